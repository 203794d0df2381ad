# SPDX-License-Identifier: GPL-2.0-or-later
"""Attributes of the plugin's classes in Python and in files, on a stand-in plugin with one attribute of each kind."""
import re
import shutil

import pytest
from conftest import build, compiled


@pytest.fixture(autouse=True)
def probe(libraries):
	shutil.copy(build / 'tests/probe.so', libraries / 'mpm/mpm_engine.so')


refusing = '''
import json, math
import numpy as np

def refusal(action):
	try:
		action()
	except Exception as error:
		return [type(error).__name__, str(error)]
	return 'accepted'
'''

# class, attribute, value as Python text, exception, words of the message
refusals = [
        ('ProbeMat', 'young', '-1', 'ValueError', 'ProbeMat.young = -1.0 is not admitted: expected a finite number > 0.'),
        ('ProbeMat', 'young', '0', 'ValueError', 'ProbeMat.young = 0.0 is not'),
        ('ProbeMat', 'young', 'math.nan', 'ValueError', 'ProbeMat.young = nan is not'),
        ('ProbeMat', 'young', 'math.inf', 'ValueError', 'ProbeMat.young = inf is not'),
        ('ProbeMat', 'young', 'True', 'TypeError', 'ProbeMat.young = True: expected a number.'),
        ('ProbeMat', 'young', '"1"', 'TypeError', "ProbeMat.young = '1': expected a number."),
        ('ProbeMat', 'young', 'None', 'TypeError', 'ProbeMat.young = None: expected a number.'),
        ('ProbeMat', 'young', '1j', 'TypeError', 'ProbeMat.young = 1j: expected a number.'),
        ('ProbeMat', 'young', '10**400', 'TypeError', 'ProbeMat.young = 1'),
        ('ProbeMat', 'density', '0', 'ValueError', 'ProbeMat.density = 0.0 is not'),  # an attribute of YADE's own class
        ('ProbeDerivedMat', 'young', '-1', 'ValueError', 'ProbeMat.young = -1.0 is not'),  # base class
        ('ProbeDerivedMat', 'poisson', '0.5', 'ValueError', 'expected a number between -1 and 0.5, both excluded.'),
        ('ProbeDerivedMat', 'poisson', '-1', 'ValueError', 'ProbeDerivedMat.poisson = -1.0 is not'),
        ('ProbeDerivedMat', 'limit', '-1e-300', 'ValueError', 'expected a finite number >= 0.'),
        ('ProbeItem', 'low', '(1, 2)', 'TypeError', 'ProbeItem.low = (1, 2): expected three numbers.'),
        ('ProbeItem', 'low', '(1, 2, "a")', 'TypeError', "ProbeItem.low = (1, 2, 'a'): expected three numbers."),
        ('ProbeItem', 'low', '(1, 2, math.nan)', 'ValueError', 'expected a number, finite or infinite, but not NaN.'),
        ('ProbeItem', 'sizes', '(1, 0, 1)', 'ValueError', 'ProbeItem.sizes = Vector3(1,0,1) is not'),
        ('ProbeItem', 'sizes', '(1, 1, math.inf)', 'ValueError', 'ProbeItem.sizes = Vector3(1,1,inf) is not'),
        ('ProbeItem', 'letters', '"xq"', 'ValueError', "ProbeItem.letters = 'xq' is not admitted: expected letters out of 'xyz'."),
        ('ProbeState', 'matrix', 'math.nan * Matrix3.Identity', 'ValueError', 'ProbeState.matrix = Matrix3('),
        ('ProbeState', 'matrix', '3', 'TypeError', 'ProbeState.matrix = 3: expected a 3x3 matrix.'),
        ('ProbeState', 'fixed', '(1, 2, 3)', 'AttributeError', 'ProbeState.fixed can only be read.'),
        ('ProbeEngine', 'choice', '4', 'ValueError', 'ProbeEngine.choice = 4 is not admitted: expected 2 or 3.'),
        ('ProbeEngine', 'choice', '2.0', 'TypeError', 'ProbeEngine.choice = 2.0: expected an integer.'),
        ('ProbeEngine', 'choice', 'True', 'TypeError', 'ProbeEngine.choice = True: expected an integer.'),
        ('ProbeEngine', 'choice', '2**31', 'TypeError', 'ProbeEngine.choice = 2147483648: expected an integer.'),
        ('ProbeEngine', 'count', '0', 'ValueError', 'expected a number >= 1.'),
        ('ProbeEngine', 'count', '2**63', 'TypeError', 'ProbeEngine.count = 9223372036854775808: expected an integer.'),
        ('ProbeEngine', 'scaling', '"third"', 'ValueError', "expected 'first' or 'second'."),
        ('ProbeEngine', 'scaling', '1', 'TypeError', 'ProbeEngine.scaling = 1: expected a string.'),
        ('ProbeEngine', 'flag', '1', 'TypeError', 'ProbeEngine.flag = 1: expected True or False.'),
        ('ProbeEngine', 'flag', 'None', 'TypeError', 'ProbeEngine.flag = None: expected True or False.'),
        ('ProbeEngine', 'item', 'ProbeMat()', 'TypeError', 'expected an object of type ProbeItem.'),
        ('ProbeEngine', 'items', 'ProbeItem()', 'TypeError', 'expected a sequence, each item an object of type ProbeItem.'),
        ('ProbeEngine', 'items', '[ProbeItem(), None]', 'TypeError', 'expected a sequence, each item an object of type ProbeItem.'),
        ('ProbeEngine', 'curve', '[(0, 1), (1,)]', 'TypeError', 'expected a sequence, each item a pair (a number, a number).'),
        ('ProbeEngine', 'curve', '[(0, "1")]', 'TypeError', 'expected a sequence, each item a pair (a number, a number).'),
        ('ProbeEngine', 'names', '"abc"', 'TypeError', "ProbeEngine.names = 'abc': expected a sequence, each item a string."),
        ('ProbeEngine', 'points', '[(1, 2)]', 'TypeError', 'expected a sequence, each item three numbers.'),
        ('ProbeEngine', 'runs', '3', 'AttributeError', 'ProbeEngine.runs can only be read.'),
        ('ProbeEngine', 'secret', '3', 'AttributeError', "ProbeEngine has no attribute 'secret'"),
        ('ProbeDerivedMat', 'yuong', '3', 'AttributeError', "ProbeDerivedMat has no attribute 'yuong'; did you mean 'young'? Its settings: density, young, poisson, limit."),
        ('ProbeEngine', 'itms', '[]', 'AttributeError', "ProbeEngine has no attribute 'itms'; did you mean 'items'"),
        ('ProbeEngine', 'unlike', '[]', 'AttributeError', 'Results, to be read: runs, posts.'),
]


