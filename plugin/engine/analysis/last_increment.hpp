// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// A scene that is saved carries the last increment along, so that it continues with the same bits: of each node the
// grid coordinates, in cells of MpmGrid.cellSize, and the displacement, three numbers each. Nodes that the grid does
// not have are left out: its refinements may have changed.
#include "core/stepping/predictor.hpp"
#include "yade_api/types.hpp"
#include <optional>

namespace yade {

// The node at a place, three numbers; none if the grid has none there, or one that is tied. All others are of the level
// of the largest cell around them.
template <int Dim> std::optional<gimpm::Key> nodeAt(const Real* place, const gimpm::Grid<Dim>&);
template <int Dim> void                      putPlace(gimpm::Key node, const gimpm::Grid<Dim>&, Real* place);

bool isIncrement(const vector<Real>& numbers);

template <int Dim> gimpm::LastIncrement<Dim> fromNumbers(const vector<Real>& numbers, Real load, const gimpm::Grid<Dim>&);
template <int Dim> vector<Real>              toNumbers(const gimpm::LastIncrement<Dim>&, const gimpm::Grid<Dim>&);

} // namespace yade
