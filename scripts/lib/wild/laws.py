# SPDX-License-Identifier: GPL-2.0-or-later
"""Public laws of soils, UMATs and those of MFront: where they are, how they are compiled, their constants and state variables, and what a triaxial test is compared with. Needs nothing of YADE."""
import math
import os
import shutil
import subprocess
import zipfile

root = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
degree = math.pi / 180
karlsruhe = dict(phi=0.578, hardness=4e6, exponent=0.27, ed0=0.677, ec0=1.054, ei0=1.212, alpha=0.14, beta=2.5)  # hardness [kPa]
frictional = dict(young=20e6, poisson=0.3, cohesion=5e3, frictionAngle=30 * degree, dilationAngle=10 * degree)


class Law:
	"""A law of a public repository; stresses are in units of *unit* [Pa] and densities in the same units over m2/s2."""

	def __init__(self, repository, commit, sources, function, parameters, states, unit=1., young=20e6, flags=(), utilities=False, exact='', pressure=100e3, check=(0.02, 10e3), theirs=None, files=(), shims=(), path='', **tensors):
		"""*check*: strain and pressure of the check of the tangent; *theirs*: the number to compare with, where no law of the plugin gives it; *files*: those that the law wants to find beside it, empty; *shims*: sources of this
		folder that stand in for another library; *path*: a file of the repository with strains and stresses along a path."""
		self.repository, self.commit, self.sources, self.function, self.exact, self.pressure, self.check, self.theirs = repository, commit, sources, function, exact, pressure, check, theirs
		self.parameters, self.states, self.unit, self.young, self.flags, self.utilities = parameters, states, unit, young, flags, utilities
		self.files, self.shims, self.path, self.tensors = files, shims, path, tensors

	def at(self, folder):
		return os.path.join(folder, self.repository.split('/')[1])

	def missing(self, folder):
		"""Sources that a folder of checkouts lacks."""
		return [source for source in self.sources if not os.path.exists(os.path.join(self.at(folder), source.split('.zip/')[0] + '.zip' * ('.zip/' in source)))]

	def source(self, folder, name, made):
		"""Path of a source; one in an archive, as a.zip/b.for, is unpacked into the folder *made*."""
		path = os.path.join(os.path.abspath(self.at(folder)), name)
		if '.zip/' not in name: return path
		archive, within = path.split('.zip/')
		with zipfile.ZipFile(archive + '.zip') as packed:
			return packed.extract(within, made)

	def compile(self, folder, library):
		"""Make the shared library."""
		made = os.path.dirname(os.path.abspath(library))
		if self.path: shutil.copy(os.path.join(self.at(folder), self.path), os.path.join(made, 'path.ref'))
		if self.sources[0].endswith('.mfront'): return self.compileMFront(folder, library)
		with open(os.path.join(made, 'ABA_PARAM.INC'), 'w') as file:
			file.write('      implicit real*8(a-h,o-z)\n      parameter (nprecd=2)\n')
		objects = []
		if self.utilities:
			objects = [os.path.join(made, 'utilities.o'), '-lstdc++']
			subprocess.run(['g++', '-O2', '-c', '-fPIC', '-I', '/usr/include/eigen3', '-o', objects[0], os.path.join(root, 'scripts/lib/wild/utilities.cpp')], check=True)
		for name in self.files: open(os.path.join(made, name), 'w').close()
		sources = [*(os.path.join(root, 'scripts/lib/wild', name) for name in self.shims), *(self.source(folder, name, made) for name in self.sources)]
		isC = sources[0].endswith('.c')
		fortran = ['gfortran', '-ffree-line-length-none', '-ffixed-line-length-none', '-I', made, '-J', made]
		ended = subprocess.run([*(['gcc'] if isC else fortran), '-O2', '-shared', '-fPIC', '-w', *self.flags, '-o', library, *sources, *objects, *(['-lm'] if isC else [])], cwd=made, capture_output=True, text=True)
		return ended.returncode == 0, ended.stderr

	def compileMFront(self, folder, library):
		if not shutil.which('mfront'): return False, 'mfront is not on the PATH: install TFEL, and set TFELHOME.'
		made = os.path.dirname(os.path.abspath(library))
		ended = subprocess.run(['mfront', '--obuild', '--interface=generic', self.source(folder, self.sources[0], made)], cwd=made, capture_output=True, text=True)
		if ended.returncode == 0: shutil.copy(os.path.join(made, 'src', 'libBehaviour.so'), library)
		return ended.returncode == 0, ended.stdout + ended.stderr


