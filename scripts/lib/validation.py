# SPDX-License-Identifier: GPL-2.0-or-later
"""Comparisons of the plugin: the runs that make them, the tables that are kept of them, and the page of all of them. For scripts/validate; needs nothing of YADE."""
import math
import os
import re

import pages
import results
from peers.scenes import scenes

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
examples = os.path.join(root, 'examples')
columns = ['command', 'quantity', 'ours', 'theirs', 'unit', 'source']

# Runs, by folder of examples, whose comparisons are kept in its compared.csv.
runs = {
        'column': ['column.py', 'column.py --cells 64'],
        'cantilever': ['cantilever.py --cells 8'],
        'slope': ['slope.py', 'slope.py --cellSize 0.5 --pointsPerCell 3'],
        'laboratory': ['laboratory.py'],
        'collapse': ['collapse.py', 'collapse.py --cellSize 0.125'],
        'safety': ['safety.py --scene cut --cells 20', 'safety.py', 'safety.py --scene infinite --cells 20 --tolerance 0.004'],
        'earth_pressure': ['earth_pressure.py', 'earth_pressure.py --contact 1 --cells 10 --movement 4 --steps 40', 'earth_pressure.py --contact 1 --rough 1 --wall 15', 'sheet.py', 'sheet.py --wall 20', 'sheet.py --halvings 1', 'sheet.py --halvings 1 --wall 20'],
        'footing3d': ['footing3d.py'],
        'axisymmetric': ['axisymmetric.py'],
        'locking': ['locking.py', 'locking.py --scene square --cells 6 --law tresca', 'locking.py --scene cut --cells 20', 'locking.py --scene beam --cells 4 --poisson 0.499'],
        'surface_loads': ['surface_loads.py', 'tube.py'],
        'walls': ['walls.py', 'walls.py --load lid', 'cook.py', 'cook.py --poisson 0.4999 --fBar 1'],
        'water': ['water.py', 'dam.py', 'drawdown.py', 'reservoir.py'],
        'consolidation': ['consolidation.py'],
        'rain': ['rain.py', 'recharge.py', 'drawdown.py'],
        'embankment': ['embankment.py', 'vasby.py'],
        'sheet_pile': ['sheet_pile.py', 'sheet_pile.py --cellSize 0.25 --depth 3'],
        'lined_tunnel': ['lined_tunnel.py', 'shaft.py'],
        'penetration': [
                'penetration.py --cells 16 --depth 0.03', 'penetration.py --scene sphere --cells 10', 'penetration.py --scene plate', 'deep.py --scene tbar', 'deep.py --scene tbar --rough 1', 'deep.py --cells 3',
                *(f'deep.py --cells 4 --halvings 1 --rigidity {which}' for which in ('50', '200', '500', '200 --rough 1')), 'cptu.py',
                'chamber.py', 'chamber.py --law constant', 'chamber.py --pressure 400e3 --densities "0.4 0.8"', 'deep.py --scene pile --cells 4', 'wheel.py', 'penetration.py --scene cylinder --cells 10', 'penetration.py --scene free --cells 2 --stiffness 20'
        ],
        'adaptive': ['adaptive.py', 'slip.py'],
        'grains_on_soil': ['grains_on_soil.py', 'plough_alone.py --cell 0.05', 'energy.py'],
        'mpm_vs_dem': ['mpm_vs_dem.py', 'dry_grains.py', 'silo.py', 'plough.py'],
        'meeting': ['propped_wall.py', 'slide.py', 'tyre.py'],
        'free_bodies': ['gravity_wall.py', 'gravity_wall.py --cellSize 0.125', 'gravity_wall.py --width 1.2 --friction 30', 'net.py'],
        'waves': ['waves.py --scene "bar block sphere"', 'explicit.py --scene bar'],
        'earthquake': ['earthquake.py'],
        'runout': ['runout.py'],
        'footings': ['footings.py', 'transcona.py'],
        'dams': ['lower.py', 'upper.py'],
        'tasks': sorted(name for name in os.listdir(os.path.join(examples, 'tasks')) if name.endswith('.py')),
}

