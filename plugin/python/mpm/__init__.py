# SPDX-License-Identifier: GPL-2.0-or-later
"""Scene building and data access for the implicit, ghost-stabilised material point method.

The classes (``MpmImplicitEngine``, ``MpmGrid``, ``MpmVonMisesMat``, ...) live beside YADE's own; this module adds what
is written more easily in Python. A slope under its own weight, with a weak layer::

    from yade import mpm

    O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=15e3, label='soil'))
    O.materials.append(MpmVonMisesMat(young=1e6, poisson=0.3, density=2400, yieldStress=7.5e3, label='weak'))
    grid = MpmGrid(cellSize=0.5, dim=2)  # unbounded; dim=2 is plane strain in x-y

    profile = mpm.polygon([(0, 0), (30, 0), (30, 7), (15, 7), (10, 12), (0, 12)])
    O.bodies.append(mpm.fill(profile, grid, pointsPerCell=3, material=lambda x: 'weak' if 7 <= x[1] <= 7.5 else 'soil'))

    O.engines = [
        MpmImplicitEngine(
            grid=grid, gravity=(0, -9.81, 0), ghost=MpmGhost(factor=1e-2), newton=MpmNewton(tolerance=1e-6, maxIterations=20),
            boundaries=[MpmBoundary(max=(0, inf, inf), fix='x'),  # rollers left and right, the base is constrained
                        MpmBoundary(min=(30, -inf, -inf), fix='x'),
                        MpmBoundary(max=(inf, 0, inf), fix='xy')])]
    O.dt = 1 / 80  # quasi-static: O.time is the load factor, one O.iter is one load step
    O.run(80, wait=True)
    print(mpm.arrays()['pos'].min(axis=0))

While it runs, one line tells how far it is (``verbosity`` of the engine); ``plot.addData(**solver.plotData())`` feeds YADE's plots, from
``PyRunner(iterPeriod=1, initRun=True, command='plot.addData(**solver.plotData())')``. What else is here:

===========================  ==========================================================================================
:func:`polygon`              region of the x-y plane
:func:`solid`                region in a closed surface of an STL or GTS file
:class:`terrain`             region below a surface: an elevation grid (.asc, GeoTIFF), an array or a function; :func:`facets` makes it rock that does not yield
:func:`fill`                 material points in a region; :func:`add` puts them into the scene, of several processes each its own
:func:`refinementsAt`        boxes in which cells are halved, where something asks for it
:func:`arrays`               data of all material points as NumPy arrays; :func:`assign` is the way back
:func:`geostatic`            initial stress of level ground
:func:`seepage`              steady flow of water with a free surface, whose pressures an ``MpmWater`` takes
:func:`surface`              surface of a region, for loads on it
:func:`contactForces`        where rigid bodies are touched, and the forces there
:func:`sectionForces`        normal force, shear force and bending moment where a plane cuts a body of points
:func:`plot`                 picture by matplotlib, of plane strain or of a slice
:class:`movie`               film of a run
:class:`view`                a run in one HTML file, which any browser turns, cuts, colours and plays
:func:`colour`               colours of the points in YADE's 3D view
:func:`state`                state of ParaView that opens what MpmVtkRecorder has written
:func:`export`               table of the points, CSV or NPZ; :func:`frame` for pandas
:func:`collect`              the runs of a yade-batch in one table and picture, from what each writes by :func:`note`
:class:`histories`           values at chosen points over time and frequency; :func:`readHistory` reads one from a file
:class:`peaks`               largest values of a run at all points, as a field
:class:`record`              a record of an earthquake, corrected and integrated, as motion of a base
:func:`freeField`            edges of a body that is shaken, beyond which free ground moves by itself
:func:`rayleigh`             damping by mass and stiffness that has given ratios; :func:`schemeDamping` is the damping of the time steps themselves
:func:`save`                 the scene, whole or not at all; :func:`load` reads it, from several processes, too
:func:`advise`               what an analysis will cost, and what it could do without
:func:`discretisationError`  how wrong a result is because of the size of the cells; :func:`stressError` tells of stresses, from one run
:func:`untilAccurate`        a result that is as accurate as asked for, by cells that are halved again and again
:func:`elementTest`          the curve of a laboratory test on a material; :func:`respond` is one call of its law
:func:`checkLaw`             whether the tangent of a law, as of a user material, is that of its stress
:func:`calibrate`            parameters of a law from the curves of laboratory tests; :func:`typicalSand` has them where there are none
``stages``                   layers that are placed, soil that is dug out, supports that are taken away
:func:`strengthReduction`    factor of safety, as a bracket; :func:`safetyInTime` runs a scene and finds it at given times
:func:`examples`             scripts to begin from, by a word: mpm.examples('footing')
===========================  ==========================================================================================

Units are SI; stress is positive in tension; strains are logarithmic; plane strain is per metre of thickness.
"""
from yade import wrapper as _wrapper

