#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A sheet pile wall with one anchor, 6 m dug out in stages, 3 m left below. By hand: free earth support with Coulomb's pressures. out/anchored_wall.png has N, Q and M on the wall."""
import os
import numpy as np
from yade import mpm
phi, delta, c, gamma, depth, foot, head = radians(32), radians(20), 1e3, 1800 * 9.81, 6, 9, 1.5
O.materials.append(MpmMohrCoulombMat(young=3e7, poisson=0.3, density=1800, cohesion=c, frictionAngle=phi, label='sand'))
grid = MpmGrid(cellSize=0.5)
O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (24, 0), (24, 12), (0, 12)]), grid, 2, 'sand'))
anchor = MpmReinforcement(line=[(14, 12 - head), (7, 8), (4, 7)], axialStiffness=5e7, freeLength=6, bond=2e5, bondStiffness=1e8, pretension=4e4)
wall = MpmBeam(line=[(14, 12), (14, 12 - foot)], axialStiffness=3e9, bendingStiffness=5e7, adhesion=0, friction=delta, anchors=[anchor])
held = [MpmBoundary(max=(0, inf, inf), fix='x'), MpmBoundary(min=(24, -inf, -inf), fix='x'), MpmBoundary(max=(inf, 0, inf), fix='xy')]
solver = MpmImplicitEngine(grid=grid, gravity=(0, -9.81, 0), boundaries=held, gravityCurve=[(0, 1)], verbosity=0)
O.engines, O.dt = [solver], 0.25
mpm.geostatic(0.5)
solver.loads = [wall]
for dug in 1.5, 3, 4.5, depth:
	mpm.stages.excavate(mpm.polygon([(14, 12 - dug), (24, 12 - dug), (24, 13), (14, 13)]), steps=4)
	O.run(4, wait=True)
os.makedirs('out', exist_ok=True)
axes = mpm.plot('displacement')
for quantity, size in dict(axialForce=1, shearForce=2, moment=3).items(): mpm.diagram(wall, quantity, axes, size)
mpm.diagram(anchor, 'axialForce', axes).figure.savefig('out/anchored_wall.png')
Ka, Kp = np.cos(phi)**2 / (1 + np.sqrt(np.sin(phi + delta) * np.sin(phi) / np.cos(delta)))**2, np.tan(np.pi / 4 + phi / 2)**2
active, less = Ka * gamma * foot**2 / 2, 2 * c * np.sqrt(Ka) * foot
needed = (active * (2 / 3 * foot - head) - less * (foot / 2 - head)) / (depth + 2 / 3 * (foot - depth) - head)  # resistance of the earth before the foot
print(f'anchored wall: anchor = {anchor.axialForces[0] / 1e3:.1f} kN, by hand {(active - less - needed) * np.hypot(7, 2.5) / 7 / 1e3:.1f} kN')
