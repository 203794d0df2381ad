# SPDX-License-Identifier: GPL-2.0-or-later
"""Small displacements of undrained clay (von Mises, perfectly plastic, plane strain) on cells of several sizes; needs nothing of YADE.

With 2 x 2 points a cell whose domains fill it, small displacements of GIMPM are those of bilinear elements with a point in the middle of each quarter: domains end where
cells end, and the mean gradient over a quarter is that in its middle. F-bar is then the mean dilation of the cell.
"""
import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

_places = np.array([(-.5, -.5), (.5, -.5), (.5, .5), (-.5, .5)])
_signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])


def _strains(meanDilation):
	"""(4, 4, 8): strain xx, yy, zz, xy (engineering) at each point from the displacements of the corners of a cell of size 1."""
	B = np.zeros((4, 4, 8))
	for q, (x, y) in enumerate(_places):
		for a, (s, t) in enumerate(_signs):
			dx, dy = s * (1 + t * y) / 2, t * (1 + s * x) / 2
			B[q, 0, 2 * a], B[q, 1, 2 * a + 1], B[q, 3, 2 * a], B[q, 3, 2 * a + 1] = dx, dy, dy, dx
	if meanDilation:
		dilation = B[:, :3].sum(axis=1)
		B[:, :3] += ((dilation.mean(axis=0) - dilation) / 3)[:, None]
	return B


