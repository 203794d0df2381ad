# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE starts with the plugin if everything fits, and otherwise without it and with one sentence that says why."""
import fcntl
import os
import re
import resource
import shutil
import subprocess

import pytest
from conftest import build, compiled, provideCommand, root, systemYade

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


def test_loaderNeedsTheCLibraryOnly():
	dynamic = subprocess.run(['readelf', '--dynamic', build / 'libpkg_mpm.so'], check=True, capture_output=True, text=True).stdout
	assert re.findall(r'\(NEEDED\).*\[(.*)\]', dynamic) == ['libc.so.6']


def boostPython():
	"""The one that YADE is linked with."""
	linked = subprocess.run(['ldd', systemYade / 'libpkg_common.so'], check=True, capture_output=True, text=True).stdout
	return re.search(r'libboost_python\S+', linked)[0]


@pytest.mark.parametrize('built', ['libboost_python39.so.1.67.0', 'libboost_python399.so.1.199.0'])
def test_builtForAnotherPython(yade, complete, libraries, built):
	"""Case after an upgrade of the system, when the libraries of before may still be there, or may not."""
	compiled((root / 'plugin/yade_api/loader.cpp').read_text(), libraries / 'libpkg_mpm.so', f'-DMPM_BOOST_PYTHON="{built}"')
	run = yade(probe)
	assert run.result == withoutPlugin
	assert f"built with {built}, and this process has loaded {boostPython()}; if that is YADE's own, build the plugin again" in explanation(run)


@pytest.mark.parametrize('yadesFirst', [True, False])
def test_twoBoostPythons(yade, complete, yadesFirst):
	"""Case of a module of another system that a script has loaded."""
	other = compiled('', yade.folder / 'libboost_python39.so.1.67.0')
	order = [boostPython(), str(other)] if yadesFirst else [str(other), boostPython()]
	(yade.folder / 'two.py').write_text(f'import ctypes\nfor library in {order}: ctypes.CDLL(library)\n')
	run = yade(probe, options=['-L', 'two'])
	assert run.result == withoutPlugin
	assert f'built with {boostPython()}, and this process has loaded libboost_python39.so.1.67.0' in explanation(run)


def test_libraryThatIsGone(yade, complete, libraries):
	gone = compiled('', yade.folder / 'libboost_gone.so.1.0', '-Wl,-soname,libboost_gone.so.1.0')
	compiled('', libraries / 'mpm/mpm_guard.so', '-Wl,--no-as-needed', '-x', 'none', str(gone))
	gone.unlink()
	run = yade(probe)
	assert run.result == withoutPlugin
	assert 'libboost_gone.so.1.0: cannot open shared object file' in explanation(run)


def test_otherVirtualFunctions(yade, complete, libraries):
	"""A YADE with one function more or less is imitated by declarations with one less or more."""
	shutil.copy(build / 'tests/other_guard.so', libraries / 'mpm/mpm_guard.so')
	run = yade(probe)
	assert run.result == withoutPlugin
	assert re.search(r'has other virtual functions in Shape \(2[89] entries instead of 2[89]\), Sphere \(2[89] entries instead of 2[89]\)\.', explanation(run))


def test_processorWithoutAvx2(yade, complete, libraries):
	"""YADE starts without the plugin, and says how to build one for this processor."""
	shutil.copy(build / 'tests/old_processor_guard.so', libraries / 'mpm/mpm_guard.so')
	run = yade(probe)
	assert run.result == withoutPlugin
	assert 'this processor has no AVX2, which this build needs; build it on this computer, or with cmake -DMPM_PORTABLE=ON' in explanation(run)


def test_otherPlaceOfAVirtualFunction(yade, complete):
	"""A table of the same size with another function in a place is imitated by a function with another name there."""
	other = compiled(
	        '''
#include <dlfcn.h>
#include <cstring>
extern "C" int dladdr(const void* address, Dl_info* info)
{
	const int found = reinterpret_cast<int (*)(const void*, Dl_info*)>(dlsym(RTLD_NEXT, "dladdr"))(address, info);
	if (found && info->dli_sname && !std::strcmp(info->dli_sname, "_ZN4yade6Engine6actionEv")) info->dli_sname = "_ZN4yade6Engine5otherEv";
	return found;
}
''', yade.folder / 'other.so'
	)
	run = yade(probe, environment={'LD_PRELOAD': str(other)})
	assert run.result == withoutPlugin
	assert 'other virtual functions in Engine (another one in place of action), GlobalEngine (' in explanation(run)


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


# A YADE whose objects are larger is imitated by a larger answer to the question for their size.
sizes = '''
#include <dlfcn.h>
#include <cstddef>
extern "C" size_t malloc_usable_size(void* p) { return reinterpret_cast<size_t (*)(void*)>(dlsym(RTLD_NEXT, "malloc_usable_size"))(p) + 16; }
'''


