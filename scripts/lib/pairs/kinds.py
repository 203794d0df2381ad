# SPDX-License-Identifier: GPL-2.0-or-later
"""Kinds of scenes that are drawn as wholes: rigid bodies, bodies of points, water, structures, laws, energy. Nothing here needs YADE."""
from math import atan, cos, pi, sin

from .kind import Kind, density, gravity, young
from .view import inf

kinds = {}
stress, strength = dict(S=1), 'yieldStress'


def kind(name):

	def add(Class):
		kinds[name] = Class
		return Class

	return add


elastic = dict(young=(young, stress), poisson=.3)
friction = dict(cohesion=(6e3, stress), frictionAngle=.5, dilationAngle=.1, **elastic)
simple = {
        'elastic': ('MpmElasticMat', elastic), 'vonMises': ('MpmVonMisesMat', dict(yieldStress=(2e4, stress), **elastic)), 'tresca': ('MpmTrescaMat', dict(undrainedStrength=(1.5e4, stress), **elastic)),
        'mohrCoulomb': ('MpmMohrCoulombMat', friction), 'druckerPrager': ('MpmDruckerPragerMat', friction)
}
clay = dict(shearModulus=(5e6, stress), criticalStateRatio=1.2, compressionIndex=.1, swellingIndex=.02, preconsolidation=(1e5, stress), referencePressure=(1e3, stress))
stiff = dict(young=(2e7, stress), poisson=.3)
sand = dict(cohesion=(5e3, stress), frictionAngle=.55, dilationAngle=.15, **stiff)
hardening = dict(
        E50ref=(3e7, stress), Eoedref=(3e7, stress), Eurref=(9e7, stress), power=.5, cohesion=(1e3, stress), frictionAngle=.61, dilationAngle=.09, K0nc=.43, referencePressure=(1e5, stress)
)
norSand = dict(
        shearModulus=(45e6, stress), swellingIndex=.0015, referencePressure=(1e5, stress), criticalStateRatio=1.27, compressionIndex=.02, criticalVolume=1.8911, criticalPressure=(1e3, stress),
        hardening=70., specificVolume=1.75
)
power = dict(power=.5, referencePressure=(1e5, stress))
viscous = dict(viscosity=(1e4, dict(S=1, T=1)))
relaxing = dict(relaxationTime=(.02, dict(T=1)))
softening = dict(residualCohesion=(1e3, stress), residualFrictionAngle=.44, softeningStrain=.005)
every = {
        'elastic': ('MpmElasticMat', stiff), 'vonMises': ('MpmVonMisesMat', dict(yieldStress=(4e4, stress), hardening=(1e5, stress), **stiff)),
        'vonMises softening': ('MpmVonMisesMat', dict(yieldStress=(4e4, stress), hardening=(-2e5, stress), residualYieldStress=(3e4, stress), **stiff)),
        'tresca': ('MpmTrescaMat', dict(undrainedStrength=(3e4, stress), **stiff)), 'mohrCoulomb': ('MpmMohrCoulombMat', sand), 'druckerPrager': ('MpmDruckerPragerMat', sand),
        'mohrCoulomb power': ('MpmMohrCoulombMat', power | sand), 'druckerPrager power': ('MpmDruckerPragerMat', power | sand), 'mohrCoulomb softening': ('MpmMohrCoulombMat', softening | sand),
        'camClay': ('MpmCamClayMat', clay), 'hardeningSoil': ('MpmHardeningSoilMat', hardening),
        'hardeningSoil small': ('MpmHardeningSoilMat', dict(G0ref=(1.5e8, stress), gamma07=1e-4) | hardening), 'norSand': ('MpmNorSandMat', norSand),
        'vonMises viscous': ('MpmVonMisesMat', viscous | dict(yieldStress=(4e4, stress), **stiff)), 'druckerPrager viscous': ('MpmDruckerPragerMat', viscous | sand),
        'mohrCoulomb relaxing': ('MpmMohrCoulombMat', relaxing | sand), 'camClay relaxing': ('MpmCamClayMat', relaxing | clay), 'hardeningSoil relaxing': ('MpmHardeningSoilMat', relaxing | hardening),
        'norSand relaxing': ('MpmNorSandMat', relaxing | norSand)
}


