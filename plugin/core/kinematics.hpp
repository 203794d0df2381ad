// SPDX-License-Identifier: GPL-2.0-or-later
// Finite-strain kinematics of one material point, and the spatial tangent in principal axes.
//
// The elastic left Cauchy-Green tensor b is carried as b - 1: strains as small as 1e-300 keep their relative precision, where
// b itself would round them to 1e-16.
#pragma once
#include "core/materials/response.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace gimpm {

/// Principal values and axes (columns) of a symmetric tensor. In plane strain the third value is the out-of-plane one.
template <int Dim> struct Principal {
	Vec3     value;
	Mat<Dim> axes;
};

/// sqrt(p^2 + q^2) without underflow, faster than std::hypot, which is exact to the last bit.
inline double length(double p, double q)
{
	const double large = std::max(std::abs(p), std::abs(q)), small = std::min(std::abs(p), std::abs(q));
	if (large == 0) return 0;
	const double ratio = small / large;
	return large * std::sqrt(1 + ratio * ratio);
}

inline Principal<2> principal(const SymTensor<2>& t)
{
	const double mean = 0.5 * (t.c[0] + t.c[1]), p = 0.5 * (t.c[0] - t.c[1]), q = t.c[2];
	const double r = length(p, q);
	double       c = 1, s = 0; // cosine and sine of the angle of the first axis; half-angle formulas without cancellation
	if (r > 0) {
		const double large = std::sqrt(0.5 * (1 + std::abs(p) / r)), small = 0.5 * std::abs(q) / (r * large);
		c = p >= 0 ? large : small;
		s = std::copysign(p >= 0 ? small : large, q);
	}
	Principal<2> result;
	result.value      = Vec3(mean + r, mean - r, t.c[3]);
	result.axes(0, 0) = result.axes(1, 1) = c;
	result.axes(1, 0) = s, result.axes(0, 1) = -s;
	return result;
}

inline Principal<3> principal(const SymTensor<3>& t)
{
	const Eigen::SelfAdjointEigenSolver<Mat3> eigen(t.full());
	return { eigen.eigenvalues(), eigen.eigenvectors() };
}

/// The tensor with these principal values and axes.
inline SymTensor<2> assemble(const Vec3& value, const Mat<2>& axes)
{
	return SymTensor<2>::from(Mat<2>(axes * value.head<2>().asDiagonal() * axes.transpose()), value[2]);
}
inline SymTensor<3> assemble(const Vec3& value, const Mat3& axes) { return SymTensor<3>::from(Mat3(axes * value.asDiagonal() * axes.transpose())); }

/// b - 1 of an elastic logarithmic strain: exp(2 strain) - 1.
template <int Dim> SymTensor<Dim> leftCauchyGreenMinusOne(const SymTensor<Dim>& elasticStrain)
{
	const auto p = principal(elasticStrain);
	return assemble(p.value.unaryExpr([](double e) { return std::expm1(2 * e); }), p.axes);
}

/// b - 1 after the increment F <- (1 + grad) F, where grad_ij = d u_i / d X_j of the increment (unsymmetric).
inline SymTensor<2> pushForward(const SymTensor<2>& b1, const Mat<2>& grad)
{
	const Mat<2> dF = Mat<2>::Identity() + grad;
	return SymTensor<2>::from(Mat<2>(dF * b1.inPlane() * dF.transpose() + grad + grad.transpose() + grad * grad.transpose()), b1.c[3]);
}
inline SymTensor<3> pushForward(const SymTensor<3>& b1, const Mat3& grad)
{
	const Mat3 dF = Mat3::Identity() + grad;
	return SymTensor<3>::from(Mat3(dF * b1.full() * dF.transpose() + grad + grad.transpose() + grad * grad.transpose()));
}

/// Logarithmic strains of principal values of b - 1.
inline Vec3 logStrain(const Vec3& b1)
{
	return b1.unaryExpr([](double x) { return 0.5 * std::log1p(x); });
}

/// d coth d: its series, exact to round-off for small d, is several times faster than tanh.
inline double dCoth(double d)
{
	const double x = d * d;
	if (x > 0.01) return d / std::tanh(d);
	return 1 + x * (1. / 3 + x * (-1. / 45 + x * (2. / 945 + x * (-1. / 4725 + x * (2. / 93555)))));
}

/// Rows and columns (i, j) -> i * Dim + j: d (J sigma)-type moduli, so that stiffness_ab,ik = V_0 grad_a,j (J a)_ijkl grad_b,l.
template <int Dim> using Moduli = Eigen::Matrix<double, Dim * Dim, Dim * Dim>;

/// J times the spatial tangent a = D:L:B / 2J - sigma_il delta_jk in global axes.
///
/// In the principal axes of the trial strain (strains e, stresses t) with d = e_i - e_j and the law's secant shear modulus G_s
///   J a_iijj = D_ij - t_i delta_ij,   J a_ijji = m,   J a_ijij = m + t_j,   m = G_s d coth d - (t_i + t_j)/2,
/// where d coth d -> 1 for coinciding stretches: there is nothing to switch.
template <int Dim> Moduli<Dim> spatialModuli(const Response& r, const Vec3& strain, const Mat<Dim>& axes)
{
	Moduli<Dim> local = Moduli<Dim>::Zero(), rotation;
	for (int i = 0; i < Dim; ++i)
		for (int j = 0; j < Dim; ++j) {
			local(i * Dim + i, j * Dim + j) = r.tangent(i, j) - (i == j ? r.stress[i] : 0);
			for (int k = 0; k < Dim; ++k)
				for (int l = 0; l < Dim; ++l)
					rotation(i * Dim + j, k * Dim + l) = axes(i, k) * axes(j, l);
		}
	for (int i = 0; i < Dim; ++i)
		for (int j = i + 1; j < Dim; ++j) {
			const double d      = strain[i] - strain[j];
			const double secant = r.shear[i + j == 1 ? 0 : (i + j == 3 ? 1 : 2)];
			const double m      = secant * dCoth(d) - 0.5 * (r.stress[i] + r.stress[j]);
			const int    ij = i * Dim + j, ji = j * Dim + i;
			local(ij, ji) = local(ji, ij) = m;
			local(ij, ij)                 = m + r.stress[j];
			local(ji, ji)                 = m + r.stress[i];
		}
	return rotation * local * rotation.transpose();
}

/// Diagonal of the right stretch tensor U = sqrt(F^T F): a domain follows it along the grid axes.
template <int Dim> Vec<Dim> stretchAlongAxes(const Mat<Dim>& F)
{
	if constexpr (Dim == 2) { // by the theorem of Cayley and Hamilton U = (C + J) / sqrt(tr C + 2 J)
		const double J = F.determinant(), cxx = F.col(0).squaredNorm(), cyy = F.col(1).squaredNorm();
		return Vec<2>(cxx + J, cyy + J) / std::sqrt(cxx + cyy + 2 * J);
	} else {
		const Eigen::SelfAdjointEigenSolver<Mat3> eigen(Mat3(F.transpose() * F));
		return eigen.operatorSqrt().diagonal();
	}
}

} // namespace gimpm
