# SPDX-License-Identifier: GPL-2.0-or-later
"""The axes of the stability atlas: which parameter is driven to which extremes. Plain Python, read by the driver, the runs and the page."""

ghosts = ['none', 'mesh-independent', 'paper'] # the last two are scalings


class Axis:
	"""One parameter and the values it takes.

	:param title: of the parameter, with its unit
	:param values: numbers or texts, from harmless to extreme
	:param dims: dimensions in which it is run
	:param quick: values of the short form
	:param ghosts: kinds of stabilisation
	:param listed: whether it has a place of its own in the tables and maps
	"""

	def __init__(self, title, values, dims=(2, 3), quick=(), ghosts=ghosts, listed=True):
		self.title, self.values, self.dims, self.quick, self.ghosts, self.listed = title, values, dims, quick, ghosts, listed


groups = { # a map of outcomes for each
        'grid': ('Grid and points', ['overlap', 'factor', 'length', 'points', 'jitter', 'missing', 'thin', 'slender']),
        'material': ('Material', ['poisson', 'contrast', 'mixed', 'yield', 'tresca', 'softening', 'young']),
        'friction': ('Friction', ['friction', 'frictionCone', 'dilation', 'cohesion']),
        'soils': ('Cam clay and sand', ['camClay', 'camClayFooting', 'sandSlope']),
        'laws': ('Hardening, softening and rates', ['hardeningPower', 'hardeningUnloading', 'hardeningFriction', 'smallStrain', 'norSandState', 'norSandHardening', 'softeningStrain', 'power', 'powerFooting', 'viscosity', 'relaxationTime']),
        'water': ('Water', ['waterWeight', 'waterLevel']),
        'flow': ('Water that flows', ['flowStep', 'flowCut', 'flowPorosity', 'suction', 'suctionPores', 'suctionCut']),
        'locking': ('F-bar', ['overlapFBar', 'yieldFBar', 'bending', 'bendingFBar', 'compressionFBar']),
        'contact': ('Contact', ['contactPenalty', 'contactFriction', 'contactSteps', 'contactThin', 'contactHeight', 'contactRadius', 'contactClamped']),
        'meeting': ('Bodies of points that meet', ['meetingRatio', 'meetingPenalty', 'meetingFriction', 'meetingStep', 'meetingThin']),
        'inertia': ('Inertia', ['inertiaCut', 'inertiaCutExplicit', 'massFactor', 'timeStep', 'rhoInfinity']),
        'motion': ('Load and motion', ['strain', 'steps', 'compression', 'free', 'turns', 'turnStep']),
}


def powers(first, last, step=1):
	return [float(f'1e{i}') for i in range(first, last + (1 if step > 0 else -1), step)]


factors = [1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.]
nearHalf = [0., .3, .45, .49, .499, .4999, .49999, .499999]
compressed = [.9, .7, .5, .3, .2, .15, .1, .07, .05]
angles = [1., 5., 10., 20., 30., 40., 45.]
ratios = [1., 1.5, 2., 3., 5., 10., 20.]
corners = [0, .5, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8]

