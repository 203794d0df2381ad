// SPDX-License-Identifier: GPL-2.0-or-later
// Inertia in a step whose displacements are known as it begins.
#pragma once
#include "core/terms/inertia/motion.hpp"
#include "core/terms/inertia/nodal_mass.hpp"

namespace gimpm {

/// Central differences in the form with velocities at the ends of steps (velocity Verlet, Newmark's rule with beta = 0
/// and gamma = 1/2): M a_0 = f(0), v_1/2 = v_0 + T/2 a_0, d = T v_1/2, M a_1 = f(d), v_1 = v_1/2 + T/2 a_1. Forces as
/// the step begins are those in its own cells, not those at the end of the step before: so each step is the same
/// forwards and backwards, and what cells that change do to energy is of second order. With accelerations that points
/// carry along, and one evaluation of forces a step, two blocks that meet win energy in proportion to the length of a
/// step, a hundred times as much. Momentum is exact to round-off, angular momentum too but for what ghost mass takes
/// from accelerations that are not linear.
template <int Dim> class ExplicitInertia {
public:
	/// Velocities and accelerations are written in commit().
	ExplicitInertia(Motion<Dim>&, const StepContext<Dim>&);

	/// True if forces of contact between bodies of points have been found.
	bool        meets() const { return meets_; }
	std::string obstacle() const; ///< why the step cannot be made, a clause; empty if it can
	bool        isSingular() const { return isSingular_; }
	int         iterations() const { return mass_.iterations(); } ///< iterations of conjugate gradients
	double      seconds() const { return seconds_; }              ///< for all that has to do with mass

	Eigen::VectorXd displacements() const { return motion_.duration * middle_; }

	/// Takes external forces less those that resist at the end of the step. Returns the forces with which held
	/// nodes have to be held, zero at the others.
	Eigen::VectorXd accelerate(const Eigen::VectorXd& imbalance);

	/// The step has been accepted.
	void commit();

private:
	void begin(const StepContext<Dim>&);
	void findMiddle();
	void meet();
	void findJump();
	void solve(const Eigen::VectorXd& right, const FreeDofs&, Eigen::VectorXd& x, const Eigen::VectorXd* C = nullptr);
	bool isConstrained(Eigen::Index dof) const { return dofs_.number[dof] < 0; }

	Motion<Dim>&                               motion_;
	const OwnedNodes&                          ownedNodes_;
	const MotionOfCopies<Dim>                  copies_;
	const CloudBasis<Dim>&                     basis_;
	const FreeDofs&                            dofs_;
	const std::vector<GhostFace<Dim>>&         faces_;
	double                                     h_; // size of the cells
	double                                     seconds_ = 0;
	NodalMass<Dim>                             mass_;
	std::vector<std::unique_ptr<Damping<Dim>>> damping_;
	bool                                       isSingular_ = false, meets_ = true;
	std::vector<Vec<Dim>>                      atMiddle_;           // velocities of the points
	Eigen::VectorXd                            momentum_;           // momentum of the points, at the nodes, in the middle of the step
	Eigen::VectorXd                            impulse_;            // impulse of contact of bodies with each other, beyond what acts as the step begins
	Eigen::VectorXd                            start_, middle_;     // velocities of the nodes, the former where there is damping
	Eigen::VectorXd                            acceleration_, end_; // at the end, and velocities there
	Eigen::VectorXd                            blow_, jump_;        // impulse of what holds nodes as the step begins, and the velocities that it changes
};

} // namespace gimpm
