# SPDX-License-Identifier: GPL-2.0-or-later
"""Presses soil that softens to twice the displacement of its peak, on three grids: with nonlocalLength, and without.

	scripts/softening                 a block, 1 m by 2 m, that is shortened; a quarter of an hour of one core, two thirds of it for the finest grid
	scripts/softening --lengths 0.2 --cells 10 20
	scripts/softening --body slope    a slope of 45 degrees, 4 m high, on the whole crest of which, 4 m wide, a smooth plate sinks; a quarter of an hour

The load is the mean vertical Kirchhoff stress of the block, and of the slope the reaction of the plate over its width. The width is (sum of a V)^2 / (sum of a^2 V) with the plastic
strain a, over the length of the block's band, 1 m / sin 60 degrees: that of a band with the same a all over, and no less than a cell. Of the slope it is that along a horizontal, of
the points from 2 m to 3 m above the toe. The plastic strain of all cases is drawn as a picture, softening.png, of the slope slope.png. All cases are in results/softening.csv, and
are not run again.
"""
import os

study = 'classes'
lengthsOf = dict(block=[0.2, 0.], slope=[0.6, 0.])
cellsOf = dict(block=[10, 20, 40], slope=[4, 8, 16])
files = dict(block='softening-a-block-between-smooth-plates.csv', slope='softening-a-slope-under-a-plate.csv')
titles = dict(block='Softening: a block between smooth plates', slope='Softening: a slope under a plate')
notes = dict(
        block='1 m x 2 m, c = 20 kPa, of which 5 kPa are left at *softeningStrain* = 0.02, phi = 30 degrees, E = 40 MPa, a weaker spot at one side:',
        slope='45 degrees, 4 m high, crest 4 m wide, c = 20 kPa, of which 4 kPa are left at a plastic strain of 1/150, phi = 20 degrees, E = 120 MPa, without weight:')


def main(study, arguments):
	study.option('--body', choices=list(files), default='block')
	study.option('--lengths', nargs='*', type=float, help='of nonlocalLength [m] (default 0.2 and 0, of the slope 0.6 and 0)')
	study.option('--cells', nargs='*', type=int, help='in 1 m (default 10, 20 and 40, of the slope 4, 8 and 16)')
	options = study.parse(arguments, timeLimit=3600)
	body, lengths, cells = options.body, options.lengths or lengthsOf[options.body], options.cells or cellsOf[options.body]
	table = study.table(['body', 'length', 'cells'], ['peak', 'at', 'late', 'width', 'why'])
	image = lambda key: os.path.abspath(os.path.join(options.out, 'results', f'{key[0]}-{key[1]:g}-{key[2]}.npz'))
	keys = [(body, length, number) for length in lengths for number in cells]
	study.fill(table, [(key, 'softening.press', dict(zip(('body', 'length', 'cells'), key), image=image(key))) for key in keys], options.time_limit, ['peak', 'at', 'late', 'width', 'why'])
	rows = [['nonlocalLength', 'cells over 1 m', 'peak [kPa]', 'at [mm]', 'at twice that [kPa]', 'width [m]'], *(rowOf(table.row(key)) for key in keys)]
	study.write([(files[body], titles[body], rows, notes[body])])
	picture(lengths, cells, lambda *key: image((body, *key)), os.path.join(options.out, 'softening.png' if body == 'block' else 'slope.png'))


def rowOf(row):
	begin = [f"{float(row['length']):g} m" if float(row['length']) else 'none', row['cells']]
	if row['why']: return [*begin, row['why'], '', '', '']
	peak, at, late, width = (float(row[name]) for name in ('peak', 'at', 'late', 'width'))
	return [*begin, f'{peak / 1e3:.2f}', f'{at * 1e3:.1f}', f'{late / 1e3:.2f}', f'{width:.3f}']


def picture(lengths, cells, image, path):
	"""Plastic strain, of which each length has its own scale: with less of it than the most strained hundredth of the points has."""
	import matplotlib
	matplotlib.use('Agg')
	import matplotlib.pyplot as plt
	import numpy as np
	figure, panels = plt.subplots(len(lengths), len(cells), figsize=(3 * len(cells), 2 * len(lengths)), sharex=True, sharey=True, squeeze=False, layout='constrained')
	for length, row in zip(lengths, panels):
		results = {number: np.load(image(length, number)) for number in cells if os.path.exists(image(length, number))}
		if not results: continue
		most = np.nanpercentile(np.concatenate([result['strain'].ravel() for result in results.values()]), 99)
		for number, axes in zip(cells, row):
			if number not in results: continue
			x, y = results[number]['box']
			drawn = axes.imshow(results[number]['strain'], origin='lower', extent=(0, x, 0, y), cmap='magma_r', vmin=0, vmax=most)
			axes.set_title(f"{f'nonlocalLength = {length:g} m' if length else 'none'}, cells of {1 / number:g} m", fontsize=8)
		figure.colorbar(drawn, ax=row, label='plastic strain [-]')
	figure.savefig(path, dpi=75)