groups = {
        'Tasks in thirty lines': ['tasks'],
        'Laws': ['laboratory'],
        'Elasticity, large strains and rotations': ['column', 'cantilever', 'surface_loads', 'walls'],
        'Limit loads': ['collapse', 'footing3d', 'axisymmetric', 'locking'],
        'Slopes': ['slope', 'safety', 'paper'],
        'Earth pressure': ['earth_pressure'],
        'Walls and tunnels in the ground': ['sheet_pile', 'lined_tunnel'],
        'Water and stages': ['water', 'consolidation', 'rain', 'embankment'],
        'Contact and penetration': ['penetration', 'adaptive', 'grains_on_soil', 'meeting', 'free_bodies'],
        'Waves and run-out': ['waves', 'earthquake', 'runout', 'splitting'],
        'Grains': ['mpm_vs_dem'],
        'Beside other programs': ['peers'],
        'Field': ['footings', 'dams'],
}
studiesOnly = 'peers',  # folders of studies, the others of examples


def kept(folder, of=examples):
	return results.read(os.path.join(of, folder, 'compared.csv'))


def write(folder, rows, of=examples):
	results.write(os.path.join(of, folder, 'compared.csv'), columns, rows)


_found = re.compile(r'(?P<what>[^:]*): .*?(?:= |: |settlement |stress |height )(?P<ours>-?\d\S*)(?: (?P<unit>\S+))?(?: on the base)?, (?:by hand|published|by experiments|without a stop) (?P<theirs>[-\d.e+]+)')


def ofTask(script, printed):
	"""The row of a task, whose last line has its number beside that by hand; whose that is says a sentence at its head."""
	found = _found.match(re.sub(r'^([^:]*): ', r'\1: : ', printed.strip().splitlines()[-1]))
	with open(os.path.join(examples, 'tasks', script)) as file:
		source = re.search(r'(?:By hand|Published): (.*?)(?:\. (?!\d).*)?\.?"""', file.read())[1]
	return dict(quantity=found['what'], ours=found['ours'], theirs=found['theirs'], unit=found['unit'] or '', source=source)


def ofPaper():
	"""Iterations of the slope beside the paper's, of runs that have come to their end there and here."""
	slopes = results.read(os.path.join(examples, 'paper', 'results', 'slope.csv'))
	ours = {(float(row['cellSize']), int(row['pointsPerCell']), float(row['factor'])): row for row in slopes if row['lineSearchTrials'] == '0' and not row['failure']}
	for row in results.read(os.path.join(examples, 'paper', 'published.csv')):
		run = ours.get((float(row['cellSize']), int(row['pointsPerCell']), float(row['factor'])))
		if not run or 'fails' in row['result'] or float(row['factor']) == 0: continue
		what = f"iterations a step of the slope, h = {row['cellSize']} m, {row['pointsPerCell']} x {row['pointsPerCell']} points, ghost factor {row['factor']}"
		yield dict(command=f"scripts/reproduce table{row['table']}", quantity=what, ours=f"{float(run['meanIterations']) + 1:.4g}", theirs=row['result'].split()[0], unit='', source=f"Coombs 2023, table {row['table']}")


def ofSplitting():
	for row in results.read(os.path.join(examples, 'splitting', 'results', 'splitting.csv')):
		if row['failure'] or not row['exact'] or float(row['exact']) in (0, 1) and row['scene'] != 'press' or math.isnan(float(row['exact'])): continue
		source = 'Lube et al. 2005, experiments' if row['scene'].startswith('runout') else 'closed form, large strains'
		yield dict(command=f"scripts/run splitting --scenes {row['scene']} --cases {row['points']}/{row['maxSplits']}", quantity=f"{row['scene']}, {row['points']} x {row['points']} points a cell, maxSplits {row['maxSplits']}",
		           ours=f"{float(row['measured']):.4g}", theirs=f"{float(row['exact']):.4g}", unit='', source=source)


def ofPeers():
	"""The plugin beside the best elements of each other program, on the finest grid that scripts/peers keeps."""
	home = os.path.join(root, 'plugin', 'docs', 'studies', 'peers')
	versions = {row['program']: row['version'].split('+')[0].split('-')[0].split('~')[0] for row in results.read(os.path.join(home, 'programs.csv'))}
	for scene, of in scenes.items():
		rows = {(row['program'], row['elements']): row for row in results.read(os.path.join(home, scene + '.csv'))}  # the last of each kind is on the finest grid
		ours = rows['plugin', 'cells, F-bar' if scene == 'footing' else 'cells']
		for program, kind in {program: kind for program, kind in rows if program != 'plugin'}.items():
			theirs = rows[program, kind]
			yield dict(
			        command=f'scripts/peers --scenes {scene}', quantity=f"{of.quantity}, h = {ours['h [m]']} m", ours=ours['value'], theirs=theirs['value'], unit=of.unit,
			        source=f'{program} {versions[program]}, {kind}')
	for row in results.read(os.path.join(home, 'ample-values.csv')):
		yield dict(command='scripts/peers --ample FOLDER', quantity=f"{row['quantity'].partition(' [')[0]}, {row['set-up']} of AMPLE GS", ours=row['plugin, same method'], theirs=row['AMPLE as shipped'], unit='m', source='AMPLE GS in Octave')


