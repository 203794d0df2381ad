# SPDX-License-Identifier: GPL-2.0-or-later
"""Messages for users who have misspelt a name, used another unit, a label twice, or another grid: what was probably meant, in the exception or warning."""
import pytest
from conftest import outcomesOf

setting = '''
import copy, json, pickle, sys
from math import inf, radians
import numpy as np
from yade import mpm, pack

base = MpmBoundary(max=(inf, 0, inf), fix='xy')

def say(text):
	sys.stderr.write(f'== {text}\\n')
	sys.stderr.flush()

def scene(height=4, grid=None, n=2, material=None, at=0, **changes):
	"""Ground 4 m wide, filled in cells of 1 m."""
	O.reset()
	material = material or MpmElasticMat(young=1e6, poisson=0.3, density=2000)
	material.label = 'soil'
	O.materials.append(material)
	O.bodies.append(mpm.fill(pack.inAlignedBox((at, 0, -1), (at + 4, height, 1)), grid or MpmGrid(cellSize=1), n, 'soil'))
	solver = MpmImplicitEngine(**(dict(grid=MpmGrid(cellSize=1), gravity=(0, -10, 0), boundaries=[base], verbosity=0) | changes))
	O.engines, O.dt = [solver], 1e-3
	return solver

def heights(name, rows, cellsize=1, x=0, y=0, columns=None):
	with open(name, 'w') as file:
		print('ncols', columns or len(rows[0]), file=file)
		print('nrows', len(rows), '\\nxllcorner', x, '\\nyllcorner', y, '\\ncellsize', cellsize, file=file)
		for row in rows: print(*row, file=file)
	return name

def cube(low, high, inwards=False):
	import gts
	corners = [gts.Vertex(*(high if i >> k & 1 else low for k in range(3))) for i in range(8)]
	edges, surface = {}, gts.Surface()
	def edge(i, j):
		return edges.setdefault(frozenset((i, j)), gts.Edge(corners[i], corners[j]))
	for a, b, c, d in (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5):
		for t in (a, b, c), (a, c, d):
			if inwards: t = t[::-1]
			surface.add(gts.Face(edge(t[0], t[1]), edge(t[1], t[2]), edge(t[2], t[0])))
	return surface

def loaded(pieces, **load):
	surface = MpmSurface(vertices=[(0, 4, 0), (2, 4, 0), (4, 4, 0)], pieces=pieces)
	return scene(loads=[MpmTraction(surface=surface, **load)])
'''

