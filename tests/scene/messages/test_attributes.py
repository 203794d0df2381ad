# SPDX-License-Identifier: GPL-2.0-or-later
"""Every attribute of every class of the plugin, set to what it cannot mean; the list is the classes' own, so none can be forgotten.

What is refused at once names itself. What is admitted goes into a scene: its step then ends with a finite state, or with a reason.
The environment variable BAD_INPUT_TABLE names a file for the outcomes, as a table in Markdown.
"""
import json
import os
import subprocess

import pytest
from conftest import Yade, root

# Values beyond the limits, as Python text. None: there are no limits beside being finite, or of the kind that the
# attribute has.
outOfRange = {
        'MpmMaterial.density': ['0.', '-1.'],
        'MpmMaterial.undrained': None,
        'MpmMaterial.waterModulus': ['0.', '-1.'],
        'MpmMaterial.conductivity': ['-1e-9', '(1e-9, -1e-9)', '(0, 1e-9)', '(inf, 1e-9)'],
        'MpmMaterial.porosity': ['0.', '1.', '40.'],
        'MpmMaterial.conductivityLaw': ['"Kozeny-Carman"'],
        'MpmMaterial.conductivityIndex': ['0.', '-1.'],
        'MpmMaterial.relaxationTime': ['0.', '-1.'],
        'MpmMaterial.retention': None,
        'MpmRetention.residual': ['-0.1', '1.'],
        'MpmRetention.voidExponent': ['-1.'],
        'MpmRetention.saturated': ['0.', '1.1'],
        'MpmRetention.permeabilities': ['[(0, 0.9)]', '[(1, 1)]', '[(0, 1), (0, 0.5)]'],
        'MpmVanGenuchten.alpha': ['0.', '-1.'],
        'MpmVanGenuchten.n': ['1.', '0.5'],
        'MpmVanGenuchten.permeability': ['"burdine"'],
        'MpmGardner.alpha': ['0.', '-1.'],
        'MpmBrooksCorey.entry': ['0.', '-1.'],
        'MpmBrooksCorey.exponent': ['0.', '-1.'],
        'MpmBrooksCorey.permeability': ['"burdine"'],
        'MpmRetentionTable.saturations': ['[(0, 1)]', '[(0, 0.5), (1, 0.7)]', '[(1, 1), (2, 0.7)]'],
        'MpmElasticMat.young': ['0.', '-1.'],
        'MpmElasticMat.poisson': ['-1.', '0.5', '7.'],
        'MpmVonMisesMat.yieldStress': ['0.', '-1.'],
        'MpmVonMisesMat.hardening': None,
        'MpmVonMisesMat.residualYieldStress': ['-1.'],
        'MpmVonMisesMat.viscosity': ['-1.'],
        'MpmTrescaMat.undrainedStrength': ['0.', '-1.'],
        'MpmFrictionalMat.cohesion': ['-1.'],
        'MpmFrictionalMat.frictionAngle': ['-0.1', '30.', '1.5708'],
        'MpmFrictionalMat.dilationAngle': ['-0.1', '10.', '1.5708'],
        'MpmFrictionalMat.tensileStrength': ['-1.'],
        'MpmFrictionalMat.power': ['-0.1', '.999'],
        'MpmFrictionalMat.referencePressure': ['0.', '-1.'],
        'MpmDruckerPragerMat.match': ['"plane strain"', '"tension"'],
        'MpmDruckerPragerMat.viscosity': ['-1.'],
        'MpmMohrCoulombMat.residualCohesion': ['-1.'],
        'MpmMohrCoulombMat.residualFrictionAngle': ['-0.1', '30.', '1.5708'],
        'MpmMohrCoulombMat.residualDilationAngle': ['-0.1', '10.', '1.5708'],
        'MpmMohrCoulombMat.softeningStrain': ['0.', '-1.'],
        'MpmHardeningSoilMat.E50ref': ['0.', '-1.'],
        'MpmHardeningSoilMat.Eoedref': ['0.', '-1.'],
        'MpmHardeningSoilMat.Eurref': ['0.', '-1.'],
        'MpmHardeningSoilMat.poisson': ['-0.1', '0.5'],
        'MpmHardeningSoilMat.power': ['-0.1', '1.1'],
        'MpmHardeningSoilMat.failureRatio': ['-0.1', '1.'],
        'MpmHardeningSoilMat.K0nc': ['0.', '1.'],
        'MpmHardeningSoilMat.referencePressure': ['0.', '-1.'],
        'MpmHardeningSoilMat.cohesion': ['-1.'],
        'MpmHardeningSoilMat.frictionAngle': ['0.', '30.', '1.5708'],
        'MpmHardeningSoilMat.dilationAngle': ['-0.1', '10.', '1.5708'],
        'MpmHardeningSoilMat.mostDilation': ['0.', '-1.'],
        'MpmHardeningSoilMat.G0ref': ['0.', '-1.'],
        'MpmHardeningSoilMat.gamma07': ['0.', '-1.'],
        'MpmNorSandMat.shearModulus': ['0.', '-1.'],
        'MpmNorSandMat.swellingIndex': ['0.', '-1.'],
        'MpmNorSandMat.referencePressure': ['0.', '-1.'],
        'MpmNorSandMat.criticalStateRatio': ['0.', '-1.'],
        'MpmNorSandMat.compressionIndex': ['0.', '-1.'],
        'MpmNorSandMat.criticalVolume': ['1.', '0.9'],
        'MpmNorSandMat.criticalPressure': ['0.', '-1.'],
        'MpmNorSandMat.curvature': ['-0.1', '1.'],
        'MpmNorSandMat.flowCurvature': ['-0.1', '1.'],
        'MpmNorSandMat.hardening': ['0.', '-1.'],
        'MpmNorSandMat.specificVolume': ['1.', '0.9'],
        'MpmNorSandMat.dilatancyRatio': ['0.', '-1.'],
        'MpmCamClayMat.shearModulus': ['0.', '-1.'],
        'MpmCamClayMat.criticalStateRatio': ['0.', '-1.'],
        'MpmCamClayMat.compressionIndex': ['0.', '-1.'],
        'MpmCamClayMat.swellingIndex': ['0.', '-1.'],
        'MpmCamClayMat.preconsolidation': ['0.', '-1.'],
        'MpmCamClayMat.referencePressure': ['0.', '-1.'],
        'MpmUserMat.library': ['""'],
        'MpmUserMat.function': ['""'],
        'MpmUserMat.parameters': None,
        'MpmUserMat.stateVariables': ['[0.] * 41'],
        'MpmUserMat.stressTensors': ['[0]', '[36]'],
        'MpmUserMat.strainTensors': ['[0]', '[36]'],
        'MpmUserMat.reentrant': None,
        'MpmState.defGrad': ['Matrix3(-1,0,0, 0,1,0, 0,0,1)', 'Matrix3.Zero'],
        'MpmState.elasticStrain': ['Matrix3(0,1,0, 2,0,0, 0,0,0)'],
        'MpmState.force': None,
        'MpmState.volume': ['0.', '-1.'],
        'MpmState.volume0': ['0.', '-1.'],
        'MpmState.excessPressure': None,
        'MpmState.plasticStrain': ['-1e-3'],
        'MpmState.internals': ['[("none", 1.)]', '[("plasticStrain", 1.)]'],
        'MpmState.parameters': ['[("poisson", 0.2)]', '[("young", 1.), ("young", 2.)]', '[("young", nan)]'],
        'MpmPoint.halfSize': ['(0.1, 0, 0.1)', '(-1, 1, 1)'],
        'MpmPoint.halfSize0': ['(0.1, 0, 0.1)', '(-1, 1, 1)'],
        'MpmGrid.cellSize': ['0.', '-1.'],
        'MpmGrid.origin': None,
        'MpmGrid.dim': ['1', '4', '-2'],
        'MpmGrid.axisymmetric': None,
        'MpmGrid.period': ['(-1, 0, 0)', '(inf, 0, 0)'],
        'MpmBoundary.min': None,
        'MpmBoundary.max': None,
        'MpmBoundary.body': None,
        'MpmBoundary.fix': ['"w"', '"X"', '"xx"', '"x y"', '"nx"'],
        'MpmBoundary.displacement': None,
        'MpmBoundary.curve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmBoundary.surface': None,
        'MpmBoundary.motion': None,
        'MpmAbsorbingBoundary.min': None,
        'MpmAbsorbingBoundary.max': None,
        'MpmAbsorbingBoundary.motion': None,
        'MpmFreeField.surface': ['None'],
        'MpmFreeField.motion': None,
        'MpmFreeField.times': ['[0., 0.]', '[1., 0.]', '[nan]'],
        'MpmFreeField.velocities': ['[nan, 0.]'],
        'MpmFreeField.displacements': ['[nan, 0.]'],
        'MpmFreeField.forces': ['[inf, 0.]'],
        'MpmFreeField.distance': ['0.', '-1.'],
        'MpmFreeField.acts': None,
        'MpmBaseMotion.history': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmBaseMotion.direction': ['(0, 0, 0)'],
        'MpmBoundary.velocity': None,
        'MpmBoundary.penalty': ['0.', '-1.'],
        'MpmGrid.refinements': None,
        'MpmRefinement.min': None,
        'MpmRefinement.max': None,
        'MpmRefinement.halvings': ['0', '6'],
        'MpmGrid.adaptation': None,
        'MpmAdaptation.halvings': ['0', '6'],
        'MpmAdaptation.where': ['"edges"', '"function"'],
        'MpmAdaptation.maxUnknowns': ['0.', '-1.', 'nan'],
        'MpmAdaptation.merge': None,
        'MpmGhost.factor': ['-1e-2'],
        'MpmGhost.scaling': ['"Paper"'],
        'MpmGhost.where': ['"edges"'],
        'MpmGhost.threshold': ['0.', '-0.1', '1.1'],
        'MpmGhost.memory': ['-0.1', '1.1'],
        'MpmGhost.massFactor': ['-1e-3'],
        'MpmGhost.workTolerance': ['0.', '-0.1', '1.1'],
        'MpmDynamicEngine.loadCurve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmDynamicEngine.scheme': ['"Newmark"'],
        'MpmDynamicEngine.beta': ['0.', '-0.25', '1.1'],
        'MpmDynamicEngine.gamma': ['0.49', '-1.', '1.1'],
        'MpmDynamicEngine.rhoInfinity': ['-0.1', '1.1'],
        'MpmDynamicEngine.timeTolerance': ['-1e-3'],
        'MpmDynamicEngine.absorbing': None,
        'MpmDynamicEngine.rayleigh': ['(-1, 0)', '(0, -1e-3)', '(0, nan)'],
        'MpmNewton.tolerance': ['0.', '1.', '-1e-6'],
        'MpmNewton.maxIterations': ['0', '-1'],
        'MpmNewton.minStep': ['0.', '-1.', '2.'],
        'MpmNewton.lineSearchTrials': ['-1'],
        'MpmNewton.acceptUnconverged': None,
        'MpmNewton.predictor': None,
        'MpmNewton.reuseFactor': None,
        'MpmNewton.keepFactor': ['-1'],
        'MpmNewton.linearSolver': ['"cg"'],
        'MpmNewton.stepTolerance': ['-1e-3'],
        'MpmImplicitEngine.grid': ['None'],
        'MpmImplicitEngine.basis': ['"cubic"'],
        'MpmImplicitEngine.domains': ['"boxes"'],
        'MpmImplicitEngine.fBar': None,
        'MpmImplicitEngine.pressureRelaxation': None,
        'MpmImplicitEngine.nonlocalLength': ['-1.'],
        'MpmImplicitEngine.gravity': None,
        'MpmImplicitEngine.loadCurve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmImplicitEngine.gravityCurve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmImplicitEngine.loads': None,
        'MpmImplicitEngine.water': None,
        'MpmWater.level': None,
        'MpmWater.levels': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmWater.pressure': None,
        'MpmWater.weight': ['0.', '-1.'],
        'MpmWater.curve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmWater.where': ['"inside"'],
        'MpmImplicitEngine.flow': None,
        'MpmFlow.unitWeight': ['0.', '-1.'],
        'MpmFlow.bulkModulus': ['0.', '-1.'],
        'MpmFlow.stabilisation': ['-1.'],
        'MpmFlow.ghost': ['-1e-2'],
        'MpmFlow.pressureTolerance': ['0.', '-1.'],
        'MpmFlow.saturationTolerance': ['0.', '-1.'],
        'MpmFlow.total': None,
        'MpmFlow.bishop': ['"terzaghi"'],
        'MpmFlow.drains': None,
        'MpmDrain.surface': ['None'],
        'MpmDrain.pressure': None,
        'MpmDrain.level': None,
        'MpmDrain.levels': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmDrain.flux': None,
        'MpmDrain.seepage': None,
        'MpmDrain.rain': None,
        'MpmDrain.driest': ['0.', '1.'],
        'MpmDrain.curve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmDrain.conductance': ['0.', '-1.'],
        'MpmTraction.surface': ['None'],
        'MpmTraction.pressure': None,
        'MpmTraction.traction': None,
        'MpmTraction.body': None,
        'MpmTraction.curve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmReinforcement.line': ['[(1, 1)]', '[(1, 1), (1, 1)]', '[(1, 1), (2, nan)]'],
        'MpmReinforcement.axialStiffness': ['0.', '-1.'],
        'MpmReinforcement.tensionOnly': None,
        'MpmReinforcement.strength': ['0.', '-1.'],
        'MpmReinforcement.bond': ['-1.'],
        'MpmReinforcement.friction': ['-0.1', '30.', '1.5708'],
        'MpmReinforcement.perimeter': ['0.', '-1.'],
        'MpmReinforcement.bondStiffness': ['0.', '-1.'],
        'MpmReinforcement.freeLength': ['-1.'],
        'MpmReinforcement.headPlate': None,
        'MpmReinforcement.pull': ['-1.'],
        'MpmReinforcement.pretension': ['-1.'],
        'MpmReinforcement.curve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmBeam.line': ['[(1, 1)]', '[(1, 1), (1, 1)]'],
        'MpmBeam.axialStiffness': ['0.', '-1.'],
        'MpmBeam.bendingStiffness': ['0.', '-1.'],
        'MpmBeam.poisson': ['-0.1', '0.6'],
        'MpmBeam.prestress': None,
        'MpmBeam.plasticMoment': ['0.', '-1.'],
        'MpmBeam.weight': ['-1.'],
        'MpmBeam.hinges': ['[(1,)]'],
        'MpmBeam.fixHead': ['"z"'],
        'MpmBeam.fixFoot': ['"xyz"'],
        'MpmBeam.headForce': None,
        'MpmBeam.headMoment': None,
        'MpmBeam.contraction': ['-0.1', '1.'],
        'MpmBeam.adhesion': ['-1.'],
        'MpmBeam.permittivity': ['-1.'],
        'MpmBeam.friction': ['-0.1', '30.', '1.5708'],
        'MpmBeam.stiffness': ['0.', '-1.'],
        'MpmBeam.anchors': None,
        'MpmBeam.curve': ['[(0, 0), (0, 1)]', '[(1, 0), (0, 1)]'],
        'MpmImplicitEngine.contacts': None,
        'MpmContact.mask': None,
        'MpmContact.implicit': None,
        'MpmContact.friction': ['-0.1', '30.', '1.5708'],
        'MpmContact.adhesion': ['-1.'],
        'MpmContact.stiffness': ['0.', '-1.'],
        'MpmBodyContact.between': ['["low"]', '["low", ""]', '["low", "up", "low"]'],
        'MpmBodyContact.friction': ['-0.1', '30.', '1.5708'],
        'MpmBodyContact.adhesion': ['-1.'],
        'MpmBodyContact.permittivity': ['-1.'],
        'MpmBodyContact.filled': None,
        'MpmBodyContact.folds': None,
        'MpmBodyContact.stiffness': ['0.', '-1.'],
        'MpmBody.name': None,
        'MpmBody.vertices': None,
        'MpmBody.pieces': ['[(0,)]', '[(0, -1)]', '[(0, 1), (0, 1, 2)]'],
        'MpmGrid.bodies': None,
        'MpmSurface.vertices': ['[(0, 0, 0)]'],
        'MpmSurface.pieces': None,
        'MpmImplicitEngine.boundaries': None,
        'MpmImplicitEngine.ghost': ['None'],
        'MpmImplicitEngine.newton': ['None'],
        'MpmImplicitEngine.mask': None,
        'MpmImplicitEngine.loadTime': None,
        'MpmImplicitEngine.verbosity': ['-1', '3'],
        'MpmImplicitEngine.maxSplits': ['-1'],
        'MpmImplicitEngine.distributed': None,
        'MpmVtkRecorder.fileName': None,
        'MpmVtkRecorder.recorders': ['["lines"]'],
        'MpmVtkRecorder.fields': ['["lines"]'],
        'MpmVtkRecorder.sectors': ['-1', '2'],
        'MpmVtkRecorder.ascii': None,
        'MpmVtkRecorder.compress': None,
        'MpmVtkRecorder.solver': None,
}

