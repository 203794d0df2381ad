// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/balance.hpp"

namespace gimpm {

template <int Dim> Balance WholeBalance<Dim>::of(const Eigen::VectorXd& d, const Eigen::VectorXd& force) const
{
	const auto&            dofs     = system_.dofs;
	const Eigen::VectorXd& external = system_.external;
	Balance                b { Eigen::VectorXd(dofs.count) };
	// scaled, so that forces as small as 1e-200 N do not vanish when they are squared
	const double scale     = std::max({ external.lpNorm<Eigen::Infinity>(), force.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min() });
	double       imbalance = 0, reference = 0, largest = -1;
	for (int i = 0; i < int(dofs.number.size()); ++i) {
		const int n = dofs.number[i];
		if (n < 0) {
			reference += std::pow(force[i] / scale, 2); // external force + reaction = internal force
			continue;
		}
		const double r = b.residual[n] = external[i] - force[i];
		imbalance += std::pow(r / scale, 2);
		reference += std::pow(external[i] / scale, 2);
		if (std::abs(r) > largest) largest = std::abs(r), b.worst = i;
	}
	reference += std::pow(system_.fromOutside(d) / scale, 2);
	b.size      = scale * std::sqrt(imbalance);
	b.reference = scale * std::sqrt(reference);
	return b;
}

template <int Dim> void WholeBalance<Dim>::begin(const Balance& balance)
{
	const double entering = system_.hasInertia() ? elastic_.strainOf(system_.ownMotion) : elastic_.prescribedStrain();
	initial_              = std::max(balance.size, balance.reference);
	vanishing_            = elastic_.roundOff * elastic_.norm([&](int i) { return elastic_.strainAtStart(i) + entering; });
	if (system_.hasInertia()) vanishing_ += system_.roundOff(system_.ownMotion).norm();
}

template <int Dim> void WholeBalance<Dim>::enter(const Balance& balance)
{
	const double strain = elastic_.prescribedStrain();
	entering_           = std::min(std::max(balance.size, balance.reference), elastic_.norm([&](int) { return strain; }));
}

template <int Dim> double WholeBalance<Dim>::relative(const Balance& balance, bool isSolved) const
{
	if (isSolved && balance.size <= vanishing_) return 0;
	const bool   vanish    = std::max(balance.size, balance.reference) <= system_.model.newton.tolerance * entering_;
	const double reference = std::max({ balance.reference, initial_, vanish ? entering_ : 0 });
	return balance.size == 0 ? 0 : balance.size / reference;
}

template <int Dim> double WholeBalance<Dim>::roundOff(const Eigen::VectorXd& d) const
{
	const double motion = elastic_.strainOf(d);
	return system_.roundOff(d).norm() + elastic_.roundOff * elastic_.norm([&](int i) { return elastic_.strainAtStart(i) + motion; });
}

template class WholeBalance<2>;
template class WholeBalance<3>;

} // namespace gimpm
