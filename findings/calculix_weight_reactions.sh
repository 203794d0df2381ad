#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# CalculiX 2.20: a column of soil of 10 m under its weight (*DLOAD, GRAV), 5, 10 and 20 elements (C3D8), its base constrained.
# Expected: the printed reaction of the base (*NODE PRINT, RF, TOTALS=ONLY) is the weight, as in Abaqus and as it is under a pressure on top.
# Seen: it lacks the part of the weight that falls on the constrained nodes, half an element: 90, 95 and 97.5 % of it. The stresses bear all, and a check of equilibrium by RF fails without a message.
. "$(dirname "$(realpath "$0")")/packages.inc"
take calculix-ccx=2.20-1
cat > deck.py <<'DECK'
import subprocess, sys
corners = (0, 0), (1, 0), (1, 1), (0, 1)
def part(elements, load):
	number = {(i, j, k): 4 * k + n for k in range(elements + 1) for n, (i, j) in enumerate(corners, 1)}
	text = '*NODE, NSET=ALL\n' + ''.join(f'{n}, {i}., {j}., {10 * k / elements}\n' for (i, j, k), n in number.items()) + '*ELEMENT, TYPE=C3D8, ELSET=SOIL\n'
	text += ''.join(f'{k + 1}, ' + ', '.join(str(number[i, j, k + up]) for up in (0, 1) for i, j in corners) + '\n' for k in range(elements))
	text += '*NSET, NSET=BASE\n1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC\n1e7, 0.\n*DENSITY\n2000.\n*SOLID SECTION, ELSET=SOIL, MATERIAL=M\n*BOUNDARY\nALL, 1, 2\nBASE, 3\n'
	load = 'SOIL, GRAV, 10., 0., 0., -1.' if load == 'weight' else f'{elements}, P2, 200000.'
	with open('column.inp', 'w') as file: file.write(text + f'*STEP\n*STATIC\n*DLOAD\n{load}\n*NODE PRINT, NSET=BASE, TOTALS=ONLY\nRF\n*END STEP\n')
	subprocess.run(['ccx', 'column'], check=True, stdout=subprocess.DEVNULL)
	with open('column.dat') as file: found = [line.split() for line in file]
	return round(float(next(words[2] for words in found if len(words) == 3 and words[0][0] in '-0123456789')) / 200000, 6)
parts = {load: [part(elements, load) for elements in (5, 10, 20)] for load in ('weight', 'pressure')}
print('reaction over the load, with 5, 10 and 20 elements:', parts, '; expected 1')
sys.exit(parts != dict(weight=[0.9, 0.95, 0.975], pressure=[1., 1., 1.]))
DECK
/usr/bin/python3 deck.py || changed 'the reaction of the base has another part of the weight'
