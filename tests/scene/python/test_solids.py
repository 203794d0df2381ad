# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions from files of CAD and GIS: closed surfaces and elevation grids, and what is refused about them."""
import pytest

build = '''
import json, struct
from yade import mpm, pack
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, label='soil'))
grid = MpmGrid(cellSize=.5, dim=3)
low, high = (0, 0, 0), (2, 1, 1.5)
corners = [(x, y, z) for z in (0, 1.5) for y in (0, 1) for x in (0, 2)]
sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
triangles = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]

def writeStl(name, triangles, scale=1, binary=False):
	places = [[[scale * x for x in corners[i]] for i in t] for t in triangles]
	if binary:
		with open(name, 'wb') as file:
			file.write(b' ' * 80 + struct.pack('<I', len(places)))
			for t in places: file.write(struct.pack('<12fH', 0, 0, 0, *sum(t, []), 0))
		return name
	with open(name, 'w') as file:
		print('solid box', file=file)
		for t in places:
			print(' facet normal 0 0 0\\n  outer loop', *('   vertex %r %r %r' % tuple(x) for x in t), '  endloop\\n endfacet', sep='\\n', file=file)
		print('endsolid box', file=file)
	return name

def refused(f, *args, **kw):
	try: f(*args, **kw)
	except Exception as error: return f'{type(error).__name__}: {error}'
	return 'nothing was refused'

def filled(region): return len(mpm.fill(region, grid, 2, 'soil'))
'''


def test_boxes_from_stl_and_gts_files_are_filled_as_the_box(yade):
	counts = yade(build + '''
text, binary = writeStl('box.stl', triangles), writeStl('mm.STL', triangles, 1000, binary=True)
surface = mpm.solid(text).surf
edges = sorted({tuple(sorted(e)) for a, b, c in triangles for e in ((a, b), (b, c), (c, a))})
number = lambda a, b: edges.index((min(a, b), max(a, b))) + 1
with open('box.gts', 'w') as file:
	print(len(corners), len(edges), len(triangles), 'GtsSurface GtsFace GtsEdge GtsVertex', file=file)
	for row in corners + [(a + 1, b + 1) for a, b in edges] + [(number(a, b), number(b, c), number(c, a)) for a, b, c in triangles]: print(*row, file=file)
print(json.dumps([filled(pack.inAlignedBox(low, high))] + [filled(r) for r in (mpm.solid(text), mpm.solid(binary, scale=1e-3), mpm.solid('box.gts'),
	mpm.solid(text, shift=(.5, -1, 3)), mpm.solid(text) - pack.inSphere((1, .5, .7), .3))] + [surface.volume(), len(mpm.surface(mpm.solid(text), dim=3).pieces)]))
''').result
	assert counts[0] == 4 * 2 * 3 * 8
	assert counts[1:5] == counts[:1] * 4 and counts[5] < counts[0]
	assert counts[6] == pytest.approx(3) and counts[7] == 12


def test_surfaces_that_are_not_closed_are_refused_with_the_place(yade):
	messages = yade(build + '''
print(json.dumps([refused(mpm.solid, writeStl('hole.stl', triangles[:4] + triangles[6:])), refused(mpm.solid, writeStl('turned.stl', triangles[1:] + [triangles[0][::-1]])),
	refused(mpm.solid, writeStl('twice.stl', triangles + triangles[:2])), refused(mpm.solid, 'nothing.stl'), refused(mpm.solid, writeStl('empty.stl', [])),
	refused(mpm.solid, writeStl('box.obj', triangles)), refused(mpm.solid, writeStl('box.stl', triangles), scale=-1), refused(mpm.solid, 'box.stl', shift=3), refused(mpm.solid, 7)]))
''').result
	hole, turned, twice, missing, empty, kind, scale, shift, path = messages
	assert 'ValueError' in hole and 'hole from (0.0, 0.0, 0.0) to (2.0, 0.0, 1.5), with 4 edges' in hole
	assert 'one is inside out' in turned and '0.5, 0.0)' in turned
	assert 'belongs to' in twice
	assert 'FileNotFoundError' in missing and 'nothing.stl' in missing
	assert 'no triangles' in empty and '.stl or .gts' in kind and 'scale = -1' in scale and 'shift = 3' in shift and 'fileName = 7' in path


