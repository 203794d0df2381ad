# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene of given features as the text of a script for YADE, as it is seen by a View. Nothing here needs YADE."""
import random

from .features import dynamic, laws, placesOf, schemes, shapes, walls, waters
from .statements import Statements, arguments
from .view import inf, pressures

gravity, density, young = 10., 2000., 1e6
_laws = {
        'elastic': ('MpmElasticMat', {}), 'vonMises': ('MpmVonMisesMat', dict(yieldStress=12e3)), 'tresca': ('MpmTrescaMat', dict(undrainedStrength=8e3)),
        'mohrCoulomb': ('MpmMohrCoulombMat', dict(cohesion=6e3, frictionAngle=.5, dilationAngle=.1)), 'druckerPrager': ('MpmDruckerPragerMat', dict(cohesion=6e3, frictionAngle=.5, dilationAngle=.1)),
        'camClay': ('MpmCamClayMat', dict(shearModulus=4e5, criticalStateRatio=1.1, compressionIndex=.1, swellingIndex=.02, preconsolidation=3e4, referencePressure=5e3))
}
_fields = dict(elastic='young', vonMises='yieldStress', tresca='undrainedStrength', mohrCoulomb='cohesion', druckerPrager='cohesion', camClay='preconsolidation')


class Scene:
	"""Numbers of a scene, drawn by its seed; lengths in cells until the text is written."""
	close, isExact = 1e-9, True  # part of the largest of the quantity, where round-off differs; true if other units change no bit

	def __init__(self, chosen, seed):
		self.chosen, self.seed, self.places = list(chosen), seed, placesOf(chosen)
		draw = self.random = random.Random(seed)
		self.dim = 3 if '3d' in chosen else 2
		self.isRing, self.isPeriodic, self.isDynamic = 'axisymmetric' in chosen, 'period' in chosen, any(s in chosen for s in dynamic)
		self.law, self.scheme = next(f for f in laws if f in chosen), next(f for f in schemes if f in chosen)
		self.shape, self.wall = next((f for f in shapes if f in chosen), None), next((f for f in walls if f in chosen), None)
		self.water = next((f for f in waters if f in chosen), None)
		self.cell = draw.choice([.5, .25, .4])
		self.size = (draw.choice([3, 4]), draw.choice([2, 3]) if self.dim == 2 else 2, 2 if self.dim == 3 else 1)
		self.perCell = 1 if 'splitting' in chosen else draw.choice([2, 2, 3]) if self.dim == 2 else 2
		self.isConfined = self.law == 'camClay' and not self.isPeriodic
		if self.places.get('excavate') == 'right' or 'excavate' in chosen: self.perCell = 2
		self._support(draw)
		self._motion(draw)

	def has(self, *features):
		return any(f in self.chosen for f in features)

	def _support(self, draw):
		"""Sets the constraints of the body, and its position between the lines of the grid."""
		roughBase = 'smoothWall' not in self.chosen and self.places.get('pushed') != 'left' and draw.random() < .7
		onLeft = self.places.get('roughWall', self.places.get('smoothWall')) == 'left' or self.places.get('pushed') == 'left'
		self.isRough = roughBase or self.isPeriodic
		self.holdsLeft = not self.isPeriodic and not self.isRing and (self.isConfined or onLeft or (not self.isRough and (not self.isDynamic or draw.random() < .3)))
		self.isFreeAlongX = self.isDynamic and not (self.isRing or self.isRough or self.holdsLeft or self.isConfined or self.has('roughWall', 'absorbing', 'baseMotion'))
		wallPlace = self.places.get(self.wall)
		self.offset = [draw.choice([.13, .25, 0.]) if not (self.holdsLeft or self.isPeriodic or self.isRing) else 0., 0., 0.]
		if wallPlace == 'base': self.offset[1] = draw.choice([.13, .375])
		if wallPlace == 'base' and not (self.holdsLeft or self.isPeriodic or self.isRing): self.offset[0] = .3  # off the lines: round-off would tell which cells hold material
		if wallPlace == 'left': self.offset[0] = draw.choice([.13, .375])

	def _motion(self, draw):
		self.fixedOnTop = self.places.get('fixedBody') == 'top left'
		self.gravity = gravity if self.fixedOnTop and self.law != 'camClay' else -gravity
		self.isFree = 'freeBody' in self.chosen
		self.steps = 4
		isStiff = self.shape or self.wall or self.has('splitting')
		self.dt = (.25 if not self.isDynamic else (.3 if self.scheme != 'explicit' else .03 if isStiff else .1) * self.cell / 26) if not self.isFree else 2e-4
		self.velocity = (draw.uniform(-.3, .3), draw.uniform(-.3, .3), draw.uniform(-.3, .3) if self.dim == 3 else 0) if self.isDynamic and self.law != 'camClay' else None
		if self.isRing and self.velocity: self.velocity = (0, self.velocity[1], 0)

	@property
	def end(self):
		return self.steps * self.dt

	def metres(self, x):
		"""A place on the body, from cells; in the plane z is in metres, and infinite things stay."""
		return tuple((x[a] + self.offset[a]) * self.cell if a < self.dim else x[a] for a in range(3))


	def text(self, view):
		return textOf(self, view)

	def units(self):
		"""Sizes of quantities; smaller differences of what is next to nothing are no difference."""
		height = self.size[1] * self.cell
		stress = density * gravity * height
		area = height if self.dim == 2 and not self.isRing else height**2
		return dict(length=self.size[0] * self.cell, stress=stress, strain=stress / young, displacement=stress / young * height, force=stress * area, energy=stress * area * stress / young * height)


