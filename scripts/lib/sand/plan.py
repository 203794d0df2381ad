# SPDX-License-Identifier: GPL-2.0-or-later
"""Plan of scripts/sand: groups of cases, each a function of this package, the words that name the case, and its arguments."""

grids = 4, 8, 16
problems = {
        'N_gamma smooth, 20': dict(phi=20),
        'N_gamma rough, 20': dict(phi=20, isRough=True),
        'N_gamma smooth, 30': dict(phi=30),
        'N_gamma rough, 30': dict(phi=30, isRough=True),
        'N_q, 20': dict(phi=20, load='surcharge'),
        'N_q, 30': dict(phi=30, load='surcharge'),
        'N_c, 20': dict(phi=20, load='cohesion'),
        'N_c, 30': dict(phi=30, load='cohesion')}


def factors():
	"""Limit loads over grids, with one and with two by two points per cell, and with the ghost on all faces."""
	for how, settings in {'1 x 1': dict(points=1), '1 x 1, all faces': dict(points=1, where='boundary'), '2 x 2': dict(points=2)}.items():
		for name, arguments in problems.items():
			for cells in grids:
				yield 'strip.strip', (name, how, f'B/{2 * cells + 1}'), arguments | settings | dict(cells=cells)


def early():
	"""N_gamma with one point per cell after a quarter of the settlement, where the strip has its limit load and points have not yet been squeezed out beside its edge; in more and fewer steps on one of the grids."""
	for name, arguments in list(problems.items())[:4]:
		for cells in grids:
			yield 'strip.strip', (name, '10 steps', f'B/{2 * cells + 1}'), arguments | dict(points=1, settlement=2.5e-4, steps=10, cells=cells)
	for name in 'N_gamma smooth, 20', 'N_gamma smooth, 30':
		for number in 40, 160, 640:
			yield 'strip.strip', (name, f'{number} steps', 'B/17'), problems[name] | dict(points=1, settlement=2.5e-4, steps=number)


def rigid():
	"""The same with soil ten and a hundred times as stiff, which moves by as much less until it fails: what is left then is the limit load of ground that has not moved."""
	for times, runs in (10, (10, 40)), (100, (10, )):
		still = dict(points=1, settlement=2.5e-4 / times, stiff=1e4 * times)
		for name, arguments in list(problems.items())[:4]:
			for number in runs:
				for cells in grids:
					yield 'strip.strip', (name, f'E x {times}, {number} steps', f'B/{2 * cells + 1}'), arguments | still | dict(steps=number, cells=cells)
		for name in 'N_gamma smooth, 20', 'N_gamma smooth, 30':
			for number in (160, 640) if 40 in runs else (40, 160, 640):
				yield 'strip.strip', (name, f'E x {times}, {number} steps', 'B/17'), problems[name] | still | dict(steps=number)
	for name in 'N_gamma smooth, 20', 'N_gamma smooth, 30':
		for number in 10, 40, 160, 640:
			yield 'strip.strip', (name, f'E x 10, {number} steps, factor 1e-4', 'B/17'), problems[name] | dict(points=1, settlement=2.5e-5, stiff=1e5, steps=number, factor=1e-4)


def limit():
	"""One setting for N_gamma and steps: soil so stiff that the ground does not move, a stabilisation a tenth as strong, and so little cohesion that it does not matter that its load and that of the weight are more together than their sum."""
	setting = dict(points=1, settlement=2.5e-6, stiff=1e6, factor=1e-3, cohesion=1e-4)
	for name, arguments in list(problems.items())[:4]:
		for cells in grids:
			yield 'strip.strip', (name, '40 steps', f'B/{2 * cells + 1}'), arguments | setting | dict(cells=cells)
	for name, arguments in list(problems.items())[:4]:
		for number in 10, 160, 640:
			yield 'strip.strip', (name, f'{number} steps', 'B/17'), arguments | setting | dict(steps=number)
	for name, arguments in list(problems.items())[:4]:
		for cohesion in 3e-4, 1e-3:
			for cells in grids:
				yield 'strip.strip', (name, f'40 steps, c {cohesion:g}', f'B/{2 * cells + 1}'), arguments | setting | dict(cells=cells, cohesion=cohesion)


def box():
	"""The setting of the group limit, and the strip as a rigid Box with MpmContact, its edge on a line of the grid: cells of one size, halved at the edge, and halved below the strip."""
	setting = dict(points=1, settlement=2.5e-6, stiff=1e6, factor=1e-3, cohesion=1e-4)
	kinds = {'cells of one size': dict(halvings=0), 'halved at its edge': dict(halvings=1), 'halved to B beside and B / 2 below its middle': dict(halvings=0, finer=(1, .5))}
	for name in 'N_gamma smooth, 30', 'N_gamma rough, 30':
		for cells in 8, 16:
			for kind, arguments in kinds.items(): yield 'strip.strip', (name, f'Box, {kind}', f'B/{2 * cells}'), problems[name] | setting | arguments | dict(cells=cells)