def test_files_of_several_solids_are_read_with_all_their_digits(yade):
	"""Two closed cubes in one text file have the volume of two; at coordinates of a national grid a text file loses no digit; what is cut off is refused."""
	(both, far, likeVtk), messages = yade(build + '''
import numpy as np
from yade.mpm.geometry.solids import _ofStl
from vtkmodules.vtkIOGeometry import vtkSTLReader
def moved(shift, name, file):
	print('Solid', name, file=file)
	for t in triangles:
		print('FACET NORMAL 0 0 0', 'outer loop', *('vertex %r %r %r' % tuple(x + s for x, s in zip(corners[i], shift)) for i in t), 'endloop', 'EndFacet', sep='\\n', file=file)
	print('endsolid', name, file=file)
with open('two.stl', 'w') as file:
	moved((0, 0, 0), 'a facet of rock', file)
	moved((5, 0, 0), '', file)
with open('far.stl', 'w') as file: moved((2600000.125, 5400000.375, 0), 'far', file)
reader = vtkSTLReader()
open('lower.stl', 'w').write(open('two.stl').read().replace('Solid ', 'solid ')) # VTK 9.6 takes other spellings for a binary file
reader.SetFileName('lower.stl')
reader.Update()
mesh = reader.GetOutput()
vtk = np.array([[mesh.GetPoint(mesh.GetCell(i).GetPointId(k)) for k in range(3)] for i in range(mesh.GetNumberOfCells())])
text = open('two.stl').read()
open('cut.stl', 'w').write(text[:text.rindex('endloop')])
open('line.stl', 'w').write(text.replace('vertex 0 0 0\\n', '', 1))
open('word.stl', 'w').write(text.replace('vertex 0 0 0', 'vertex 0 x 0', 1))
whole = open(writeStl('binary.stl', triangles, binary=True), 'rb').read()
open('part.stl', 'wb').write(whole[:-30])
open('solid.stl', 'wb').write(b'solid' + whole[5:])
numbers = [mpm.solid('two.stl').surf.volume(), mpm.solid('far.stl', shift=(-2600000, -5400000, 0)).surf.volume(), bool((_ofStl('two.stl') == vtk).all())]
assert (_ofStl('solid.stl') == _ofStl('binary.stl')).all()
assert sorted(set(_ofStl('far.stl')[..., 0].ravel())) == [2600000.125, 2600002.125]
print(json.dumps([numbers, [refused(mpm.solid, f'{name}.stl') for name in ('cut', 'line', 'word', 'part')]]))
''').result
	assert both == pytest.approx(2 * 3) and far == pytest.approx(3) and likeVtk
	for message, words in zip(messages, ('begins 24 facets and ends 23', 'facet 1 has 2 vertices', "'x'", '12 triangles')):
		assert 'ValueError' in message and words in message, message


asc = build + '''
def writeAsc(name, rows, **header):
	header = dict(ncols=len(rows[0]), nrows=len(rows), xllcorner=600000, yllcorner=200000, cellsize=1, NODATA_value=-9999) | header
	with open(name, 'w') as file:
		for key, value in header.items():
			if value is not None: print(key, value, file=file)
		for row in rows: print(*row, file=file)
	return name
'''


def test_terrain_is_filled_down_to_its_bottom(yade):
	"""A plane z = 3 + x / 4 - y / 8: bilinear heights are exact, and so is the volume, to points."""
	count, heights, box, layer, profile = yade(asc + '''
plane = lambda x, y: 3 + x / 4 - y / 8  # x, y from the first corner
writeAsc('dem.asc', [[plane(i, 4 - j) for i in range(6)] for j in range(5)], xllcorner=599999.5, yllcorner=199999.5)
writeAsc('rock.asc', [[plane(i, 4 - j) - 1 for i in range(6)] for j in range(5)], xllcorner=None, yllcorner=None, xllcenter=600000, yllcenter=200000)
ground = mpm.terrain('dem.asc', bottom=0, origin=(600000, 200000))
fine = MpmGrid(cellSize=.25, dim=3)
print(json.dumps([len(mpm.fill(ground, fine, 2, 'soil')) * .125**3, ground.heights([(1, 1), (2.3, .7), (9, 0)]).tolist()[:2], [list(x) for x in ground.aabb()],
	len(mpm.fill(mpm.terrain('dem.asc', bottom='rock.asc', origin=(600000, 200000)), fine, 2, 'soil')) * .125**3,
	filled(mpm.terrain('dem.asc', 0, (600001, 200001), (600003, 200002), (600000, 200000)) & pack.inAlignedBox((0, 0, 0), (9, 9, 1)))]))
''').result
	assert count == pytest.approx(5 * 4 * (3 + 2.5 / 4 - 2 / 8), rel=.003)
	assert heights == pytest.approx([3.125, 3 + 2.3 / 4 - .7 / 8])
	assert box[0] == [0, 0, 0] and box[1] == [5, 4, 3 + 5 / 4]
	assert layer == pytest.approx(5 * 4 * 1, rel=.02) and profile == 8 * 4 * 4


