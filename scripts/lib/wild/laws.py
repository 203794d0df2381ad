# SPDX-License-Identifier: GPL-2.0-or-later
"""Public UMATs of soils: where they are, how they are compiled, their constants and state variables, and what a triaxial test is compared with. Needs nothing of YADE."""
import math
import os
import subprocess

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
degree = math.pi / 180
karlsruhe = dict(phi=0.578, hardness=4e6, exponent=0.27, ed0=0.677, ec0=1.054, ei0=1.212, alpha=0.14, beta=2.5)  # hardness [kPa]
frictional = dict(young=20e6, poisson=0.3, cohesion=5e3, frictionAngle=30 * degree, dilationAngle=10 * degree)


class Law:
	"""A law of a public repository; stresses are in units of *unit* [Pa] and densities in the same units over m2/s2."""

	def __init__(self, repository, commit, sources, function, parameters, states, unit=1., young=20e6, flags=(), utilities=False, exact='', **tensors):
		self.repository, self.commit, self.sources, self.function = repository, commit, sources, function
		self.parameters, self.states, self.unit, self.young, self.flags, self.utilities, self.exact, self.tensors = parameters, states, unit, young, flags, utilities, exact, tensors

	def at(self, folder):
		return os.path.join(folder, self.repository.split('/')[1])

	def missing(self, folder):
		"""Sources that a folder of checkouts lacks."""
		return [source for source in self.sources if not os.path.exists(os.path.join(self.at(folder), source))]

	def compile(self, folder, library):
		"""Make the shared library."""
		made = os.path.dirname(os.path.abspath(library))
		with open(os.path.join(made, 'ABA_PARAM.INC'), 'w') as file:
			file.write('      implicit real*8(a-h,o-z)\n      parameter (nprecd=2)\n')
		objects = []
		if self.utilities:
			objects = [os.path.join(made, 'utilities.o'), '-lstdc++']
			subprocess.run(['g++', '-O2', '-c', '-fPIC', '-I', '/usr/include/eigen3', '-o', objects[0], os.path.join(root, 'scripts/lib/wild/utilities.cpp')], check=True)
		sources = [os.path.join(os.path.abspath(self.at(folder)), source) for source in self.sources]
		isC = sources[0].endswith('.c')
		fortran = ['gfortran', '-ffree-line-length-none', '-ffixed-line-length-none', '-I', made, '-J', made]
		ended = subprocess.run([*(['gcc'] if isC else fortran), '-O2', '-shared', '-fPIC', '-w', *self.flags, '-o', library, *sources, *objects, *(['-lm'] if isC else [])], cwd=made, capture_output=True, text=True)
		return ended.returncode == 0, ended.stderr


platypus = 'PlatypusBytes/ConstitutiveModels', 'cf5836cf1bb90a19dcb69a4f00f5c7ebb554e374'
anisotropy = math.sqrt(2 / 3) * 0.45  # fabric at first, as the author's SDVINI sets it
c = frictional['cohesion']
laws = {
        'Mohr-Coulomb':
                Law(*platypus, ['fortran_models/mohr_coulomb/UMAT_MohrCoulomb.f'], 'umat_', [20e6 / 2.6, 0.3, c, 30, 10, 0], [0], exact='Mohr-Coulomb of the plugin'),
        'Matsuoka-Nakai':
                Law(*platypus, [f'c_models/{name}.c' for name in ('matsuoka_nakai/matsuoka_nakai', 'globals', 'stress_utils', 'utils', 'elastic_laws/hookes_law', 'yield_surfaces/matsuoka_nakai_surface')], 'umat',
                    [20e6, 0.3, c, 30, 10], [0], exact='Mohr-Coulomb of the plugin, the same in compression'),
        'Mohr-Coulomb, softening':
                Law('CriticalSoilModels/MohrCoulomb_StrainSoft', '5ff42190eab4b85c213b6f75ee4ee077d3af3b20',
                    [f'src/{name}.f90' for name in ('kind_precision_module', 'mod_array_helper', 'MCSS_funcs', 'MohrCoulomb_StrainSoft')], '__mod_mcss_esm_MOD_umat_mohrcoulombstrainsoftening',
                    [20e6 / 2.6, 0.3, c, c, 30, 30, 10, 10, 1, 1, 1e-8, 1000, 1e-9], [c, 30 * degree, 10 * degree, 0, 0, 0, 0, 0, 0], exact='Mohr-Coulomb of the plugin: residual strength as at first', strainTensors=[4]),
        'Cam clay':
                Law('CriticalSoilModels/Modified_Cam_Clay', '8e0d8b2cb70f695be5edd9b50d09bd92513c6a41', ['UMAT_ModifiedCamClayCopy.f90'], '__camclay_MOD_umat',
                    [25 * degree, 0.3, 0.02, 0.1, 1], [-100, 0, 0, 0, 0, 0, 0], unit=1e3, young=1e4, exact='critical state, 6 sin phi / (3 - sin phi)', strainTensors=[2]),
        'hypoplasticity, intergranular strain':
                Law('patrickstaubach/abaqus-implicit', '7bb189cbc4d7cdcbcc6471e979c41f07a96225f7', ['HPP_Staubach_implicit.f'], 'umat_',
                    [karlsruhe['phi'], 0.37, *list(karlsruhe.values())[1:], 1.2, 2.4, 1e-4, 0.1, 6, 0], [0.8278, 0, 0, 0] + [0] * 21, unit=1e3, young=5e4,
                    exact='examples/laboratory/hypoplasticity.cpp, without intergranular strain', strainTensors=[2], stressTensors=[8]),
        'Sanisand':
                Law('Gzunviwuwenhao/Abaqus_UMAT_sanisand', '5142e53bb7b0de34b8feb490880cff8370b583e1', ['merge/source.F90'], 'umat_', [], [0.76, 0.01, anisotropy, -anisotropy / 2, -anisotropy / 2, 0, 0, 0] + [0] * 10,
                    unit=1e3, young=1e5, flags=['-cpp'], utilities=True, stressTensors=[3]),
}