def everything(of=examples):
	"""Rows by folder."""
	found = {folder: kept(folder, of) for folder in runs}
	return found | dict(paper=list(ofPaper()), splitting=list(ofSplitting()), peers=list(ofPeers()))


def difference(row):
	ours, theirs = float(row['ours']), float(row['theirs'])
	return ours / theirs - 1 if theirs else ours


def closedForms():
	"""Sources of the tests: rows of test, against."""
	return results.read(os.path.join(root, 'tests', 'data', 'closed_forms.csv'))


words = re.compile(r"closed form|by hand|published|Rankine|Prandtl|Hertz|Boussinesq|Lame|Coulomb's law|Skempton|Griffiths|limit analysis|Timoshenko|elastica\b|Archimedes|Terzaghi|Davis|Clapeyron|independent implementation")


def ofTests():
	"""(file, name of the test, docstring or comments) of all tests but those of the project itself."""
	for folder, ending in ('scene', '.py'), ('core', '.cpp'):
		for place, _, files in sorted(os.walk(os.path.join(root, 'tests', folder))):
			if os.path.basename(place) == 'project': continue
			for name in sorted(files):
				if not name.startswith('test_') or not name.endswith(ending): continue
				path = os.path.join(place, name)
				with open(path) as file:
					text = file.read()
				for test, said in _documented(text) if ending == '.py' else _commented(text): yield os.path.relpath(path, root), test, ' '.join(said.split())


def _documented(text):
	"""Tests in Python: name, docstring with comments."""
	for match in re.finditer(r'^def (test_\w+)\((.*?)(?=^\S|\Z)', text, re.MULTILINE | re.DOTALL):
		docstring = re.match(r'[^\n]*\n\t"""(.*?)"""', match[2], re.DOTALL)
		comments = re.findall(r'(?:^|\s)# (.*)$', match[2], re.MULTILINE)
		yield match[1], '. '.join(([docstring[1].rstrip('.')] if docstring else []) + comments)


def _commented(text):
	"""Tests of the core: name, comment before them with those in them."""
	for match in re.finditer(r'((?:^[ \t]*//[^\n]*\n)*)^[ \t]*(?:TYPED_)?TEST(?:_[FP])?\((\w+), (\w+)\)(.*?)(?=^\t?\}|^[ \t]*(?:TYPED_)?TEST|\Z)', text, re.MULTILINE | re.DOTALL):
		before = ' '.join(re.findall(r'//+[!<]? ?(.*)', match[1]))
		yield f'{match[2]}.{match[3]}', '. '.join([before.rstrip('.')] * bool(before) + re.findall(r'//+[!<]? ?(.*)', match[4]))


def commandOf(folder, command):
	return f'scripts/run examples/{folder}/{command}'


def percentOf(difference):
	return f'{100 * difference:+.2g} %' if difference else '0'


def rowsOf(rows):
	"""Comparisons as rows of a table, head first."""
	lines = [['what', 'ours', 'theirs', 'difference', 'source of theirs', 'command']]
	for row in rows:
		unit = f" {row['unit']}" if row['unit'] not in ('', '-') else ''
		lines.append([row['quantity'], row['ours'] + unit, row['theirs'] + unit, percentOf(difference(row)), row['source'], f"`{row['command']}`"])
	return lines


def linkOf(folder):
	if folder == 'tasks': return '[the course](../../../../examples/README.md#tasks)'
	return f'[{folder}]({f"../{folder}.md" if folder in studiesOnly else f"../../../../examples/{folder}/README.md"})'


