# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE starts with the plugin if everything fits, and otherwise without it and with one sentence that says why."""
import shutil
import subprocess
import time

import pytest
from conftest import build, compiled, root

# Prints whether YADE works and knows the plugin's classes.
probe = '''
import json, yade.wrapper
O.engines = [ForceResetter(), NewtonIntegrator()]
O.bodies.append(sphere((0, 0, 0), 1))
O.dt = 1
O.run(2, wait=True)
print(json.dumps({'iterations': O.iter, 'knowsPlugin': hasattr(yade.wrapper, 'MpmGrid')}))
'''
withoutPlugin = {'iterations': 2, 'knowsPlugin': False}


@pytest.fixture
def complete(libraries):
	shutil.copy(build / 'mpm/mpm_engine.so', libraries / 'mpm')


def explanation(run):
	"""The loader's sentence: exactly one."""
	lines = [line for line in run.stderr.splitlines() if line.startswith('Material point plugin not loaded: ')]
	assert len(lines) == 1, str(run)
	return lines[0]


def test_completePluginIsLoaded(yade, complete):
	run = yade(probe)
	assert run.result == {'iterations': 2, 'knowsPlugin': True}
	assert 'Material point plugin' not in run.stderr


def test_missingEngineFile(yade, libraries):
	run = yade(probe)
	assert run.result == withoutPlugin
	assert 'mpm/mpm_engine.so is missing' in explanation(run)


@pytest.mark.parametrize('part', [0, 1000, -1])
def test_engineFileCutOff(yade, libraries, part):
	complete = (build / 'mpm/mpm_engine.so').read_bytes()
	(libraries / 'mpm/mpm_engine.so').write_bytes(complete[:part])
	run = yade(probe)
	assert run.result == withoutPlugin
	assert 'mpm/mpm_engine.so is incomplete' in explanation(run)


def test_engineFileIsNoLibrary(yade, libraries):
	(libraries / 'mpm/mpm_engine.so').write_bytes(bytes(1000))
	run = yade(probe)
	assert run.result == withoutPlugin
	assert 'mpm/mpm_engine.so: invalid ELF header' in explanation(run)


def test_unresolvedSymbol(yade, libraries):
	compiled('void nowhereDefined(); struct Caller { Caller() { nowhereDefined(); } } caller;', libraries / 'mpm/mpm_engine.so')
	run = yade(probe)
	assert run.result == withoutPlugin
	assert 'undefined symbol: _Z14nowhereDefinedv' in explanation(run)


def test_otherVersionOfYade(yade, complete):
	(yade.folder / 'other_version.py').write_text('''
import importlib.util, os, sys
path = os.path.join([p for p in sys.path if p.endswith('yade-double/py')][0], 'yade/config.py')
spec = importlib.util.spec_from_file_location('yade.config', path)
config = sys.modules['yade.config'] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(config)
config.version = '2024.01a'
''')
	run = yade(probe, options=['-L', 'other_version'])
	assert run.result == withoutPlugin
	assert 'made for YADE 2023.02a, and this is YADE 2024.01a' in explanation(run)


def test_otherSizes(yade, complete):
	"""A YADE whose objects are larger is imitated by a larger answer to the question for their size."""
	larger = compiled(
	        '''
#include <dlfcn.h>
#include <cstddef>
extern "C" size_t malloc_usable_size(void* p) { return reinterpret_cast<size_t (*)(void*)>(dlsym(RTLD_NEXT, "malloc_usable_size"))(p) + 16; }
''', yade.folder / 'larger.so'
	)
	run = yade(probe, environment={'LD_PRELOAD': str(larger)})
	assert run.result == withoutPlugin
	assert 'differs in size of Scene, size of Body' in explanation(run)


def test_otherPlaceOfAttribute(yade, complete):
	"""A YADE that keeps an attribute elsewhere is imitated by one that does not store it."""
	elsewhere = compiled(
	        '''
#include <string>
namespace boost::python::api { class object; }
namespace yade { struct Scene { void pySetAttr(const std::string&, const boost::python::api::object&); }; }
void yade::Scene::pySetAttr(const std::string&, const boost::python::api::object&) { }
''', yade.folder / 'elsewhere.so'
	)
	run = yade(probe, environment={'LD_PRELOAD': str(elsewhere)})
	assert run.result == withoutPlugin
	assert 'differs in Scene.dt, Scene.iter' in explanation(run)