# (script, exception, what its sentence must contain)
refused = [
        # misspelt names: the nearest ones first, settings and results apart
        ('scene().gravty = (0, 0, 0)', 'AttributeError', ["no attribute 'gravty'; did you mean 'gravity'", 'Its settings: ', 'Results, to be read: converged']),
        ('scene().gravty', 'AttributeError', ["did you mean 'gravity'"]),
        ('scene().stifness()', 'AttributeError', ["did you mean 'stiffness'"]),
        ('MpmImplicitEngine(Boundary=[])', 'AttributeError', ["did you mean 'boundaries'"]),
        ('MpmDynamicEngine(time_tolerance=1)', 'AttributeError', ["did you mean 'timeTolerance'"]),
        ('MpmImplicitEngine(iterperiod=2)', 'AttributeError', ["did you mean 'iterPeriod'"]),
        ('MpmMohrCoulombMat(friction=.5)', 'AttributeError', ["'frictionAngle'"]),
        ('MpmElasticMat(xyz=.5)', 'AttributeError', ["no attribute 'xyz'. Its settings: density, undrained, waterModulus, conductivity, porosity, conductivityLaw, conductivityIndex, retention, relaxationTime, young, poisson."]),
        # symbols and words of the field
        ('MpmElasticMat(E=1e6)', 'AttributeError', ["no attribute 'E'; did you mean 'young'?"]),
        ('MpmElasticMat(young=1e6).nu', 'AttributeError', ["did you mean 'poisson'?"]),
        ('MpmMohrCoulombMat(phi=0.5)', 'AttributeError', ["did you mean 'frictionAngle'?"]),
        ('MpmMohrCoulombMat(psi=0.5)', 'AttributeError', ["did you mean 'dilationAngle'?"]),
        ('MpmTrescaMat(su=1e3)', 'AttributeError', ["did you mean 'undrainedStrength'?"]),
        ('MpmElasticMat(rho=2000)', 'AttributeError', ["did you mean 'density'?"]),
        ('MpmBeam(EA=1e6)', 'AttributeError', ["did you mean 'axialStiffness'?"]),
        ('MpmBeam(EI=1e6)', 'AttributeError', ["did you mean 'bendingStiffness'?"]),
        ('MpmReinforcement(EA=1e6)', 'AttributeError', ["did you mean 'axialStiffness'?"]),
        ('MpmContact(mu=0.3)', 'AttributeError', ["did you mean 'friction'?"]),
        ('MpmGrid(h=0.3)', 'AttributeError', ["did you mean 'cellSize'?"]),
        ('mpm.excavate', 'AttributeError', ["did you mean 'mpm.stages.excavate'?"]),
        ('mpm.phiC', 'AttributeError', ["did you mean 'strengthReduction'?"]),
        ('mpm.MpmVonMisesMat', 'AttributeError', ['without mpm.']),
        ('mpm.MpmVonMises', 'AttributeError', ["did you mean 'MpmVonMisesMat'"]),
        ('MpmVonMises(young=1e6)', 'NameError', ["name 'MpmVonMises' is not defined; did you mean 'MpmVonMisesMat'?"]),
        # results before they are there
        ('scene().reactions[0]', 'IndexError', ['MpmImplicitEngine.reactions is empty', 'first step', 'O.run(1, wait=True)']),
        ('MpmBeam(line=[(0, 1), (0, 0)], axialStiffness=1, bendingStiffness=1).moments[-1]', 'IndexError', ['MpmBeam.moments is empty']),
        ('s = scene(); O.step(); s.reactions[1]', 'IndexError', ['index out of range']),
        # positions without soil, cells without number
        ('scene(); mpm.histories([(70, 1, 0)])', 'ValueError', ['(70.0, 1.0, 0.0)', '66.3 m away', 'cellSize = 1 m']),
        ("scene(); mpm.points.filling._room = lambda: 1e7; mpm.fill(pack.inAlignedBox((0, 0, -1), (200, 200, 1)), MpmGrid(cellSize=0.01), 2, 'soil')", 'ValueError', ['cellSize = 0.01 m', 'GiB are free']),
        # functions of yade.mpm
        ("mpm.plot(filename='x.png')", 'TypeError', ["plot: there is no argument 'filename'; did you mean 'fileName'?"]),
        ("mpm.fill(pack.inSphere((0, 0, 0), 1), MpmGrid(cellSize=1), pointPerCell=2, material='soil')", 'TypeError', ["fill: there is no argument 'pointPerCell'; did you mean 'pointsPerCell'"]),
        ("scene(); mpm.fill(pack.inAlignedBox((0, 0, 0), (1, 1, 1)), MpmGrid(cellSize=1), 2, 'soil', yuong=1)", 'TypeError', ["yuong", "did you mean 'young'?"]),
        ("scene(); mpm.assign(stres=1)", 'TypeError', ["did you mean 'stress'"]),
        ("scene(); mpm.plot('stres_yz')", 'ValueError', ["did you mean 'stress_yz'"]),
        ("mpm.polygon(vertexes=[])", 'TypeError', ["polygon: there is no argument 'vertexes'; did you mean 'vertices'"]),
        ("mpm.terrain(top='x', botom=0)", 'TypeError', ["did you mean 'bottom'"]),
        ("mpm.stages.excavate(None, step=2)", 'TypeError', ["did you mean 'steps'"]),
        ("mpm.ploot()", 'AttributeError', ["did you mean 'plot'"]),
        # attributes that are read are copies
        ('scene().boundaries.append(base)', 'AttributeError', ['MpmImplicitEngine.boundaries', 'copy', 'x.boundaries = [*x.boundaries, another]']),
        ('scene().loadCurve.extend([(2, 1)])', 'AttributeError', ['MpmImplicitEngine.loadCurve']),
        ('scene().loads.insert(0, 1)', 'AttributeError', ['MpmImplicitEngine.loads']),
        ('scene().contacts[0] = 1', 'TypeError', ['MpmImplicitEngine.contacts']),
        ('del scene().water[0]', 'TypeError', ['MpmImplicitEngine.water']),
        ('MpmGrid(cellSize=1).refinements.remove(1)', 'AttributeError', ['MpmGrid.refinements']),
        ('scene().reactions.append(1)', 'AttributeError', ['MpmImplicitEngine.reactions', 'a result, which cannot be changed']),
        ('scene().boundaries.unknown', 'AttributeError', ["'tuple' object has no attribute 'unknown'"]),
        # labels
        ("scene(); O.materials.append(MpmElasticMat(young=2e6, poisson=.3, density=2000, label='soil')); mpm.fill(pack.inAlignedBox((0, 0, 0), (1, 1, 1)), MpmGrid(cellSize=1), 2, 'soil')", 'ValueError',
         ["'soil' is the label of 2 materials, O.materials[0] and O.materials[1]"]),
        ("scene(); O.materials.append(MpmElasticMat(young=2e6, poisson=.3, density=2000)); mpm.fill(pack.inAlignedBox((0, 0, 0), (1, 1, 1)), MpmGrid(cellSize=1), 2, '')", 'ValueError', ['is no label']),
        ("scene(); mpm.fill(pack.inAlignedBox((0, 0, 0), (1, 1, 1)), MpmGrid(cellSize=1), 2, 'siol')", 'KeyError', ["did you mean 'soil'"]),
        ("scene(); O.materials.append(MpmElasticMat(young=2e6, poisson=.3, density=2000, label='soil')); mpm.elementTest('soil', 'oedometer', -.01)", 'ValueError', ['is the label of 2 materials']),
        # grids of heights
        ("mpm.terrain(heights('a.asc', [(1, 2, 3), (4, )], columns=2), bottom=0)", 'ValueError', ['2 heights (ncols)', 'row 1 does not end with a line', 'line 1 of the heights has 3']),
        ("mpm.terrain(heights('a.asc', [(1, 2), (4, 5)], columns=2.5), bottom=0)", 'ValueError', ['ncols = 2.5 is no whole number']),
        ("mpm.terrain(heights('a.asc', [(410, 455), (430, 520)], 1 / 7200, 11.5, 47.2), bottom=300)", 'ValueError', ['degrees of longitude and latitude', '75.5', 'EPSG:32632', 'UTM zone 32']),
        ("mpm.terrain(heights('a.asc', [(3, 3), (3, 3)], 1 / 7200, -71.5, -33.2), bottom=0)", 'ValueError', ['EPSG:32719']),
        ("""region = mpm.terrain(heights('a.asc', [(410, 411), (412, 413)], 10, 680000, 5230000), bottom=400)
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, label='soil'))
mpm.fill(region, MpmGrid(dim=3, cellSize=1), 1, 'soil')""", 'ValueError', ['fill: a point at (680006, 5.23001e+06', 'MpmGrid.origin = (0 0 0)', 'mpm.terrain(origin=...)']),
        # surfaces inside out
        ("scene(); mpm.fill(pack.inGtsSurface(cube(0, 2, inwards=True)), MpmGrid(dim=3, cellSize=1), 1, 'soil')", 'ValueError', ['face inwards', 'surface.revert()']),
        ("scene(); mpm.fill(pack.inGtsSurface(cube(0, 2, inwards=True)) & pack.inAlignedBox((0, 0, 0), (1, 1, 1)), MpmGrid(dim=3, cellSize=1), 1, 'soil')", 'ValueError', ['face inwards']),
        ("mpm.surface(pack.inGtsSurface(cube(0, 2, inwards=True)), dim=3)", 'ValueError', ['surface: ', 'face inwards']),
        ('loaded([(2, 1), (0, 1)], pressure=1e3); O.step()', 'ValueError', ['loads[0].surface: of the pieces 0 and 1, which meet at Vector3(2,4,0), one is inside out']),
        # corners that are swapped
        ('MpmRefinement(min=(2, 0, 0), max=(0, 2, 0))', 'ValueError', ['MpmRefinement.min = 2 is greater than max = 0 along x', 'swapped']),
        ("MpmBoundary(min=(2, 0, 0), max=(0, 2, 0), fix='x')", 'ValueError', ['MpmBoundary.min = 2 is greater than max = 0 along x']),
        ('MpmAbsorbingBoundary(min=(2, 0, 0), max=(0, 2, 0))', 'ValueError', ['MpmAbsorbingBoundary.min = 2']),
]

