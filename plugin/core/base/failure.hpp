// SPDX-License-Identifier: GPL-2.0-or-later
// Reasons why a load step may fail.
#pragma once

namespace gimpm {

enum class Failure {
	none,
	detached,
	misplaced,
	unrestrained,
	slides,
	penetrated,
	refused, ///< refusal by a term, which has no kind of its own for it
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
