// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Scenes that could be computed but can hardly be meant.
#include "core/grid/point_cloud.hpp"
#include "core/stepping/model.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <map>
#include <optional>
#include <set>

namespace yade {
class Analysis;

// Asked around every step. Settings and materials are looked at each time. Points, which takes longer, are looked at
// when they are not as this engine has left them: in the first step, when bodies come or go, and when a script has
// changed them.
//
// std::invalid_argument for what would be left out without a word, or counted twice: gravity across the plane of a
// two-dimensional grid, points in the same place, cells that are no match for the points, an O.dt that nobody has set
// or that jumps over the whole load curve.
class Plausibility {
public:
	// Before a step. What can be meant, but seldom is: sentences for YADE's log. Each is said once as long as what
	// it says stays so. Adds the time [s] that the points have taken, if they were looked at.
	template <int Dim>
	vector<string> look(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<Dim>&, const gimpm::Model<Dim>&, double& time);

	// Doubt about points that mpm.stages places: the next step may look at all points together, among which they
	// would not be seen.
	template <int Dim> string warningOfPlaced(const vector<MaterialPoint>&, const gimpm::Grid<Dim>&);

	// After it.
	template <int Dim> vector<string> warningsOfResult(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<Dim>&);

	// The points are as the engine has left them.
	template <int Dim> void know(const gimpm::PointCloud<Dim>&);
	template <int Dim> bool knows(const vector<MaterialPoint>&) const;
	template <int Dim> void know(const vector<MaterialPoint>&);

	// Once: that the load curves are at their end, and which conditions reach no point. A wall may wait for soil
	// that arrives later; that a boundary moves nothing is an error of the step.
	string warningOfEnd(const Analysis&);
	string warningOfPlaces(const Analysis&, const vector<MaterialPoint>&);

	// The first of all sentences about the same.
	string once(const string& about, const string& sentence);
	bool   hasSaid(const string& about) const { return saidAbout.count(about) > 0; }

private:
	template <int Dim> bool isNew(const gimpm::PointCloud<Dim>&) const; // not those of the last call of know()
	template <int Dim> void requirePoints(const vector<MaterialPoint>&, const gimpm::PointCloud<Dim>&);
	void                    requireGrid(const Analysis&) const; // checks the sizes that requirePoints() has found

	// Looked at where the points are, and where the length of steps has changed.
	template <int Dim>
	string warningOfLength(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<Dim>&, const gimpm::Model<Dim>&, bool areNew);

	// Takes the sentence, which is empty where there is no doubt, unless it has been said.
	void say(vector<string>&, const string& about, const string& sentence);

	std::optional<uint64_t> known;
	std::map<string, bool>  said; // doubts that were told, by subject
	bool                    saidEnd = false;
	std::set<string>        saidAbout;

	vector<std::pair<Vector3r, Vector3r>> lookedAt; // boxes of conditions: whether they reach any point

	// results for the points of the last check
	Real                          smallest = 0, largest = 0;                  // initial sizes [m]
	Matrix3r                      initialStress = Matrix3r::Zero();           // mean [Pa]
	string                        overlap;                                    // the doubt about it
	Real                          fastestWave = 0;                            // [m/s]
	Real                          duration    = 0;                            // duration of a step in the last check [s]
	string                        length;                                     // the doubt about it
	std::pair<Vector3r, Vector3r> box { Vector3r::Zero(), Vector3r::Zero() }; // box that all were in at first: its corners [m]
};

} // namespace yade
