# SPDX-License-Identifier: GPL-2.0-or-later
"""Cohesive grains for mpm_vs_dem.py: one layer of spheres that move in the x-y plane only, without friction between them.

The layer counts as one mean diameter thick, which turns forces into stresses. A contact resists tension and shear up to its adhesion;
after slip in shear it stays, and new contacts have adhesion, too: a ductile material whose strength is cohesion, with hardly any
friction.
"""
import time

import numpy as np
from yade import utils
from yade.minieigenHP import Matrix3
from yade.wrapper import *

O = Omega()

young, adhesion, density = 2e7, 8e4, 2500.  # grains: stiffness and strength of contacts [Pa], density [kg/m3]
stretch = 0.2  # mean diameters by which a contact can be pulled apart before it breaks
spread = 0.3  # radii are within this part of the mean
apart = 1.15  # vertical distance of grains that fall into a silo, over that in a layer
compaction = 5e3  # pressure [Pa] under which grains are packed


def _grain(position, radius, moves=True):
	grain = utils.sphere(position, radius, material='grains', fixed=not moves)
	if moves: grain.state.blockedDOFs = 'zXY'
	return grain


def _materials(friction=0):
	O.materials.append(CohFrictMat(young=young, poisson=0.3, density=density, frictionAngle=friction, normalCohesion=adhesion, shearCohesion=adhesion, fragile=False, label='grains'))
	O.materials.append(FrictMat(young=young, poisson=0.3, density=density, frictionAngle=0, label='wall'))


def _engines(diameter, adhesive, further=[], gravity=(0, 0, 0)):
	contacts = Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=adhesive)
	return [
	        ForceResetter(),
	        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb(), Bo1_Wall_Aabb()], verletDist=0.075 * diameter),
	        InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D(), Ig2_Box_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [contacts, Ip2_FrictMat_FrictMat_FrictPhys()],
	                        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(), Law2_ScGeom_FrictPhys_CundallStrack()]),
	        *further,
	        *([PyRunner(iterPeriod=50, initRun=True, command=f'import sys; sys.modules["grains"].makeDuctile({stretch * diameter})')] if adhesive else []),
	        NewtonIntegrator(damping=0.2, gravity=gravity, label='newton'),
	]


def makeAdhesive():
	"""Give the contacts that exist the adhesion that new ones have."""
	for contact in O.interactions:
		if isinstance(contact.phys, CohFrictPhys): contact.phys.initCohesion = True


def makeRough(friction):
	"""Give grains and their contacts a friction angle [rad]."""
	O.materials['grains'].frictionAngle = friction
	for contact in O.interactions: contact.phys.tangensOfFrictionAngle = np.tan(friction)


def makeDuctile(unpMax):
	"""Contacts in tension flow at their strength until they are pulled apart by *unpMax* [m]; YADE would break them at once."""
	for contact in O.interactions:
		if isinstance(contact.phys, CohFrictPhys) and contact.phys.unpMax == 0: contact.phys.unpMax = unpMax


