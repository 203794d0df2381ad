// SPDX-License-Identifier: GPL-2.0-or-later
// L S L^T of a symmetric matrix, where S has a sign for each row, and L S U of one that has only its pattern symmetric,
// in the pattern that CHOLMOD finds for Cholesky's method.
#pragma once
#include "core/solvers/csc.hpp"
#include <cholmod.h>
#include <vector>

namespace gimpm {

/// Destinations of entries of a matrix among the values of a supernodal factor of its pattern, supernode by supernode.
struct EntryDestinations {
	/// Part of a matrix: its upper triangle, or what of an unsymmetric one is below the diagonal of the factor,
	/// with it, or above, transposed.
	enum class Part { triangle, below, above };
	struct Entry {
		int number, slot; ///< in the matrix, and from the first value of its supernode
	};
	std::vector<Entry> entries;
	std::vector<int>   start;               ///< those of supernode s: start[s] ... start[s + 1] - 1
	bool               areInPattern = true; ///< not if an entry of a general matrix lacks the one across the diagonal

	EntryDestinations() = default;
	EntryDestinations(const cholmod_factor&, const Csc& K, Part);
};

/// Supernode by supernode, from the left, without pivoting: that is stable where one field is stiff and the other one
/// soft (quasi-definite matrices: Vanderbei 1995), as with displacements and pressures that are stabilised; who solves
/// with it has to look at the residual. The values of the factor are written, and the signs in its order. False if a
/// pivot is smaller than a part `smallest` of the largest one.
bool factoriseSigned(cholmod_factor&, const EntryDestinations&, const std::vector<double>& values, double smallest, Eigen::VectorXd& signs);

/// The same of a matrix that is not symmetric: L and U^T have the same diagonal, whose squares are the sizes of the
/// pivots, and the same pattern. The values of U^T go to `upper`.
bool factoriseSigned(
        cholmod_factor&, std::vector<double>& upper, const EntryDestinations& below, const EntryDestinations& above, const std::vector<double>& values,
        double smallest, Eigen::VectorXd& signs);

} // namespace gimpm
