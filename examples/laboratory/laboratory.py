#!/usr/bin/env yade
# SPDX-License-Identifier: GPL-2.0-or-later
"""Laboratory tests on one material point of each law, against closed forms: what a law does, before any scene is built.

	      | |        triaxial    the stress around the sample is kept, or its volume: drained, undrained
	   ___v_v___     biaxial     the stress along x is kept, no strain along z
	 ->|       |<-   oedometer   no strain along x and z
	 ->|_______|<-   shear       along x, under a stress along y that is kept
	   ooooooooo

Run it with `scripts/run examples/laboratory/laboratory.py [options]`, or by yade-batch with the options as columns of a parameter table.
It prints the end of each curve beside its closed form, and draws the curves.
"""
import os
import sys

from yade import mpm
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions
from style import plt

options = readOptions('Laboratory tests on one material point of each law, against closed forms.', steps=(200, 'steps of a test'))

phi, c, pressure = radians(30), 10e3, 50e3
k = (1 + sin(phi)) / (1 - sin(phi))
elastic = dict(young=50e6, poisson=0.3, density=2000)
clay = dict(density=2000, shearModulus=5e6, criticalStateRatio=1.2, compressionIndex=0.1, swellingIndex=0.02, referencePressure=100e3)
worst = 0


def compare(name, found, exact, unit='Pa'):
	"""One line: the end of a curve, the closed form and how far they are apart."""
	global worst
	worst = max(worst, abs(found / exact - 1))
	form = '.0f' if unit == 'Pa' else '.5f'
	print(f'{name:54} {found:12{form}} {unit:2}  closed form {exact:12{form}}  ({100 * (found / exact - 1):+.4f} %)')
	compared(' '.join(name.split()), found, exact, 'closed form', unit)


def test(material, kind, strain, **how):
	return mpm.elementTest(material, kind, strain, steps=options.steps, **how)


def biaxial(axes):
	"""sigma_y = k sigma_x - 2 c sqrt(k) / J at any dilation: c is a Kirchhoff stress, J the volume over that at first."""
	for psi in 0, 15, 30:
		for law in MpmMohrCoulombMat, MpmDruckerPragerMat:
			curve = test(law(cohesion=c, frictionAngle=phi, dilationAngle=radians(psi), **elastic), 'biaxial', -0.03, confiningPressure=pressure)
			stress, J = curve['stress'][:, 1, 1], np.exp(curve['volumetricStrain'])
			line = '-' if law is MpmMohrCoulombMat else '--'
			axes.plot(-100 * curve['axialStrain'], -stress / 1e3, line, label=f'$\\psi$ = {psi}°' if line == '-' else None, color=f'C{psi // 15}')
			compare(f'biaxial, {law.__name__[3:-3]}, psi = {psi}: sigma_y', stress[-1], -k * pressure - 2 * c * sqrt(k) / J[-1])
	axes.axhline((k * pressure + 2 * c * sqrt(k)) / 1e3, color='k', linewidth=0.8, linestyle=':')
	axes.set(title='biaxial, c = 10 kPa, $\\varphi$ = 30°', xlabel='axial compression [%]', ylabel='$-\\sigma_y$ [kPa]')


def simpleShear(axes):
	"""Davis (1968): sin(phi) cos(psi) / (1 - sin(phi) sin(psi))."""
	for psi in 0, 15, 30:
		sand = MpmMohrCoulombMat(cohesion=0, frictionAngle=phi, dilationAngle=radians(psi), **{**elastic, 'young': 1e9})
		curve = test(sand, 'simpleShear', 0.02, confiningPressure=100e3)
		ratio = -curve['stress'][:, 0, 1] / curve['stress'][:, 1, 1]
		exact = sin(phi) * cos(radians(psi)) / (1 - sin(phi) * sin(radians(psi)))
		axes.plot(1000 * curve['shearStrain'], ratio, label=f'$\\psi$ = {psi}°')
		axes.axhline(exact, color='k', linewidth=0.8, linestyle=':')
		compare(f'simple shear, MohrCoulomb, psi = {psi}: tau / sigma_n', ratio[-1], exact, '-')
	axes.set(title='simple shear, c = 0, $\\varphi$ = 30°', xlabel='shear strain [‰]', ylabel='$\\tau/\\sigma_n$ [-]', xlim=(0, 2))


