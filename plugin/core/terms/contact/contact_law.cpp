// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact_law.hpp"
#include <algorithm>

namespace gimpm {

template <int Dim> std::optional<Touch<Dim>> touch(const ContactLaw<Dim>& law, const Approach<Dim>& approach, double tolerance)
{
	const auto& [gap, n, dn, beside] = approach.at;
	const bool isPressed             = gap <= tolerance;
	if (!isPressed && !(law.around > 0 && gap <= law.reach)) return std::nullopt;
	const Mat<Dim> P = Mat<Dim>::Identity() - n * n.transpose();
	Touch<Dim>     t;
	t.normal      = n;
	t.normalForce = std::max(0., -law.normalStiffness * gap);
	if (isPressed) t.tangent = -law.normalStiffness * n * n.transpose() + t.normalForce * dn;
	const double limit = std::min(law.frictionCoefficient * std::max(t.normalForce, law.around), law.cap);
	if (law.frictionCoefficient == 0 || law.cap == 0) return t;
	if (limit == 0) {
		t.tangent -= law.tangentialStiffness * P * approach.slipDerivative;
		return t;
	}
	const Vec<Dim> y = approach.tangentialForce - law.tangentialStiffness * approach.slip, trial = P * y;
	const Mat<Dim> dtrial = -n * (y.transpose() * dn) - n.dot(y) * dn - law.tangentialStiffness * P * approach.slipDerivative;
	const double   size   = trial.norm();
	t.slips               = size > limit;
	if (!t.slips) {
		t.tangentialForce = trial;
		t.tangent += dtrial;
		return t;
	}
	const Vec<Dim> along = trial / size;
	t.tangentialForce    = limit * along;
	t.tangent += limit / size * (dtrial - along * (along.transpose() * dtrial));
	if (t.normalForce >= law.around && law.frictionCoefficient * t.normalForce < law.cap)
		t.tangent -= law.frictionCoefficient * law.normalStiffness * along * n.transpose();
	return t;
}

template std::optional<Touch<2>> touch(const ContactLaw<2>&, const Approach<2>&, double);
template std::optional<Touch<3>> touch(const ContactLaw<3>&, const Approach<3>&, double);

} // namespace gimpm
