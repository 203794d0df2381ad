// SPDX-License-Identifier: GPL-2.0-or-later
// Motion of points, and the common part of the schemes in time: masses, momenta, and blows of constrained nodes.
#pragma once
#include "core/solvers/linear_solver.hpp"
#include "core/terms/inertia/damping.hpp"
#include "core/terms/inertia/mass_matrix.hpp"
#include "core/terms/inertia/time_scheme.hpp"

namespace gimpm {

template <int Dim> struct ContactSystem;
template <int Dim> struct BodyContacts;

/// Constrained nodes that move by a history.
template <int Dim> struct MovingBase {
	ConstrainedBox<Dim> box;
	Vec<Dim>            velocity;     ///< velocity as the step begins [m/s]
	Vec<Dim>            acceleration; ///< mean of the step [m/s2]
};

/// Motion of the points of a cloud, in its order, and the time scheme of the next step.
template <int Dim> struct Motion {
	TimeScheme                scheme;
	double                    ghostMass = 1e-3;     ///< gamma_M over the density
	double                    duration  = 0;        ///< duration of the step, > 0 [s]
	double                    tolerance = infinite; ///< on the local error of the displacements, not with TimeScheme::midpoint() [m]
	std::vector<double>       mass {};              ///< mass of each point [kg]
	std::vector<Vec<Dim>>     velocity {};          ///< [m/s]
	std::vector<Vec<Dim>>     acceleration {};      ///< [m/s2], a result; all zero: the motion begins
	double                    ghostWork   = 0;      ///< work that ghost stabilisation has taken in the last step that was accepted [J]
	double                    impactWork  = 0; ///< work that constrained nodes have taken in it by their blow, beyond what they have worked with it [J]
	int                       loosePoints = 0; ///< in cells whose points do not tell the velocities of their nodes, as that step began
	double                    gridWork  = 0; ///< work of the forces that are out of balance with the accelerations of the points as the last step began [J]
	double                    exactness = 1e-13;          ///< tolerance of velocities and accelerations of the nodes, over the momenta of the points
	Eigen::VectorXd           growth {};                  ///< growth of velocities of the nodes in the last step that was accepted [m/s]
	const ContactSystem<Dim>* contacts         = nullptr; ///< if there are some, of TimeScheme::weightOfContact()
	const BodyContacts<Dim>*  bodies           = nullptr; ///< contacts of bodies of points with each other, the same
	LinearSolver              solvers[Dim + 1] = {};      ///< solvers by axis, and of all nodes; keep their symbolic analyses

	std::vector<char>               isElastic {}; ///< flag of each material: nothing flows; empty: of none
	std::vector<DampingOfStep<Dim>> damping {};   ///< in each step
	std::vector<MovingBase<Dim>>    bases {};     ///< last one counts for nodes in several boxes

	static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// Motion of the copies of others' points, behind the own ones, as long as this lives.
template <int Dim> class MotionOfCopies {
public:
	MotionOfCopies(Motion<Dim>&, const Division&);
	~MotionOfCopies();
	MotionOfCopies(const MotionOfCopies&)            = delete;
	MotionOfCopies& operator=(const MotionOfCopies&) = delete;

private:
	Motion<Dim>&      motion_;
	const std::size_t own_;
};

/// True if no point moves with an acceleration, wherever it is.
template <int Dim> bool begins(const Motion<Dim>&, const Division&);

/// Faces with gamma_M h^3 / 3 for their stiffness, gamma_M by the density of the lighter of the two cells.
template <int Dim> std::vector<GhostFace<Dim>> massFaces(const Motion<Dim>&, const StepContext<Dim>&);

/// None without ghost mass: then nothing is connected, and mass is that of the points alone.
template <int Dim> std::vector<LooseCell<Dim>> looseOf(const Motion<Dim>&, const StepContext<Dim>&, int reach = Dim);

/// The points in them, of all processes.
template <int Dim> int countOfPoints(const std::vector<LooseCell<Dim>>&, const StepContext<Dim>&);

/// Extent that the points in loose cells add to the inertia of their centres, as the mass of these cells that resists
/// accelerations, while it is not remembered: for laws that flow.
template <int Dim> std::vector<LooseCell<Dim>> extentOf(const std::vector<LooseCell<Dim>>&, const Motion<Dim>&, const StepContext<Dim>&);

/// Loose cells that nodal velocities would tear within the step, with the nodes that are free along the axis of the
/// gap, -1 for the others: there they move apart by more than the size of the cell. Points that pass each other
/// determine such a field, whose gradient has no bound as the way between them has none.
template <int Dim>
std::vector<LooseCell<Dim>> tornOf(const std::vector<LooseCell<Dim>>& loose, const Eigen::VectorXd& velocity, const Motion<Dim>&, const StepContext<Dim>&);

/// (M + M_g) of all points, with those of loose cells, and of torn ones what the extent of points has that fill half a
/// cell: else what nodes make of their velocities would be given to the points as energy.
template <int Dim>
MassMatrix<Dim> massMatrix(const Motion<Dim>&, const StepContext<Dim>&, const std::vector<LooseCell<Dim>>& loose, const std::vector<LooseCell<Dim>>& torn = {});

/// Sum of S m x_p at the nodes; `share`: those around which this process knows all points.
template <int Dim>
Eigen::VectorXd weighedAtNodes(const CloudBasis<Dim>&, const std::vector<double>& mass, const std::vector<Vec<Dim>>& ofPoints, const OwnedNodes& ownedNodes);

template <int Dim> using OfBase = Vec<Dim> MovingBase<Dim>::*;

/// A value of the constrained degrees of freedom.
template <int Dim> Eigen::VectorXd ofHeld(const Eigen::VectorXd& otherwise, OfBase<Dim> value, const std::vector<MovingBase<Dim>>&, const StepContext<Dim>&);

/// The impulse by which constrained nodes get `velocity`, where that is more than round-off, of the largest momentum.
template <class Mass, class IsConstrained>
Eigen::VectorXd blowOf(const Mass& M, const Eigen::VectorXd& velocity, const Eigen::VectorXd& momentum, double roundOff, IsConstrained&& isConstrained)
{
	Eigen::VectorXd blow  = M * velocity - momentum;
	const double    least = roundOff * momentum.template lpNorm<Eigen::Infinity>();
	for (Eigen::Index i = 0; i < blow.size(); ++i)
		if (!isConstrained(i) || std::abs(blow[i]) <= least) blow[i] = 0;
	return blow;
}

/// Kinetic energy of the nodes before a blow, p v / 2 with M v = p, less that of `velocity` after it, and with the work
/// of what holds them, whose velocity is `held`. `jump`: M^-1 `blow`.
template <class Mass>
double energyOfBlow(const Mass& M, const Eigen::VectorXd& velocity, const Eigen::VectorXd& blow, const Eigen::VectorXd& jump, const Eigen::VectorXd& held)
{
	if (blow.isZero(0)) return 0;
	return blow.dot(held) - jump.dot(M * velocity - blow / 2);
}

} // namespace gimpm
