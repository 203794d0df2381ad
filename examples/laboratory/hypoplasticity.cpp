// SPDX-License-Identifier: GPL-2.0-or-later
// Hypoplastic sand (P.-A. von Wolffersdorff 1996, A hypoplastic relation for granular materials with a predefined limit
// state surface, Mech. Cohesive-Frictional Mater. 1, 251-271) for MpmUserMat, by Abaqus' interface of user materials:
// the rate of the stress T is f_s (L : D + f_d N ||D||), with neither elastic strain nor yield surface.
//
// Constants: phi_c [rad], h_s [Pa], n, e_d0, e_c0, e_i0, alpha, beta, and a small pressure [Pa] that is added to that of
// the stress, as the law has no stiffness without any. State variable: the void ratio.
//
//	g++ -O2 -shared -fPIC -I /usr/include/eigen3 -o hypoplasticity.so hypoplasticity.cpp
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace {

using Tensor = Eigen::Matrix<double, 6, 1>; // Mandel's numbers: xx, yy, zz, and sqrt(2) times xy, xz, yz
using Matrix = Eigen::Matrix<double, 6, 6>;

const Tensor unit = (Tensor() << 1, 1, 1, 0, 0, 0).finished();
const double root = std::sqrt(2.);

Tensor mandel(const double* numbers, double ofShear)
{
	Tensor t;
	for (int i = 0; i < 6; ++i)
		t[i] = numbers[i] * (i < 3 ? 1 : root / ofShear);
	return t;
}

double cubed(const Tensor& t) // trace of t t t
{
	Eigen::Matrix3d m;
	m << t[0], t[3] / root, t[4] / root, t[3] / root, t[1], t[5] / root, t[4] / root, t[5] / root, t[2];
	return (m * m * m).trace();
}

struct Sand {
	double friction, hardness, exponent, dense, critical, loose, alpha, beta, added;

	explicit Sand(const double* c)
	        : friction(c[0]), hardness(c[1]), exponent(c[2]), dense(c[3]), critical(c[4]), loose(c[5]), alpha(c[6]), beta(c[7]), added(c[8])
	{
	}

	/// The linear part f_s L, and f_s f_d N.
	void stiffness(const Tensor& stress, double voids, Matrix& linear, Tensor& other) const
	{
		const Tensor T = stress - added * unit;
		const double pressure = -T.dot(unit); // three times the mean one
		const Tensor hat = -T / pressure, deviator = hat - unit / 3;
		const double size = deviator.norm(), tangent = std::sqrt(3.) * size, sine = std::sin(friction);
		const double lode = size > 1e-12 ? std::clamp(-std::sqrt(6.) * cubed(deviator) / (size * size * size), -1., 1.) : 1;
		const double a = std::sqrt(3.) * (3 - sine) / (2 * root * sine), tangent2 = tangent * tangent;
		const double F = std::sqrt(std::max(0., tangent2 / 8 + (2 - tangent2) / (2 + root * tangent * lode))) - tangent / (2 * root);

		const double fall = std::exp(-std::pow(pressure / hardness, exponent)), ed = dense * fall, ec = critical * fall, ei = loose * fall;
		const double range = (loose - dense) / (critical - dense);
		const double fd = std::pow(std::max(0., (voids - ed) / (ec - ed)), alpha), fe = std::pow(ec / voids, beta);
		const double fb = hardness / exponent * std::pow(loose / critical, beta) * (1 + ei) / ei * std::pow(pressure / hardness, 1 - exponent)
		        / (3 + a * a - std::sqrt(3.) * a * std::pow(range, alpha));
		const double fs = fb * fe / hat.squaredNorm();
		linear = fs * (F * F * Matrix::Identity() + a * a * hat * hat.transpose());
		other  = fs * fd * a * F * (hat + deviator);
	}

	/// Heun's method, in steps of strain of at most 2e-5.
	void integrate(const Tensor& increment, Tensor& stress, double& voids) const
	{
		const int    steps = std::max(1, int(std::ceil(increment.norm() / 2e-5)));
		const Tensor part = increment / steps;
		Matrix       linear;
		Tensor       other;
		for (int k = 0; k < steps; ++k) {
			stiffness(stress, voids, linear, other);
			const Tensor first = linear * part + other * part.norm();
			const double grown = voids + (1 + voids) * std::expm1(part.dot(unit));
			stiffness(stress + first, grown, linear, other);
			stress += (first + linear * part + other * part.norm()) / 2;
			voids = grown;
		}
	}
};

} // namespace

extern "C" void umat_(
        double* stress, double* state, double* tangent, double*, double*, double*, double*, double*, double*, double*, const double*, const double* increment,
        const double*, const double*, const double*, const double*, const double*, const double*, const char*, const int*, const int*, const int*, const int*,
        const double* properties, const int*, const double*, const double*, double* shorter, const double*, const double*, const double*, const int*,
        const int*, const int*, const int*, const int*, const int*, int)
{
	const Sand   sand(properties);
	const Tensor before = mandel(stress, 1), step = mandel(increment, 2);
	const double voids = state[0], size = step.norm();
	if (size > .02 || !(before.dot(unit) < 3 * sand.added)) { // too long a step; or no pressure
		*shorter = .5;
		return;
	}
	Tensor after = before;
	sand.integrate(step, after, state[0]);
	if (!(after.dot(unit) < 3 * sand.added)) *shorter = .5;
	for (int i = 0; i < 6; ++i)
		stress[i] = after[i] / (i < 3 ? 1 : root);

	Matrix D; // derivative by differences, but at rest, where the law has a corner and its linear part lies in the middle
	Tensor other;
	if (size < 1e-12) sand.stiffness(before, voids, D, other);
	for (int c = 0; c < 6 && size >= 1e-12; ++c) {
		const Tensor h     = 1e-4 * size * Tensor::Unit(c);
		Tensor       above = before, below = before;
		double       e1 = voids, e2 = voids;
		sand.integrate(step + h, above, e1), sand.integrate(step - h, below, e2);
		D.col(c) = (above - below) / (2e-4 * size);
	}
	for (int i = 0; i < 6; ++i)
		for (int j = 0; j < 6; ++j)
			tangent[i + 6 * j] = D(i, j) / ((i < 3 ? 1 : root) * (j < 3 ? 1 : root));
}
