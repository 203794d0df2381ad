// SPDX-License-Identifier: GPL-2.0-or-later
// First guess of Newton's method: the displacements of the last step, in the ratio of the load increments.
#pragma once
#include "core/grid/grid.hpp"
#include <vector>

namespace gimpm {

/// Nodal displacements of the last converged step.
template <int Dim> struct LastIncrement {
	std::vector<Key> nodes;        ///< sorted
	Eigen::VectorXd  displacement; ///< Dim components a node [m]
	double           load = 0;     ///< growth of the load factor in that step
};

/// Nodal values of `width` components times a factor, at other nodes. A node at which none are known takes the mean of
/// its neighbours that have some, layer by layer.
template <int Dim>
Eigen::VectorXd continued(
        const std::vector<Key>& nodesBefore, const Eigen::VectorXd& before, double times, int width, const std::vector<Key>& nodes, const Grid<Dim>&);

/// Start for a step in which the load factor grows by `load`; empty where the last step says nothing of it: there was
/// none, or its load did not grow in the same direction. As continued().
template <int Dim> Eigen::VectorXd predict(const LastIncrement<Dim>&, const std::vector<Key>& nodes, double load, const Grid<Dim>& = {});

} // namespace gimpm
