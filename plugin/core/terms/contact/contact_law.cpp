// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact_law.hpp"

namespace gimpm {

template <int Dim> std::optional<Touch<Dim>> touch(const ContactLaw<Dim>& law, const Approach<Dim>& approach, double tolerance)
{
	const auto& [gap, n, dn, beside] = approach.at;
	const bool isPressed             = gap <= tolerance;
	if (!isPressed && !(law.around > 0 && gap <= law.reach)) return std::nullopt;
	const Mat<Dim> P = Mat<Dim>::Identity() - n * n.transpose();
	Touch<Dim>     t;
	t.normal      = n;
	t.normalForce = law.normalForce(gap);
	if (isPressed) t.tangent = -law.normalStiffness * n * n.transpose() + t.normalForce * dn;
	if (law.isSmooth()) return t;
	if (std::max(t.normalForce, law.around) == 0) {
		t.tangent -= law.tangentialStiffness * P;
		return t;
	}
	const Vec<Dim>                      y        = approach.tangentialForce - law.tangentialStiffness * approach.slip;
	const Mat<Dim>                      dTrial   = -n * (y.transpose() * dn) - n.dot(y) * dn - law.tangentialStiffness * P;
	const Eigen::Matrix<double, 1, Dim> dGap     = n.transpose();
	const auto                          friction = returnMapping<Dim, Dim>(law, t.normalForce, P * y, &dTrial, &dGap, &t.tangent);
	t.tangentialForce = friction.force, t.slips = friction.slips;
	return t;
}

template std::optional<Touch<2>> touch(const ContactLaw<2>&, const Approach<2>&, double);
template std::optional<Touch<3>> touch(const ContactLaw<3>&, const Approach<3>&, double);

} // namespace gimpm