# Wrong values of each kind, by the type of its default: the wrong type, NaN, infinite, empty, huge.
kinds = {
        'float': (['"1"', 'None', 'True', '(1, 2)', 'object()', '1j'], ['nan'], ['inf', '-inf'], ['()', '""'], ['1e308', '10**400']),
        'int': (['"1"', 'None', 'True', '2.0', 'object()'], ['nan'], ['inf'], ['()', '""'], ['2**31 - 1', '10**30']),
        'bool': (['"1"', 'None', '1', 'object()'], ['nan'], ['inf'], ['()', '""'], ['10**30']),
        'str': (['1', 'None', 'b"x"', '["x"]'], ['nan'], ['inf'], ['""', '()'], ['"x" * 10**5']),
        'Vector3': (['"xyz"', 'None', '1', '(1, 2)', '(1, 2, "3")', '(1, 2, 3, 4)'], ['(nan, 0, 0)', '(0, 0, nan)'], ['(inf, 0, 0)', '(0, -inf, 0)'], ['()', '""'],
                    ['(1e308, 0, 0)', '(0, -1e308, 0)', '(0, 10**400, 0)']),
        'Matrix3': (['"xyz"', 'None', '1', '(1, 2, 3)'], ['Matrix3(nan,0,0, 0,1,0, 0,0,1)'], ['Matrix3(inf,0,0, 0,1,0, 0,0,1)'], ['()', '""'],
                    ['Matrix3(1e308,0,0, 0,1e308,0, 0,0,1)', '1e200 * Matrix3.Identity']),
        'tuple': (['1', 'None', '"ab"', '[None]', '[1]', '{}'], ['[nan]', '[(0, nan)]'], ['[inf]', '[(inf, 1)]'], ['()'], ['[(0, 0), (1, 1e308)]', '[(t, t) for t in range(10**5)]']),
        'object': (['1', '"x"', 'MpmState()', 'object()', '[]'], ['nan'], ['inf'], ['()', '""'], ['10**30']),
}
categories = ['wrong type', 'NaN', 'infinite', 'empty', 'huge', 'out of range']

