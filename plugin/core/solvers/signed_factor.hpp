// SPDX-License-Identifier: GPL-2.0-or-later
// L S L^T of a symmetric matrix, where S has a sign for each row, in the pattern that CHOLMOD finds for Cholesky's
// method.
#pragma once
#include "core/solvers/csc.hpp"
#include <cholmod.h>
#include <vector>

namespace gimpm {

/// Where the entries of an upper triangle go among the values of a supernodal factor of its pattern, supernode by
/// supernode.
struct PlacedEntries {
	struct Entry {
		int number, place; ///< in the matrix, and from the first value of its supernode
	};
	std::vector<Entry> entries;
	std::vector<int>   start; ///< those of supernode s: start[s] ... start[s + 1] - 1

	PlacedEntries() = default;
	PlacedEntries(const cholmod_factor&, const Csc& K);
};

/// Supernode by supernode, from the left, without pivoting: that is stable where one field is stiff and the other one
/// soft (quasi-definite matrices: Vanderbei 1995), as with displacements and pressures that are stabilised; who solves
/// with it has to look at the residual. The values of the factor are written, and the signs in its order. False if a
/// pivot is smaller than a part `smallest` of the largest one.
bool factoriseSigned(cholmod_factor&, const PlacedEntries&, const std::vector<double>& values, double smallest, Eigen::VectorXd& signs);

} // namespace gimpm
