// SPDX-License-Identifier: GPL-2.0-or-later
// What is done with a full Newton step that raises the residual; functions of its size |r(d)| only.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace gimpm {

/// A full step may raise the residual by this much: points that begin to yield do so in steps that converge well.
constexpr double toleratedGrowth = 1.1;

/// Full steps after one that raised the residual, which may be the way all the same, as in bending: the stretch that
/// straight displacements cause is gone after the next solve. They must bring the residual down quickly, at least to a
/// half each time, until it is smaller than before; else the iteration goes back and shortens the first one (the
/// watchdog technique: Chamberlain et al. 1982).
class Watchdog {
public:
	Eigen::VectorXd from, step;             ///< displacements before the first step, and that step
	double          before = 0, raised = 0; ///< residual before it and after it [N]

	void begin(const Eigen::VectorXd& d, const Eigen::VectorXd& firstStep, double residualBefore, double residual)
	{
		from = d, step = firstStep, before = residualBefore, raised = bound_ = residual, isOpen_ = true;
	}
	/// Whether the next full step, which ended with this residual, is taken.
	bool admits(double residual)
	{
		bound_ /= 2;
		isOpen_ = residual >= before;
		return residual <= bound_;
	}
	void giveUp() { isOpen_ = false, wasVain_ = true; }
	bool isOpen() const { return isOpen_; }
	bool wasVain() const { return wasVain_; } ///< one in vain is enough for a load step

private:
	double bound_  = 0;
	bool   isOpen_ = false, wasVain_ = false;
};

/// Full steps that lead round in a circle, as where places begin to slip and to stick in turn.
class Rounds {
public:
	/// Whether a step has raised the residual to where it has been.
	bool isBack(double before, double after)
	{
		const auto hasBeen = [&](double size) { return std::abs(size - after) < 1e-3 * after; };
		const bool found   = after > before && std::any_of(sizes_.begin(), sizes_.end(), hasBeen);
		sizes_.push_back(after);
		return found;
	}

private:
	std::vector<double> sizes_; // [N]
};

/// Which part of a step to take.
struct Shortened {
	double length = 1; ///< part of the full step
	double size   = 0; ///< residual there [N]
	int    trials = 0; ///< residuals looked at
};

/// A full step raised the residual from `before` to `full`: tries halves of it, at most `trials` times, until Armijo's
/// condition holds, and takes the best. size(part) gives the residual of a part of the step.
template <class F> Shortened lineSearch(double before, double full, int trials, F&& size)
{
	Shortened best { 1, full };
	for (double part = 0.5; best.trials < trials; part /= 2) {
		const double found = size(part);
		++best.trials;
		if (found < best.size) best.size = found, best.length = part;
		if (found <= (1 - 1e-4 * part) * before) break;
	}
	return best;
}

} // namespace gimpm