@kind('laws')
class Laws(Kind):
	"""Level ground under a surcharge, at rest; then nodes of its surface move down, up or along."""
	imbalance = .1  # nodes are moved from one step to the next: goes with the time step
	admitted = dict(finer=.6, shorter=.1)  # nodes that are moved depend on the cells
	dims = (2, 2, 2, 3)
	depth = 1.

	def plan(self, draw):
		self.law = draw.choice(list(every))
		self.isDynamic = self.law.endswith(('viscous', 'relaxing')) or draw.random() < .2
		self.scheme = draw.choice(['newmark', 'generalised-alpha', 'midpoint'])
		self.perCell = draw.choice([1, 2, 2, 3]) if self.dim == 2 else draw.choice([1, 2])
		self.cover, self.OCR = draw.choice([.5, 1., 3.]), draw.choice([1., 1.5, 3.])
		self.fBar, self.isNonlocal = draw.random() < .5, 'softening' in self.law and draw.random() < .5
		self.isUndrained = draw.random() < .25
		self.way = draw.choice([(0, -.01, 0), (0, -.002, 0), (0, .002, 0), (.004, -.004, 0)])
		self.isBalanced, self.isExact = not self.isDynamic, 'norSand' not in self.law  # NorSand takes logarithms of pressures
		if self.dim == 3: self.side = 1.
		self.isEnergyKnown = not self.law.startswith(('camClay', 'hardeningSoil', 'norSand')) and 'power' not in self.law  # the balance is that of Hencky's elasticity
		if self.isDynamic: self.dt, self.admitted = .01, dict(finer=.6, shorter=.35)

	def write(self, text):
		v, W = text.view, self.side
		name, values = every[self.law]
		if self.isUndrained: values = values | dict(undrained=True, waterModulus=(1e8, stress))
		text.material(name, values)
		text.fill(text.box((0, 0, 0), (W, W, self.depth)), perCell=self.perCell)
		text.sides(0., W)
		fix = 'xy' if self.way[0] else 'y'
		text.boundary((.3 * W, W, -inf), (.8 * W, inf, inf), fix, displacement=v.vector(self.way, v.L))
		top = text.plane((0, W, 0), (W, W, self.depth), 1, 1)
		text.engine['loads'] = f'[{text.traction(top, [(0., 1.)], pressure=self.cover * density * gravity)}]'
		text.write(gravityCurve=[(0., 1.)], fBar=self.fBar, **(dict(nonlocalLength=.75 * v.L) if self.isNonlocal else {}))
		text.add(f'mpm.geostatic(K0={.5 if self.law.startswith(("elastic", "vonMises", "tresca")) else None}, OCR={self.OCR}, surface={text.level(W + self.cover)})')
		text.end()


