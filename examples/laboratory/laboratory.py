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
import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt
import numpy as np
sys.path.insert(0, os.path.join(os.path.dirname(sys.argv[0]), '..'))
from options import compared, readOptions

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


figure, axes = plt.subplots(2, 3, figsize=(12, 7.2), layout='constrained')
biaxial(axes[0, 0])
simpleShear(axes[0, 1])
undrainedStrength(axes[0, 2])
camClay(axes[1, 0], axes[1, 1])
oedometer(axes[1, 2])
for one in axes.flat:
	one.legend(frameon=False, fontsize='small')
print(f'largest difference from a closed form: {100 * worst:.4f} %')
figure.savefig(os.path.join(options.out, 'laboratory.png'), dpi=130)
print(f'written: {options.out}/laboratory.png')
