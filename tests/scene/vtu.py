# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads the files that the recorder writes for ParaView."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


class Vtu:
	"""A .vtu file as NumPy arrays."""

	def __init__(self, path):
		reader = vtkXMLUnstructuredGridReader()
		reader.SetFileName(str(path))
		reader.Update()
		assert reader.GetErrorCode() == 0, path
		self.cells = reader.GetOutput()
		about, times = reader.GetOutputInformation(0), reader.GetExecutive().TIME_STEPS() # same calls as those of ParaView
		self.times = [about.Get(times, i) for i in range(about.Length(times))]
		data = self.cells.GetCellData()
		self.fields = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
		self.types = {self.cells.GetCellType(i) for i in range(len(self))}

	def __len__(self):
		return self.cells.GetNumberOfCells()

	@property
	def boxes(self):
		"""(N, 2, 3) lower and upper corners of the cells' bounding boxes."""
		return np.array([self.cells.GetCell(i).GetBounds() for i in range(len(self))]).reshape(-1, 3, 2).transpose(0, 2, 1)

	def sizes(self, quantity):
		"""'Area' or 'Volume' of each cell, which corners in a wrong order would change."""
		sizes = vtkCellSizeFilter()
		sizes.SetInputData(self.cells)
		sizes.Update()
		return vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray(quantity))