def test_refusedValues(yade):
	"""The same exception from assignment and from construction, and the old value stays."""
	script = refusing + 'found = []\n'
	for name, attribute, value, *_ in refusals:
		script += f'''
thing = {name}()
before = repr(getattr(thing, '{attribute}', None))
found.append([refusal(lambda: setattr(thing, '{attribute}', {value})), refusal(lambda: {name}({attribute}={value})), before == repr(getattr(thing, '{attribute}', None))])
'''
	results = yade(script + 'print(json.dumps(found))').result
	for (name, attribute, value, kind, words), (assigned, constructed, kept) in zip(refusals, results, strict=True):
		assert assigned[0] == kind and words in assigned[1], (name, attribute, value, assigned)
		assert constructed == assigned
		assert kept or attribute in ('secret', 'yuong', 'itms', 'unlike')


def test_refusedConstruction(yade):
	found = yade(refusing + 'print(json.dumps([refusal(lambda: ProbeMat(3)), refusal(lambda: ProbeMat(young=3, density=-1))]))').result
	assert found[0] == ['TypeError', 'ProbeMat takes keyword arguments only, as in ...(name=value).']
	assert found[1][0] == 'ValueError' and 'ProbeMat.density = -1.0' in found[1][1]


def test_acceptedValues(yade):
	found = yade(
	        refusing + '''
engine = ProbeEngine(
	item=ProbeItem(low=(-math.inf, 0, 1)), items=(ProbeItem(letters='x'), ProbeItem(letters='yz')), curve=[[0, 0], (1, np.float32(0.5))],
	names=['a', 'b'], points=((1, 2, 3), Vector3(4, 5, 6)), flag=True, choice=np.int64(3), count=2**62, number=np.float64(1.5), scaling='second')
engine.number += np.int64(1)
empty = ProbeEngine(items=[], curve=(), item=None)
state = ProbeState(matrix=Matrix3(1, 2, 3, 4, 5, 6, 7, 8, 9))
state.vector[1] = 7  # in place
class Derived(ProbeMat):
	def __init__(self, **keywords):
		ProbeMat.__init__(self, **keywords)
		self.note = 'own attribute'
print(json.dumps({
	'low': list(engine.item.low), 'letters': [i.letters for i in engine.items], 'curve': engine.curve, 'names': engine.names,
	'points': [list(p) for p in engine.points], 'flag': engine.flag, 'choice': engine.choice, 'count': engine.count, 'number': engine.number,
	'scaling': engine.scaling, 'doubled': engine.doubled(), 'kinds': [type(v).__name__ for v in (engine.items, engine.curve, engine.curve[0], engine.names)],
	'empty': [empty.items, empty.curve, empty.item], 'vector': list(state.vector), 'row': list(state.matrix.row(1)),
	'append': refusal(lambda: engine.items.append(ProbeItem())), 'note': Derived(young=2).note, 'doc': ProbeEngine.curve.__doc__,
	'readonlyCopy': refusal(lambda: state.fixed.__setitem__(0, 5)), 'fixed': list(state.fixed), 'dict': sorted(set(engine.dict()) & {'secret', 'runs', 'posts', 'dead'}),
}))'''
	).result
	assert found == {
	        'low': [-float('inf'), 0, 1], 'letters': ['x', 'yz'], 'curve': [[0, 0], [1, 0.5]], 'names': ['a', 'b'], 'points': [[1, 2, 3], [4, 5, 6]],
	        'flag': True, 'choice': 3, 'count': 2**62, 'number': 2.5, 'scaling': 'second', 'doubled': 5, 'kinds': ['tuple'] * 4,
	        'empty': [[], [], None], 'vector': [0, 7, 0], 'row': [4, 5, 6],
	        'append': ['AttributeError', 'ProbeEngine.items can be read only as a copy, a tuple, which is not the attribute itself: assign a new one, as in x.items = [*x.items, another].'], 'note': 'own attribute', 'doc': 'Curve. :yattrflags:`4`',
	        'readonlyCopy': 'accepted', 'fixed': [1, 1, 1], 'dict': ['dead', 'posts', 'runs'],
	}


