#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE with the material point plugin, for one user: the system's yade, made to look for libraries in this overlay.

Installed by scripts/setup as bin/yade of the overlay, with the path of the system's yade in the file `host`.
"""
import importlib.machinery
import os
import sys

_overlay = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
os.environ['YADE_PREFIX'] = _overlay
os.environ.setdefault('GOMP_SPINCOUNT', '10000')  # same value as in scripts/run


class _OverlayFinder:
	"""Finds yade.mpm in the overlay; the package yade itself is the system's."""

	@staticmethod
	def find_spec(name, path=None, target=None):
		if name == 'yade.mpm':
			return importlib.machinery.PathFinder.find_spec(name, [os.path.join(_overlay, 'python')], target)


sys.meta_path.insert(0, _OverlayFinder)
with open(os.path.join(_overlay, 'host')) as _host:
	_command = _host.read().strip()
with open(_command) as _yade:
	exec(compile(_yade.read(), _yade.name, 'exec'))
