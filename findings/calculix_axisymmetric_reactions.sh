#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# CalculiX 2.20: a ring of axisymmetric elements (CAX4) under a force of 180 kN.
# Expected: a force on a node (*CLOAD) and the printed reaction (*NODE PRINT, RF) are both of the whole circle, as are those of Abaqus, and balance: 180 kN.
# Seen: the force is of the whole circle, the reaction of a wedge of 2 degrees: 1 kN. A load by pressure gives the same reaction as its part of the circle.
. "$(dirname "$(realpath "$0")")/packages.inc"
take calculix-ccx=2.20-1
cat > ring.inp <<'DECK'
*NODE, NSET=ALL
1, 1., 0.
2, 2., 0.
3, 2., 1.
4, 1., 1.
*ELEMENT, TYPE=CAX4, ELSET=RING
1, 1, 2, 3, 4
*MATERIAL, NAME=M
*ELASTIC
1e7, 0.
*SOLID SECTION, ELSET=RING, MATERIAL=M
*NSET, NSET=BASE
1, 2
*BOUNDARY
BASE, 2
*STEP
*STATIC
*CLOAD
3, 2, -9e4
4, 2, -9e4
*NODE PRINT, NSET=BASE, TOTALS=ONLY
RF
*END STEP
DECK
ccx ring > log
reaction=$(awk '/total force/ { getline; getline; print $2 }' ring.dat)
echo "force 180000 N, expected reaction 180000 N, printed $reaction N"
awk -v r="$reaction" 'BEGIN { exit !(r > 990 && r < 1010) }' || changed 'the printed reaction is not that of 2 degrees'
