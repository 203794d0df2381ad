// SPDX-License-Identifier: GPL-2.0-or-later
// Finite-strain kinematics of one material point, and the tangent in principal axes. T is double, or Lanes for several
// points at once.
//
// The elastic left Cauchy-Green tensor b is carried as b - 1: strains as small as 1e-300 keep their relative precision,
// where b itself would round them to 1e-16.
#pragma once
#include "core/materials/response.hpp"
#include <Eigen/LU>
#include <cmath>

namespace gimpm {

template <int Dim, class T> using MatrixOf = Eigen::Matrix<T, Dim, Dim>;

/// Principal values and axes (columns) of a symmetric tensor. In plane strain the third value is the out-of-plane one.
template <int Dim, class T = double> struct Principal {
	PrincipalValues<T> value;
	MatrixOf<Dim, T>   axes;
};

/// sqrt(p^2 + q^2) without underflow, faster than std::hypot, which is exact to the last bit.
template <class T> GIMPM_INLINE T length(const T& p, const T& q)
{
	const T    a = abs(p), b = abs(q), large = select(a > b, a, b), small = select(a > b, b, a);
	const auto some  = large > T(0);
	const T    ratio = small / select(some, large, T(1));
	return large * sqrt(T(1) + ratio * ratio);
}

template <class T> GIMPM_INLINE Principal<2, T> principal(const SymTensor<2, T>& t)
{
	const T    mean = T(0.5) * (t.c[0] + t.c[1]), p = T(0.5) * (t.c[0] - t.c[1]), q = t.c[2];
	const T    r    = length(p, q);
	const auto some = r > T(0);
	// cosine and sine of the angle of the first axis; half-angle formulas without cancellation
	const T         safe = select(some, r, T(1)), large = sqrt(T(0.5) * (T(1) + abs(p) / safe)), small = T(0.5) * (abs(q) / safe) / large;
	const auto      upright = p >= T(0);
	const T         c = select(some, select(upright, large, small), T(1)), s = select(some, copysign(select(upright, small, large), q), T(0));
	Principal<2, T> result;
	result.value      = PrincipalValues<T>(mean + r, mean - r, t.c[3]);
	result.axes(0, 0) = result.axes(1, 1) = c;
	result.axes(1, 0) = s, result.axes(0, 1) = -s;
	return result;
}

/// Jacobi's method turns the plane (p, q) such that m(p, q) vanishes (Golub and Van Loan, Matrix Computations, section
/// 8.5).
template <class T> GIMPM_INLINE void jacobiRotation(MatrixOf<3, T>& m, MatrixOf<3, T>& axes, int p, int q)
{
	const T    off   = m(p, q);
	const auto some  = abs(off) > T(0);
	const T    theta = T(0.5) * (m(q, q) - m(p, p)) / select(some, off, T(1));
	const T    t     = select(some, copysign(T(1), theta) / (abs(theta) + sqrt(theta * theta + T(1))), T(0));
	const T    c = T(1) / sqrt(t * t + T(1)), s = t * c;
	const int  k = 3 - p - q;
	m(p, p) -= t * off;
	m(q, q) += t * off;
	m(p, q) = m(q, p) = T(0);
	const T kp = m(k, p), kq = m(k, q);
	m(k, p) = m(p, k) = c * kp - s * kq;
	m(k, q) = m(q, k) = s * kp + c * kq;
	for (int i = 0; i < 3; ++i) {
		const T ip = axes(i, p), iq = axes(i, q);
		axes(i, p) = c * ip - s * iq;
		axes(i, q) = s * ip + c * iq;
	}
}

template <class T> GIMPM_INLINE Principal<3, T> principal(const SymTensor<3, T>& t)
{
	Principal<3, T> result;
	MatrixOf<3, T>  m = t.full();
	result.axes       = MatrixOf<3, T>::Identity();
	// Convergence is quadratic: five are enough, and numbers that are none must not keep it going.
	constexpr int sweeps = 12;
	for (int sweep = 0; sweep < sweeps; ++sweep) {
		const T off = abs(m(0, 1)) + abs(m(1, 2)) + abs(m(0, 2)), size = abs(m(0, 0)) + abs(m(1, 1)) + abs(m(2, 2));
		if (everywhere(off <= T(1e-18) * size)) break;
		jacobiRotation(m, result.axes, 0, 1);
		jacobiRotation(m, result.axes, 1, 2);
		jacobiRotation(m, result.axes, 0, 2);
	}
	result.value = m.diagonal();
	return result;
}

/// The tensor with these principal values and axes.
template <class T, int Dim> GIMPM_INLINE SymTensor<Dim, T> assemble(const PrincipalValues<T>& value, const Eigen::Matrix<T, Dim, Dim>& axes)
{
	MatrixOf<Dim, T> scaled;
	for (int k = 0; k < Dim; ++k)
		scaled.col(k) = axes.col(k) * value[k];
	return SymTensor<Dim, T>::from(MatrixOf<Dim, T>(scaled.lazyProduct(axes.transpose())), value[2]);
}

/// b - 1 of an elastic logarithmic strain: exp(2 strain) - 1.
template <int Dim> SymTensor<Dim> leftCauchyGreenMinusOne(const SymTensor<Dim>& elasticStrain)
{
	const auto p = principal(elasticStrain);
	return assemble<double, Dim>(p.value.unaryExpr([](double e) { return std::expm1(2 * e); }), p.axes);
}

/// b - 1 after the increment F <- (1 + grad) F, where grad_ij = d u_i / d X_j of the increment (unsymmetric).
template <class T, int Dim> GIMPM_INLINE SymTensor<Dim, T> pushForward(const SymTensor<Dim, T>& b1, const Eigen::Matrix<T, Dim, Dim>& grad)
{
	using M         = MatrixOf<Dim, T>;
	const M inPlane = b1.inPlane(), gb = grad.lazyProduct(inPlane), increment = inPlane + gb + gb.transpose() + M(gb.lazyProduct(grad.transpose()));
	return SymTensor<Dim, T>::from(M(increment + grad + grad.transpose() + M(grad.lazyProduct(grad.transpose()))), b1.c[Dim == 2 ? 3 : 2]);
}

/// log(1 + x): its series, exact to round-off for small x, is several times faster than std::log1p.
template <class T> GIMPM_INLINE T log1p(const T& x)
{
	if (!everywhere(abs(x) <= T(0.1))) return each(x, [](double y) { return std::log1p(y); });
	const T s = x / (T(2) + x), z = s * s; // log(1 + x) = 2 artanh s
	return T(2) * s * (T(1) + z * (T(1. / 3) + z * (T(1. / 5) + z * (T(1. / 7) + z * (T(1. / 9) + z * (T(1. / 11) + z * T(1. / 13)))))));
}

/// Logarithmic strains of principal values of b - 1.
template <class T> GIMPM_INLINE PrincipalValues<T> logStrain(const Eigen::Matrix<T, 3, 1>& b1)
{
	return { T(0.5) * log1p(b1[0]), T(0.5) * log1p(b1[1]), T(0.5) * log1p(b1[2]) };
}

/// d coth d: its series, exact to round-off for small d, is several times faster than std::tanh.
template <class T> GIMPM_INLINE T dCoth(const T& d)
{
	const T x = d * d;
	if (!everywhere(x <= T(0.01))) return each(d, [](double y) { return y == 0 ? 1 : y / std::tanh(y); });
	return T(1) + x * (T(1. / 3) + x * (T(-1. / 45) + x * (T(2. / 945) + x * (T(-1. / 4725) + x * T(2. / 93555)))));
}

/// Volumetric strain of an elastic logarithmic strain given by b - 1.
template <int Dim> double volumetricStrain(const SymTensor<Dim>& b1) { return 0.5 * std::log((b1.full() + Mat3::Identity()).determinant()); }

/// Rows and columns (i, j) -> i * Dim + j: moduli a such that stiffness_ab,ik = grad_a,j a_ijkl grad_b,l.
template <int Dim, class T = double> using Moduli = Eigen::Matrix<T, Dim * Dim, Dim * Dim>;

/// J times the tangent a = D:L:B / 2J - sigma_il delta_jk, in the axes q_k (columns) for the first index of a pair, w_k
/// for the second. With w = q these are the moduli for gradients in the current configuration. With w = F^-1 q (F of
/// the increment) they go with gradients in the configuration at the start of the step, which do not change from
/// iteration to iteration.
///
/// In the principal axes of the trial strain (strains e, stresses t) with d = e_i - e_j and the law's secant shear
/// modulus G_s
///   J a_iijj = D_ij - t_i delta_ij,   J a_ijji = m,   J a_ijij = m + t_j,   m = G_s d coth d - (t_i + t_j)/2,
/// where d coth d -> 1 for coinciding stretches: there is nothing to switch.
template <int Dim, class T>
GIMPM_INLINE Moduli<Dim, T> moduli(
        const ResponseOf<T>& r, const PrincipalValues<T>& strain, const Eigen::Matrix<T, Dim, Dim>& q, const Eigen::Matrix<T, Dim, Dim>& w)
{
	constexpr int  n = Dim * Dim;
	Moduli<Dim, T> axes, stress; // columns: q_i w_j; and their products with the moduli in principal axes
	for (int i = 0; i < Dim; ++i)
		for (int j = 0; j < Dim; ++j)
			for (int a = 0; a < n; ++a)
				axes(a, i * Dim + j) = q(a / Dim, i) * w(a % Dim, j);
	for (int i = 0; i < Dim; ++i) {
		for (int a = 0; a < n; ++a) {
			T sum = (r.tangent(i, i) - r.stress[i]) * axes(a, i * (Dim + 1));
			for (int j = 0; j < Dim; ++j)
				if (j != i) sum += r.tangent(j, i) * axes(a, j * (Dim + 1));
			stress(a, i * (Dim + 1)) = sum;
		}
		for (int j = i + 1; j < Dim; ++j) {
			const T   secant = r.shear[i + j == 1 ? 0 : (i + j == 3 ? 1 : 2)];
			const T   m      = secant * dCoth(T(strain[i] - strain[j])) - T(0.5) * (r.stress[i] + r.stress[j]);
			const int ij = i * Dim + j, ji = j * Dim + i;
			for (int a = 0; a < n; ++a) {
				const T sum   = m * (axes(a, ij) + axes(a, ji));
				stress(a, ij) = sum + r.stress[j] * axes(a, ij);
				stress(a, ji) = sum + r.stress[i] * axes(a, ji);
			}
		}
	}
	return stress.lazyProduct(axes.transpose());
}

/// In global axes, for gradients in the current configuration.
template <int Dim> Moduli<Dim> spatialModuli(const Response& r, const Vec3& strain, const Mat<Dim>& axes) { return moduli<Dim, double>(r, strain, axes, axes); }

} // namespace gimpm
