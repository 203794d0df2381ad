// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Beams between two waters: the pressure of a function jumps there.
#include "core/grid/grid.hpp"
#include "engine/conditions/structures/MpmBeam.hpp"

namespace yade {

// A beam, and where a function is asked for the pressure on its two sides. Functions know the beam where it has been
// put in.
struct WallInWater {
	using Vec2 = gimpm::Vec<2>;

	// A node of the grid that is not on a side (0 left, 1 right) of the beam. Seen from there its pressure goes on
	// linearly from a place beside the beam and another one as far before the beam as the node is behind it.
	struct NodeBehind {
		gimpm::Key node;
		int        side;
		Vec2       beside, before;
	};

	shared_ptr<MpmBeam> beam;
	vector<Vec2>        left, right; // positions beside its vertices
	vector<NodeBehind>  behind;

	WallInWater(const shared_ptr<MpmBeam>&, const string& name, const gimpm::Grid<2>&);

	vector<Vec2> places() const;
};

vector<WallInWater> wallsInWater(const vector<Listed>&, const gimpm::Grid<2>&);

// The side of beams, as they are now, that a place near them is on: 1 + 2 w left, 2 + 2 w right of wall w; 0: near
// none.
class SideOfWalls {
public:
	SideOfWalls(const vector<WallInWater>&, Real cellSize);
	int operator()(const gimpm::Vec<2>& place) const;

private:
	vector<vector<gimpm::Vec<2>>> lines;
	Real                          reach;
};

} // namespace yade
