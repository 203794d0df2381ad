// SPDX-License-Identifier: GPL-2.0-or-later
// Out-of-balance forces at an iterate, and the forces that they are compared with.
#pragma once
#include "core/materials/kinematics.hpp"
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// Out-of-balance forces on the free degrees of freedom. Those of other fields than the displacements are scaled.
struct Balance {
	Eigen::VectorXd residual;       ///< residual by number of the free degree of freedom [N]
	double          size      = 0;  ///< |residual| of all fields together, infinite where there is no such number [N]
	double          reference = 0;  ///< |external forces + reactions| [N]
	int             worst     = -1; ///< unknown

	/// Balance of one field.
	struct Part {
		/// |residual|; forces that it is compared with; what is round-off.
		double size = 0, reference = 0, vanishing = 0;
		int    worst = -1; ///< unknown
	};
	std::vector<Part> fields {}; ///< all, in their order; empty where there are displacements alone
};

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

/// The residual of the whole body, iterate by iterate.
template <int Dim> class WholeBalance {
public:
	explicit WholeBalance(const StepSystem<Dim>& system) : system_(system), elastic_(system) { }

	/// Balance of this sum of the terms at d; their absolute contributions where there are several fields.
	Balance of(const Eigen::VectorXd& d, const Eigen::VectorXd& force, const Eigen::VectorXd& absoluteContributions) const;

	/// The one at the start of the step: forces of this size are its scale to the end.
	void begin(const Balance&);

	/// The one with which prescribed displacements entered: no more than they can cause by themselves, for points
	/// that other loads have nearly turned inside out resist with any force. `caused`: what prescribed growth of
	/// several fields causes.
	void enter(const Balance&, const Eigen::VectorXd& caused);

	/// |residual| / |external forces + reactions|. Where both end at zero, the residual is compared with the forces
	/// at
	/// the start of the step, as in unloading, or with those that prescribed displacements cause at first, as in a
	/// rigid motion; and it is zero where it is round-off of stresses that balance each other, at an iterate that a
	/// solve has led to. Of several fields that which is least in balance counts. Others than displacements are
	/// compared with the absolute contributions of all that enters or leaves at the nodes.
	double relative(const Balance&, bool isSolved) const;

	/// Residual that round-off of the displacements d and of the strains at the start of the step may leave [N].
	double roundOff(const Eigen::VectorXd& d) const;

private:
	void   addFields(Balance&, const Eigen::VectorXd& d, const Eigen::VectorXd& force, const Eigen::VectorXd& absoluteContributions) const;
	double normOf(int field, const Eigen::VectorXd& all) const;
	double relativeOfDisplacements(double size, double reference, bool isSolved) const;
	double relativeOf(int field, const Balance::Part&, bool isSolved) const;

	const StepSystem<Dim>& system_;
	ElasticForces<Dim>     elastic_;
	double                 initial_ = 0, entering_ = 0, vanishing_ = 0; // [N]
	std::vector<double>    initialOfFields_, enteringOfFields_;         // the same of the other fields, scaled
};

} // namespace gimpm
