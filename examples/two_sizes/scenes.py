# SPDX-License-Identifier: GPL-2.0-or-later
"""Limit loads of undrained clay with known answers, on a Quadtree: what of them the grid makes too large; needs nothing of YADE.

	footing  rough strip footing of width 2, half by symmetry, in a block 3 widths wide (half of it) and 2.5 deep, as that of examples/penetration: 2 + pi
	cut      vertical cut of examples/collapse, 5 m high and 10 m wide: stability number 3.776 where the front has moved by 1 % of the height
	bar      rough cylinder of diameter 1 in a block 3 diameters around it between rough walls, as the T-bar of examples/penetration, half by symmetry: 11.94

and the same in blocks that hold what fails and little more: tightFooting (1.5 widths and 1, as in examples/locking), tightCut (8 m wide), tightBar (1.5 diameters).
"""
from dataclasses import dataclass
from typing import Callable

import numpy as np
from clay import Clay
from quadtree import Quadtree

scenes = {}


def scene(function):
	scenes[function.__name__] = function
	return function


@dataclass
class Scene:
	"""A scene and its answer.

	:param tree: the grid before cells are halved
	:param near: distances (N,) of places (N, 2) from where it is decided
	:param analyse: of the connected tree, the limit load and the Clay that bore it
	:param exact: limit load
	"""
	tree: Quadtree
	near: Callable
	analyse: Callable
	exact: float



def positions(tree):
	"""(F, 2) of the free nodes."""
	kept = np.asarray((tree.free == 1).argmax(axis=0)).ravel()
	return tree.nodes[kept]


def pushed(clay, held, rigid, way, steps):
	"""Largest force on free nodes of the mask *rigid*, moved downwards in equal steps."""
	mask = held.copy()
	mask[rigid] = True
	down = np.zeros(mask.shape)
	down[rigid, 1] = -way / steps
	fixed, d, largest, worked = mask.ravel(), np.zeros(mask.size), 0., 0.
	for _ in range(steps):
		d, force, _ = clay.step(d, fixed, down.ravel()[fixed])
		worked = worked + clay.dissipated
		largest = max(largest, -force.reshape(-1, 2)[rigid, 1].sum())
	clay.work = worked
	return largest


@scene
def footing(cells, levels, fBar=True, block=(3, 2.5)):
	"""*cells* of the smallest size over half the width, without the half cell at its edge. *block* in widths."""
	B = 2.
	h = B / (2 * cells + 1)
	coarse = h * 2**levels
	shape = [int(np.ceil(n * B / coarse - 1e-9)) for n in block]
	tree = Quadtree(shape, coarse, (0, -shape[1] * coarse))

	def analyse(tree):
		clay = Clay(tree, 1000, 0.3, fBar)
		x, y = positions(tree).T
		held = np.column_stack([(x < 1e-9) | (x > shape[0] * coarse - 1e-9) | (y < tree.origin[1] + 1e-9), y < tree.origin[1] + 1e-9])
		return pushed(clay, held, (y > -1e-9) & (x <= B / 2 + 1e-9), 0.04 * B, 16) / (B / 2), clay

	edge = np.array([B / 2, 0])
	return Scene(tree, lambda at: np.linalg.norm(at - edge, axis=1), analyse, 2 + np.pi)


@scene
def cut(cells, levels, fBar=True, width=10.):
	"""*cells* of the smallest size over the height. *width* in metres."""
	H, coarse = 5., 5. / cells * 2**levels
	shape = [round(width / coarse), cells // 2**levels]
	tree = Quadtree(shape, coarse, (0, 0))

	def analyse(tree):
		clay = Clay(tree, 500, 0.3, fBar)
		x, y = positions(tree).T
		fixed = np.column_stack([(x < 1e-9) | (y < 1e-9), y < 1e-9]).ravel()
		load, front = clay.weight() / H, np.flatnonzero(x > width - 1e-9)
		unit = width * 0.002  # unit of the mean settlement [m], over the area
		d, moved, total, factor, clay.work = np.zeros(fixed.size), [0.], np.zeros(fixed.size), 0., 0.
		numbers = [0.]
		while moved[-1] < 0.01 * H:
			d, _, factor = clay.step(d, fixed, 0, load, (unit, factor))
			clay.work, total = clay.work + clay.dissipated, total + d
			moved, numbers = moved + [total.reshape(-1, 2)[front, 0].max()], numbers + [factor]
		return np.interp(0.01 * H, moved, numbers), clay

	toe = np.array([width, 0])
	return Scene(tree, lambda at: np.linalg.norm(at - toe, axis=1), analyse, 3.776)


@scene
def bar(cells, levels, fBar=True, way=0., block=3):
	"""*cells* of the smallest size over the radius. *way* of the bar through the clay: what is near is near to any of its places. *block* in diameters."""
	D = 1.
	h = D / 2 / cells
	coarse = h * 2**levels
	across = int(np.ceil(block * D / coarse - 1e-9))
	tree = Quadtree([across, 2 * across], coarse, (0, -across * coarse))

	def analyse(tree):
		clay = Clay(tree, 200, 0.49, fBar)
		x, y = positions(tree).T
		wall = (x > across * coarse - 1e-9) | (abs(y) > across * coarse - 1e-9)
		held = np.column_stack([(x < 1e-9) | wall, wall])
		return 2 * pushed(clay, held, np.hypot(x, y) <= D / 2 - h / 2, 0.1 * D, 10) / D, clay

	def near(at):
		return abs(np.hypot(at[:, 0], np.maximum(abs(at[:, 1]) - way / 2, 0)) - D / 2)

	return Scene(tree, near, analyse, 11.94)


@scene
def tightFooting(cells, levels):
	return footing(cells, levels, block=(1.5, 1))


@scene
def tightCut(cells, levels):
	return cut(cells, levels, width=8.)


@scene
def tightBar(cells, levels):
	return bar(cells, levels, block=1.5)