class Layer:
	"""A periodic layer of grains, about *width* by *height* [m], packed without adhesion and friction. Then adhesion is switched on, or *friction* [rad] without adhesion."""

	def __init__(self, width, height, diameter, seed=1, friction=0):
		self.diameter = self.thickness = diameter
		self.friction = friction
		self.depth = 4 * diameter # depth of the periodic cell
		O.reset()
		O.periodic = True
		_materials()
		random, loose = np.random.default_rng(seed), 1.25
		columns, rows = round(width / diameter * 1.03), round(height / diameter * 1.03)
		O.cell.setBox(loose * width, loose * height, self.depth)
		for i in range(columns):
			for j in range(rows):
				x, y = (np.array([i, j]) + 0.5 + random.uniform(-0.15, 0.15, 2)) * (loose * width / columns, loose * height / rows)
				O.bodies.append(_grain((x, y, self.depth / 2), diameter / 2 * random.uniform(1 - spread, 1 + spread)))
		O.dt = 0.4 * utils.PWaveTimeStep()
		packing = self._control((compaction, compaction), 0b011, (0.5, 0.5))
		packing.doneHook = 'O.pause()'
		O.engines = _engines(diameter, adhesive=False, further=[packing])
		O.run(300000, wait=True)
		self.width, self.height = O.cell.size[0], O.cell.size[1]
		self.packed = self.grains()
		self.density = sum(b.state.mass for b in O.bodies) / (self.width * self.height * self.thickness)
		O.cell.velGrad = Matrix3.Zero
		O.cell.trsf = Matrix3.Identity
		O.engines = _engines(diameter, adhesive=not friction)
		if friction: makeRough(friction)
		else: makeAdhesive()
		O.run(1000, wait=True)

	def _control(self, goal, pressures, rates):
		"""YADE's engine that brings the cell to a pressure [Pa] or strain along x and y; bits of *pressures* say to which."""
		share = self.thickness / self.depth # YADE averages stress over the depth of the cell
		goal = [-g * share if pressures & 1 << axis else -g for axis, g in enumerate(goal)]
		return PeriTriaxController(dynCell=True, mass=2 * sum(b.state.mass for b in O.bodies), goal=(*goal, 0), stressMask=pressures,
		                           maxStrainRate=(*rates, 0), maxUnbalanced=5e-3, relStressTol=2e-2, globUpdate=5)

	def stress(self):
		"""Mean stress (sigma_xx, sigma_yy) [Pa], positive in tension."""
		return np.array(utils.getStress().diagonal())[:2] * self.depth / self.thickness

	def oedometer(self, strain=1e-3, rate=0.01, readings=10):
		"""A small compression along y without strain along x, as a test for mpm.calibrate: growth of the stresses over the strain."""
		O.saveTmp()
		before, rows = self.stress(), []
		O.cell.velGrad = Matrix3(0, 0, 0, 0, -rate, 0, 0, 0, 0)
		for i in range(readings):
			O.run(max(1, round(strain / readings / rate / O.dt)), wait=True)
			rows.append((np.log(O.cell.trsf[1, 1]), *(self.stress() - before)))
		O.loadTmp()
		along, x, y = np.transpose(rows)
		return dict(kind='oedometer', axialStrain=along, stress_xx=x, stress_yy=y, name='oedometer')

	def biaxial(self, pressure, strain, rate=0.05, readings=60):
		"""Compression along y under constant pressure [Pa] along x, as a test for mpm.calibrate: stress along y over the strain.

		The pressure is kept to 2 %, by which the stress along y is set right. Volumetric strains are there, too, but not for laws whose flow keeps the volume.
		"""
		O.saveTmp()
		O.engines = _engines(self.diameter, adhesive=not self.friction, further=[self._control((pressure, 1.5 * strain), 0b001, (0.5, rate))])
		rows = []
		for _ in range(readings):
			for _ in range(round(strain / readings / rate / O.dt)):
				O.step() # O.run(n, wait=True) looks only every 40 ms whether it has ended: longer than it takes here
			x, y = self.stress()
			rows.append((np.log(O.cell.trsf[1, 1]), y - x - pressure, np.log(O.cell.trsf.determinant())))
		O.loadTmp()
		along, y, volume = np.transpose(rows)
		return dict(kind='biaxial', confiningPressure=pressure, axialStrain=along, stress_yy=y, volumetricStrain=volume, name=f'biaxial, {pressure / 1e3:g} kPa')

	def grains(self):
		"""(N, 3) x, y, radius [m] of the grains, with a corner of the cell in the origin."""
		wrapped = [O.cell.wrap(b.state.pos) for b in O.bodies]
		return np.array([(p[0], p[1], b.shape.radius) for p, b in zip(wrapped, O.bodies)])


