# SPDX-License-Identifier: GPL-2.0-or-later
"""Square cells of several sizes in the plane, halved once or more, neighbours differing by one halving at most; needs nothing of YADE."""
import numpy as np
from scipy import sparse

corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])


class Quadtree:
	"""Cells of a box, some of them halved.

	:param shape: (2,) whole numbers of coarse cells along x and y
	:param size: of a coarse cell [m]
	:param origin: (2,) lower left corner [m]
	"""

	def __init__(self, shape, size, origin):
		self.coarse, self.origin, self.levels, self.shape = size, np.array(origin, float), 0, tuple(shape)
		self.low, self.width = np.argwhere(np.ones(shape, bool)), np.ones(np.prod(shape), int)  # lowest corner and width of each cell, in those of the smallest size

	@property
	def smallest(self):
		return self.coarse / 2**self.levels

	def centres(self):
		return self.origin + self.smallest * (self.low + self.width[:, None] / 2)

	def sizes(self):
		return self.smallest * self.width

	def halve(self, which):
		"""Cut the cells of a mask (N,) into four; those of the smallest size begin a new one, and neighbours follow so that sizes differ by two at most."""
		if (self.width[which] == 1).any(): self.low, self.width, self.levels = 2 * self.low, 2 * self.width, self.levels + 1
		while which.any():
			half = self.width[which] // 2
			children = (self.low[which][:, None] + half[:, None, None] * corners).reshape(-1, 2)
			self.low, self.width = np.concatenate([self.low[~which], children]), np.concatenate([self.width[~which], np.repeat(half, 4)])
			which = self._tooLarge()

	def _tooLarge(self):
		"""Cells with a neighbour of a quarter of their size or less."""
		owner = np.full([n * 2**self.levels for n in self.shape], -1)
		for number, ((x, y), w) in enumerate(zip(self.low, self.width)): owner[x:x + w, y:y + w] = number
		found = np.zeros(len(self.width), bool)
		for a, b in ((owner[1:], owner[:-1]), (owner[:, 1:], owner[:, :-1])):
			found[a[self.width[a] > 2 * self.width[b]]] = True
			found[b[self.width[b] > 2 * self.width[a]]] = True
		return found

	def connect(self):
		"""``nodes`` (M, 2) [m], ``cells`` (N, 4) their numbers from the lower left corner around, and ``free`` (M, F): a node on the side of a larger cell moves as that side does,
		all others are free."""
		across = int(np.array(self.shape).max() * 2**self.levels + 1)
		places = self.low[:, None] + self.width[:, None, None] * corners
		codes, cells = np.unique(places[..., 0] * across + places[..., 1], return_inverse=True)
		cells = cells.reshape(-1, 4)
		self.nodes = self.origin + self.smallest * np.column_stack([codes // across, codes % across])
		sides = np.concatenate([cells[:, [k, (k + 1) % 4]] for k in range(4)])
		between = codes[sides].sum(axis=1)
		middle = np.searchsorted(codes, between // 2).clip(max=len(codes) - 1)
		isNode = (np.tile(self.width, 4) > 1) & (codes[middle] == between // 2)
		hangs = np.zeros(len(codes), bool)
		hangs[middle[isNode]] = True
		rows, columns = np.concatenate([middle[isNode], middle[isNode]]), np.concatenate([sides[isNode, 0], sides[isNode, 1]])
		spread = sparse.coo_matrix((np.full(len(rows), 0.5), (rows, columns)), shape=(len(codes), ) * 2).tocsr() + sparse.diags((~hangs).astype(float))
		for _ in range(self.levels): spread = spread @ spread  # ends of a side may hang themselves
		self.cells, self.free = cells, spread[:, ~hangs].tocsr()
		return self
