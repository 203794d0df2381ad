// SPDX-License-Identifier: GPL-2.0-or-later
// What a load step is given besides the points.
#pragma once
#include "core/base/processes.hpp"
#include "core/grid/basis.hpp"
#include "core/grid/boundary.hpp"
#include "core/grid/division.hpp"
#include "core/materials/law.hpp"
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
};

struct NewtonSettings {
	double                tolerance         = 1e-6;  ///< on |residual| / |external forces + reactions|; three times it around each node
	int                   maxIterations     = 20;    ///< linear solves
	int                   lineSearchTrials  = 5;     ///< shorter steps tried when a full one does not reduce the residual; 0: none
	bool                  acceptUnconverged = false; ///< take over the last iterate after maxIterations
	LinearMethod          linearSolver      = LinearMethod::automatic;
	bool                  reuseFactor       = true; ///< of the last solve, where the convergence history says that it suffices
	std::function<bool()> interrupted;              ///< asked once per iteration; may be empty
	double                stepTolerance = std::numeric_limits<double>::infinity(); ///< on rateChange() of a step without inertia that has a prediction [m]
};

/// What a condition that remembers its distance from the points has to do where a study makes all moduli larger and leaves the points in their places.
template <int Dim> struct InPlace {
	std::function<void(const PointCloud<Dim>&, double scale)> begin; ///< what has given way elastically is `scale` of what it was
	std::function<void(const PointCloud<Dim>&)>               goOn;  ///< after a step, the points are back where they were
};

template <int Dim> class Inertia;

/// Makes inertia for a step, in which it is the last of the terms.
template <int Dim> using InertiaOfStep = std::function<std::unique_ptr<Inertia<Dim>>(const Beginning<Dim>&)>;

template <int Dim> struct Model {
	Grid<Dim>             grid;
	Basis                 basis = Basis::gimp;
	bool                  fBar  = false; ///< against volumetric locking; needs the ghost stabilisation, which holds the nodes of nearly empty cells
	std::vector<Material> materials;
	std::vector<double> shares {}; ///< by material, of what acts of point loads and water in a stage of construction, as it does of the density; empty: all
	Boundary<Dim>       boundary;  ///< the last box is that of the axis of symmetry, if there is one
	/// Off the lines of the grid, by the box of the boundary that their reaction is reported with, which holds nothing; moved in each step that is accepted.
	std::map<int, std::shared_ptr<Wall<Dim>>> walls {};
	GhostSettings                             ghost;
	NewtonSettings                            newton;
	std::vector<TermOfStep<Dim>>              terms {};         ///< besides the points' resistance and the ghost stabilisation
	InertiaOfStep<Dim>                        inertia {};       ///< of steps in time; null: those without
	std::vector<NodalField<Dim>>              fields {};        ///< besides the displacements
	std::vector<CoupledTermOfStep<Dim>>       coupledTerms {};  ///< of all fields, and of nodes that are apart
	std::vector<InPlace<Dim>>                 inPlace {};       ///< of those of the terms that need it
	bool                                      atMiddle = false; ///< the points' resistance is that after half of the displacements
	std::shared_ptr<const Processes>          processes {};     ///< that work on it together; null: this one alone
	std::shared_ptr<Division>                 division {};      ///< of the points among them; null: all have the same points
};

template <int Dim> struct Load {
	Vec<Dim>                  gravity = Vec<Dim>::Zero(); ///< at factor 1 [m/s2]
	LoadFactor                factor {};                  ///< of point loads, and of prescribed displacements, which go with its growth
	std::optional<LoadFactor> ofGravity {};               ///< if it has its own
	std::map<int, LoadFactor> ofBoxes {};                 ///< of the displacement of boxes of the boundary that have their own
	double                    motion = 0;                 ///< duration of the step where something moves by its velocity [s]
	std::map<int, Vec<Dim>>   boxMotion {};               ///< of the nodes held by boxes of the boundary, in the step, besides their displacement [m]

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

	/// What the displacements of the step are in proportion to, as far as that can be known.
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