def tables(found):
	"""File, title, rows and note of all tables."""
	rows = [row for of in found.values() for row in of]
	sizes = sorted(abs(difference(row)) for row in rows)
	summary = dict(count=len(rows), median=pages.percent(sizes[len(sizes) // 2]), most=pages.percent(sizes[int(0.9 * len(sizes))]))
	yield 'summary.csv', 'Summary', [['number', 'value'], *summary.items()], 'Number of comparisons, median of their differences, and the difference that nine of ten are below.'
	for group, folders in groups.items():
		links = ', '.join(linkOf(folder) for folder in folders)
		yield group.lower().replace(',', '').replace(' ', '-') + '.csv', group, rowsOf(row for folder in folders for row in found[folder]), f'From {links}.'
	files, forms = {test: file for file, test, _ in ofTests()}, closedForms()
	listed = [['test', 'compared with', 'file'], *([f"`{row['test']}`", row['against'], f"`{files[row['test']]}`"] for row in forms)]
	yield 'tests.csv', 'In the tests', listed, TESTS.format(count=len(forms))


TESTS = """{count} tests that run on every change compare with closed forms and numbers of others, to tolerances that they name. Those of the core by `build/tests/core_tests --gtest_filter=NAME`,
those in YADE by `/usr/bin/python3 -m pytest FILE -k NAME`, all by `scripts/test`.""".replace('\n', ' ')


kinds = {'closed form': 'o', 'other program': 's', 'experiment': '^', 'field': '*', 'balance, or itself': 'x'}
_programs = re.compile('finite (elements|volumes|method)|finer method|limit analysis|Coombs 2023|independent implementations|Gourvenec|Griffiths|same (cut|column|silo|bed) in grains|CalculiX|GetFEM|FEniCS|AMPLE')
_itself = re.compile('balance|its weight|weight of|what was set|what turns|the same (cells|dam|undrained|drained|at V)|nothing changes|by MpmContact|MpmWater of|potential_plane|volume loss|base of the ground bears')


def kindOf(source):
	"""Kind of what a number is compared with."""
	if 'experiment' in source: return 'experiment'
	if source.endswith(', field'): return 'field'
	if _programs.search(source): return 'other program'
	return 'balance, or itself' if _itself.search(source) else 'closed form'


def _sizes(rows):
	"""Number of rows, median of their differences, that which nine of ten are below, and the row with the largest."""
	sizes = sorted(abs(difference(row)) for row in rows)
	return len(sizes), pages.percent(sizes[len(sizes) // 2]), pages.percent(sizes[int(0.9 * len(sizes))]), max(rows, key=lambda row: abs(difference(row)))


def summary(found):
	"""File, title, rows and note of the tables of the page of one screen: differences by what is compared with, and by group."""
	rows = [row for of in found.values() for row in of]
	shown = [['compared with', 'numbers', 'median', 'nine of ten below', 'largest', 'command of the largest']]
	for kind in kinds:
		count, median, most, worst = _sizes([row for row in rows if kindOf(row['source']) == kind])
		shown.append([kind, count, median, most, f"{percentOf(difference(worst))}: {worst['quantity'].split(',')[0]}", f"`{worst['command']}`"])
	yield 'sources.csv', 'By what it is compared with', shown, ''
	shown = [['group', 'numbers', 'median', 'nine of ten below', 'command']]
	for group, folders in groups.items():
		count, median, most, _ = _sizes([row for folder in folders for row in found[folder]])
		run = [folder for folder in folders if folder in runs]
		others = dict(paper='scripts/reproduce', splitting='scripts/run splitting', peers='scripts/peers')
		shown.append([group, count, median, most, ', '.join(f'`{command}`' for command in ([f"scripts/validate --run {' '.join(run)}"] if run else []) + [others[folder] for folder in folders if folder in others])])
	yield 'groups.csv', 'By group', shown, 'Each number with its command is in [validation](../validation.md).'


def picture(found, path):
	"""Differences of each group, by kind of what they are held against; what is smaller than 1e-3 % stands at the left edge."""
	import matplotlib
	matplotlib.use('Agg')
	import matplotlib.pyplot as plt
	figure, ax = plt.subplots(figsize=(9.5, 5.2), layout='constrained')
	for kind, marker in kinds.items():
		x, y = [], []
		for number, folders in enumerate(groups.values()):
			rows = [row for folder in folders for row in found[folder] if kindOf(row['source']) == kind]
			x += [max(100 * abs(difference(row)), 1e-3) for row in rows]
			y += [number + 0.5 * ((3 * i) % 7 - 3) / 7 for i in range(len(rows))]  # beside each other, that none hides another
		ax.plot(x, y, marker, label=kind, alpha=0.6, markersize=5, markeredgewidth=1 if marker == 'x' else 0)
	for edge in 1, 10: ax.axvline(edge, color='0.7', linewidth=0.8, zorder=0)
	ax.set(xscale='log', xlim=(7e-4, 200), ylim=(len(groups) - 0.5, -0.5), yticks=range(len(groups)), yticklabels=list(groups), xlabel='difference [%]')
	ax.set_xticks([1e-3, 1e-2, 0.1, 1, 10, 100], ['below 0.001', '0.01', '0.1', '1', '10', '100'])
	ax.legend(frameon=False, loc='upper center', bbox_to_anchor=(0.5, 1.1), ncols=4)
	figure.savefig(path, dpi=120)