def test_postLoad(yade):
	found = yade(
	        '''
import json
engine = ProbeEngine()
posts = [engine.posts]
engine.number = 3; posts.append(engine.posts)
engine.curve = [(0, 1)]; posts.append(engine.posts)
engine = ProbeEngine(number=3, curve=[(0, 1)]); posts.append(engine.posts)
print(json.dumps(posts))'''
	).result
	assert found == [0, 0, 1, 1]


# numbers whose last bits, signs and special values a text format may lose
numbers = [0.1, 1 / 3, 1e-310, 5e-324, 1.7976931348623157e308, -0.0, float('inf'), -float('inf'), float('nan'), 1 + 2**-52]

# every attribute as text in which each double shows all of its bits
describing = '''
import json, copy, pickle, struct
bits = lambda *values: [struct.pack('<d', v).hex() for v in values]
def describe():
	e, s, m = O.engines[0], O.bodies[0].state, O.bodies[0].material
	return [
		[[bits(*i.low), bits(*i.sizes), i.letters] for i in [e.item, *e.items]], [bits(*pair) for pair in e.curve], e.names, [bits(*p) for p in e.points],
		e.flag, e.choice, e.count, bits(e.number), e.scaling, e.runs, e.label, e.iterPeriod, e.failAt,
		bits(*[s.matrix[i, j] for i in range(3) for j in range(3)]), bits(*s.vector), bits(*s.fixed), bits(*s.pos),
		type(m).__name__, bits(m.density, m.young, m.poisson, m.limit), e.item == e.items[0], m == O.materials[-1]]
'''
building = describing + f'''
inf, nan = float('inf'), float('nan')
numbers = {numbers}
O.materials.append(ProbeDerivedMat(young=1 / 3, poisson=0.1, limit=5e-324, density=1e-310))
O.bodies.append(Body(material=O.materials[-1], state=ProbeState(matrix=Matrix3(0.1, 1 / 3, 1e-310, 5e-324, 1.7976931348623157e308, -0.0, 7, 8, 9), vector=(0.1, 0.2, 0.3))))
item = ProbeItem(low=(-inf, 0.1, inf), sizes=(0.1, 1 / 3, 5e-324), letters='xyz')
O.engines = [ProbeEngine(item=item, items=[item, ProbeItem()], curve=[(n, -n) for n in numbers], names=['', 'a b<&>'], points=[(n, 0, n) for n in numbers],
	flag=True, choice=3, count=2**62, number=nan, scaling='second', label='probe', failAt=-7)]
O.dt = 0.1
O.step()
before = describe()
'''


