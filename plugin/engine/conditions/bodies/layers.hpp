// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies of points that have nodes of their own: those in contact, and those that a condition names.
#include "engine/analysis/analysis.hpp"

namespace yade {

// Layers of bodies by their number, from -1 on, which is that of points without a name; empty: no contact between
// bodies, and all share their nodes. A body is in the lowest layer without a body that it is in contact with, so that
// those that goes together, and one that a condition names is in a layer alone.
vector<int> bodyLayers(const Analysis&);

// Layer of a body by its name; -1 for no name: of all.
int layerOf(const Analysis&, const string& body);

// std::invalid_argument for a name, in the settings of `name`, which is not that of a body with nodes of its own; an
// empty one is admitted.
void requireOwnNodes(const Analysis&, const string& body, const string& name);

// The names of bodies of points that there are, for messages.
string bodiesThereAre(const MpmGrid&);

// True if there is an MpmBodyContact between two bodies; -1: points of no body.
bool meet(const Analysis&, int one, int other);

} // namespace yade
