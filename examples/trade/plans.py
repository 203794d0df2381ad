# SPDX-License-Identifier: GPL-2.0-or-later
"""Plans of scripts/trade: scenes and their settings."""
import itertools
import os
from dataclasses import dataclass, field, replace

here = os.path.dirname(os.path.abspath(__file__))


@dataclass
class Plan:
	"""Runs of one script. Values of parameters are texts, as in a parameter table.

	:param parameters: all parameters with the values from which single ones are moved
	:param together: values of the parameters that are combined with each other
	:param alone: values of others, which are moved one by one
	:param around: settings in which they are moved
	:param errors: variables of the script that are errors
	:param words: what variables of the script are, where their name does not say it, and so parameters
	:param quantities: variables that are compared with those of the reference
	:param reference, check: parameters of the reference run, and of a coarser one that tells how far it is to be trusted
	:param quick: values of the combined parameters in the short form, whose reference is quickReference
	"""
	script: str
	parameters: dict
	together: dict
	alone: dict = field(default_factory=dict)
	around: list = field(default_factory=lambda: [{}])
	errors: list = field(default_factory=list)
	quantities: list = field(default_factory=list)
	reference: dict = None
	check: dict = None
	quick: dict = field(default_factory=dict)
	quickReference: dict = None
	words: dict = field(default_factory=dict)


def shortened(plan):
	return replace(plan, together=plan.quick, alone={}, reference=plan.quickReference, check=None)


def settings(plan):
	"""All runs of a plan."""
	runs = [plan.parameters | dict(zip(plan.together, combined)) for combined in itertools.product(*plan.together.values())]
	for name, values in plan.alone.items():
		runs += [plan.parameters | centre | {name: value} for centre in plan.around for value in values]
	runs += [plan.parameters | special for special in (plan.check, plan.reference) if special]
	distinct = {tuple(run.values()): run for run in runs}
	return list(distinct.values())


def ownPlan(options):
	"""Plan of a user's script, from the command line of scripts/trade."""
	vary = dict(options.vary)
	others = (options.reference or {}) | (options.check or {})
	parameters = {name: values[0] for name, values in vary.items()}
	for name in others:
		if name not in parameters: raise SystemExit(f'scripts/trade: {name} of the reference is not among the --vary parameters')
	return Plan(
	        script=os.path.abspath(options.scene[0]), parameters=parameters, together=vary, errors=options.error, quantities=options.quantity, reference=options.reference,
	        check=options.check)


def plan(scene, steps, centre, dim=2, **others):
	"""Plan of a scene in scenes.py; *centre* is the setting around which single parameters are moved."""
	parameters = dict(
	        scene=f"'{scene}'", dim=str(dim), cells='1', pointsPerCell='2', steps=steps, tolerance='1e-6', basis="'gimp'", ghostFactor='1e-2', scaling="'mesh-independent'",
	        predictor='True', threads='1')
	alone = dict(tolerance=['1e-1', '1e-2', '1e-3', '1e-4', '1e-9'], basis=["'mpm'"], ghostFactor=['0', '1e-4', '1', '100'], scaling=["'paper'"], predictor=['False'],
	             threads=['2'])
	return Plan(script=os.path.join(here, 'scenes.py'), parameters=parameters, alone=alone, around=[centre], **others)


def locking(scene, cells, words):
	"""Plan of a scene of examples/locking, with F-bar and without."""
	parameters = dict(scene=f"'{scene}'", cells='8', fBar='1', picture='0', out="'out'")
	return Plan(
	        script=os.path.join(here, '..', 'locking', 'locking.py'), parameters=parameters, together=dict(cells=cells, fBar=['0', '1']), errors=['error'],
	        quick=dict(cells=cells[:1], fBar=['0', '1']), words=words | dict(fBar='with F-bar'))