platypus = 'PlatypusBytes/ConstitutiveModels', 'cf5836cf1bb90a19dcb69a4f00f5c7ebb554e374'
gallery = 'thelfer/MFrontGallery', '536660d8d1647d187397134ac6d6c13003dfb4d7'
anisotropy = math.sqrt(2 / 3) * 0.45  # fabric at first, as the author's SDVINI sets it
c = frictional['cohesion']
slope = 6 * math.sin(25 * degree) / (3 - math.sin(25 * degree))  # critical state
nerlerk = [71500, 500, 0.4, 0.15, 0.852, 0.875, 0.021, 1, 1.45, 0.43, 3.4, 40, 0, 0, 0, 0, 0, 1e5, 0, 200, 0]  # parameters of the repository's drained test, without those of rates


def cap(pressure, d=150e6, slope=math.tan(0.6), pa=10e6, pb=75e6):
	"""Strength in a triaxial test [Pa] on the cap of DruckerPragerCap, (p - p_a)^2 + (R q)^2 = (p_b - p_a)^2."""
	R, a, c = (pb - pa) / (d + pa * slope), 1 / 3, pressure - pa
	return (-a * c + math.sqrt((a * c)**2 - (a * a + R * R) * (c * c - (pb - pa)**2))) / (a * a + R * R)


