// SPDX-License-Identifier: GPL-2.0-or-later
// usage: node search.js FOLDER QUESTION ...
// First page that the search of the HTML in FOLDER finds for each question, one a line, without a browser.
const fs = require('fs');
const vm = require('vm');
const [folder, ...questions] = process.argv.slice(2);

globalThis.window = globalThis;
globalThis.document = {addEventListener() {}};
globalThis._ready = () => 0;
for (const name of ['_static/searchtools.js', '_static/language_data.js', 'searchindex.js'])
	vm.runInThisContext(fs.readFileSync(`${folder}/${name}`, 'utf8'));

const first = vm.runInThisContext(`question => {
	const stemmer = new Stemmer();
	const asked = splitQuery(question.toLowerCase()).filter(word => ![...stopwords].includes(word)).map(word => stemmer.stemWord(word));
	const found = Search.performTermsSearch(new Set(asked), new Set());
	return found.sort((a, b) => Scorer.score(b) - Scorer.score(a))[0];
}`);
for (const question of questions) {
	const [page, , anchor] = first(question);
	console.log(page + anchor);
}
