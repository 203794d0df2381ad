# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies of the cases, and how deep a place is inside of them."""
import numpy as np
from yade import utils
from yade.wrapper import FrictMat, Omega

O = Omega()


def steel():
	O.materials.append(FrictMat(frictionAngle=0, density=2600, label='rigid'))


class Outline:
	"""A closed line of Facets in the plane z = 0, or around the axis x = 0 from the axis back to it, with the soil on the right seen along it (outward normals).

	:param corners: of the line; it is closed by the axis, or by its first corner given again
	"""

	def __init__(self, corners):
		self.corners = np.array(corners, float)
		self.ids = [O.bodies.append(self._facet(a, b)) for a, b in zip(self.corners[:-1], self.corners[1:])]
		self.start = np.array(O.bodies[self.ids[0]].state.pos)[:2]

	def _facet(self, a, b):
		"""Facet with the line as the edge that lies in the plane."""
		deep = 2 * np.linalg.norm(b - a)
		third = (*((a + b) / 2), deep)
		return utils.facet([(*a, 0.), (*b, 0.), third], material='rigid', fixed=True)

	def move(self, velocity):
		for i in self.ids:
			O.bodies[i].state.vel = velocity

	def force(self, contact, members=None):
		"""Sum over all of the facets, or over some of them by number."""
		wanted = {self.ids[k] for k in (range(len(self.ids)) if members is None else members)}
		return sum((np.array(F) for i, F in zip(contact.bodies, contact.forces) if i in wanted), np.zeros(3))

	@property
	def way(self):
		return np.array(O.bodies[self.ids[0]].state.pos)[:2] - self.start

	def depths(self, places):
		"""Depth of positions (N, 3) inside, from the faces; 0 outside."""
		line = self.corners + self.way
		x = places[:, :2]
		inside, least = np.zeros(len(x), bool), np.full(len(x), np.inf)
		for a, b in zip(line, np.roll(line, -1, axis=0)):
			with np.errstate(divide='ignore', invalid='ignore'):
				crosses = ((a[1] > x[:, 1]) != (b[1] > x[:, 1])) & (x[:, 0] < (b[0] - a[0]) * (x[:, 1] - a[1]) / (b[1] - a[1]) + a[0])
			inside ^= crosses
		for a, b in zip(line[:-1], line[1:]):
			t = np.clip((x - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
			least = np.minimum(least, np.linalg.norm(x - a - t[:, None] * (b - a), axis=1))
		return np.where(inside, least, 0.)


class QuarterCone:
	"""A cone of 60 degrees and its shaft around the y axis as triangles, where x and z are positive, with the tip in the origin and as much cross section as a round one."""

	def __init__(self, radius, length, sectors=6):
		turns = np.linspace(0, np.pi / 2, sectors + 1)
		self.radius, self.tip = radius, radius * np.sqrt(3)
		rim = radius * np.sqrt(turns[1] / np.sin(turns[1])) * np.array([np.cos(turns), 0 * turns, np.sin(turns)]).T
		low, high = rim + (0, self.tip, 0), rim + (0, self.tip + length, 0)
		corners = [((0, 0, 0), low[k], low[k + 1]) for k in range(sectors)]
		corners += [triangle for k in range(sectors) for triangle in ((low[k], high[k], high[k + 1]), (low[k], high[k + 1], low[k + 1]))]
		self.ids = [O.bodies.append(utils.facet([tuple(map(float, c)) for c in three], material='rigid', fixed=True)) for three in corners]
		self.start = np.array(O.bodies[self.ids[0]].state.pos)[:2]

	move, way = Outline.move, Outline.way

	def force(self, contact):
		return Outline.force(self, contact)

	def depths(self, places):
		"""Depth as that of an Outline, from the round faces."""
		x = places - (0, self.way[1], 0)
		across = np.hypot(x[:, 0], x[:, 2])
		fromCone = (x[:, 1] * self.radius / self.tip - across) * np.cos(np.pi / 6)
		return np.maximum(0, np.minimum(fromCone, self.radius - across))


class One:
	"""A Box, Sphere, Wall or Facet by itself."""

	def __init__(self, body, velocity=(0, 0, 0), spin=(0, 0, 0)):
		self.id = O.bodies.append(body)
		self.ids = [self.id]
		self.state, self.shape = O.bodies[self.id].state, O.bodies[self.id].shape
		self.state.vel, self.state.angVel = velocity, spin
		self.start = np.array(self.state.pos)[:2]

	def move(self, velocity):
		self.state.vel = velocity

	def force(self, contact, members=None):
		return sum((np.array(F) for i, F in zip(contact.bodies, contact.forces) if i == self.id), np.zeros(3))

	def torque(self, contact):
		return sum((np.array(T) for i, T in zip(contact.bodies, contact.torques) if i == self.id), np.zeros(3))

	@property
	def way(self):
		return np.array(self.state.pos)[:2] - self.start

	def depths(self, places):
		"""Depth as that of an Outline. In the plane a Box is without ends along z."""
		x = places - np.array(self.state.pos)
		if type(self.shape).__name__ == 'Sphere': return np.maximum(0, self.shape.radius - np.linalg.norm(x, axis=1))
		own = x @ np.array(self.state.ori.toRotationMatrix())
		return np.maximum(0, (np.array(self.shape.extents) - np.abs(own)).min(axis=1))
