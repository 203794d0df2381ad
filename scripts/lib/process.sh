#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# usage: scripts/lib/process.sh <folder> <command> ...
#
# One of several processes that scripts/run -n has mpirun start: the first one speaks, and the others write their errors
# to the folder.

said=$1/$OMPI_COMM_WORLD_RANK
shift
[ "$OMPI_COMM_WORLD_RANK" = 0 ] || exec "$@" >/dev/null 2>"$said"
exec "$@" 2> >(tee "$said" >&2)
