# SPDX-License-Identifier: GPL-2.0-or-later
"""One slope of section 4.2 and what is noted of it; tables 1 and 2 and figures 6 and 7 share these runs."""
from common import *

B, C, weakTop = np.array([10., 12.]), np.array([15., 7.]), 7.5 # [m], figure 5


def smoothing(position, radius):
	"""(N, N) matrix that replaces values at the points by local linear fits (moving least squares).

	The weight of a neighbour at the distance r is (1 - (r / radius)^2)^2.
	"""
	matrix = np.zeros((len(position), len(position)))
	for i, centre in enumerate(position):
		away = (position - centre) / radius
		squared = (away**2).sum(axis=1)
		near = np.flatnonzero(squared < 1)
		root = 1 - squared[near] # square root of the weight
		linear = np.column_stack([np.ones(len(near)), away[near]])
		matrix[i, near] = np.linalg.pinv(linear * root[:, None])[0] * root
	return matrix


class FaceStress:
	"""sigma_xy [Pa] of the points within one cell of the slope's face B-C, above the weak layer, whose stress differs by itself.

	Points, and the neighbours in the fit, go by initial positions: all steps of all runs with the same points are measured alike.
	"""

	def __init__(self, cellSize):
		position = mpm.arrays()['pos0'][:, :2]
		tangent = (C - B) / np.linalg.norm(C - B)
		along, depth = (position - B) @ tangent, (position - B) @ [tangent[1], -tangent[0]]
		self.points = np.flatnonzero((along >= 0) & (depth <= cellSize * (1 + 1e-9)) & (position[:, 1] > weakTop))
		self.along = along[self.points] # [m] from B
		self.smoothing = smoothing(position[self.points], 2 * cellSize)
		self.history = []

	def record(self):
		"""Take the stress of this step; returns its oscillation [-]: RMS deviation from the local linear fit over two cells around, over the RMS."""
		stress = mpm.arrays()['stress'][self.points, 0, 1]
		self.history.append(stress)
		return np.linalg.norm(stress - self.smoothing @ stress) / np.linalg.norm(stress)


def saveState(path, face):
	"""Saves data of the pictures: corners of the deformed domains [m] and sigma_xy [Pa] of the last converged state, and of the face for all steps."""
	points = mpm.arrays()
	box = points['halfSize0'][:, None, :] * np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
	corners = points['pos'][:, None, :] + np.einsum('pij,pcj->pci', points['defGrad'], box)
	os.makedirs(os.path.dirname(path), exist_ok=True)
	state = dict(corners=corners[:, :, :2], shearStress=points['stress'][:, 0, 1], along=face.along, faceStress=face.history)
	np.savez_compressed(path, **{name: np.asarray(values, np.float32) for name, values in state.items()})


def runSlope(out, cellSize, pointsPerCell, factor, lineSearchTrials=0):
	"""Run one slope to its end, or to the step that fails, unless its results are there already.

	Adds a row to slope.csv and one for each converged step to slope-steps.csv, and keeps the last converged state in
	<out>/states. Iterations are linear solves.
	"""
	key = cellSize, pointsPerCell, factor, lineSearchTrials
	keys = ['cellSize', 'pointsPerCell', 'factor', 'lineSearchTrials']
	runs = Results(out, 'slope', keys, ['points', 'steps', 'completed', 'meanIterations', 'maxIterations', 'displacement', 'oscillation', 'failure'])
	state = os.path.join(out, 'states', 'slope-{:g}-{}-{:g}-{}.npz'.format(*key))
	if key in runs and os.path.exists(state): return

	engine, steps = slope(cellSize, pointsPerCell, lineSearchTrials, factor=factor)
	face, history = FaceStress(cellSize), []
	failure = runSteps(steps, lambda: history.append((len(history) + 1, engine.iterations, engine.residual, face.record())))
	saveState(state, face)
	Results(out, 'slope-steps', keys + ['step'], ['iterations', 'residual', 'oscillation']).add(
	        dict(zip(keys + ['step', 'iterations', 'residual', 'oscillation'], (*key, *row))) for row in history)
	points = mpm.arrays()
	solves = [row[1] for row in history]
	values = (
	        len(points['id']), steps, len(history), np.mean(solves), max(solves), np.linalg.norm(points['pos'] - points['pos0'], axis=1).max(),
	        history[-1][-1], failure)
	runs.add([dict(zip(runs.columns, (*key, *values)))])
	print(*runs.row(key).values(), flush=True)


def countByTolerance(out, cellSize, pointsPerCell):
	"""Iterations of the slope with ghost stabilisation if the tolerance were tighter: adds rows to table1-tolerance.csv.

	All are read from the residuals of one run that meets the tightest tolerance.
	"""
	results = Results(out, 'table1-tolerance', ['cellSize', 'pointsPerCell', 'tolerance'], ['meanIterations', 'maxIterations'])
	tolerances = [1e-6, 5e-7, 3e-7]
	if all((cellSize, pointsPerCell, tolerance) in results for tolerance in tolerances): return
	engine, steps = slope(cellSize, pointsPerCell, factor=1e-2)
	engine.newton.tolerance = tolerances[-1]
	history = []
	failure = runSteps(steps, lambda: history.append(engine.residuals))
	if failure: raise RuntimeError(failure)
	rows = []
	for tolerance in tolerances:
		solves = [next(i for i, residual in enumerate(residuals) if i > 0 and residual <= tolerance) for residuals in history]
		rows.append(dict(zip(results.columns, (cellSize, pointsPerCell, tolerance, np.mean(solves), max(solves)))))
	results.add(rows)
