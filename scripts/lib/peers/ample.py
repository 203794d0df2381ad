# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares the plugin with AMPLE GS point by point after each step, for scripts/peers. Needs nothing of YADE."""
import os

import numpy as np

from . import by_ample

# Runs of AMPLE: tolerance and rows of empty elements above its mesh, each compared with the plugin at the same tolerance
shipped, tight, empty = (1e-6, 0), (1e-9, 0), (1e-9, 2)
runs = {shipped: 'as shipped', tight: 'tolerance 1e-9', empty: 'tolerance 1e-9, empty elements above'}
kinds = dict(column=[shipped, tight, empty], beam=[shipped, tight], collapse=[shipped, empty])
defaults = 0  # the tolerance that stands for the plugin's default settings
quantities = dict(
        column=('height of the uppermost points [m]', lambda x: x[-1, :, 1].max()),
        beam=('deflection of the tip [m]', lambda x: (x[0] - x[-1])[x[0, :, 0] > 9.9, 1].mean()),
        collapse=('front [m]', lambda x: x[-1, :, 0].max()))


def digits(ours, theirs):
	"""Digits in which positions and stresses agree, after each step: of the largest difference over the largest movement, or stress."""
	found = []
	for (mine, his), reference in zip(zip(ours, theirs), (theirs[0][0], 0)):
		size, difference = abs(his - reference).max((1, 2))[1:], abs(mine - his).max((1, 2))[1:]
		found.append(-np.log10(np.maximum(difference, 1e-16 * size) / size))
	return found


def sort(positions, stresses):
	"""Points in the order of their initial positions, which both programs have."""
	order = np.lexsort(np.round(positions[0], 6).T)
	return positions[:, order], stresses[:, order]


def compare(study, folder, names, limit):
	"""Runs set-ups in both programs and returns their tables."""
	missing = by_ample.missing(folder)
	if missing: study.fail(f"{', '.join(missing)}: not found. Give a checkout of branch AMPLE-GS of github.com/wmcoombs/AMPLE-m, and install octave.")
	home = os.path.abspath(os.path.join(study.options.out, 'ample'))
	os.makedirs(home, exist_ok=True)
	keys = [(name, tolerance) for name in names for tolerance in (shipped[0], tight[0], defaults)]
	fileOf = lambda name, tolerance: os.path.join(home, f'{name}-{tolerance:g}.npz')
	solves = {}
	for ((name, tolerance), *_), result in study.run([(key, 'peers.beside_ample.run', dict(name=key[0], tolerance=key[1], file=fileOf(*key))) for key in keys], limit):
		if isinstance(result, str) or 'why' in result: study.fail(f'{name} in the plugin: {result}')
		solves[name, tolerance] = result['solves']
	rows, values = [], []
	for name in names:
		mine = {tolerance: sort(*np.load(fileOf(name, tolerance)).values()) for tolerance in (*{run[0] for run in kinds[name]}, defaults)}
		for run in kinds[name]:
			*his, steps = by_ample.run(folder, os.path.join(home, f'{name}-{run[0]:g}-{run[1]}'), name, *run, limit)
			his = sort(*his)
			rows.append([name, runs[run], his[0].shape[1], len(steps), int(steps[:, 0].sum()), solves[name, run[0]], *shown(digits(mine[run[0]], his), len(steps))])
			print(*rows[-1], flush=True)
			if run == shipped: values.append([name, *quantity(name, his, mine[run[0]], mine[defaults])])
	yield 'ample.csv', 'AMPLE GS: digits that agree', [head, *rows], notes[0]
	yield 'ample-values.csv', 'AMPLE GS: results', [['set-up', 'quantity', 'AMPLE as shipped', 'plugin, same method', 'difference', 'plugin, defaults', 'difference of the defaults'], *values], notes[1]


notes = ('''Digits of the largest difference, over the largest movement and the largest stress. The plugin has domains by the stretch, the scaling of the paper and full Newton steps. The meshes of column and collapse
end where the body does: their top is no free surface, and not stabilised, at first, which leaves 4 digits; two rows of empty elements above it bring the others back. With a tolerance of 1e-6 one program
does a last solve that the other leaves. In the collapse domains overhang the base by 1e-8 of their half length after the first step, by their stretch: AMPLE counts that, the plugin takes it for round-off, which
leaves 8 digits of stress, whatever the tolerances.'''.replace('\n', ' '),
         'The column of AMPLE has points without domains, which end 7.2 % below the exact 23.301 m; domains, the default of the plugin, end 0.3 % below it.')
head = ['set-up', 'AMPLE', 'points', 'steps', 'its solves', 'our solves', *(f'{of}, {when}' for of in ('positions', 'stresses') for when in ('first step', 'half', 'end'))]


def shown(found, steps):
	return [f'{of[step]:.1f}' for of in found for step in (0, steps // 2 - 1, steps - 1)]


def quantity(name, his, mine, usual):
	"""Name and values of the quantity of a set-up."""
	title, of = quantities[name]
	theirs, same, default = (of(positions) for positions, _ in (his, mine, usual))
	percent = lambda value: f'{100 * (value / theirs - 1):+.4f} %'
	return [title, f'{theirs:.9f}', f'{same:.9f}', percent(same), f'{default:.9f}', percent(default)]
