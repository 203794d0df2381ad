#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# VTK 9.1: a column of points with a gap written as nan, as text, in the XML format (.vti) and in the legacy format (.vtk).
# Expected: both readers give 1, nan, 3, 4, and the column after it.
# Seen: the XML reader does. The legacy reader stops at nan: the values behind it are not those of the file, the next column is not there, and GetErrorCode() is 0 all the same.
. "$(dirname "$(realpath "$0")")/packages.inc"
take python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
/usr/bin/python3 - <<'SCRIPT' || changed 'nan is read otherwise'
import sys
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy
vtk.vtkLogger.SetStderrVerbosity(vtk.vtkLogger.VERBOSITY_OFF)
column = lambda name, values: f'<DataArray type="Float64" Name="{name}" format="ascii">{values}</DataArray>'
image = '<ImageData WholeExtent="0 3 0 0 0 0" Origin="0 0 0" Spacing="1 1 1"><Piece Extent="0 3 0 0 0 0"><PointData>{}</PointData></Piece></ImageData>'
with open('gap.vti', 'w') as file: file.write('<VTKFile type="ImageData" version="0.1">' + image.format(column('a', '1 nan 3 4') + column('b', '1 2 3 4')) + '</VTKFile>')
scalars = lambda name, values: f'SCALARS {name} double 1\nLOOKUP_TABLE default\n{values}\n'
with open('gap.vtk', 'w') as file:
	file.write('# vtk DataFile Version 3.0\ngap\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 4 1 1\nORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 4\n' + scalars('a', '1 nan 3 4') + scalars('b', '1 2 3 4'))
def read(reader, name):
	reader.SetFileName(name)
	reader.Update()
	data = reader.GetOutput().GetPointData()
	return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).tolist() for i in range(data.GetNumberOfArrays())}, reader.GetErrorCode()
legacy = vtk.vtkStructuredPointsReader()
legacy.ReadAllScalarsOn()
xml, old = read(vtk.vtkXMLImageDataReader(), 'gap.vti'), read(legacy, 'gap.vtk')
print(f'VTK {vtk.vtkVersion.GetVTKVersion()}: XML {xml}; legacy: columns {list(old[0])}, first value {old[0]["a"][0]}, error code {old[1]}')
isRight = lambda found: np.array_equal(found.get('a', []), [1, np.nan, 3, 4], equal_nan=True) and 'b' in found
sys.exit(not isRight(xml[0]) or isRight(old[0]) or old[1] != 0)
SCRIPT
