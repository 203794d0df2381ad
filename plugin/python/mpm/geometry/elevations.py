# SPDX-License-Identifier: GPL-2.0-or-later
"""Files with heights of ground: ESRI ASCII, and by GDAL whatever else GIS writes."""
import math
import os

import numpy as np

from ..base.messages import brief

_ascii = '.asc', '.txt', ''  # endings of ESRI ASCII


def read(fileName, who):
	"""Heights [m] (Nx, Ny), NaN where they are not known, the place (x, y) of the first one, and their distances along x and y [m], for the function *who*."""
	with open(fileName, 'rb'):
		pass  # GDAL does not say that there is no such file
	return _ofAscii(fileName, who) if os.path.splitext(fileName)[1].lower() in _ascii else _ofGdal(fileName, who)


def _ofGdal(fileName, who):
	"""First band of a file, with the heights at the centres of its cells."""
	try:
		from osgeo import gdal
	except ImportError:
		raise ImportError(f'{who}: {fileName!r} needs GDAL, which is not installed (apt install python3-gdal); without it the files that end in .asc, ESRI ASCII, are read: gdal_translate -of AAIGrid makes one') from None
	gdal.UseExceptions()
	refuse = lambda what: ValueError(f'{who}: {fileName!r} is no elevation grid: {what}')
	try:
		source = gdal.Open(fileName)
		band, frame, system = source.GetRasterBand(1), source.GetGeoTransform(can_return_null=True), source.GetSpatialRef()
		values = band.ReadAsArray().astype(float)
	except RuntimeError as error:
		raise refuse(f'GDAL says {brief(str(error))}') from None
	if frame is None: raise refuse('it does not say where it is; give it coordinates, as by gdal_translate -a_ullr')
	if frame[2] or frame[4]: raise refuse('its rows do not run along x; gdalwarp turns it')
	if system is not None and system.IsProjected() and system.GetLinearUnits() != 1: raise refuse(f'its coordinates are in {system.GetLinearUnitsName()}; have gdalwarp project it to metres')
	if band.GetUnitType() not in ('', 'm', 'metre', 'meter'): raise refuse(f'its heights are in {band.GetUnitType()!r}; convert them to metres')
	known = np.isfinite(values) & (band.GetMaskBand().ReadAsArray() != 0)
	values = np.where(known, values * (band.GetScale() or 1) + (band.GetOffset() or 0), np.nan)
	if min(values.shape) < 2: raise refuse(f'it has {values.shape[0]} rows of {values.shape[1]} heights, and at least 2 of each are needed')
	steps, first = np.array([frame[1], frame[5]]), np.array([frame[0], frame[3]])
	for axis in (0, 1):
		if steps[axis] > 0: continue
		first[axis] += steps[axis] * values.shape[1 - axis]
		values = np.flip(values, 1 - axis)
	return values.T, first + abs(steps) / 2, abs(steps)


def _ofAscii(fileName, who):
	refuse = lambda what: ValueError(f'{who}: {fileName!r} is no elevation grid (ESRI ASCII): {what}')
	header, lines = {}, []
	with open(fileName, encoding='utf-8', errors='replace') as file:
		for line in file:
			words = line.split()
			if words and not lines and words[0][0].isalpha() and words[0].lower() != 'nan':
				try:
					header[words[0].lower()] = float(words[1])
				except (IndexError, ValueError):
					raise refuse(f'its header has the line {brief(line.strip())}') from None
			elif words: lines.append(line)
	sizes = ('dx', 'dy') if {'dx', 'dy'} & set(header) else ('cellsize', )
	if 'cellsize' in header and sizes != ('cellsize', ): raise refuse('its header has cellsize beside dx or dy, which say the same; leave one of them')
	missing = [name for name in ('ncols', 'nrows', *sizes) if name not in header] + [axis + 'llcorner' for axis in 'xy' if not {axis + 'llcorner', axis + 'llcenter'} & set(header)]
	if missing: raise refuse(f"{', '.join(missing)} {'is' if len(missing) == 1 else 'are'} not in its header")
	try:
		values = np.array(' '.join(lines).split(), float)
	except ValueError as error:
		raise refuse(error) from None
	for name in 'nrows', 'ncols':
		if header[name] != int(header[name]): raise refuse(f'{name} = {header[name]:g} is no whole number')
	shape = int(header['nrows']), int(header['ncols'])
	if values.size != shape[0] * shape[1] or min(shape) < 2: raise refuse(f'{shape[0]} rows of {shape[1]} heights are announced, at least 2 of each, and {values.size} are there')
	for name in sizes:
		if not (math.isfinite(header[name]) and header[name] > 0): raise refuse(f'{name} = {header[name]:g} must be > 0 and finite')
	widths = [len(line.split()) for line in lines]
	areWrapped = len(set(widths[:-1])) <= 1 and widths[-1] <= widths[0] and len(lines) != shape[0] and (len(lines), widths[0]) != shape[::-1]  # at a width of their own; not a height lost in one row, nor nrows and ncols exchanged
	ends = np.cumsum(widths)
	cut = np.setdiff1d(shape[1] * np.arange(1, shape[0] + 1), ends)
	if cut.size and not areWrapped:
		row, line = cut[0] // shape[1], np.searchsorted(ends, cut[0])
		raise refuse(
		        f'each of its {shape[0]} rows has {shape[1]} heights (ncols), but row {row} does not end with a line: line {line + 1} of the heights has {len(lines[line].split())}; is ncols '
		        'right, or has a height been lost or doubled?'
		)
	half = [0 if f'{axis}llcenter' in header else header[size] / 2 for axis, size in zip('xy', (*sizes, *sizes))]
	corner = [header.get(f'{axis}llcenter', header.get(f'{axis}llcorner')) for axis in 'xy']
	rows = np.where(values == header.get('nodata_value', -9999), np.nan, values).reshape(shape)
	return rows[::-1].T, np.array(corner) + half, np.array([header[sizes[0]], header[sizes[-1]]])  # the first row is the northern one