# Admitted though odd: by attribute and text of the value.
admitted = {
        **{(f'{class_}.{side}', text): 'no limit on that side' for side in ('min', 'max') for class_ in ('MpmBoundary', 'MpmAbsorbingBoundary', 'MpmRefinement') for text in ('(inf, 0, 0)', '(0, -inf, 0)')},
        ('MpmFrictionalMat.tensileStrength', 'inf'): 'no cut',
        **{(f'MpmUserMat.{name}', text): 'as the law has it' for name in ('parameters', 'stateVariables', 'stressTensors', 'strainTensors') for text in ('[1]', '()')},
        ('MpmImplicitEngine.boundaries', '()'): 'nothing is held',
        ('MpmDynamicEngine.absorbing', '()'): 'nothing absorbs',
        **{(f'MpmFreeField.{name}', '()'): 'nothing moves beyond' for name in ('times', 'velocities', 'displacements', 'forces')},
        **{(f'MpmFreeField.{name}', '[1]'): 'numbers' for name in ('times', 'velocities', 'displacements', 'forces')},
        ('MpmFreeField.distance', 'inf'): 'no springs',
        ('MpmGrid.refinements', '()'): 'equal cells',
        ('MpmGrid.adaptation', '()'): 'equal cells',
        ('MpmMaterial.conductivity', '(1, 2)'): 'horizontal and vertical',
        ('MpmImplicitEngine.loads', '()'): 'nothing is loaded',
        ('MpmTraction.body', '""'): 'the one that is near',
        ('MpmBoundary.body', '""'): 'all',
        ('MpmTraction.curve', '()'): 'loadCurve',
        ('MpmBoundary.curve', '()'): 'loadCurve',
        ('MpmImplicitEngine.water', '()'): 'no water',
        ('MpmWater.level', 'nan'): 'levels or pressure',
        ('MpmWater.levels', '()'): 'level or pressure',
        ('MpmWater.curve', '()'): 'that of gravity',
        **{(f'MpmMaterial.{name}', 'nan'): 'not given' for name in ('waterModulus', 'conductivity', 'porosity', 'conductivityIndex', 'relaxationTime')},
        **{(f'MpmMohrCoulombMat.{name}', 'nan'): 'as before softening' for name in ('residualCohesion', 'residualFrictionAngle', 'residualDilationAngle', 'softeningStrain')},
        **{(f'MpmHardeningSoilMat.{name}', 'nan'): 'no small-strain stiffness' for name in ('G0ref', 'gamma07')},
        ('MpmHardeningSoilMat.mostDilation', 'inf'): 'no cut-off',
        ('MpmNorSandMat.flowCurvature', 'nan'): 'that of the yield function',
        ('MpmImplicitEngine.flow', 'None'): 'no water flows',
        ('MpmFlow.bulkModulus', 'inf'): 'it keeps its volume',
        ('MpmFlow.drains', '()'): 'none leaves',
        ('MpmFlow.pressureTolerance', 'inf'): 'not looked at',
        ('MpmFlow.saturationTolerance', 'inf'): 'not looked at',
        ('MpmFlow.stabilisation', 'nan'): 'by the kind of steps',
        ('MpmDrain.level', 'nan'): 'pressure or flux',
        ('MpmDrain.levels', '()'): 'level stays',
        ('MpmDrain.flux', 'nan'): 'pressure or level',
        ('MpmDrain.rain', 'nan'): 'pressure or level',
        ('MpmMaterial.retention', 'None'): 'always saturated',
        ('MpmRetention.permeabilities', '()'): 'by the form of the curve',
        ('MpmDrain.curve', '()'): 'one',
        ('MpmImplicitEngine.contacts', '()'): 'nothing touches',
        **{(f'MpmReinforcement.{name}', 'inf'): 'no limit' for name in ('strength', 'bond', 'bondStiffness')},
        ('MpmReinforcement.perimeter', 'nan'): 'both faces of a sheet',
        **{(f'{class_}.curve', '()'): 'loadCurve' for class_ in ('MpmReinforcement', 'MpmBeam')},
        **{(f'MpmBeam.{name}', 'inf'): 'no limit' for name in ('plasticMoment', 'adhesion', 'permittivity')},
        **{(f'MpmBeam.{name}', '()'): 'none' for name in ('hinges', 'anchors')},
        **{(f'MpmBeam.{name}', '""'): 'it is free' for name in ('fixHead', 'fixFoot')},
        ('MpmContact.friction', 'nan'): 'that of the bodies',
        ('MpmAdaptation.maxUnknowns', 'inf'): 'no limit',
        ('MpmContact.adhesion', 'inf'): 'no cap',
        ('MpmBodyContact.adhesion', 'inf'): 'no cap',
        ('MpmBodyContact.permittivity', 'inf'): 'no limit',
        ('MpmBody.vertices', '()'): 'no surface',
        ('MpmBody.pieces', '()'): 'no surface',
        ('MpmGrid.bodies', '()'): 'none has a name',
        ('MpmGhost.massFactor', 'nan'): 'the default',
        ('MpmImplicitEngine.gravityCurve', '()'): 'loadCurve',
        ('MpmVtkRecorder.solver', '""'): 'the only one',
        ('MpmState.internals', '()'): 'initial values',
        ('MpmState.parameters', '()'): 'those of the material',
        ('MpmVtkRecorder.fields', '()'): 'the domains alone',
}

