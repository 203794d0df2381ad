# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that cannot be meant are refused with the kind of exception that Python has for it, and a sentence that names parameter and value."""
import pytest
from conftest import outcomesOf

nan, inf = float('nan'), float('inf')
material = dict(young=1e6, poisson=0.3, density=2400, yieldStress=15e3)


def made(**changes):
	return 'MpmVonMisesMat(**' + repr(material | changes).replace('nan', 'float("nan")').replace('inf', 'float("inf")') + ')'


notPositive = [0., -1., nan, inf]

# (statement in a YADE script, exception, what its sentence must contain)
refused = (
        # parameters of materials
        [(made(**{name: value}), 'ValueError', [f'.{name} = {value!r}', 'a finite number > 0']) for name in ('young', 'density', 'yieldStress')
         for value in notPositive] +
        [(made(poisson=value), 'ValueError', [f'.poisson = {value!r}', 'between -1 and 0.5']) for value in (-1., 0.5, 0.7, -2., nan, inf)] + [
                (made(young='stiff'), 'TypeError', ['.young', "'stiff'", 'a number']),
                (made(youngs=1e6), 'AttributeError', ["'youngs'", 'yieldStress']),
                ('soil().young = -3', 'ValueError', ['.young = -3.0']),
                ('soil().density = 0', 'ValueError', ['.density = 0.0']),
                ('soil().poison = 0.3', 'AttributeError', ["'poison'"]),
        ] +
        # the grid
        [(f'MpmGrid(cellSize={text})', 'ValueError', ['.cellSize', 'a finite number > 0']) for text in ('0', '-1', 'float("nan")', 'inf')] +
        [(f'MpmGrid(cellSize=1, dim={dim})', 'ValueError', [f'.dim = {dim}', '2 or 3']) for dim in (0, 1, 4, -2)] + [
                ('MpmGrid(cellSize=1, dim=2.5)', 'TypeError', ['.dim = 2.5', 'an integer']),
                ('MpmGrid(cellSize=1, origin=(0, inf, 0))', 'ValueError', ['.origin', 'finite']),
                ('MpmGrid(cellSize=1, origin=(0, 0))', 'TypeError', ['.origin', 'three numbers']),
                ('MpmGrid(1)', 'TypeError', ['keyword']),
                ('MpmGrid(cellsize=1)', 'AttributeError', ["'cellsize'", 'cellSize']),
        ] +
        # boundaries
        [(f'MpmBoundary(fix={text!r})', 'ValueError', [f'.fix = {text!r}', 'x, y, z']) for text in ('w', 'X', 'xyw', 'xx', 'x y', '')] + [
                ('MpmBoundary(fix=1)', 'TypeError', ['.fix = 1', 'a string']),
                ('MpmBoundary(fix="x", min=(0, float("nan"), 0))', 'ValueError', ['.min', 'NaN']),
                ('MpmBoundary(fix="x", displacement=(inf, 0, 0))', 'ValueError', ['.displacement', 'finite']),
        ] +
        # ghost stabilisation and Newton's method
        [(f'MpmGhost(factor={text})', 'ValueError', ['.factor', '>= 0']) for text in ('-1e-2', 'float("nan")', 'inf')] + [
                ('MpmGhost(scaling="Paper")', 'ValueError', [".scaling = 'Paper'", 'mesh-independent', 'paper']),
        ] + [(f'MpmNewton(tolerance={text})', 'ValueError', ['.tolerance', 'between 0 and 1']) for text in ('0', '1', '-1e-6', 'float("nan")')] + [
                ('MpmNewton(maxIterations=0)', 'ValueError', ['.maxIterations = 0', '>= 1']),
                ('MpmNewton(maxIterations=2.0)', 'TypeError', ['.maxIterations = 2.0', 'an integer']),
                ('MpmNewton(minStep=0)', 'ValueError', ['.minStep = 0', '> 0 and <= 1']),
                ('MpmNewton(minStep=2)', 'ValueError', ['.minStep = 2', '> 0 and <= 1']),
                ('MpmNewton(minStep=float("nan"))', 'ValueError', ['.minStep = nan']),
                ('MpmNewton(lineSearchTrials=-1)', 'ValueError', ['.lineSearchTrials = -1', '>= 0']),
                ('MpmNewton(acceptUnconverged=1)', 'TypeError', ['.acceptUnconverged = 1', 'True or False']),
                ('MpmNewton(maxIterations=True)', 'TypeError', ['.maxIterations = True', 'an integer']),
        ] +
        # the state and shape of a point
        [
                ('MpmState(stress=Matrix3.Identity)', 'AttributeError', ['.stress', 'can only be read']),
                ('MpmState(elasticStrain=Matrix3(0,1,0, 2,0,0, 0,0,0))', 'ValueError', ['.elasticStrain', 'symmetric']),
                ('MpmState(elasticStrain=Matrix3(float("nan"),0,0, 0,0,0, 0,0,0))', 'ValueError', ['.elasticStrain', 'finite']),
                ('MpmState(defGrad=Matrix3(-1,0,0, 0,1,0, 0,0,1))', 'ValueError', ['.defGrad', 'determinant > 0']),
                ('MpmState(volume=0)', 'ValueError', ['.volume = 0.0', '> 0']),
                ('MpmState(force=(0, float("nan"), 0))', 'ValueError', ['.force', 'finite']),
                ('MpmState(plasticStrain=-1e-3)', 'ValueError', ['.plasticStrain', '>= 0']),
                ('MpmPoint(halfSize=(0.1, 0, 0.1))', 'ValueError', ['.halfSize', '> 0']),
        ] +
        # polygons
        [
                ('mpm.polygon([(0, 0), (1, 0)])', 'ValueError', ['vertices', 'at least 3']),
                ('mpm.polygon([])', 'ValueError', ['vertices', 'at least 3']),
                ('mpm.polygon(7)', 'TypeError', ['vertices = 7']),
                ('mpm.polygon([(0, 0), (1, 0), "ab"])', 'TypeError', ['vertices', 'pairs']),
                ('mpm.polygon([(0, 0, 0), (1, 0, 0), (1, 1, 0)])', 'TypeError', ['(0.0, 0.0, 0.0)', 'pair']),
                ('mpm.polygon([(0, 0), (1, 0), (1, float("nan"))])', 'ValueError', ['vertices[2]', 'finite']),
                ('mpm.polygon([(0, 0), (2, 2), (2, 0), (0, 2)])', 'ValueError', ['crosses', 'in order']),
                ('mpm.polygon([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)])', 'ValueError', ['vertices[4]', 'do not repeat']),
                ('mpm.polygon([(0, 0), (1, 0), (2, 0)])', 'ValueError', ['no area']),
                ('mpm.polygon([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)])', 'ValueError', ['touch itself']),
                ('mpm.polygon([(0, 0), (4, 0), (4, 4), (4, 2), (0, 4)])', 'ValueError', ['touch itself']),
        ] +
        # filling
        [(f'fill(pointsPerCell={n})', 'ValueError', [f'pointsPerCell = {n}', 'at least 1']) for n in (0, -2)] +
        [(f'fill(pointsPerCell={n})', 'TypeError', [f'pointsPerCell = {n}', 'an integer']) for n in ('2.5', '2.0', "'2'", 'True', 'None')] + [
                ('fill(grid=0.5)', 'TypeError', ['grid = 0.5', 'MpmGrid']),
                ('fill(grid=MpmGrid())', 'ValueError', ['.cellSize = nan', 'there is no default']),
                ('fill(grid=MpmGrid(cellSize=1e-9))', 'ValueError', ['cellSize = 1e-09', 'pointsPerCell = 2']),
                ('fill(predicate=[(0, 0), (1, 0), (1, 1)])', 'TypeError', ['predicate', 'polygon']),
                ('fill(predicate=pack.inSpace())', 'ValueError', ['no bounds', 'inAlignedBox']),
                ('fill(grid=MpmGrid(cellSize=1, dim=3))', 'ValueError', ['no bounds', 'inAlignedBox']),
                ('fill(predicate=pack.inSphere((0, 0, 0), 0.01))', 'ValueError', ['no point', '0.5 m']),
                ('fill(predicate=pack.inSphere((0, 0, 9), 5))', 'ValueError', ['no point', 'z = 0']),
                ('fill(material="sand")', 'KeyError', ["'sand'", "'soil'"]),
                ('fill(material="steel")', 'TypeError', ["'steel'", 'FrictMat']),
                ('fill(material="bare")', 'ValueError', ["'bare'", 'no constitutive law']),
                ('fill(material="unfinished")', 'ValueError', ['.poisson = nan', 'there is no default']),
                ('fill(material=soil())', 'TypeError', ['material', 'O.materials']),
                ('fill(material=None)', 'TypeError', ['material = None']),
                ('fill(material=lambda x: None)', 'TypeError', ['None', '(0.25, 0.25, 0.0)']),
                ('fill(material=lambda x: "sand" if x[0] > 1 else "soil")', 'KeyError', ["'sand'"]),
                ('fill(material=[(square, "sand")])', 'KeyError', ["'sand'"]),
                ('fill(material=["soil"])', 'TypeError', ['material[0]', 'pair']),
                ('fill(material=[])', 'ValueError', ['64 of 64', '(0.25, 0.25, 0.0)']),
                ('fill(material=[(pack.inAlignedBox((0, 0, -1), (9, 1, 1)), "soil")])', 'ValueError', ['48 of 64', '(0.25, 1.25, 0.0)']),
        ] +
        # bodies that are no complete material points
        [
                ('point(mat=O.materials["steel"])', 'ValueError', ['Body #0', 'FrictMat']),
                ('point(state=State())', 'ValueError', ['Body #0', 'MpmState', 'State']),
                ('point(bounded=True)', 'ValueError', ['Body #0', 'bounded']),
                ('point(dynamic=True)', 'ValueError', ['Body #0', 'blockedDOFs']),
                ('point(shape=Sphere(radius=1))', 'ValueError', ['Body #0', "'soil'", 'Sphere', 'last material']),
        ] +
        # Values that only the engine sees: positions, elements changed in place, values that do not go together
        [
                ('step("b.state.pos = (nan, 0, 0)")', 'ValueError', ['Body #5', '.pos = (nan, 0, 0)']),
                ('step("b.state.refPos = (0, inf, 0)")', 'ValueError', ['Body #5', '.refPos = (0, inf, 0)']),
                ('step("b.state.force[1] = nan")', 'ValueError', ['Body #5', '.force', 'nan']),
                ('step("b.shape.halfSize0[0] = 0")', 'ValueError', ['Body #5', '.halfSize0', '> 0']),
                ('step("b.state = MpmState()")', 'ValueError', ['Body #5', 'blockedDOFs']),
                ('step("b.state = MpmState(blockedDOFs=63)")', 'ValueError', ['Body #5', '.volume', 'no default']),
                ('step("b.state.elasticStrain = Matrix3(0,0,.1, 0,0,0, .1,0,0)")', 'ValueError', ['Body #5', '.elasticStrain', 'plane strain']),
                ('step("b.state.force = (0, 0, 1)")', 'ValueError', ['Body #5', '.force', 'plane strain']),
                ('step("base.min = (0, 1, 0)")', 'ValueError', ['MpmBoundary.min', 'max', 'swapped']),
                ('step("base.displacement = (1, 0, 0); base.fix = chr(121)")', 'ValueError', ['.displacement', "fix = 'y'"]),
                ('step("soil.density = 1; b.mat = MpmElasticMat(young=1)")', 'ValueError', ['.poisson = nan', 'no default']),
                ('step("b.state.force[1] = nan", lambda: O.run(1, wait=True))', 'RuntimeError', ['Body #5', '.force', 'nan']),
        ])

