// SPDX-License-Identifier: GPL-2.0-or-later
// When a solver gives up, or begins anew: of one process and of several.
#pragma once

namespace gimpm {

/// A pivot that is left of a row's diagonal of about one. Below it, round-off of the rows before is what it consists
/// of.
constexpr double smallestPivot = 1e-12;

/// Iterations with the diagonal that an attempt is worth. To set up multigrid and solve with it takes as long as some
/// 300 of them.
constexpr int patience = 300;

/// Iterations with the diagonal after which the residual of the system must have fallen.
constexpr int firstTrial = 100;

/// Iterations with multigrid, which take as long as what the diagonal is given.
constexpr int mostWithMultigrid = 250;

/// Iterations over those of the first solve with which multigrid is given up at once, and with which it is renewed for
/// the next solve.
constexpr double tooMany = 2, worthRenewing = 1.5;

constexpr int few = 5; ///< iterations which say nothing

} // namespace gimpm
