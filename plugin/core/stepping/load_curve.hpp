// SPDX-License-Identifier: GPL-2.0-or-later
// Factor of a load over time.
#pragma once
#include <utility>
#include <vector>

namespace gimpm {

/// In one step.
struct LoadFactor {
	double value  = 1; ///< at the end of the step
	double growth = 1; ///< in the step

	double before() const { return value - growth; }
};

/// Linear between its knees (time, factor), constant before the first and after the last.
class LoadCurve {
public:
	using Knees = std::vector<std::pair<double, double>>;

	static bool isAdmissible(const Knees&); ///< one or more, finite, with increasing times

	explicit LoadCurve(Knees knees) : knees_(std::move(knees)) { }

	static double valueAt(const Knees&, double time);
	double        valueAt(double time) const { return valueAt(knees_, time); }
	LoadFactor    between(double begin, double end) const { return { valueAt(end), valueAt(end) - valueAt(begin) }; }
	double        end() const { return knees_.back().first; } ///< when it has come to rest

private:
	Knees knees_;
};

} // namespace gimpm
