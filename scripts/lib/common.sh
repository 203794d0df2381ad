# SPDX-License-Identifier: GPL-2.0-or-later
# shellcheck shell=bash disable=SC2034 # variables are for the scripts that read this
# Read by the scripts of the folder above.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build
overlay=$build/overlay
forUser=no # option --user
docsPackages=(python3-sphinx python3-myst-parser libjs-mathjax)
pdfPackages=(latexmk texlive-xetex texlive-latex-extra texlive-fonts-recommended fonts-freefont-otf tex-gyre)

fail() {
	echo "${0##*/}: $*" >&2
	exit 1
}

debianYade=/usr/lib/x86_64-linux-gnu/yade-double

# Sets $systemYade to the folder of libyade.so, $yadePrefix to the one that it is installed in, $systemCommand to the
# command: those of the variable YADE_DIR, of the command yade of PATH where that is none of Debian's package, or of the
# package.
findYade() {
	systemYade=${YADE_DIR:-$(besideCommandOfPath)}
	systemYade=${systemYade:-$debianYade}
	yadePrefix=/usr
	systemCommand=/usr/bin/yade
	[ "$systemYade" != $debianYade ] || return 0
	[ -e "$systemYade/libyade.so" ] || fail "YADE_DIR = $systemYade has no libyade.so; it is a folder such as <prefix>/lib/x86_64-linux-gnu/yade-<version>"
	systemYade=$(realpath "$systemYade")
	yadePrefix=${systemYade%/lib/*}
	systemCommand=$yadePrefix/bin/${systemYade##*/} # yade and its suffix
	[ -x "$systemCommand" ] || fail "the command $systemCommand is missing, which belongs to YADE_DIR = $systemYade"
}

# The folder of libyade.so that belongs to the command yade of PATH; nothing if that is of Debian's package, or of an
# overlay.
besideCommandOfPath() {
	local command prefix
	command=$(type -P yade) || return 0
	prefix=$(dirname "$(dirname "$(realpath "$command")")")
	[ "$prefix" != /usr ] && [ ! -e "$prefix/host" ] || return 0
	find "$prefix/lib" -name libyade.so -printf '%h\n' -quit
}

# the comment at the head of the calling script, from its usage line on
printHelp() {
	sed -n '/^# usage:/,/^$/ { s/^# \?//; p }' "$0"
}

# Sets $mode to where the plugin goes: `system`, or `user` on request or without the right to write to YADE's folder.
chooseMode() {
	findYade
	mode=system
	if [ "$forUser" = yes ] || { [ "$(id -u)" != 0 ] && [ ! -w "$systemYade" ]; }; then mode=user; fi
	yade=$systemCommand
	if [ "$mode" = user ]; then yade=$overlay/bin/yade; fi
}

isInstalled() {
	dpkg-query --show --showformat '${db:Status-Status}' "$1" 2>/dev/null | grep -q '^installed'
}

# apt-get as root, which waits while another one is at work. Its option for that, DPkg::Lock::Timeout, is for one of its
# three locks only.
aptGet() {
	local asRoot=() said='' waiting=no deadline=$((SECONDS + 1200))
	[ "$(id -u)" = 0 ] || asRoot=(sudo)
	until said=$("${asRoot[@]}" env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get -q "$@" 2>&1 >&3); do
		[[ $said = *'Could not get lock'* ]] && [ $SECONDS -lt $deadline ] || fail "apt-get $1: $said"
		[ $waiting = yes ] || echo "Waiting for another program that installs packages. ${said%%$'\n'*}"
		waiting=yes
		sleep 2
	done 3>&1
	[ -z "$said" ] || echo "$said" >&2
}

# Installs those of the given Debian packages that are missing, as root or through sudo.
installPackages() {
	local installed missing
	installed=$(dpkg-query --show --showformat '${db:Status-Status} ${binary:Package}\n' | sed -n 's/^installed \([^:]*\).*/\1/p')
	missing=$(comm -23 <(printf '%s\n' "$@" | sort) <(sort <<<"$installed") | tr '\n' ' ')
	[ -n "$missing" ] || return 0
	[ "$(id -u)" = 0 ] || command -v sudo >/dev/null || fail "these Debian packages are missing, and only root can install them: $missing"
	echo "Installing packages: $missing"
	aptGet update
	# shellcheck disable=SC2086 # a list of words
	aptGet install -y --no-install-recommends $missing
}