setting = '''
import json, os, sys
from yade import mpm, pack, utils, wrapper
from yade.mpm.points.data import table
nan = float('nan')

dynamic = 'MpmDynamicEngine', 'MpmAbsorbingBoundary', 'MpmBaseMotion', 'MpmFreeField'
flowing = 'MpmFlow', 'MpmDrain'
retaining = 'MpmVanGenuchten', 'MpmGardner', 'MpmBrooksCorey', 'MpmRetentionTable'
meeting = 'MpmBodyContact', 'MpmBody'
structures = 'MpmReinforcement', 'MpmBeam'

def scene(engine='MpmImplicitEngine'):
	"""A sound scene with this engine, where it names one; {class: the object of it that takes part}."""
	O.reset()
	materials = dict(density=2400, young=1e6, poisson=0.3)
	friction = dict(cohesion=5e3, frictionAngle=radians(30), **materials)
	O.materials.append([MpmElasticMat(label='elastic', **materials), MpmVonMisesMat(yieldStress=15e3, label='plastic', **materials),
	                    MpmCamClayMat(density=2400, shearModulus=5e5, criticalStateRatio=1.2, compressionIndex=0.05, swellingIndex=0.01, preconsolidation=1e4,
	                                  referencePressure=5e3, label='clay'),
	                    MpmTrescaMat(undrainedStrength=15e3, label='tresca', **materials), MpmMohrCoulombMat(label='friction', **friction),
	                    MpmDruckerPragerMat(label='cone', **friction),
	                    MpmHardeningSoilMat(density=2400, E50ref=1e6, Eoedref=1e6, Eurref=3e6, power=0.5, K0nc=0.5, cohesion=5e3, frictionAngle=radians(30), label='hardening'),
	                    MpmNorSandMat(density=2400, shearModulus=5e5, swellingIndex=0.01, referencePressure=5e3, criticalStateRatio=1.2, compressionIndex=0.05,
	                                  criticalVolume=1.9, hardening=100, specificVolume=1.7, label='sand'),
	                    MpmUserMat(library=os.environ['UMAT'], parameters=[1e6, 0.3, 15e3, 1], stateVariables=[0], label='user', **materials)])
	labels = [material.label for material in O.materials] + ['elastic']
	grid, base, ghost, newton = MpmGrid(cellSize=1), MpmBoundary(max=(inf, 0, inf), fix='xy'), MpmGhost(), MpmNewton()
	for low, high, body in [(0, 2, 'low'), (2, 5, 'up')] if engine in meeting else [(0, 5, None)]:
		O.bodies.append(mpm.fill(mpm.polygon([(0, low), (2, low), (2, high), (0, high)]), grid, 2, lambda x: labels[int(x[0] / 0.5) % 2 + 2 * int(x[1])], body=body))
	clay = [b.id for b in O.bodies if b.material.label in ('clay', 'sand')]
	mpm.assign(clay, stress=[-5e3 * np.identity(3)] * len(clay))
	load = MpmTraction(surface=[(2, 5), (0, 5)], pressure=10)
	O.materials.append(FrictMat(label='rigid'))
	O.bodies.append(utils.wall(7, axis=1, sense=-1, material='rigid'))
	touch, water = MpmContact(), MpmWater(level=1, weight=10)
	solver = (MpmDynamicEngine if engine in dynamic else MpmImplicitEngine)(grid=grid, gravity=(0, -1, 0), boundaries=[base], loads=[load], water=[water], contacts=[touch], ghost=ghost, newton=newton)
	wave = MpmBaseMotion(history=[(0, 0), (2, 1e-3)])
	edge = MpmAbsorbingBoundary(min=(2, -inf, -inf), motion=wave)
	if engine in dynamic[1:]: solver.absorbing = [edge]
	free = MpmFreeField(surface=[(0, 5), (0, 0)])
	if engine == 'MpmFreeField': solver.loads = [load, free]
	drain = MpmDrain(surface=[(2, 5), (0, 5)])
	if engine in flowing:
		solver.flow = MpmFlow(drains=[drain])
		for material in list(O.materials)[:9]: material.conductivity, material.porosity = 1e-4, .4
	curve = dict(MpmVanGenuchten=lambda: MpmVanGenuchten(alpha=1, n=2), MpmGardner=lambda: MpmGardner(alpha=1), MpmBrooksCorey=lambda: MpmBrooksCorey(entry=1, exponent=1),
	             MpmRetentionTable=lambda: MpmRetentionTable(saturations=[(0, 1), (10, .2)], permeabilities=[(0, 1), (10, .1)]))[engine]() if engine in retaining else None
	if curve:
		solver.flow, solver.water = MpmFlow(total=True, unitWeight=10, drains=[MpmDrain(surface=[(2, 5), (0, 5)], rain=1e-6)]), []
		for material in list(O.materials)[:9]: material.conductivity, material.porosity, material.retention = 1e-4, .4, curve
	nail = MpmReinforcement(line=[(.3, 2.5), (1.7, 2.2)], axialStiffness=1e4)
	beam = MpmBeam(line=[(.2, 3), (1.8, 3)], axialStiffness=1e5, bendingStiffness=1e3, weight=10)
	if engine in structures: solver.loads = [load, nail, beam]
	small = MpmRefinement()
	bodies = MpmBodyContact(between=('low', 'up'), friction=0.1)
	if engine in meeting: solver.contacts, solver.water = [touch, bodies], []
	if engine == 'MpmRefinement': grid.refinements, solver.water = [small], []
	adaptation = MpmAdaptation()
	if engine == 'MpmAdaptation': grid.adaptation, solver.water = [adaptation], []
	O.engines = [solver, MpmVtkRecorder(fileName='out-', recorders=['all'])]
	O.dt = 1
	objects = [*O.engines, *O.materials, O.bodies[5].state, O.bodies[5].shape, grid, base, load, load.surface, water, touch, ghost, newton]
	return {type(o).__name__: o for o in objects + [edge, wave] * (engine in dynamic[1:]) + [free] * (engine == 'MpmFreeField') + [small] * (engine == 'MpmRefinement') + [adaptation] * (engine == 'MpmAdaptation') + [solver.flow, drain] * (engine in flowing) + [curve] * (engine in retaining) + ([bodies, *grid.bodies] if engine in meeting else []) + [nail, beam] * (engine in structures)}

def attributes():
	"""(class, attribute, class of the object to set it on, kind, whether it can only be read) from the classes themselves."""
	classes = [c for name, c in vars(wrapper).items() if isinstance(c, type) and name.startswith('Mpm')]
	for c in classes:
		users = [name for name in [*scene(), *dynamic, *flowing, *retaining, *meeting, *structures, 'MpmRefinement', 'MpmAdaptation'] if issubclass(getattr(wrapper, name), c)]
		for name, value in vars(c).items():
			if not isinstance(value, property): continue
			default = getattr(c(), name)
			kind = 'object' if default is None or isinstance(default, wrapper.Serializable) else type(default).__name__
			yield c.__name__, name, users, kind, value.fset is None

def outcome(user, name, text):
	"""(name of the exception or None, its sentence, whether it was raised by the assignment)."""
	target, value = scene(user)[user], eval(text)
	try:
		before = repr(getattr(target, name))
		setattr(target, name, value)
	except Exception as error:
		assert repr(getattr(target, name)) == before, (user, name, text) # as it was
		return type(error).__name__, str(error), True
	points = mpm.arrays()
	try:
		O.step()
	except Exception as error:
		return type(error).__name__, str(error), False
	after = mpm.arrays()
	ofOneLaw = [np.isfinite(after.pop(name)) for name in list(after) if table[name]['isInternal'] and name != 'plasticStrain']
	assert all(has.any() and not has.all() for has in ofOneLaw) and all(np.isfinite(values).all() for values in after.values()), (user, name, text)
	return None, '', False

import numpy as np
values = json.load(open('values.json')) # {kind: texts}, {attribute: texts}
results = []
for class_, name, users, kind, readonly in attributes():
	if readonly:
		for user in users[:1]:
			try:
				setattr(scene(user)[user], name, getattr(scene(user)[user], name))
				results.append([class_, name, kind, 'readonly', '', None, '', True])
			except AttributeError as error:
				results.append([class_, name, kind, 'readonly', '', 'AttributeError', str(error), True])
		continue
	if not users:
		results.append([class_, name, kind, 'unused', '', None, '', True])
		continue
	for category, text in values['kinds'][kind] + [['out of range', text] for text in values['outOfRange'].get(f'{class_}.{name}') or []]:
		results.append([class_, name, kind, category, text, *outcome(users[0], name, text)])
print(json.dumps(results))
'''


