// SPDX-License-Identifier: GPL-2.0-or-later
// Pressure by which contact points on a round body rub that soil does not reach because it is straight within a cell.
#include "core/terms/contact/contact.hpp"
#include <array>
#include <cmath>
#include <map>

namespace gimpm {
namespace {

struct Pressed {
	double force = 0, area = 0;
};

/// A chord of a cell's length is off an arc by an eighth of a cell where the radius is that of a cell, and less where
/// it is larger.
constexpr double offChord = 1. / 8;

} // namespace

/// Soil that is pressed all over a ball touches it in some contact points of a cell and lies off it by a part of the
/// chord in others. The grid knows what presses on all of them together, so that is what adhesion goes by: that of the
/// last step, over the area. Where friction has no other bound than pressure, all of it is the same with or without.
template <int Dim> void Contact<Dim>::spreadPressure()
{
	const auto cellOf = [&](const ContactPoint& contactPoint) {
		std::array<int, Dim + 1> key { contactPoint.body };
		for (int a = 0; a < Dim; ++a)
			key[a + 1] = int(std::floor((contactPoint.soil[a] - grid_.origin[a]) / grid_.cellSize));
		return key;
	};
	const auto isMeant = [&](const ContactPoint& contactPoint) {
		return system_.bodies[contactPoint.body].shape.kind == RigidKind::ball && contactPoint.law.frictionCoefficient > 0
		        && std::isfinite(contactPoint.law.cap);
	};
	std::map<std::array<int, Dim + 1>, Pressed> cells;
	for (const ContactPoint& contactPoint : contactPoints_) {
		if (!isMeant(contactPoint)) continue;
		auto& cell = cells[cellOf(contactPoint)];
		cell.area += contactPoint.area;
		if (const auto* r = recordOf(contactPoint)) cell.force += r->normalForce;
	}
	for (ContactPoint& contactPoint : contactPoints_) {
		if (!isMeant(contactPoint)) continue;
		const auto& cell        = cells[cellOf(contactPoint)];
		contactPoint.law.around = cell.force / cell.area * contactPoint.area, contactPoint.law.reach = offChord * grid_.cellSize;
	}
}

template void Contact<2>::spreadPressure();
template void Contact<3>::spreadPressure();

} // namespace gimpm
