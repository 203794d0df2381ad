// SPDX-License-Identifier: GPL-2.0-or-later
// Input of a load step besides the points.
#pragma once
#include "core/grid/basis.hpp"
#include "core/grid/boundary.hpp"
#include "core/grid/domain.hpp"
#include "core/materials/material.hpp"
#include "core/parallel/division.hpp"
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/load_curve.hpp"
#include "core/terms/coupled_term.hpp"
#include "core/terms/ghost.hpp"
#include "core/terms/wall.hpp"
#include <functional>
#include <map>
#include <optional>

namespace gimpm {

struct GhostSettings {
	double       factor  = 1e-2; ///< gamma_k over the modulus; 0: plain GIMPM, no faces are looked for
	GhostScaling scaling = GhostScaling::meshIndependent;
	/// Part of the last step's displacements, in the ratio of the loads, of which jumps of the gradient cost
	/// nothing.
	double memory = 0;
	/// Filled part of a cell below which it is ill-filled: then it is tied to others, and other faces keep
	/// `elsewhere` of their stiffness (core/terms/aggregates.hpp). 0: all faces alike.
	double threshold = 0;
	/// Part of the work of a static step (ghostWorkRatio) that it may take up. Where it is more, jumps of the
	/// gradient that have been reached cost nothing, and the step goes on from there; and so on, until stress in
	/// the points bears the rest. 1: no limit.
	double workTolerance = 1;

	/// Holds what no stress holds, as points at the apex of their yield surface in well-filled cells.
	static constexpr double elsewhere = 1e-2;
};

struct NewtonSettings {
	/// On |residual| / |external forces + reactions|; three times it around each node.
	double       tolerance         = 1e-6;
	int          maxIterations     = 20;    ///< linear solves
	int          lineSearchTrials  = 5;     ///< shorter steps tried when a full one does not reduce the residual; 0: none
	bool         acceptUnconverged = false; ///< take over the last iterate after maxIterations
	LinearMethod linearSolver      = LinearMethod::automatic;
	/// Reuse of the factor of the last solve, where the convergence history says that it suffices.
	bool reuseFactor = true;
	/// Solves of a step that may take the factor of an earlier step, by the modified Newton method; 0: none.
	int keepFactor = 0;
	/// Asked once per iteration; may be empty.
	std::function<bool()> interrupted;
	/// On rateChange() of a step without inertia that has a prediction [m].
	double stepTolerance = std::numeric_limits<double>::infinity();
};

/// Actions of a condition that remembers its distance from the points, where a study makes all moduli larger and leaves
/// the points in their positions.
template <int Dim> struct InPlace {
	/// Begins a study: what has given way elastically is `scale` of what it was.
	std::function<void(const PointCloud<Dim>&, double scale)> begin;
	/// After a step, the points are back where they were.
	std::function<void(const PointCloud<Dim>&)> goOn;
};

template <int Dim> class Inertia;

/// Makes inertia for a step, in which it is the last of the terms.
template <int Dim> using InertiaOfStep = std::function<std::unique_ptr<Inertia<Dim>>(const StepContext<Dim>&)>;

template <int Dim> struct Model {
	Grid<Dim>  grid;
	Basis      basis   = Basis::gimp;
	DomainRule domains = DomainRule::tiling;
	/// Against volumetric locking; needs the ghost stabilisation, which holds the nodes of nearly empty cells.
	bool fBar = false;
	/// Pressure filter with F-bar: pressures of points in a cell that differ without any effect are removed as the
	/// points move.
	bool                  pressureRelaxation = false;
	std::vector<Material> materials;
	/// Part of point loads and water that acts in a stage of construction, by material, as for the density; empty:
	/// all.
	std::vector<double> shares {};
	/// Layer of nodes (Grid::layer) of each body, by its number, from -1 on, which is that of those without a name;
	/// empty: all are in one.
	std::vector<int> layers {};
	Boundary<Dim>    boundary; ///< the last box is that of the axis of symmetry, if there is one
	/// Off the lines of the grid, by the box of the boundary that their reaction is reported with, which holds
	/// nothing; moved in each step that is accepted.
	std::map<int, std::shared_ptr<Wall<Dim>>> walls {};
	GhostSettings                             ghost;
	NewtonSettings                            newton;
	/// Besides the points' resistance and the ghost stabilisation.
	std::vector<TermOfStep<Dim>> terms {};
	/// Besides the displacements.
	InertiaOfStep<Dim>           inertia {}; ///< inertia of time steps; null: steps without
	std::vector<NodalField<Dim>> fields {};
	/// Terms of all fields, and of nodes that are apart.
	std::vector<CoupledTermOfStep<Dim>> coupledTerms {};
	/// Pressures of water that flows in the soil (StepContext::water), at the nodes of a step. `field`: theirs;
	/// null where they stay as they are. Empty: none flows.
	std::function<Eigen::VectorXd(const CloudBasis<Dim>&, const Eigen::VectorXd* field)> water {};
	/// Makes fields stay as they are at the moment, for a study of it; empty: there are none but the displacements.
	std::function<void(Model&)> freeze {};
	/// Actions of those of the terms that need them.
	std::vector<InPlace<Dim>> inPlace {};
	/// The points' resistance is that after half of the displacements.
	bool atMiddle = false;
	/// Processes that work on it together.
	std::shared_ptr<const Processes> processes = Processes::alone();
	/// Division of the points among them; whole where all have the same points.
	std::shared_ptr<Division> division = std::make_shared<Division>();
};

template <int Dim> struct Load {
	Vec<Dim>                  gravity = Vec<Dim>::Zero(); ///< at factor 1 [m/s2]
	LoadFactor                factor {};                  ///< factor of point loads, and of prescribed displacements, which go with its growth
	std::optional<LoadFactor> ofGravity {};               ///< if it has its own
	std::map<int, LoadFactor> ofBoxes {};                 ///< factors of the displacement of boxes of the boundary with their own
	double                    motion   = 0;               ///< duration of the step where something moves by its velocity [s]
	double                    duration = 0;               ///< duration of the step, for laws that depend on it, in the time of the loads
	std::map<int, Vec<Dim>>   boxMotion {}; ///< motion of the nodes constrained by boxes of the boundary, in the step, besides their displacement [m]

	LoadFactor ofBox(int number) const
	{
		const auto own = ofBoxes.find(number);
		return own == ofBoxes.end() ? factor : own->second;
	}

	/// The same as the step begins.
	Load before() const
	{
		const auto factorBefore = [](const LoadFactor& f) { return LoadFactor { f.before(), 0 }; };
		Load       load { gravity, factorBefore(factor) };
		if (ofGravity) load.ofGravity = factorBefore(*ofGravity);
		return load;
	}

	/// Quantity that the displacements of the step are proportional to, as far as that can be known.
	double growth() const
	{
		const double ofLoads = factor.growth != 0 ? factor.growth : ofGravity.value_or(factor).growth;
		if (ofLoads != 0) return ofLoads;
		for (const auto& [number, own] : ofBoxes)
			if (own.growth != 0) return own.growth;
		return motion;
	}
};

} // namespace gimpm
