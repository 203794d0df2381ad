# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/wild without the public laws: what it says where they are missing, and the routines of Abaqus that it links to them."""
import ctypes
import re
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from conftest import root

sys.path.insert(0, str(root / 'scripts' / 'lib'))
from wild import files
from wild.laws import laws


def test_sources_that_are_missing_are_named(tmp_path):
	ended = subprocess.run([root / 'scripts/wild', tmp_path], capture_output=True, text=True, cwd=tmp_path)
	assert ended.returncode == 1 and 'has none of the laws' in ended.stderr or 'gfortran is not installed' in ended.stderr
	law = laws['Sanisand']
	assert law.missing(tmp_path) == ['merge/source.F90']
	folder = tmp_path / 'Abaqus_UMAT_sanisand/merge'
	folder.mkdir(parents=True)
	(folder / 'source.F90').write_text('')
	assert not law.missing(tmp_path)


def test_a_source_in_an_archive_is_unpacked(tmp_path):
	law = laws['Cam clay, trust region']
	assert law.missing(tmp_path) == law.sources
	folder = tmp_path / 'NMTR_Method'
	folder.mkdir()
	with zipfile.ZipFile(folder / 'NMTR-Parallel.zip', 'w') as archive:
		archive.writestr('NMTR-Parallel/NMTR_Method_CTO.for', '      end\n')
	made = tmp_path / 'made'
	assert not law.missing(tmp_path) and open(law.source(tmp_path, law.sources[0], made)).read() == '      end\n'


def test_each_law_has_room_for_its_tensors():
	for name, law in laws.items():
		begins = sorted(law.tensors.get('stressTensors', []) + law.tensors.get('strainTensors', []))
		assert len(law.states) <= 40 and len(law.commit) == 40, name
		assert all(begin + 5 <= len(law.states) for begin in begins) and all(b - a >= 6 for a, b in zip(begins, begins[1:])), name


@pytest.fixture(scope='module')
def routines(tmp_path_factory):
	library = tmp_path_factory.mktemp('wild') / 'utilities.so'
	subprocess.run(['g++', '-O1', '-shared', '-fPIC', '-I', '/usr/include/eigen3', '-o', library, root / 'scripts/lib/wild/utilities.cpp'], check=True)
	return ctypes.CDLL(str(library))


def array(*numbers):
	return (ctypes.c_double * len(numbers))(*numbers)


@pytest.mark.parametrize('kind', [1, 2])
def test_principal_values_and_rotations_of_stress_and_strain(routines, kind):
	"""A tensor with the principal values 3, 2, -1, turned by 30 degrees about z: strains have twice the shear component."""
	c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
	R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
	whole = R @ np.diag([3., -1., 2.]) @ R.T
	expected = [whole[0, 0], whole[1, 1], whole[2, 2], kind * whole[0, 1], 0, 0]
	turned, found, three = array(*[0] * 6), array(0, 0, 0), ctypes.c_int(3)
	routines.rotsig_(array(3, -1, 2, 0, 0, 0), array(*R.T.ravel()), turned, ctypes.byref(ctypes.c_int(kind)), ctypes.byref(three), ctypes.byref(three))
	assert list(turned) == pytest.approx(expected)
	routines.sprinc_(turned, found, ctypes.byref(ctypes.c_int(kind)), ctypes.byref(three), ctypes.byref(three))
	assert list(found) == pytest.approx([3, 2, -1])
	mean, mises = ctypes.c_double(), ctypes.c_double()
	routines.sinv_(array(0, 0, -30, 0, 0, 0), ctypes.byref(mean), ctypes.byref(mises), ctypes.byref(three), ctypes.byref(three))
	assert (mean.value, mises.value) == pytest.approx((-10, 30))


def test_files_that_are_missing_or_others_are_named(tmp_path):
	"""Each file of the list has an address and a check sum; what is not there is left out."""
	assert all(re.fullmatch('[0-9a-f]{16}', total) and re.fullmatch('[0-9a-f]{40}', commit) for _, (_, commit, _), _, total, _ in files.files)
	path = tmp_path / 'landlab' / files.landlab[2] / 'mass_wasting_runout'
	path.mkdir(parents=True)
	(path / 'A_PlanarSlope.asc').write_text('ncols 2')
	states = {files.state(tmp_path, entry) for entry in files.files}
	assert states == {'missing', 'another version'}
	ended = subprocess.run([root / 'scripts/wild', tmp_path / 'none', '--files'], capture_output=True, text=True, cwd=tmp_path)
	assert ended.returncode == 1 and 'has none of the files' in ended.stderr and 'check out OpenSees/OpenSees at' in ended.stdout


def test_peaks_that_headers_tell(tmp_path):
	for text, peak in ('PGA_CM/S^2: -0.25', 0.25), ('Max. Acc. (gal)   4.078', 4.078), ('PEAK ACCELERATION =  -267.957    CM/SEC/SEC', 267.957), ('dist = 89.0       pk     =    104.4', 104.4), ('NPTS= 4', None):
		(tmp_path / 'record').write_text(text)
		assert files.told(tmp_path / 'record') == peak