def test_otherVersionOfYade(yade, complete):
	(yade.folder / 'other_version.py').write_text('''
import importlib.util, os, sys
path = os.path.join([p for p in sys.path if p.endswith('yade-double/py')][0], 'yade/config.py')
spec = importlib.util.spec_from_file_location('yade.config', path)
config = sys.modules['yade.config'] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(config)
config.version = '2024.01a'
''')
	assert yade(probe, options=['-L', 'other_version']).result['knowsPlugin'] # nothing that matters differs
	larger = compiled(sizes, yade.folder / 'larger.so')
	run = yade(probe, options=['-L', 'other_version'], environment={'LD_PRELOAD': str(larger)})
	assert run.result == withoutPlugin
	assert re.search(r'this YADE 2024\.01a \(the plugin was built for \S+\) differs in size of Scene', explanation(run))


def test_otherSizes(yade, complete):
	larger = compiled(sizes, yade.folder / 'larger.so')
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
	yade.command = provideCommand(yade.folder / 'prefix')


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
	replace = setup[setup.index('replace() {'):setup.index('# copyPlugin')]
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
	"""Overlay that scripts/setup installs without the rights of root."""
	subprocess.run([root / 'scripts/setup', '--user'], check=True)
	yade.command = str(build / 'overlay/bin/yade')
	run = yade('from yade import mpm, config; import json; print(json.dumps([mpm.__file__, config.libDir, str(MpmGrid)]))')
	file, folder, grid = run.result
	assert file == str(build / 'overlay/python/mpm/__init__.py')
	assert folder == str(build / 'overlay/lib/x86_64-linux-gnu/yade-double')
	assert grid == "<class 'yade.wrapper.MpmGrid'>"


def test_setupThatChangesNothingIsQuick(yade):
	subprocess.run([root / 'scripts/setup', '--user'], check=True)
	spent = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])  # time of the processor: others may want it too
	before = spent()
	second = subprocess.run([root / 'scripts/setup', '--user'], check=True, capture_output=True, text=True)
	assert spent() - before < 2
	assert second.stdout == ''


