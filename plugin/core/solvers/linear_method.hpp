// SPDX-License-Identifier: GPL-2.0-or-later
// Method for solving a linear system, and its effort.
#pragma once
#include <string>

namespace gimpm {

/// `automatic`: iterative where a factor would take much longer, and with multigrid where that takes too many
/// iterations. `multigrid` is the same from the first iteration on.
enum class LinearMethod { automatic, direct, iterative, multigrid };

/// Method of a solve. `lu`: by pivots (L U or L D L^T), as K is not positive definite, or not symmetric.
enum class SolverStatus { cholesky, lu, singular, iterative };

struct SolverTimes {
	double analyse = 0, factorise = 0, solve = 0; ///< [s]; to set up multigrid takes the place of a factorisation
};

struct IterativeEffort {
	int         iterations  = 0; ///< iterations of conjugate gradients or GMRES
	int         hierarchies = 0; ///< hierarchies that multigrid has set up
	int         fallbacks   = 0; ///< solves that they left to the direct solver
	std::string reason {};       ///< reason of the last fallback, or why multigrid was not set up
};

} // namespace gimpm
