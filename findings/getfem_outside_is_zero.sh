#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# GetFEM 5.4.2: the field x on the unit square, interpolated at points on its edge and a nanometre beyond it.
# Expected: an exception, or NaN, or the value of the nearest point, 1, as round-off puts points of a surface there.
# Seen: 0 without an exception. A settlement read at a surface is zero, and a warning goes to standard error alone.
. "$(dirname "$(realpath "$0")")/packages.inc"
take python3-getfem=5.4.2+dfsg1-3+b1
/usr/bin/python3 - <<'SCRIPT' || changed 'a point outside does not get 0'
import sys
import getfem
import numpy as np
mesh = getfem.Mesh('cartesian', np.linspace(0, 1, 5), np.linspace(0, 1, 5))
field = getfem.MeshFem(mesh, 1)
field.set_fem(getfem.Fem('FEM_QK(2, 1)'))
at = lambda x: float(np.ravel(getfem.compute_interpolate_on(field, field.basic_dof_nodes()[0], np.array([[x], [0.5]])))[0])
print(f'at x = 1: {at(1.)}, at x = 1 + 1e-9: {at(1 + 1e-9)}')
sys.exit(abs(at(1.) - 1) > 1e-9 or at(1 + 1e-9) != 0)
SCRIPT
