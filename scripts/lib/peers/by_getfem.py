# SPDX-License-Identifier: GPL-2.0-or-later
"""GetFEM: builds the scenes by its Python interface and solves them. Plane strain; needs nothing of YADE."""
import time

import numpy as np

from . import meshes
from .scenes import Beam, Cavity, Consolidation, Embankment, Footing

package = 'python3-getfem'
kinds = {'Q1': 1, 'Q2': 2}  # order of the elements
lacking = {('consolidation', 'Q1'): 'displacements and pressure of the same order oscillate'}
order8 = [0, 4, 1, 7, 5, 3, 6, 2]  # nodes of a quadratic element, row by row


class Solid:
	"""Mesh, displacement and boundaries of a scene."""

	def __init__(self, mesh, order):
		import getfem
		self.getfem, self.order = getfem, order
		getfem.util('trace level', 0)
		self.mesh = getfem.Mesh('empty', 2)
		transformation = getfem.GeoTrans('GT_QK(2,1)' if order == 1 else 'GT_Q2_INCOMPLETE(2)')
		corners = [0, 1, 3, 2] if order == 1 else order8
		nodes = np.array(mesh.nodes)
		self.convex = [self.mesh.add_convex(transformation, nodes[[element[c] for c in corners]].T)[0] for element in mesh.elements]
		self.nodes, self.of, self.regions = nodes, mesh, 0
		self.field = self.of_order(order, 2)
		self.integration = getfem.MeshIm(self.mesh, getfem.Integ('IM_GAUSS_PARALLELEPIPED(2, 3)'))  # 2 x 2 points
		self.model = getfem.Model('real')
		self.model.add_fem_variable('u', self.field)

	def of_order(self, order, components):
		field = self.getfem.MeshFem(self.mesh, components)
		field.set_fem(self.getfem.Fem('FEM_Q2_INCOMPLETE(2)' if order == 2 else f'FEM_QK(2, {order})'))
		return field

	def boundary(self, condition):
		"""Number of a region of faces whose corners are where condition(x, y) holds."""
		self.regions += 1
		points, faces = self.mesh.pts(), self.mesh.outer_faces()
		inside = {n for n in range(points.shape[1]) if condition(*points[:, n])}
		chosen = []
		for convex, face in faces.T:
			ids = self.mesh.pid_in_faces(np.array([[convex], [face]]))
			if all(n in inside for n in np.ravel(ids)): chosen.append((convex, face))
		self.mesh.set_region(self.regions, np.array(chosen).T)
		return self.regions

	def block(self, name):
		self.regions += 1
		self.mesh.set_region(self.regions, np.array([[self.convex[e] for e in self.of.blocks[name]]]))
		return self.regions

	def fix(self, condition, young, *components, value=0.):
		"""Constrain components of the displacement by a penalty, which the size of the elements makes stiff."""
		region, name = self.boundary(condition), f'fixed{self.regions}'
		self.model.add_initialized_data(name, [value])
		for component in components: self.model.add_linear_term(self.integration, f'{1e6 * young:.9g} * (u({component}) - {name}) * Test_u({component})', region)
		return region, name

	def elastic(self, scene, region=-1):
		G = scene.young / 2 / (1 + scene.poisson)
		self.model.add_initialized_data('lame', [2 * G * scene.poisson / (1 - 2 * scene.poisson)])
		self.model.add_initialized_data('shear', [G])
		self.model.add_linear_term(self.integration, '(lame * Trace(Grad_u) * Id(2) + shear * (Grad_u + Grad_u\')) : Grad_Test_u', region)

	def plastic(self, scene):
		"""Perfectly plastic clay of von Mises; returns a function that accepts a step."""
		G = scene.young / 2 / (1 + scene.poisson)
		data = self.getfem.MeshImData(self.integration, -1)
		tensor = self.getfem.MeshImData(self.integration, -1, [2, 2])
		self.model.add_fem_data('Previous_u', self.field)
		self.model.add_im_data('xi', data)
		self.model.add_im_data('Previous_xi', data)
		self.model.add_im_data('Epn', tensor)
		for name, value in (('lame', 2 * G * scene.poisson / (1 - 2 * scene.poisson)), ('shear', G), ('strength', np.sqrt(3) * scene.strength)): self.model.add_initialized_data(name, [value])
		law = 'plane strain Prandtl Reuss', 'displacement only', 'u', 'xi', 'Epn', 'lame', 'shear', 'strength'
		self.model.add_small_strain_elastoplasticity_brick(self.integration, *law)
		return lambda: self.model.small_strain_elastoplasticity_next_iter(self.integration, *law)

	def solve(self):
		"""The program says by a number only whether Newton's method has converged."""
		if self.model.solve('lsolver', 'mumps', 'max_iter', 60, 'max_res', 1e-8)[1] == 0: raise RuntimeError('has not converged')

	def load(self, name, begin, end, accept, halves=8):
		"""Change a number of the model, in two parts where Newton's method does not converge."""
		before = self.model.variable('u').copy()
		self.model.set_variable(name, [end])
		try:
			self.solve()
			return accept()
		except RuntimeError:
			if not halves: raise
		self.model.set_variable('u', before)
		self.load(name, begin, (begin + end) / 2, accept, halves - 1)
		self.load(name, (begin + end) / 2, end, accept, halves - 1)

	def displacement(self, condition):
		"""Positions and displacements of the nodes where condition(x, y) holds."""
		at = self.field.basic_dof_nodes()[:, ::2]
		u = self.model.variable('u').reshape(-1, 2)
		chosen = [n for n in range(at.shape[1]) if condition(*at[:, n])]
		return at[:, chosen].T, u[chosen]

	@property
	def unknowns(self):
		return self.field.nbdof()