# Sentences that must hold, with their scripts.
sound = {
        'a copy of an attribute is a tuple in all else':
        '''
solver = scene(loadCurve=[(0, 0), (1, 2)])
read = solver.loadCurve
assert read == ((0, 0), (1, 2)) and ((0, 0), (1, 2)) == read and isinstance(read, tuple) and repr(read) == '((0.0, 0.0), (1.0, 2.0))' == str(read)
assert hash(read) == hash(((0, 0), (1, 2))) and read[-1] == (1, 2) and read[:1] == ((0, 0), ) and len(read) == 2 and not hasattr(read, 'append')
for same in pickle.loads(pickle.dumps(read)), copy.copy(read), copy.deepcopy(read): assert type(same) is tuple and same == read
assert json.loads(json.dumps(read)) == [[0, 0], [1, 2]]
solver.loadCurve += [(2, 3)]
assert solver.loadCurve == ((0, 0), (1, 2), (2, 3)) and type(solver.loadCurve + ((3, 4), )) is tuple
solver.boundaries = [*solver.boundaries, MpmBoundary(min=(4, -inf, -inf), fix='x')]
assert len(solver.boundaries) == 2 and solver.dict()['boundaries'] == solver.boundaries
''',
        'names that Python looks for itself are missed in its own words':
        '''
solver = scene()
assert not hasattr(solver, '_repr_html_') and getattr(solver, '__deepcopy__', 3) == 3 and getattr(solver, 'gravty', 4) == 4
class Own(MpmImplicitEngine):
	pass
own = Own()
own.note = 'own attribute'
assert own.note == 'own attribute' and not hasattr(own, 'other')
assert pickle.loads(pickle.dumps(mpm.fill)) is mpm.fill and mpm.fill.__name__ == 'fill' and 'pointsPerCell' in str(__import__('inspect').signature(mpm.fill))
''',
        'grids of heights may be small, steep in places, and wrapped':
        '''
mpm.terrain(heights('a.asc', [(.1, .2, .15), (.12, .4, .1)], .05), bottom=0) # a flume
mpm.terrain(heights('a.asc', [(1, 2, 9, 9)] * 4, .5, 10, 40), bottom=-5)
mpm.terrain(heights('a.asc', [(1, 2), (3, 4), (5, 6), (7, 8)], columns=2), bottom=0)
text = open('a.asc').read().replace('1 2', '1\\n2')
open('a.asc', 'w').write(text)
assert mpm.terrain('a.asc', bottom=0).heights([(1, 1)])[0] > 0
''',
        'closed surfaces are solid inside, whichever way a file has them':
        '''
O.materials.append(MpmElasticMat(young=1e6, poisson=.3, density=2000, label='soil'))
grid = MpmGrid(dim=3, cellSize=.5)
import gts
def filled(*surfaces):
	with open('x.stl', 'w') as file:
		print('solid x', file=file)
		for surface in surfaces:
			for face in surface.faces():
				print('facet normal 0 0 0 outer loop', *('vertex %r %r %r' % v.coords() for v in face.vertices()), 'endloop endfacet', sep='\\n', file=file)
		print('endsolid x', file=file)
	region = mpm.solid('x.stl')
	points = np.array([b.state.pos for b in mpm.fill(region, grid, 1, 'soil')])
	assert all(region.surf.volume() > 0 for _ in range(1)) and len(mpm.surface(region, dim=3).pieces) == 12 * len(surfaces)
	return points
for inwards in False, True:
	points = filled(cube(0, 2, inwards))
	assert len(points) == 64 and (points > 0).all() and (points < 2).all()
	assert len(filled(cube(0, 2, inwards), cube(3, 5, not inwards))) == 128 # side by side
	assert len(filled(cube(0, 3, inwards), cube(1, 2, not inwards))) == 216 - 8 == len(filled(cube(0, 3, inwards), cube(1, 2, inwards))) # with a cavity
''',
        'a pressure is felt on one side, a load of fixed direction goes on any':
        '''
solver = loaded([(2, 1), (0, 1)], traction=(0, -1e3, 0))
solver.loadCurve = [(0, 1)]
O.step()
assert abs(solver.loads[0].resultant[1] + 4e3) < 1e-6
solver = loaded([(2, 1), (1, 0)], pressure=1e3)
O.step()
''',
        'a laboratory test on soil that keeps its volume ends where its stress is known to round-off':
        '''
worst = 0
for p in 200, 5e3, 1e5:
	for young in 1e7, 2e8:
		clay = MpmTrescaMat(young=young, poisson=.4999, density=2000, undrainedStrength=1e3)
		curve = mpm.elementTest(clay, 'triaxial', -.02, confiningPressure=p)
		worst = max(worst, abs(curve['stress'][:, 0, 0] + p).max() / (2.3e-16 * young / 6e-4))
		assert abs(curve['q'].max() / 2e3 - 1) < .01
assert worst < 30, worst
''',
}


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	return outcomesOf(tmp_path_factory.mktemp('telling'), setting, [*(script for script, _, _ in refused), *sound.values()])