def test_filesKeepEveryBit(yade):
	yade(
	        building + '''
for name in ('a.xml', 'a.xml.gz', 'a.yade', 'a.yade.gz', 'a.xml.bz2'):
	O.save(name)
	O.load(name)
	assert describe() == before, name
	assert probe.label == 'probe' and probe == O.engines[0]
O.saveTmp()
O.loadTmp()
assert describe() == before
open('before.json', 'w').write(json.dumps(before))
'''
	)
	for name in ('a.xml.gz', 'a.yade.gz'):
		yade(describing + f"O.load('{name}'); assert json.loads(json.dumps(describe())) == json.load(open('before.json'))")


def test_copiesKeepEveryBit(yade):
	yade(
	        building + '''
for duplicate in (copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x)), copy.copy):
	O.engines = [duplicate(O.engines[0])]
	after = describe()
	after[-2] = before[-2]  # copies of the list do not share items with the single one, as in YADE's own classes
	assert after == before
	state = duplicate(O.bodies[0].state)
	assert describe()[13:16] == [bits(*[state.matrix[i, j] for i in range(3) for j in range(3)]), bits(*state.vector), bits(*state.fixed)]
'''
	)


def test_xmlIsThatOfYade(yade):
	"""Vectors and matrices under the element names of YADE's own archives."""
	yade(building + "O.save('a.xml')")
	xml = (yade.folder / 'a.xml').read_text().replace('\t', '').replace('\n', '')
	number = r'[-+.e0-9]+'
	components = ''.join(f'<{c}>{number}</{c}>' for c in 'xyz')
	assert re.search(f'<vel[^>]*>{components}</vel>', xml)  # YADE's own
	assert re.search(f'<vector[^>]*>{components}</vector>', xml)
	assert re.search('<matrix[^>]*>' + ''.join(f'<m{i}{j}>{number}</m{i}{j}>' for i in range(3) for j in range(3)) + '</matrix>', xml)