@pytest.fixture(scope='module')
def outcomes(tmp_path_factory):
	yade = Yade(tmp_path_factory.mktemp('attributes'))
	yade.environment['UMAT'] = str(yade.folder / 'law.so')
	subprocess.run(['g++', '-shared', '-fPIC', '-o', yade.environment['UMAT'], root / 'tests/umat/von_mises.cpp'], check=True)
	texts = {kind: [[category, text] for category, list_ in zip(categories, lists) for text in list_] for kind, lists in kinds.items()}
	(yade.folder / 'values.json').write_text(json.dumps(dict(kinds=texts, outOfRange=outOfRange)))
	results = yade(setting, timeout=240).result
	if 'BAD_INPUT_TABLE' in os.environ: writeTable(results, os.environ['BAD_INPUT_TABLE'])
	return results


def writeTable(results, path):
	with open(path, 'w') as table:
		print('| attribute |', ' | '.join(categories), '|', file=table)
		print('|---' * (len(categories) + 1) + '|', file=table)
		for name in dict.fromkeys(f'{r[0]}.{r[1]}' for r in results if r[3] in categories):
			row = []
			for category in categories:
				cells = {}
				for class_, attribute, kind, which, text, error, sentence, atOnce in results:
					if f'{class_}.{attribute}' != name or which != category: continue
					what = f'{error}' if atOnce and error else f'step: {error}' if error else 'runs'
					cells.setdefault(what, []).append(text if len(text) < 40 else text[:37] + '...')
				row.append('; '.join(f"{what}: {', '.join(f'`{text}`' for text in found)}" for what, found in cells.items()) or 'no limit')
			print(f'| {name} |', ' | '.join(row), '|', file=table)
		print('\nOnly to be read:', ', '.join(f'{r[0]}.{r[1]}' for r in results if r[3] == 'readonly'), file=table)