@kind('flow')
class Flow(Kind):
	"""A block of soil under a load, out of which water flows; in still water or in none, in statics and in time."""
	dims = (2, 2, 2, 3)
	depth = 1.

	def plan(self, draw):
		self.isRing = self.dim == 2 and draw.random() < .25
		self.isDynamic = self.dim == 2 and draw.random() < .25
		self.scheme = draw.choice(['newmark', 'generalised-alpha'])
		self.law = draw.choice(['elastic', 'elastic', 'vonMises', 'mohrCoulomb', 'druckerPrager'])
		self.perCell = draw.choice([2, 2, 3]) if self.dim == 2 else 2
		self.cell = draw.choice([.5, .4])
		nx, ny = draw.choice([(2, 3), (3, 3), (4, 2)]) if self.dim == 2 else (2, 2)
		self.wide, self.high, self.depth = nx * self.cell, (ny + draw.choice([0., .5]) * (self.perCell == 2)) * self.cell, 2 * self.cell
		self.drain = draw.choice(['top', 'top', 'right', 'both'])
		self.drainKind = draw.choice(['pressure', 'pressure', 'level', 'seepage'])
		self.load = draw.choice([dict(pressure=8e3), dict(traction=(0 if self.isRing else 1e3, -6e3, 0))])
		self.onHalf, self.hasWeight = draw.random() < .5, draw.random() < .5
		self.water = draw.choice([None, None, 'level'])
		if self.drainKind != 'pressure': self.water = 'level'
		if self.water: self.hasWeight = True  # a level is along gravity
		self.waterLevel = draw.choice([.5, 1.2]) * self.high
		self.conductivity, self.lawOfFlow = draw.choice([1e-6, 1e-4, 1e-3]), draw.choice(['constant', 'constant', 'kozeny-carman', 'log'])
		self.bulkModulus = draw.choice([inf, 1e7, 2e9]) if not self.isDynamic else draw.choice([1e7, 2e8])
		self.isHeldRight = self.drain == 'top' and draw.random() < .7
		if self.dim == 3 and self.lawOfFlow != 'constant': self.close = 1e-5  # drains ask one of two cells where the corner of a triangle lies on their face
		self.isEnergyKnown = False  # water takes and keeps some
		self.admitted = dict(finer=.5, shorter=.6)
		self.dt = 5. if not self.isDynamic else .005
		self.side = self.high

	def drainsOf(self, text):
		v, found = text.view, []
		W, H, D = self.wide, self.high, self.depth
		for place in ['top', 'right'] if self.drain == 'both' else [self.drain]:
			surface = text.plane((0, H, 0), (W, H, D), 1, 1) if place == 'top' else text.plane((W, 0, 0), (W, H, D), 0, 1)
			kindOf = self.drainKind if place == self.drain else 'pressure'
			value = {'pressure': '', 'level': f', level={text.level(.8 * self.waterLevel)}', 'seepage': ', seepage=True'}[kindOf]
			found.append(f'MpmDrain(surface={v.line(surface)}{value})')
		return found

	def write(self, text):
		v = text.view
		W, H, D = self.wide, self.high, self.depth
		name, values = simple[self.law]
		pores = dict(conductivity=(self.conductivity, dict(L=1, T=-1)), porosity=.4, conductivityLaw=self.lawOfFlow)
		if self.lawOfFlow == 'log': pores['conductivityIndex'] = .6
		text.material(name, values | pores)
		text.fill(text.box((0, 0, 0), (W, H, D)), perCell=self.perCell)
		text.sides(0., W if self.isHeldRight else None)
		text.engine['loads'] = f'[{text.traction(text.plane((0, H, 0), (W / 2 if self.onHalf else W, H, D), 1, 1), [(0., 0.), (self.end / 2, 1.)], **self.load)}]'
		if self.water: text.engine['water'] = f'[MpmWater(level={text.level(self.waterLevel)}, weight={9810 * v.S / v.L})]'
		bulk = '' if self.bulkModulus == inf else f', bulkModulus={self.bulkModulus * v.S}'
		text.engine['flow'] = f'MpmFlow(unitWeight={9810 * v.S / v.L}{bulk}, drains=[{", ".join(self.drainsOf(text))}])'
		if not self.hasWeight: self.gravity = (0., 0., 0.)
		text.write(loadCurve=[(0., 1.)], gravityCurve=[(0., 0.), (self.end / 2, 1.)])
		text.end()