from .base import processes
from . import ending
from .analysis.accuracy import untilAccurate
from .analysis.advice import advise
from .analysis.bending import sectionForces
from .analysis.darcy import seepage
from .analysis.discretisation import discretisationError, stressError
from .analysis.failing import safetyInTime
from .analysis.safety import strengthReduction
from .base.naming import didYouMean as _didYouMean, telling as _telling, tellShortNames as _tellShortNames
from .earthquake.damping import rayleigh, schemeDamping
from .earthquake.freefields import freeField
from .earthquake.records import record
from .finding import examples
from .geometry.cells import refinementsAt
from .geometry.outline import polygon
from .geometry.solids import solid
from .geometry.surfaces import surface
from .geometry.terrains import facets, terrain
from .laboratory.calibration import calibrate
from .laboratory.lawchecks import checkLaw
from .laboratory.tests import elementTest, respond
from .laboratory.typical import typicalSand
from .library import engine as _engine
from .output.collecting import collect, note
from .output.colouring import colour
from .output.diagrams import diagram
from .output.histories import histories, readHistory
from .output.movies import movie
from .output.paraview import state
from .output.peaks import peaks
from .output.plotting import plot
from .output.viewing import view
from .points import stages
from .points.data import arrays, assign, contactForces
from .points.files import load, save
from .points.filling import add, fill
from .points.geostatics import geostatic
from .points.tables import export, frame

__version__ = _engine.version
__all__ = ['polygon', 'fill', 'add', 'refinementsAt', 'arrays', 'assign', 'geostatic', 'seepage', 'plot', 'diagram', 'colour', 'export', 'save', 'load', 'advise', 'discretisationError', 'stressError', 'untilAccurate', 'elementTest', 'respond', 'checkLaw', 'strengthReduction', 'safetyInTime', 'surface', 'contactForces', 'histories', 'readHistory', 'solid', 'terrain', 'movie', 'view', 'facets', 'frame', 'note', 'collect', 'state', 'examples', 'record', 'peaks', 'freeField', 'rayleigh', 'schemeDamping', 'calibrate', 'typicalSand', 'sectionForces']

for _name in __all__:
	_thing = globals()[_name] = _telling(globals()[_name])
	_thing.__module__ = __name__  # the name by which it is found
for _name in stages.__all__:
	setattr(stages, _name, _telling(getattr(stages, _name)))

_tellShortNames([name for name in dir(_wrapper) if name.startswith('Mpm')])


def __getattr__(name):
	if name.startswith('_'): raise AttributeError(f"module 'yade.mpm' has no attribute {name!r}")
	classes = [known for known in dir(_wrapper) if known.startswith('Mpm')]
	if name in classes: raise AttributeError(f"module 'yade.mpm' has no attribute {name!r}: the classes are beside YADE's own, so write {name}(...) without mpm.")
	meant = _didYouMean(name, __all__ + ['stages'])
	if name in stages.__all__: meant = f"; did you mean 'mpm.stages.{name}'?"
	elif name.startswith('Mpm'): meant = _didYouMean(name, classes)
	raise AttributeError(f"module 'yade.mpm' has no attribute {name!r}{meant}")
