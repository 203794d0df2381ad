# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugin's library: what mpm does with all material points at once, in C++."""
import importlib.machinery
import importlib.util
import os

from yade import config, wrapper


def _loadEngine():
	"""The plugin's library, which is a Python module too; ImportError if YADE has not accepted it or does not fit it."""
	if not hasattr(wrapper, 'MpmPoint'):
		raise ImportError('yade.mpm: YADE has not loaded the plugin; what it printed at the start says why, or libpkg_mpm.so is not in ' + config.libDir)
	name = 'mpm_engine'
	path = os.path.join(config.libDir, 'mpm', name + '.so')
	_requireTheOneInUse(path)
	loader = importlib.machinery.ExtensionFileLoader(name, path)
	module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
	loader.exec_module(module)
	module.verify()
	return module


def _requireTheOneInUse(path):
	"""ImportError if the file has been replaced since YADE opened it: a second library beside the first would have objects of its own."""
	former = os.path.realpath(path) + ' (deleted)\n'
	with open('/proc/self/maps') as maps:
		replaced = any(line.endswith(former) for line in maps)
	if replaced:
		raise ImportError(f'yade.mpm: {path} has been installed anew since this YADE started; start YADE again')


engine = _loadEngine()