@kind('water')
class Water(Kind):
	"""Still water of a level or of a function of place and time, in the pores, outside or both; on a block with a slope."""
	dims = (2, 2, 3)
	depth = 1.

	def plan(self, draw):
		self.water = True
		self.isRing = self.dim == 2 and draw.random() < .25
		self.isDynamic = draw.random() < .3
		self.scheme = draw.choice(['newmark', 'generalised-alpha', 'midpoint', 'explicit'])
		self.law = draw.choice(list(simple))
		self.perCell = 2
		self.slope = draw.choice([0., .5, 1.]) if self.dim == 2 and not self.isRing else 0.
		self.where = [draw.choice(['everywhere', 'pores', 'outside']) for _ in range(draw.choice([1, 1, 2]))]
		if len(self.where) == 2: self.where = ['pores', 'outside']
		self.how = [draw.choice(['level', 'levels', 'function', 'time']) for _ in self.where]
		self.height = [draw.uniform(.3, 1.6) * self.side for _ in self.where]
		if 'time' in self.how: self.without = ('saved and loaded', )  # files do not keep functions, which is refused by name
		self.lean = 0. if self.isRing else draw.choice([0., .2])
		self.onBoundaries = draw.random() < .3
		self.admitted = dict(finer=.4, shorter=.1)
		if self.isDynamic: self.dt = .003 if self.scheme != 'explicit' else 1e-3
		if self.dim == 3: self.side = 1.

	def waterOf(self, text, number):
		v, height = text.view, self.height[number]
		where = f', where={self.where[number]!r}'
		weight = f', weight={9810 * v.S / v.L}'
		if self.how[number] == 'level': return f'MpmWater(level={text.level(height)}{weight}{where})'
		if self.how[number] == 'levels':
			levels = [(0., text.level(height)), (self.end * v.T, text.level(.8 * height))]
			return f'MpmWater(levels={levels}{weight}{where})'
		rise = f' + {.3 * self.side} * O.time / {self.end * v.T}' if self.how[number] == 'time' else ''
		text.add(f'def pressure{number}(x):\n\tx = placeInScene(x)\n\treturn {9810 * v.S} * max(0., {height} - {self.lean} * x[0] - x[1]{rise})')
		return f'MpmWater(pressure=pressure{number}{where})'

	def write(self, text):
		v, W = text.view, self.side
		text.material(*simple[self.law])
		region = text.polygon([(0, 0), (W + self.slope, 0), (W, W), (0, W)]) if self.slope else text.box((0, 0, 0), (W, W, self.depth))
		text.fill(region, perCell=self.perCell)
		text.sides(0., None)
		text.engine['water'] = f'[{", ".join(self.waterOf(text, k) for k in range(len(self.where)))}]'
		text.write(**(dict(loadCurve=[(0., 1.)], gravityCurve=[(0., 1.)]) if self.isDynamic else {}))
		text.end()


