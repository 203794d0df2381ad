# SPDX-License-Identifier: GPL-2.0-or-later
"""Builds small scenes from pairs and triples of features and asks of each what must not depend on how it is looked at.

	scripts/pairs                      every pair of features in at least 20 scenes; about half an hour on two cores
	scripts/pairs --seeds 0:100        the first hundred scenes of the same list
	scripts/pairs --only 17            one scene, with all that differs
	scripts/pairs --only 17 --script bad.py   the same scene as a script for YADE that needs nothing of this
	scripts/pairs --kind flow          a hundred scenes of one kind, or of 'all' kinds; --seeds, --only and --script as above

Each scene is run as it is, mirrored, turned by a quarter, shifted by whole cells, in other units (powers of two, of stress powers of four), with bodies in another order, saved and
loaded in mid-run, and with two threads. Bits are asked for where nothing but exact operations differ (again, other units, saved and loaded, threads), elsewhere 1e-9 of the largest
of each quantity. Static scenes are in balance, those by Newmark keep their momentum, and a fixed smooth body gives no energy. A pair that is not supported is refused by a sentence
that has the words in scripts/lib/pairs/features.py.

Scenes of a kind (scripts/lib/pairs/kinds.py: rigid bodies, bodies of points, water that flows or stands, structures, laws, energy) are compared with the same copies, to 1e-9 or
the bound of the kind, and with two more: half the cell size and half the time step, whose means of displacements, stresses, forces and energies may differ by the bounds of the
kind. A line of a beam is drawn backwards with the bodies in another order. Other units are compared to 1e-9 for NorSand, which takes logarithms of pressures, for beams, whose
displacements and rotations have no common scale, and for facets in the plane. Forces of static scenes balance to 1e-8, the energy of those in time to 2 to 10 percent where it is
known. Where copies differ, the findings say what gravity that is larger by 1e-14 changes: as much where round-off decides, nothing where the position does. Left out as known: mirrored
and turned bodies of points in 3D (triangles of the surface), bodies of one cell between others, inclined beams that end in the soil, energy of soils whose elasticity is not Hencky's.

All outcomes are in results/pairs.csv; scenes with findings are tried again. Ends with 1 if there are findings.
"""
from pairs.features import Plan, allPairs, features, ordered, refusals, refused
from pairs.kinds import kinds
from pairs.scene import Scene
from pairs.view import View
from results import seeds

fine = 'right', 'refused', 'stops'


def main(study, arguments):
	study.option('--times', type=int, default=20, metavar='N', help='how often each pair is tried (default %(default)s)')
	study.option('--seeds', type=seeds, metavar='FROM:TO', help='these scenes of the list only')
	study.option('--only', type=int, metavar='SEED', help='this scene only')
	study.option('--kind', choices=[*kinds, 'all'], help='scenes of this kind instead of features in pairs')
	study.option('--script', metavar='FILE', help='with --only: write the scene as a script for YADE instead of checking it')
	options = study.parse(arguments, timeLimit=120, limited='for one scene [s]', processes=2)
	if options.kind == 'all' and options.only is not None: study.fail('--only goes with one kind')
	plan = Plan().until(options.times) if not options.kind else range(100)
	chosen = [options.only] if options.only is not None else options.seeds or range(len(plan))
	if not options.kind and any(seed not in range(len(plan)) for seed in chosen): study.fail(f'there are scenes 0 to {len(plan) - 1}')
	if options.script: return script(study, options, plan)
	names = list(kinds) if options.kind == 'all' else [options.kind] if options.kind else ['']
	scenes = [(name, seed, name or ' '.join(plan[seed])) for seed in chosen for name in names]
	table = study.table(['kind', 'seed', 'scene'], ['outcome', 'findings'])
	table.rows = {key: row for key, row in table.rows.items() if row['outcome'] in fine and row['seed'] != str(options.only)}
	cases = [(key, 'pairs.checks.checkKind', dict(name=key[0], seed=key[1])) if key[0] else (key, 'pairs.checks.check', dict(chosen=plan[key[1]], seed=key[1])) for key in scenes]
	study.fill(table, cases, options.time_limit, ['outcome', 'findings'], reason='outcome', threads=1 if options.kind else 2)
	rows = [table.row(key) for key in scenes]
	study.write(ofKinds(names, rows) if options.kind else ofPairs(rows))
	wrong = [row for row in rows if row['outcome'] not in fine]
	study.summary = f'{len(rows)} scenes, {len(wrong)} with findings. {study.summary}'
	return int(bool(wrong))


def script(study, options, plan):
	"""Write a scene as a script for YADE."""
	if options.only is None: study.fail('--script goes with --only')
	scene = kinds[options.kind](options.only) if options.kind else Scene(plan[options.only], options.only)
	with open(options.script, 'w') as file:
		file.write(f"# {options.kind or ' '.join(plan[options.only])} {options.only}\n" + scene.text(View(scene.dim, scene.isRing)))
		file.write("for step in range(steps):\n\texec(actions.get(step, ''))\n\tO.step()\nfor name, value in O.engines[-1 if O.engines[-1].label else 1].plotData().items():\n\tprint(name, value)\n")
	print(f'written: {options.script}')


def findings(rows):
	return [['seed', 'scene', 'what differs'], *([row['seed'], row['scene'], row['findings'] or row['outcome']] for row in rows if row['outcome'] not in fine)]


def ofKinds(names, rows):
	"""Tables of the outcomes by kind. *stops*: an exception, alike in all copies."""
	counts = [['kind', 'scenes', 'right', 'stop', 'findings']]
	for name in names:
		of = [row['outcome'] for row in rows if row['kind'] == name]
		counts.append([name, len(of), of.count('right'), of.count('stops'), len(of) - of.count('right') - of.count('stops')])
	return [('kinds.csv', 'Scenes of a kind', counts, '*stop*: an exception, alike in all copies.'), ('findings-kinds.csv', 'Scenes of a kind with findings', findings(rows))]


def ofPairs(rows):
	"""Tables of the pairs that were tried."""
	counts = dict.fromkeys(allPairs, 0)
	for row in rows:
		scene = row['scene'].split()
		for pair in refusals(scene) or [ordered(a, b) for i, a in enumerate(scene) for b in scene[i + 1:]]: counts[pair] += 1
	number = {kind: sum(row['outcome'] == kind for row in rows) for kind in ('right', 'refused', 'wrong', 'crash', 'timeout')}
	note = f"{len(rows)} scenes of {len(features)} features, {len(allPairs)} pairs of them in {min(counts.values())} scenes at least: {number['right']} right, {number['refused']} refused by name, "
	note += f"{number['wrong']} with findings, {number['crash']} crashed, {number['timeout']} hung. **r**: refused by name, and tried as often; · : has no meaning together."
	tried = lambda a, b: '·' if ordered(a, b) not in counts else '**r** ' * (ordered(a, b) in refused) + str(counts[ordered(a, b)])
	cells = [[f'{i + 1} {a}', *('' if j >= i else tried(a, b) for j, b in enumerate(features))] for i, a in enumerate(features)]
	return [('pairs.csv', 'How often each feature was tried with which', [['feature', *range(1, len(features) + 1)], *cells], note), ('findings.csv', 'Scenes with findings', findings(rows))]
