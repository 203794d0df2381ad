# SPDX-License-Identifier: GPL-2.0-or-later
"""The cases: which function with which arguments, what is different in their short form, and the bounds by which its numbers are judged. Nothing here needs YADE."""
from collections import namedtuple
from math import inf, log

Case = namedtuple('Case', 'name function arguments short bounds')
cases = {}
derived = {}  # functions of the results of several cases, None if one is missing


def add(name, function, bounds, short=None, **arguments):
	"""short: arguments that differ in the short form."""
	cases[name] = Case(name, function, arguments, short or {}, bounds)


def near(value, part):
	return value * (1 - part), value * (1 + part)


atMost, atLeast = lambda x: (-inf, x), lambda x: (x, inf)

# 1. Penetration. Of the cone N is judged in Tresca's clay, by Lu et al. (2004) with the roughness of its face; von Mises' is told, as it has less strength in triaxial compression.
smooth = dict(part=atLeast(.999), scatter=atMost(.03), largest=atMost(.08), inside=atMost(.05))
lu = lambda rough: dict(late=near(3.4 + 1.6 * log(200) + 1.3 * rough, .08))
for cells in 2, 3, 4, 6, 8:
	rules = smooth if cells in (3, 6, 8) else dict(part=smooth['part'], inside=smooth['inside'])
	add(f'cone-R{cells}', 'penetration.onAxis', rules | lu(0), dict(depth=4. if cells < 6 else 1.5), kind='cone', cells=cells, seconds=300 if cells < 6 else 900 if cells < 8 else 3000)


def atNoSize(found):
	"""Value on cells of no size, by a straight line through values by the cells of a radius, and its slope by their size over the radius."""
	size, N = [1 / cells for cells in found], list(found.values())
	mean = sum(size) / len(found), sum(N) / len(found)
	slope = sum((x - mean[0]) * (y - mean[1]) for x, y in zip(size, N)) / sum((x - mean[0])**2 for x in size)
	return mean[1] - slope * mean[0], slope


def ofCone(results):
	"""N on cells of no size, by a straight line through its values on three grids or more that got as deep."""
	found = {cells: results.get(f'cone-R{cells}', {}) for cells in (2, 3, 4, 6, 8)}
	deepest = max(result.get('reached', 0) for result in found.values())
	found = {cells: result['late'] for cells, result in found.items() if result.get('part', 0) > .999 and result['reached'] > .999 * deepest}
	if len(found) < 3: return None
	late, slope = atNoSize(found)
	return dict(late=late, slope=slope)


derived['cone-limit'] = Case('cone-limit', ofCone, {}, {}, lu(0))
add('cone-rough', 'penetration.onAxis', smooth | lu(1), dict(depth=3.), kind='cone', rough=1.)
add('cone-mises', 'penetration.onAxis', smooth, dict(depth=3.), kind='cone', law='vonMises')
add('cone-mises-rough', 'penetration.onAxis', smooth, dict(depth=3.), kind='cone', law='vonMises', rough=1.)
add('cone-surface', 'penetration.onAxis', smooth, dict(depth=3.), kind='cone', wished=False)
add('punch', 'penetration.onAxis', smooth, dict(depth=3.), kind='box', wished=False, relaxation=True)
add('punch-mises', 'penetration.onAxis', smooth, dict(depth=3.), kind='box', wished=False, law='vonMises')
add('pile', 'penetration.onAxis', smooth, dict(depth=3.), kind='pile')
add('pile-box', 'penetration.onAxis', smooth, dict(depth=3.), kind='box')
add('pile-rough', 'penetration.onAxis', smooth, dict(depth=3.), kind='pile', rough=.5)
# T-bar: Randolph and Houlsby (1984), exact for a rough one, a lower bound within 0.8 % of the least upper one for a smooth one. Ball in Tresca's clay: lower bounds of Randolph et al. (2000), upper
# ones by minimising the dissipation of smooth stream functions, which gives 10.26 and 14.12 in von Mises'.
# The smooth ball's stiffness is less, and so is that in von Mises' clay: with 10 the smooth one got to 1.25 diameters.
for rough in 0, 1:
	end = '-rough' if rough else ''
	add('tbar' + end, 'penetration.fullFlow', smooth | dict(late=near(11.94 if rough else 9.14, .05)), dict(depth=1.), kind='tbar', rough=rough)
	add('tbar-mises' + end, 'penetration.fullFlow', smooth | dict(late=near(11.94 if rough else 9.14, .05)), dict(depth=1.), kind='tbar', rough=rough, law='vonMises')
	add('ball' + end, 'penetration.fullFlow', smooth | dict(late=(.95 * 15.1, 1.05 * 15.12) if rough else (.95 * 10.97, 1.05 * 11.04)), dict(depth=1.), kind='ball', rough=rough, stiffness=10. if rough else 2.)
	add('ball-mises' + end, 'penetration.fullFlow', smooth, dict(depth=1.), kind='ball', rough=rough, stiffness=3., law='vonMises')