@kind('beams')
class Beams(Kind):
	"""Plates, walls, rings of revolution and bars in or on a block of soil, loaded on one half of its top."""
	isExact = False  # displacements and rotations of a beam have no common scale
	close = 1e-6  # a beam is up to a thousand times as stiff as the soil whose forces Newton's tolerance is of
	dims = (2, 2, 2, 2, 3)
	depth = 1.

	def plan(self, draw):
		self.isRing = self.dim == 2 and draw.random() < .2
		self.isDynamic = self.dim == 2 and draw.random() < .15
		self.scheme = draw.choice(['newmark', 'generalised-alpha', 'midpoint'])
		self.law = draw.choice(['elastic', 'elastic', 'vonMises', 'mohrCoulomb'])
		self.side = 3. if self.dim == 2 else 1.
		self.long = 2 * self.side if self.dim == 2 else 1.5
		self.part = draw.choice(['bar'] if self.dim == 3 else ['plate', 'plate', 'lining'] if self.isRing else ['plate', 'wall', 'wall', 'anchored', 'bar', 'bar'])
		self.x, self.y = draw.uniform(.3, .6) * self.long, draw.uniform(.3, .6) * self.side
		self.toX, self.toY = self.x + draw.choice([-1, 1]) * draw.uniform(.2, .35) * self.long, self.y + draw.uniform(-.25, .25) * self.side
		self.foot = draw.choice([.3, .4, .5]) * self.side + draw.choice([0., .13])
		self.adhesion, self.friction = draw.choice([inf, 0., 2e3]), draw.choice([0., .3])
		self.axial, self.bending = draw.choice([1e7, 1e9]), draw.choice([1e5, 1e6])
		self.plastic = draw.choice([inf, inf, 3e3]) if not self.isRing else inf
		self.weight = draw.choice([0., 2e3]) if self.part != 'plate' else 8e3
		self.hasBond, self.tensionOnly, self.pretension = draw.random() < .5, draw.random() < .5, draw.choice([0., 0., 3e3])
		self.hasHead = draw.random() < .3
		self.water = draw.random() < .15 and self.part in ('wall', 'anchored') or None
		self.isBalanced = not self.isDynamic and not self.weight and not self.water
		self.load = 6e3
		self.admitted = dict(finer=.35, shorter=.15)
		self.lean = draw.choice([0., draw.uniform(-.7, .7)])
		if self.isDynamic: self.dt = .004

	def bar(self, text, line, isOfWall=False):
		v = text.view
		per = 0 if self.dim == 2 else 1  # powers of L beyond those by metre of thickness
		values = dict(axialStiffness=(1e6, dict(S=1, L=1 + per)), tensionOnly=self.tensionOnly)
		if self.hasBond or isOfWall: values |= dict(bond=(5e3, dict(S=1, L=per)), bondStiffness=(5e6, dict(S=1, L=per - 1)))
		if self.pretension: values['pretension'] = (self.pretension, dict(S=1, L=1 + per))
		if self.hasHead and not isOfWall: values['headPlate'] = True
		if self.pretension and (self.hasBond or isOfWall): values['freeLength'] = (.4, dict(L=1))
		return f'MpmReinforcement(line={[v.point(x)[:self.dim] for x in line]}, {", ".join(f"{n}={x!r}" for n, x in text.scaled(values).items())})'

	def beam(self, text, line, **more):
		v = text.view
		if v.order is not None: line = line[::-1]
		values = dict(axialStiffness=(self.axial, dict(S=1, L=1)), bendingStiffness=(self.bending, dict(S=1, L=3)), friction=self.friction, weight=(self.weight, stress))
		if self.adhesion < inf: values['adhesion'] = (self.adhesion, stress)
		if self.plastic < inf: values['plasticMoment'] = (self.plastic, dict(S=1, L=2))
		more = ''.join(f', {name}={value}' for name, value in more.items())
		return f'MpmBeam(line={[v.point(x)[:2] for x in line]}, {", ".join(f"{n}={x!r}" for n, x in text.scaled(values).items())}{more})'

	def structures(self, text):
		W, H, z = self.long, self.side, .45
		a, b = (self.x, self.y, z), (self.toX, self.toY, z)
		if self.part == 'bar': return [self.bar(text, [a, b])]
		if self.part == 'plate': return [self.beam(text, [(0., H, 0), (self.x, H, 0)] if self.isRing else [(.2 * W, H, 0), (.2 * W + self.x, H, 0)])]
		if self.part == 'lining': return [self.beam(text, [(self.x, H, 0), (self.x, self.foot, 0)])]
		wall = [(self.x, H, 0), (self.x + self.lean, self.foot, 0)]
		if self.part == 'wall': return [self.beam(text, wall)]
		head = self.x + self.lean * .6 / (H - self.foot)
		text.add(f'anchor = {self.bar(text, [(head, H - .6, 0), (.4, H - 1.1, 0)], True)}')
		return [self.beam(text, wall, anchors='[anchor]')]

	def write(self, text):
		v, W, H = text.view, self.long, self.side
		text.material(*simple[self.law])
		text.fill(text.box((0, 0, 0), (W, H, self.depth)))
		text.sides(0., W)
		loads = self.structures(text)
		crest = dict(wall=(0, self.x - .01), anchored=(0, self.x - .01), lining=(self.x + .01, W), bar=(0, W / 2)).get(self.part)
		if crest: loads.append(text.traction(text.plane((crest[0], H, 0), (crest[1], H, self.depth), 1, 1), pressure=self.load))
		text.engine['loads'] = f'[{", ".join(loads)}]'
		if self.water:
			text.add(f'def pressure(x):\n\tx = placeInScene(x)\n\treturn {9810 * v.S} * max(0., ({H} if x[0] < {self.x} else {.7 * H}) - x[1])')
			text.engine['water'] = '[MpmWater(pressure=pressure)]'
		text.write(gravityCurve=[(0., 0.), (self.end / 2, 1.)])
		text.end()