def footing(size, order):
	s, solid = Footing(size), Solid(meshes.footing(size, order), order)
	accept = solid.plastic(s)
	wide, deep = s.columns * s.h, s.rows * s.h
	solid.fix(lambda x, y: x < 1e-9 or x > wide - 1e-9, s.young, 1)
	solid.fix(lambda x, y: y < 1e-9 - deep, s.young, 1, 2)
	under = lambda x, y: y > -1e-9 and x < s.width / 2 + 1e-6
	solid.fix(under, s.young, 1)
	region, sunk = solid.fix(under, s.young, 2)
	loads = []
	for step in range(s.steps):
		solid.load(sunk, -s.settlement * step / s.steps, -s.settlement * (step + 1) / s.steps, accept)
		loads.append(solid.getfem.asm_generic(solid.integration, 0, f'{1e6 * s.young:.9g} * (u(2) - {sunk})', region, solid.model))
	return max(loads) / (s.width / 2) / s.strength, solid


def cavity(size, order):
	s, solid = Cavity(size), Solid(meshes.cavity(size, order), order)
	accept = solid.plastic(s)
	solid.fix(lambda x, y: x < 1e-9, s.young, 1)
	solid.fix(lambda x, y: y < 1e-9, s.young, 2)
	wall = lambda x, y: x * x + y * y < s.inner**2 + 1e-9
	solid.model.add_initialized_data('pressure', [0.])
	solid.model.add_linear_term(solid.integration, 'pressure * Normal . Test_u', solid.boundary(wall))
	for step in range(s.steps): solid.load('pressure', s.pressure * step / s.steps, s.pressure * (step + 1) / s.steps, accept)
	return 1e3 * np.linalg.norm(solid.displacement(wall)[1], axis=1).mean() / s.inner, solid


def consolidation(size, order):
	"""Pressures are linear where displacements are quadratic."""
	s, mesh = Consolidation(size), meshes.Mesh(order)
	mesh.block('soil', order, size, lambda i, j: (i * s.h, j * s.h))
	solid = Solid(mesh, order)
	model = solid.model
	model.add_fem_variable('p', solid.of_order(order - 1, 1))
	model.add_fem_data('before', solid.field)
	model.add_initialized_data('duration', [0.])
	model.add_linear_term(solid.integration, f"{s.young:.9g} * Sym(Grad_u) : Grad_Test_u - p * Div_Test_u")
	model.add_linear_term(solid.integration, f"(Div_u - Div_before) * Test_p + duration * {s.mobility:.9g} * Grad_p . Grad_Test_p")
	solid.fix(lambda x, y: x < 1e-9 or x > order * s.h - 1e-9, s.young, 1)
	solid.fix(lambda x, y: y < 1e-9, s.young, 2)
	top = solid.boundary(lambda x, y: y > 1 - 1e-9)
	model.add_linear_term(solid.integration, f'{s.load:.9g} * Test_u(2) + 1e6 * {1 / s.young:.9g} * p * Test_p', top)
	for duration in np.diff(s.times, prepend=0):
		model.set_variable('duration', [duration])
		solid.solve()
		model.set_variable('before', model.variable('u'))
	return -solid.displacement(lambda x, y: y > 1 - 1e-9)[1][:, 1].mean() * s.young / s.load, solid


