// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Progress of an analysis for the user: one line on stderr, redrawn in place on a terminal and now and then repeated
// in a log.
#include <chrono>
#include <string>

namespace yade {

struct Progress {
	std::string place;          ///< in the course of the loads, or in time
	long        step, lastStep; ///< O.iter at the end of this step and of the run; lastStep < step: no end is known
	int         iterations, cuts;
	double      residual; ///< NaN: nothing was solved
	std::size_t points;
	bool        inTime;       ///< a time step: how many are made in a second is told, too
	bool        inBackground; ///< run by O.run(), so that nothing but the script's output can come between two steps
	bool        ends;         ///< true if the run comes to its end with this step
};

class ProgressLine {
public:
	ProgressLine() = default;
	ProgressLine(const ProgressLine&) { } // a copied engine starts a line of its own
	~ProgressLine() { breakLine(); }

	// A step begins in this iteration.
	void start(long iter);

	// Level 1: as said above; level 2: a line for each call.
	void show(const Progress&, int level);

	// Whatever comes next on the terminal starts on a line of its own.
	void breakLine();

	// The run is over.
	void end();

private:
	using Clock = std::chrono::steady_clock;

	bool        isDue(const Progress&, int level, bool inPlace) const;
	std::string text(const Progress&) const;

	bool              isRunning = false, isOpen = false; // isOpen: the cursor stands behind the text
	long              first = 0, latest = 0, begun = 0;  // iterations where the run and its latest step began; steps begun in it
	Clock::time_point begin, shown;
};

} // namespace yade