@kind('bodies')
class Bodies(Kind):
	"""Two or three bodies of points that press on each other: turned blocks and polygons on a bed, pushed in statics, flying or falling in time. None is thinner than two cells."""
	dims = (2, 2, 2, 2, 3)
	cell, depth = .1, .3

	def plan(self, draw):
		if self.dim == 3: self.without = ('mirrored', 'turned', 'other order', 'finer')  # MpmBodyContact in 3D depends on the triangles of the surface
		self.isDynamic = draw.random() < .5
		self.isFree = self.isDynamic and draw.random() < .5
		self.scheme = draw.choice(['newmark', 'generalised-alpha', 'midpoint', 'explicit'])
		self.yields = draw.random() < .3
		self.E = [young * draw.choice([1., 4., 20.]) for _ in range(2)]
		self.friction, self.adhesion, self.perCell = draw.choice([0., .3, .8]), draw.choice([inf, inf, 2e3]), draw.choice([2, 2, 3]) if self.dim == 2 else 2
		self.speed = draw.choice([.3, 1.])
		self.angle = draw.uniform(-.6, .6)
		self.isBlock = self.dim == 3 or draw.random() < .4
		self.corners = self._corners(draw)
		self.side = .4
		self.dt = .25 if not self.isDynamic else (.1 if self.scheme != 'explicit' else .01) * self.cell / 1.
		if self.scheme == 'explicit' and self.isDynamic: self.dt = 1e-4
		self.without = (*self.without, 'finer', 'shorter')  # a first touch or a blow depends on cells and steps
		self.admitted = dict(finer=.5, shorter=.35)

	def _corners(self, draw):
		x, gap, h = draw.uniform(.35, .5), draw.uniform(.003, .01), self.cell
		if self.isBlock: return [(x - .15, gap), (x + .15, gap), (x + .15, gap + .3), (x - .15, gap + .3)]
		number, radius, turn = draw.choice([4, 5, 6]), draw.uniform(.17, .24), draw.uniform(0, pi)
		corners = [(x + radius * cos(turn + 2 * pi * k / number), radius * sin(turn + 2 * pi * k / number)) for k in range(number)]
		low = min(y for _, y in corners)
		return [(a, b - low + gap) for a, b in corners]

	def write(self, text):
		v, D = text.view, self.depth
		for name, E in zip(('low', 'up'), self.E):
			text.material(*(('MpmVonMisesMat', dict(young=(E, stress), poisson=.3, yieldStress=(E / 60, stress))) if self.yields else ('MpmElasticMat', dict(young=(E, stress), poisson=.3))), label=name)
		(x0, y0), (x1, y1) = (min(c) for c in zip(*self.corners)), (max(c) for c in zip(*self.corners))
		up = text.box((x0, y0, 0), (x1, y1, D)) if self.isBlock else text.polygon(self.corners)
		text.fill(text.box((0, -.3, 0), (.9, 0, D)), up, perCell=self.perCell, names=('low', 'up'))
		if not self.isFree: text.boundary((-inf, -inf, -inf), (inf, -.3, inf), 'xyz', body="'low'")
		if self.dim == 3: text.boundary((-inf, -inf, -inf), (inf, inf, 0), 'z')
		if not self.isDynamic:
			text.boundary((-inf, y1 - 1.5 * .1, -inf), (inf, inf, inf), 'xy', displacement=v.vector((.004 * sin(self.angle), -.006 * cos(self.angle) - .006, 0), v.L), body="'up'")
		adhesion = f', adhesion={self.adhesion * v.S}' if self.adhesion < inf else ''
		text.engine['contacts'] = f"[MpmBodyContact(between=('low', 'up'), friction={atan(self.friction)}{adhesion})]"
		text.write(**(dict(loadCurve=[(0., 1.)], gravityCurve=[(0., 1.)]) if self.isDynamic else dict(gravityCurve=[(0., 1.)])))
		if self.isDynamic:
			flying = v.vector((self.speed * sin(self.angle), -self.speed * cos(self.angle), 0), v.L / v.T)
			text.add('state = mpm.arrays()', 'isUp = np.array([placeInScene(x)[1] > 0 for x in state["pos"]])', f'mpm.assign(velocity=np.outer(isUp, {flying}))')
		text.end()


