# SPDX-License-Identifier: GPL-2.0-or-later
"""Error of a result that is due to the size of the cells."""
import math

import numpy as np

from ..base.messages import brief, isNumber
from ..base.solver import noPoints, solverOf
from ..library import engine
from ..points.data import pointsOf
from .recovery import smoothed
from .refinement import errorOf
from .repeated import enginesOf, resultOf


def stressError(solver=None):
	"""Estimate the error of the stresses that the size of the cells makes, from one run, and print it; nothing is run, and the scene is left alone.

	Stresses of points scatter about smooth ones, found by least squares around each node (O.C. Zienkiewicz, J.Z. Zhu 1992, https://doi.org/10.1002/nme.1620330702), within each material.
	The estimate is the root mean square of the difference over the volume, over that of the stress. Against stresses in closed form it has been within a factor of two in all cases
	(``examples/discretisation``), elastic and plastic. It costs a pass over the points.

	What is smooth and wrong is not seen: of a displacement, a limit load or a factor of safety :func:`discretisationError` tells more. Nor are load steps, the size of the model
	and the law. In water it is about the effective stress, which a level that cuts cells makes scatter, too.

	:param solver: the ``MpmImplicitEngine``; may be left out when ``O.engines`` holds one
	:return: dict of ``error`` [-], ``points`` (N,) [Pa], the difference at each point (Frobenius' norm) in order of body id, which ``mpm.plot(found['points'])`` draws, ``place`` (3,) [m]
		of the point with the largest, and ``cellSize`` [m] of the largest cells
	:raises TypeError: *solver* is no MpmImplicitEngine.
	:raises ValueError: none or several of them among O.engines, no material points, no stress in them, or points spread over more cells than can be numbered (1e18).
	"""
	solver = solverOf('stressError', solver)
	data, _, material = pointsOf(solver)
	if not len(data['id']): raise ValueError(noPoints('stressError', solver))
	grid, volume = solver.grid, data['volume']
	tensors = data['stress'].reshape(-1, 9)
	norm = math.sqrt(volume @ (tensors**2).sum(axis=1))
	if norm == 0: raise ValueError('stressError: no point has any stress; run the analysis first')
	places, scatter = (data['pos'] - np.array(grid.origin))[:, :grid.dim], np.zeros(len(volume))
	sizes = np.frombuffer(engine.cellSizes(grid, np.ascontiguousarray(data['pos'])))
	for size in np.unique(sizes): # smooth over nodes of the cells in which a point is
		try: smooth = smoothed(places / size, material, volume, tensors)
		except ValueError as error: raise ValueError(f'stressError: {error}') from None
		scatter[sizes == size] = np.linalg.norm(tensors - smooth, axis=1)[sizes == size]
	worst = data['pos'][scatter.argmax()]
	found = dict(error=math.sqrt(volume @ scatter**2) / norm, points=scatter, place=worst, cellSize=grid.cellSize)
	cells = f'{sizes.max():g} m' if sizes.min() == sizes.max() else f'{sizes.min():g} to {sizes.max():g} m'
	print(f"stress: wrong by about {100 * found['error']:.2g} % (root mean square) with cells of {cells}, up to twice or down to half of that; most, by {scatter.max():.3g} Pa, at ({', '.join(f'{x:.4g}' for x in worst)})")
	return found