def camClay(undrained, drained):
	"""Critical states: undrained p = p0 (OCR / 2)^(1 - kappa / lambda), drained p = 3 p0 / (3 - M); q = M p."""
	p0, M = 100e3, clay['criticalStateRatio']
	for OCR in 1, 2, 5:
		soil = MpmCamClayMat(preconsolidation=OCR * p0, **clay)
		curve, p = test(soil, 'undrainedTriaxial', -0.4, confiningPressure=p0), p0 * (OCR / 2)**(1 - clay['swellingIndex'] / clay['compressionIndex'])
		undrained.plot(curve['p'] / 1e3, curve['q'] / 1e3, label=f'OCR = {OCR}')
		undrained.plot(p / 1e3, M * p / 1e3, 'k.', zorder=3)
		compare(f'triaxial undrained, CamClay, OCR = {OCR}: p', curve['p'][-1], p)
		compare(f'triaxial undrained, CamClay, OCR = {OCR}: q', curve['q'][-1], M * p)
		curve, p = test(soil, 'triaxial', -1.2, confiningPressure=p0), 3 * p0 / (3 - M)
		drained.plot(-100 * curve['axialStrain'], curve['q'] / 1e3, label=f'OCR = {OCR}')
		drained.axhline(M * p / 1e3, color='k', linewidth=0.8, linestyle=':')
		compare(f'triaxial drained, CamClay, OCR = {OCR}: p', curve['p'][-1], p)
		compare(f'triaxial drained, CamClay, OCR = {OCR}: q', curve['q'][-1], M * p)
	undrained.plot([0, 250], [0, M * 250], 'k:', linewidth=0.8)
	undrained.set(title='Cam clay, undrained', xlabel='p [kPa]', ylabel='q [kPa]')
	drained.set(title='Cam clay, drained', xlabel='axial compression [%]', ylabel='q [kPa]', xlim=(0, 60))