@kind('contact')
class Contact(Kind):
	"""Rigid bodies, turned as it comes, that are pushed into a block of soil or dragged over it, that the soil falls on, or that are free."""
	dims = (2, 2, 2, 3)
	cell = .1
	depth = .3

	def plan(self, draw):
		self.isRing = self.dim == 2 and draw.random() < .15
		self.isDynamic = not self.isRing and draw.random() < .4
		self.isFree = False
		self.shape = draw.choice(['box', 'sphere', 'clump', 'facets', 'box'] if not self.isRing else ['sphere'])
		self.scheme = draw.choice(['newmark', 'generalised-alpha', 'midpoint', 'explicit'])
		self.law = draw.choice(list(simple))
		self.perCell = draw.choice([2, 2, 3]) if self.dim == 2 else 2
		self.friction, self.adhesion = draw.choice([0., .2, .6]), draw.choice([None, None, 2e3])
		self.stiffness = draw.choice([10., 50.])
		self.x, self.turn, self.gap = draw.uniform(.35, .5), draw.uniform(.1, 1.4), draw.uniform(.001, .004)
		self.sizes = draw.uniform(.08, .2), draw.uniform(.08, .2)
		self.way = (0. if self.isRing else draw.choice([0., 0., .006, -.02]), -draw.uniform(.01, .02), 0.)
		self.spin = 0. if self.isRing else draw.choice([0., 0., .1])
		self.wide, self.high = .9, .4
		self.side = .4
		self.dt = .25 if not self.isDynamic else 2e-3 if self.scheme != 'explicit' else 2e-4
		self.without = ('finer', 'shorter')  # a first touch or a blow depends on cells and steps
		self.isBalanced, self.isEnergyKnown = not self.isDynamic, False  # energy in penalties is left out of the balance
		self.admitted = dict(finer=.6, shorter=.25)

	def body(self, text):
		"""Bodies with their lowest point a gap above the soil."""
		v = text.view
		x, y, z = 0. if self.isRing else self.x, self.high + self.gap, self.depth / 2 if self.dim == 3 else 0.
		a, b = self.sizes
		sphere = lambda x, y, r: f'utils.sphere({v.point((x, y, z))}, {r * v.L}, material="rigid", fixed=True)'
		if self.shape == 'sphere': return [sphere(x, y + a, a)]
		if self.shape == 'clump': return [sphere(x - .07, y + a, a), sphere(x + .08, y + b, b)]
		if self.shape == 'box':
			top = a * abs(sin(self.turn)) + b * abs(cos(self.turn))
			turned = f'utils.Quaternion({v.around((0., 0., 1.))}, {self.turn})'
			return [f'utils.box({v.point((x, y + top, z))}, {v.sizes((a, b, 1. if self.dim == 2 else .1))}, orientation={turned}, material="rigid", fixed=True)']
		tip, left, right = (x, y), (x - a, y + b), (x + b, y + a)
		if self.dim == 2: pieces = [[(*p, -.5), (*q, -.5), ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, .7)] for p, q in ((left, tip), (tip, right))]
		else: pieces = [[(*p, i), (*q, i), (*(p if k else q), j)] for p, q in ((left, tip), (tip, right)) for k, (i, j) in enumerate(((-.03, .33), (.33, -.03)))]
		return [f'utils.facet({[v.point(c) for c in corners]}, material="rigid", fixed=True)' for corners in pieces]

	def write(self, text):
		v = text.view
		text.material(*simple[self.law])
		text.add(f'O.materials.append(FrictMat(young={young * v.S}, poisson=.3, density={density * v.D}, frictionAngle=0., label="rigid"))')
		text.fill(text.box((0, 0, 0), (self.wide, self.high, self.depth)), perCell=self.perCell)
		text.sides(0., self.wide)
		bodies = self.body(text)
		if self.shape == 'clump': text.add(f'clump, members = O.bodies.appendClumped([{", ".join(bodies)}])', 'rigid = [O.bodies[clump]]')
		else: text.add(f'rigid = [O.bodies[i] for i in O.bodies.append([{", ".join(bodies)}])]')
		speed = v.vector([x / self.end for x in self.way], v.L / v.T)
		text.add(f'for body in rigid:\n\tbody.dynamic = False\n\tbody.state.vel = {speed}')
		if self.shape not in ('facets', ) and self.spin: text.add(f'for body in rigid: body.state.angVel = {v.around((0., 0., self.spin / self.end), 1 / v.T)}')
		adhesion = f', adhesion={self.adhesion * v.S}' if self.adhesion and self.friction else ''
		text.engine['contacts'] = f'[MpmContact(friction={self.friction}{adhesion}, stiffness={self.stiffness}, mask=1)]'
		text.write(gravityCurve=[(0., 1.)], mask=2)
		text.end()


