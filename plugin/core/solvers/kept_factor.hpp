// SPDX-License-Identifier: GPL-2.0-or-later
// The last factor of a solver, offered to the steps that follow.
#pragma once
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gimpm {

/// Record of what the last factor is of, and how well it has served since. A step with the same unknowns may begin with
/// it, by the modified Newton method, as long as a few solves are expected to do.
class KeptFactor {
public:
	/// Numbers of the free unknowns, and scales of the fields.
	struct Unknowns {
		std::vector<int>    numbers;
		std::vector<double> scales;

		bool operator==(const Unknowns& other) const { return numbers == other.numbers && scales == other.scales; }
	};

	/// The factor is a new one, of a matrix with signs of its rows or without.
	void renew(Unknowns unknowns, bool hasSigns)
	{
		unknowns_ = std::move(unknowns), hasSigns_ = hasSigns;
		reduction_ = hoped, served_ = 0;
	}
	/// There is no factor any more.
	void discard() { unknowns_ = {}; }

	/// True if a step with these unknowns may begin with it. Counts the steps in which it may not, after it has
	/// failed.
	bool isOffered(const Unknowns& unknowns)
	{
		if (pause_ > 0) return --pause_, false;
		return !unknowns_.numbers.empty() && unknowns_ == unknowns;
	}
	bool hasSigns() const { return hasSigns_; }

	/// True if this excess of the residual is gone after so many solves with it, or earlier.
	bool isEnough(double excess, int solves) const { return excess * std::pow(reduction_, solves) <= 1; }

	/// A solve has left this part of the residual.
	void note(double reduction) { reduction_ = reduction; }

	/// It has served a step.
	void hasServed() { ++served_, failures_ = 0; }

	/// It has not. One that never has is followed by a pause, which gets longer each time; others are just old.
	void hasFailed()
	{
		if (served_ > 0) return;
		pause_    = shortest << failures_;
		failures_ = std::min(failures_ + 1, mostDoublings);
	}

private:
	static constexpr double hoped    = 1e-2; // part of the residual that the first solve in another step leaves
	static constexpr int    shortest = 2, mostDoublings = 6;

	Unknowns unknowns_;
	bool     hasSigns_  = false;
	double   reduction_ = hoped;
	int      served_ = 0, failures_ = 0, pause_ = 0; // steps, factors, steps
};

} // namespace gimpm