add('tbar-fine', 'penetration.fullFlow', smooth | dict(late=near(9.14, .05)), dict(depth=.5), kind='tbar', cells=8, depth=1., seconds=600)
add('pile-3d', 'penetration.inSpace', dict(part=atLeast(.999), inside=atMost(.05)), dict(depth=1.5), kind='box')
add('ball-3d', 'penetration.inSpace', dict(part=atLeast(.999), inside=atMost(.05)), dict(depth=1.), kind='ball', depth=2.)
add('cone-sand', 'penetration.sand', smooth, dict(depth=2.), kind='cone')
add('cone-sand-3d', 'penetration.sandInSpace', dict(part=atLeast(.999), inside=atMost(.05)), dict(depth=1.))
add('pile-sand', 'penetration.sand', smooth, dict(depth=2.), kind='box', friction=20.)

# 2. Thin and small bodies: a force that is there, and the same at five places in a cell
alike = dict(spread=atMost(.05), least=atLeast(1e-6))
for width in .1, .3, 1.:
	add(f'strip-{width:g}', 'thin.strip', alike | (dict(warned=atLeast(1)) if width < 1 else {}), width=width)
add('ball-half-domain', 'thin.ball', alike | dict(warned=atLeast(1)), diameter=.25)
add('tip-45', 'thin.tip', alike, degrees=45.)
add('tip-20', 'thin.tip', alike, degrees=20.)
add('edge-upright', 'thin.edge', alike | dict(mean=near(1., .2)), degrees=90., rough=1.)
add('edge-leaning', 'thin.edge', alike, degrees=45., rough=0.)
# Bodies that are not as thin as that, but small still
add('ball-1', 'thin.ball', alike, diameter=1., wide=6)
for width in 1.2, 2., 2.5, 3., 4.:
	add(f'strip-{width:g}', 'thin.strip', alike, width=width, wide=24)
add('tip-45-1', 'thin.tip', alike | dict(warned=atLeast(1)), degrees=45., deep=1., wide=16)

# 3. Energy over the first: how much more there has been, and what contact has given; in how many scenes either was more than 1e-3
honest = dict(energy=atMost(1.001), contactWork=atMost(1e-3), ended=atLeast(.995))
for scheme in 'newmark', 'generalised-alpha', 'midpoint':
	add(f'energy-{scheme}', 'energy.edges', honest, dict(parts=[.3, .15]), scheme=scheme)
add('energy-random', 'energy.drawn', dict(gifts=atMost(0), contactWork=atMost(1e-3), ended=atLeast(.995)), dict(seeds=[0, 60], seconds=60), seeds=[0, 1000], seconds=900)
add('energy-sticking', 'energy.drawn', dict(gifts=atMost(0), contactWork=atMost(1e-3), ended=atLeast(.995)), dict(seeds=[0, 60], seconds=60), seeds=[0, 300], seconds=300, sticks=True)

# 4. Tunnels: at 0.3 to 5 cells a step, in how many scenes a middle of a point was more than a tenth of a cell inside of a body or behind it
for mode in 'soilFlies', 'bodyFlies', 'soilPushed', 'bodyPushed':
	add(f'tunnel-{mode}', 'tunnel.met', dict(behind=atMost(0), failed=atMost(0)) | (dict(contactWork=atMost(1e-3)) if mode == 'soilFlies' else {}), dict(parts=[.7, 2., 5.]), mode=mode)