@kind('energy')
class Energy(Kind):
	"""A block that flies at held ground or at a body that is fixed, or swings, by each scheme; asked besides whether energy is found again."""
	imbalance = .06  # goes with the step
	dims = (2, 2, 2, 3)
	cell, depth = .1, .2
	isDynamic = True

	def plan(self, draw):
		self.isRing = self.dim == 2 and draw.random() < .15
		self.scheme = draw.choice(['newmark', 'generalised-alpha', 'midpoint', 'explicit'])
		self.law = draw.choice(['elastic', 'elastic', 'vonMises', 'mohrCoulomb', 'viscous', 'relaxing'])
		self.perCell = draw.choice([2, 2, 3]) if self.dim == 2 else 2
		self.speed, self.angle = draw.choice([.2, 1.]), 0. if self.isRing else draw.uniform(-.7, .7)
		self.hasWeight, self.rayleigh = draw.random() < .5, draw.choice([None, None, (1., 1e-3)])
		self.isHeld, self.absorbs = draw.random() < .6, draw.random() < .2
		self.wide, self.high = draw.choice([.3, .4]), .3
		if self.scheme == 'explicit': self.rayleigh = None
		self.side, self.steps = .3, 6
		self.dt = 2e-3 if self.scheme != 'explicit' else 2e-4
		self.admitted = dict(finer=.5, shorter=.3)

	def write(self, text):
		v = text.view
		name, values = {'viscous': ('MpmVonMisesMat', dict(yieldStress=(4e3, stress), viscosity=(20., dict(S=1, T=1)), **elastic)), 'relaxing': ('MpmMohrCoulombMat', relaxing | friction)}.get(self.law) or simple[self.law]
		if self.law == 'vonMises': values = values | dict(yieldStress=(6e3, stress))
		text.material(name, values)
		text.fill(text.box((0, 0, 0), (self.wide, self.high, self.depth)), perCell=self.perCell)
		if self.absorbs:
			low, high = v.box((-inf, -inf, -inf), (inf, 0, inf))
			text.engine['absorbing'] = f'[MpmAbsorbingBoundary(min={low}, max={high})]'
		elif self.isHeld: text.boundary((-inf, -inf, -inf), (inf, 0, inf), 'xyz')
		if self.rayleigh: text.engine['rayleigh'] = (self.rayleigh[0] / v.T, self.rayleigh[1] * v.T)
		if not self.hasWeight: self.gravity = (0., 0., 0.)
		text.write(loadCurve=[(0., 1.)], gravityCurve=[(0., 1.)])
		flying = v.vector((self.speed * sin(self.angle), -self.speed * cos(self.angle), 0), v.L / v.T)
		text.add(f'mpm.assign(velocity=[np.array({flying}) * (1 + placeInScene(x)[1]) for x in mpm.arrays()["pos"]])')
		text.end()