def test_grids_with_holes_and_other_files_are_refused_with_the_place(yade):
	messages = yade(asc + '''
rows = [[1, 2, 3], [4, -9999, 6], [7, 8, 9], [1, 1, 1]]
holed = writeAsc('holed.asc', rows)
def of(**header): return refused(mpm.terrain, writeAsc('bad.asc', rows, **header), 0)
print(json.dumps([refused(mpm.terrain, holed, 0), refused(mpm.terrain, holed, 0, max=(1e9, 200001.5)), refused(mpm.terrain, holed, 5, max=(1e9, 200001.5)), of(nrows=7), of(cellsize=None), of(cellsize='x'),
	of(cellsize=-1), refused(mpm.terrain, 'none.asc', 0), refused(mpm.terrain, holed, float('nan')), refused(mpm.terrain, holed, 0, min=(0, 0), max=(1, 1)), refused(mpm.terrain, holed, 0, min=3), refused(mpm.terrain, holed, None)]))
''').result
	hole, fine, bottom, rows, cell, word, negative, missing, nan, beside, pair, none = messages
	assert 'no height at (600001.5, 200002.5)' in hole and 'min and max' in hole
	assert fine == 'nothing was refused'
	assert 'bottom, at 5 m, is not below the surface, at 1 m, at (600000.5, 200000.5)' in bottom
	assert '7 rows of 3' in rows and 'cellsize is not in its header' in cell and "'cellsize x'" in word and 'cellsize = -1 must be > 0' in negative
	assert 'FileNotFoundError' in missing and 'bottom = nan' in nan and 'is between min' in beside and 'min = 3' in pair and 'bottom = None' in none


def test_grids_as_their_format_admits_them(yade):
	"""Rows that are wrapped at another width, and cells that are not square, as the drivers of GIS write and read them."""
	same, exchanged, both, box = yade(asc + '''
import numpy as np
head = 'ncols 6\\nnrows 4\\nxllcorner 0\\nyllcorner 0\\n'
rows = np.arange(24).reshape(4, 6) + 1
def grid(name, sizes, width):
	lines = [' '.join(map(str, rows.ravel()[i:i + width])) for i in range(0, 24, width)]
	open(name, 'w').write(head + sizes + '\\n'.join(lines) + '\\n')
	return name
places = [(0.5 + i, 0.5 + j) for i in range(6) for j in range(4)]
heights = lambda name: mpm.terrain(name, -1).heights(places).tolist()
grid('rows.asc', 'cellsize 1\\n', 6)
same = [heights(grid('wrapped.asc', 'cellsize 1\\n', width)) == heights('rows.asc') for width in (5, 8, 9, 24)]
slim = mpm.terrain(grid('slim.asc', 'dx 1\\ndy 2\\n', 6), -1)
print(json.dumps([same, refused(mpm.terrain, grid('exchanged.asc', 'cellsize 1\\n', 4), -1), refused(mpm.terrain, grid('both.asc', 'cellsize 1\\ndx 1\\n', 6), -1), [list(x) for x in slim.aabb()]]))
''').result
	assert all(same) and 'is ncols right' in exchanged and 'cellsize beside dx or dy' in both
	assert box == [[0.5, 1, -1], [5.5, 7, 24]]