def textOf(scene, view):
	"""The statements that make the scene; `solver` is its engine, `actions` are statements before the step of that number."""
	return '\n'.join(_Text(scene, view).lines) + '\n'


class _Text(Statements):

	def __init__(self, scene, view):
		super().__init__(scene, view)
		self.actions, self.contacts = {}, []
		self._materials()
		self._grid()
		self.placeInScene()
		self._points()
		self._supports()
		self._loads()
		self._water()
		self._rigid()
		self._engines()
		self._start()
		self._stages()

	# Materials, grid and points

	def _materials(self):
		s, v = self.scene, self.view
		name, own = _laws[s.law]
		values = dict(density=density * v.D)
		if s.law != 'camClay': values |= dict(young=young * v.S, poisson=.3)
		if s.fixedOnTop and s.law != 'camClay': own = {key: value * (4 if key in pressures else 1) for key, value in own.items()}  # stronger, as the body hangs
		values |= {key: value * v.S if key in pressures else value for key, value in own.items()}
		self.add(f'O.materials.append({name}({arguments(values)}, label="soil"))')
		if s.has('twoEngines'): self.add(f'O.materials.append(MpmElasticMat(young={young * v.S}, poisson=.2, density={density * v.D}, label="other"))')
		if s.shape: self.add(f'O.materials.append(FrictMat(young={young * v.S}, poisson=.3, density={1.3 * density * v.D}, frictionAngle=0., label="rigid"))')

	def _grid(self):
		s, v = self.scene, self.view
		values = dict(cellSize=s.cell * v.L, dim=s.dim)
		if s.isRing: values['axisymmetric'] = True
		if s.isPeriodic:
			values['period'] = v.sizes((s.size[0] * s.cell, 0, 0))
			values['origin'] = tuple(x if p > 0 else 0. for x, p in zip(v.box((0, 0, 0), (s.size[0] * s.cell, 0, 0))[0], values['period']))
		text = f'grid = MpmGrid({arguments(values)})'
		if s.has('refinement'):
			low, high = v.box((-inf, -inf, -inf), (s.random.choice([.9, 1.4] if not s.has('pressure') else [.9]) * s.cell, inf, inf) if s.random.random() < .5 or s.has('pressure') else (inf, .7 * s.cell, inf))
			text = text[:-1] + f', refinements=[MpmRefinement(min={low}, max={high})])'
		self.add(text)

	def _part(self, low, high):
		"""A region between two corners in cells, as a predicate for mpm.fill; without the offset, which comes to the points."""
		s = self.scene
		ends = [tuple(x[a] * s.cell if a < s.dim else (-1., 1.)[x is high] for a in range(3)) for x in (low, high)]
		low, high = self.view.box(*ends)
		return f'pack.inAlignedBox({low}, {high})'

	def _filled(self, name, regions, grid='grid', material='soil', perCell=None):
		s, v = self.scene, self.view
		self.add(f'{name} = mpm.fill({" | ".join(regions)}, {grid}, {perCell or s.perCell}, {material!r})')
		if any(s.offset):
			by = v.vector([x * s.cell for x in s.offset], v.L)
			self.add(f'for body in {name}: body.state.pos = body.state.refPos = body.state.pos + Vector3({by})')
		if v.order is not None: self.add(f'np.random.RandomState({v.order % (1 << 31)}).shuffle({name})')

	def _points(self):
		s = self.scene
		nx, ny, nz = s.size
		regions = [self._part((0, 0, 0), s.size)]
		if s.random.random() < .4 and not s.isPeriodic and not s.isConfined and s.dim == 2: regions = [self._part((0, 0, 0), (nx, ny - 1, nz)), self._part((0, 0, 0), (nx - 1, ny, nz))] if not (s.places.keys() & {'traction', 'pressure', 'fixedBody', 'excavate', 'place'}) else regions
		self._filled('points', regions)
		if s.has('freeBody', 'twoEngines') or s.isFree: self.add('for body in points: body.groupMask = 2')
		# Forces by volume, so that refined cells with more points do not bear more
		force = self.view.vector((1.5e3, -2e3, 1e3 if s.dim == 3 else 0.), self.view.F / self.view.volume) if not s.isRing else self.view.vector((3e2, -5e2, 0.), self.view.F / self.view.volume)
		if s.has('pointLoad'): self.add(f'for body in points[::1]:\n\tif placeInScene(body.state.pos)[1] > {(ny - 1 + s.offset[1]) * s.cell}: body.state.force = body.state.volume * Vector3({force})')

	# Boundaries

	def _supports(self):
		s, v = self.scene, self.view
		rough = 'xyz' if s.isRough else 'y'
		base = dict()
		if s.places.get('pushed') == 'base': base['displacement'] = v.vector((0, .06 * s.cell, 0), v.L)
		isShaken = s.has('baseMotion') and not s.has('absorbing')
		if isShaken: base['motion'] = 'shaking'
		if s.has('baseMotion'):
			along = (0, 1, 0) if s.isRing or rough == 'y' or s.holdsLeft or s.isConfined else (.8, .6, 0)
			history = [(0., 0.), (s.end * v.T, .2 * v.L / v.T)]
			self.add(f'shaking = MpmBaseMotion(history={history}, direction={v.vector(along)})')
		wallPlace = s.places.get(s.wall)
		if wallPlace: self._wall(wallPlace)
		if wallPlace != 'base' and s.places.get('absorbing') != 'base': self.boundary((-inf, -inf, -inf), (inf, 0, inf), rough, **base)
		if s.has('absorbing'): self._absorbing()
		self._sides(wallPlace)

	def _sides(self, wallPlace):
		s, v = self.scene, self.view
		if s.holdsLeft and wallPlace != 'left':
			pushed = dict(displacement=v.vector((.06 * s.cell, 0, 0), v.L)) if s.places.get('pushed') == 'left' else {}
			self.boundary((-inf, -inf, -inf), (0, inf, inf), 'x', **pushed)
		if s.isConfined and not s.isPeriodic: self.boundary((s.size[0] * s.cell, -inf, -inf), (inf, inf, inf), 'x')
		if s.isPeriodic and not s.isDynamic and s.has('smoothWall'): self.boundary((-inf, s.cell, -inf), (inf, inf, inf), 'x')
		if s.dim == 3:
			self.boundary((-inf, -inf, -inf), (inf, inf, 0), 'z')
			if s.isConfined: self.boundary((-inf, -inf, s.size[2] * s.cell), (inf, inf, inf), 'z')

	def _wall(self, place):
		s, v = self.scene, self.view
		fix = 'n' if s.wall == 'smoothWall' else v.letters('xyz'[:s.dim])
		nx, ny, nz = s.size
		# Wider than the body, by parts of a cell that differ: pieces that are equally far from two cells belong
		# to none of them more than to the other
		if place == 'base':
			x = (0, nx) if s.isPeriodic else (0, nx + .5) if s.isRing else (-.5, nx + .47)
			surface = self._flat((x[0], 0, -.37), (x[1], 0, nz + .43), 1, -1)
		else: surface = self._flat((0, -.5, -.37), (0, ny + .47, nz + .43), 0, -1)
		moving = ''
		if s.has('movingWall'):
			speed = .05 * s.cell / s.end
			moving = f', velocity={v.vector((0, speed, 0) if place == "base" else (speed, 0, 0), v.L / v.T)}'
		self.boundaries.append(f'MpmBoundary(surface={v.line(surface)}, fix={fix!r}{moving})')

	def _absorbing(self):
		s = self.scene
		low, high = self.view.box((-inf, -inf, -inf), (inf, 0, inf))
		motion = ', motion=shaking' if s.has('baseMotion') else ''
		self.engine['absorbing'] = f'[MpmAbsorbingBoundary(min={low}, max={high}{motion})]'

	def _flat(self, low, high, axis, side):
		"""A piece of a plane, from corners in cells (Statements.plane)."""
		return self.plane(self.scene.metres(low), self.scene.metres(high), axis, side, 12 if self.scene.has('refinement') else 6)

	# Loads and water

	def _loads(self):
		s, v = self.scene, self.view
		nx, ny, nz = s.size
		loads = []
		for kind in 'traction', 'pressure':
			if not s.has(kind): continue
			onTop = s.places[kind] == 'top right'
			surface = self._flat((nx / 2, ny, 0), (nx, ny, nz), 1, 1) if onTop else self._flat((nx, 0, 0), (nx, ny - s.has('excavate'), nz), 0, 1)
			value = repr(4e3 * v.S) if kind == 'pressure' else repr(v.vector((2e3 if not s.isRing else 0., -3e3 if onTop else -8e2, 1e3 if s.dim == 3 and onTop else 0.), v.S))
			loads.append(f'MpmTraction(surface={v.line(surface)}, {kind}={value})')
		if loads: self.engine['loads'] = f'[{", ".join(loads)}]'

	def _water(self):
		s, v = self.scene, self.view
		if not s.water: return
		where = s.random.choice(['everywhere', 'everywhere', 'pores', 'outside']) if s.law != 'camClay' else 'everywhere'
		if s.water == 'waterLevel':
			up = 1 if s.gravity < 0 else -1
			axis, sign = v.axis(1)
			level = v.point((0, s.random.choice([.6, 1.5] if s.law != 'camClay' else [1.5]) * s.size[1] * s.cell, 0))[axis] * sign * up
			self.engine['water'] = f'[MpmWater(level={level + 0.}, weight={9810 * v.S / v.L}, where={where!r})]'
		else:
			lean = 0. if s.isPeriodic or s.isRing or s.law == 'camClay' else .2
			self.add(f'def pressure(x):\n\tx = placeInScene(x)\n\treturn {9810 * v.S} * max(0., {s.size[1] * s.cell} - {lean} * x[0] - x[1])')
			self.engine['water'] = f'[MpmWater(pressure=pressure, where={where!r})]'

	# Rigid bodies

	def _rigid(self):
		s, v = self.scene, self.view
		if not s.shape: return
		nx, ny, nz = s.size
		onTop = not s.has('fixedBody') or s.fixedOnTop
		self.speed = (0., 0., 0.)
		if s.has('movedBody'): self.speed = (0. if s.isRing or s.isPeriodic else .02 * s.cell / s.end, -.08 * s.cell / s.end, 0.)
		middle = 0. if s.isRing else nx / 2 - .2 if not s.has('place') else .4 if s.shape != 'clump' else .1
		axis, at = (1, (middle, ny, nz / 2)) if onTop else (0, (nx, ny / 2 + .1, nz / 2))
		self.bodies = []
		getattr(self, '_' + s.shape)(axis, at)
		self.add('rigid = []', *self.bodies)
		if s.shape == 'clump': self.add('clump, members = O.bodies.appendClumped(rigid)', 'rigid = [O.bodies[clump]]')
		else: self.add('O.bodies.append(rigid)')
		fixed = '' if s.isFree else f'\n\tbody.state.vel = {v.vector(self.speed, v.L / v.T)}'
		self.add(f'for body in rigid:\n\tbody.dynamic = {s.isFree}{fixed}')
		mask = ', mask=1'
		friction = s.random.choice([.2, .5]) if s.has('friction') else 0.
		adhesion = f', adhesion={2e3 * v.S}' if s.has('friction') and s.random.random() < .3 else ''
		self.engine['contacts'] = f'[MpmContact(friction={friction}{adhesion}, stiffness={s.random.choice([20., 100.])}{mask})]'
		self.add('for body in points: body.groupMask = 2')

	def _centre(self, axis, at, away):
		"""In cells, on the outer side."""
		at = list(at)
		at[axis] += away
		return self.view.point(_flattened(self.scene, at))

	def _box(self, axis, at, name='box'):
		s, v = self.scene, self.view
		extents = [1.3 * s.cell] * 3
		extents[axis] = .6 * s.cell
		if s.dim == 2: extents[2] = 1.
		self.bodies.append(f'rigid.append(utils.box({self._centre(axis, at, .6)}, {v.sizes(extents)}, material="rigid", fixed={not s.isFree}))')

	def _sphere(self, axis, at, radius=1.4, beside=0.):
		s, v = self.scene, self.view
		at = list(at)
		at[1 - axis] += beside
		self.bodies.append(f'rigid.append(utils.sphere({self._centre(axis, at, radius - .02)}, {radius * s.cell * v.L}, material="rigid", fixed={not s.isFree}))')

	def _clump(self, axis, at):
		self._sphere(axis, at, 1.2, -.45)
		self._sphere(axis, at, 1.3, .5)

	def _facet(self, axis, at):
		s, v = self.scene, self.view
		x, y, z = _flattened(s, at)
		half = 2.2 * s.cell * (.5 if s.has('place') else 1)
		if s.dim == 2: corners = [(x - half, y, -9.), (x + half, y, -9.), (x, y, 9.)] if axis == 1 else [(x, y - half, -9.), (x, y + half, -9.), (x, y, 9.)]
		else: corners = [(x - 3 * half, y, z - 2 * half), (x + 3 * half, y, z - 2 * half), (x, y, z + 3 * half)] if axis == 1 else [(x, y - 3 * half, z - 2 * half), (x, y + 3 * half, z - 2 * half), (x, y, z + 3 * half)]
		if s.isRing and axis == 1: corners = [(1e-9, y, -9.), (2 * half, y, -9.), (half, y, 9.)]
		if s.isRing and axis == 1: corners = [(-half, y, -9.), (3 * half, y, -9.), (half, y, 9.)]
		self.bodies.append(f'rigid.append(utils.facet({[v.point(c) for c in corners]}, material="rigid", fixed={not s.isFree}))')

	def _plate(self, axis, at):
		s, v = self.scene, self.view
		to, sign = v.axis(axis)
		sense = s.random.choice([-1, 0]) * sign
		self.bodies.append(f'rigid.append(utils.wall({v.point(_flattened(s, at))[to]}, {to}, sense={sense}, material="rigid"))')

	# Engines, first values, stages

	def _engines(self):
		s, v = self.scene, self.view
		values = dict(self.engine)
		acts = 'y' if s.isRing else 'xyz'
		values |= dict(grid='grid', gravity=v.vector((0, s.gravity, 0), v.L / v.T**2 if s.isDynamic else v.S / (v.D * v.L)), boundaries=f'[{", ".join(self.boundaries)}]', verbosity=0, ompThreads=v.threads)
		values['newton'] = 'MpmNewton(tolerance=1e-10)'
		if s.has('fBar'): values['fBar'] = True
		if s.has('splitting'): values['maxSplits'] = 2
		if s.shape or s.has('twoEngines'): values['mask'] = 2
		curve = v.curve([(0., 0.), (s.end, 1.)])
		if s.isDynamic:
			scheme = dict(generalisedAlpha='generalised-alpha').get(s.scheme, s.scheme)
			values |= dict(scheme=repr(scheme), loadCurve=curve, gravityCurve=[(0., 1.)])
		else: values |= dict(loadCurve=curve)
		if s.law == 'camClay': values['gravityCurve'] = [(0., 1.)]
		name = 'MpmDynamicEngine' if s.isDynamic else 'MpmImplicitEngine'
		self.add(f'solver = {name}({", ".join(f"{key}={value}" for key, value in values.items())}, label="solver")', 'O.engines = [solver]')
		if s.has('twoEngines'): self._second(name, values)
		self.add('O.bodies.append(points)')
		if s.isFree: self.add(f'O.engines = [ForceResetter(), *O.engines, NewtonIntegrator(damping=0, gravity={values["gravity"]}, mask=1)]')
		self.add(f'O.dt = {s.dt * v.T}')

	def _second(self, name, values):
		"""A block of its own, far away, on cells of another size, moved by another engine of the same kind."""
		s, v = self.scene, self.view
		away = 0. if s.isRing else 16.
		low, high = (away, 16., 0.), (away + 2, 18., 2.)
		self.add(f'otherGrid = MpmGrid(cellSize={s.cell * v.L}, dim={s.dim}{", axisymmetric=True" if s.isRing else ""})')
		offset, s.offset = s.offset, [0., 0., 0.]
		self._filled('otherPoints', [self._part(low, high)], 'otherGrid', 'other', 2)
		s.offset = offset
		self.boundaries = []
		self.boundary((-inf, -inf, -inf), (inf, 16 * s.cell, inf), 'xyz')
		own = {key: values[key] for key in ('gravity', 'verbosity', 'ompThreads', 'newton', 'scheme', 'loadCurve', 'gravityCurve') if key in values}
		arguments = ', '.join(f'{key}={value}' for key, value in own.items())
		self.add('for body in otherPoints: body.groupMask = 4', f'otherSolver = {name}({arguments}, grid=otherGrid, mask=4, boundaries=[{self.boundaries[0]}], label="otherSolver")')
		self.add('O.engines = [otherSolver, solver]', 'O.bodies.append(otherPoints)')

	def _start(self):
		s, v = self.scene, self.view
		nx, ny, nz = s.size
		if s.has('fields') or s.velocity or s.law == 'camClay': self.add('first = np.array([placeInScene(x) for x in mpm.arrays()["pos"]])', 'ids = mpm.arrays()["id"].tolist()')
		if s.has('twoEngines') and (s.has('fields') or s.law == 'camClay'): self.add('own = [i for i in range(len(ids)) if O.bodies[ids[i]].groupMask == 2]', 'first, ids = first[own], [ids[i] for i in own]')
		if s.has('fields'):
			name = _fields[s.law]
			first = _laws[s.law][1].get(name, young) * v.S
			if name == 'preconsolidation': self.add(f'mpm.assign(ids=ids, preconsolidation={first} * (1 + .2 * first[:, 1] / {ny * s.cell}))')
			else: self.add(f'mpm.assign(ids=ids, {name}={first} * (1 + .3 * first[:, 0] / {nx * s.cell} - .2 * first[:, 1] / {ny * s.cell}))')
		if s.law == 'camClay':
			top = (ny + s.offset[1]) * s.cell
			weight = density * gravity - (9810 if s.water else 0)  # in balance with the water
			self.add(f'vertical = -{weight * v.S} * ({top} - first[:, 1])')
			along = [float(x) for x in (abs(v.turn) @ [.6, 1., .6])]
			self.add(f'mpm.assign(ids=ids, stress=[np.diag({along}) * x for x in vertical])')
		if s.velocity:
			self.add(f'mpm.assign(ids=ids, velocity=[np.array({v.vector(s.velocity, v.L / v.T)}) * (1 + x[1] / {ny * s.cell}) for x in first])')

	def _stages(self):
		s, v = self.scene, self.view
		nx, ny, nz = s.size
		statements = []
		if s.has('place'):
			before, self.lines = self.lines, []
			self._filled('layer', [self._part((nx / 2 if nx % 2 == 0 else (nx + 1) / 2, ny, 0), (nx, ny + 1, nz))])
			if s.shape or s.has('twoEngines'): self.add('for body in layer: body.groupMask = 2')
			statements, self.lines = [*self.lines, 'new = mpm.stages.place(layer, steps=2, solver=solver)'], before
			if s.law == 'camClay': statements.append(f'mpm.assign(ids=list(new), stress=[-{5e3 * v.S} * np.eye(3)] * len(new))')
		if s.has('excavate'):
			isNotch = s.places['excavate'] == 'right'  # below a load on the top
			low, high = v.box(s.metres((nx - (.5 if isNotch else 1), .5 if isNotch else ny - 1, -1)), s.metres((nx + 9, ny - 1 if isNotch else ny + 9, nz + 9)))
			statements = [f'mpm.stages.excavate(pack.inAlignedBox({low}, {high}), steps=2, solver=solver)']
		self.add(f'actions = {{1: {chr(10).join(statements)!r}}}' if statements else 'actions = {}', f'steps = {s.steps}')


def _flattened(scene, at):
	"""From cells to metres, in the plane at z = 0."""
	x = list(scene.metres(at))
	if scene.dim == 2: x[2] = 0.
	return x
