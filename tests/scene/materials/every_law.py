# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of each law in each kind of analysis, for test_every_law.py: one process for all of them, as JSON {law: {check: [name of the exception or '', its sentence or what was found]}}.

The argument is the library of the user material.
"""
import json
import sys
from pathlib import Path

from scenes import *
from yade.wrapper import *

degree = np.pi / 180
elastic = dict(young=20e6, poisson=.3, density=2000)
friction = dict(cohesion=5e3, frictionAngle=30 * degree, dilationAngle=10 * degree, **elastic)
softening = dict(residualCohesion=1e3, residualFrictionAngle=25 * degree, softeningStrain=.005, **friction)
clay = dict(density=2000, shearModulus=5e6, criticalStateRatio=1.2, compressionIndex=.1, swellingIndex=.02, preconsolidation=1e5, referencePressure=1e3)
soil = dict(density=2000, E50ref=30e6, Eoedref=30e6, Eurref=90e6, power=.5, cohesion=1e3, frictionAngle=35 * degree, dilationAngle=5 * degree, K0nc=.43)
sand = dict(
        density=2000, shearModulus=45e6, swellingIndex=.0015, referencePressure=100e3, criticalStateRatio=1.27, compressionIndex=.02, criticalVolume=1.8911, hardening=70,
        specificVolume=1.75
)
small = dict(G0ref=150e6, gamma07=1e-4)
metal = dict(yieldStress=40e3, hardening=1e5, **elastic)

# a class, its attributes, and settings of the engine
laws = {
        'elastic': (MpmElasticMat, elastic, {}),
        'von Mises': (MpmVonMisesMat, metal, {}),
        'Tresca': (MpmTrescaMat, dict(undrainedStrength=30e3, **elastic), {}),
        'Drucker-Prager': (MpmDruckerPragerMat, friction, {}),
        'Mohr-Coulomb': (MpmMohrCoulombMat, friction, {}),
        'Drucker-Prager, power': (MpmDruckerPragerMat, dict(power=.5, **friction), {}),
        'Mohr-Coulomb, power': (MpmMohrCoulombMat, dict(power=.5, **friction), {}),
        'softening': (MpmMohrCoulombMat, softening, {}),
        'softening, nonlocal': (MpmMohrCoulombMat, softening, dict(nonlocalLength=.75)),
        'Cam clay': (MpmCamClayMat, clay, {}),
        'hardening soil': (MpmHardeningSoilMat, soil, {}),
        'hardening soil, small strain': (MpmHardeningSoilMat, small | soil, {}),
        'NorSand': (MpmNorSandMat, sand, {}),
        'viscous von Mises': (MpmVonMisesMat, dict(viscosity=1e4, **metal), {}),
        'viscous Drucker-Prager': (MpmDruckerPragerMat, dict(viscosity=1e4, **friction), {}),
        'relaxing Mohr-Coulomb': (MpmMohrCoulombMat, dict(relaxationTime=.02, **friction), {}),
        'relaxing softening': (MpmMohrCoulombMat, dict(relaxationTime=.02, **softening), dict(nonlocalLength=.75)),
        'relaxing Cam clay': (MpmCamClayMat, dict(relaxationTime=.02, **clay), {}),
        'relaxing hardening soil': (MpmHardeningSoilMat, dict(relaxationTime=.02, **small, **soil), {}),
        'relaxing NorSand': (MpmNorSandMat, dict(relaxationTime=.02, **sand), {}),
        'user': (MpmUserMat, dict(library=sys.argv[1], parameters=[20e6, .3, 40e3, 1], stateVariables=[0], **elastic), {}),
}
flowing = [name for name in laws if name.startswith(('viscous', 'relaxing'))]
ratios = dict(user=.5)  # K0, where it is to be given
side, dt, weight = 2, .01, 2000 * 9.81


def material(name, **changes):
	Class, attributes, _ = laws[name]
	return Class(label='soil', **attributes | changes)


def engineOf(name):
	return MpmDynamicEngine if name in flowing else MpmImplicitEngine


def ground(name, Engine, cover=1, changes={}, **settings):
	"""Level ground of 4 x 4 cells at rest, *cover* metres below its surface; a footing on the left half of it goes down by 8 mm in the second to the fifth step."""
	O.reset()
	O.materials.append(material(name, **changes))
	grid = MpmGrid(cellSize=side / 4)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (side, side, 1)), grid, 2, 'soil'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(side, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	curve = [(dt, 0), (5 * dt, 1)]
	if cover: held += [MpmBoundary(min=(-inf, side, -inf), max=(side / 2, inf, inf), fix='y', displacement=(0, -.008, 0), curve=curve)]
	loads = [MpmTraction(surface=[(side, side), (0, side)], pressure=cover * weight, curve=[(0, 1)])] if cover else []
	solver = Engine(grid=grid, gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], boundaries=held, loads=loads, fBar=True, verbosity=0, **laws[name][2], **settings)
	O.engines, O.dt = [solver], dt
	mpm.geostatic(K0=ratios.get(name), OCR=1.5, surface=side + cover)
	return solver


def atRest(ofSoil=weight, ofSurface=weight):
	"""Errors of the first step: vertical stress over that of the weight, K0 that does not vary, and displacement [m]."""
	before = mpm.arrays()
	O.step()
	after = mpm.arrays()
	expected = -(ofSurface + ofSoil * (side - before['pos'][:, 1]))
	ratio = after['stress'][:, 0, 0] / after['stress'][:, 1, 1]
	return dict(stress=float(np.abs(after['stress'][:, 1, 1] / expected - 1).max()), ratio=float(ratio.mean()), spread=float(np.ptp(ratio)), moved=float(np.abs(after['pos'] - before['pos']).max()))


def settle(solver):
	"""Two steps with F-bar and two without: the pressures below the footing, and whether all is finite."""
	O.run(2, wait=True)
	solver.fBar = False
	O.run(2, wait=True)
	after = mpm.arrays()
	isFinite = all(np.isfinite(after[name]).all() for name in ('pos', 'stress', 'defGrad', 'elasticStrain', 'plasticStrain'))
	footing = (after['pos0'][:, 0] < side / 2) & (after['pos0'][:, 1] > .9 * side)
	return dict(isFinite=isFinite, pressed=float(-after['stress'][footing, 1, 1].mean() / weight), plastic=float(after['plasticStrain'].max()), settled=float((after['pos'] - after['pos0'])[footing, 1].mean()))


def moving(name, Engine):
	solver = ground(name, Engine)
	return atRest() | settle(solver)


def explicit(name):
	"""At rest in a step, and moved by the footing in four."""
	solver = ground(name, MpmDynamicEngine, scheme='explicit')
	O.dt = .3 * solver.criticalTimeStep()
	footing = solver.boundaries[-1]
	footing.curve, footing.displacement = [(O.dt, 0), (5 * O.dt, 1)], (0, -5e-4, 0)
	found = atRest()
	O.run(4, wait=True)
	after = mpm.arrays()
	return found | dict(isFinite=bool(np.isfinite(after['stress']).all()), settled=float((after['pos'] - after['pos0'])[:, 1].min()))


def restart(name):
	"""Columns that have other bits after a restart amidst; columns by their name in arrays and files, and those that have changed."""
	ground(name, engineOf(name))
	first = mpm.arrays()
	O.engines += [MpmVtkRecorder(fileName='law-', iterPeriod=4)]
	O.run(3, wait=True)
	O.save('middle.yade.gz')
	O.run(1, wait=True)
	straight = mpm.arrays()
	files = sorted(Path('.').glob('law-*.vtu'))  # files of the first step and the fourth
	text = files[-1].read_bytes()
	for file in files:
		file.unlink()
	O.load('middle.yade.gz')
	O.run(1, wait=True)
	after = mpm.arrays()
	other = [column for column in straight.keys() | after.keys() if column not in after or column not in straight or after[column].tobytes() != straight[column].tobytes()]
	known = [column for column in straight if f'"{column}"'.encode() in text and np.isfinite(straight[column]).all()]
	return dict(other=other, columns=known, changed=[column for column in known if column not in first or (first[column] != straight[column]).any()])


def water(name):
	"""Ground below the water."""
	solver = ground(name, engineOf(name))
	solver.water = [MpmWater(level=side)]
	mpm.geostatic(K0=ratios.get(name), OCR=1.5, surface=side + 1)
	return atRest(weight - 9810)


def undrained(name):
	solver = ground(name, engineOf(name), changes=dict(undrained=True, waterModulus=1e9))
	found = atRest() | settle(solver)
	excess = mpm.arrays()['excessPressure']
	return found | dict(excess=float(excess.max() / weight))


def strength(name):
	"""A bank of which the right side is let go, if it can be."""
	attributes = laws[name][1]
	isPlain = 'young' in attributes and name not in flowing
	solver = ground(name, MpmImplicitEngine, cover=0, changes=dict(cohesion=20e3) if isPlain and 'cohesion' in attributes else {})
	solver.boundaries = [solver.boundaries[0], solver.boundaries[2]]
	if isPlain: O.run(2, wait=True)
	found = mpm.strengthReduction(tolerance=.3, factor=2.)
	return dict(lower=found['lower'], upper=found['upper'])


def excavation(name):
	"""The upper quarter is dug out in two steps: what its weight was is gone from below."""
	ground(name, engineOf(name), cover=0)
	mpm.stages.excavate(pack.inAlignedBox((0, .75 * side, -1), (side, side, 1)), steps=2)
	O.run(3, wait=True)
	after = mpm.arrays()
	depth = .75 * side - after['pos0'][:, 1]
	return dict(points=len(after['id']), stress=float(np.abs(after['stress'][:, 1, 1] + weight * depth).max() / weight), heave=float((after['pos'] - after['pos0'])[:, 1].max()))


def replacement(name):
	"""The lower half of elastic ground becomes ground of this law, and stays at rest."""
	solver = ground('elastic', engineOf(name), cover=0)
	solver.nonlocalLength = laws[name][2].get('nonlocalLength', 0)
	mpm.geostatic(K0=.7)
	new = material(name)
	new.label = 'new'
	O.materials.append(new)
	O.step()
	before = mpm.arrays()
	count = mpm.stages.replace(pack.inAlignedBox((0, 0, -1), (side, side / 2, 1)), 'new')
	O.step()
	after = mpm.arrays()
	return dict(points=count, moved=float(np.abs(after['pos'] - before['pos']).max()), stress=float(np.abs(after['stress'] - before['stress']).max() / weight))


ofPressure = {name: dict(capPressure=200e3) for name in laws if 'hardening soil' in name}


def element(name):
	curve = mpm.elementTest(material(name), 'triaxial', -.01, steps=10, confiningPressure=50e3, duration=1, **ofPressure.get(name, {}))
	return dict(kept=float(np.abs(curve['stress'][:, 0, 0] / -50e3 - 1).max()), q=float(curve['q'][-1]), isFinite=all(bool(np.isfinite(values).all()) for values in curve.values()))


def tangent(name):
	return mpm.checkLaw(material(name), strain=4e-3 if 'NorSand' in name else 1e-2, initialStress=(-40e3, -85e3, -40e3), samples=8, duration=.01, **ofPressure.get(name, {}))


checks = dict(
        static=lambda name: moving(name, MpmImplicitEngine), dynamic=lambda name: moving(name, MpmDynamicEngine), explicit=explicit, restart=restart, water=water,
        undrained=undrained, strength=strength, excavation=excavation, replacement=replacement, element=element, tangent=tangent
)


def outcome(check, name):
	try:
		return ['', checks[check](name)]
	except Exception as error:
		return [type(error).__name__, str(error)]


print(json.dumps({name: {check: outcome(check, name) for check in checks} for name in laws}))