def test_grids_of_other_formats_are_read_by_gdal(yade):
	"""GeoTIFF with a hole, as ESRI ASCII has the same heights; and what is refused: feet, rows askew, no coordinates, no GDAL."""
	same, refusals = yade(asc + '''
import sys
import numpy as np
from osgeo import gdal, osr
rows = np.arange(24.).reshape(4, 6) + 1
def tif(name, frame=(10, 2, 0, 8, 0, -2), epsg=25832, unit=''):
	made = gdal.GetDriverByName('GTiff').Create(name, 6, 4, 1, gdal.GDT_Float32)
	if frame: made.SetGeoTransform(frame)
	system = osr.SpatialReference()
	system.ImportFromEPSG(epsg)
	made.SetProjection(system.ExportToWkt())
	made.GetRasterBand(1).SetUnitType(unit)
	made.GetRasterBand(1).SetNoDataValue(-9999)
	made.GetRasterBand(1).WriteArray(rows)
	return name
places = [(11 + 2 * i, 1 + 2 * j) for i in range(6) for j in range(4)] + [(12.5, 3.25)]
heights = lambda name, **part: mpm.terrain(name, -1, **part).heights(places).tolist()
open('rows.asc', 'w').write('ncols 6\\nnrows 4\\nxllcorner 10\\nyllcorner 0\\ncellsize 2\\n' + '\\n'.join(' '.join(map(str, row)) for row in rows))
expected = heights('rows.asc')
same = [heights(tif('a.tif')) == expected]
rows = rows[::-1]
same.append(heights(tif('south.tif', (10, 2, 0, 0, 0, 2))) == expected)
rows = rows[::-1].copy()
rows[0, 5] = -9999
refusals = [refused(mpm.terrain, tif('hole.tif'), -1), refused(mpm.terrain, tif('feet.tif', epsg=2263), -1), refused(mpm.terrain, tif('high.tif', unit='ft'), -1)]
refusals += [refused(mpm.terrain, tif('askew.tif', (10, 2, 1, 8, 0, -2)), -1), refused(mpm.terrain, tif('nowhere.tif', None), -1)]
open('text.tif', 'w').write('no picture')
refusals.append(refused(mpm.terrain, 'text.tif', -1))
sys.modules['osgeo'] = None
try: mpm.terrain('a.tif', -1)
except ImportError as error: refusals.append(str(error))
print(json.dumps([same, refusals]))
''').result
	assert all(same)
	for said, words in zip(refusals, ("'hole.tif' has no height at (21.0, 7.0)", 'US survey foot', "heights are in 'ft'", 'do not run along x', 'does not say where', 'GDAL says', 'apt install python3-gdal'), strict=True): assert words in said, said


def test_facets_of_rock(yade):
	"""Facets of a function, an array, a file and a terrain: a plane keeps its area and normal, corners lie on the surface, and soil rests on them with its weight."""
	result = yade('''
import json
import numpy as np
from yade import mpm, utils
O.materials.append(FrictMat(label='rock', frictionAngle=0.3))
plane = lambda x, y: 0.5 * x + 0.25 * y
corners = lambda bodies: np.array([[b.state.pos + b.state.ori * v for v in b.shape.vertices] for b in bodies])
def told(bodies):
	c = corners(bodies)
	n = np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]) / 2
	return [len(c), float(np.linalg.norm(n, axis=1).sum()), n.sum(axis=0).tolist(), float(abs(c[..., 2] - plane(c[..., 0], c[..., 1])).max()), c.reshape(-1, 3).min(axis=0)[:2].tolist()]
array = np.array([[plane(x, y) for y in range(3)] for x in range(5)])
open('plane.asc', 'w').write('ncols 5\\nnrows 3\\nxllcenter 700000\\nyllcenter 200000\\ncellsize 1\\n' + '\\n'.join(' '.join(map(str, row)) for row in array.T[::-1]))
kinds = dict(function=mpm.facets(plane, 1, (0, 0), (4, 2), material='rock', mask=6), array=mpm.facets(array, 1, (0, 0)), file=mpm.facets('plane.asc', origin=(700000, 200000)),
	terrain=mpm.facets(mpm.terrain('plane.asc', -1, origin=(700000, 200000))), coarse=mpm.facets(plane, 3, (0, 0), (4, 2)))
result = {kind: told(bodies) for kind, bodies in kinds.items()}
one = kinds['function'][0]
result['body'] = [one.material.label, one.groupMask, one.dynamic]
O.bodies.append(mpm.facets(lambda x, y: 0, 1.5, (-3, -3), (3, 3), material='rock'))
O.materials.append(MpmElasticMat(young=1e6, poisson=0.2, density=1000, label='soil'))
grid = MpmGrid(cellSize=0.5, dim=3)
O.bodies.append(mpm.fill(mpm.terrain(lambda x, y: 1 + 0 * x, 0, (-1, -1), (1, 1), spacing=1), grid, 2, 'soil'))
contact = MpmContact(friction=0.3)
sides = [MpmBoundary(min=(-inf, 0, -inf), max=(inf, 0, inf), fix='y'), MpmBoundary(min=(0, -inf, -inf), max=(0, inf, inf), fix='x')]
O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, 0, -10), contacts=[contact], boundaries=sides, verbosity=0)]
O.dt = 0.5
O.run(2, wait=True)
result['weight'] = -sum(f[2] for f in contact.forces) / (mpm.arrays()['volume'].sum() * 1000 * 10)
print(json.dumps(result))
''').result
	assert result.pop('body') == ['rock', 6, False]
	assert 0.98 < result.pop('weight') < 1.02
	for kind, (number, area, normal, off, low) in result.items():
		assert number == (4 if kind == 'coarse' else 16) and abs(area / (8 * (1 + 0.25 + 0.0625)**0.5) - 1) < 1e-6 and off < 1e-6 and low == pytest.approx([0, 0], abs=1e-6), kind
		assert normal == pytest.approx([-4, -2, 8], abs=1e-5), kind


