// SPDX-License-Identifier: GPL-2.0-or-later
// Vectors and tensors of the core; the dimension is 2 (plane strain in x-y) or 3.
#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace gimpm {

template <int Dim> using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim> using Mat = Eigen::Matrix<double, Dim, Dim>;
using Vec3                   = Vec<3>;
using Mat3                   = Mat<3>;

/// Integer coordinates of a cell or node of the background grid.
template <int Dim> using Index = Eigen::Matrix<int, Dim, 1>;

/// Symmetric second-order tensor. Plane strain keeps the out-of-plane normal component.
/// Components: 2D (xx, yy, xy, zz), 3D (xx, yy, zz, xy, yz, zx).
template <int Dim> struct SymTensor;

template <> struct SymTensor<2> {
	Eigen::Vector4d c = Eigen::Vector4d::Zero();

	Mat<2>        inPlane() const
	{
		Mat<2> m;
		m(0, 0) = c[0], m(1, 1) = c[1], m(0, 1) = m(1, 0) = c[2];
		return m;
	}
	Mat3          full() const
	{
		Mat3 m = Mat3::Zero();
		m.topLeftCorner<2, 2>() = inPlane(), m(2, 2) = c[3];
		return m;
	}
	static SymTensor from(const Mat<2>& m, double zz)
	{
		SymTensor t;
		t.c[0] = m(0, 0), t.c[1] = m(1, 1), t.c[2] = 0.5 * (m(0, 1) + m(1, 0)), t.c[3] = zz;
		return t;
	}
	static SymTensor from(const Mat3& m) { return from(Mat<2>(m.topLeftCorner<2, 2>()), m(2, 2)); }
};

template <> struct SymTensor<3> {
	Eigen::Matrix<double, 6, 1> c = Eigen::Matrix<double, 6, 1>::Zero();

	Mat3          inPlane() const { return full(); }
	Mat3          full() const
	{
		Mat3 m;
		m(0, 0) = c[0], m(1, 1) = c[1], m(2, 2) = c[2];
		m(0, 1) = m(1, 0) = c[3], m(1, 2) = m(2, 1) = c[4], m(2, 0) = m(0, 2) = c[5];
		return m;
	}
	static SymTensor from(const Mat3& m)
	{
		SymTensor t;
		t.c << m(0, 0), m(1, 1), m(2, 2), 0.5 * (m(0, 1) + m(1, 0)), 0.5 * (m(1, 2) + m(2, 1)), 0.5 * (m(2, 0) + m(0, 2));
		return t;
	}
};

} // namespace gimpm
