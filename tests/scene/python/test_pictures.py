# SPDX-License-Identifier: GPL-2.0-or-later
"""mpm.plot and mpm.colour: what they draw, taken from matplotlib's objects and YADE's shapes."""
import pytest
from conftest import outcomesOf

refused = [
        ('mpm.plot("sress_xy")', 'ValueError', ["'sress_xy'", 'stress', 'displacement']),
        ('mpm.plot("stress")', 'ValueError', ["'stress'", 'stress_xy']),
        ('mpm.plot("stress_x")', 'ValueError', ["'stress_x'", 'stress_xx']),
        ('mpm.plot(np.zeros(3))', 'ValueError', ['field', '32 material points']),
        ('mpm.plot(np.full(32, nan))', 'ValueError', ['field[0]', 'finite']),
        ('mpm.plot(range=(1, 0))', 'ValueError', ['range = (1, 0)', 'increasing']),
        ('mpm.plot(range=3)', 'TypeError', ['range = 3', 'pair']),
        ('mpm.plot(colormap="rainbows")', 'ValueError', ["'rainbows'", 'viridis']),
        ('mpm.plot(deformed=False, grid=True)', 'ValueError', ['grid', 'deformed=True']),
        ('mpm.plot(plane=("z", 0))', 'ValueError', ['plane', 'dim=2']),
        ('mpm.plot(fileName="x.docx")', 'ValueError', ["'x.docx'", '.png']),
        ('mpm.plot(vectors="stress")', 'ValueError', ["vectors = 'stress'", 'displacement']),
        ('mpm.plot(vectors=np.zeros((3, 3)))', 'ValueError', ['vectors', '(32, 3)']),
        ('mpm.plot(contours=0)', 'ValueError', ['contours = 0']),
        ('mpm.plot(contours=[2, 1])', 'ValueError', ['contours = [2, 1]', 'increasing']),
        ('mpm.movie("x.avi")', 'ValueError', ["'x.avi'", '.gif']),
        ('mpm.movie("x.gif", every=0)', 'ValueError', ['every = 0']),
        ('mpm.movie("x.gif", fps=-1)', 'ValueError', ['fps = -1']),
        ('mpm.movie("x.gif", "sress")', 'ValueError', ["'sress'"]),
        ('mpm.plot(solver=3)', 'TypeError', ['solver = 3', 'MpmImplicitEngine']),
        ('O.engines += [MpmImplicitEngine()]; mpm.plot()', 'ValueError', ['2 MpmImplicitEngine', 'solver']),
        ('O.bodies.clear(); mpm.plot()', 'ValueError', ['no material points']),
        ('mpm.colour("plasticstrain")', 'ValueError', ["'plasticstrain'", 'plasticStrain']),
        ('mpm.colour("volume", range=(2, 1))', 'ValueError', ['colour: range = (2, 1)']),
]


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	setting = 'from math import nan\nfrom scenes import *\n'
	return outcomesOf(tmp_path_factory.mktemp('pictures'), setting, [statement for statement, _, _ in refused], before='O.reset(), column(8)')


@pytest.mark.parametrize('statement, exception, words', refused, ids=[statement for statement, _, _ in refused])
def test_isRefused(outcomes, statement, exception, words):
	kind, sentence = outcomes[statement]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence


def test_planeStrain(yade):
	run = yade('''
import json
from scenes import *
solver = slope()
O.run(20, wait=True)
points = mpm.arrays()
ax = mpm.plot('stress_xy', grid=True, ghost=True, fileName='out/slope.png')
boundary, cells, matter, faces = ax.collections
area = lambda q: abs(0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(q, np.roll(q, -1, axis=0))))
areas = [area(path.vertices[:4]) for path in matter.get_paths()]
result = dict(
    boundary=[len(boundary.get_paths()), solver.boundaryCells], cells=[len(cells.get_paths()), solver.activeCells], faces=[len(faces.get_paths()), solver.ghostFaces],
    volume=float(np.abs(np.array(areas) / points['volume'] - 1).max()), value=float(np.abs(matter.get_array() * 1e3 - points['stress'][:, 0, 1]).max()),
    label=ax.child_axes[0].get_ylabel(), axes=[ax.get_xlabel(), ax.get_ylabel(), ax.get_title()], aspect=ax.get_aspect(), symmetric=sum(matter.get_clim()))
first = mpm.plot('displacement_y', deformed=False, range=(-1, 0), fileName='out/first.pdf')
result['first'] = [len(first.collections), sorted(first.dataLim.get_points()[1]), first.collections[0].get_clim(), first.get_title()]
from matplotlib.figure import Figure
arrows = lambda *limits: mpm.plot('displacement_y', deformed=False, range=limits, ax=Figure().add_subplot()).child_axes[0]._colorbar.extend
result['arrows'] = [arrows(-1, -.5), arrows(-1, 9), arrows(-9, -.5), arrows(-9, 9)]
first.set_title('mine')
result['array'] = mpm.plot(points['pos0'][:, 0], grid=False, ghost=False, ax=first) is first
result['titles'] = [result['first'].pop(), first.get_title()]
print(json.dumps(result))
''')
	result = run.result
	# the engine counted at the start of its last step, the picture shows its end: the same kind of numbers, not
	# always the same
	for name in 'boundary', 'cells', 'faces':
		drawn, counted = result[name]
		assert drawn > 0 and abs(drawn - counted) <= 0.1 * counted
	assert result['volume'] < 1e-9 and result['value'] < 1e-9
	assert result['label'] == 'stress $\\sigma_{xy}$ [kPa]' and result['aspect'] == 1 and result['symmetric'] == 0
	assert result['axes'] == ['x [m]', 'y [m]', 'load factor 0.5'] and result['titles'] == ['load factor 0.5, at the initial positions', 'mine']
	assert result['arrows'] == ['both', 'min', 'max', 'neither']
	assert result['first'] == [1, [12, 30], [-1, 0]] and result['array']
	assert (run.folder / 'out/slope.png').stat().st_size > 30000 and (run.folder / 'out/first.pdf').read_bytes()[:4] == b'%PDF'


def test_sliceAndColours(yade):
	"""Slices of a column of cubes have the area that its volume tells, wherever they are; colours are those of the map."""
	areas, cells, colours, limits, constant = yade('''
import json
from scenes import *
solver = column(8, dim=3, width=2)
O.run(10, wait=True)
def area(q): return abs(0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(q, np.roll(q, -1, axis=0))))
def drawn(plane): return {c.get_zorder(): c for c in mpm.plot('stress_yy', grid=True, ghost=True, plane=plane, fileName='out.png').collections}  # 2: matter, 3: cells
h, points = solver.grid.cellSize, mpm.arrays()
side = points['volume'].sum() / (2 * h)
areas = [sum(area(path.vertices[:-1]) for path in drawn(plane)[2].get_paths()) / expected for plane, expected in
         ((('z', h), side), (None, side), (('x', 1.3 * h), side), (('y', 3 * h), 4 * h * h))]
rows = np.ceil((points['pos'] + points['halfSize'])[:, 1].max() / h)
cells = [len(drawn(plane)[3].get_paths()) / expected for plane, expected in ((('z', h), 2 * rows), (('y', 3 * h), 4))]
low, high = mpm.colour('pos0_y')
import matplotlib
share = (points['pos0'][:, 1] - low) / (high - low)
colours = max((O.bodies[int(i)].shape.color - Vector3(*matplotlib.colormaps['viridis'](s)[:3])).norm() for i, s in zip(points['id'], share))
limits = mpm.colour('stress_yy', range=(-1e3, 0))
print(json.dumps([areas, cells, colours, limits, mpm.colour('material')]))
''').result
	assert all(abs(a - 1) < 1e-6 for a in areas), areas
	assert cells == [1, 1]
	assert colours < 1e-9 and limits == [-1000, 0] and constant == [-1, 1]


