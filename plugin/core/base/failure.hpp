// SPDX-License-Identifier: GPL-2.0-or-later
// What may be wrong with a load step.
#pragma once

namespace gimpm {

enum class Failure {
	none,
	detached,
	misplaced,
	unrestrained,
	slides,
	penetrated,
	refused, ///< by a term, which has no kind of its own for it
	inaccurate,
	gainsEnergy,
	stabilised, ///< only the stabilisation holds the body
	singular,
	inverted,
	noResponse,
	notFinite,
	diverging,
	tooManyIterations,
	stalled,
	apart,
	interrupted
};

} // namespace gimpm