# The rest can be checked only after YADE has started, by `from yade import mpm`.
importing = '''
try:
	from yade import mpm
except ImportError as error:
	print(error)
'''


@pytest.fixture
def importable(complete, yade):
	"""Makes yade.mpm importable without installing it."""
	shutil.copytree(root / 'plugin/python', yade.folder / 'prefix/python')
	(yade.folder / 'prefix/bin').mkdir()
	yade.command = str(shutil.copy(root / 'scripts/lib/yade-in-overlay.py', yade.folder / 'prefix/bin/yade'))


def test_otherPlaceOfForces(yade, importable):
	nowhere = compiled(
	        '''
extern "C" void nowhere(void*, int, const void*) asm("_ZN4yade14ForceContainer8addForceEiRKN5Eigen6MatrixIdLi3ELi1ELi0ELi3ELi1EEE");
void nowhere(void*, int, const void*) { }
''', yade.folder / 'nowhere.so'
	)
	assert 'differs from the one that the plugin is made for, in: ForceContainer' in yade(importing, environment={'LD_PRELOAD': str(nowhere)}).stdout


def test_classThatYadeCannotRegister(yade, importable):
	"""YADE goes on without a word if a class refuses registration."""
	refusing = compiled(
	        '''
#include <stdexcept>
#include <string>
namespace yade { struct Serializable { void checkPyClassRegistersItself(const std::string&) const; }; }
void yade::Serializable::checkPyClassRegistersItself(const std::string& name) const { if (name == "MpmGrid") throw std::runtime_error(name); }
''', yade.folder / 'refusing.so'
	)
	run = yade(importing, environment={'LD_PRELOAD': str(refusing)})
	assert 'could not register these classes of the plugin: MpmGrid' in run.stdout


def test_importWithoutPlugin(yade, libraries):
	shutil.copytree(root / 'plugin/python', yade.folder / 'prefix/python')
	run = yade("import sys; sys.path.insert(0, 'prefix/python'); import mpm", fails=True)
	assert 'ImportError: yade.mpm: YADE has not loaded the plugin' in run.stderr


@pytest.mark.parametrize('importsFirst', [True, False])
def test_pluginInstalledAnewUnderARunningYade(yade, importable, libraries, importsFirst):
	"""It goes on with what it has opened, as if nothing had happened, or says that it cannot."""
	setup = (root / 'scripts/setup').read_text()
	replace = setup[setup.index('replace() {'):setup.index('# installInto')]
	other = yade.folder / 'other.so'
	other.write_bytes((build / 'mpm/mpm_engine.so').read_bytes() + b'newer')
	yade(
	        f'''
import subprocess
if {importsFirst}:
	from scenes import slope, mpm
	solver = slope()
	O.run(5)
subprocess.run(['bash', '-c', {replace!r} + 'replace {other} {libraries}/mpm/mpm_engine.so; replace {other} {libraries}/libpkg_mpm.so'], check=True)
if {importsFirst}:
	O.wait()
	O.run(5, wait=True)
	assert O.iter == 10 and solver.report()['converged'] and len(mpm.arrays()['id']) == 1095
	O.saveTmp()
	O.loadTmp()
	O.step()
else:
	MpmGrid(cellSize=1)
	try:
		from yade import mpm
		assert False
	except ImportError as error:
		assert 'start YADE again' in str(error), error
'''
	)


def test_overlayForOneUser(yade):
	"""What scripts/setup installs without the rights of root."""
	subprocess.run([root / 'scripts/setup', '--user'], check=True)
	yade.command = str(build / 'overlay/bin/yade')
	run = yade('from yade import mpm, config; import json; print(json.dumps([mpm.__file__, config.libDir, str(MpmGrid)]))')
	file, folder, grid = run.result
	assert file == str(build / 'overlay/python/mpm/__init__.py')
	assert folder == str(build / 'overlay/lib/x86_64-linux-gnu/yade-double')
	assert grid == "<class 'yade.wrapper.MpmGrid'>"


def test_setupThatChangesNothingIsQuick(yade):
	subprocess.run([root / 'scripts/setup', '--user'], check=True)
	start = time.monotonic()
	second = subprocess.run([root / 'scripts/setup', '--user'], check=True, capture_output=True, text=True)
	assert time.monotonic() - start < 2
	assert second.stdout == ''
