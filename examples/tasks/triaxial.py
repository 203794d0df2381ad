#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A triaxial test on sand, with its curve as a picture. By hand: q = (N - 1) p + 2 c sqrt(N), N = (1 + sin phi) / (1 - sin phi) (Mohr-Coulomb)."""
import numpy as np
from yade import mpm
c, phi, p = 2e3, np.radians(32), 1e5
O.materials.append(MpmMohrCoulombMat(young=4e7, poisson=0.3, density=1800, cohesion=c, frictionAngle=phi, dilationAngle=0, label='sand'))
curve = mpm.elementTest('sand', 'triaxial', -0.05, confiningPressure=p, fileName='triaxial.png')
N = (1 + np.sin(phi)) / (1 - np.sin(phi))
found, hand = curve['q'].max(), (N - 1) * p + 2 * c * np.sqrt(N)
print(f'triaxial test: q = {found / 1e3:.2f} kPa, by hand {hand / 1e3:.2f} kPa ({100 * (found / hand - 1):+.2f} %)')