def cutScene(layer, height, length, front):
	"""Replace the scene by a cut of *height* and *length* [m] out of a layer, on a base of fixed grains that reaches as far as x = *front*.

	The left side, at x = 0, is a smooth wall. The base ends at y = 0.
	"""
	x, y, radius = layer.grains().T
	diameter, width = layer.diameter, layer.width
	O.reset()
	_materials()
	O.dt = 0.4 * np.sqrt(density / young) * radius.min()  # time step of utils.PWaveTimeStep
	base = y < diameter
	for shift in np.arange(0, front, width):
		O.bodies.append([_grain((i + shift, j - diameter, 0), r, moves=False) for i, j, r in zip(x[base], y[base], radius[base]) if i + shift < front])
	inside = ~base & (x > radius) & (x < length) & (y < height + diameter)
	O.bodies.append([_grain((i, j - diameter, 0), r) for i, j, r in zip(x[inside], y[inside], radius[inside])])
	O.bodies.append(utils.wall(0, axis=0, material='wall'))
	O.engines = _engines(diameter, adhesive=True)
	O.step()
	makeAdhesive()
	O.run(3000, wait=True)
	for b in O.bodies:
		b.state.refPos = b.state.pos
	O.resetTime()


def grainArrays(thickness):
	"""Arrays of the grains that move, as mpm.arrays() of points: ``pos``, ``pos0``, ``halfSize``, and ``force``, sigma_yy times volume [N m].

	Forces are per metre of thickness.
	"""
	tensors = utils.bodyStressTensors()
	moving = [b for b in O.bodies if isinstance(b.shape, Sphere) and b.dynamic]
	return {
	        'pos': np.array([b.state.pos for b in moving]),
	        'pos0': np.array([b.state.refPos for b in moving]),
	        'halfSize': np.array([[b.shape.radius] * 3 for b in moving]),
	        'force': np.array([tensors[b.id][1, 1] * 4 / 3 * np.pi * b.shape.radius**3 for b in moving]) / thickness,
	}


def betweenWalls(layer, height, length, front, g):
	"""Replace the scene by rough grains out of a layer, *length* by *height* [m], at rest under gravity *g* between smooth walls; the base is as cutScene's. Returns the ids of grains and walls."""
	x, y, radius = layer.grains().T
	diameter, width = layer.diameter, layer.width
	O.reset()
	_materials(layer.friction)
	O.dt = 0.4 * np.sqrt(density / young) * radius.min()
	base, ids = y < diameter, []
	for shift in np.arange(-width, front, width):
		O.bodies.append([_grain((i + shift, j - diameter, 0), r, moves=False) for i, j, r in zip(x[base], y[base], radius[base]) if -diameter < i + shift < front])
	inside = ~base & (x > radius) & (x < length - radius) & (y < height + diameter)
	ids = O.bodies.append([_grain((i, j - diameter, 0), r) for i, j, r in zip(x[inside], y[inside], radius[inside])])
	left, right = (O.bodies.append(utils.wall(at, axis=0, sense=sense, material='wall')) for at, sense in ((0, 1), (length, -1)))
	O.engines = _engines(diameter, adhesive=False, gravity=(0, -g, 0))
	while O.iter < 3000 or max(O.bodies[i].state.vel.norm() for i in ids) > 0.02 * np.sqrt(g * diameter): O.run(500, wait=True)
	return ids, left, right


def columnScene(layer, height, length, front, g):
	"""The same without the right wall: a column of grains that is let go. Returns the ids of the grains."""
	ids, _, right = betweenWalls(layer, height, length, front, g)
	letGo(right)
	return ids


def _settle(ids, speed2):
	"""Goes on until no grain is faster than a fiftieth of a speed, which is given by its square [m2/s2]."""
	O.run(3000, wait=True)
	while max(O.bodies[i].state.vel.norm() for i in ids) > 0.02 * np.sqrt(speed2): O.run(1000, wait=True)


