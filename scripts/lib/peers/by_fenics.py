# SPDX-License-Identifier: GPL-2.0-or-later
"""FEniCS (dolfin 2019): linear scenes, by weak forms that it compiles. Plane strain, triangles; needs nothing of YADE."""
import time

import numpy as np

from . import meshes
from .scenes import Consolidation, Embankment

package = 'python3-dolfin'
kinds = {'P1': 1, 'P2': 2}  # order of the elements
lacking = {('consolidation', 'P1'): 'displacements and pressure of the same order oscillate'}
lacking |= {(scene, kind): 'has no plasticity of its own' for scene in ('footing', 'cavity') for kind in kinds}
lacking |= {('beam', kind): 'has no beam elements of its own' for kind in kinds}


def triangles(mesh):
	"""Mesh of both halves of each quadrilateral, of its corners."""
	import dolfin
	used = sorted({n for element in mesh.elements for n in element[:4]})
	new, made, editor = {n: i for i, n in enumerate(used)}, dolfin.Mesh(), dolfin.MeshEditor()
	editor.open(made, 'triangle', 2, 2)
	editor.init_vertices(len(used))
	editor.init_cells(2 * len(mesh.elements))
	for n in used: editor.add_vertex(new[n], np.array(mesh.nodes[n]))
	for e, (a, b, c, d, *_) in enumerate(mesh.elements):
		for half, corners in enumerate([(a, b, c), (a, c, d)]): editor.add_cell(2 * e + half, [new[n] for n in corners])
	editor.close(order=False)
	made.order()
	return made


def stress(u, scene, poisson):
	import dolfin
	G = scene.young / 2 / (1 + poisson)
	strain = dolfin.sym(dolfin.grad(u))
	return 2 * G * strain + 2 * G * poisson / (1 - 2 * poisson) * dolfin.tr(strain) * dolfin.Identity(2)


def constrained(space, condition, value=0.):
	import dolfin
	return dolfin.DirichletBC(space, dolfin.Constant(value), lambda x, on: on and condition(*x))


def consolidation(size, order):
	"""Pressures are linear where displacements are quadratic."""
	import dolfin
	s = Consolidation(size)
	mesh = dolfin.RectangleMesh(dolfin.Point(0, 0), dolfin.Point(order * s.h, 1), 1, size // order)
	space = dolfin.FunctionSpace(mesh, dolfin.MixedElement(dolfin.VectorElement('P', 'triangle', order), dolfin.FiniteElement('P', 'triangle', order - 1)))
	(u, p), (v, q) = dolfin.TrialFunctions(space), dolfin.TestFunctions(space)
	found, duration = dolfin.Function(space), dolfin.Constant(0)
	form = dolfin.inner(stress(u, s, 0), dolfin.grad(v)) * dolfin.dx - p * dolfin.div(v) * dolfin.dx - dolfin.div(u) * q * dolfin.dx
	form -= duration * s.mobility * dolfin.dot(dolfin.grad(p), dolfin.grad(q)) * dolfin.dx
	marked = dolfin.MeshFunction('size_t', mesh, 1, 0)
	dolfin.CompiledSubDomain('on_boundary && near(x[1], 1)').mark(marked, 1)
	load = -dolfin.div(found.split()[0]) * q * dolfin.dx - s.load * v[1] * dolfin.ds(subdomain_data=marked)(1)
	sides = constrained(space.sub(0).sub(0), lambda x, y: x < 1e-9 or x > order * s.h - 1e-9)
	held = [sides, constrained(space.sub(0).sub(1), lambda x, y: y < 1e-9), constrained(space.sub(1), lambda x, y: y > 1 - 1e-9)]
	for length in np.diff(s.times, prepend=0):
		duration.assign(length)
		dolfin.solve(form == load, found, held)
	return -found(order * s.h / 2, 1.)[1] * s.young / s.load, space.dim()


def embankment(size, order):
	"""A run for each lift, whose weight ground and lifts up to it bear; its displacements add."""
	import dolfin
	s, settlement = Embankment(size), 0
	for lift in range(s.lifts):
		space = dolfin.VectorFunctionSpace(triangles(meshes.embankment(size, order, lift + 1)), 'P', order)
		u, v = dolfin.TrialFunction(space), dolfin.TestFunction(space)
		weight = dolfin.Expression('x[1] > bottom ? weight : 0', degree=0, bottom=lift * s.lift, weight=s.weight)
		sides = constrained(space.sub(0), lambda x, y: x < 1e-9 or x > s.width - 1e-9)
		found = dolfin.Function(space)
		dolfin.solve(dolfin.inner(stress(u, s, s.poisson), dolfin.grad(v)) * dolfin.dx == -weight * v[1] * dolfin.dx, found, [sides, constrained(space, lambda x, y: y < 1e-9 - s.depth, (0., 0.))])
		along = np.linspace(0, s.crest, 10 * size + 1)
		settlement -= meshes.meanOfLine(along, [found(x, 0.)[1] for x in along], s.crest)
	return 1e3 * settlement, space.dim()


def run(scene, size, kind, folder):
	"""Value, unknowns and seconds from the mesh to the result, the second time: the first compiles the forms."""
	import dolfin
	dolfin.set_log_level(40)
	for _ in range(2):
		begin = time.time()
		value, unknowns = globals()[scene](size, kinds[kind])
	return dict(value=float(value), unknowns=unknowns, seconds=time.time() - begin)
