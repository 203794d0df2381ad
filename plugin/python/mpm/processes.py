# SPDX-License-Identifier: GPL-2.0-or-later
"""Under mpirun, mpi4py begins MPI before algebraic multigrid can, and so ends it, however the script ends."""
import os

if 'OMPI_COMM_WORLD_RANK' in os.environ: import mpi4py.MPI
