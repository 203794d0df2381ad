# SPDX-License-Identifier: GPL-2.0-or-later
"""CalculiX (ccx): writes input decks, runs them, and reads the printed results. Plane strain; needs nothing of YADE."""
import os
import re
import subprocess
import time

import numpy as np

from . import meshes
from .scenes import Beam, Cavity, Consolidation, Embankment, Footing

program, package = 'ccx', 'calculix-ccx'
kinds = {'CPE4': 1, 'CPE8R': 2}  # order of the elements
lacking = {}


def lines(numbers):
	"""Numbers, 10 a line."""
	numbers = [str(number) for number in numbers]
	return '\n'.join(', '.join(numbers[i:i + 10]) for i in range(0, len(numbers), 10))


def nodeSet(name, numbers):
	return f'*NSET, NSET={name}\n{lines(number + 1 for number in numbers)}\n'


def model(mesh, kind, materials):
	"""Nodes, elements by blocks, and their materials: by block the lines of its material."""
	text = '*NODE, NSET=NALL\n' + ''.join(f'{n}, {x:.12g}, {y:.12g}, 0\n' for n, (x, y) in enumerate(mesh.nodes, 1))
	for block, numbers in mesh.blocks.items():
		text += f'*ELEMENT, TYPE={kind}, ELSET={block.upper()}\n' + ''.join(f"{e + 1}, {', '.join(str(n + 1) for n in mesh.elements[e])}\n" for e in numbers)
	for block, material in materials.items():
		text += f'*MATERIAL, NAME=M{block.upper()}\n{material}*SOLID SECTION, ELSET={block.upper()}, MATERIAL=M{block.upper()}\n1.\n'
	return text


def elastic(scene, more=''):
	return f'*ELASTIC\n{scene.young:.9g}, {scene.poisson:.9g}\n{more}'


def fixed(name, *directions):
	return '*BOUNDARY\n' + ''.join(f'{name}, {direction}, {direction}\n' for direction in directions)


def clay(scene):
	return elastic(scene, f'*PLASTIC\n{np.sqrt(3) * scene.strength:.9g}, 0.\n')


def staticStep(steps, more, begin=''):
	"""Step in equal increments, which the program may shorten."""
	return f'*STEP, INC=1000{begin}\n*STATIC\n{1 / steps:.9g}, 1., 1e-5, {1 / steps:.9g}\n{more}*END STEP\n'


def footing(size, kind):
	mesh, s = meshes.footing(size, kinds[kind]), Footing(size)
	edge, wide, deep = s.width / 2 + 1e-6, s.columns * s.h, s.rows * s.h
	strip = mesh.where(lambda x, y: y > -1e-9 and x < edge)
	text = model(mesh, kind, dict(clay=clay(s))) + nodeSet('STRIP', strip) + nodeSet('BASE', mesh.where(lambda x, y: y < 1e-9 - deep))
	text += nodeSet('SIDES', mesh.where(lambda x, y: x < 1e-9 or x > wide - 1e-9))
	text += fixed('BASE', 1, 2) + fixed('SIDES', 1) + fixed('STRIP', 1)
	text += staticStep(s.steps, f'*BOUNDARY\nSTRIP, 2, 2, {-s.settlement:.9g}\n*NODE PRINT, NSET=STRIP, TOTALS=ONLY\nRF\n')
	return mesh, text, lambda printed: max(abs(rows[-1][1]) for rows in printed['total force']) / (s.width / 2) / s.strength


def cavity(size, kind):
	mesh, s = meshes.cavity(size, kinds[kind]), Cavity(size)
	wall = lambda x, y: x * x + y * y < s.inner**2 + 1e-9
	pressed = ''.join(f'{e + 1}, P{side + 1}, {s.pressure:.9g}\n' for e, side in mesh.sides(wall))
	text = model(mesh, kind, dict(clay=clay(s))) + nodeSet('LEFT', mesh.where(lambda x, y: x < 1e-9)) + nodeSet('BOTTOM', mesh.where(lambda x, y: y < 1e-9)) + nodeSet('WALL', mesh.where(wall))
	text += fixed('LEFT', 1) + fixed('BOTTOM', 2) + staticStep(s.steps, f'*DLOAD\n{pressed}*NODE PRINT, NSET=WALL\nU\n')
	return mesh, text, lambda printed: 1e3 * np.linalg.norm([row[1:3] for row in printed['displacements'][-1]], axis=1).mean() / s.inner


def consolidation(size, kind):
	"""By analogy: heat is conducted in a rod as the excess pressure is in a column; the rod does not deform."""
	s, order = Consolidation(size), kinds[kind]
	mesh = meshes.Mesh(order)
	mesh.block('soil', order, size, lambda i, j: (i * s.h, j * s.h))
	thermal = f'*CONDUCTIVITY\n{s.mobility:.9g}\n*SPECIFIC HEAT\n{1 / s.young:.9g}\n*DENSITY\n1.\n'
	text = model(mesh, kind, dict(soil=thermal)) + nodeSet('TOP', mesh.where(lambda x, y: y > 1 - 1e-9)) + nodeSet('SIDE', mesh.where(lambda x, y: x < 1e-9))
	text += f'*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, {s.load:.9g}\n'
	drained = '*BOUNDARY\nTOP, 11, 11, 0.\n*NODE PRINT, NSET=SIDE\nNT\n'
	for length in np.diff(s.times, prepend=0): text += f'*STEP\n*HEAT TRANSFER, DIRECT\n{length:.9g}, {length:.9g}\n{drained}*END STEP\n'
	heights = np.array([y for _, y in mesh.nodes])

	def result(printed):
		rows = printed['temperatures'][-1]
		return 1 - meshes.meanOfLine([heights[int(row[0]) - 1] for row in rows], [row[1] for row in rows], 1) / s.load

	return mesh, text, result