@pytest.mark.parametrize('script, exception, words', refused, ids=[script[:60] for script, _, _ in refused])
def test_isRefused(outcomes, script, exception, words):
	kind, sentence = outcomes[script]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence, sentence


@pytest.mark.parametrize('script', sound.values(), ids=sound)
def test_holds(outcomes, script):
	assert outcomes[script] == ['no exception', ''], outcomes[script]


def test_doubts_name_the_unit_and_both_grids(yade):
	"""Each in one warning; what can be meant is left in peace."""
	run = yade(setting + '''
tresca = lambda **changes: MpmTrescaMat(**(dict(young=1e6, poisson=.3, density=2000, undrainedStrength=20e3) | changes))
sand = lambda **changes: MpmMohrCoulombMat(**(dict(young=1e6, poisson=.3, density=2000, cohesion=0, frictionAngle=radians(30)) | changes))
def tried(title, *arguments, **changes):
	say(title)
	scene(*arguments, **changes)
	try: O.step()
	except RuntimeError: pass # it may yield
tried('unit weight', material=tresca(density=20))
tried('weight in N', material=tresca(density=19e3))
tried('tonnes', material=tresca(density=1.9))
tried('steel', material=tresca(density=7850))
tried('MPa', material=tresca(young=20))
tried('strength', material=tresca(undrainedStrength=50))
tried('cohesion', material=sand(cohesion=40, frictionAngle=0))
tried('next to no cohesion', material=sand(cohesion=1))
tried('a model in a box', height=2, material=tresca(undrainedStrength=500))
tried('another cell size', grid=MpmGrid(cellSize=.7))
tried('another origin', grid=MpmGrid(cellSize=1, origin=(.2, 0, 0)), at=.2)
tried('another division', grid=MpmGrid(cellSize=.5), n=1)
tried('refined', grid=MpmGrid(cellSize=1, refinements=[MpmRefinement(min=(0, 0, 0), max=(2, 2, 0))]))
tried('periodic', grid=MpmGrid(cellSize=1, period=(4, 0, 0)))
say('end')
''')
	said = {text.split('\n')[0]: text for text in run.stderr.split('== ')[1:]}
	expected = {
	        'unit weight': ['density = 20', 'kN/m3, a unit weight, that is 2038.74 kg/m3'],
	        'weight in N': ['density = 19000', 'N/m3, a unit weight, that is 1936.8 kg/m3'],
	        'tonnes': ['t/m3, that is 1900 kg/m3'],
	        'MPa': ['young = 20', 'meant in MPa or GPa, that is 2e+07 or'],
	        'strength': ['undrainedStrength = 50', '0.000625 times the stress', 'kPa, that is 50000 Pa'],
	        'cohesion': ['cohesion = 40', 'kPa'],
	        'another cell size': ['0.35 m wide', '2.85714 in a cell and along an axis (cellSize = 1 m)'],
	        'another origin': ['lies across the lines of the grid', 'origin = (0 0)'],
	}
	for title in 'steel', 'a model in a box', 'another division', 'refined', 'periodic':
		assert 'WARNING' not in said[title], said[title]
	held = 'the ghost stabilisation took up' # true of a block that has next to no strength
	slides = 'Coulomb 1776' # and which no plane through its foot bears
	assert said['next to no cohesion'].count('WARNING') == 2 and all(said['next to no cohesion'].count(text) == 1 for text in (held, slides)), said['next to no cohesion']
	for title, words in expected.items():
		assert said[title].count('WARNING') == 1 + said[title].count('fill: the region has') + said[title].count(held), said[title]
		assert all(word in said[title] for word in words), said[title]
