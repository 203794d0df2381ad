// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The material points of a scene divided among processes (MpmImplicitEngine.distributed).
#include "core/grid/division.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/solver/MpmGrid.hpp"

namespace yade {
class MpmImplicitEngine;

// What files keep of it: the pieces that the points were in, this one's number, and of how many bodies. Those behind have been added to the scene since, by each process.
struct Pieces {
	int count = 0, number = 0, bodies = 0;

	template <class V> static void attributes(V&& v)
	{
		v("pieces", &Pieces::count, hidden, "", atLeast(0));
		v("piece", &Pieces::number, hidden, "", atLeast(0));
		v("bodiesInPieces", &Pieces::bodies, hidden, "", atLeast(0));
	}
};

class Distribution {
public:
	// std::invalid_argument where the scene is a piece that is not this process's, as after O.load().
	static void requireWhole(const MpmImplicitEngine&);

	// std::invalid_argument names what points that are divided do not admit.
	static void requireDivisible(const MpmImplicitEngine&, const vector<MaterialPoint>&);

	// Leaves each process its own points, the work of all about the same. Each calls it with what it has of them, and gets what it keeps.
	template <int Dim> std::shared_ptr<gimpm::Division> divide(MpmImplicitEngine&, vector<MaterialPoint>&);

private:
	template <int Dim> vector<gimpm::Key> lowestCells(const MpmImplicitEngine&, const vector<MaterialPoint>&) const;
	void                                  cut(const gimpm::Processes&, const vector<gimpm::Key>& lowest, size_t own);

	vector<gimpm::Key> first; // of the ranges, as in gimpm::Division; empty before the first step
};

// Whether the points of an engine are in several processes, of which this one has its own only.
bool isDivided(const MpmImplicitEngine&);

// For Python: of one of the engines of the current scene.
bool isSceneDivided();

// For mpm.load, which has put the points of all pieces of the current scene into so many processes.
void takePieces(int count, int number);

} // namespace yade
