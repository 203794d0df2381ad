// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/step_errors.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"
#include "yade_api/value_lock.hpp"

namespace yade {

StepErrors::StepErrors(const MpmImplicitEngine& engine) : engine(engine)
{
	const ValueLock lock;
	tolerance = engine.newton->stepTolerance;
}

string StepErrors::warningOf(const gimpm::StepReport& report, const gimpm::StepControl& next)
{
	if (tolerance == 0 || report.failure != gimpm::Failure::inaccurate || !next.isLeast() || isTold) return "";
	isTold = true;
	std::ostringstream text;
	text << "at load factor " << engine.loadFactor << " small load steps, too, are beyond newton.stepTolerance: " << report.cause
	     << ". Steps of newton.minStep are made whatever their error, in the rest of this run without a word: the body jumps, or the tolerance is too small.";
	return text.str();
}

} // namespace yade
