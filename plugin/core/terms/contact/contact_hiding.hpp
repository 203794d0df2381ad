// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of a body that others hide: contact points inside of them, and soil behind them.
#pragma once
#include "core/terms/contact/contact_sight.hpp"
#include "core/terms/contact/rigid_body.hpp"
#include <algorithm>

namespace gimpm {

/// Bodies in or on which a contact point of a body may be.
template <int Dim> std::vector<int> bodiesAround(const std::vector<RigidBody<Dim>>& bodies, int number, double tolerance)
{
	const auto [low, high] = bodies[number].bounds(bodies[number].begin);
	std::vector<int> found;
	for (int b = 0; b < int(bodies.size()); ++b) {
		const auto [otherLow, otherHigh] = bodies[b].bounds(bodies[b].begin);
		const bool isApart               = (otherLow.array() > high.array() + tolerance).any() || (otherHigh.array() < low.array() - tolerance).any();
		if (b != number && !isApart) found.push_back(b);
	}
	return found;
}

/// The bodies around one.
template <int Dim> class Hiding {
public:
	Hiding(const std::vector<RigidBody<Dim>>& bodies, int number, double cellSize, double tolerance)
	        : bodies_(bodies), number_(number), cellSize_(cellSize), tolerance_(tolerance), around_(bodiesAround(bodies, number, tolerance))
	{
	}

	/// True if the contact point is in another body, in a joint with it, or on the surface of one that came first
	/// and faces alike.
	bool hides(const Vec<Dim>& position, const Vec<Dim>& normal) const
	{
		return std::any_of(around_.begin(), around_.end(), [&](int b) {
			const auto& other    = bodies_[b];
			const auto  at       = other.proximity(other.begin, position, other.sideOf(other.begin, position + cellSize_ * normal));
			const bool  isAlike  = at.normal.dot(normal) > 1 - 1e-6 && std::abs(at.gap) <= tolerance_ && at.beside < 0;
			const bool  isInside = !other.shape.isTwoSided && at.gap < -tolerance_;
			const bool  isJoint  = !other.shape.isTwoSided && at.normal.dot(normal) < -1 + 1e-6 && at.gap <= tolerance_;
			return isInside || isJoint || (isAlike && b < number_);
		});
	}

	/// Tests if one of the sheets around is between a contact point and soil; empty if none can be. At the edge
	/// that it shares with the sheet of the contact point, as below a pile that is made of sheets, soil outside is
	/// beside the contact points inside. Soil that is a little behind the screen counts as before it.
	typename SoilNear<Dim>::Hides screensBefore(const Vec<Dim>& position) const
	{
		std::vector<std::pair<const RigidBody<Dim>*, double>> screens; // and how far the contact point is from their planes
		for (const int b : around_) {
			const auto& sheet = bodies_[b];
			if (sheet.shape.kind != RigidKind::sheet) continue;
			const double away = sheet.proximity(sheet.begin, position, 1).gap + sheet.halfThickness();
			if (std::abs(away) > tolerance_) screens.emplace_back(&sheet, away);
		}
		if (screens.empty()) return {};
		return [screens = std::move(screens), position](const Vec<Dim>& soil) {
			return std::any_of(screens.begin(), screens.end(), [&](const auto& screen) {
				const auto& [sheet, here] = screen;
				if (here * sheet->sideOf(sheet->begin, soil) > 0) return false;
				const double   there    = sheet->proximity(sheet->begin, soil, 1).gap + sheet->halfThickness();
				const Vec<Dim> crossing = here * there < 0 ? Vec<Dim>(position + here / (here - there) * (soil - position)) : soil;
				return sheet->proximity(sheet->begin, crossing, 1).beside < 0;
			});
		};
	}

private:
	const std::vector<RigidBody<Dim>>& bodies_;
	const int                          number_;
	const double                       cellSize_, tolerance_;
	const std::vector<int>             around_;
};

} // namespace gimpm
