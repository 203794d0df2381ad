// SPDX-License-Identifier: GPL-2.0-or-later
// Line search after a full Newton step that the forces resist.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace gimpm {

/// A Newton step d from some displacements, and how it went. The work of the out-of-balance force on it is r.d: where
/// forces have a potential, as at small strains with associated flow, that is the slope of the potential along the
/// step, and it falls to zero where the potential is least. The size of the residual is no such guide where soil yields
/// by friction: at the apex of its yield surface large forces store next to no energy.
struct NewtonStep {
	Eigen::VectorXd from, step;               ///< displacements before it, and the whole of it [m]
	double          before = 0, after = 0;    ///< work of the out-of-balance force on it, before and after all of it [J]
	double          sizeBefore = 0, size = 0; ///< size of the residual [N]
	double          length = 0;               ///< largest displacement in it [m]

	/// True if the step may be taken as it is: it may lead a little past the least potential. One that does not
	/// lead downhill, as it may where flow is not associated, is not judged by its work. One of more than a cell
	/// must reduce the residual: points that nothing holds fly without work.
	bool isTaken(double cell) const
	{
		if (length > cell && !(size < sizeBefore)) return false;
		return before > 0 ? after > -0.5 * before : std::isfinite(after);
	}
};

/// Full steps after one that is not taken, which may be the way all the same, as in bending: the stretch that straight
/// displacements cause is gone after the next solve. They must bring the residual down quickly, at least to a quarter
/// each time, until it is smaller than before; else the iteration goes back and shortens the first one (the watchdog
/// technique: Chamberlain et al. 1982).
class Watchdog {
public:
	NewtonStep first;

	void begin(NewtonStep step)
	{
		first   = std::move(step);
		bound_  = first.size;
		isOpen_ = true;
	}
	/// True if the next full step, which ended with this residual, is taken.
	bool admits(double residual)
	{
		bound_ /= 4;
		isOpen_ = residual >= first.sizeBefore;
		return residual <= bound_;
	}
	void giveUp() { isOpen_ = false, wasVain_ = true; }
	bool isOpen() const { return isOpen_; }
	bool wasVain() const { return wasVain_; } ///< one in vain is enough for a load step

private:
	double bound_  = 0;
	bool   isOpen_ = false, wasVain_ = false;
};

/// Part of a step to take.
struct Shortened {
	double length = 1; ///< part of the full step
	int    trials = 0; ///< residuals looked at
};

/// Looks for the part of a step where the out-of-balance force does at most half as much work on it as before (Matthies
/// and Strang 1979), between the parts where that pulls on and where it pulls back, by linear interpolation that
/// leaves a tenth of the interval at either end. work(part) gives it; minus infinity where there is no force.
template <class F> Shortened lineSearch(const NewtonStep& step, int trials, F&& work)
{
	double     low = 0, high = 1, atLow = step.before, atHigh = step.after;
	const auto between = [&] {
		if (!std::isfinite(atHigh)) return low > 0 ? (low + high) / 2 : high / 4;
		return low + (high - low) * std::clamp(atLow / (atLow - atHigh), 0.1, 0.9);
	};
	for (int trial = 1; trial <= trials; ++trial) {
		const double part = between(), at = work(part);
		if (step.before > 0 ? std::abs(at) <= 0.5 * step.before : std::isfinite(at)) return { part, trial };
		if (at > 0) low = part, atLow = at;
		else
			high = part, atHigh = at;
	}
	return { low > 0 && atLow < -atHigh ? low : high, trials };
}

} // namespace gimpm
