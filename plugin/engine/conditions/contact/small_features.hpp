// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Features of rigid bodies that are too small for the cells of the grid.
#include "core/terms/contact/contact_system.hpp"
#include "yade_api/types.hpp"

namespace yade {

// About the first body that touches the soil by what is smaller than a cell: a thin one, a small ball, an edge or a tip
// of which less is in the soil. Names the body, the cells that would do, and what keeps a thin one from parting the
// soil; empty if there is none.
template <int Dim> string warningOfSmallFeatures(const gimpm::ContactSystem<Dim>&, Real cellSize, const string& inItsWay);

} // namespace yade