def test_arrows_lines_and_films(yade):
	"""Arrows are the displacements, lines have the values that are asked for; a film has a picture for every second step, and the first and last state."""
	run = yade('''
import json, os
from scenes import *
solver = column(8, dim=2, width=2)
film = mpm.movie('out/column.gif', 'stress_yy', every=2, range=(-1e4, 0), size=(4, 4))
history = mpm.histories([0], record=['displacement'])
line = history.plot('displacement_y', fileName='out/history.png', live=True).lines[0]
O.run(5, wait=True)
for callback, args, kw in line.figure.follow.callbacks: callback(*args, **kw)
film.finish()
from PIL import Image
with Image.open('out/column.gif') as image: frames = image.n_frames
points = mpm.arrays()
ax = mpm.plot('stress_yy', vectors='displacement', contours=[-2e3, -1e3], fileName='out/arrows.png')
from matplotlib.quiver import Quiver
arrows = next(c for c in ax.collections if isinstance(c, Quiver))
moved = points['pos'] - points['pos0']
nearest = [int(((points['pos'][:, :2] - xy)**2).sum(1).argmin()) for xy in arrows.XY]
print(json.dumps([frames, film.frames, [e.label for e in O.engines], sorted(os.listdir('out')), float(abs(np.column_stack([arrows.U, arrows.V]) - moved[nearest][:, :2]).max()), len(arrows.U),
	len(line.get_xdata()), mpm.plot('stress_yy', contours=3, grid=False, ghost=False, fileName='out/lines.png') is not None]))
''')
	frames, counted, labels, files, off, arrows, times, drawn = run.result
	assert frames == counted == 4 and not [label for label in labels if label.startswith('movie')]
	assert files == ['arrows.png', 'column.gif', 'history.png'] and off == 0 and arrows > 10 and times == 6 and drawn


def test_labelsDoNotOverlap(yade):
	"""Labels of wide, narrow and small pictures, slices with the small view beside them, and all that can be on top; the check finds texts that do."""
	found = yade('''
import json
from labels import overlaps
from scenes import *
from matplotlib.figure import Figure
found = {}
def look(name, *arguments, **options): found[name] = overlaps(mpm.plot(*arguments, fileName='out.png', **options).figure)
slope()
O.run(10, wait=True)
look('slope', 'stress_xy')
look('all', 'displacement_y', grid=True, ghost=True, vectors='displacement', contours=3)
O.reset(), column(40), O.run(2, wait=True)
look('narrow', 'stress_yy', grid=True, ghost=True, vectors='displacement')
O.reset(), column(8, dim=3, width=2), O.run(2, wait=True)
look('slice', 'stress_yy')
look('level', 'displacement', plane=('y', 3.), grid=True)
figure = Figure()
figure.add_subplot(111).set_title('one'), figure.add_subplot(111).set_title('two')
found['wrong'] = overlaps(figure)
print(json.dumps(found))
''').result
	wrong, _ = found.pop('wrong')
	assert ['two', 'one'] in wrong
	assert all(number > 8 for _, number in found.values()) and not {name: pairs for name, (pairs, _) in found.items() if pairs}


def test_needlesAreDots(yade):
	"""A point that is drawn out six to one is a disc as large as its box was; the legend says so, and one of four to one is drawn as it is."""
	names, sides, areas, kept = yade('''
import json
from scenes import *
solver = column(8, dim=2, width=2)
O.run(1, wait=True)
ids = mpm.arrays()['id'][:2]
mpm.assign(ids=ids, defGrad=[np.diag([np.sqrt(r), 1 / np.sqrt(r), 1]) for r in (6, 4)])
ax = mpm.plot('plasticStrain', loads=False, fileName='out.png')
matter = ax.collections[0]
area = lambda q: abs(0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(q, np.roll(q, -1, axis=0))))
paths = [path.vertices[:-1] for path in matter.get_paths()]
whole = 4 * np.prod(mpm.arrays()['halfSize0'][0, :2])
print(json.dumps([[t.get_text() for t in ax.get_legend().get_texts()], [len(path) for path in paths], [area(paths[0]) / whole, area(paths[-1]) / whole], len(paths) == len(mpm.arrays()['id'])]))
''').result
	assert names == ['dots: 1 points strongly stretched, more than 5 : 1'] and sides.count(12) == 1 and sides[-1] == 12 and kept
	assert abs(areas[0] - 1) < 1e-9 and abs(areas[1] - 12 / 3.141592653589793 * 0.25) < 0.01  # area of twelve corners on the circle


