#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""A column between rollers that stand askew on the grid, under its weight or under a lid that is pushed in, against the aligned column's stress.

	   \\    lid: pushed by its velocity
	  \\  \\
	   \\  \\      walls and lid are segments, turned by an angle against the grid, and hold along their normals;
	    \\  \\     gravity goes along the column
	     \\ /
	   foot

A confined column knows its stress at any angle: along its axis it carries the weight above, or E ln(l) / l at the stretch l under the lid (Hencky's law without
Poisson's ratio).

Run it with `scripts/run examples/walls/walls.py [options]`, or by yade-batch with the options as columns of a parameter table. Read examples/column first.
"""
import os
import sys

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('A confined column askew on the grid.',
        load=('weight', "'weight' or 'lid'"),
        angle=(20., 'of the column against the grid [degrees]'),
        cells=(16, 'cells over the height'),
        steps=(10, 'load steps'),
        penalty=(0., 'of the walls; 0: the default'),
        pattern=('turned', "'turned': rows of points are along the walls; 'grid': along the grid"),
        poisson=(0., "Poisson's ratio"),
        pointsPerCell=(2, 'material points per cell and axis'),
        push=(0.1, 'way of the lid over the height'))

height, width, E, weight = 8., 2., 1e6, 2e4
h, nu = height / options.cells, options.poisson
angle = np.radians(options.angle)
axis, across = np.array([-np.sin(angle), np.cos(angle)]), np.array([np.cos(angle), np.sin(angle)])
corner = lambda x, y: tuple(np.append(x * across + y * axis, 0))

O.materials.append(MpmElasticMat(young=E, poisson=nu, density=weight / 10, label='soil'))
grid = MpmGrid(cellSize=h, origin=(0.13 * h, 0.29 * h, 0))
if options.pattern == 'turned':  # rows of points along the walls
	O.bodies.append(mpm.fill(mpm.polygon([(0, 0), (width, 0), (width, height), (0, height)]), MpmGrid(cellSize=h), options.pointsPerCell, 'soil'))
	for body in O.bodies:
		body.state.pos = body.state.refPos = corner(*list(body.state.pos)[:2])
else:  # same as any region: rows along the grid, and stairs at the walls
	column = mpm.polygon([corner(x, y)[:2] for x, y in ((0, 0), (width, 0), (width, height), (0, height))])
	O.bodies.append(mpm.fill(column, grid, options.pointsPerCell, 'soil'))


def wall(*points, **keywords):
	if options.penalty: keywords['penalty'] = options.penalty
	return MpmBoundary(surface=[corner(x, y) for x, y in points], fix='n', **keywords)


isLid = options.load == 'lid'
foot, left, right = wall((-h, 0), (width + h, 0)), wall((0, height + h), (0, -h)), wall((width, -h), (width, height + h))
lid = wall((width + h, height), (-h, height), velocity=tuple(np.append(-options.push * height * axis, 0)))
O.engines = [
        MpmImplicitEngine(
                grid=grid,
                gravity=(0, 0, 0) if isLid else tuple(np.append(-10 * axis, 0)),
                boundaries=[foot, left, right] + ([lid] if isLid else []),
                newton=MpmNewton(tolerance=1e-8),
                label='solver'),
        MpmVtkRecorder(fileName=os.path.join(options.out, 'walls-'), recorders=['points', 'walls'], iterPeriod=options.steps),
]
O.dt = 1 / options.steps
O.run(options.steps, wait=True)

points = mpm.arrays()
along, sideways = (np.einsum('i,pij,j->p', n, points['stress'][:, :2, :2], n) for n in (axis, across))
above = height - points['pos0'][:, :2] @ axis
stretch = 1 - options.push
exact = np.full(len(along), E * np.log(stretch) / stretch) if isLid else -weight * above
forces = [np.array([-np.dot(force, [*axis, 0]), np.dot(force, [*across, 0])]) for force in solver.reactions]
print(f'{len(O.bodies)} material points, {solver.dofs} unknowns, {solver.iterations} iterations in the last step, condition number about {solver.conditionEstimate():.2g}')
print(f'stress along: mean error over the largest {np.abs(along - exact).mean() / np.abs(exact).max():.5f}, mean {along.mean() / exact.mean():.5f} of the aligned one')
compared(f'mean stress of a column askew, {options.load}', along.mean() / exact.mean(), 1, 'closed form', 'aligned')
if nu: print(f'stress across over stress along: {sideways.mean() / along.mean():.4f}, exact {nu / (1 - nu):.4f}')
if isLid:
	print(f'force on lid over exact: {forces[3][0] / (width * -exact[0]):.5f}, lid and foot together: {(forces[3][0] + forces[0][0]) / forces[3][0]:.1e}')
	compared('force on the lid of a column askew', forces[3][0] / (width * -exact[0]), 1, 'closed form', 'aligned')
else:
	total = weight * sum(body.state.volume0 for body in O.bodies)
	print(f'reactions over weight: {-sum(forces)[0] / total:.8f} along, {sum(forces)[1] / total:.1e} across; of the foot alone {-forces[0][0] / total:.5f}')

figure, (picture, curve) = plt.subplots(1, 2, figsize=(9, 4.8), layout='constrained')
mpm.plot(along / 1e3, ax=picture, grid=True, range=(along.min() / 1e3, -along.min() / 1e3), colormap='RdBu_r')
picture.set_title('stress along the column [kPa]', pad=24, fontsize='medium')
curve.plot(along / 1e3, above, '.', markersize=2, label='points')
order = np.argsort(above)
curve.plot(exact[order] / 1e3, above[order], 'k-', linewidth=0.8, label='aligned column')
curve.set(xlabel='stress along the column [kPa]', ylabel='initial depth [m]', ylim=(height, 0))
curve.legend(frameon=False)
figure.savefig(os.path.join(options.out, 'walls.png'), dpi=130)
print(f'written: {options.out}/walls.png, and for ParaView {options.out}/walls-walls.pvd')
