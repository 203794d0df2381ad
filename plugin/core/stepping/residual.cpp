// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/residual.hpp"
#include "core/base/stopwatch.hpp"

namespace gimpm {

template <int Dim> Residual<Dim>::Residual(const StepSystem<Dim>& system, StepReport& report) : system_(system), report_(report), scales_(system.map.fields())
{
	prepare();
}

template <int Dim> void Residual<Dim>::prepare()
{
	const Stopwatch watch(report_.times.assembly);
	system_.prepare(K, &couplingBlocks);
	hasJacobian = false;
}

/// An evaluation without Jacobian is that of an iteration about to end, which needs the absolute contributions.
template <int Dim> void Residual<Dim>::evaluate(const Eigen::VectorXd& d, bool withJacobian)
{
	const Stopwatch watch(report_.times.assembly);
	hasJacobian       = withJacobian;
	hasContributions_ = !withJacobian || !system_.map.isAlone();
	failure           = system_.evaluate(
	                  d, force, withJacobian ? &K : nullptr, hasContributions_ ? &contributions_ : nullptr, withJacobian ? &couplingBlocks : nullptr);
	values.resize(system_.dofs.count);
	parts_ = { displacements(d) };
	norm = parts_[0].norm, worst = parts_[0].worst;
	if (!system_.map.isAlone()) {
		const Eigen::VectorXd roundOff = system_.roundOff(d);
		double                largest  = relativeOf(0, true);
		for (int f = 1; f < system_.map.fields(); ++f) {
			parts_.push_back(field(f, roundOff));
			norm = std::hypot(norm, parts_[f].norm);
			if (const double relative = relativeOf(f, true); parts_[f].worst >= 0 && relative > largest)
				largest = relative, worst = parts_[f].worst;
		}
	}
	if (failure || !std::isfinite(norm)) norm = std::numeric_limits<double>::infinity();
}

/// Scaled, so that forces as small as 1e-200 N do not vanish when they are squared.
template <int Dim> typename Residual<Dim>::Part Residual<Dim>::displacements(const Eigen::VectorXd& d)
{
	const Eigen::VectorXd& external     = system_.external;
	const double           largestForce = system_.map.of(0, force).template lpNorm<Eigen::Infinity>();
	const double           scale        = std::max({ external.lpNorm<Eigen::Infinity>(), largestForce, std::numeric_limits<double>::min() });
	double                 imbalance = 0, reference = 0, largest = -1;
	int                    worstOne = -1;
	for (int i = 0; i < system_.map.end(0); ++i) {
		const int n = system_.dofs.number[i];
		if (n < 0) {
			reference += std::pow(force[i] / scale, 2); // external force + reaction = internal force
			continue;
		}
		const double r = values[n] = external[i] - force[i];
		imbalance += std::pow(r / scale, 2);
		reference += std::pow(external[i] / scale, 2);
		if (std::abs(r) > largest) largest = std::abs(r), worstOne = i;
	}
	reference += std::pow(system_.fromOutside(system_.map.displacements(d)) / scale, 2);
	return { scale * std::sqrt(imbalance), scale * std::sqrt(reference), vanishing_, worstOne };
}

/// Residual of another field: what is left of all that enters or leaves at the nodes.
template <int Dim> typename Residual<Dim>::Part Residual<Dim>::field(int field, const Eigen::VectorXd& roundOff)
{
	const DofMap&   map      = system_.map;
	Eigen::VectorXd residual = -force;
	Part            part { 0, normOf(field, contributions_), normOf(field, roundOff), -1 };
	for (int i = map.begin(field); i < map.end(field); ++i)
		if (const int n = system_.dofs.number[i]; n < 0) residual[i] = 0;
		else {
			values[n] = map[field].scale * residual[i];
			if (part.worst < 0 || std::abs(residual[i]) > std::abs(residual[part.worst])) part.worst = i;
		}
	part.norm = normOf(field, residual);
	return part;
}

/// Norm of one block, scaled.
template <int Dim> double Residual<Dim>::normOf(int field, const Eigen::VectorXd& all) const
{
	return system_.map[field].scale * Eigen::VectorXd(system_.map.of(field, all)).stableNorm();
}

template <int Dim> void Residual<Dim>::begin()
{
	const double entering = system_.hasInertia() ? elastic_.strainOf(system_.inertialPredictor) : elastic_.prescribedStrain();
	vanishing_            = elastic_.roundOff * elastic_.norm([&](int i) { return elastic_.strainAtStart(i) + entering; });
	if (system_.hasInertia()) vanishing_ += system_.map.displacements(system_.roundOff(system_.inertialPredictor)).norm();
	for (std::size_t f = 0; f < scales_.size(); ++f)
		scales_[f].initial = std::max(parts_[f].norm, parts_[f].reference);
}

template <int Dim> void Residual<Dim>::enter(const Eigen::VectorXd& caused)
{
	const double strain = elastic_.prescribedStrain();
	caused_             = caused.cwiseAbs();
	scales_[0].entering = std::min(std::max(parts_[0].norm, parts_[0].reference), elastic_.norm([&](int) { return strain; }));
	for (int f = 1; f < int(scales_.size()); ++f)
		scales_[f].entering = normOf(f, caused_);
}

template <int Dim> Eigen::VectorXd Residual<Dim>::forcesOf(const Eigen::VectorXd& growth) const
{
	Eigen::VectorXd forces = Eigen::VectorXd::Zero(growth.size());
	K.multiplyAdd(growth, forces);
	if (system_.isCoupled()) couplingBlocks.multiplyAdd(growth, forces);
	system_.constraints.template condense<Dim>(system_.map, forces);
	system_.completeForces(forces);
	return forces;
}

template <int Dim> double Residual<Dim>::relative(bool isSolved) const
{
	if (!std::isfinite(norm)) return norm;
	double largest = relativeOf(0, isSolved);
	for (int f = 1; f < int(parts_.size()); ++f)
		largest = std::max(largest, relativeOf(f, isSolved));
	return largest;
}

template <int Dim> double Residual<Dim>::relativeOf(int field, bool isSolved) const
{
	const Part&  part  = parts_[field];
	const Scale& scale = scales_[field];
	if (part.norm == 0 || (isSolved && part.norm <= part.vanishing)) return 0;
	const bool vanish = std::max(part.norm, part.reference) <= system_.model.newton.tolerance * scale.entering;
	return part.norm / std::max({ part.reference, scale.initial, vanish ? scale.entering : 0 });
}

template <int Dim> bool Residual<Dim>::isRoundOff(const Eigen::VectorXd& d) const
{
	const double motion = elastic_.strainOf(d);
	return norm <= system_.map.displacements(system_.roundOff(d)).norm()
	        + elastic_.roundOff * elastic_.norm([&](int i) { return elastic_.strainAtStart(i) + motion; });
}

template class Residual<2>;
template class Residual<3>;

} // namespace gimpm
