// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The material points of a scene divided among processes (MpmImplicitEngine.distributed).
#include "core/parallel/division.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class Analysis;
class NewPoints;

class Distribution {
public:
	// std::invalid_argument where the scene is a piece that is not this process's, as after O.load().
	static void requireWhole(const Analysis&);

	// std::invalid_argument names what points that are divided do not admit.
	static void requireDivisible(const Analysis&, const vector<MaterialPoint>&);

	// Leaves each process its own points, the work of all about the same. Each calls it with what it has of them,
	// and gets what it keeps. Of points that all are about to add, each will have those whose lowest cells,
	// `added`, the division gives it.
	template <int Dim> std::shared_ptr<gimpm::Division> divide(Analysis&, vector<MaterialPoint>&, const vector<gimpm::Key>& added = {});

	// The same, before points are added that all know: the numbers of those that this process will have.
	// std::invalid_argument of all where one refuses.
	template <int Dim> vector<int> ownOf(Analysis&, vector<MaterialPoint>&, const NewPoints& added);

private:
	void cut(const std::shared_ptr<const gimpm::Processes>&, const vector<gimpm::Key>& lowest, size_t own);

	vector<gimpm::Key> first; // first keys of the ranges, as in gimpm::Division; empty before the first step
};

// The processes among which the points of an engine are divided, so that each has its own only; this one alone where it
// has all of them.
std::shared_ptr<const gimpm::Processes> holdersOf(const Analysis&);
std::shared_ptr<const gimpm::Processes> holdersOf(const Scene&); // whichever engine has divided them

bool isDivided(const Analysis&);

// For Python: the same of those of the current scene.
bool isSceneDivided();

// For mpm.load, which has put the points of all pieces into the processes that there are now.
void takePieces();

} // namespace yade
