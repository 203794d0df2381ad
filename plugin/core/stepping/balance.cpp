// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/balance.hpp"

namespace gimpm {
namespace {

/// |residual| of the displacements [N].
double sizeOfForces(const Balance& balance) { return balance.fields.empty() ? balance.size : balance.fields[0].size; }

} // namespace

template <int Dim> Balance WholeBalance<Dim>::of(const Eigen::VectorXd& d, const Eigen::VectorXd& force, const Eigen::VectorXd& absoluteContributions) const
{
	const auto&            dofs     = system_.dofs;
	const Eigen::VectorXd& external = system_.external;
	Balance                b { Eigen::VectorXd(dofs.count) };
	// scaled, so that forces as small as 1e-200 N do not vanish when they are squared
	const double largestForce = system_.map.of(0, force).template lpNorm<Eigen::Infinity>();
	const double scale        = std::max({ external.lpNorm<Eigen::Infinity>(), largestForce, std::numeric_limits<double>::min() });
	double       imbalance = 0, reference = 0, largest = -1;
	for (int i = 0; i < system_.map.end(0); ++i) {
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
	reference += std::pow(system_.fromOutside(system_.map.displacements(d)) / scale, 2);
	b.size      = scale * std::sqrt(imbalance);
	b.reference = scale * std::sqrt(reference);
	if (!system_.map.isAlone()) addFields(b, d, force, absoluteContributions);
	return b;
}

/// Adds the residuals of other fields: what is left of all that enters or leaves at the nodes. The worst unknown is
/// that of the field which is least in balance.
template <int Dim>
void WholeBalance<Dim>::addFields(Balance& b, const Eigen::VectorXd& d, const Eigen::VectorXd& force, const Eigen::VectorXd& absoluteContributions) const
{
	const DofMap&         map      = system_.map;
	const Eigen::VectorXd roundOff = system_.roundOff(d);
	b.fields                       = { { b.size, b.reference, 0, b.worst } };
	double largest                 = relativeOf(0, b.fields[0], true);
	for (int f = 1; f < map.fields(); ++f) {
		Eigen::VectorXd residual = -force;
		Balance::Part   part { 0, normOf(f, absoluteContributions), normOf(f, roundOff), -1 };
		for (int i = map.begin(f); i < map.end(f); ++i)
			if (const int n = system_.dofs.number[i]; n < 0) residual[i] = 0;
			else {
				b.residual[n] = map[f].scale * residual[i];
				if (part.worst < 0 || std::abs(residual[i]) > std::abs(residual[part.worst])) part.worst = i;
			}
		part.size = normOf(f, residual);
		b.size    = std::hypot(b.size, part.size);
		if (const double relative = relativeOf(f, part, true); part.worst >= 0 && relative > largest) largest = relative, b.worst = part.worst;
		b.fields.push_back(part);
	}
}

/// Norm of one block, scaled.
template <int Dim> double WholeBalance<Dim>::normOf(int field, const Eigen::VectorXd& all) const
{
	return system_.map[field].scale * Eigen::VectorXd(system_.map.of(field, all)).stableNorm();
}

template <int Dim> void WholeBalance<Dim>::begin(const Balance& balance)
{
	const double entering = system_.hasInertia() ? elastic_.strainOf(system_.inertialPredictor) : elastic_.prescribedStrain();
	initial_              = std::max(sizeOfForces(balance), balance.reference);
	vanishing_            = elastic_.roundOff * elastic_.norm([&](int i) { return elastic_.strainAtStart(i) + entering; });
	if (system_.hasInertia()) vanishing_ += system_.map.displacements(system_.roundOff(system_.inertialPredictor)).norm();
	enteringOfFields_.assign(balance.fields.size(), 0);
	initialOfFields_ = enteringOfFields_;
	for (std::size_t f = 0; f < balance.fields.size(); ++f)
		initialOfFields_[f] = std::max(balance.fields[f].size, balance.fields[f].reference);
}

template <int Dim> void WholeBalance<Dim>::enter(const Balance& balance, const Eigen::VectorXd& caused)
{
	const double strain = elastic_.prescribedStrain();
	entering_           = std::min(std::max(sizeOfForces(balance), balance.reference), elastic_.norm([&](int) { return strain; }));
	for (int f = 1; f < int(balance.fields.size()); ++f)
		enteringOfFields_[f] = normOf(f, caused);
}

template <int Dim> double WholeBalance<Dim>::relative(const Balance& balance, bool isSolved) const
{
	if (balance.fields.empty() || !std::isfinite(balance.size)) return relativeOfDisplacements(balance.size, balance.reference, isSolved);
	double largest = 0;
	for (int f = 0; f < int(balance.fields.size()); ++f)
		largest = std::max(largest, relativeOf(f, balance.fields[f], isSolved));
	return largest;
}

template <int Dim> double WholeBalance<Dim>::relativeOf(int field, const Balance::Part& part, bool isSolved) const
{
	if (field == 0) return relativeOfDisplacements(part.size, part.reference, isSolved);
	if (part.size == 0 || (isSolved && part.size <= part.vanishing)) return 0;
	const bool   hasBegun = field < int(initialOfFields_.size());
	const double initial = hasBegun ? initialOfFields_[field] : 0, entering = hasBegun ? enteringOfFields_[field] : 0;
	const bool   vanish = std::max(part.size, part.reference) <= system_.model.newton.tolerance * entering;
	return part.size / std::max({ part.reference, initial, vanish ? entering : 0 });
}

template <int Dim> double WholeBalance<Dim>::relativeOfDisplacements(double size, double reference, bool isSolved) const
{
	if (isSolved && size <= vanishing_) return 0;
	const bool vanish = std::max(size, reference) <= system_.model.newton.tolerance * entering_;
	return size == 0 ? 0 : size / std::max({ reference, initial_, vanish ? entering_ : 0 });
}

template <int Dim> double WholeBalance<Dim>::roundOff(const Eigen::VectorXd& d) const
{
	const double motion = elastic_.strainOf(d);
	return system_.map.displacements(system_.roundOff(d)).norm()
	        + elastic_.roundOff * elastic_.norm([&](int i) { return elastic_.strainAtStart(i) + motion; });
}

template class WholeBalance<2>;
template class WholeBalance<3>;

} // namespace gimpm