class Clay:
	"""Stresses of the points and what follows from them; moduli over c_u.

	:param tree: a connected Quadtree
	:param young: Young's modulus over c_u
	:param poisson: Poisson's ratio
	:param fBar: whether the dilation is taken as constant in a cell
	"""

	def __init__(self, tree, young, poisson, fBar):
		self.tree, self.B, self.h = tree, _strains(fBar), tree.sizes()
		self.shear, self.bulk = young / 2 / (1 + poisson), young / 3 / (1 - 2 * poisson)
		self.stress, self.strength = np.zeros((len(self.h), 4, 4)), np.sqrt(2.)
		self.dofs = (2 * tree.cells[:, :, None] + np.arange(2)).reshape(-1, 8)
		self.spread = sparse.kron(tree.free, sparse.identity(2)).tocsr()
		self.i, self.j = (np.broadcast_to(k, (len(self.h), 8, 8)).ravel() for k in (self.dofs[:, :, None], self.dofs[:, None, :]))

	def respond(self, d, tangent=True):
		"""Stresses (N, 4, 4) after free displacements *d*, their resultants at free nodes and, if asked for, the stiffness (radial return: J.C. Simo, T.J.R. Hughes 1998, box 3.2)."""
		strain = np.einsum('qsa,na->nqs', self.B, (self.spread @ d)[self.dofs]) / self.h[:, None, None]
		one, two = np.array([1, 1, 1, 0.]), np.array([1, 1, 1, 2.])
		volumetric = strain[..., :3].sum(axis=-1)
		half = np.array([1, 1, 1, .5])
		trial = self.stress + 2 * self.shear * (strain - volumetric[..., None] / 3 * one) * half + self.bulk * volumetric[..., None] * one
		mean = trial[..., :3].mean(axis=-1)
		deviator = trial - mean[..., None] * one
		norm = np.sqrt((two * deviator**2).sum(axis=-1))
		keep = np.minimum(1, self.strength / np.maximum(norm, 1e-300))
		stress = mean[..., None] * one + keep[..., None] * deviator
		self.dissipated = (self.strength * np.maximum(norm - self.strength, 0) / 2 / self.shear).mean(axis=1)
		force = self.spread.T @ np.bincount(self.dofs.ravel(), (np.einsum('qsa,nqs->na', self.B, stress) * self.h[:, None] / 4).ravel(), self.spread.shape[0])
		if not tangent: return stress, force, None
		project = np.diag(half) - np.outer(one, one) / 3
		normal = deviator / np.maximum(norm, 1e-300)[..., None]
		plastic = np.where(norm > self.strength, keep, 0)
		C = self.bulk * np.outer(one, one) + 2 * self.shear * (keep[..., None, None] * project - plastic[..., None, None] * normal[..., :, None] * normal[..., None, :])
		K = np.einsum('qsa,nqst,qtb->nab', self.B, C, self.B, optimize=True) / 4
		K = sparse.coo_matrix((K.ravel(), (self.i, self.j)), shape=(self.spread.shape[0], ) * 2).tocsr()
		return stress, force, (self.spread.T @ K @ self.spread).tocsc()

	def _change(self, K, residual, free, d, load, control):
		"""Change of displacements and factor in one iteration."""
		matrix = K[free][:, free] + sparse.identity(len(free), format='csc') * 1e-9 * self.shear
		solver = splu(matrix, permc_spec='MMD_AT_PLUS_A', options=dict(SymmetricMode=True), diag_pivot_thresh=0.01)
		change, along = np.zeros((2, len(d)))
		change[free] = solver.solve(residual[free])
		if not control: return change, 0.
		along[free] = solver.solve(load[free])
		more = (control[0] - load @ (d + change)) / (load @ along)
		return change + more * along, more

	def _share(self, d, change, loadOf, free):
		"""Part of the change, halved until the power of what is out of balance has shrunk (H. Matthies, G. Strang 1979)."""
		power = lambda share, force: abs((loadOf(share) - force)[free] @ change[free])
		before, share = power(0, self.respond(d, False)[1]), 1.
		while share > 0.05 and power(share, self.respond(d + share * change, False)[1]) > 0.8 * before: share /= 2
		return share

	def stressError(self):
		"""Square of the difference between the stresses of each cell and those smoothed by their means around nodes, over its area."""
		cells, count = self.tree.cells, len(self.tree.nodes)
		mean = self.stress.mean(axis=1)
		share = np.bincount(cells.ravel(), minlength=count)
		atNodes = np.column_stack([np.bincount(cells.ravel(), np.repeat(mean[:, k], 4), count) for k in range(4)]) / share[:, None]
		hats = (1 + _signs[None, :, 0] * _places[:, None, 0]) * (1 + _signs[None, :, 1] * _places[:, None, 1]) / 4
		smooth = np.einsum('qa,nas->nqs', hats, atNodes[cells])
		return self.h**2 * ((self.stress - smooth)**2 @ (1, 1, 1, 2.)).mean(axis=1)

	def weight(self):
		"""Forces at free nodes of a unit weight downwards."""
		force = np.zeros(self.spread.shape[0])
		np.add.at(force, self.dofs[:, 1::2].ravel(), np.repeat(-self.h**2 / 4, 4))
		return self.spread.T @ force

	def step(self, d, held, prescribed, load=None, control=None, tolerance=1e-4, most=60):
		"""One step from the guess *d*; free displacements, resultants and the factor of *load* with which *control* of them is as prescribed.

		:param held: mask of the free displacements that are prescribed in this step
		:param prescribed: their values
		:param load: forces, multiplied by a factor that is looked for, or None
		:param control: (increment of load @ d, factor to start from)
		"""
		d = d.copy()
		d[held] = prescribed
		factor = control[1] if control else 0.
		for iteration in range(most):
			stress, force, K = self.respond(d)
			residual = (factor * load if control else 0) - force
			size = np.linalg.norm(force) + (abs(factor) * np.linalg.norm(load) if control else 0)
			done = np.linalg.norm(residual[~held]) <= tolerance * size and (not control or abs(load @ d - control[0]) <= 1e-6 * control[0])
			if done and iteration: break
			change, more = self._change(K, residual, np.flatnonzero(~held), d, load, control)
			share = self._share(d, change, lambda share: (factor + share * more) * load if control else 0, ~held)
			d, factor = d + share * change, factor + share * more
		else: raise RuntimeError(f'no equilibrium after {most} iterations')
		self.stress = stress
		return d, force, factor
