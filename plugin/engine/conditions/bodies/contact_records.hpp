// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Pairs of bodies that an MpmBodyContact acts between, and the stresses that it keeps for each.
#include "engine/conditions/bodies/MpmBodyContact.hpp"
#include "engine/grid/MpmGrid.hpp"

namespace yade {

// Stresses on the pieces of the slave's surface.
struct ContactRecord {
	int              slave, master; // numbers in MpmGrid.bodies
	vector<Real>     pressures {};
	vector<Vector3r> shears {};
};

// Numbers of a body by its name, and of the parts that have come off it.
vector<int> partsOf(const MpmGrid&, const string& body);

// Pairs of bodies that a contact acts between, the first one of a body of `between[0]`: of contact of a body with
// itself, all pairs of its parts, and with `folds` each part and itself.
vector<std::pair<int, int>> pairsOf(const MpmBodyContact&, const MpmGrid&);

// Stresses that a contact has kept.
vector<ContactRecord> recordsOf(const MpmBodyContact&, const MpmGrid&);
void                  keepRecords(MpmBodyContact&, const MpmGrid&, const vector<ContactRecord>&);

} // namespace yade
