// SPDX-License-Identifier: GPL-2.0-or-later
// Vectors and tensors of the core; the dimension is 2 (plane strain in x-y) or 3.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace gimpm {

template <int Dim> using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim> using Mat = Eigen::Matrix<double, Dim, Dim>;
using Vec3                   = Vec<3>;
using Mat3                   = Mat<3>;

/// Integer coordinates of a cell or node of the background grid.
template <int Dim> using Index = Eigen::Matrix<int, Dim, 1>;

/// Sortable name of a cell or node: its integer coordinates packed so that x runs fastest, and above them its level:
/// cells of level l are 2^l times as large as the smallest ones, of which coordinates are numbers. A cell is named
/// after its lowest node, and the key of a neighbour of the same level is the key plus a constant, whatever the
/// position in the grid.
using Key = std::uint64_t;

/// Internal variables of the points, column by column (core/materials/law.hpp says which is which). A column that is
/// missing or empty is at its initial values.
using InternalColumns = std::vector<std::vector<double>>;

/// Parameters of the laws of material points where they differ from point to point: column k has the k-th parameter of
/// the law of each point, whatever that is. Empty: all points have that of their material.
using ParameterColumns = std::vector<std::vector<double>>;

/// Symmetric second-order tensor. Plane strain keeps the out-of-plane normal component.
/// Components: 2D (xx, yy, xy, zz), 3D (xx, yy, zz, xy, yz, zx).
template <int Dim, class T = double> struct SymTensor {
	static constexpr int size = Dim == 2 ? 4 : 6;
	using Components          = Eigen::Matrix<T, size, 1>;
	using InPlane             = Eigen::Matrix<T, Dim, Dim>;
	using Full                = Eigen::Matrix<T, 3, 3>;

	Components c = Components::Constant(T(0));

	InPlane inPlane() const
	{
		InPlane m;
		m(0, 0) = c[0], m(1, 1) = c[1];
		if constexpr (Dim == 2) m(0, 1) = m(1, 0) = c[2];
		else {
			m(2, 2) = c[2];
			m(0, 1) = m(1, 0) = c[3], m(1, 2) = m(2, 1) = c[4], m(2, 0) = m(0, 2) = c[5];
		}
		return m;
	}
	Full full() const
	{
		if constexpr (Dim == 3) return inPlane();
		else {
			Full m                           = Full::Constant(T(0));
			m.template topLeftCorner<2, 2>() = inPlane(), m(2, 2) = c[3];
			return m;
		}
	}
	/// From the components in the plane and the normal one out of it (in 3D: from all components; zz is not used).
	static SymTensor from(const InPlane& m, const T& zz)
	{
		SymTensor t;
		t.c[0] = m(0, 0), t.c[1] = m(1, 1);
		const T xy = T(0.5) * (m(0, 1) + m(1, 0));
		if constexpr (Dim == 2) t.c[2] = xy, t.c[3] = zz;
		else
			t.c[2] = m(2, 2), t.c[3] = xy, t.c[4] = T(0.5) * (m(1, 2) + m(2, 1)), t.c[5] = T(0.5) * (m(2, 0) + m(0, 2));
		return t;
	}
	static SymTensor from(const Full& m) { return from(InPlane(m.template topLeftCorner<Dim, Dim>()), m(2, 2)); }
};

} // namespace gimpm