def siloScene(layer, height, width, opening, g, wallFriction, lowered):
	"""Replace the scene by a plane silo of rough grains, *width* by *height* [m] with its axis at x = 0, at rest under gravity *g*: walls with their own friction angle [rad], a rough base, and in its middle a door. Grains of a layer fall from apart, as in filling by rain; then the base is lowered by a length [m] to y = 0, which makes the walls rub. Returns the ids of grains, walls, base and door."""
	x, y, radius = layer.packed.T
	O.reset()
	_materials(layer.friction)
	for label, angle in ('side', wallFriction), ('base', layer.friction): O.materials.append(FrictMat(young=young, poisson=0.3, density=density, frictionAngle=angle, label=label))
	O.dt = 0.4 * np.sqrt(density / young) * radius.min()
	inside = (x > radius) & (x < width - radius) & (y > radius) & (y < height)
	ids = O.bodies.append([_grain((i - width / 2, lowered + apart * j, 0), r) for i, j, r in zip(x[inside], y[inside], radius[inside])])
	walls = [O.bodies.append(utils.wall(sense * -width / 2, axis=0, sense=sense, material='side')) for sense in (1, -1)]
	thick, part = layer.diameter, (width - opening) / 4
	box = lambda at, half: O.bodies.append(utils.box((at, lowered - thick, 0), (half, thick, 2 * thick), material='base', fixed=True))
	base, door = [box(side * (opening / 2 + part), part) for side in (-1, 1)], box(0, opening / 2)
	O.engines = _engines(layer.diameter, adhesive=False, gravity=(0, -g, 0))
	O.engines[-1].damping = 0.8  # an impact would lock pressure in between the walls
	_settle(ids, g * layer.diameter)
	plates, speed = [O.bodies[i] for i in (*base, door)], 0.1 * np.sqrt(g * layer.diameter)
	for plate in plates: plate.state.vel = (0, -speed, 0)
	O.run(round(lowered / speed / O.dt), wait=True)
	for plate in plates: plate.state.vel = (0, 0, 0)
	_settle(ids, g * layer.diameter)
	return ids, walls, base, door


def letGo(body):
	"""Take away a body that grains rest on, and most of the damping."""
	O.bodies.erase(body)
	O.engines[-1].damping, O.engines[-1].dampGravity = 0.05, False


def strength(layer, pressures, strain):
	"""Friction angle at the peak and over the last third, dilation angle at the peak [degrees] and shortening from the peak to half of the fall, means of biaxial tests; shortening and mobilised angle in the last of them."""
	angles = []
	for pressure in pressures:
		test = layer.biaxial(pressure, strain, readings=30)
		along, growth, volume = -test['axialStrain'], -test['stress_yy'], test['volumetricStrain']
		mobilised = growth / (growth + 2 * pressure)
		peak = max(2, mobilised.argmax())
		near = slice(max(0, peak - 3), peak + 4)
		opens = np.polyfit(along[near], volume[near], 1)[0]
		half = along[peak:][mobilised[peak:] < (mobilised.max() + mobilised[-10:].mean()) / 2]
		angles.append([*np.degrees(np.arcsin([mobilised.max(), mobilised[-10:].mean(), opens / (2 + opens)])), half[0] - along[peak] if len(half) else strain])
	return np.mean(angles, axis=0), along, np.degrees(np.arcsin(mobilised))


def meanStrength(options, diameter, friction):
	"""Means of strength over the samples of all seeds of a script, which are printed: friction angle at the peak and at large strain, dilation angle [degrees], shortening of the fall."""
	began, size, seeds, pressures = time.process_time(), options.sample / options.grains, options.seeds.split(), [float(pressure) for pressure in options.pressures.split()]
	peak, last, opens, fall = np.mean([strength(Layer(size, size, diameter, int(seed), friction), pressures, options.strain)[0] for seed in seeds], axis=0)
	print(f'grains: friction {peak:.1f} degrees at the peak, {last:.1f} at large strain, dilation {opens:.1f}; {time.process_time() - began:.0f} s for {len(seeds)} samples', flush=True)
	return peak, last, opens, fall
