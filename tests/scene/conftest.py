# SPDX-License-Identifier: GPL-2.0-or-later
"""Fixtures for tests that drive the real YADE: each script runs in a YADE process of its own.

The environment variable YADE names the command to test; scripts/test sets it. By default it is the installed yade.
"""
import functools
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import pytest

root = Path(__file__).resolve().parents[2]
sys.path.append(str(root / 'scripts' / 'lib'))
from mpi import byMpi, makingRoom

build = root / 'build'
systemYade = Path('/usr/lib/x86_64-linux-gnu/yade-double')
systemCommand = '/usr/bin/yade'


@dataclass
class Run:
	"""Results of a YADE process."""
	exitCode: int
	stdout: str
	stderr: str
	folder: Path  # working folder, with the files that the script wrote

	@property
	def result(self):
		"""Last output of the script, read as JSON: print(json.dumps(...))"""
		return json.loads(self.stdout.splitlines()[-1])

	def __str__(self):
		return f'exit code {self.exitCode}\n--- stdout\n{self.stdout}\n--- stderr\n{self.stderr}'


def theCommand():
	return os.environ.get('YADE', 'yade')


@functools.cache
def quickWaits():
	"""The folder of waits.so for LD_PRELOAD, by which O.run(n, wait=True) looks every 0.4 ms whether it has ended, not every 40: most steps of tests take less."""
	folder = tempfile.TemporaryDirectory()
	compiled(
	        '''
#include <dlfcn.h>
#include <time.h>
static const auto sleeps = reinterpret_cast<int (*)(const timespec*, timespec*)>(dlsym(RTLD_NEXT, "nanosleep"));
extern "C" int nanosleep(const timespec* asked, timespec* left)
{
	const timespec quick { 0, 400000 };
	return sleeps(asked->tv_sec == 0 && asked->tv_nsec == 40000000 ? &quick : asked, left);
}
''', Path(folder.name) / 'waits.so'
	)
	return folder


class Started:
	"""A YADE that has started, once for many scripts: most of them end sooner than YADE starts. Each runs in a copy of its process (waiting.py)."""

	every = []

	def __init__(self, command):
		self.folder = tempfile.TemporaryDirectory()
		self.connection, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
		with theirs, open(self.path('said'), 'w') as said:
			self.process = subprocess.Popen(
			        [command, '-n', '-x', '-j1', str(root / 'tests/scene/waiting.py'), str(theirs.fileno())],
			        cwd=self.folder.name,
			        env=os.environ | makingRoom | Yade(Path(self.folder.name)).ownSettings() | {'IPYTHONDIR': self.path('ipython')},
			        stdin=subprocess.DEVNULL,
			        stdout=said,
			        stderr=said,
			        pass_fds=[theirs.fileno()],
			        preexec_fn=interruptible
			)
		self.every.append(self)

	def path(self, name):
		return os.path.join(self.folder.name, name)

	def answer(self, timeout):
		self.connection.settimeout(timeout)
		message = self.connection.recv(1 << 20)
		assert message, 'YADE that was to run the scripts has ended: ' + Path(self.path('said')).read_text()
		return json.loads(message)

	def run(self, arguments, folder, environment, timeout):
		with tempfile.TemporaryFile('w+', errors='replace') as stdout, tempfile.TemporaryFile('w+', errors='replace') as stderr:
			message = json.dumps([arguments, str(folder), environment]).encode()
			socket.send_fds(self.connection, [message], [stdout.fileno(), stderr.fileno()])
			copy = self.answer(timeout)
			try:
				exitCode = self.answer(timeout)
			except TimeoutError:
				os.kill(copy, signal.SIGKILL)
				self.answer(timeout)
				raise
			for file in stdout, stderr:
				file.seek(0)
			return Run(exitCode, stdout.read(), stderr.read(), folder)

	def end(self):
		self.connection.close()
		try:
			self.process.wait(timeout=60)
		finally: # it would keep the whole run from ending
			self.process.kill()
			self.process.wait()
			self.folder.cleanup()


started = functools.cache(Started)


def pytest_collection_modifyitems(items):
	"""Files that take long come first: where processes take a file each, the last ones to end then have little left to wait for."""
	first = ['test_processes', 'test_examples', 'test_calibration', 'test_pairs', 'test_studies', 'test_documentation', 'test_loading', 'test_reproduce']
	items.sort(key=lambda item: first.index(item.path.stem) if item.path.stem in first else len(first))


def pytest_unconfigure():
	for each in Started.every:
		each.end()


class Yade:
	"""Runs scripts in YADE without windows."""

	def __init__(self, folder):
		self.folder = folder
		self.command = theCommand()
		self.isShared = False  # true for another command that many scripts use
		self.environment = {}  # variables in addition to those of this process

	def __call__(self, script, *arguments, threads=1, processes=1, timeout=120, fails=False, environment={}, options=(), stderr=subprocess.PIPE):
		"""Run a script to its end; the test fails unless the exit code is 0, or with *fails* unless it is not 0.

		:param script: its text, or its path as a pathlib.Path
		:param arguments: of the script
		:param threads: for YADE's option -j
		:param processes: if more than one, by mpirun, as scripts/run -n does
		:param timeout: [s], after which the process is ended and the test fails
		:param environment: variables for this run only
		:param options: of YADE, in addition to -n -x -j
		:param stderr: file descriptor to which it goes instead of the Run
		:return: Run
		"""
		if not isinstance(script, Path):
			text, script = script, self.folder / 'script.py'
			script.write_text(text)
		if (self.isShared or self.command == theCommand()) and not self.environment and (processes, threads, environment, options, stderr) == (1, 1, {}, (), subprocess.PIPE):
			run = started(self.command).run([str(script), *map(str, arguments)], self.folder, self.ownSettings(), timeout)
			assert (run.exitCode != 0) == fails, str(run)
			assert 'labels overlap in' not in run.stderr, run.stderr  # pictures of examples (labels.py)
			return run
		ended = subprocess.run(
		        [*byMpi(processes), self.command, '-n', '-x', f'-j{threads}', *options, str(script), *map(str, arguments)],
		        cwd=self.folder,
		        env=os.environ | makingRoom | self.ownSettings() | self.environment | environment,
		        timeout=timeout,
		        stdout=subprocess.PIPE,
		        stderr=stderr,
		        stdin=subprocess.DEVNULL,
		        text=True,
		        errors='replace',
		        preexec_fn=interruptible
		)
		run = Run(ended.returncode, ended.stdout, ended.stderr, self.folder)
		assert (run.exitCode != 0) == fails, str(run)
		return run

	def ownSettings(self):
		"""Variables that keep the process from reading or writing the settings of the user, find scenes.py, and let waiting take no longer than it must."""
		config = str(self.folder / 'config')
		waits = ' '.join([os.path.join(quickWaits().name, 'waits.so'), *os.environ.get('LD_PRELOAD', '').split()])
		return {'PYTHONPATH': str(root / 'tests' / 'scene'), 'XDG_CONFIG_HOME': config, 'MPLCONFIGDIR': config, 'MPLBACKEND': 'Agg', 'LD_PRELOAD': waits}


def interruptible():
	"""A shell that runs the tests in the background has Ctrl-C ignored, which the processes that they start would inherit."""
	signal.signal(signal.SIGINT, signal.SIG_DFL)


def outcomesOf(folder, setting, statements, before='O.reset()'):
	"""Outcomes of statements that are each tried after *before*, all in one YADE process.

	:return: dict of [name of the exception, its sentence] by statement
	"""
	(folder / 'statements.json').write_text(json.dumps(statements))
	return Yade(folder)(
	        setting + f'''
import json
outcomes = {{}}
for statement in json.load(open('statements.json')):
	{before}
	try:
		exec(statement)
		outcomes[statement] = ['no exception', '']
	except Exception as error:
		outcomes[statement] = [type(error).__name__, str(error)]
print(json.dumps(outcomes))
'''
	).result


def compiled(source, library, *options):
	"""A shared library from C++ text; with LD_PRELOAD it replaces functions of YADE."""
	compiler = ['g++', '-shared', '-fPIC', '-x', 'c++', '-', '-o', str(library), '-ldl', *options]
	subprocess.run(compiler, input=source, text=True, check=True)
	return library


@pytest.fixture
def yade(tmp_path):
	"""The YADE under test, with the plugin: yade(script, ...) runs a script and returns a Run."""
	return Yade(tmp_path)


@pytest.fixture
def libraries(yade):
	"""Makes `yade` start from a folder of its own: the system's libraries, the loader and the guard. What the guard shall open is up to the test.

	:return: the folder; the guard looks for mpm/mpm_engine.so in it
	"""
	yade.command = systemCommand
	yade.environment['YADE_PREFIX'] = str(yade.folder / 'prefix')
	return makeLibraries(yade.folder / 'prefix')


def makeLibraries(prefix):
	"""A folder of YADE's libraries with the loader and the guard, which opens the plugin in its folder mpm."""
	folder = prefix / systemYade.relative_to('/usr')
	(folder / 'mpm').mkdir(parents=True)
	for path in [*systemYade.glob('*.so'), systemYade / 'py']:
		if path.name != 'libpkg_mpm.so': (folder / path.name).symlink_to(path)
	shutil.copy(build / 'libpkg_mpm.so', folder)
	shutil.copy(build / 'mpm/mpm_guard.so', folder / 'mpm')
	return folder


def makeOverlay(prefix, engine=build / 'mpm/mpm_engine.so', withPetsc=True):
	"""Makes the overlay of scripts/setup --user, with the plugin of the build, or another library in its place.

	:return: the command of YADE in it
	"""
	folder = makeLibraries(prefix) / 'mpm'
	shutil.copy(engine, folder)
	if withPetsc and (build / 'mpm/mpm_petsc.so').exists(): shutil.copy(build / 'mpm/mpm_petsc.so', folder)
	return provideCommand(prefix)


def provideCommand(prefix):
	"""YADE's command in an overlay, which finds yade.mpm there."""
	(prefix / 'python').symlink_to(root / 'plugin/python')
	(prefix / 'bin').mkdir()
	(prefix / 'host').write_text(systemCommand)
	return str(shutil.copy(root / 'scripts/lib/yade-in-overlay.py', prefix / 'bin/yade'))


@pytest.fixture
def yadeWithoutPetsc(yade):
	"""`yade` with all of the plugin but mpm_petsc.so."""
	yade.command = makeOverlay(yade.folder / 'prefix', withPetsc=False)
	return yade
