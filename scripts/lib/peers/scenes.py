# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that all programs compute: dimensions, materials, sizes of elements, and the exact or converged value of one quantity. SI units; needs nothing of YADE."""
import numpy as np


class Footing:
	"""Rigid rough strip on clay, small strains: N_c, largest mean pressure over c_u (Prandtl 1921). The strip ends in the middle between two nodes."""
	quantity, unit, source = 'N_c of a strip on clay', '', 'Prandtl 1921, 2 + pi'
	sizes = [4, 8, 16]  # elements over half the width, without the half element at its edge
	width, strength, steps = 2., 25e3, 16  # of the strip [m], c_u [Pa]
	young, poisson, settlement = 5000 * strength, 0.3, 0.008 * width
	exact = 2 + np.pi

	def __init__(self, size):
		self.h = self.width / (2 * size + 1)
		self.columns, self.rows = (2 * int(np.ceil(part * (2 * size + 1) / 2)) for part in (1.5, 1))  # even: quadratic elements are twice as large


class Cavity:
	"""Cylindrical cavity in clay of von Mises with an outer radius b = 4 a, small strains: displacement of its wall over a at a pressure of 2 c_u; see `radial`."""
	quantity, unit, source = 'widening of a cavity in clay', '1e-3 a', 'elements along the radius, converged'
	sizes = [4, 8, 16]  # elements over the inner radius
	inner, outer, strength, steps = 1., 4., 25e3, 10
	young, poisson, pressure = 5000 * strength, 0.3, 2 * strength

	def __init__(self, size):
		self.h = self.inner / size
		self.columns, self.rows = int((self.outer - self.inner) * size), 2 * int(np.ceil(np.pi / 4 * 2 * size))  # along the radius; around a quarter, h apart at r = 2 a


class Consolidation:
	"""Column of height 1 under a load put on at once, drained at its top: degree of consolidation, by its settlement, after 40 implicit steps that grow (Terzaghi 1923)."""
	quantity, unit, source = 'degree of consolidation at T = 0.1', '', 'Terzaghi 1923, in the same time steps'
	sizes = [10, 20, 40]  # elements over the height
	young, mobility, load = 1e6, 1e-7 / 9810, 1e2  # [Pa], conductivity over unit weight of water [m4/(N s)], [Pa]; Poisson's ratio 0
	end, steps = 0.1, 40
	odd = np.pi * (2 * np.arange(200) + 1) / 2
	parts = np.arange(steps + 1)**2 / steps**2  # of the end, at the ends of the steps
	exact = 1 - (2 / odd**2 / np.prod(1 + odd**2 * end * np.diff(parts)[:, None], axis=0)).sum()

	def __init__(self, size):
		self.h = 1 / size
		self.times = self.end / (self.young * self.mobility) * self.parts[1:]


class Beam:
	"""Beam that a force bends, glued to an elastic layer on a rough rigid base, half of it by symmetry: settlement under the force less that at the far end; see `beam`."""
	quantity, unit, source = 'settlement of a beam on a layer', 'mm', 'Fourier series of the layer'
	sizes = [2, 4, 8]  # elements in 1 m
	length, depth, young, poisson = 6., 4., 1e7, 0.3  # half length and depth of the layer [m]
	bending, axial, force = 1e7, 2e9, 2e4  # E I [N m2] and E A [N] per metre, force [N/m]

	def __init__(self, size):
		self.h = 1 / size


class Embankment:
	"""Embankment placed in four lifts on an elastic layer, each without stress at first: mean settlement of the ground below its crest by all lifts."""
	quantity, unit, source = 'settlement below an embankment', 'mm', 'finite elements, converged'
	sizes = [2, 4, 8]  # elements in 1 m
	width, depth, lift, lifts, crest, slope = 12., 4., 0.5, 4, 2., 2.  # half widths of ground and crest, height of a lift [m]; horizontal over vertical
	young, poisson, weight = 1e8, 0.3, 2e4  # of ground and fill; unit weight of the fill [N/m3]
	exact = 1.1403

	def __init__(self, size):
		self.h = 1 / size

	def toe(self, lift):
		"""Half width of the fill at the base of a lift, the first being 0."""
		return self.crest + self.slope * self.lift * (self.lifts - lift)


