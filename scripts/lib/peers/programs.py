# SPDX-License-Identifier: GPL-2.0-or-later
"""The programs: their Debian packages, the elements that each has, and how one of their cases is run. Needs nothing of YADE."""
import json
import os
import subprocess
import sys

from . import by_calculix, by_fenics, by_getfem
from .scenes import scenes

programs = dict(CalculiX=by_calculix, GetFEM=by_getfem, FEniCS=by_fenics)
library = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ours = {'cells': False, 'cells, F-bar': True}


def version(name):
	"""Version of the Debian package of a program; empty if it is not installed."""
	try:
		shown = subprocess.run(['dpkg-query', '-W', '-f', '${Status} ${Version}', programs[name].package], capture_output=True, text=True).stdout
	except FileNotFoundError:
		return ''
	return shown.split()[-1] if shown.startswith('install ok installed') else ''


def cases(name, scene):
	"""Kinds of elements and sizes of a scene that a program can do."""
	module = programs[name]
	return [(kind, size) for kind in module.kinds if (scene, kind) not in module.lacking for size in scenes[scene].sizes]


def lacking(name):
	"""Reasons why a program does not do some scenes."""
	found = {}
	for (scene, kind), why in programs[name].lacking.items(): found.setdefault((scene, why), []).append(kind)
	whole = lambda kinds: '' if len(kinds) == len(programs[name].kinds) else f" with {' and '.join(kinds)}"
	return '; '.join(f'{scene}{whole(kinds)}: {why}' for (scene, why), kinds in found.items())


def run(name, scene, size, kind, limit):
	"""Value, unknowns and seconds of a case in a process of its own, on one thread; otherwise 'why'."""
	environment = os.environ | dict(PYTHONPATH=library, OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1')
	command = [sys.executable, os.path.join(library, 'peers', 'case.py'), programs[name].__name__.rpartition('.')[2], scene, str(size), kind]
	try:
		ended = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=limit)
	except subprocess.TimeoutExpired:
		return dict(why='timeout')
	try:
		return json.loads(ended.stdout.strip().splitlines()[-1])
	except (IndexError, ValueError):
		return dict(why=f'exit code {ended.returncode}')