def contact(scene, steps, together, quick, words, **parameters):
	"""Plan of a scene of examples/penetration, through MpmContact."""
	parameters = dict(scene=f"'{scene}'", cells='4', pointsPerCell='2', stiffness='100', steps=steps, picture='0', out="'out'") | parameters
	return Plan(
	        script=os.path.join(here, '..', 'penetration', 'penetration.py'), parameters=parameters, together=together, errors=['error'], quick=quick,
	        words=dict(pointsPerCell='points per cell and axis') | words)


perMetre = dict(cells='cells in a metre', pointsPerCell='points per cell and axis')
perHeight = dict(cells='cells over the height', pointsPerCell='points per cell and axis', stressError='vertical stress, mean over all points')

plans = {
        'column':
                plan(
                        'column', '20', dict(cells='32'), errors=['stressError'], words=perHeight,
                        together=dict(cells=['4', '8', '16', '32', '64', '128'], pointsPerCell=['1', '2', '3'], steps=['5', '20', '80']),
                        quick=dict(cells=['4', '8'], pointsPerCell=['2'], steps=['5', '10'])),
        'column3d':
                plan(
                        'column', '20', dict(cells='16'), dim=3, errors=['stressError'], words=perHeight,
                        together=dict(cells=['4', '8', '16', '32'], pointsPerCell=['2', '3'], steps=['5', '20', '80']),
                        quick=dict(cells=['4'], pointsPerCell=['2'], steps=['5'])),
        'slope':
                plan(
                        'slope', '40', dict(cells='1'), quantities=['crest', 'toe'], words=perMetre | dict(crest='settlement of the crest', toe='run-out of the toe'),
                        together=dict(cells=['1', '2', '3'], pointsPerCell=['2', '3'], steps=['10', '40', '160']),
                        reference=dict(cells='4', steps='160'), check=dict(cells='3', steps='160'),
                        quick=dict(cells=['1'], pointsPerCell=['2'], steps=['10']), quickReference=dict(cells='1', steps='20')),
        'collapse':
                plan(
                        'collapse', '20', dict(cells='2'), quantities=['settlement', 'spread'], words=perMetre | dict(settlement='mean settlement', spread='mean run-out'),
                        together=dict(cells=['1', '2', '4'], pointsPerCell=['2', '3'], steps=['10', '20', '40', '80']),
                        reference=dict(cells='12', steps='80'), check=dict(cells='8', steps='80'),
                        quick=dict(cells=['1'], pointsPerCell=['2'], steps=['10']), quickReference=dict(cells='1', steps='20')),
        'cantilever':
                plan(
                        'cantilever', '20', dict(cells='2'), quantities=['tipX', 'tipY'],
                        words=perMetre | dict(tipX='displacement of the tip along x', tipY='along y'),
                        together=dict(cells=['1', '2', '4'], pointsPerCell=['2', '3', '4'], steps=['5', '20', '80']),
                        reference=dict(cells='8', pointsPerCell='3', steps='80'), check=dict(cells='4', pointsPerCell='3', steps='80'),
                        quick=dict(cells=['1'], pointsPerCell=['2'], steps=['5']), quickReference=dict(cells='2', steps='10')),
        'footing': locking('strip', ['4', '6', '8', '12', '16', '24'], dict(cells='cells over half the width', error='limit load')),
        'cut': locking('cut', ['5', '10', '20', '40'], dict(cells='cells over the height', error='stability number')),
        'sphere':
                contact(
                        'sphere', '5', dict(cells=['1', '2', '4', '6'], stiffness=['5', '20', '100', '1000'], steps=['2', '5'], pointsPerCell=['2', '3']),
                        dict(cells=['1', '2'], stiffness=['20']), dict(cells='cells over the radius of the contact', error='force')),
        'clay':
                replace(
                        contact(
                                'footing', '6', dict(cells=['2', '4', '8', '16'], stiffness=['5', '20', '100', '1000'], pointsPerCell=['2', '3']),
                                dict(cells=['2'], stiffness=['20']), dict(cells='cells over half the width', error='limit load', halvings='of the cells at its edge'), depth='0.03', halvings='0', accuracy='0.05'),
                        alone=dict(halvings=['1', '2', '3'], scene=["'accurate'"]), around=[dict(cells='2'), dict(cells='4'), dict(cells='8')]),
        'tbar':
                Plan(
                        script=os.path.join(here, '..', 'penetration', 'deep.py'), errors=['error'],
                        parameters=dict(scene="'tbar'", cells='4', pointsPerCell='3', depth='0.8', stiffness='10', stepsPerCell='8', picture='0', out="'out'"),
                        together=dict(cells=['2', '4'], stiffness=['5', '10', '20'], pointsPerCell=['2', '3']), alone=dict(stepsPerCell=['4', '16']),
                        quick=dict(cells=['2'], stiffness=['10'], pointsPerCell=['2']),
                        words=dict(cells='cells over the radius', pointsPerCell='points per cell and axis', stepsPerCell='steps while the bar moves by a cell', error='resistance')),
        'meeting':
                Plan(
                        script=os.path.join(here, 'meeting.py'), errors=['error'], parameters=dict(cells='4', pointsPerCell='2', stiffness='10', steps='3'),
                        together=dict(cells=['2', '4', '8'], stiffness=['5', '10', '20', '100'], steps=['3', '10'], pointsPerCell=['2', '3']),
                        quick=dict(cells=['2'], stiffness=['10'], steps=['3'], pointsPerCell=['2']),
                        words=dict(cells='cells over half the contact', pointsPerCell='points per cell and axis', error='half width and pressure, the larger one')),
        'seepage':
                Plan(
                        script=os.path.join(here, '..', 'water', 'water.py'), errors=['error'],
                        parameters=dict(scene="'seepage'", cells='10', pointsPerCell='2', tolerance='0.02', out="'out'"),
                        together=dict(cells=['5', '10', '20', '40'], pointsPerCell=['2', '3'], tolerance=['0.05', '0.02', '0.005']),
                        quick=dict(cells=['5'], pointsPerCell=['2'], tolerance=['0.05']),
                        words=dict(cells='cells over the height', pointsPerCell='points per cell and axis', tolerance='width of the bracket', error='factor of safety')),
        'consolidation':
                Plan(
                        script=os.path.join(here, '..', 'consolidation', 'consolidation.py'), errors=['error'],
                        parameters=dict(scene="'terzaghi'", cells='20', cut='0.5', steps='40', stabilisation='1', skin='30', out="'out'"),
                        together=dict(cells=['5', '10', '20', '40'], steps=['10', '20', '40', '80']),
                        alone=dict(cut=['0.1', '0.9'], stabilisation=['0', '0.1', '3'], skin=['3', '10', '100', '1000']), around=[dict(cells='10', steps='80'), dict(cells='20', steps='40')],
                        quick=dict(cells=['5'], steps=['10']),
                        words=dict(cells='cells over the height', steps='steps to T = 1', error='degree of consolidation from T = 0.02 on')),
        'rain':
                Plan(
                        script=os.path.join(here, '..', 'rain', 'rain.py'), errors=['error'], parameters=dict(scene="'rain'", cells='40', cut='0.5', longest='0.01', out="'out'"),
                        together=dict(cells=['10', '20', '40', '80'], longest=['0.04', '0.02', '0.01', '0.005', '0.0025']),
                        alone=dict(cut=['0.1', '0.9']), around=[dict(cells='20', longest='0.01')],
                        quick=dict(cells=['10'], longest=['0.04']),
                        words=dict(cells='cells over the height', longest='a quarter of the longest step, over the time', error='heads, over their range')),
        'circle':
                Plan(
                        script=os.path.join(here, '..', 'axisymmetric', 'axisymmetric.py'), errors=['error'], parameters=dict(scene="'rough'", cells='4', steps='16', out="'out'"),
                        together=dict(cells=['2', '4', '8', '16']), alone=dict(scene=["'circle'"]), around=[dict(cells='2'), dict(cells='4')], quick=dict(cells=['2']),
                        words=dict(cells='cells over the radius', error='limit load')),
        'beam': locking('beam', ['2', '4', '8', '16'], dict(cells='cells over the height', error='deflection')),
}
