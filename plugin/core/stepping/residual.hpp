// SPDX-License-Identifier: GPL-2.0-or-later
// Residual r(d) = f_ext - sum of the terms at d, and the forces that it is compared with.
#pragma once
#include "core/stepping/elastic_forces.hpp"

namespace gimpm {

/// Residual, forces and, on demand, Jacobian K = d(sum of the terms) / dd at the last growth d that was evaluated.
template <int Dim> class Residual {
public:
	Residual(const StepSystem<Dim>&, StepReport&);

	/// Sets the pattern of K; the next evaluation has to fill it.
	void prepare();

	/// A failure of a point or a residual that is not a number leaves the norm infinite.
	void evaluate(const Eigen::VectorXd& d, bool withJacobian);

	/// Marks the last evaluation as the start of the step: forces of its size are a scale to the end.
	void begin();

	/// Marks the last evaluation as the one with which prescribed growth entered: no more than this can cause by
	/// itself is a scale, for points that other loads have nearly turned inside out resist with any force.
	/// `caused`: forces that it alone causes.
	void enter(const Eigen::VectorXd& caused);

	/// K times a growth, completed at all nodes.
	Eigen::VectorXd forcesOf(const Eigen::VectorXd& growth) const;

	/// |r| / |external forces + reactions|. Where both end at zero, r is compared with the forces at the start of
	/// the step, as in unloading, or with those that prescribed displacements cause at first, as in a rigid motion;
	/// and it is zero where it is round-off of stresses that balance each other, at an iterate that a solve has led
	/// to. Of several fields that which is least in balance counts. Others than displacements are compared with
	/// the absolute contributions of all that enters or leaves at the nodes.
	double relative(bool isSolved) const;

	/// Largest |r| around a node over the forces there (local_residual.cpp), at d, where the last evaluation was,
	/// if that is above `enough`; else an upper bound of it. One norm over the whole body does not see a soft or
	/// lightly loaded part beside a stiff or strongly loaded one. A node and its neighbours are taken together: a
	/// node that the body hardly touches has next to no forces of its own, and each node of a soft part has some
	/// neighbourhood that reaches no stiff one.
	double local(const Eigen::VectorXd& d, double enough);

	/// True if |r| is no more than round-off of d and of the strains at the start of the step may leave.
	bool isRoundOff(const Eigen::VectorXd& d) const;

	Eigen::VectorXd             values;              ///< r by number of the free degree of freedom, other fields than displacements scaled [N]
	double                      norm  = 0;           ///< |r| of all fields together, infinite where there is no such number [N]
	int                         worst = -1;          ///< unknown with the largest |r|, of the field that is least in balance
	Eigen::VectorXd             force;               ///< sum of the terms at all unknowns
	NodeMatrix<Dim>             K;                   ///< Jacobian of the last evaluation that asked for it
	Couplings                   couplingBlocks;      ///< K, of the same evaluation
	bool                        hasJacobian = false; ///< K is that of the last evaluation
	std::optional<PointFailure> failure;

private:
	/// Norms of one field.
	struct Part {
		double norm = 0, reference = 0, vanishing = 0; ///< |r|; forces that it is compared with; round-off
		int    worst = -1;                             ///< unknown
	};
	/// Scales of one field, besides the forces at an iterate.
	struct Scale {
		double initial = 0, entering = 0;
	};
	Part   displacements(const Eigen::VectorXd& d);
	Part   field(int field, const Eigen::VectorXd& roundOff);
	double normOf(int field, const Eigen::VectorXd& all) const;
	double relativeOf(int field, bool isSolved) const;

	double          localOfDisplacements(const Eigen::VectorXd& nodal, const Eigen::VectorXd& d, double enough) const;
	double          localOf(int field, const Eigen::VectorXd& nodal, const Eigen::VectorXd& roundOff) const;
	Eigen::VectorXd around(const Eigen::VectorXd& ofNode) const;
	double          largestStrain(const Eigen::VectorXd& d) const;

	const StepSystem<Dim>& system_;
	StepReport&            report_;
	ElasticForces<Dim>     elastic_ { system_ };
	std::vector<Part>      parts_;                    // by field
	std::vector<Scale>     scales_;                   // by field
	double                 vanishing_ = 0;            // round-off of displacements [N]
	Eigen::VectorXd        contributions_;            // absolute contributions to the forces
	Eigen::VectorXd        caused_;                   // absolute forces that prescribed growth causes
	bool                   hasContributions_ = false; // they are those of the last evaluation
};

} // namespace gimpm
