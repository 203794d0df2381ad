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
	assert '7 rows of 3' in rows and 'cellsize is not in its header' in cell and "'cellsize x'" in word and 'must be > 0' in negative
	assert 'FileNotFoundError' in missing and 'bottom = nan' in nan and 'is between min' in beside and 'min = 3' in pair and 'bottom = None' in none