def test_classesInYade(yade):
	found = yade(
	        building + '''
from yade import system, timing
O.timingEnabled = True
O.step(); O.step()
phases = O.engines[0].timingDeltas.data
timing.reset()
print(json.dumps([sorted(system.childClasses('Material') & {'ProbeMat', 'ProbeDerivedMat'}), O.materials[-1].dispHierarchy(), phases, O.engines[0].timingDeltas.data,
	ProbeMat.__doc__]))'''
	)
	children, hierarchy, phases, afterReset, doc = found.result
	assert children == ['ProbeDerivedMat', 'ProbeMat']
	assert hierarchy == ['ProbeDerivedMat', 'ProbeMat', 'Material']
	assert phases == [['phase', 14, 2]] and afterReset == []
	assert doc.strip() == 'A material.'
	assert 'ProbeEngine' in found.stderr + found.stdout and 'first run' in found.stderr + found.stdout  # through YADE's log


def test_stateOfAnotherMaterialIsRefused(yade):
	run = yade('O.bodies.append(Body(material=ProbeDerivedMat(), state=State())); O.dt = 1; O.step()', fails=True)
	assert "ProbeDerivedMat doesn't correspond to Body::state type State (should be ProbeState instead)" in run.stderr


def test_valueChangedInPlaceIsFound(yade):
	run = yade(building + 'item.sizes[1] = -1; O.run(1, wait=True)', fails=True)
	assert 'ProbeItem.sizes = Vector3(' in run.stderr and 'is not admitted' in run.stderr


@pytest.mark.parametrize('run', ['O.run(3, wait=True)', 'O.run(3); O.wait()', 'O.step()'])
def test_failureEndsTheScript(yade, run):
	ended = yade(f'O.engines = [ProbeEngine(failAt=0)]\n{run}\nfor i in range(1000): pass\nprint("went on")', fails=True)
	assert ended.exitCode == 1
	assert 'RuntimeError: asked to fail' in ended.stderr
	assert 'went on' not in ended.stdout


def test_failureBeforeYadeBeginsToWait(yade):
	"""The main thread takes a while from starting the background thread to waiting for it; YADE alone then loses the exception."""
	slow = compiled(
	        '''
#include <dlfcn.h>
#include <unistd.h>
namespace yade { struct ThreadRunner { void start(); }; }
void yade::ThreadRunner::start()
{
	reinterpret_cast<void (*)(ThreadRunner*)>(dlsym(RTLD_NEXT, "_ZN4yade12ThreadRunner5startEv"))(this);
	usleep(300000);
}
''', yade.folder / 'slow.so'
	)
	script = '''
O.engines = [ProbeEngine(failAt=0)]
try:
	O.run(3, wait=True)
except RuntimeError as error:
	print(f'caught: {error}')
O.engines = [ProbeEngine(failAt=0)]
O.run(3, wait=True)
print('went on')
'''
	ended = yade(script, environment={'LD_PRELOAD': str(slow)}, fails=True)
	assert 'caught: asked to fail' in ended.stdout
	assert 'RuntimeError: asked to fail' in ended.stderr
	assert 'went on' not in ended.stdout


def test_failureCanBeCaught(yade):
	"""Raised once, at the call that failed, and the simulation can go on."""
	found = yade(
	        '''
import json
caught = []
for attempt in range(30):
	O.engines = [ProbeEngine(failAt=O.iter + attempt % 3)]
	try:
		O.run(5, wait=True)
	except RuntimeError as error:
		caught.append(str(error))
O.engines = [ProbeEngine()]
first = O.iter
O.run(5, wait=True)
print(json.dumps([len(caught), sorted(set(caught)), O.iter - first]))'''
	).result
	assert found == [30, ['asked to fail'], 5]


def test_failureInTheBackground(yade):
	ended = yade('import time\nO.engines = [ProbeEngine(failAt=100)]\nO.run()\nfor i in range(100): time.sleep(0.05)\nprint("went on")', fails=True)
	assert ended.exitCode == 1
	assert 'RuntimeError: asked to fail' in ended.stderr
	assert 'went on' not in ended.stdout
