#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# GetFEM 5.4.2: Newton's method of a model with one iteration, which is too few for its nonlinear term.
# Expected: Model.solve raises an exception, as it does for wrong input.
# Seen: it prints nothing, leaves the last iterate in the variable and returns (iterations, 0); the 0 is all that says that it has not converged.
. "$(dirname "$(realpath "$0")")/packages.inc"
take python3-getfem=5.4.2+dfsg1-3+b1
/usr/bin/python3 - <<'SCRIPT' || changed 'a model that has not converged says so'
import sys
import getfem
import numpy as np
getfem.util('trace level', 0)
mesh = getfem.Mesh('cartesian', np.linspace(0, 1, 5), np.linspace(0, 1, 5))
field = getfem.MeshFem(mesh, 1)
field.set_fem(getfem.Fem('FEM_QK(2, 1)'))
model, integration = getfem.Model('real'), getfem.MeshIm(mesh, getfem.Integ('IM_GAUSS_PARALLELEPIPED(2, 3)'))
model.add_fem_variable('u', field)
model.add_nonlinear_term(integration, 'Grad_u . Grad_Test_u + exp(10 * u) * Test_u - 100 * Test_u')
try: returned = model.solve('max_iter', 1, 'max_res', 1e-10)
except Exception as error: sys.exit(f'raised {error}')
print(f'returned {returned}; largest value {np.abs(model.variable("u")).max():.4g}, of the solution ln(100) / 10 = {np.log(100) / 10:.4g}')
sys.exit(returned[1] != 0)
SCRIPT