setting = '''
import json, sys
from yade import mpm, pack

def soil():
	return MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil')

square = mpm.polygon([(0, 0), (4, 0), (4, 4), (0, 4)])

def fill(predicate=square, grid=MpmGrid(cellSize=1), pointsPerCell=2, material='soil'):
	return mpm.fill(predicate, grid, pointsPerCell, material)

def point(**changes):
	"""A scene of one body that would be a material point but for the changes, looked at by mpm.arrays."""
	body = fill()[0]
	for name, value in changes.items():
		setattr(body, name, value)
	O.bodies.append(body)
	mpm.arrays()

nan = float('nan')

def step(change, go=O.step):
	"""One step of a sound scene but for the change, which may speak of a body b, the boundary base, and the material soil."""
	bodies, base = fill(), MpmBoundary(max=(inf, 0, inf), fix='xy')
	O.bodies.append(bodies)
	O.engines = [MpmImplicitEngine(grid=MpmGrid(cellSize=1), gravity=(0, -1, 0), boundaries=[base])]
	O.dt = 1
	exec(change, globals(), dict(b=bodies[5], base=base, soil=bodies[5].mat))
	go()
'''


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	"""{statement: [name of the exception, its sentence]}, all from one YADE process."""
	before = "O.reset(); O.materials.append([soil(), FrictMat(label='steel'), MpmMaterial(label='bare'), MpmElasticMat(young=1, label='unfinished')])"
	return outcomesOf(tmp_path_factory.mktemp('bad_input'), setting, [statement for statement, _, _ in refused], before)


@pytest.mark.parametrize('statement, exception, words', refused, ids=[statement for statement, _, _ in refused])
def test_is_refused(outcomes, statement, exception, words):
	kind, sentence = outcomes[statement]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence


def test_correct_input_is_accepted(yade):
	"""The statements above fail for what they say, not because nothing passes."""
	script = setting + '''
O.materials.append(soil())
step('b.state.force[1] = -1')
assert O.iter == 1
O.bodies.clear()
point()
MpmGrid(cellSize=1e-3, origin=(-1, 2, 3), dim=3)
MpmBoundary(min=(-inf, 0, 0), max=(inf, 0, 0), fix='zx', displacement=(1, 0, 0))
MpmGhost(factor=0, scaling='paper')
MpmNewton(tolerance=0.5, maxIterations=1)
MpmElasticMat(young=1, poisson=-0.99, density=1e-3)
MpmState(elasticStrain=Matrix3(1,2,3, 2,4,5, 3,5,6), defGrad=Matrix3(2,1,0, 0,1,0, 0,0,1), force=(0, -1, 0), volume=2, volume0=1)
print(json.dumps(len(mpm.arrays()['id'])))
'''
	assert yade(script).result == 1