def beam(size, kind):
	"""Beam elements have nodes of their own, which equations tie to those of the surface."""
	mesh, s = meshes.beam(size, kinds[kind]), Beam(size)
	top = sorted(mesh.where(lambda x, y: y > -1e-9), key=lambda n: mesh.nodes[n][0])
	first = len(mesh.nodes)
	own = [first + i for i in range(len(top))]
	thick = np.sqrt(12 * s.bending / s.axial)
	text = model(mesh, kind, dict(ground=elastic(s))) + '*NODE, NSET=NBEAM\n' + ''.join(f'{n + 1}, {mesh.nodes[t][0]:.12g}, 0, 0\n' for n, t in zip(own, top))
	step = kinds[kind]
	text += f"*ELEMENT, TYPE={'B32' if step == 2 else 'B31'}, ELSET=EBEAM\n"
	for number, i in enumerate(range(0, len(own) - 1, step)): text += f"{len(mesh.elements) + number + 1}, {', '.join(str(n + 1) for n in own[i:i + step + 1])}\n"
	text += f'*MATERIAL, NAME=MBEAM\n*ELASTIC\n{s.axial / thick:.9g}, 0.\n*BEAM SECTION, ELSET=EBEAM, MATERIAL=MBEAM, SECTION=RECT\n1., {thick:.9g}\n0., 0., 1.\n'
	for n, t in zip(own, top):
		for direction in (1, 2): text += f'*EQUATION\n2\n{t + 1}, {direction}, 1., {n + 1}, {direction}, -1.\n'
	text += nodeSet('BASE', mesh.where(lambda x, y: y < 1e-9 - s.depth)) + nodeSet('SIDES', mesh.where(lambda x, y: y < -1e-9 and (x < 1e-9 or x > s.length - 1e-9))) + nodeSet('ENDS', [own[0], own[-1]])
	text += fixed('BASE', 1, 2) + fixed('SIDES', 1) + fixed('ENDS', 1, 6) + fixed('NBEAM', 3, 4, 5)
	text += staticStep(1, f'*CLOAD\n{own[0] + 1}, 2, {-s.force / 2:.9g}\n*NODE PRINT, NSET=ENDS\nU\n')

	def result(printed):
		found = {int(row[0]): row[2] for row in printed['displacements'][-1]}
		return 1e3 * (found[own[-1] + 1] - found[own[0] + 1])

	return mesh, text, result


def embankment(size, kind):
	mesh, s = meshes.embankment(size, kinds[kind]), Embankment(size)
	lifts = [f'LIFT{n}' for n in range(s.lifts)]
	materials = {block: elastic(s, '*DENSITY\n1.\n') for block in mesh.blocks}
	surface = mesh.where(lambda x, y: abs(y) < 1e-9 and x < s.crest + 1e-9)
	text = model(mesh, kind, materials) + nodeSet('SURFACE', surface) + nodeSet('BASE', mesh.where(lambda x, y: y < 1e-9 - s.depth))
	text += nodeSet('SIDES', mesh.where(lambda x, y: x < 1e-9 or x > s.width - 1e-9)) + fixed('BASE', 1, 2) + fixed('SIDES', 1)
	text += staticStep(1, '', ', NLGEOM')  # elements in the plane cannot be removed in a first step, nor added without stress in a linear one
	for n, lift in enumerate(lifts):
		change = '*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n' + '\n'.join(lifts[1:]) if n == 0 else f'*MODEL CHANGE, TYPE=ELEMENT, ADD=STRAINFREE\n{lift}'
		text += staticStep(1, f'{change}\n*DLOAD\n{lift}, GRAV, {s.weight:.9g}, 0., -1., 0.\n*NODE PRINT, NSET=SURFACE\nU\n', ', NLGEOM')
	across = {n + 1: mesh.nodes[n][0] for n in surface}

	def result(printed):
		rows = printed['displacements'][-1]
		return -1e3 * meshes.meanOfLine([across[int(row[0])] for row in rows], [row[2] for row in rows], s.crest)

	return mesh, text, result


def read(text):
	"""Printed tables by name: rows of numbers of each."""
	found, rows = {}, []
	for line in text.splitlines():
		words = line.split()
		if words and not re.match(r'-?\d', words[0]):
			rows = []
			found.setdefault(' '.join(words).split(' (')[0].split(' for set')[0], []).append(rows)
		elif words: rows.append([float(word) for word in words])
	return found


def run(scene, size, kind, folder):
	"""Value, unknowns and seconds of the program; 'why' if it fails."""
	mesh, text, result = globals()[scene](size, kind)
	with open(os.path.join(folder, 'deck.inp'), 'w') as file:
		file.write(text)
	begin = time.time()
	ended = subprocess.run([program, 'deck'], cwd=folder, capture_output=True, text=True, env=os.environ | dict(OMP_NUM_THREADS='1'))
	seconds = time.time() - begin
	said = [line.strip() for line in ended.stdout.splitlines() if '*ERROR' in line or '*WARNING' in line]
	path = os.path.join(folder, 'deck.dat')
	if ended.returncode or not os.path.exists(path) or any('*ERROR' in line for line in said): return dict(why='; '.join(said[:3]) or f'exit code {ended.returncode}')
	with open(path) as file:
		printed = read(file.read())
	return dict(value=result(printed), unknowns=(1 if scene == 'consolidation' else 2) * len(mesh.nodes), seconds=seconds)