modules = [
        'csm_kinds', *(f'utils/{name}' for name in ('voigt_utils', 'elastic_utils', 'cmname_parser')), *(f'invariants/{name}' for name in ('stress_invariants', 'stress_invariant_deriv', 'strain_invariants')), 'core/csm_model',
        *(f'models/norsand/norsand_{name}' for name in ('types', 'functions', 'model')), *(f'integrators/{name}' for name in ('euler_substep', 'cpa', 'integrate_stress')), 'conventions/voigt_conventions', 'models/norsand/umat_norsand'
]
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
                    [25 * degree, 0.3, 0.02, 0.1, 1], [-100, 0, 0, 0, 0, 0, 0], unit=1e3, young=1e4, exact='critical state, 6 sin phi / (3 - sin phi)', theirs=slope, strainTensors=[2]),
        'hypoplasticity, intergranular strain':
                Law('patrickstaubach/abaqus-implicit', '7bb189cbc4d7cdcbcc6471e979c41f07a96225f7', ['HPP_Staubach_implicit.f'], 'umat_',
                    [karlsruhe['phi'], 0.37, *list(karlsruhe.values())[1:], 1.2, 2.4, 1e-4, 0.1, 6, 0], [0.8278, 0, 0, 0] + [0] * 21, unit=1e3, young=5e4,
                    exact='examples/laboratory/hypoplasticity.cpp, without intergranular strain', strainTensors=[2], stressTensors=[8]),
        'Sanisand':
                Law('Gzunviwuwenhao/Abaqus_UMAT_sanisand', '5142e53bb7b0de34b8feb490880cff8370b583e1', ['merge/source.F90'], 'umat_', [], [0.76, 0.01, anisotropy, -anisotropy / 2, -anisotropy / 2, 0, 0, 0] + [0] * 10,
                    unit=1e3, young=1e5, flags=['-cpp'], utilities=True, stressTensors=[3]),
        'Cam clay, trust region':
                Law('zhouxin615/NMTR_Method', 'b87f8a312ff15cd2a062f2cd6b917228a92dc733', ['NMTR-Parallel.zip/NMTR-Parallel/NMTR_Method_CTO.for'], 'umat_', [0.1, 0.02, slope, 0.3, 1], [0] * 5,
                    unit=1e3, young=1e4, exact='critical state, 6 sin phi / (3 - sin phi)', theirs=slope),
        'Cam clay, Hvorslev':
                Law('CriticalSoilModels/Modified_Cam_Clay_Potts', 'a2e43985d4ce3d07626c39928688659d2c82e0e6', ['src/Modified_Cam_Clay.f90'], '__mod_umat_cam_clay_MOD_umat', [25 * degree, 0.3, 0.02, 0.1, 2.5, 0.5],
                    [100, 2.5 - 0.1 * math.log(100), 0, 0, 0, 0, 0, 0, 0], unit=1e3, young=1e4, files=['diagnostics_output.txt'], exact='critical state, 6 sin phi / (3 - sin phi)', theirs=slope, strainTensors=[4]),
        'NorSand':
                Law('luisez1988/NorSand-VT', 'c9b7eee83d69fe9aa2463c3cda3872186b74b8f2', ['UMAT_Nor_Sand_Zamb.for'], 'umat_', nerlerk, [0] * 25, unit=1e3, young=1.6e5, flags=['-ffree-form'], pressure=500e3,
                    exact='Benchmark.csv of the repository', theirs=1239.87e3, strainTensors=[9, 15]),
        'NorSand, by modules':
                Law('CriticalSoilModels/critical-soil-models', '71aa203263f4a7671f4b07281ccd4c541833d064', [f'src/{name}.f90' for name in modules], '__mod_umat_norsand_MOD_umat_norsand', nerlerk[:13],
                    [71500, 78309.5, -500, 0.852, 0.0864776, 3.4, -500 / math.e, 1.31702, 0] + [0] * 6, unit=1e3, young=1.6e5, shims=['stdlib_kinds.f90'], pressure=500e3, check=(0.005, 500e3), exact='Benchmark.csv of NorSand-VT', theirs=1239.87e3, strainTensors=[10]),
        'Drucker-Prager':
                Law('JuliaFEM/UMAT.jl', '091d34e317da0ac34271168de1288157718af5fd', [f'umat_models/drucker_prager_plasticity{part}.f90' for part in ('_deriv', '')], 'umat_',
                    [12 / 7 * 3**0.5 * c / 1e3 / 2, 2 * 3**0.5 * c / 1e3, 0, 0, 1, 1, 1e-6, 0, 20e3, 0.3, -1, 0, 1e-9, 50, -1, -1, 2, 1], [0], unit=1e3, young=2e4, utilities=True, shims=['abaqus_units.f90'], check=(0.02, 100e3),
                    exact='Mohr-Coulomb of the plugin, the same in compression'),
        'Cam clay of MFront':
                Law(*gallery, ['generic-behaviours/plasticity/SemiImplicitModifiedCamClay_OpenGeoSys2020.mfront'], 'SemiImplicitModifiedCamClay_OpenGeoSys2020', [52e6, 0.3, 1.2, 6.6e-3, 7.7e-2],
                    [0] * 7 + [2e5, 0, 0.4407158836689038, 1.788], young=52e6, check=(0.01, 100e3), path='generic-behaviours/plasticity/references/SemiImplicitModifiedCamClay_OpenGeoSys2020_Triax.ref',
                    exact='SemiImplicitModifiedCamClay_OpenGeoSys2020_Triax.ref of the repository'),
        'Drucker-Prager with a cap of MFront':
                Law(*gallery, ['generic-behaviours/plasticity/DruckerPragerCap.mfront'], 'DruckerPragerCap', [], [], young=150e9, check=(5e-4, 60e6), theirs=cap(100e3), exact='ellipse of the cap'),
}
