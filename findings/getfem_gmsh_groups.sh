#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# GetFEM 5.4.2 and Gmsh 4.8.4: a rectangle with the physical groups 11 (its base) and 12 (its soil), saved in the formats msh 2.2, 4.0 and 4.1.
# Expected: GetFEM makes the regions 11 and 12 of them from each.
# Seen: from msh 2.2 it does. From 4.0 and 4.1, the present default of Gmsh, it takes the numbers of the geometry, here 1 for the curve and 1 for the surface, one of which it changes.
. "$(dirname "$(realpath "$0")")/packages.inc"
take python3-getfem=5.4.2+dfsg1-3+b1 gmsh=4.8.4+ds2-3
cat > ground.geo <<'GEOMETRY'
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("base", 11) = {1}; Physical Surface("soil", 12) = {1};
GEOMETRY
for format in msh2 msh40 msh41; do gmsh -2 -format $format -o ground.$format ground.geo > log; done
/usr/bin/python3 - <<'SCRIPT' || changed 'regions have other numbers'
import sys
import getfem
getfem.util('trace level', 0)
getfem.util('warning level', 0)
found = [[int(number) for number in getfem.Mesh('import', 'gmsh', f'ground.{format}').regions()] for format in ('msh2', 'msh40', 'msh41')]
print('regions from msh 2.2, 4.0, 4.1:', found, '; expected [11, 12] of each')
sys.exit(found[0] != [11, 12] or any({11, 12} & set(numbers) for numbers in found[1:]))
SCRIPT
