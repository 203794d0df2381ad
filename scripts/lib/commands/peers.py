# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares the plugin with finite elements of other programs: five scenes, the same quantity and distance of nodes, error and time.

	scripts/peers                              all of them; ten minutes on one core
	scripts/peers --scenes footing beam        some scenes
	scripts/peers --programs CalculiX          beside one of CalculiX, GetFEM and FEniCS
	scripts/peers --ample FOLDER               beside AMPLE GS in Octave, all of its set-ups, point by point; an hour on one core

The programs are Debian packages: calculix-ccx, python3-getfem and python3-dolfin (bookworm). Scenes are in scripts/lib/peers/scenes.py: a strip on clay (Prandtl), a cavity in clay,
consolidation (Terzaghi), a beam on an elastic layer, an embankment in lifts. Finite elements take small strains, the plugin large ones; loads are small enough that this changes
less than 0.5 %. Nodes are h apart: quadratic elements are twice as large as linear ones. Seconds are the least of three runs on one thread: of CalculiX the whole program, of the
others from the mesh to the result, without the start of Python. All cases are in results/peers.csv, and are not run again.
"""
import os

from peers import ample
from peers.programs import cases, lacking, ours, programs, run, version
from peers.scenes import scenes

study = 'peers'
values = ['value', 'unknowns', 'seconds', 'why']
repeats = 3


def main(study, arguments):
	study.option('--scenes', nargs='*', metavar='SCENE', default=[], help=f"some of {', '.join(scenes)}")
	study.option('--programs', nargs='*', metavar='PROGRAM', default=[], help=f"some of {', '.join(programs)}, or none")
	study.option('--ample', metavar='FOLDER', help='checkout of branch AMPLE-GS of github.com/wmcoombs/AMPLE-m; only its set-ups are run, with --quick the first')
	options = study.parse(arguments, timeLimit=300, quick='coarsest sizes only, one run of each')
	if options.ample:
		made = list(ample.compare(study, options.ample, list(ample.kinds)[:1 if options.quick else None], 20 * options.time_limit))
		return study.write(made, command=f'`scripts/peers --ample FOLDER`, {study.provenance}')
	chosen = study.chosen(options.scenes, scenes, 'scene')
	others = [] if options.programs == ['none'] else study.chosen(options.programs, programs, 'program')
	missing = [f'{name} (package {programs[name].package})' for name in others if not version(name)]
	if missing: study.fail(f"{', '.join(missing)}: not installed. Install the packages of Debian, or name other programs with --programs.")
	times = 1 if options.quick else repeats
	isCoarsest = lambda scene, size: not options.quick or size == scenes[scene].sizes[0]
	table = study.table(['scene', 'program', 'elements', 'size'], values)
	own = [(scene, 'plugin', kind, size) for scene in chosen for kind in ours for size in scenes[scene].sizes if isCoarsest(scene, size)]
	study.fill(table, [(key, 'peers.ours.best', dict(scene=key[0], size=key[3], fBar=ours[key[2]], repeats=times)) for key in own], options.time_limit, values)
	theirs = [(scene, name, kind, size) for scene in chosen for name in others for kind, size in cases(name, scene) if isCoarsest(scene, size)]
	for key in theirs:
		if key in table: continue
		scene, name, kind, size = key
		found = min((run(name, scene, size, kind, options.time_limit) for _ in range(times)), key=lambda found: found.get('seconds', 0))
		table.add([dict.fromkeys(values, '') | found | dict(zip(table.keys, key))])
		print(*key, *(table.row(key)[column] for column in values), flush=True)
	study.write(tables({scene: [table.row(key) for key in own + theirs if key[0] == scene] for scene in chosen}, others))
	picture({scene: [table.row(key) for key in own + theirs if key[0] == scene] for scene in chosen}, os.path.join(options.out, 'peers.png'))


def tables(found, others):
	"""Programs, and the results of each scene: error of the value against what is exact or converged."""
	listed = [['program', 'package', 'version', 'scenes that it does not do'], *([name, programs[name].package, version(name), lacking(name) or '-'] for name in others)]
	yield 'programs.csv', 'Programs', listed
	for scene, rows in found.items():
		of = scenes[scene]
		shown = [['program', 'elements', 'h [m]', 'unknowns', 'value', 'error', 'seconds']]
		for row in rows:
			h = f'{of(int(row["size"])).h:.4g}'
			if row['why']: shown.append([row['program'], row['elements'], h, '', row['why'], '', ''])
			else: shown.append([row['program'], row['elements'], h, row['unknowns'], f"{float(row['value']):.5g}", f'{100 * error(row):+.2f} %', f"{float(row['seconds']):.2g}"])
		yield f'{scene}.csv', of.quantity[0].upper() + of.quantity[1:] + f' [{of.unit}]' * bool(of.unit), shown, f'Compared with {of.exact:.5g} ({of.source}).'
	yield 'peers.png', 'Error and time', None


def error(row):
	return float(row['value']) / scenes[row['scene']].exact - 1


def picture(found, path):
	"""Error over seconds of each scene; a line is one kind of elements, by size."""
	import matplotlib
	matplotlib.use('Agg')
	import matplotlib.pyplot as plt
	figure, panels = plt.subplots(2, 3, figsize=(11, 6.5), layout='constrained')
	colours = dict(zip(['plugin', *programs], ['k', 'C0', 'C1', 'C2']))
	kinds, lines = {name: list(module.kinds) for name, module in programs.items()} | dict(plugin=list(ours)), {}
	for ax, (scene, rows) in zip(panels.flat, found.items()):
		for name, kind in dict.fromkeys((row['program'], row['elements']) for row in rows):
			of = [row for row in rows if (row['program'], row['elements']) == (name, kind) and not row['why']]
			style = ('-o', '--s')[kinds[name].index(kind)]
			x, y = [float(row['seconds']) for row in of], [max(100 * abs(error(row)), 1e-3) for row in of]
			lines[f'{name}, {kind}'], = ax.plot(x, y, style, color=colours[name], markersize=4)
		ax.set(xscale='log', yscale='log', title=scenes[scene].quantity, xlabel='time [s]', ylabel='error [%]')
	for ax in list(panels.flat)[len(found):]: ax.axis('off')
	panels[-1, -1].legend(lines.values(), lines, loc='center', frameon=False)
	figure.savefig(path, dpi=110)
	plt.close(figure)