def test_every_attribute_is_in_the_table(outcomes):
	assert {f'{r[0]}.{r[1]}' for r in outcomes if r[3] != 'readonly'} == set(outOfRange)
	assert not [r for r in outcomes if r[3] == 'unused']


def test_what_can_only_be_read_says_so(outcomes):
	for class_, name, _, _, _, error, sentence, _ in (r for r in outcomes if r[3] == 'readonly'):
		assert error == 'AttributeError' and name in sentence, (class_, name, sentence)


def test_what_cannot_be_meant_is_refused_by_the_assignment(outcomes):
	"""The old value is kept; the sentence names class and attribute and says what is admitted."""
	for class_, name, kind, category, text, error, sentence, atOnce in outcomes:
		if category in ('huge', 'readonly') or (f'{class_}.{name}', text) in admitted: continue
		where = f'{class_}.{name} = {text}: {error} {sentence}'
		assert atOnce and error == ('TypeError' if 'TypeError' == error else 'ValueError'), where
		if category == 'wrong type': assert error == 'TypeError', where
		if category == 'out of range': assert error == 'ValueError', where
		assert f'{class_}.{name} = ' in sentence and 'expected' in sentence, where


def test_what_is_admitted_gives_a_finite_state_or_a_reason(outcomes):
	for class_, name, kind, category, text, error, sentence, atOnce in outcomes:
		if not error or atOnce: continue
		assert error in ('ValueError', 'RuntimeError') and len(sentence) > 30, f'{class_}.{name} = {text}: {error} {sentence}'


