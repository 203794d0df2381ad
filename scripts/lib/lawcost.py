# SPDX-License-Identifier: GPL-2.0-or-later
"""In YADE: processor time of laws of soil, of ground 24 m x 12 m that bears a strip load."""
import os
import subprocess
import tempfile
from math import inf, pi

from yade import mpm, pack
from yade.wrapper import *

O = Omega()
root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
degree = pi / 180
friction = dict(young=30e6, poisson=0.3, density=2000, cohesion=5e3, frictionAngle=30 * degree)
stiff = dict(density=2000, E50ref=30e6, Eoedref=30e6, Eurref=90e6, power=0.5, K0nc=0.5, cohesion=5e3, frictionAngle=30 * degree)
elastic, limit = dict(young=30e6, poisson=0.3, density=2000), 110e3
clay = dict(density=2000, shearModulus=10e6, criticalStateRatio=1.2, compressionIndex=0.02, swellingIndex=0.004, preconsolidation=1e5, referencePressure=1e3)
norSand = dict(density=2000, shearModulus=30e6, swellingIndex=0.0015, referencePressure=100e3, criticalStateRatio=1.27, compressionIndex=0.02, criticalVolume=1.8911, hardening=70, specificVolume=1.75)
sand = [33 * degree, 1.5e9, 0.28, 0.55, 0.95, 1.05, 0.25, 1, 1e3]


def compiled(source):
	"""Library of a law; those of tests/mfront have MFront's generic interface and need no MFront."""
	library = os.path.join(tempfile.mkdtemp(), 'law.so')
	subprocess.run(['g++', '-O2', '-shared', '-fPIC', '-I', '/usr/include/eigen3', '-o', library, os.path.join(root, source)], check=True)
	return library


laws = {
        'Mohr-Coulomb': lambda: MpmMohrCoulombMat(**friction),
        'Drucker-Prager': lambda: MpmDruckerPragerMat(**friction),
        'Mohr-Coulomb, softens': lambda: MpmMohrCoulombMat(residualCohesion=4e3, softeningStrain=0.05, **friction),
        'Mohr-Coulomb, power': lambda: MpmMohrCoulombMat(power=0.5, **friction),
        'Drucker-Prager, power': lambda: MpmDruckerPragerMat(power=0.5, **friction),
        'Cam clay': lambda: MpmCamClayMat(**clay),
        'hardening soil': lambda: MpmHardeningSoilMat(**stiff),
        'hardening soil, small strain': lambda: MpmHardeningSoilMat(G0ref=150e6, gamma07=1e-4, **stiff),
        'NorSand': lambda: MpmNorSandMat(**norSand),
        'von Mises': lambda: MpmVonMisesMat(yieldStress=limit, **elastic),
        "von Mises, by MFront's interface": lambda: MpmUserMat(library=compiled('tests/mfront/laws.cpp'), function='VonMises', parameters=[30e6, 0.3, limit * 1.5**0.5], reentrant=True, **elastic),
        'hypoplastic, by UMAT': lambda: MpmUserMat(
                library=compiled('examples/laboratory/hypoplasticity.cpp'), parameters=sand, stateVariables=[0.7], reentrant=True, young=50e6, poisson=0.2, density=2000)
}


def cost(law):
	"""Processor time of a point and iteration [microseconds], over ten steps."""
	O.reset()
	soil = laws[law]()
	soil.label = 'soil'
	O.materials.append(soil)
	grid = MpmGrid(cellSize=0.5)
	O.bodies.append(mpm.fill(pack.inAlignedBox((0, 0, -1), (24, 12, 1)), grid, 2, 'soil'))
	held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(24, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='y')]
	loads = [MpmTraction(surface=[(24, 12), (0, 12)], pressure=10e3, curve=[(0, 1)]), MpmTraction(surface=[(15, 12), (9, 12)], pressure=60e3)]
	solver = MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), gravityCurve=[(0, 1)], boundaries=held, loads=loads, verbosity=0)
	O.engines, O.dt = [solver], 0.1
	mpm.geostatic(K0=0.5, surface=12 + 10e3 / (2000 * 9.81))
	begin, iterations, steps, why = os.times(), 0, 0, ''
	while steps < 10 and not why:
		try:
			O.step()
			steps, iterations = steps + 1, iterations + solver.iterations
		except RuntimeError:
			why = f'ended after {steps} steps'
	end = os.times()
	return dict(law=law, microseconds=1e6 * (end.user + end.system - begin.user - begin.system) / max(iterations, 1) / len(O.bodies), iterations=iterations, why=why)


def costs():
	return [cost(law) for law in laws]
