# SPDX-License-Identifier: GPL-2.0-or-later
"""usage: pvbatch scripts/paraview-picture.py [options] <prefix>

Makes a picture with ParaView of what MpmVtkRecorder has written with fileName=<prefix>, such as out/slope-: the domains of the material
points, coloured by one of their fields, and, if there are files of them, the background grid with its boundary cells and the ghost
faces; with --spheres DEM grains in front of them. With --state the same can be opened in ParaView, to go on from there.

pvbatch is in Debian's package paraview, and its Python modules in python3-paraview; without a screen: xvfb-run -a pvbatch ...
"""
import argparse
import glob
import math
import os
import re
import sys

import paraview.simple
from paraview.simple import *

kilopascals = 'stress', 'meanStress', 'sqrt2J2'
units = {field: 'kPa' for field in kilopascals} | {'displacement': 'm', 'plasticStrain': '-', 'volume': 'm3', 'material': '-', 'id': '-'}
components = {'displacement': ['x', 'y', 'z'], 'stress': [a + b for a in 'xyz' for b in 'xyz']}
grey, orange, tint, black, grain = [0.53, 0.56, 0.59], [0.85, 0.28, 0.06], [1, 0.91, 0.8], [0, 0, 0], [0.85, 0.75, 0.6]


def arguments():
	usage, description = __doc__.split('\n\n', 1)
	parser = argparse.ArgumentParser(usage=usage[7:], description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
	parser.add_argument('prefix', help='start of the files, the fileName of the MpmVtkRecorder')
	parser.add_argument('--field', default='stress_xy', help='of the points, with its component: stress_xy, displacement (its length), displacement_y, plasticStrain, ... (default %(default)s)')
	parser.add_argument('--range', type=float, nargs=2, metavar=('LOW', 'HIGH'), help='of the colours, in the unit of the colour bar (default: that of the values)')
	parser.add_argument('--time', type=float, help='load time of the state (default: the last)')
	parser.add_argument('--spheres', metavar='FILE', help='series of the files that YADE\'s VTKRecorder has written with recorders=["spheres"] (.pvd)')
	parser.add_argument('--up', choices='xyz', default='y', help='axis that points upwards in a three-dimensional picture (default %(default)s)')
	parser.add_argument('--turn', type=float, default=0, metavar='DEGREES', help='turn a three-dimensional body about that axis: 180 shows its other side')
	parser.add_argument('--width', type=int, default=1600, help='of the picture [pixels] (default %(default)s)')
	parser.add_argument('--out', help='picture (default: <prefix>paraview.png)')
	parser.add_argument('--state', help='also write a state of ParaView to this file (.pvsm)')
	return parser.parse_args([re.sub(r'^--(?=[.\d])', '-', word) for word in sys.argv[1:]])  # pvbatch writes -12 as --12


def opened(prefix, kind):
	"""The series of files of one kind, or None."""
	file = f'{prefix}{kind}.pvd'
	return PVDReader(registrationName=kind, FileName=os.path.abspath(file)) if os.path.exists(file) else None


def formula(name):
	"""Expression of ParaView's calculator for a field's name: 'stress_xy' -> '"stress_1" / 1000'."""
	field, _, component = name.partition('_')
	if field not in units: sys.exit(f'paraview-picture.py: there is no field {field}; there are {", ".join(units)}')
	if field == 'displacement' and not component: return 'mag(displacement)'
	admitted = components.get(field, [''])
	if component not in admitted: sys.exit(f'paraview-picture.py: {name}: {field} has {"the components " + ", ".join(admitted) if admitted[0] else "no components"}')
	return f'"{field}_{component.upper() if field == "displacement" else admitted.index(component)}"' * bool(component) + field * (not component) + ' / 1000' * (field in kilopascals)


def hasSign(name):
	return 'tress' in name or name.startswith('displacement_')


def shades(name, low, high):
	"""Values and colours as those of mpm.plot: zero is white where a quantity has a sign."""
	from matplotlib import colormaps
	shares = [i / 32 for i in range(33)]
	ends = [x / max(abs(low), abs(high)) for x in (low, high)] if hasSign(name) else [-1, 1]
	if ends[0] * ends[1] > 0: ends = [math.copysign(min(abs(x), 0.25), x) if abs(x) < 1 else x for x in ends]
	chosen = colormaps['RdBu_r' if hasSign(name) else 'YlOrRd' if name == 'plasticStrain' else 'viridis']
	return [x for s in shares for x in (low + s * (high - low), *chosen((1 + ends[0] + s * (ends[1] - ends[0])) / 2)[:3])]


def colour(points, name, limits, view):
	"""Shows the points with their colours and a bar that explains them."""
	shown = Calculator(registrationName=name, Input=points, AttributeType='Cell Data', ResultArrayName='shown', Function=formula(name))
	shown.UpdatePipeline(view.ViewTime)
	display = Show(shown, view)
	display.Representation = 'Surface'
	display.Ambient, display.Diffuse = 0.6, 0.4
	ColorBy(display, ('CELLS', 'shown'))
	low, high = limits or shown.CellData['shown'].GetRange()
	isSigned = hasSign(name)
	if low < 0 < high and isSigned and not limits: low, high = -max(-low, high), max(-low, high)
	colours = GetColorTransferFunction('shown')
	colours.ColorSpace, colours.RGBPoints = 'RGB', shades(name, low, high if high > low else low + 1)
	bar = GetScalarBar(colours, view)
	bar.Title, bar.ComponentTitle = f'{name} ({units[name.partition("_")[0]]})', ''
	bar.TitleColor = bar.LabelColor = black
	bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, '%.3g', '%.3g'
	display.SetScalarBarVisibility(view, True)
	return shown


def lines(source, view, colour, width, lift):
	display = Show(source, view)
	display.Representation = 'Wireframe'
	display.ColorArrayName = ['POINTS', '']
	display.AmbientColor = display.DiffuseColor = colour
	display.LineWidth = width
	display.Position = [0, 0, lift]


def showGrid(prefix, view, lift):
	"""*lift*: what lies in one plane is drawn this far apart, behind and before the points."""
	grid, faces = opened(prefix, 'grid'), opened(prefix, 'ghostFaces')
	if grid: lines(grid, view, grey, 1, lift)
	if grid and lift:
		boundary = Threshold(registrationName='boundary cells', Input=grid, Scalars=['CELLS', 'boundary'], LowerThreshold=1, UpperThreshold=1)
		display = Show(boundary, view)
		display.ColorArrayName = ['POINTS', '']
		display.AmbientColor = display.DiffuseColor = tint
		display.Ambient, display.Diffuse, display.Position = 1, 0, [0, 0, -lift]
	if faces: lines(faces, view, orange, 3, 2 * lift)


def showSpheres(file, view, lift):
	"""Draws grains as translucent discs or spheres, so that what is behind them can be compared with them."""
	grains = PVDReader(registrationName='spheres', FileName=os.path.abspath(file))
	drawn = Glyph(registrationName='grains', Input=grains, GlyphType='Sphere', ScaleArray=['POINTS', 'radii'], ScaleFactor=2, GlyphMode='All Points')
	drawn.GlyphType.ThetaResolution = drawn.GlyphType.PhiResolution = 24
	display = Show(drawn, view)
	display.ColorArrayName = ['POINTS', '']
	display.AmbientColor = display.DiffuseColor = grain
	display.Opacity, display.Position = 0.5, [0, 0, lift]


def lookAt(view, bounds, up, turn, width):
	"""The plane x-y from in front, or a body in space from a corner, turned by an angle about the axis *up*; returns the size of the picture."""
	sides = [bounds[2 * a + 1] - bounds[2 * a] for a in range(3)]
	middle = [(bounds[2 * a + 1] + bounds[2 * a]) / 2 for a in range(3)]
	view.CameraParallelProjection = 1
	if sides[2] == 0:
		view.InteractionMode = '2D'
		size = [width, int(width * min(1.5, max(0.3, 1.1 * sides[1] / sides[0] + 0.05)))]
		towards, upwards = [0, 0, 1], [0, 1, 0]
		height = max(1.12 * sides[1], 1.25 * sides[0] * size[1] / width)
	else:
		size, height = [width, int(0.75 * width)], 1.1 * sum(side**2 for side in sides)**0.5
		upwards = [axis == up for axis in 'xyz']
		towards = [0.45 if u else s for u, s in zip(upwards, (1, 0.9, 0.8))]
		a, b = (axis for axis in range(3) if not upwards[axis])
		cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
		towards[a], towards[b] = cosine * towards[a] - sine * towards[b], sine * towards[a] + cosine * towards[b]
	view.CameraFocalPoint, view.CameraViewUp, view.CameraParallelScale = middle, [float(u) for u in upwards], height / 2
	view.CameraPosition = [m + 10 * sum(sides) * t for m, t in zip(middle, towards)]
	return size


def main():
	options = arguments()
	points = opened(options.prefix, 'points')
	if options.spheres and not os.path.exists(options.spheres): sys.exit(f'paraview-picture.py: there is no {options.spheres}')
	if not points: sys.exit(f'paraview-picture.py: there is no {options.prefix}points.pvd; there are {glob.glob(options.prefix + "*.pvd") or "no files of that start"}')
	paraview.simple._DisableFirstRenderCameraReset()
	view = CreateRenderView(UseColorPaletteForBackground=0, Background=[1, 1, 1], OrientationAxesLabelColor=black)
	view.ViewTime = points.TimestepValues[-1] if options.time is None else options.time
	bounds = colour(points, options.field, options.range, view).GetDataInformation().GetBounds()
	view.ViewSize = lookAt(view, bounds, options.up, options.turn, options.width)
	showGrid(options.prefix, view, 1e-3 * (bounds[1] - bounds[0]) if bounds[4] == bounds[5] else 0)
	if options.spheres: showSpheres(options.spheres, view, (bounds[1] - bounds[0]) if bounds[4] == bounds[5] else 0)
	note = Show(Text(Text=f'load time {view.ViewTime:g}'), view)
	note.Color, note.WindowLocation = black, 'Upper Left Corner'
	picture = options.out or f'{options.prefix}paraview.png'
	SaveScreenshot(picture, view)
	print('written:', picture)
	if options.state:
		SaveState(options.state)
		print('written:', options.state)


main()
