// SPDX-License-Identifier: GPL-2.0-or-later
// Report of a load step. Failure is a value.
#pragma once
#include "core/base/failure.hpp"
#include "core/base/types.hpp"
#include "core/solvers/linear_method.hpp"
#include <limits>
#include <string>
#include <vector>

namespace gimpm {

/// Definiteness of a stiffness matrix, as far as its factorisation told: an equilibrium may be unstable where it is not
/// positive definite.
enum class Definiteness { notChecked, positive, indefinite };

struct StepTimes {
	double      basis = 0, ghost = 0, assembly = 0, update = 0; ///< [s]
	SolverTimes linear;
};

struct StepReport {
	Failure             failure = Failure::none;
	std::string         cause;                    ///< one clause for the user, empty when converged
	std::string         advice;                   ///< remedies in sentences, from the term that has refused the step; empty if none has
	bool                accepted         = false; ///< the points took over an iterate that had not converged
	int                 iterations       = 0;     ///< linear solves
	int                 reusedFactors    = 0;     ///< solves with the factor of the solve before
	bool                predicted        = false; ///< Newton's method started from the prediction
	int                 lineSearchTrials = 0;     ///< evaluations of the residual for steps shorter than Newton's
	std::vector<double> residuals;                ///< |residual| / |external forces + reactions| before the first solve and after each
	double              localResidual = std::numeric_limits<double>::quiet_NaN(); ///< largest |residual| / |forces| around a node, or a bound of it
	double              localError    = 0;                                        ///< error of the displacements, over what is admitted; 0: nobody asks
	int                 errorOrder    = 3;                        ///< the power of the length of the step that the largest of them goes with
	Definiteness        definiteness  = Definiteness::notChecked; ///< definiteness of the last symmetric matrix that was factorised
	int                 luSolves      = 0;                        ///< solves for which K was not positive definite, or not symmetric
	IterativeEffort     conjugateGradients;                       ///< or of GMRES; of all attempts at the step
	int                 failedPoint = -1;                         ///< its index in the cloud, for Failure::inverted and noResponse

	int nodes = 0, dofs = 0, populatedCells = 0, boundaryCells = 0, ghostFaces = 0;
	int mixedCells = 0; ///< populated by points of several materials
	int parts      = 0; ///< parts of the body that share no node
	/// In parts of a few points that nothing keeps from moving freely (restraint.hpp), which are held where they
	/// are, and the position of the first part.
	int         loosePoints = 0;
	std::string loosePosition {};
	Vec3        looseForce = Vec3::Zero(); ///< force on them in their positions [N]

	/// Free degree of freedom with the largest out-of-balance force.
	struct {
		Vec3        position = Vec3::Constant(std::numeric_limits<double>::quiet_NaN()); ///< node [m]
		int         axis     = -1;                                                       ///< -1: of another field than the displacements
		double      force    = 0;                                                        ///< [N]
		std::string field {};                                                            ///< the name of another field
	} worst;

	/// For each of Boundary's boxes, the sum of the forces with which it holds its nodes; of a node in several
	/// boxes the last one is given.
	std::vector<Vec3> reactions; ///< [N]

	/// The same of the open boxes: what holds the parts of domains that reach through them [N].
	std::vector<Vec3> openReactions;

	int    clampedDomains     = 0; ///< points whose domain would have outgrown half a cell in this step
	double largestWallOverlap = 0; ///< largest length by which a domain reached behind a wall [m]

	double ghostShare = std::numeric_limits<double>::quiet_NaN(); ///< part of the work of the step (ghostWorkRatio), NaN if it is not known
	int    passes     = 0;                                        ///< in which the stabilisation was relieved (GhostSettings::workTolerance)

	StepTimes times;

	/// Adds the effort of an attempt that failed.
	void takeEffort(const StepReport& attempt)
	{
		iterations       = attempt.iterations;
		reusedFactors    = attempt.reusedFactors;
		lineSearchTrials = attempt.lineSearchTrials;
		luSolves         = attempt.luSolves;
		definiteness     = attempt.definiteness;
		times            = attempt.times;
	}
	bool   converged() const { return failure == Failure::none; }
	double residual() const { return residuals.empty() ? std::numeric_limits<double>::quiet_NaN() : residuals.back(); }
};

} // namespace gimpm
