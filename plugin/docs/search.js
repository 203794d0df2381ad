// SPDX-License-Identifier: GPL-2.0-or-later
// Weights of the search: those of Sphinx, and more for pages that answer than for studies, lists of messages and changes.
const weights = [
	[/plugin\/docs\/questions/, 20],
	[/plugin\/docs\/(tutorials|classes)|plugin\/docs\/(failures|results|processes|installation)|README$/, 8],
	[/plugin\/docs\/explanation/, 6],
	[/plugin\/docs\/(studies|changes)|build\/docs\/messages/, -4],
];

var Scorer = {
	score: result => weights.reduce((score, [page, weight]) => page.test(result[0]) ? score + weight : score, result[4]),
	objNameMatch: 11,
	objPartialMatch: 6,
	objPrio: {0: 15, 1: 5, 2: -5},
	objPrioDefault: 0,
	title: 15,
	partialTitle: 7,
	term: 5,
	partialTerm: 2,
};