files = '''
import json, os
from scenes import *

def tried(statement):
	try:
		exec(statement)
		return None
	except Exception as error:
		return f'{type(error).__name__}: {error}'

def record(path):
	"""Writes the recorder's files in a step; the scene stays usable."""
	O.reset()
	slope()
	O.engines = O.engines + [MpmVtkRecorder(fileName=path)]
	O.step()

def save(path):
	mpm.save(path)

def load(path):
	O.load(path)
	if not len(O.bodies): raise ValueError('nothing in it')

slope()
O.step()
mpm.save('whole.yade.gz')
mpm.save('whole.xml')
for ending in 'yade.gz', 'xml':
	content = open(f'whole.{ending}', 'rb').read()
	open(f'cut.{ending}', 'wb').write(content[:len(content) // 2])
	open(f'foreign.{ending}', 'wb').write(b'Not a scene.')
	open(f'empty.{ending}', 'wb')
os.mkdir('folder.xml')
results = {statement: tried(statement) for statement in json.load(open("statements.json"))}
record('good/new-')
load('whole.yade.gz')
load('whole.xml')
O.step()
print(json.dumps([results, sorted(os.listdir('.'))]))
'''

# (statement, what its error must contain)
refusedFiles = [(f'record({path!r})', word) for path, word in [('', 'fileName'), ('whole.xml/x-', 'whole.xml'), ('a\0b-', 'fileName'), ('a\nb-', 'line breaks'), ('n' * 300, 'File name too long'), ('/proc/x-', '/proc')]] + [
        (f'save({path!r})', word) for path, word in [('', 'save: file'), ('x.txt', 'x.txt'), ('/proc/missing/x.xml', '/proc/missing/x.xml'), ('folder.xml', 'folder.xml'), ('whole.xml/x.xml', 'whole.xml'), ('a\0b.xml', 'null'),
                                                     ('n' * 300 + '.xml', 'too long')]
] + [('save(7)', 'file = 7 must be a path')] + [(f'load({path!r})', '') for path in ('missing.xml', 'missing.yade.gz', 'cut.xml', 'cut.yade.gz', 'foreign.xml', 'foreign.yade.gz', 'empty.xml', 'empty.yade.gz', 'folder.xml', '')]


def test_files_that_cannot_be_written_or_read(yade):
	(yade.folder / 'statements.json').write_text(json.dumps([statement for statement, _ in refusedFiles]))
	run = yade(files)
	results, left = run.result
	if 'BAD_INPUT_TABLE' in os.environ:
		with open(os.environ['BAD_INPUT_TABLE'], 'a') as table:
			print('\n| file argument | outcome |\n|---|---|', file=table)
			for statement, message in results.items():
				print(f'| `{statement[:60]}` | {(message or "accepted")[:150]} |', file=table)
	for statement, word in refusedFiles:
		message = results[statement]
		assert message and word in message, (statement, message)
	assert not [name for name in left if name.startswith('.') or 'n' * 10 in name], left