def beam(size, order):
	"""Deflections by cubic and extensions by linear elements on a mesh of the beam, tied to the surface by multipliers."""
	s, solid = Beam(size), Solid(meshes.beam(size, order), order)
	getfem, model = solid.getfem, solid.model
	solid.elastic(s)
	solid.fix(lambda x, y: y < 1e-9 - s.depth, s.young, 1, 2)
	solid.fix(lambda x, y: x < 1e-9 or x > s.length - 1e-9, s.young, 1)
	line = getfem.Mesh('cartesian', np.linspace(0, s.length, round(s.length * size / order) + 1))
	integration = getfem.MeshIm(line, getfem.Integ('IM_GAUSS1D(7)'))
	for name, element in (('w', 'FEM_HERMITE(1)'), ('v', 'FEM_PK(1, 1)'), ('normal', f'FEM_PK(1, {order})'), ('tangential', f'FEM_PK(1, {order})')):
		field = getfem.MeshFem(line, 1)
		field.set_fem(getfem.Fem(element))
		model.add_fem_variable(name, field)
	model.add_interpolate_transformation_from_expression('ground', line, solid.mesh, '[X(1); 0]')
	model.add_linear_term(integration, f'{s.bending:.9g} * Hess_w : Hess_Test_w + {s.axial:.9g} * Grad_v . Grad_Test_v')
	model.add_linear_term(integration, 'normal * (Test_w - Interpolate(Test_u, ground)(2)) + (w - Interpolate(u, ground)(2)) * Test_normal')
	model.add_linear_term(integration, 'tangential * (Test_v - Interpolate(Test_u, ground)(1)) + (v - Interpolate(u, ground)(1)) * Test_tangential')
	ends = line.outer_faces()
	line.set_region(1, ends)
	line.set_region(2, np.array([[ends[0, 0]], [ends[1, 0]]]) if line.pts_from_cvid(ends[:1, 0])[0].min() < 1e-9 else ends[:, 1:])
	model.add_linear_term(integration, f'{1e6 * s.bending:.9g} * Grad_w . Grad_Test_w + {1e6 * s.axial:.9g} * v * Test_v', 1)
	model.add_linear_term(integration, f'{s.force / 2:.9g} * Test_w', 2)
	solid.solve()
	w = lambda x: getfem.compute_interpolate_on(model.mesh_fem_of_variable('w'), model.variable('w'), np.array([[x]]))
	return 1e3 * float(np.ravel(w(s.length - 1e-9) - w(1e-9))[0]), solid


def embankment(size, order):
	"""A linear run for each lift, whose weight ground and lifts up to it bear; its displacements add."""
	s, settlement = Embankment(size), 0
	below = lambda x, y: abs(y) < 1e-9 and x < s.crest + 1e-9
	for lift in range(s.lifts):
		solid = Solid(meshes.embankment(size, order, lift + 1), order)
		solid.elastic(s)
		solid.fix(lambda x, y: x < 1e-9 or x > s.width - 1e-9, s.young, 1)
		solid.fix(lambda x, y: y < 1e-9 - s.depth, s.young, 1, 2)
		solid.model.add_linear_term(solid.integration, f'{s.weight:.9g} * Test_u(2)', solid.block(f'lift{lift}'))
		solid.solve()
		at, u = solid.displacement(below)
		settlement -= meshes.meanOfLine(at[:, 0], u[:, 1], s.crest)
	return 1e3 * settlement, solid


def run(scene, size, kind, folder):
	"""Value, unknowns and seconds from the mesh to the result; 'why' if it fails."""
	begin = time.time()
	value, solid = globals()[scene](size, kinds[kind])
	return dict(value=float(value), unknowns=solid.unknowns, seconds=time.time() - begin)
