// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/exchange.hpp"
#include <tuple>

namespace yade {

// Columns of an engine's points between its steps. They serve for the next one as long as nobody else has changed
// values of points: this plugin, which counts its PointWriters, or Python, the assignments of which are counted.
class KeptColumns {
public:
	// Takes the columns as a step begins, if they serve; else none.
	template <int Dim> LeftColumns<Dim> take();

	void wrote() { ++seen; } // the engine's own PointWriter

	// Keeps those of a step that has ended.
	template <int Dim> void keep(gimpm::PointCloud<Dim>&&, const std::vector<gimpm::Material>&);

	// Columns between two steps; null if they do not serve.
	template <int Dim> const gimpm::PointCloud<Dim>* cloud() const;

private:
	static long changes(); // those so far; -1 if there may be others at any time

	std::tuple<LeftColumns<2>, LeftColumns<3>> columns;
	long                                       seen = 0; // changes when they were taken, and those by the engine since
};

} // namespace yade
