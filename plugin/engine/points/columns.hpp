// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The table of what there is to know of a material point, in numbers: whatever reads, writes, shows or stores all
// points reads this.
#include "engine/points/MaterialPoints.hpp"
#include <functional>

namespace yade {

struct PointColumn {
	enum Use : unsigned {
		inArrays = 1,   // columns of mpm.arrays
		inVtk    = 2,   // field of the domains that MpmVtkRecorder writes
		ofMotion = 8,   // only where a point moves is it a field
		ofWater  = 16,  // only where there is water
		ofSplits = 32,  // only where a point has been split
		ofPores  = 64,  // only where water has a pressure in excess
		ofFlow   = 128, // only where it flows
		ofBodies = 256, // only where bodies of points have names
		ofAir    = 512, // only where pores need not be full
		derived  = 4,   // follows from others: in pictures and tables beside those of mpm.arrays
	};

	string   name, unit, label; // the label names it in pictures
	int      width;             // numbers of a point: 1, 3 of a vector, 9 of a tensor row by row
	bool     isInteger;
	unsigned uses;

	// Row by row, of points from the first one to before the last.
	std::function<void(const MaterialPoint* first, const MaterialPoint* last, const Scene&, Real*)> get;

	std::function<void(const MaterialPoint&, const Real*)> set; // none: a result

	const gimpm::InternalVariable* variable    = nullptr; // variable of laws; null: every point has it
	bool                           isParameter = false;   // parameter of laws: present if a point has its own

	bool is(Use use) const { return uses & use; }
};

// In the order of mpm.arrays.
const vector<PointColumn>& pointColumns();

// Those that one of the points has. The plastic strain is an attribute of all.
vector<const PointColumn*> columnsOf(const vector<MaterialPoint>&);

// A column, and room for its rows.
struct ColumnRows {
	const PointColumn* column;
	Real*              to;
};

// Fills columns of all points.
void fillRows(const vector<ColumnRows>&, const vector<MaterialPoint>&, const Scene&);

// Null: there is no such column.
const PointColumn* findColumn(const string& name);

// For Python: dicts with name, unit, label, width, isInteger, isGiven (to points, by mpm.assign), derived, isInternal
// (a variable of laws) and isParameter (of laws).
py::list pointColumnsForPython();

} // namespace yade
