// SPDX-License-Identifier: GPL-2.0-or-later
// Master nodes of a refined grid.
#pragma once
#include "core/grid/refinement.hpp"
#include <map>

namespace gimpm {

/// Weights by master.
using Masters = std::map<Key, double>;

/// Masters of a node, in its layer; a node that is not tied is its only one. A node is tied to the corners of the
/// largest leaf that touches it, and these in turn to theirs.
template <int Dim> Masters mastersIn(const Refinement<Dim>&, Key node);

} // namespace gimpm