def causes():
	"""Causes for the load of the smooth strip, 20 degrees, B/17, one point a cell, to depend on the number of steps: one thing changed at a time."""
	stiff, stiffer = dict(stiff=1e5, settlement=2.5e-5), dict(stiff=1e6, settlement=2.5e-6)
	changes = {
	        'E of 1e4': {},
	        'tolerance 1e-9': dict(tolerance=1e-9),
	        'no F-bar': dict(fBar=False),
	        'no memory': dict(memory=0),
	        'factor 1e-4': dict(factor=1e-4),
	        'E x 10': stiff,
	        'E x 100': stiffer,
	        'E x 100, no memory': stiffer | dict(memory=0),
	        'E x 100, all faces': stiffer | dict(where='boundary'),
	        'E x 100, factor 1e-4': stiffer | dict(factor=1e-4)}
	for name, change in changes.items():
		for number in 10, 40, 160, 640:
			yield 'strip.strip', (name, f'{number} steps', 'B/17'), dict(phi=20, points=1, settlement=2.5e-4, steps=number) | change


def parts():
	"""Causes of the load of the smooth strip, 20 degrees, B/17: one thing changed at a time."""
	changes = {
	        '2 x 2 points': {},
	        '1 point': dict(points=1),
	        '3 x 3 points': dict(points=3),
	        'no F-bar': dict(fBar=False),
	        'pressureRelaxation': dict(relaxation=True),
	        '1 point, no F-bar': dict(points=1, fBar=False),
	        'ghost on all faces': dict(where='boundary', memory=0),
	        'ghost on all faces, memory 1': dict(where='boundary'),
	        'aggregates without memory': dict(memory=0),
	        'ghost times 0.1': dict(factor=1e-3),
	        'ghost times 0.01': dict(factor=1e-4),
	        '10 steps': dict(steps=10),
	        '160 steps': dict(steps=160),
	        'tolerance 1e-9': dict(tolerance=1e-9),
	        'E times 10': dict(stiff=1e5),
	        'settlement 0.01 B': dict(settlement=1e-2)}
	for name, change in changes.items():
		yield 'strip.strip', (name, '', 'B/17'), dict(phi=20) | change


def steps():
	"""The same load in more and fewer steps."""
	ghosts = {
	        'ghost as for sand': {},
	        'ghost times 0.1': dict(factor=1e-3),
	        'ghost times 0.01': dict(factor=1e-4),
	        'all faces, memory 1': dict(where='boundary'),
	        'all faces (default)': dict(where='boundary', memory=0)}
	for name, ghost in ghosts.items():
		for number in 10, 40, 160, 640:
			yield 'strip.strip', (name, f'{number} steps', 'B/17'), dict(phi=20, steps=number) | ghost


def walls():
	"""A smooth wall, away from the sand and into it."""
	for points in 1, 2:
		for phi in 20, 30:
			for isPassive in False, True:
				for cells in 5, 10, 20:
					name = f"K {'passive' if isPassive else 'active'}, {phi}"
					yield 'wall.wall', (name, f'{points} x {points}', f'H/{cells}'), dict(phi=phi, isPassive=isPassive, cells=cells, points=points)


def cuts():
	"""Condition numbers, elastic and where all points yield, in cells that are filled by less and less."""
	ghosts = {
	        'no stabilisation': dict(factor=0, fBar=False),
	        'all faces (default)': {},
	        'aggregates, memory 1': dict(where='aggregates', memory=1),
	        'aggregates, memory 1, factor 1e-3': dict(where='aggregates', memory=1, factor=1e-3),
	        'aggregates, memory 1, factor 1e-4': dict(where='aggregates', memory=1, factor=1e-4)}
	for dim, parts in (2, (.5, .3, .1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8)), (3, (.5, .1, 1e-4, 1e-8)):
		for flows in False, True:
			for name, ghost in ghosts.items():
				for cut in parts:
					yield 'cuts.condition', (f"{'flowing' if flows else 'elastic'}, {dim}D", name, f'{cut:g}'), dict(cut=cut, flows=flows, dim=dim) | ghost


groups = dict(factors=factors, early=early, rigid=rigid, limit=limit, box=box, causes=causes, parts=parts, steps=steps, walls=walls, cuts=cuts)
