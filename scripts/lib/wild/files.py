# SPDX-License-Identifier: GPL-2.0-or-later
"""Public files of records and terrain, by format: where they are, their check sums, and what they say of themselves. `read` runs in YADE."""
import hashlib
import os
import re

ground = 'usgs/groundmotion-processing', 'c5e7849af39e1a8ed89530a1aa6e3dbde88f50fa', 'tests/data/'
opensees = 'OpenSees/OpenSees', '2890cb36f59b5a707c607c63a831606f325adb7c', 'EXAMPLES/'
landlab = 'landlab/landlab', '33b6215cf3c4fb55e0354f38ae99a9019602578e', 'docs/source/tutorials/'
# Format; repository, commit and folder; file; first sixteen digits of its SHA-256; settings of mpm.record
files = [
        ('ESM', ground, 'esm/us60004wsq/HL.DLFA..HNE.D.20190728.160908.C.ACC.ASC', '4cb8baddfde894a3', {}),
        ('K-NET', ground, 'knet/us2000cnnl/AOM0011801241951.EW', 'e9c2e8874cc6e96a', {}),
        ('KiK-net', ground, 'kiknet/usp000hzq8/NGNH311106302345.EW2', '9e90d78cfce916d6', {}),
        ('KiK-net, borehole', ground, 'kiknet/usp000hzq8/NGNH311106302345.NS1', '7be1ff9081880139', {}),
        ('COSMOS', ground, 'cosmos/us1000hyfh/us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c', '178a79bfc9f04016', {}),
        ('CSMIP, three channels', ground, 'dmg/nc71734741/CE89146.V2', '3a872841b6481c60', dict(channel=1)),
        ('CSMIP of 1983', ground, 'dmg/nc1091100/ce36456p_CE36456.V2', 'f78f24e5a275862e', dict(channel=1)),
        ('SMC', ground, 'smc/nc216859/0111a.smc', '2d51e2695d367ade', {}),
        ('PEER, new form', ground, 'high_freq_sa/RSN10590_ComalTX11-10-20_IU.CCM.BH1.00.AT2', 'eba22a42416ee2e4', {}),
        ('PEER', opensees, 'SmallMP/GM/A-ELC180.AT2', 'c3427a100beb2314', {}),
        ('PEER, unit in brackets', opensees, 'ExampleScripts/elCentro.AT2', 'e096f0458ae7565a', {}),
        ('ESRI ASCII', landlab, 'mass_wasting_runout/A_PlanarSlope.asc', '4f12a5c661458656', {}),
        ('ESRI ASCII', landlab, 'ecohydrology/cellular_automaton_vegetation_DEM/DEM_10m.asc', 'fa32b7107988c52b', {}),
        ('ESRI ASCII', landlab, 'river_flow_dynamics/DEM-kootenai_37x50_1x1.asc', '1fa39e20291f4648', {}),
        ('ESRI ASCII with holes', landlab, 'mass_wasting_runout/pre_runout_DEM.asc', '00f7d207b456e86f', {}),
]
peaks = r'PGA_CM/S\^2:\s*([-\d.]+)', r'Max\. Acc\. \(gal\)\s+([\d.]+)', r'Peak acceleration\s*=\s*([-\d.]+)', r'\bpk\s*=\s*([-\d.]+)'  # [cm/s2], in the headers of networks


def pathOf(folder, entry):
	_, (repository, _, within), file, *_ = entry
	return os.path.join(folder, repository.split('/')[1], within + file)


def state(folder, entry):
	"""Empty if the file is there and the one that is listed."""
	path = pathOf(folder, entry)
	if not os.path.exists(path): return 'missing'
	with open(path, 'rb') as file:
		return '' if hashlib.sha256(file.read()).hexdigest()[:16] == entry[3] else 'another version'


def told(path):
	"""Largest acceleration in a header [cm/s2]; None if it has none."""
	with open(path, errors='replace') as file:
		head = file.read(8000)
	found = [float(match[1]) for pattern in peaks if (match := re.search(pattern, head, re.IGNORECASE))]
	return abs(found[0]) if found else None


def read(path, format, settings):
	"""In YADE: what a file holds, and what is read beside what its header tells."""
	return terrain(path) if format.startswith('ESRI') else record(path, settings)


def record(path, settings):
	from yade import mpm
	quake = mpm.record(path, baseline=None, isSure=True, **settings)
	values = 100 * quake.acceleration
	if quake.isCorrected is False: values = values - values.mean()  # as networks tell the peak
	return dict(holds=f'{len(values)} samples, {quake.step:g} s', told=told(path) or '', found=abs(values).max())


def terrain(path):
	"""The height of the highest cell by the lines of the file, and by mpm.terrain."""
	import numpy as np
	from yade import mpm
	with open(path) as file:
		lines = file.read().lower().split('\n')
	head = {name: float(value) for name, value in (line.split() for line in lines[:6] if line[:1].isalpha())}
	heights = np.loadtxt(lines[len(head):])[::-1]
	heights[heights == head.get('nodata_value', -9999)] = -np.inf
	row, column = np.unravel_index(heights.argmax(), heights.shape)
	place = np.array([head['xllcorner'], head['yllcorner']]) + head['cellsize'] * (np.array([column, row]) + 0.5)
	around = dict(min=place - 0.1 * head['cellsize'], max=place + 0.1 * head['cellsize']) if np.isinf(heights).any() else {}
	ground = mpm.terrain(path, bottom=heights.max() - 1000, **around)
	return dict(holds=f"{heights.shape[1]} by {heights.shape[0]} heights, {head['cellsize']:g} m", told=heights.max(), found=ground.heights([place])[0])
