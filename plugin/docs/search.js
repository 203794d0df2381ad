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

// Pages without one of the words, where no page has all; and titles and entries whose words are all among those of the question, wherever they stand in it.
(() => {
	const stemmer = new Stemmer();
	const isLeftOut = word => (stopwords.has ? stopwords.has(word) : stopwords.includes(word));
	const stems = text => splitQuery(text.toLowerCase()).filter(word => !isLeftOut(word)).map(word => stemmer.stemWord(word));
	const searchAll = Search.performTermsSearch;

	const searchWithoutOne = (asked, excluded) =>
		[...asked].flatMap(left => searchAll(new Set([...asked].filter(word => word !== left)), excluded));

	const searchPhrases = (table, asked, fewestWords, titleOf) => {
		const {docnames, filenames, titles} = Search._index;
		return Object.entries(table).flatMap(([phrase, places]) => {
			const words = new Set(stems(phrase));
			const isHeadingOfMany = places.length > 5; // as Limits
			if (words.size < fewestWords || isHeadingOfMany || [...words].some(word => !asked.has(word))) return [];
			const score = Math.round(30 + 50 * words.size / asked.size);
			return places.map(([file, id]) => [docnames[file], titleOf(titles[file], phrase), id ? '#' + id : '', null, score, filenames[file]]);
		});
	};

	Search.performTermsSearch = (asked, excluded) => {
		let found = searchAll(asked, excluded);
		if (!found.length && asked.size > 1) found = searchWithoutOne(asked, excluded);
		const ofHeading = (page, heading) => (page === heading ? page : `${page} > ${heading}`); // as Sphinx names it, so that it is shown once
		return found.concat(searchPhrases(Search._index.alltitles, asked, 2, ofHeading), searchPhrases(Search._index.indexentries, asked, 1, page => page));
	};
})();
