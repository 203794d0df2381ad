// SPDX-License-Identifier: GPL-2.0-or-later
// Inertia: the step as one in time.
#pragma once
#include "core/solvers/linear_solver.hpp"
#include "core/terms/contact.hpp"
#include "core/terms/damping.hpp"
#include "core/terms/mass_matrix.hpp"
#include "core/terms/term.hpp"
#include "core/terms/time_scheme.hpp"

namespace gimpm {

/// Held nodes that move by a history.
template <int Dim> struct MovingBase {
	HeldBox<Dim> box;
	Vec<Dim>     velocity;     ///< as the step begins [m/s]
	Vec<Dim>     acceleration; ///< mean of the step [m/s2]
};

/// How the points of a cloud move, in its order, and how the next step advances that.
template <int Dim> struct Motion {
	TimeScheme                scheme;
	double                    ghostMass = 1e-3;     ///< gamma_M over the density
	double                    duration  = 0;        ///< of the step, > 0 [s]
	double                    tolerance = infinite; ///< on the local error of the displacements, not with TimeScheme::midpoint() [m]
	std::vector<double>       mass {};              ///< of each point [kg]
	std::vector<Vec<Dim>>     velocity {};          ///< [m/s]
	std::vector<Vec<Dim>>     acceleration {};      ///< [m/s2], a result; all zero: the motion begins
	double                    ghostWork  = 0;       ///< that ghost stabilisation has taken in the last step that was accepted [J]
	double                    impactWork = 0;       ///< that held nodes have taken in it by their blow, beyond what they have worked with it [J]
	double                    gridWork   = 0; ///< of the forces that are out of balance with the accelerations of the points as the last step began [J]
	const ContactSystem<Dim>* contacts   = nullptr;  ///< if there are some, of TimeScheme::weightOfContact()
	LinearSolver              solvers[Dim + 1] = {}; ///< by axis, and of all nodes; keep their symbolic analyses

	std::vector<DampingOfStep<Dim>> damping {}; ///< in each step
	std::vector<MovingBase<Dim>>    bases {};   ///< of nodes in several boxes the last one counts

	static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// Faces with gamma_M h^3 / 3 for their stiffness, gamma_M by the density of the lighter of the two cells.
template <int Dim> std::vector<GhostFace<Dim>> massFaces(const Motion<Dim>&, const Beginning<Dim>&);

/// None without ghost mass: then nothing is connected, and mass is that of the points alone.
template <int Dim> std::vector<LooseCell<Dim>> looseOf(const Motion<Dim>&, const Beginning<Dim>&, int reach = Dim);

/// Sum of S m x_p at the nodes.
template <int Dim> Eigen::VectorXd weighedAtNodes(const CloudBasis<Dim>&, const std::vector<double>& mass, const std::vector<Vec<Dim>>& ofPoints);

template <int Dim> using OfBase = Vec<Dim> MovingBase<Dim>::*;

/// A value of the held degrees of freedom.
template <int Dim> Eigen::VectorXd ofHeld(const Eigen::VectorXd& otherwise, OfBase<Dim> value, const std::vector<MovingBase<Dim>>&, const Beginning<Dim>&);

/// The impulse by which held nodes get `velocity`, where that is more than round-off, of the largest momentum.
template <class Mass, class IsHeld>
Eigen::VectorXd blowOf(const Mass& M, const Eigen::VectorXd& velocity, const Eigen::VectorXd& momentum, double roundOff, IsHeld&& isHeld)
{
	Eigen::VectorXd blow  = M * velocity - momentum;
	const double    least = roundOff * momentum.template lpNorm<Eigen::Infinity>();
	for (Eigen::Index i = 0; i < blow.size(); ++i)
		if (!isHeld(i) || std::abs(blow[i]) <= least) blow[i] = 0;
	return blow;
}

/// Kinetic energy of the nodes before a blow, p v / 2 with M v = p, less that of `velocity` after it, and with the work of what holds them, whose velocity is `held`.
/// `jump`: M^-1 `blow`.
template <class Mass>
double energyOfBlow(const Mass& M, const Eigen::VectorXd& velocity, const Eigen::VectorXd& blow, const Eigen::VectorXd& jump, const Eigen::VectorXd& held)
{
	if (blow.isZero(0)) return 0;
	return blow.dot(held) - jump.dot(M * velocity - blow / 2);
}

/// Consistent mass times acceleration, and damping. Points give momentum to the nodes, which have the velocities v of (M + M_g) v = sum of S m v_p, held ones those that
/// the step prescribes, by a blow where points have brought others along; points take back what changes of them (FLIP). Every other force is that at the end of the step. Where
/// the scheme weighs it with that of the beginning the whole balance is divided by its weight: so other terms are as in a step without inertia.
template <int Dim> class Inertia : public Term<Dim> {
public:
	/// To be made after all other terms. Velocities and accelerations are written in commit().
	Inertia(Motion<Dim>&, const Beginning<Dim>&);

	void                        mark(NodeMatrix<Dim>& K) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const TermSum<Dim>&) const override;
	void                        addBefore(Eigen::VectorXd&) const override { }
	bool                        isSymmetric() const override;
	std::string                 obstacle() const override;
	bool                        isSingular() const override { return isSingular_; }
	double                      fromOutside(const Eigen::VectorXd& d) const override;
	void                        addRoundOff(const Eigen::VectorXd& d, Eigen::VectorXd& sizes) const override;
	Eigen::VectorXd             ownMotion() const override;
	void                        restrain(const typename Term<Dim>::Hold&) const override;
	LocalError                  localError(const Eigen::VectorXd& d) const override;
	void                        commit(const Eigen::VectorXd& d) override;

private:
	Eigen::VectorXd solve(const Eigen::VectorXd& momentum, const Eigen::VectorXd& ofHeld);
	Eigen::VectorXd imbalanceOf(const Beginning<Dim>&) const;
	Eigen::VectorXd velocityAt(const Eigen::VectorXd& d) const;
	void            solve(int axis, int solver, const FreeDofs&, const Eigen::VectorXd& right, Eigen::VectorXd& x);
	void            findVelocity(const Eigen::VectorXd& ofHeld);
	void            findAcceleration(const Beginning<Dim>&, const Eigen::VectorXd& ofHeld);
	Eigen::VectorXd ofContact(const Eigen::VectorXd* d) const; // on the nodes; null: as the step begins
	Eigen::VectorXd accelerationAt(const Eigen::VectorXd& d) const;
	bool            isHeld(Eigen::Index dof) const { return dofs_.number[dof] < 0; }

	Motion<Dim>&                               motion_;
	const CloudBasis<Dim>&                     basis_;
	const FreeDofs&                            dofs_;
	const Eigen::VectorXd&                     prescribed_;
	const std::vector<GhostFace<Dim>>&         faces_;
	double                                     h_; // size of the cells
	MassMatrix<Dim>                            mass_;
	std::vector<std::unique_ptr<Damping<Dim>>> damping_;
	bool                                       isSingular_ = false;
	std::array<bool, Dim + 1>                  factorised_ {};           // of the solvers of the motion, in this step
	Eigen::VectorXd                            imbalance_;               // at the start, without contact, where the scheme asks for it; zero at held nodes
	Eigen::VectorXd                            neglected_;               // forces at the start beyond those of acceleration_; zero at held nodes
	Eigen::VectorXd                            velocity_, acceleration_; // at the start, without what contact does to the latter
	Eigen::VectorXd                            expected_;                // acceleration, with contact
	Eigen::VectorXd                            blow_, jump_; // impulse of what holds nodes as the step begins, and the velocities that it changes
};

} // namespace gimpm
