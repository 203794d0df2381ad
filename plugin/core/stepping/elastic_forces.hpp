// SPDX-License-Identifier: GPL-2.0-or-later
// Forces that residuals and their round-off are compared with.
#pragma once
#include "core/materials/kinematics.hpp"
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// The points' stiffness as a measure of forces.
template <int Dim> class ElasticForces {
public:
	explicit ElasticForces(const StepSystem<Dim>& system) : system_(system) { }

	/// Norm of the points' internal forces if each had an elastic strain of this size, strain(point) [N].
	template <class F> double norm(F&& strain) const
	{
		Eigen::VectorXd force = Eigen::VectorXd::Zero(system_.points.volume0.size());
		for (const auto& patch : system_.basis.patches)
			for (int i = patch.first; i < patch.first + patch.count && system_.counts(patch); ++i)
				force[i] = of(i, strain(i));
		return normOfAll(*system_.model.division->processes, force.stableNorm());
	}
	/// Their sum over the points around each node [N].
	template <class F> Eigen::VectorXd atNodes(F&& strain) const
	{
		Eigen::VectorXd force = Eigen::VectorXd::Zero(system_.basis.nodes.size());
		for (const auto& patch : system_.basis.patches) {
			double sum = 0;
			for (int i = patch.first; i < patch.first + patch.count; ++i)
				sum += of(i, strain(i));
			for (const int node : patch.node)
				if (node >= 0) force[node] += sum;
		}
		system_.complete(force);
		return force;
	}
	/// Size of the elastic strain of a point at the start of the step.
	double strainAtStart(int i) const { return system_.points.leftCauchyGreen[i].c.norm(); }

	/// Strain of a cell of which one side is held while the displacements prescribed in the step move the other.
	double prescribedStrain() const { return strainOf(system_.prescribed); }

	/// Strain of a cell of which one side is held and the other moves like the node that moves most.
	double strainOf(const Eigen::VectorXd& d) const { return system_.map.of(0, d).template lpNorm<Eigen::Infinity>() / system_.model.grid.cellSize; }

	static constexpr double roundOff = 10 * std::numeric_limits<double>::epsilon(); ///< part of a strain

private:
	double of(int i, double strain) const
	{
		const auto&  points     = system_.points;
		const auto   dilatation = [&] { return volumetricStrain(points.leftCauchyGreen[i]); };
		const double young      = system_.model.materials[points.material[i]].young(points.parameters, points.internals, i, dilatation);
		const double water      = system_.model.materials[points.material[i]].waterModulus;
		return points.volume0[i] * (young + water) * strain / system_.model.grid.cellSize;
	}
	const StepSystem<Dim>& system_;
};

} // namespace gimpm
