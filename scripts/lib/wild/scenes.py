# SPDX-License-Identifier: GPL-2.0-or-later
"""In YADE: element tests, a column and a strip with a public law; units are those of the law."""
import os
import subprocess
import time
from math import inf

import numpy as np
from yade import mpm
from yade.mpm.library import engine
from yade.wrapper import MpmBoundary, MpmGrid, MpmImplicitEngine, MpmMohrCoulombMat, MpmTraction, MpmUserMat, Omega

from .laws import frictional, karlsruhe, laws, root

O = Omega()


def material(name, library):
	law = laws[name]
	os.chdir(os.path.dirname(library))  # where some laws write files
	return MpmUserMat(
	        density=2000 / law.unit, young=law.young, poisson=0.3, library=library, function=law.function, parameters=law.parameters, stateVariables=law.states, label='soil', **law.tensors)


def reference(name, library):
	"""Largest q in Pa, or q/p of Cam clay at its critical state."""
	if laws[name].theirs is not None: return laws[name].theirs
	if name.split('-')[0] in ('Mohr', 'Matsuoka', 'Drucker'): return triaxial(MpmMohrCoulombMat(density=2000, label='soil', **frictional), 100e3, -0.1, 400)['q'].max()
	if not name.startswith('hypo'): return np.nan
	own = os.path.join(os.path.dirname(library), 'own.so')
	subprocess.run(['g++', '-O2', '-shared', '-fPIC', '-I', '/usr/include/eigen3', '-o', own, os.path.join(root, 'examples/laboratory/hypoplasticity.cpp')], check=True)
	constants = [value * (1e3 if key == 'hardness' else 1) for key, value in karlsruhe.items()] + [1]
	sand = MpmUserMat(density=2000, young=5e7, poisson=0.3, library=own, parameters=constants, stateVariables=laws[name].states[:1], label='soil')
	return triaxial(sand, 100e3, -0.1, 400)['q'].max()


def triaxial(law, pressure, strain, steps):
	return mpm.elementTest(law, 'triaxial', strain, steps=steps, confiningPressure=pressure, duration=1)


def element(name, library):
	"""Triaxial test, compared with *reference*, and the error of the tangent where the law flows."""
	law, soil = laws[name], material(name, library)
	begin = time.time()
	if law.path: found, theirs = alongPath(soil, os.path.join(os.path.dirname(library), 'path.ref'))
	else: found, theirs = triaxialTest(law, soil, name), reference(name, library)
	seconds = time.time() - begin
	tangent = mpm.checkLaw(soil, strain=law.check[0], confiningPressure=law.check[1] / law.unit, duration=1)['tangentError']
	return dict(found=found, theirs=theirs, tangent=tangent, seconds=seconds)


def triaxialTest(law, soil, name):
	"""Largest q in Pa, of the Kirchhoff stress where a number of small strains stands beside it; of Cam clay q/p in the end."""
	isClay = name.startswith('Cam clay')
	curve = triaxial(soil, law.pressure / law.unit, -0.5 if isClay else -0.25 if name.startswith('NorSand') else -0.1, 1000 if isClay else 400)
	mean = -np.trace(curve['stress'], axis1=1, axis2=2) / 3
	volume = np.exp(curve['volumetricStrain']) if law.theirs is not None else 1
	return curve['q'][-1] / mean[-1] if isClay else (volume * curve['q']).max() * law.unit


def alongPath(soil, path):
	"""Last q of a law along the strains of a file of MTest, and that of the file [Pa]; stresses between may differ by 1e-9 of the last."""
	rows = np.loadtxt(path, usecols=(1, 2, 3, 7, 8, 9))
	strain, elastic, internals, worst = np.zeros((3, 3)), np.zeros((3, 3)), {}, 0
	for row in rows[1:]:
		increment = np.diag(row[:3]) - strain
		answer = engine.respondInSpace(soil, list((elastic + increment).ravel()), list(increment.ravel()), internals, 0.)
		strain, elastic, internals, stress = strain + increment, np.array(answer['elasticStrain']), answer['internals'], np.diag(answer['stress'])
		worst = max(worst, abs(stress - row[3:]).max())
	if worst > 1e-9 * abs(rows[-1, 3:]).max(): raise ValueError(f'stresses differ by {worst:.3g} Pa along {os.path.basename(path)}.')
	return stress[0] - stress[2], rows[-1, 3] - rows[-1, 5]


def ground(name, library, width, loaded, cell=0.5, depth=4., steps=20):
	"""Ground under its weight and 10 kPa, loaded by 100 kPa on a part of its surface: settlement [m], and iterations and seconds of a step."""
	law = laws[name]
	O.reset()
	O.materials.append(material(name, library))
	grid = MpmGrid(cellSize=cell)
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (width, 0), (width, depth), (0, depth)]), grid, 2, 'soil'))
	sides = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(width, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
	always = MpmTraction(surface=[(width, depth), (0, depth)], pressure=10e3 / law.unit, curve=[(0, 1)])
	load = MpmTraction(surface=[(loaded, depth), (0, depth)], pressure=100e3 / law.unit)
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], boundaries=sides, loads=[load, always], loadCurve=[(0, 0), (1, 1)], verbosity=0)
	O.engines, O.dt = [solver], 1 / steps
	mpm.geostatic(K0=0.5)
	points = mpm.arrays()
	top = points['pos'][:, 1] > depth - 0.3 * cell
	chosen = top & (points['pos'][:, 0] < loaded)
	begin, iterations, count = time.time(), 0, 0
	while O.time < 1 - 1e-9:
		O.step()
		iterations, count = iterations + solver.iterations, count + 1
	settlement = (points['pos'] - mpm.arrays()['pos'])[chosen, 1].mean()
	return dict(settlement=settlement, iterations=iterations / count, steps=count, seconds=(time.time() - begin) / count)


def column(name, library):
	return ground(name, library, 1., 1.)


def strip(name, library):
	return ground(name, library, 6., 1.)