def oedometer(axes):
	"""Elastic: sigma_y = (K + 4 G / 3) ln(l) / l of the length l over that at first."""
	E, nu = 1e6, 0.3
	curve = test(MpmElasticMat(young=E, poisson=nu, density=2000), 'oedometer', log(0.5))
	length, modulus = np.exp(curve['axialStrain']), E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
	exact = modulus * np.log(length) / length
	axes.plot(length, -curve['stress'][:, 1, 1] / 1e3, label='elastic')
	axes.plot(length[::options.steps // 10], -exact[::options.steps // 10] / 1e3, 'k.')
	compare('oedometer, Elastic, to 0.5 of the height: sigma_y', curve['stress'][-1, 1, 1], exact[-1])
	curve = test(MpmElasticMat(young=E, poisson=nu, density=2000), 'oedometer', log(0.8))
	compare('oedometer, Elastic, to 0.8 of the height: sigma_y', curve['stress'][-1, 1, 1], modulus * log(0.8) / 0.8)
	axes.set(title='oedometer, E = 1 MPa, $\\nu$ = 0.3', xlabel='height over that at first [-]', ylabel='$-\\sigma_y$ [kPa]')
	axes.invert_xaxis()


def undrainedStrength(axes):
	"""Tresca: q = 2 c_u. Von Mises: sqrt(2 J2) = rho_0 + H a of the plastic strain a, which is the strain less its elastic part."""
	rho, G, end = 15e3, elastic['young'] / (2 * (1 + elastic['poisson'])), 0.02
	curve = test(MpmTrescaMat(undrainedStrength=10e3, **elastic), 'undrainedTriaxial', -end)
	axes.plot(-100 * curve['axialStrain'], curve['q'] / 1e3, label='Tresca, $c_u$ = 10 kPa')
	compare('triaxial undrained, Tresca: q', curve['q'][-1], 20e3)
	for H in -200e3, 0, 500e3:
		curve = test(MpmVonMisesMat(yieldStress=rho, hardening=H, **elastic), 'undrainedTriaxial', -end)
		exact = sqrt(1.5) * (rho + H * end) / (1 + sqrt(2 / 3) * H / (2 * G))
		axes.plot(-100 * curve['axialStrain'], curve['q'] / 1e3, label=f'von Mises, H = {H / 1e3:g} kPa')
		axes.plot(100 * end, exact / 1e3, 'k.', zorder=3)
		compare(f'triaxial undrained, VonMises, H = {H / 1e3:g} kPa: q', curve['q'][-1], exact)
	axes.set(title='undrained strength', xlabel='axial compression [%]', ylabel='q [kPa]', ylim=(0, 36))


def hardeningSoil(drained, pressed):
	"""q of the axial strain e: e Ei / (1 + e Ei Rf / qf), Ei = 2 E50 / (2 - Rf), up to qf. In the oedometer Eoed and K0nc."""
	angle, E, Rf = radians(35), 30e6, 0.9
	soil = MpmHardeningSoilMat(density=2000, E50ref=E, Eoedref=E, Eurref=3 * E, power=0.5, cohesion=0, frictionAngle=angle, dilationAngle=radians(5), K0nc=1 - sin(angle))
	for p in 50e3, 100e3, 200e3:
		curve = test(soil, 'triaxial', -0.02, confiningPressure=p, capPressure=1e8)
		strain, strength, first = -curve['axialStrain'], 2 * sin(angle) / (1 - sin(angle)) * p, 2 * E * sqrt(p / 100e3) / (2 - Rf)
		exact = np.minimum(strain * first / (1 + strain * first * Rf / strength), strength)
		drained.plot(100 * strain, curve['q'] / 1e3, label=f'{p / 1e3:g} kPa')
		drained.plot(100 * strain[::options.steps // 10], exact[::options.steps // 10] / 1e3, 'k.')
		compare(f'triaxial drained, HardeningSoil, {p / 1e3:g} kPa: q', curve['q'][-1], exact[-1])
	drained.set(title='hardening soil, drained', xlabel='axial compression [%]', ylabel='q [kPa]')
	curve = test(soil, 'oedometer', -0.006, initialStress=-20e3 * np.array([soil.K0nc, 1, soil.K0nc]))
	stress, strain = -curve['stress'][:, 1, 1] * np.exp(curve['volumetricStrain']), -curve['axialStrain']
	pressed.plot(100 * strain, stress / 1e3, label=r'$\sigma_y$')
	pressed.plot(100 * strain, -curve['stress'][:, 0, 0] / 1e3, label=r'$\sigma_x$')
	modulus = np.interp(100e3, (stress[1:] + stress[:-1]) / 2, np.diff(stress) / np.diff(strain))
	compare('oedometer, HardeningSoil, at 100 kPa: tangent modulus', modulus, E)
	compare('oedometer, HardeningSoil: sigma_x / sigma_y', curve['stress'][-1, 0, 0] / curve['stress'][-1, 1, 1], soil.K0nc, '-')
	pressed.set(title='hardening soil, oedometer', xlabel='axial compression [%]', ylabel='pressure [kPa]')


def powerModuli(axes):
	"""s (K_s + 4 G / 3) e of the strain e, s = (K_s / p sqrt(e^2 (1 + 4 G / (3 K_s)) + a^2))^(n / (1 - n)), K_s = (1 - n) K (Houlsby, Amorosi and Rojas 2005)."""
	E, nu, p = 30e6, 0.2, 100e3
	K, G = E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu))
	for n in 0.3, 0.5, 0.8:
		soil = MpmMohrCoulombMat(young=E, poisson=nu, power=n, referencePressure=p, cohesion=1e8, frictionAngle=phi, density=2000)
		curve, Ks = test(soil, 'oedometer', -0.01), (1 - n) * K
		strain, a = curve['axialStrain'], 0.01**(1 - n) * p / Ks
		stiffness = (Ks / p * np.sqrt(strain**2 * (1 + 4 * G / (3 * Ks)) + a**2))**(n / (1 - n))
		exact = stiffness * (Ks + 4 * G / 3) * strain / np.exp(strain)
		axes.plot(-100 * strain, -curve['stress'][:, 1, 1] / 1e3, label=f'n = {n}')
		axes.plot(-100 * strain[::options.steps // 10], -exact[::options.steps // 10] / 1e3, 'k.')
		compare(f'oedometer, MohrCoulomb, power = {n}: sigma_y', curve['stress'][-1, 1, 1], exact[-1])
	axes.set(title='moduli by power, oedometer', xlabel='axial compression [%]', ylabel='$-\\sigma_y$ [kPa]')


def norSand(axes):
	"""The critical state, Q = M P: of undrained shear long before the pressure is that of the critical state."""
	sand = MpmNorSandMat(density=2000, shearModulus=45e6, swellingIndex=0.0015, referencePressure=100e3, criticalStateRatio=1.27, compressionIndex=0.02, criticalVolume=1.8911, hardening=70, specificVolume=1.75)
	curve = test(sand, 'undrainedTriaxial', -4, confiningPressure=390e3)
	axes.plot(curve['p'] / 1e3, curve['q'] / 1e3, label='v = 1.75, 390 kPa')
	axes.plot(np.array([0, curve['p'].max()]) / 1e3, 1.27 * np.array([0, curve['p'].max()]) / 1e3, 'k:', linewidth=0.8)
	axes.set(title='NorSand, undrained', xlabel='p [kPa]', ylabel='q [kPa]')
	compare('triaxial undrained, NorSand: q / p', curve['q'][-1] / curve['p'][-1], 1.27, '-')


def bingham():
	"""In steady shear the strength, and viscosity times the rate of shear."""
	mud = MpmVonMisesMat(young=1e6, poisson=0.3, density=2000, yieldStress=sqrt(2) * 100, viscosity=40)
	curve = test(mud, 'simpleShear', 0.01, duration=0.004)
	compare('simple shear, Bingham, 2.5 / s: tau', curve['stress'][-1, 0, 1], 100 + 40 * 2.5)


figure, axes = plt.subplots(2, 5, figsize=(17, 7.2), layout='constrained')
biaxial(axes[0, 0])
simpleShear(axes[0, 1])
undrainedStrength(axes[0, 2])
camClay(axes[1, 0], axes[1, 1])
oedometer(axes[1, 2])
hardeningSoil(axes[0, 3], axes[1, 3])
powerModuli(axes[0, 4])
norSand(axes[1, 4])
bingham()
for one in axes.flat:
	one.legend(frameon=False, fontsize='small')
print(f'largest difference from a closed form: {100 * worst:.4f} %')
figure.savefig(os.path.join(options.out, 'laboratory.png'), dpi=110)
print(f'written: {options.out}/laboratory.png')