def surface(k, depth, young, poisson):
	"""Tractions at the surface of a layer on a rough rigid base by displacements there, (sin k x, cos k x): a matrix 2 x 2 for each wave number k > 0."""
	G, D = young / 2 / (1 + poisson), depth
	lame = 2 * G * poisson / (1 - 2 * poisson)
	k, a = np.asarray(k, float), 3 - 4 * poisson

	def waves(y):
		"""Displacements and tractions at y of four waves: two that fall downwards from the surface, two upwards from the base."""
		U, V, X, Y = (np.empty((len(k), 4)) for _ in range(4))
		for s, e, j in (1, np.exp(k * y), 0), (-1, np.exp(-k * (y + D)), 2):
			u, v, du, dv = -1 * e, s * e, -s * k * e, k * e
			U[:, j], V[:, j], X[:, j], Y[:, j] = u, v, G * (du - k * v), lame * (k * u + dv) + 2 * G * dv
			u, v, du = k * y * e, (a - s * k * y) * e, (k + s * k * k * y) * e
			dv = (-s * k + s * k * a - k * k * y) * e
			U[:, j + 1], V[:, j + 1], X[:, j + 1], Y[:, j + 1] = u, v, G * (du - k * v), lame * (k * u + dv) + 2 * G * dv
		return U, V, X, Y

	U, V, X, Y = waves(0)
	below = waves(-D)
	parts = np.linalg.solve(np.stack([U, V, below[0], below[1]], 1), np.tile(np.eye(4)[:, :2], (len(k), 1, 1)))
	return np.stack([X, Y], 1) @ parts


def beam(terms=4000):
	"""Settlement [m] of the beam under its force less that at its end: the layer and the beam answer each cosine by themselves."""
	s = Beam
	k = np.pi * np.arange(1, terms + 1) / s.length
	matrix = surface(k, s.depth, s.young, s.poisson)
	matrix[:, 0, 0] += s.axial * k**2
	matrix[:, 1, 1] += s.bending * k**4
	inverse = np.linalg.inv(matrix)[:, 1, 1]
	return (s.force / s.length * inverse * (1 - np.cos(k * s.length))).sum()


def radial(elements):
	"""Displacement of the wall of the cavity over a: linear elements along the radius with one point each, plane strain, perfectly plastic by von Mises, loaded in equal steps."""
	s = Cavity
	G, K = s.young / 2 / (1 + s.poisson), s.young / 3 / (1 - 2 * s.poisson)
	r = np.linspace(s.inner, s.outer, elements + 1)
	length, middle = np.diff(r), (r[1:] + r[:-1]) / 2
	B = np.zeros((elements, 2, 2))  # strains (r, theta) by displacements of both nodes
	B[:, 0], B[:, 1] = np.stack([-1 / length, 1 / length], 1), 1 / (2 * middle)[:, None]
	weight, limit = length * middle, np.sqrt(2) * s.strength
	u, plastic = np.zeros(elements + 1), np.zeros((elements, 3))
	for step in range(1, s.steps + 1):
		for _ in range(30):
			strain = np.zeros((elements, 3))
			strain[:, :2] = np.einsum('eij,ej->ei', B, np.stack([u[:-1], u[1:]], 1))
			volume = strain.sum(1)
			deviator = 2 * G * (strain - volume[:, None] / 3 - plastic)
			size = np.linalg.norm(deviator, axis=1)
			n, ratio = deviator / size.clip(1e-300)[:, None], np.minimum(1, limit / size.clip(1e-300))
			stress = K * volume[:, None] + ratio[:, None] * deviator
			isotropic = np.eye(3) - 1 / 3
			tangent = K + 2 * G * ratio[:, None, None] * (isotropic - (ratio < 1)[:, None, None] * n[:, :, None] * n[:, None, :])
			force = np.zeros(elements + 1)
			local = np.einsum('eij,ei,e->ej', B, stress[:, :2], weight)
			force[:-1] += local[:, 0]
			force[1:] += local[:, 1]
			force[0] -= s.pressure * step / s.steps * s.inner
			if np.abs(force).max() < 1e-10 * s.pressure: break
			blocks = np.einsum('eij,eik,ekl,e->ejl', B, tangent[:, :2, :2], B, weight)
			u -= solveThreeDiagonals(blocks, force)
		plastic = strain - volume[:, None] / 3 - ratio[:, None] * deviator / 2 / G
	return u[0] / s.inner


def solveThreeDiagonals(blocks, force):
	"""Solution of a chain of 2 x 2 blocks, symmetric, by elimination."""
	main, side, x = np.append(blocks[:, 0, 0], 0) + np.append(0, blocks[:, 1, 1]), blocks[:, 0, 1], force.copy()
	for i in range(1, len(main)):
		factor = side[i - 1] / main[i - 1]
		main[i] -= factor * side[i - 1]
		x[i] -= factor * x[i - 1]
	x[-1] /= main[-1]
	for i in range(len(main) - 2, -1, -1): x[i] = (x[i] - side[i] * x[i + 1]) / main[i]
	return x


scenes = dict(footing=Footing, cavity=Cavity, consolidation=Consolidation, beam=Beam, embankment=Embankment)
Beam.exact, Cavity.exact = 1e3 * beam(), 1e3 * radial(3200)
