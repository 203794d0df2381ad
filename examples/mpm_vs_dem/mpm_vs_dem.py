#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""The same collapse as grains (DEM) and as a continuum (MPM): a vertical cut in a cohesive material under growing gravity.

	o|_________________           height H = 5 m, length 2 H; left: smooth wall; base: rough
	o|                 |          gravity grows in proportion to time (DEM) and to the load factor (MPM)
	o|    grains or    | H        1. a layer of grains is tested; mpm.calibrate gives E, nu, c_u
	o|   continuum     |          2. a cut out of such a layer collapses: DEM
	 ///////////////////////////  3. a continuum with these E, nu, c_u and density collapses: MPM

Run it with `scripts/run examples/mpm_vs_dem/mpm_vs_dem.py [options]`, or by yade-batch with the options as columns of a parameter
table. Read examples/collapse first; grains.py has the DEM part.
"""
import os
import re
import sys
import time

from yade import mpm
from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle
import numpy as np
sys.path[:0] = [os.path.dirname(sys.argv[0]), os.path.join(os.path.dirname(sys.argv[0]), '..')]
from grains import Layer, cutScene, grainArrays
from options import compared, readOptions
from style import plt

options = readOptions('Collapse of a cohesive cut, by DEM and by MPM.',
        grains=(24, 'mean diameters over the height'),
        sample=(20, 'mean diameters along the edges of the sample for calibration'),
        cells=(24, 'cells of the MPM over the height'),
        end=(8., 'stability number gamma H / c_u at the end'),
        duration=(16., 'seconds in which gravity grows to that'))

H, L = 5., 10.
shown = 3., options.end # stability numbers at which states are compared: before and after failure
confinements = 5e3, 20e3, 60e3 # [Pa]
clock = time.process_time


class History:
	"""The same measurements on grains and material points."""

	def __init__(self, points):
		self.rows, self.states = [(0, 0, 0)], {}
		corner = np.linalg.norm(points['pos0'][:, :2] - (L, H), axis=1)
		self.crest = np.flatnonzero(corner < 0.15 * H)
		self.front0 = self.front(points)

	@staticmethod
	def front(points):
		"""Mean x [m] of the foremost hundredth."""
		reach = np.sort((points['pos'] + points['halfSize'])[:, 0])
		return reach[-max(1, len(reach) // 100):].mean()

	def record(self, N, points):
		sinks = (points['pos0'] - points['pos'])[self.crest, 1].mean()
		self.rows.append((N, self.front(points) - self.front0, sinks))
		for at in shown:
			if at not in self.states and N > at * (1 - 1e-9): self.states[at] = points

	@property
	def columns(self):
		return np.array(self.rows).T


def profile(points, width):
	"""Height of the surface [m] in bins along x."""
	x, top = points['pos'][:, 0], (points['pos'] + points['halfSize'])[:, 1]
	edges = np.arange(0, x.max() + width, width)
	number = np.digitize(x, edges) - 1
	return [(edges[i] + width / 2, top[number == i].max()) for i in np.unique(number)]


def verticalStress(points, bins=8):
	"""Mean of sigma_yy [Pa] over 0 < x < H in horizontal slices of the initial height."""
	x, y = points['pos0'][:, 0], points['pos0'][:, 1]
	edges = np.linspace(0, H, bins + 1)
	slices = [(x < H) & (y >= low) & (y < high) for low, high in zip(edges, edges[1:])]
	return (edges[1:] + edges[:-1]) / 2, np.array([points['force'][s].sum() for s in slices]) / (H * H / bins)


## 1. calibration
begin = clock()
d = H / options.grains
layer = Layer(options.sample * d, options.sample * d, d)
oedometer = layer.oedometer()
biaxial = {pressure: layer.biaxial(pressure, 0.25) for pressure in confinements}
sampleCount, bulkDensity, packed = len(O.bodies), layer.density, clock() - begin
# The oedometer is to say how stiff the continuum is, since curves of the biaxial tests bend from the beginning; in these a pascal counts alike at any pressure. The search
# needs no other places to begin at than the middle of the bounds.
tests = [{**oedometer, 'weight': 3}]
for test in biaxial.values():
	tests.append({name: value for name, value in test.items() if name != 'volumetricStrain'} | {'weight': abs(test['stress_yy']).max() / 100e3})
fit = mpm.calibrate(MpmVonMisesMat(density=bulkDensity), tests, dict(young=(1e6, 1e8), poisson=(0, 0.45), yieldStress=(5e3, 2e5)), steps=20, samples=0)
E, nu, cu = fit['values']['young'], fit['values']['poisson'], fit['values']['yieldStress'] / np.sqrt(2)
print(fit['report'])
print(f'calibration on {sampleCount} grains in {packed:.0f} s of CPU, and {clock() - begin - packed:.0f} s for the fit: '
      f'E = {E / 1e6:.2f} MPa, nu = {nu:.3f}, c_u = {cu / 1e3:.1f} kPa, density = {bulkDensity:.0f} kg/m3')


def shearStress(test, values):
	"""(sigma_xx - sigma_yy) / 2 [Pa] of a biaxial test with these sigma_yy."""
	return -(test['confiningPressure'] + values) / 2


strength = {p: shearStress(test, test['stress_yy'])[(test['axialStrain'] < -0.02) & (test['axialStrain'] > -0.2)].mean() for p, test in biaxial.items()}
print('strength at lateral pressure: ' + ', '.join(f'{strength[p] / 1e3:.1f} kPa at {p / 1e3:g} kPa' for p in confinements))
perN = cu / (bulkDensity * H) # gravity [m/s2] at stability number 1

## 2. grains
begin = clock()
layer = Layer(L + d, H + 2.5 * d, d, seed=2)
cutScene(layer, H, L, front=1.7 * L)
dem = History(grainArrays(d))
period = max(1, int(options.duration / O.dt / 400))
O.engines += [
        PyRunner(iterPeriod=period, command='load()'),
        VTKRecorder(fileName=os.path.join(options.out, 'dem-'), recorders=['spheres', 'velocity'], iterPeriod=20 * period),
]
stages, fastest = [(0, 0)], [0]


def load():
	"""Gravity of this time, and measurements: O.time / duration * end is the stability number."""
	N = options.end * min(1, O.time / options.duration)
	newton.gravity = (0, -N * perN, 0)
	if O.iter // period % 4 == 0: dem.record(N, grainArrays(d))
	if O.iter % (20 * period) == 0: stages.append((N, O.iter))
	fastest[0] = max(fastest[0], np.sqrt(2 * utils.kineticEnergy() / sum(b.state.mass for b in O.bodies if b.dynamic)))


O.run(402 * period, wait=True)
dem.record(options.end, grainArrays(d))
demSeconds, grainCount, demSteps = clock() - begin, len(dem.states[options.end]['pos']), O.iter

## 3. continuum
begin = clock()
steps = round(options.end / 0.05)
O.reset()
fit['material'].label = 'continuum'
O.materials.append(fit['material'])
grid = MpmGrid(cellSize=H / options.cells)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (L, 0), (L, H), (0, H)]), grid, pointsPerCell=2, material='continuum'))
O.engines = [
        MpmImplicitEngine(
                grid=grid,
                gravity=(0, -perN, 0),
                loadCurve=[(0, 0), (options.end, options.end)],
                boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')],
                label='solver',
        ),
        PyRunner(iterPeriod=1, initRun=True, command='measure()'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'mpm-'), iterPeriod=max(1, steps // 20), recorders=['points']),
]
O.dt = options.end / steps


def pointArrays():
	points = mpm.arrays()
	return {**points, 'force': points['stress'][:, 1, 1] * points['volume']}


def measure():
	continuum.record(solver.loadFactor, pointArrays())


continuum = History(pointArrays())
try:
	O.run(steps, wait=True)
except RuntimeError as error:
	print(error)
mpmSeconds = clock() - begin

## one table, one series for ParaView, one picture
final = options.end
print(f'DEM: {grainCount} grains, {demSteps} time steps, {demSeconds:.0f} s of CPU; root mean square velocity up to {fastest[0]:.3f} m/s')
print(f'MPM: {len(O.bodies)} material points, {O.iter} of {steps} load steps, {mpmSeconds:.0f} s of CPU')
failures = {}
for name, history in ('DEM', dem), ('MPM', continuum):
	N, front, crest = history.columns
	at = np.interp(0.02 * H, np.maximum.accumulate(crest), N)
	np.savetxt(os.path.join(options.out, name.lower() + '.csv'), np.transpose([N, front, crest]), '%.6g', ',', header='N,front,crest', comments='')
	print(f'{name}: crest sinks by H / 50 at N = {at:.2f}; at N = {N[-1]:.2f} the front has moved by {front[-1]:.3f} m and the crest has sunk by {crest[-1]:.3f} m')
	failures[name] = at
	pressure = [-verticalStress(state)[1].mean() / 1e3 for state in history.states.values()]
	print(f'{name}: mean vertical pressure over 0 < x < H: ' + ', '.join(f'{p:.1f} kPa at N = {N:g} (weight: {N * cu / 2e3:.1f})' for N, p in zip(history.states, pressure)))
compared('stability number at which the crest of a cut sinks by H / 50', failures['MPM'], failures['DEM'], 'the same cut in grains')


def dataSet(part, N, name):
	"""Entry of a .pvd file; grains and continuum get the same 20 times, for ParaView shows together what has the same time to the last digit."""
	return f'<DataSet timestep="{round(20 * N / final) * final / 20:.6g}" part="{part}" file="{name}"/>\n'


with open(os.path.join(options.out, 'mpm-points.pvd')) as file:
	entries = [dataSet(1, float(N), name) for N, name in re.findall(r'timestep="([^"]+)".*file="([^"]+)"', file.read())]
grainEntries = [dataSet(0, N, f'dem-spheres.{iteration}.vtu') for N, iteration in stages]
for name, listed in ('dem-spheres.pvd', grainEntries), ('both.pvd', entries + grainEntries):
	with open(os.path.join(options.out, name), 'w') as file:
		file.write('<VTKFile type="Collection" version="0.1">\n<Collection>\n' + ''.join(listed) + '</Collection>\n</VTKFile>\n')

colours = {'DEM': 'C1', 'MPM': 'C0'}
figure, axes = plt.subplots(3, 2, figsize=(12, 11), layout='constrained')
(curvesOfTests, curves), (grainView, pointView), (surfaces, stresses) = axes
for (pressure, test), fitted, colour in zip(biaxial.items(), fit['curves'][1:], ('C0', 'C1', 'C2')):
	along = -100 * test['axialStrain']
	curvesOfTests.plot(along, shearStress(test, test['stress_yy']) / 1e3, color=colour, label=f'lateral pressure {pressure / 1e3:g} kPa: mean {strength[pressure] / 1e3:.0f} kPa')
	curvesOfTests.plot(along, shearStress(test, fitted['stress_yy']) / 1e3, '--', color='k', label=f'continuum, $c_u$ = {cu / 1e3:.1f} kPa' if colour == 'C2' else None)
curvesOfTests.set(xlabel='axial strain [%]', ylabel='shear stress [kPa]', title='Calibration: biaxial tests on grains', ylim=(0, None))
curvesOfTests.legend(frameon=False, loc='lower right')
for name, history in ('DEM', dem), ('MPM', continuum):
	N, front, crest = history.columns
	curves.plot(front, N, color=colours[name], label=f'{name}, front forwards')
	curves.plot(crest, N, '--', color=colours[name], label=f'{name}, crest downwards')
	for at, style in zip(shown, ('--', '-')):
		if at not in history.states: continue
		surfaces.plot(*np.transpose(profile(history.states[at], H / 12)), style, color=colours[name], label=f'{name}, N = {at:g}')
		height, stress = verticalStress(history.states[at])
		stresses.plot(-stress / 1e3, height, 'o' if name == 'DEM' else '-', color=colours[name], alpha=1 if at == shown[1] else 0.5, label=f'{name}, N = {at:g}')
curves.set(xlabel='movement [m]', ylabel='stability number $N = \\gamma H / c_u$ [-]', title='Movement', ylim=(0, None))
surfaces.set(xlabel='x [m]', ylabel='y [m]', title='Surface', ylim=(0, 1.1 * H))
stresses.set(xlabel='vertical pressure [kPa], mean over 0 < x < H', ylabel='initial height y [m]', title='Stress', xlim=(0, None))
for panel in curves, surfaces, stresses:
	panel.legend(frameon=False)
limit = 0.4 * H
state = dem.states[final]
moved = np.linalg.norm(state['pos'] - state['pos0'], axis=1)
discs = grainView.add_collection(PatchCollection([Circle(p[:2], r[0]) for p, r in zip(state['pos'], state['halfSize'])], array=moved, cmap='viridis', clim=(0, limit), edgecolors='none'))
figure.colorbar(discs, cax=grainView.inset_axes([1.02, 0, 0.025, 1]), label='displacement [m]')
mpm.plot('displacement', ax=pointView, range=(0, limit))
if pointView.get_legend(): pointView.get_legend().remove()  # would lie on the title
for view, title in (grainView, f'DEM: {grainCount} grains, {demSeconds:.0f} s of CPU'), (pointView, f'MPM: {len(O.bodies)} points, {mpmSeconds:.0f} s of CPU'):
	view.plot([0, L, L], [H, H, 0], 'k--', linewidth=0.8)
	view.set(aspect='equal', xlim=(-0.2, 1.45 * L), ylim=(-0.3, 1.1 * H), xlabel='x [m]', ylabel='y [m]', title=f'{title}, N = {final:g}')
figure.savefig(os.path.join(options.out, 'mpm_vs_dem.png'), dpi=110)
print(f'written: {options.out}/mpm_vs_dem.png, dem.csv, mpm.csv, and for ParaView {options.out}/both.pvd')
