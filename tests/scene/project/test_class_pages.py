# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages of the classes: one form, at most 800 words, an example that runs, tables that list every attribute with its default."""
import json
import re

import pytest
from conftest import root

pages = {path.stem: path for path in sorted((root / 'plugin/docs/classes').glob('*.md'))}
admitted = ['Needed', 'Useful', 'Expert', 'Results', 'Methods', 'Limits']


def withoutCode(text):
	return re.sub(r'```.*?```', '', text, flags=re.DOTALL)


def rowsOf(text, heading):
	"""Cells of each row of the first table below a heading, without the head of the table."""
	section = text.partition(f'\n## {heading}\n')[2].partition('\n## ')[0]
	rows = [[cell.strip() for cell in line.strip('|').split('|')] for line in re.findall(r'^\|.*\|$', section, re.MULTILINE)]
	return rows[2:]


@pytest.mark.parametrize('name', pages)
def test_a_page_of_a_class_has_one_form(name):
	"""Two sentences or three, the example, attributes by group, and limits last."""
	text = pages[name].read_text()
	assert text.startswith(f'# {name}\n') and text.count('```python\n') == 1
	words = [word for word in withoutCode(text).split() if re.search(r'\w', word)]
	assert len(words) <= 800
	headings = re.findall(r'^## (.*)$', withoutCode(text), re.MULTILINE)
	assert [heading for heading in headings if heading in admitted] == [heading for heading in admitted if heading in headings]
	assert len(text.partition('```python')[0].split()) < 80


def test_examples_of_the_pages_run(yade):
	"""One after the other, each in an empty scene."""
	scripts = {name: re.search(r'```python\n(.*?)```', path.read_text(), re.DOTALL)[1] for name, path in pages.items()}
	(yade.folder / 'scripts.json').write_text(json.dumps(scripts))
	run = yade('''
import json
for name, script in json.load(open('scripts.json')).items():
	O.reset()
	exec(script, dict(globals()))
	print('ran:', name)
''')
	assert run.stdout.count('ran: ') == len(pages) > 25, run


def test_tables_of_the_pages_are_those_of_the_classes(yade):
	"""Each attribute that a class adds to its base stands in one table, a result among the results, others with their default."""
	run = yade('''
import json
from yade import wrapper

def shown(value):
	if value is None or isinstance(value, (str, bool)): return repr(value)
	if isinstance(value, float): return 'NaN' if value != value else f'{value:g}'
	if isinstance(value, Matrix3): return 'identity' if value == Matrix3.Identity else 'zero'
	if isinstance(value, (tuple, list, Vector3)):
		inner = ', '.join(map(shown, value))
		return f'({inner},)' if len(value) == 1 else f'({inner})'
	return repr(value) if isinstance(value, int) else type(value).__name__ + '()'

classes = {}
for name in dir(wrapper):
	if not name.startswith('Mpm'): continue
	cls = getattr(wrapper, name)
	values = cls().dict()
	classes[name] = {key: None if not isinstance(value, property) else '' if value.fset is None else shown(values[key])
		for key, value in vars(cls).items() if isinstance(value, property) or callable(value) and not key.startswith('_')}
print(json.dumps(classes))
''')
	classes = run.result
	assert set(classes) - {'MpmCondition'} == set(pages)
	wrong = []
	for name, path in pages.items():
		text, told = path.read_text(), {}
		for heading in 'Needed', 'Useful', 'Expert':
			for row in rowsOf(text, heading):
				assert len(row) == 5 and row[3] and row[4], (name, row)
				told[row[0].strip('`')] = row[2].strip('`')
		told |= {row[0].strip('`'): '' for row in rowsOf(text, 'Results')}
		told |= {method: None for method in re.findall(r'^- `(\w+)\(\)`: ', text, re.MULTILINE)}
		live = classes[name]
		wrong += [f'{name}.{key} is not on its page' for key in set(live) - set(told)] + [f'{name} has no {key}' for key in set(told) - set(live)]
		empty = 'NaN', "''", '()', 'None'
		wrong += [f'{name}.{key} is {live[key]}, not {told[key]}' for key in set(live) & set(told) if told[key] != live[key] and not (told[key] == 'required' and live[key] in empty)]
	assert not wrong


def admits(text, value):
	"""True if the column "admitted" of a page admits a number; None where it is not about numbers alone."""
	text = re.sub(r'\(.*?\)', '', text)
	alternatives = [part.strip() for part in text.split(',')] if re.fullmatch(r'[^,]*(, or (NaN|inf|0))?', text) else [text]
	main = alternatives[0].removeprefix('or ')
	others = {part.removeprefix('or ').strip() for part in alternatives[1:]}
	if str(value) in ('nan', 'inf'): return {'nan': 'NaN', 'inf': 'inf'}[str(value)] in others
	number = r'(-?\d+(?:\.\d+)?|1/2|pi/2)'
	limit = lambda word: {'1/2': 0.5, 'pi/2': 1.5707963}.get(word) or float(word)
	if match := re.fullmatch(rf'(>=?) {number}', main): return value > limit(match[2]) or match[1] == '>=' and value == limit(match[2])
	if match := re.fullmatch(rf'(from|above|between) {number},? (to|to below|below|and) {number}', main):
		low, high = limit(match[2]), limit(match[4])
		return low < value < high or match[1] == 'from' and value == low or match[1] in ('from', 'above') and match[3] == 'to' and value == high
	return True if main == 'finite' else None


def test_pages_admit_what_the_classes_admit(yade):
	"""Numbers at the ends of what is admitted, where that is told by numbers."""
	tried = -2., -1., -0.5, 0., 0.25, 0.5, 1., 1.5, 2., float('nan'), float('inf')
	told = {name: {row[0].strip('`'): [admits(row[3], x) for x in tried] for heading in ('Needed', 'Useful', 'Expert') for row in rowsOf(path.read_text(), heading)} for name, path in pages.items()}
	run = yade(f'''
import json
from math import nan, inf
from yade import wrapper
told, tried, found = json.loads({json.dumps(json.dumps(told))}), {tried!r}, []
checked = 0
for name, rows in told.items():
	for key, admitted in rows.items():
		if admitted[0] is None: continue
		default = getattr(wrapper, name)().dict()[key]
		for x, is_admitted in zip(tried, admitted):
			if isinstance(default, int) and (isinstance(default, bool) or not float(x).is_integer()): continue
			value = int(x) if isinstance(default, int) else x
			if not isinstance(default, (int, float)): continue
			checked += 1
			try: setattr(getattr(wrapper, name)(), key, value)
			except ValueError: really = False
			else: really = True
			if really != is_admitted: found.append([name, key, str(x), really])
print(json.dumps([checked, found]))
''')
	checked, found = run.result
	assert not found, found
	assert checked > 500