# 5. Turning: one full turn of a sheared block with its plates [degrees, -], and torques over their closed forms
turned = dict(turned=atLeast(359.9), angle=atMost(1), size=atMost(.02))
# Loss of the size of the force is the loss of points in turning, in the plane as much as across the normal in 3D with the same cells and points: it is judged
# with 4 cells over the half height and 3 points, or told besides, on the coarsest grid as the angle is.
for cells, points in (1, 2), (2, 2), (2, 3), (4, 2), (4, 3):
	judged = ['turned'] if (cells, points) == (1, 2) else turned if (cells, points) == (4, 3) else ['turned', 'angle']
	add(f'turn-plane-{cells}-{points}', 'turning.block', {name: turned[name] for name in judged}, dim=2, cells=cells, points=points)
add('turn-normal', 'turning.block', turned, dict(steps=40), dim=3, points=3)
add('turn-across', 'turning.block', dict(turned=turned['turned'], angle=turned['angle']), dict(steps=60), dim=3, axis=1, points=3)
add('turn-across-2-4', 'turning.block', turned, dict(steps=10), dim=3, axis=1, cells=2, points=4)
add('cylinder', 'turning.cylinder', dict(turned=atLeast(57), torque=near(1, .05), largest=atMost(.08)), angle=1.)
for cells in 4, 6, 10:
	add(f'vane-R{cells}', 'turning.vane', dict(turned=atLeast(57), band=near(1, .05), largest=atMost(.08)), dict(angle=1.), cells=cells, angle=1.5)
add('vane-ring', 'turning.vane', dict(torque=near(1, .05), first=near(1, .05), largest=atMost(.08)), cells=4, halvings=3, angle=.4)


def ofVane(results):
	"""Torque on cells of no size, by a straight line through its roots on the three grids: what turns is wider by a part of a cell, and a torque goes with the square of that. At first,
	which is told, all four blades lie along the lines of each grid; later by how much wider a blade acts changes with its angle to them, and not alike on the three."""
	found = {cells: result for cells in (4, 6, 10) if (result := results.get(f'vane-R{cells}', {})).get('turned', 0) > 57}
	if len(found) < 3: return None
	limits = {name: atNoSize({cells: result[name]**.5 for cells, result in found.items()}) for name in ('first', 'torque')}
	return dict(torque=limits['torque'][0]**2, slope=limits['torque'][1], first=limits['first'][0]**2)


derived['vane-limit'] = Case('vane-limit', ofVane, {}, {}, dict(torque=near(1, .05)))
add('ring-shear', 'turning.ring', dict(turned=atLeast(359.9), torque=near(1, .02), largest=atMost(.02)))

for cells in 4, 6, 8:
	for end, isDynamic in ('', False), ('-time', True):
		add(f'wheel-clay-{cells}{end}', 'turning.wheel', dict(torque=near(1, .1)), cells=cells, isDynamic=isDynamic)

# 6. Overlap: largest difference of the force from that of one body
add('layers', 'overlap.layers', dict(off=atMost(.01), rubs=atMost(.02)))
add('embracing', 'overlap.embracing', dict(off=atMost(.01)))
add('clumps', 'overlap.clumps', dict(off=atMost(.01)))
add('mesh', 'overlap.mesh', dict(off=atMost(1e-3), narrow=atMost(.05)))
add('mesh-closed', 'overlap.closed', dict(off=atMost(.05)))
add('floors-explicit', 'overlap.explicitFloors', dict(imbalance=atMost(.01)))

# 7. Free bodies: by how much way and speed are off those of closed forms, from two places in a cell, and the change of momentum in an impact over that of the sphere
rolls = dict(off=atMost(.01), speedOff=atMost(.01))
# Rolling bodies stick, by springs a twentieth as stiff as the penalty: by these they creep. Their friction is lost where they bounce, as it does where one
# passes the nodes as fast as it swings on the ground: with ten cells over its radius, and ground so soft that it touches over a cell to either side, it passes
# them four times as fast.
rollsOn = dict(young=3.4e7, stiffness=400., dt=1e-3, h=.05, rest=.4, long=17, seconds=400)
# On 30 degrees rolling takes 0.82 of a friction of 0.2, and as the normal force swings it slips.
slopes = {.2: dict(degrees=20., end=.6)}
for friction in 0., .1, .2, .4:
	add(f'rolling-{friction:g}', 'free.rolling', rolls, dict(end=.3), friction=friction, **(rollsOn if friction > .1 else {}), **slopes.get(friction, {}))
