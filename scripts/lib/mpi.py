# SPDX-License-Identifier: GPL-2.0-or-later
"""Several processes by OpenMPI's mpirun, on a machine that need not have so many processors (scripts/run does it in its own way)."""

# A process that waits without making room keeps waiting, on a busy machine, for those that it keeps from working.
makingRoom = dict(OMPI_MCA_mpi_yield_when_idle='1')


def byMpi(processes):
	"""Words before a command that is to run in so many processes; nothing for one."""
	return ['mpirun', '--allow-run-as-root', '--oversubscribe', '--bind-to', 'none', '-n', str(processes)] if processes > 1 else []