def discretisationError(run, cellSize):
	"""Estimate the discretisation error of a result, and print it: the scene is run with cells of twice, once and half the size.

	The estimate is twice the change that halving the cells makes: within a factor of two of an error that shrinks with any order above 0.415 (L.F. Richardson 1911; P.J. Roache 1994,
	https://doi.org/10.1115/1.2910291). Where the three values go up and down it is 0.7 times the change. Against known answers it is within a factor of two in more than nine of ten
	cases (``examples/discretisation``). It costs what *run* takes with half of the cell size, 3 to 8 times as long in the plane and 10 or more in 3D, and a little. If that is too much, give twice the
	cell size: the error of the run with *cellSize* itself is then smaller than the estimate as a rule.

	What stays as it is, is not seen: load steps or time steps (let ``O.dt`` go with *cellSize* in *run*), the number of points in a cell, the tolerance, the size of the model, the law. Layers, gaps and slip bands that are narrower than a
	cell of the smallest size are not seen either. The scene that is open is lost (``O.reset()``); that with the smallest cells is left. ::

		def run(cellSize):
			O.materials.append(MpmElasticMat(young=1e7, poisson=0.3, density=2000, label='soil'))
			grid = MpmGrid(cellSize=cellSize)
			O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (8, 0), (8, 4), (0, 4)]), grid, 2, 'soil'))
			held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
			O.engines = [MpmImplicitEngine(grid=grid, gravity=(0, -10, 0), boundaries=held)]
			O.dt = 1 / 10
			O.run(10, wait=True)

		found = mpm.discretisationError(run, cellSize=0.5)
		print(found['displacement']['error'])

	:param run: function of the cell size [m] that makes the scene and runs it, and returns what is of interest: a number, a dict of numbers by name, or None for the largest displacement of
		a point [m]. It is called with ``2 * cellSize``, ``cellSize`` and ``cellSize / 2``, each time in an empty scene
	:param cellSize: cell size [m] of the run that is asked about, > 0
	:return: dict by name (``'value'`` of a single number, ``'displacement'`` of None) of dicts with ``error``, the estimate for *cellSize*, >= 0 and in the unit of the value; ``value``, that of *cellSize*;
		``values`` and ``cellSizes`` [m] of the three runs, from coarse to fine; ``oneWay``: whether the values only rise or only fall; and ``settled``: whether the second
		change is less than three quarters of the first. If not, cells are too large for an estimate that is to be relied on
	:raises TypeError: an argument, or what *run* returns, of the wrong kind.
	:raises ValueError: a cell size that is not admitted; a *run* whose grid has other cells, or that returns other names with other cells or a number that is not finite; no material points where
		the largest displacement is asked for.
	:raises RuntimeError: *run* fails: the message says with which cells, and why.
	"""
	if not callable(run): raise TypeError(f'discretisationError: run = {brief(run)} must be a function of the cell size that makes and runs the scene')
	if not isNumber(cellSize): raise TypeError(f'discretisationError: cellSize = {brief(cellSize)} must be a number [m]')
	if not 0 < cellSize < math.inf: raise ValueError(f'discretisationError: cellSize = {cellSize} is not admitted: expected a finite number > 0 [m]')
	sizes = (2. * cellSize, float(cellSize), cellSize / 2.)
	results = [_resultOf(run, size) for size in sizes]
	for size, result in zip(sizes, results):
		if set(result) != set(results[0]):
			raise ValueError(f'discretisationError: run({size:g}) returns {sorted(result)}, and run({sizes[0]:g}) {sorted(results[0])}: expected the same names')
	found = {name: _judged(sizes, [result[name] for result in results]) for name in results[0]}
	for name, quantity in found.items():
		print(_sentence(name, quantity))
	return found


def _resultOf(run, size):
	"""Numbers by name of the run with cells of a size."""
	result, _ = resultOf('discretisationError', run, size, f'cells of {size:g} m')
	others = [engine.grid.cellSize for engine in enginesOf()]
	if others and not any(math.isclose(other, size, rel_tol=1e-9) for other in others):
		raise ValueError(f'discretisationError: run({size:g}) makes a grid with cellSize = {others[0]:g} m: expected its argument, as in MpmGrid(cellSize=cellSize)')
	return result


def _judged(sizes, values):
	error, oneWay, settled = errorOf(*values)
	return dict(error=error, value=values[1], values=values, cellSizes=list(sizes), oneWay=oneWay, settled=settled)


def _sentence(name, quantity):
	value, error = quantity['value'], quantity['error']
	relative = f' ({100 * error / abs(value):.2g} %)' if value else ''
	text = f"{name} = {value:.6g}, wrong by about {error:.2g}{relative} with cells of {quantity['cellSizes'][1]:g} m, up to twice or down to half of that"
	if not quantity['oneWay']: text += '; it goes up and down with the cells'
	if not quantity['settled']: text += '; halving the cells again changed it by no less: they are too large for an estimate to be relied on'
	return text
