#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# meshio 5.0.0 (Debian 12) and files of Abaqus and CalculiX (.inp): quadrilaterals in the plane, which ground in plane strain is meshed with.
# Expected: a quadrilateral is written as an element of continua or shells (CPS4, CPE4 or S4), and elements CPE4 of plane strain are read as quadrilaterals.
# Seen: it is written as CAX4P, an axisymmetric element with pore pressure, one of 8 nodes as a thin shell, S8R5. CPE4 is not read: the reader leaves Python (SystemExit). CPS4 is read.
. "$(dirname "$(realpath "$0")")/packages.inc"
take python3-meshio=7.0.0-3 python3-rich python3-commonmark python3-pygments python3-lxml
/usr/bin/python3 - <<'SCRIPT' || changed 'quadrilaterals are written or read otherwise'
import sys
import numpy as np
import meshio
def lineOf(kind, nodes):
	meshio.Mesh(np.random.rand(nodes, 3), [(kind, np.arange(nodes)[None])]).write('one.inp')
	with open('one.inp') as file: return next(line.strip() for line in file if line.startswith('*ELEMENT'))
def canRead(kind):
	with open('two.inp', 'w') as file: file.write(f'*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n*ELEMENT, TYPE={kind}\n1, 1, 2, 3, 4\n')
	try: return meshio.read('two.inp').cells[0].type == 'quad'
	except SystemExit: return False
found = lineOf('quad', 4), lineOf('quad8', 8), canRead('CPE4'), canRead('CPS4')
print(f'meshio {meshio.__version__}: written as "{found[0]}" and "{found[1]}"; CPE4 is read: {found[2]}, CPS4 is read: {found[3]}')
sys.exit(found != ('*ELEMENT, TYPE=CAX4P', '*ELEMENT, TYPE=S8R5', False, True))
SCRIPT
