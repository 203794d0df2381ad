// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/output_columns.hpp"

namespace yade {
class Analysis;
class MpmContact;

// The faces of the bodies near the soil that they touched in the last load step: the part of the surface of each place,
// with what acts there. Of surfaces with two sides only what has soil in front of it.
template <int Dim> void drawFaces(Picture&, const MpmContact&, const Analysis&);

} // namespace yade