wrongRock = [
        ('mpm.facets(lambda x, y: 0)', 'ValueError', ['spacing', 'function']),
        ('mpm.facets(lambda x, y: 0, 1)', 'ValueError', ['min and max']),
        ('mpm.facets(lambda x, y: 0, 1, (0, 0), (0, 1))', 'ValueError', ['min and max']),
        ('mpm.facets(lambda x, y: nan, 1, (0, 0), (1, 1))', 'ValueError', ['nan', '(0.0, 0.0)', 'finite']),
        ('mpm.facets(lambda x: 0, 1, (0, 0), (1, 1))', 'TypeError', ['function of x and y']),
        ('mpm.facets(lambda x, y: 0, -1, (0, 0), (1, 1))', 'ValueError', ['spacing = -1']),
        ('mpm.facets(lambda x, y: 0, "1", (0, 0), (1, 1))', 'TypeError', ["spacing = '1'"]),
        ('mpm.facets([1, 2, 3], 1, (0, 0))', 'TypeError', ['at least 2 by 2']),
        ('mpm.facets([[1, 2], [3, nan]], 1, (0, 0))', 'ValueError', ['no height', '(1.0, 1.0)']),
        ('mpm.facets([[1, 2], [3, 4]], 1)', 'ValueError', ['min']),
        ('mpm.facets([[1, 2], [3, 4]], 1, (0, 0), material="rok")', 'ValueError', ["'rok'", 'rock']),
        ('mpm.facets([[100, 200], [300, 400]], 0.001, (7.5, 46.5))', 'ValueError', ['degrees', 'EPSG:32632', '76.54 km']),
        ('mpm.terrain([[100, 200], [300, 400]], 0, (7.5, 46.5), spacing=0.001)', 'ValueError', ['degrees', 'terrain']),
        ('mpm.facets("none.asc")', 'FileNotFoundError', ['none.asc']),
        ('mpm.facets(3)', 'TypeError', ['surface = 3']),
]


@pytest.fixture(scope='module')
def rockOutcomes(tmp_path_factory):
	from conftest import outcomesOf
	before = "O.reset(), O.materials.append(FrictMat(label='rock'))"
	return outcomesOf(tmp_path_factory.mktemp('rock'), 'from math import nan\nfrom yade import mpm\n', [statement for statement, _, _ in wrongRock], before=before)


@pytest.mark.parametrize('statement, exception, words', wrongRock, ids=[statement for statement, _, _ in wrongRock])
def test_rock_is_refused(rockOutcomes, statement, exception, words):
	kind, sentence = rockOutcomes[statement]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence
