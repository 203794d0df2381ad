# SPDX-License-Identifier: GPL-2.0-or-later
"""mpm.state: what ParaView is told, recorded by a stand-in for its module, and ParaView itself where it is installed."""
import os
import shutil
import subprocess

import pytest
from conftest import outcomesOf

refused = [
        ('mpm.state("x.pvsm")', 'ValueError', ["'x.pvsm'", '.py']),
        ('mpm.state(3)', 'TypeError', ['fileName = 3']),
        ('O.engines = O.engines[:1]; mpm.state("x.py")', 'ValueError', ['no MpmVtkRecorder', 'MpmVtkRecorder(fileName=']),
        ('O.engines += [MpmVtkRecorder(fileName="b-")]; mpm.state("x.py")', 'ValueError', ['2 MpmVtkRecorder', 'recorder']),
        ('mpm.state("x.py", recorder=3)', 'TypeError', ['recorder = 3']),
        ('mpm.state("x.py")', 'FileNotFoundError', ['a-points.pvd', 'recorded']),
        ('mpm.state("x.py", "stress")', 'ValueError', ['stress_xy']),
        ('O.engines[1].fields = ("stress", ); O.run(1, wait=True); mpm.state("x.py", "plasticStrain")', 'ValueError', ["'plasticStrain'", 'stress', 'fields']),
        ('mpm.state("x.py", range=(1, 0))', 'ValueError', ['range = (1, 0)']),
]


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	before = 'O.reset(), column(8), setattr(O, "engines", O.engines + [MpmVtkRecorder(fileName="a-")]), [os.remove(f) for f in os.listdir() if f.startswith("a-")]'
	return outcomesOf(tmp_path_factory.mktemp('state'), 'import os\nfrom scenes import *\n', [statement for statement, _, _ in refused], before=before)


@pytest.mark.parametrize('statement, exception, words', refused, ids=[statement for statement, _, _ in refused])
def test_isRefused(outcomes, statement, exception, words):
	kind, sentence = outcomes[statement]
	assert kind == exception, sentence
	for word in words:
		assert word in sentence


@pytest.fixture(scope='module')
def written(tmp_path_factory):
	"""Folder with states of a slope, and its largest shear stress [Pa] and displacement [m]."""
	from conftest import Yade
	run = Yade(tmp_path_factory.mktemp('states'))('''
import json
from scenes import *
slope()
O.engines += [MpmVtkRecorder(fileName='out/slope-', iterPeriod=5)]
O.run(10, wait=True)
mpm.state('out/stress.py', 'stress_xy')
mpm.state('states/moved.py')
from yade.mpm.output.paraview import formula
points = mpm.arrays()
print(json.dumps([float(points['stress'][:, 0, 1].min()), float(points['stress'][:, 0, 1].max()), float(np.linalg.norm(points['pos'] - points['pos0'], axis=1).max()),
	[formula(*pair) for pair in (('displacement_y', 1), ('displacement', 1e-3), ('plasticStrain', 1), ('meanStress', 1e6), ('stress_zz', 1e3), ('defGrad_yx', 1))]]))
''')
	return run.folder, run.result


class Recorded:
	"""Takes any attribute and call, as ParaView's objects do."""
	TimestepValues = [0, 0.125, 0.25]
	CameraParallelScale, CameraFocalPoint = 1., [0, 0, 0]

	def __init__(self, **settings):
		self.__dict__ |= settings

	def __getattr__(self, name):
		return lambda *arguments, **settings: None


def told(folder, name):
	"""Globals of a state after it has been run with the stand-in, and the objects that it has made, by kind."""
	made = {}

	def maker(kind):
		return lambda *arguments, **settings: made.setdefault(kind, []).append(Recorded(**settings)) or made[kind][-1]

	names = ('PVDReader', 'GetActiveViewOrCreate', 'GetAnimationScene', 'Calculator', 'Show', 'Hide', 'ColorBy', 'GetColorTransferFunction', 'GetScalarBar', 'AnnotateTimeFilter', 'ResetCamera', 'SetActiveSource')
	given = {kind: maker(kind) for kind in names} | {'__file__': str(folder / name)}
	exec(compile((folder / name).read_text().replace('from paraview.simple import *', ''), name, 'exec'), given)
	return given, made


def test_what_paraview_is_told(written):
	folder, (low, high, moved, formulas) = written
	given, made = told(folder / 'out', 'stress.py')
	assert all(os.path.exists(reader.FileName) for reader in made['PVDReader']) and {reader.registrationName for reader in made['PVDReader']} == {'points'} | set(given['files'])
	colours = made['GetColorTransferFunction'][0].RGBPoints
	assert made['Calculator'][0].Function == '"stress_1" / 1000' and colours[0] == pytest.approx(-max(-low, high) / 1e3, rel=1e-5) and colours[-4] == pytest.approx(-colours[0])
	assert made['GetScalarBar'][0].Title == 'stress sigma_xy [kPa]' and made['AnnotateTimeFilter'][0].Format == 'load time {time:g}' and made['GetActiveViewOrCreate'][0].InteractionMode == '2D'
	given, made = told(folder / 'states', 'moved.py')
	assert os.path.exists(made['PVDReader'][0].FileName) and made['GetColorTransferFunction'][0].RGBPoints[-4] == pytest.approx(moved, rel=1e-5) and moved > 0.1
	assert formulas == ['"displacement_Y"', 'mag(displacement) / 0.001', 'plasticStrain', 'meanStress / 1000000', '"stress_8" / 1000', '"defGrad_3"']


@pytest.mark.skipif(not (shutil.which('pvpython') and shutil.which('xvfb-run')), reason='there is no ParaView with Python, or no Xvfb')
def test_paraview_opens_it(written):
	folder, (low, high, _, _) = written
	(folder / 'out/check.py').write_text("exec(open('stress.py').read())\nshown.UpdatePipeline(view.ViewTime)\nprint('range', *shown.CellData['shown'].GetRange())\n")
	said = subprocess.run(['xvfb-run', '-a', 'pvpython', 'check.py'], cwd=folder / 'out', capture_output=True, text=True, timeout=200).stdout
	assert [float(word) for word in said.split('range')[1].split()[:2]] == pytest.approx([low / 1e3, high / 1e3])


def test_files_have_any_name(yade):
	"""Signs that XML writes in other letters: the state is written, and names the files as they are."""
	found = yade('''
import json
from scenes import *
found = []
for name in 'c & phi-', 'phi<30-', 'a "b"-':
	O.reset()
	column(8)
	O.engines = O.engines + [MpmVtkRecorder(fileName=name)]
	O.run(1, wait=True)
	mpm.state('state.py', 'stress_yy')
	found.append(repr(name + 'points.pvd') in open('state.py').read())
print(json.dumps(found))
''').result
	assert found == [True, True, True]
