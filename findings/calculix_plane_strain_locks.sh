#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# CalculiX 2.20: a cantilever of 8 m x 1 m in plane strain, Poisson's ratio 0.4999, 32 x 4 elements, under a force at its tip.
# Expected: CPE4 and C3D8 integrate the volumetric strain selectively, as the elements of these names do in Abaqus, and give 80 % of Timoshenko's deflection at least.
# Seen: both are integrated fully and give 3 %; C3D8I and CPE4R give 97 % and 104 %. Undrained soil is too strong by as much, and no message says so.
. "$(dirname "$(realpath "$0")")/packages.inc"
take calculix-ccx=2.20-1
cat > deck.py <<'DECK'
import subprocess, sys
import numpy as np
columns, rows, L, H, E, nu = 32, 4, 8., 1., 1e6, 0.4999
exact = L**3 / 3 / (E / (1 - nu**2) / 12) + 1.2 * L / (E / 2 / (1 + nu))
def part(kind):
	solid = kind.startswith('C3D')
	number = {(i, j, k): n for n, (k, j, i) in enumerate(np.ndindex(1 + solid, rows + 1, columns + 1), 1)}
	text = '*NODE, NSET=ALL\n' + ''.join(f'{n}, {L * i / columns}, {H * j / rows}, {k}.\n' for (i, j, k), n in number.items()) + f'*ELEMENT, TYPE={kind}, ELSET=BEAM\n'
	for e, (j, i) in enumerate(np.ndindex(rows, columns), 1):
		text += f'{e}, ' + ', '.join(str(number[i + di, j + dj, k]) for k in range(1 + solid) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))) + '\n'
	tip = [n for (i, j, k), n in number.items() if i == columns]
	for name, nodes in ('ROOT', [n for (i, j, k), n in number.items() if i == 0]), ('TIP', tip): text += f'*NSET, NSET={name}\n' + ''.join(f'{n},\n' for n in nodes)
	text += f'*MATERIAL, NAME=M\n*ELASTIC\n{E}, {nu}\n*SOLID SECTION, ELSET=BEAM, MATERIAL=M\n*BOUNDARY\nROOT, 1, 2\n' + 'ALL, 3\n' * solid
	text += f'*STEP\n*STATIC\n*CLOAD\nTIP, 2, {-1 / len(tip)}\n*NODE PRINT, NSET=TIP\nU\n*END STEP\n'
	with open('beam.inp', 'w') as file: file.write(text)
	subprocess.run(['ccx', 'beam'], check=True, stdout=subprocess.DEVNULL)
	with open('beam.dat') as file: found = [float(line.split()[2]) for line in file if len(line.split()) == 4 and line.split()[0].isdigit()]
	return -np.mean(found) / exact
parts = {kind: part(kind) for kind in ('CPE4', 'C3D8', 'C3D8I', 'CPE4R')}
print('deflection over that of Timoshenko:', {kind: round(float(value), 3) for kind, value in parts.items()}, '; expected at least 0.8 of CPE4 and C3D8')
sys.exit(not (max(parts['CPE4'], parts['C3D8']) < 0.1 and 0.9 < min(parts['C3D8I'], parts['CPE4R'])))
DECK
/usr/bin/python3 deck.py || changed 'CPE4 or C3D8 does not lock'
