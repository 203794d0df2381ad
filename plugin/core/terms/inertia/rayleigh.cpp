// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/rayleigh.hpp"
#include "core/terms/inertia/mass_matrix.hpp"
#include "core/terms/points/internal_force.hpp"

namespace gimpm {

template <int Dim>
RayleighDamping<Dim>::RayleighDamping(
        Rayleigh& settings, const std::vector<Material>& materials, bool fBar, const std::vector<double>& masses, const StepContext<Dim>& step)
        : settings_(settings), ownedNodes_(step.ownedNodes)
{
	const auto points = stepPoints(step.cloud, materials, step.basis, fBar);
	C_.reset(step.basis.nodes, points.isSymmetric, step.grid, ownedNodes_.range());
	markPointPattern(step.basis, C_);
	if (settings.beta > 0) {
		const Eigen::VectorXd still   = Eigen::VectorXd::Zero(Dim * step.basis.nodes.size());
		Eigen::VectorXd       force   = still;
		std::int64_t          isThere = !addInternalForce<Dim>(step.basis, points, materials, still, { force, &C_ });
		step.division.smallest(&isThere, 1);
		if (!isThere) obstacle_ = "a point has no stiffness to be damped by";
		C_.multiplyBy(settings.beta);
	}
	if (settings.alpha > 0) MassMatrix<Dim>(step.basis, masses, {}, step.grid.cellSize).addTo(C_, settings.alpha);
}

template <int Dim> void RayleighDamping<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (int a = 0; a < C_.nodes(); ++a)
		for (int code = 0; code < NodeMatrix<Dim>::codes; ++code)
			if (C_.used(a, code)) K.markUsed(a, code);
}

template <int Dim> void RayleighDamping<Dim>::add(const Eigen::VectorXd& v, double velocityDerivative, const AssembledTerms<Dim>& sum) const
{
	Eigen::VectorXd force = Eigen::VectorXd::Zero(v.size());
	C_.multiplyAdd(v, force);
	sum.force += force;
	if (sum.absoluteContributions) *sum.absoluteContributions += force.cwiseAbs();
	if (!sum.K) return;
	for (int a = 0; a < C_.nodes(); ++a)
		for (int code = 0; code < NodeMatrix<Dim>::codes; ++code)
			for (int i = 0; i < NodeMatrix<Dim>::block && C_.used(a, code) && sum.K->keeps(a); ++i) {
				sum.K->at(a, code)[i] += velocityDerivative * C_.at(a, code)[i];
				if (!C_.isSymmetric()) sum.K->skewAt(a, code)[i] += velocityDerivative * C_.skewAt(a, code)[i];
			}
}

template <int Dim> void RayleighDamping<Dim>::commit(const Eigen::VectorXd& d, const Eigen::VectorXd& before, const Eigen::VectorXd& now)
{
	settings_.work = this->workTaken(d, before, now, ownedNodes_);
}

template class RayleighDamping<2>;
template class RayleighDamping<3>;

} // namespace gimpm
