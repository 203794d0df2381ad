# A state of ParaView, written by mpm.state: File, Load State; or paraview --state=<this file>
import os

from paraview.simple import *

# FACTS

if '__file__' in globals() and os.path.exists(os.path.join(os.path.dirname(os.path.abspath(__file__)), files['points'])): folder = os.path.dirname(os.path.abspath(__file__))
readers = {kind: PVDReader(registrationName=kind, FileName=os.path.join(folder, file)) for kind, file in files.items()}
view = GetActiveViewOrCreate('RenderView')
view.UseColorPaletteForBackground, view.Background, view.OrientationAxesLabelColor = 0, [1, 1, 1], [0, 0, 0]
view.ViewTime = readers['points'].TimestepValues[-1]
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()

shown = Calculator(registrationName=title, Input=readers['points'], AttributeType='Cell Data', ResultArrayName='shown', Function=formula)
display = Show(shown, view)
display.Representation = 'Surface'
ColorBy(display, ('CELLS', 'shown'))
table = GetColorTransferFunction('shown')
table.AutomaticRescaleRangeMode = 'Never'
table.ColorSpace, table.RGBPoints = 'RGB', colours
bar = GetScalarBar(table, view)
bar.Title, bar.ComponentTitle = title, ''
bar.TitleColor = bar.LabelColor = [0, 0, 0]
bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, '%.4g', '%.4g'
display.SetScalarBarVisibility(view, True)

for kind, reader in readers.items():
	if kind == 'points': continue
	other = Show(reader, view)
	other.Representation = 'Wireframe' if kind in ('grid', 'ghostFaces') else 'Surface'
	Hide(reader, view)
moment = AnnotateTimeFilter(registrationName='moment', Input=readers['points'], Format=moment)
Show(moment, view).Color = [0, 0, 0]

ResetCamera(view)
if isFlat: view.InteractionMode = '2D'
else:
	direction = [[0.5, -1, 0.55], [0.5, 0.55, 1], [0.45, -1, 0.55]][up]
	size = view.CameraParallelScale * 4
	view.CameraPosition = [x + size * d for x, d in zip(view.CameraFocalPoint, direction)]
	view.CameraViewUp = [float(axis == up) for axis in range(3)]
	ResetCamera(view)
SetActiveSource(shown)