add('rolling-askew', 'free.rolling', rolls, dict(end=.3), friction=.4, heading=30.)
add('rolling-flat', 'free.rolling', rolls, dict(end=.6), friction=.1, degrees=10., end=.8, **rollsOn)
add('rolling-static', 'free.rolling', rolls, dict(end=.3), friction=.4, isDynamic=False, **rollsOn)
add('wheel', 'free.driven', dict(way=near(1, .02), speed=near(1, .02)))
for every in 1, 5, 20:
	add(f'impact-{every}', 'free.impact', dict(off=atMost(.01)), every=every)

# 8. What was right with the corners of domains
add('plate', 'known.example', dict(error=(-.02, .02)), scene='plate', stiffness=50)
add('hertz', 'known.example', dict(error=(-.02, .02)), dict(cells=5), scene='sphere', cells=10, steps=5)
add('hertz-free', 'known.example', dict(error=(-.03, .03)), scene='free', cells=2, stiffness=20)
add('hertz-line', 'known.example', dict(error=(-.03, .03), pressure=(-.03, .03)), dict(cells=6), scene='cylinder', cells=10)
for cells, points in (4, 2), (8, 3), (16, 2):
	add(f'footing-{cells}', 'known.example', dict(error=(-.04, .04)) if cells >= 8 else dict(error=(-.1, .1)), scene='footing', cells=cells, pointsPerCell=points, depth=.03)
add('footing-rough', 'known.example', dict(error=(-.04, .04)), scene='footing', cells=8, pointsPerCell=3, depth=.03, rough=1)

# Cost: the part of an iteration with a plate on 5 % of the cells, and microseconds a place by their number
for dim, wide in (2, 80), (3, 10):
	for friction in 0., .1:
		add(f'cost-{dim}d-{friction:g}', 'cost.share', dict(share=atMost(.25)), dim=dim, wide=wide, friction=friction)
for dim, wide in (2, 40), (3, 12):
	add(f'cost-ball-{dim}d', 'cost.ball', dict(more=atMost(.2)), dict(runs=1), dim=dim, wide=wide)
add('cost-search', 'cost.search', dict(growth=atMost(2)))

for inTime in False, True:
	for friction in 0., .6:
		add(f"cost-bodies-{'time' if inTime else 'static'}-{friction:g}", 'cost.bodies', dict(times=atMost(1.3)), dict(wide=64, deep=24), friction=friction, inTime=inTime)

for dim, cells in (2, 55), (3, 11):
	add(f'cost-itself-{dim}d', 'cost.itself', dict(times=atMost(1.1)), dict(runs=1), dim=dim, cells=cells, steps=12 if dim == 2 else 6)

# A body of points that folds, against two bodies, and without supports
for dim, steps in (2, 40), (3, 24):
	add(f'fold-{dim}d', 'folding.legs', dict(force=near(1, .02), off=atMost(.02)), dim=dim, steps=steps)
add('fold-free', 'folding.free', dict(momentum=atMost(1e-12), gain=atMost(1e-3), narrowest=atMost(.5), last=atLeast(1)))

# 9. Random scenes: the part of them that ends, and the largest of what is left over of the forces in statics
add('random', 'scenes.drawn', dict(ended=atLeast(.995), balance=atMost(1e-6)), dict(seeds=[0, 60], seconds=120), seeds=[0, 1000])
add('random-stabilised', 'scenes.drawn', dict(ended=atLeast(.995), balance=atMost(1e-6)), dict(seeds=[0, 60], seconds=120), seeds=[0, 1000], ghost=.1)

# 10. Bodies of points that meet, at random: the part of the scenes that ends, how many win energy, and what is left over of forces in statics, of momenta in time
add('meeting', 'meeting.drawn', dict(ended=atLeast(.995), gains=atMost(0), balance=atMost(1e-6)), dict(seeds=[0, 30], seconds=60), seeds=[0, 300], seconds=300)
