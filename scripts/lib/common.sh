# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2034 # variables are for the scripts that read this
# Read by the scripts of the folder above.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build
systemYade=/usr/lib/x86_64-linux-gnu/yade-double # of Debian's package
overlay=$build/overlay
forUser=no # option --user

fail() {
	echo "${0##*/}: $*" >&2
	exit 1
}

# the comment at the head of the calling script, from its usage line on
printHelp() {
	sed -n '/^# usage:/,/^$/ { s/^# \?//; p }' "$0"
}

# Sets $mode to where the plugin goes: `system`, or `user` on request or without the right to write to YADE's folder.
chooseMode() {
	mode=system
	if [ "$forUser" = yes ] || [ "$(id -u)" != 0 ]; then mode=user; fi
	yade=/usr/bin/yade
	if [ "$mode" = user ]; then yade=$overlay/bin/yade; fi
}
