// SPDX-License-Identifier: GPL-2.0-or-later
// In how many parts a load step is made: smaller ones where it does not converge.
#pragma once
#include "core/stepping/report.hpp"

namespace gimpm {

/// True if a smaller load may help. It does not against boundaries that hold too little, nor against a tolerance below
/// round-off, nor after an interruption by the user.
bool canBeCut(Failure);

/// A part that fails is tried again with half of it, down to a least one, or with as small a one as its local error,
/// which grows with a power of the step, asks for. After one that took few iterations the next is twice as large, if
/// the error admits it. All are made by halving and by taking away, so that they have few digits and their sum is
/// exact.
class StepControl {
public:
	/// Begins with the part that the step before has left, 1 at first.
	StepControl(double part, double leastPart, int maxIterations) : part_(part), leastPart_(leastPart), maxIterations_(maxIterations) { }

	double part() const;                                       ///< part of the whole to be tried now
	double goal() const { return done_ + part(); }             ///< part of the whole that is done when it succeeds
	bool   isLeast() const { return part() / 2 < leastPart_; } ///< it will not be cut
	bool   isDone() const { return done_ >= 1; }
	int    cuts() const { return cuts_; }

	/// Nothing tells how fast the body will move: the next part is a small one, if it may be cut.
	void                    beginAnew();
	static constexpr double firstPart = 1. / 8;

	/// Takes the result of the part that was tried. False: it has failed and is not cut, so the step is given up;
	/// the next one will be tried as a whole.
	bool take(const StepReport&);

	double nextPart() const { return part_; } ///< part that the next step may begin with

private:
	bool   mayGrow(const StepReport&) const;
	double cut(const StepReport&) const;

	double part_, leastPart_, done_ = 0;
	int    maxIterations_, cuts_ = 0;
};

} // namespace gimpm
