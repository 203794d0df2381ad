# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages of the studies: each is what its conclusion and its kept tables say."""
import sys

import pytest
from conftest import root

sys.path.insert(0, str(root / 'scripts' / 'lib'))
import studies

home = root / 'plugin/docs/studies'


def test_pages_are_what_the_tables_say():
	written = [study for study in studies.names() if studies.indexOf(home / study)]
	assert len(written) >= 4
	for study in written: assert (home / f'{study}.md').read_text() == studies.page(study), study


def test_each_table_and_picture_of_a_study_is_on_its_page():
	for study in studies.names():
		index = {row['file'] for row in studies.indexOf(home / study) if row['file'].endswith('.csv')}
		assert index == {path.name for path in (home / study).glob('*.csv')} - {'tables.csv'}, study
		titles = [row['title'] for row in studies.indexOf(home / study)]
		assert all(titles) and len(set(titles)) == len(titles), study
		page = (home / f'{study}.md').read_text()
		assert all(f']({study}/{path.name})' in page for path in (home / study).glob('*.png')), study
	assert {path.stem for path in home.glob('*.md')} == set(studies.names())


def test_tables_have_as_many_cells_in_each_row():
	for path in home.glob('*/*.csv'):
		assert len({len(row) for row in studies.rowsOf(path)}) == 1, path


def test_a_table_that_is_kept_again_stays_in_its_place(tmp_path, monkeypatch):
	monkeypatch.setattr(studies, 'home', str(tmp_path))
	keep = lambda title, N: studies.keep(tmp_path / 'a', f'{title.lower()}.csv', title, '`scripts/a`', [['case', 'N'], ['x | y', N]])
	for title, N in ('First', '1'), ('Second', '1'), ('First', '2'): keep(title, N)
	studies.keep(tmp_path / 'a', 'd.png', 'Picture', '', None, 'See [b](../../b.md).')
	studies.keep(tmp_path / 'a', 'summary.csv', 'Summary', '', [['number', 'value'], ['count', '3']])
	(tmp_path / 'a/conclusion.md').write_text('# A\n\nAll {count}. It holds ([b](../../b.md#c), [here](#first), [web](https://c)).\n\n![Curve](c.png)\n')
	page = studies.page('a')
	assert page.index('### First') < page.index('### Second') and '| x \\| y | 2 |' in page
	assert '([b](../b.md#c), [here](#first), [web](https://c))' in page and '![Curve](a/c.png)' in page
	assert 'See [b](../b.md).\n\n![Picture](a/d.png)' in page and 'All 3. It' in page


def test_new_rows_of_a_case_replace_the_old_ones(tmp_path, monkeypatch):
	"""Old rows are kept as earlier ones."""
	monkeypatch.setattr(studies, 'home', str(tmp_path))
	for folder, file, rows in ('a', 'cases.csv', [['x', '1'], ['y', '1']]), ('a', 'earlier.csv', []), ('out', 'cases.csv', [['y', '2'], ['z', '2']]):
		studies.keep(tmp_path / folder, file, 'Cases', '`scripts/a`', [['case', 'N'], *rows])
	(tmp_path / 'a/conclusion.md').write_text('# A\n')
	studies.take('a', tmp_path / 'out')
	assert '| y | 2 |' in (tmp_path / 'a.md').read_text()
	assert studies.rowsOf(tmp_path / 'a/cases.csv')[1:] == [['x', '1'], ['y', '2'], ['z', '2']]
	assert studies.rowsOf(tmp_path / 'a/earlier.csv')[1:] == [['y', '1']]
	with pytest.raises(ValueError, match='give rows of the same columns'): studies.renew(tmp_path / 'a', [['other']])
	with pytest.raises(ValueError, match='lists no tables'): studies.take('a', tmp_path)


def test_conclusions_are_short_and_have_a_title(tmp_path, monkeypatch):
	monkeypatch.setattr(studies, 'home', str(tmp_path))
	(tmp_path / 'a').mkdir()
	for text, said in ('No title', 'begins with'), ('# A\n' + 'word ' * 600, 'at most 600'):
		(tmp_path / 'a/conclusion.md').write_text(text)
		with pytest.raises(ValueError, match=said): studies.page('a')
