// SPDX-License-Identifier: GPL-2.0-or-later
// Inertia: the step as one in time.
#pragma once
#include "core/terms/inertia/motion.hpp"
#include "core/terms/inertia/nodal_mass.hpp"

namespace gimpm {

/// Consistent mass times acceleration, and damping. Points give momentum to the nodes, which have the velocities v of
/// (M + M_g) v = sum of S m v_p, constrained ones those that the step prescribes, by a blow where points have brought
/// others along; points take back what changes of them (FLIP). Every other force is that at the end of the step. Where
/// the scheme weighs it with that of the beginning the whole balance is divided by its weight: so other terms are as in
/// a step without inertia. Cells whose points are too few also resist accelerations by the inertia of their extent:
/// else what the points do not see of their nodes' motion has neither mass nor, where soil is torn, any stiffness, and
/// Newton's method goes round. A body in free fall does not feel it.
template <int Dim> class Inertia : public Term<Dim> {
public:
	/// To be made after all other terms. Velocities and accelerations are written in commit().
	Inertia(Motion<Dim>&, const StepContext<Dim>&);

	void                        mark(NodeMatrix<Dim>& K) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) override;
	void                        addBefore(Eigen::VectorXd&) override { }
	bool                        isSymmetric() const override;
	std::string                 obstacle() const override;
	double                      fromOutside(const Eigen::VectorXd& d) override;
	void                        restrain(const typename Term<Dim>::Constrain&) override;
	LocalError                  localError(const Eigen::VectorXd& d) const override;
	void                        commit(const Eigen::VectorXd& d) override;

	/// True if the mass matrix is singular to working precision.
	bool isSingular() const { return isSingular_; }

	/// Displacements by which the body goes on by itself, with the prescribed ones.
	Eigen::VectorXd inertialPredictor() const;

	/// Adds what round-off of d leaves of its force, which is more than round-off of strains does [N].
	void addRoundOff(const Eigen::VectorXd& d, Eigen::VectorXd& absoluteContributions) const;

	/// Work of the forces that are out of balance with the accelerations of the points as the step begins, and of
	/// what the scheme damps; negative: energy that nobody has put in [J].
	double gridWork(const Eigen::VectorXd& d);

	const Motion<Dim>& motion() const { return motion_; }
	double             kineticEnergy() const; ///< energy of the points as the step begins, of all processes [J]

private:
	using Side = typename NodalMass<Dim>::Side;
	/// Effect of contact on the nodes at the end of the step: forces, and the accelerations that these give.
	struct Pushed {
		Eigen::VectorXd d, force, acceleration;
	};

	void            findExtent(const StepContext<Dim>&);
	void            findStart(const StepContext<Dim>&);
	void            findVelocity(bool withAcceleration);
	void            mend(const StepContext<Dim>&, bool withAcceleration);
	Eigen::VectorXd imbalanceOf(const StepContext<Dim>&) const;
	void            solve(const std::vector<Side>&);
	void            solveByFactor(const std::vector<Side>&);
	void            solveAlong(int axis, const Side&, const Eigen::VectorXd& rest);
	Eigen::VectorXd solved(const Eigen::VectorXd& right); // solution, zero at constrained nodes
	Eigen::VectorXd velocityAt(const Eigen::VectorXd& d) const;
	Eigen::VectorXd ofContact(const Eigen::VectorXd* d) const; // on the nodes; null: as the step begins
	const Pushed&   pushedAt(const Eigen::VectorXd& d);
	Eigen::VectorXd withoutContact(const Eigen::VectorXd& d); // acceleration at the end
	Eigen::VectorXd growthAt(const Eigen::VectorXd& d);       // growth of velocities, without that by a blow
	Eigen::VectorXd accelerationAt(const Eigen::VectorXd& d) const;
	Eigen::VectorXd ofExtent(const Eigen::VectorXd& acceleration) const;
	bool            isConstrained(Eigen::Index dof) const { return dofs_.number[dof] < 0; }

	Motion<Dim>&                               motion_;
	const Division&                            division_;
	const OwnedNodes&                          ownedNodes_;
	const MotionOfCopies<Dim>                  copies_;
	const CloudBasis<Dim>&                     basis_;
	const FreeDofs&                            dofs_;
	const Eigen::VectorXd&                     prescribed_;
	const std::vector<GhostFace<Dim>>&         faces_;
	double                                     h_; // size of the cells
	const std::vector<LooseCell<Dim>>          loose_;
	MassMatrix<Dim>                            mass_;
	NodalMass<Dim>                             nodal_;    // the same, for products and conjugate gradients
	std::unique_ptr<MassMatrix<Dim>>           extent_;   // extent of points in loose cells; null: there are none
	bool                                       iterates_; // its condition number is bounded, and conjugate gradients have got there
	std::vector<std::unique_ptr<Damping<Dim>>> damping_;
	bool                                       isSingular_ = false;
	// Flags of the solvers of the motion that have a factor in this step.
	std::array<bool, Dim + 1> factorised_ {};
	// At the start, without contact, where the scheme asks for it; zero at constrained nodes.
	Eigen::VectorXd imbalance_;
	// Forces at the start beyond those of acceleration_; zero at constrained nodes.
	Eigen::VectorXd neglected_;
	// At the start, without what contact does to the latter.
	Eigen::VectorXd velocity_, acceleration_;
	Eigen::VectorXd expected_;    // acceleration, with contact
	Pushed          pushed_;      // forces at the displacements they were last asked for
	Eigen::VectorXd blow_, jump_; // impulse of what holds nodes as the step begins, and the velocities that it changes
};

} // namespace gimpm
