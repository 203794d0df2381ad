// SPDX-License-Identifier: GPL-2.0-or-later
// L S L^T of a symmetric matrix, where S has a sign for each row, in the pattern that CHOLMOD finds for Cholesky's
// method.
#pragma once
#include "core/solvers/csc.hpp"
#include <cholmod.h>
#include <cstddef>

namespace gimpm {

/// Where each entry of an upper triangle goes among the values of a supernodal factor of its pattern.
std::vector<std::ptrdiff_t> placesIn(const cholmod_factor&, const Csc& K);

/// Supernode by supernode, from the left, without pivoting: that is stable where one field is stiff and the other one
/// soft (quasi-definite matrices: Vanderbei 1995), as with displacements and pressures that are stabilised; who solves
/// with it has to look at the residual. The values of the factor are written, and the signs in its order. False if a
/// pivot is smaller than a part `smallest` of the largest one.
bool factoriseSigned(cholmod_factor&, const std::vector<std::ptrdiff_t>& places, const std::vector<double>& values, double smallest, Eigen::VectorXd& signs);

} // namespace gimpm