class OtherFolder:
	"""A second folder with the sources of this one, and a YADE of its own in place of the system's. What would be compiled there is only named."""
	libraries = 'lib/x86_64-linux-gnu/yade-double'

	def __init__(self, folder):
		self.folder, self.system, self.overlay = folder / 'second clone', folder / 'system' / self.libraries, folder / 'second clone/build/overlay'
		for part in 'scripts', 'plugin':
			shutil.copytree(root / part, self.folder / part, ignore=shutil.ignore_patterns('__pycache__'))
		shutil.copy(root / 'CMakeLists.txt', self.folder)
		(self.system / 'py/yade').mkdir(parents=True)
		for path in [*systemYade.glob('*.so'), *(systemYade / 'py').iterdir(), *(systemYade / 'py/yade').iterdir()]:
			copy = self.system / path.relative_to(systemYade)
			if path.name not in ('libpkg_mpm.so', 'mpm', 'yade'): copy.symlink_to(path)
		self.write('scripts/lib/common.sh', self.read('scripts/lib/common.sh').replace(str(systemYade), str(self.system)).replace('yadePrefix=/usr', f'yadePrefix={folder}/system'))
		self.tools = folder / 'tools'
		self.tools.mkdir()
		self.tool('cmake', 'echo compiles; exit 1')

	def tool(self, name, text):
		"""A program that is found before the system's."""
		(self.tools / name).write_text('#!/bin/sh\n' + text + '\n')
		(self.tools / name).chmod(0o755)

	def read(self, name):
		return (self.folder / name).read_text()

	def write(self, name, text):
		(self.folder / name).write_text(text)

	def plugin(self, folder):
		"""Puts the plugin there that is installed for this folder."""
		shutil.rmtree(folder / 'mpm', ignore_errors=True)
		shutil.copytree(build / 'overlay' / self.libraries / 'mpm', folder / 'mpm')
		shutil.copy(build / 'overlay' / self.libraries / 'libpkg_mpm.so', folder)

	def librariesOf(self, options):
		"""The folder that scripts/setup with these options installs into."""
		return self.overlay / self.libraries if options else self.system

	def command(self, *arguments):
		environment = {name: value for name, value in os.environ.items() if name not in ('CXXFLAGS', 'YADE_DIR')} | {'PATH': f'{self.tools}:{os.environ["PATH"]}'}
		return dict(args=arguments, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

	def setup(self, *options, **environment):
		"""Output of scripts/setup."""
		command = self.command(self.folder / 'scripts/setup', *options)
		command['env'] |= environment
		ended = subprocess.run(**command)
		assert (ended.returncode != 0) == ('compiles' in ended.stdout), ended.stdout
		return ended.stdout


forUserAndForAll = pytest.mark.parametrize(
        'options', [['--user'], pytest.param([], marks=pytest.mark.skipif(os.geteuid() != 0, reason='only root installs for all users'))], ids=['user', 'all'])


@pytest.fixture
def second(tmp_path):
	subprocess.run([root / 'scripts/setup', '--user'], check=True)
	folder = OtherFolder(tmp_path)
	folder.plugin(folder.overlay / folder.libraries)
	return folder


def test_sameSourcesInAnotherFolderAreNotCompiledAgain(yade, second):
	assert 'compiles' not in second.setup('--user')
	yade.command = str(second.overlay / 'bin/yade')
	assert yade('from yade import mpm; print(mpm.__file__, MpmGrid())').stdout.splitlines()[-1].startswith(str(second.overlay / 'python/mpm'))
	assert second.setup('--user') == ''
	second.write('plugin/python/mpm/geometry/outline.py', second.read('plugin/python/mpm/geometry/outline.py') + '# more')
	assert second.setup('--user') == f'Installed {second.overlay}/python/mpm/geometry/outline.py\n'


def test_whatIsInstalledForAllUsersIsNotCompiledAgain(yade, second):
	shutil.rmtree(second.overlay)
	second.plugin(second.system)
	assert 'compiles' not in second.setup('--user')
	yade.command = str(second.overlay / 'bin/yade')
	assert yade(probe).result == {'iterations': 2, 'knowsPlugin': True}
	assert second.setup('--user') == ''


@forUserAndForAll
def test_whatIsNotThatPluginIsCompiled(second, options):
	"""Other sources, and what somebody else has left of it."""
	libraries = second.librariesOf(options)
	source = 'plugin/core/stepping/newton.cpp'
	text = second.read(source)
	damages = [
	        lambda: second.write(source, text + '// more\n'),
	        lambda: second.write('plugin/core/added.cpp', ''),
	        lambda: (libraries / 'libpkg_mpm.so').unlink(),
	        lambda: (libraries / 'mpm/mpm_engine.so').write_bytes((build / 'mpm/mpm_engine.so').read_bytes()[:1000]),
	        lambda: (libraries / 'libpkg_mpm.so').write_bytes(b'of another revision'),
	        lambda: (libraries / 'mpm/made-from').write_text(''),
	        lambda: shutil.rmtree(libraries / 'mpm'),
	]
	for damage in damages:
		second.plugin(libraries)
		damage()
		assert 'compiles' in second.setup(*options)
		second.write(source, text)
		(second.folder / 'plugin/core/added.cpp').unlink(missing_ok=True)
	second.plugin(libraries)
	assert 'compiles' in second.setup(*options, CXXFLAGS='-march=native')
	assert 'compiles' not in second.setup(*options)


@forUserAndForAll
def test_setupWaitsForAnotherAndTakesWhatThatHasInstalled(second, options):
	second.setup('--user')
	libraries = second.librariesOf(options)
	shutil.rmtree(libraries / 'mpm', ignore_errors=True)
	lock = os.open(second.folder / 'build/.setup-lock' if options else second.system, os.O_RDONLY)
	fcntl.flock(lock, fcntl.LOCK_EX)
	waiting = subprocess.Popen(**second.command(second.folder / 'scripts/setup', *options))
	assert 'Waiting for another scripts/setup' in waiting.stdout.readline()
	second.plugin(libraries)
	os.close(lock)
	assert 'compiles' not in waiting.communicate(timeout=20)[0] and waiting.returncode == 0


def test_packagesWaitForAnotherInstallation(second, tmp_path):
	"""apt has locks for its lists, its downloads and dpkg, and ends at once where it finds one taken."""
	install = second.command('bash', '-eu', '-o', 'pipefail', '-c', f'source "{second.folder}/scripts/lib/common.sh"; installPackages there-is-no-such-package')
	second.tool('sudo', 'exec "$@"')
	second.tool('sleep', '')
	second.tool('apt-get', f'''echo "$*" >>{tmp_path}/calls
case $(grep -c . {tmp_path}/calls) in
	1) echo "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 1 (apt-get)" >&2; exit 100 ;;
	3) echo "E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 1 (apt-get)" >&2; exit 100 ;;
esac''')
	said = subprocess.run(**install)
	assert said.returncode == 0 and said.stdout.count('Waiting for another program that installs packages') == 2, said.stdout
	update, install2 = '-q update', '-q install -y --no-install-recommends there-is-no-such-package'
	assert (tmp_path / 'calls').read_text().splitlines() == [update, update, install2, install2]
	second.tool('apt-get', 'echo "E: No network" >&2; exit 100')
	said = subprocess.run(**install)
	assert said.returncode == 1 and 'apt-get update: E: No network' in said.stdout, said.stdout
