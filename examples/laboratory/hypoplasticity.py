#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Hypoplastic sand of one's own, by the door for user materials: compiled here, checked, and in triaxial tests from loose to dense: hypoplasticity.py [steps]."""
import os
import subprocess
import sys

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), '..'))
from style import plt

out, steps = 'out/laboratory', int((sys.argv[1:] or [800])[0])
os.makedirs(out, exist_ok=True)
source, library = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), 'hypoplasticity.cpp'), os.path.join(out, 'hypoplasticity.so')
subprocess.run(['g++', '-O2', '-shared', '-fPIC', '-I', '/usr/include/eigen3', '-o', library, source], check=True)

phi, hardness, exponent, ed0, ec0, ei0 = radians(33), 1.5e9, 0.28, 0.55, 0.95, 1.05  # parameters of Hochstetten sand
fall = lambda p: np.exp(-(3 * p / hardness)**exponent)
sand = lambda e: MpmUserMat(density=1600, young=50e6, poisson=0.2, library=library, parameters=[phi, hardness, exponent, ed0, ec0, ei0, 0.25, 1, 1], stateVariables=[e], reentrant=True)

p = 100e3
check = mpm.checkLaw(sand(0.7), confiningPressure=p)
print(f"hypoplasticity: the tangent differs from the slope by {check['tangentError']:.1e}")

first = mpm.elementTest(sand(ei0 * fall(10e3)), 'oedometer', -0.01, steps=steps // 2, initialStress=(-10e3, -10e3, -10e3))
loosest = np.array([[10e3, ei0 * fall(10e3)]])
figure, axes = plt.subplots(1, 2, figsize=(11, 4.2))
print(f'hypoplasticity: void ratio after an oedometer from the loosest state {first["state1"][-1]:.4f}, that of the strain {(1 + loosest[0, 1]) * np.exp(-0.01) - 1:.4f}')
for e in 0.6, 0.7, 0.8, 0.9:
	curve = mpm.elementTest(sand(e), 'triaxial', -0.4, steps=steps, confiningPressure=p)
	mean = -np.trace(curve['stress'], axis1=1, axis2=2) / 3
	ratio, voids = curve['q'] / mean, curve['state1']
	axes[0].plot(-100 * curve['axialStrain'], ratio, label=f'e = {e}')
	axes[1].plot(-100 * curve['axialStrain'], voids)
	print(f'hypoplasticity: e = {e}: largest q/p {ratio.max():.4f}, last {ratio[-1]:.4f} (critical {6 * np.sin(phi) / (3 - np.sin(phi)):.4f}), void ratio {voids[-1]:.4f} (critical {ec0 * fall(mean[-1]):.4f})')
axes[0].axhline(6 * np.sin(phi) / (3 - np.sin(phi)), color='black', linestyle=':')
axes[1].axhline(ec0 * fall(mean[-1]), color='black', linestyle=':')
axes[0].set(xlabel='axial shortening, logarithmic [%]', ylabel='q / p [-]'), axes[1].set(xlabel='axial shortening, logarithmic [%]', ylabel='void ratio [-]')
axes[0].legend()
figure.tight_layout()
figure.savefig(f'{out}/hypoplasticity.png', dpi=110)