def test_coloursTitlesAndUnits(yade):
	"""One map for each quantity whatever its values, with zero in the middle of its colours; titles say the time, the load factor or the stage; small displacements are in mm."""
	result = yade('''
import json
from scenes import *
from matplotlib import colormaps
result = {}
solver = column(8, dim=2, width=2)
O.run(4, wait=True)
def drawn(field, **options):
	ax = mpm.plot(field, fileName='out.png', **options)
	return ax, ax.collections[0]
ax, matter = drawn('plasticStrain')
result['plastic'] = matter.get_cmap().name, ax.get_title()
ax, matter = drawn('stress_yy', range=(-1e4, 0))
result['zero'] = float(abs(np.array(matter.get_cmap()(1.)) - colormaps['RdBu_r'](0.5)).max()), float(abs(np.array(matter.get_cmap()(0.)) - colormaps['RdBu_r'](0.)).max())
ax, matter = drawn('stress_yy', range=(-1e4, 1e4))
result['both'] = float(abs(np.array(matter.get_cmap()(0.5)) - colormaps['RdBu_r'](0.5)).max())
O.reset(); solver = column(8, dim=2, width=2); O.materials[0].young *= 1e4; O.run(1, wait=True)
ax, matter = drawn('displacement')
moved = mpm.arrays()
result['mm'] = ax.child_axes[0].get_ylabel(), float(matter.get_array().max() / np.linalg.norm(moved['pos'] - moved['pos0'], axis=1).max())
mpm.stages.excavate(mpm.polygon([(-1, 40), (99, 40), (99, 60), (-1, 60)]), steps=4)
O.run(3, wait=True)
result['stage'] = drawn('displacement')[0].get_title()
O.reset(); solver = column(8, dim=2, width=2)
O.engines = [MpmDynamicEngine(grid=solver.grid, gravity=solver.gravity, boundaries=solver.boundaries, verbosity=0)]
O.dt = 1e-3
O.run(5, wait=True)
result['time'] = drawn('velocity_y')[0].get_title()
from yade.mpm.output.plotting import _across
result['across'] = [int(_across(*case)) for case in (((0, 0, -10), (3, 2, 5)), ((0, 0, -10), (2, 3, 5)), ((1, 0, -10), (2, 2, 5)), ((0, -10, 0), (2, 9, 2)), ((0, 0, 0), (1, 2, 3)))]
print(json.dumps(result))
''').result
	assert result['across'] == [1, 0, 1, 2, 2]
	assert result['plastic'] == ['YlOrRd', 'load factor 0.1']
	assert result['zero'] == pytest.approx([0, 0], abs=0.01) and result['both'] == pytest.approx(0, abs=0.01)
	assert result['mm'][0] == 'displacement [mm]' and result['mm'][1] == pytest.approx(1000)
	assert result['stage'] == 'excavating, step 3 of 4' and result['time'] == 'time 0.005 s'


def test_picturesOfExamplesAreLookedAt(yade):
	"""A script in a folder of examples that saves texts over each other does not pass."""
	script = yade.folder / 'examples' / 'wrong.py'
	script.parent.mkdir()
	script.write_text("from matplotlib.figure import Figure\nfigure = Figure()\nfor word in 'one', 'two': figure.add_subplot(111).set_title(word)\nfigure.savefig('wrong.png')\n")
	with pytest.raises(AssertionError, match='labels overlap in wrong.png'):
		yade(script)
	assert (yade.folder / 'wrong.png').exists()