axes = {
        'overlap': Axis('overlap of the body with its outermost cells [h]', powers(-1, -15, -1), quick=[1e-3, 1e-12]),
        'factor': Axis('ghost factor, overlap 1e-4 h [-]', powers(-12, 3), quick=[1e-12, 1e-2], ghosts=ghosts[1:]),
        'poisson': Axis("Poisson's ratio [-]", [-.99, -.9, -.5, 0., .3, .45, .49, .499, .4999, .499999], quick=[.4999]),
        'contrast': Axis('stiffness of every other layer of cells over the rest, small strains [-]', powers(0, 16, 2), quick=[1e8]),
        'mixed': Axis('the same, but the layers move through the grid [-]', powers(0, 8), quick=[1e2]),
        'yield': Axis("yield stress over Young's modulus [-]", powers(0, -8, -1) + [1e-12, 1e-16], quick=[1e-6]),
        'length': Axis('size of a cell [m]', powers(-7, 7, 1), quick=[1e-6]),
        'young': Axis("Young's modulus [Pa]", powers(-6, 15, 3), quick=[1e12]),
        'strain': Axis('strain that the load causes [-]', powers(0, -18, -2) + [1e-30, 1e-100], quick=[1e-12]),
        'steps': Axis('load steps to half the height', [1, 2, 3, 5, 10, 30, 100, 300, 1000], dims=(2, ), quick=[10]),
        'points': Axis('points per cell and axis', [1, 2, 3, 4, 6, 8], quick=[1]),
        'jitter': Axis('random shift of points [half of their spacing]', [0., .1, .25, .5, .75, 1.], quick=[.5]),
        'missing': Axis('share of points taken out at random [-]', [0., .05, .1, .2, .3, .4, .5, .6, .7, .8, .9], quick=[.5]),
        'compression': Axis('height after loading over the one before, between walls [-]', compressed, quick=[.3]),
        'free': Axis('the same without walls: the column may buckle [-]', [.9, .7, .5, .3, .2, .15, .1], quick=[.3]),
        'turns': Axis('turns of a bar, 24 steps each', [.25, .5, 1., 2., 4., 8.], quick=[.25]),
        'turnStep': Axis('rotation of a bar in one step [degrees]', [1., 5., 15., 30., 45., 60., 75., 90.], dims=(2, ), quick=[15.]),
        'thin': Axis('columns of points / points per cell along x', ['2/2', '1/1', '1/2', '1/4', '1/8', '2/4', '2/8', '4/8'], quick=['1/2']),
        'slender': Axis('length of a bar of one cell thickness [cells]', [4, 16, 64, 256, 1024, 4096], dims=(2, ), quick=[4]),
        'overlapFBar': Axis('overlap, with F-bar [h]', powers(-1, -15, -1), quick=[1e-6], ghosts=ghosts[1:]),
        'yieldFBar': Axis("yield stress over Young's modulus, with F-bar [-]", powers(0, -8, -1) + [1e-12, 1e-16], quick=[1e-6], ghosts=ghosts[1:]),
        'bending': Axis("Poisson's ratio of a bar that bends, 4 cells thick and 32 long [-]", nearHalf, dims=(2, ), quick=[.499]),
        'bendingFBar': Axis('the same with F-bar [-]', nearHalf, dims=(2, ), quick=[.499], ghosts=ghosts[1:]),
        'compressionFBar': Axis('height after loading over the one before, between walls, with F-bar [-]', compressed, quick=[.3], ghosts=ghosts[1:]),
        'friction': Axis('friction angle of Mohr-Coulomb, no cohesion, no dilation [degrees]', angles, quick=[45.]),
        'frictionCone': Axis('the same of Drucker-Prager [degrees]', angles, quick=[45.]),
        'dilation': Axis('dilation angle, friction angle 45 degrees, no cohesion [degrees]', [0., 5., 10., 20., 30., 45.], quick=[0.]),
        'cohesion': Axis("cohesion over Young's modulus, friction angle 30 degrees [-]", powers(-1, -8, -1) + [0.], quick=[0.]),
        'softening': Axis("softening over Young's modulus, yield stress 1e-2 of it [-]", [0., 1e-4, 1e-3, 1e-2, .1, .3, .6, .9], quick=[.1]),
        'tresca': Axis("undrained strength over Young's modulus, Tresca [-]", powers(0, -8, -1) + [1e-12, 1e-16], quick=[1e-6]),
        'camClay': Axis('overconsolidation ratio of Cam clay, weight tripled [-]', ratios, quick=[20.]),
        'camClayFooting': Axis('the same, under a footing [-]', ratios, quick=[20.]),
        'sandSlope': Axis('angle of a slope of sand of 35 degrees / cohesion', [f'{a}/{c:g}' for c in (0., 1e-3) for a in (10, 20, 25, 30, 33, 35, 40)], dims=(2, ), quick=['25/0']),
        'hardeningPower': Axis('power of the pressure in moduli of hardening soil, weight tripled [-]', [0., .1, .3, .5, .7, .9, 1.], dims=(2, ), quick=[1.]),
        'hardeningUnloading': Axis('modulus of unloading of hardening soil over E50 [-]', [1.5, 2., 3., 5., 10., 100., 1e3, 1e4], dims=(2, ), quick=[10.]),
        'hardeningFriction': Axis('friction angle of hardening soil under a footing [degrees]', [5., 10., 20., 30., 40., 50., 60., 80.], dims=(2, ), quick=[40.]),
        'smallStrain': Axis('strain at which small-strain stiffness has fallen to 0.72, under a footing [-]', powers(-1, -9, -1), dims=(2, ), quick=[1e-4]),
        'norSandState': Axis('state parameter of NorSand at 10 kPa, under a footing [-]', [-.05, -.1, -.2, -.3, -.4, 0., .05, .1, .2], dims=(2, ), quick=[-.1]),
        'norSandHardening': Axis('hardening modulus of NorSand, under a footing [-]', [100., 30., 10., 3., 1., .1, 300., 1e3, 1e4, 1e6], dims=(2, ), quick=[100.]),
        'softeningStrain': Axis('plastic strain over which cohesion is lost, under a footing [-]', powers(1, -8, -1), dims=(2, ), quick=[.1]),
        'power': Axis('power of the pressure in moduli of Mohr-Coulomb, weight tripled [-]', [0., 1e-12, 1e-6, 1e-3, .1, .3, .5, .7, .9, .99, .999, .999999], dims=(2, ), quick=[.5]),
        'powerFooting': Axis('the same, under a footing [-]', [0., 1e-12, 1e-6, 1e-3, .1, .3, .5, .7, .9, .99, .999, .999999], dims=(2, ), quick=[.5]),
        'viscosity': Axis("viscosity over E and the length of a step, von Mises [-]", [0., *powers(-9, 9, 3)], dims=(2, ), quick=[1.]),
        'relaxationTime': Axis('relaxation time over the length of a step, von Mises [-]', powers(-9, 9, 3), dims=(2, ), quick=[1.]),
        'waterWeight': Axis('weight of water over that of the soil, by volume, far above the column [-]', [0., .1, .3, .5, .7, .9, .99, 1., 1.01, 1.5, 2.], quick=[.5]),
        'waterLevel': Axis('level of water of half the weight over the height of the column, strain 1e-3 [-]', [1e-12, 1e-6, 1e-3, .1, .25, .5, .501, 1., 10., 1e3, 1e6, 1e9], quick=[.501]),
        'flowStep': Axis('time step over that in which pressures spread over a cell: conductivity [-]', powers(-8, 4), quick=[1e-6]),
        'flowCut': Axis('overlap of a body that drains with its outermost cells, a hundredth of that time a step [h]', powers(-1, -9, -2), quick=[1e-5]),
        'flowPorosity': Axis('porosity of soil that is strained by 0.02, and lets through as Kozeny and Carman have it [-]', [.011, .02, .03, .05, .1, .3, .5, .9, .99, .999], quick=[.1]),
        'suction': Axis('suction of a dry column on which water stands, over its height and the inverse of alpha [-]', powers(-1, 6), quick=[10.]),
        'suctionPores': Axis("van Genuchten's n of that column, suction 10 [-]", [1.1, 1.3, 1.6, 2., 3., 5., 8.], quick=[3.]),
        'suctionCut': Axis('overlap of that column with its outermost cells, suction 10 [h]', powers(-1, -9, -2), quick=[1e-5]),
        'softeningGrid': Axis('cells over the width of a block that softens / softening', [f'{n}/{kind}' for kind in ('none', 'same', 'scaled') for n in (8, 16, 32)], dims=(2, ), quick=['8/same'], ghosts=ghosts[1:2], listed=False),
        'contactPenalty': Axis('stiffness of a contact; a plate presses a block to 0.75 of its height [-]', powers(-1, 6), quick=[1e2]),
        'contactFriction': Axis('friction angle of a plate that is dragged over a block [degrees]', [0., 1., 5., 10., 20., 30., 40., 45.], quick=[30.]),
        'contactSteps': Axis('load steps in which a plate presses a block to half its height', [1, 2, 3, 5, 10, 30, 100], dims=(2, ), quick=[10]),
        'contactThin': Axis('thickness of a plate over how far it moves in a step, a tenth of a cell [-]', [20., 5., 2., 1., .5, .2, .1, .01], dims=(2, ), quick=[1.]),
        'contactHeight': Axis('height of a pressed block over the one before, Poisson 0.3 [-]', [.9, .7, .5, .3, .2, .15, .1], dims=(2, ), quick=[.5]),
        'contactRadius': Axis('cells over the radius of the contact of a sphere, 0.1 R, axisymmetric', [.5, 1, 2, 3, 4, 6, 8], dims=(2, ), quick=[1]),
        'contactClamped': Axis('points per cell and axis of a block that grows by a quarter up to a wall', [1, 2, 3, 4], dims=(2, ), quick=[2]),
        'meetingRatio': Axis('modulus of a body over that of the one on which it stands [-]', powers(0, 12, 2), dims=(2, ), quick=[1e4]),
        'meetingPenalty': Axis('stiffness of the contact of these two [-]', powers(-2, 6), dims=(2, ), quick=[10.]),
        'meetingFriction': Axis('friction angle of a block on a slope of 45 degrees [degrees]', [0., 10., 30., 44., 45., 46., 60., 80., 89., 89.9], dims=(2, ), quick=[30.]),
        'meetingStep': Axis('cells by which a block flies in a step until it meets another one [-]', [.05, .1, .25, .5, 1., 2., 4.], dims=(2, ), quick=[.25]),
        'meetingThin': Axis('rows of points / points per cell along y of a body on another one', ['2/2', '1/2', '2/4', '1/4', '2/8', '1/8', '1/16'], dims=(2, ), quick=['1/2']),
        'inertiaCut': Axis('overlap of a vibrating bar with its outermost cells, half a cell a step [h]', powers(-1, -15, -2), quick=[1e-3]),
        'inertiaCutExplicit': Axis('the same in explicit steps of a quarter of a cell [h]', powers(-1, -15, -2), quick=[1e-3]),
        'massFactor': Axis('ghost mass over the density, overlap 1e-3 h, half a cell a step [-]', [0., *powers(-6, 1)], quick=[1e-3], ghosts=ghosts[1:]),
        'timeStep': Axis('cells that sound passes in a step [-]', powers(-4, 4), quick=[10.]),
        'rhoInfinity': Axis('spectral radius of generalised alpha, half a cell a step [-]', [0., .2, .5, .8, .9, 1.], dims=(2, ), quick=[.8]),
        'columnFactor': Axis('cells over the height of a column that shrinks to half of it / ghost factor', [f'{n}/{f:g}' for n in (8, 32, 128) for f in factors], dims=(2, ), quick=['8/0.01'], ghosts=ghosts[1:2], listed=False),
        'slopeFactor': Axis('cells in a metre of the slope / ghost factor', [f'{n}/{f:g}' for n in (1, 2) for f in factors], dims=(2, ), ghosts=ghosts[1:2], listed=False),
        'corner': Axis('overlap along x / along y [h]', [f'{x:g}/{y:g}' for x in corners for y in corners], dims=(2, ), quick=['0.001/0.1'], listed=False),
}


def cases(names, quick):
	"""Keys of all runs: (axis, dim, ghost, value)."""
	for name in names:
		axis = axes[name]
		for dim in axis.dims[:1] if quick else axis.dims:
			for ghost in axis.ghosts:
				for value in axis.quick if quick else axis.values:
					yield name, dim, ghost, value
