// SPDX-License-Identifier: GPL-2.0-or-later
// Water in the pores of one point: what it pushes, what flows and what is stored there, and the derivatives.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/materials/pores.hpp"
#include <Eigen/LU>

namespace gimpm {

/// Gradient that drives water times the conductivity over the horizontal one: (I + (ratio - 1) e e^T) grad p.
template <int Dim> Vec<Dim> conducted(const Pores& pores, const Vec<Dim>& vertical, const Vec<Dim>& gradient)
{
	if (pores.verticalRatio == 1) return gradient;
	return gradient + (pores.verticalRatio - 1) * vertical.dot(gradient) * vertical;
}

/// Positions of the nodes of a patch along each axis, and in the window of its lowest cell, x fastest.
template <int Dim> struct PatchShape {
	int count = 1;
	int along[windowNodes<Dim>][Dim] {}, inWindow[windowNodes<Dim>] {};

	constexpr PatchShape(int span = 0)
	{
		for (int a = 0; a < Dim; ++a)
			count *= 2 + (span >> a & 1);
		for (int n = 0; n < count; ++n)
			for (int a = 0, rest = n, stride = 1; a < Dim; rest /= 2 + (span >> a & 1), ++a, stride *= 3)
				along[n][a] = rest % (2 + (span >> a & 1)), inWindow[n] += stride * along[n][a];
	}
	static constexpr std::array<PatchShape, 1 << Dim> all()
	{
		std::array<PatchShape, 1 << Dim> shapes {};
		for (int span = 0; span < 1 << Dim; ++span)
			shapes[span] = PatchShape(span);
		return shapes;
	}
};
/// Shapes by the span of the patch.
template <int Dim> inline constexpr auto patchShapes = PatchShape<Dim>::all();

/// Functions of a point at the nodes of its patch; gradients along the axes as the step begins. The hoop functions give
/// u_x / x, zero without an axis of symmetry.
template <int Dim> struct PointFunctions {
	int      count;
	double   value[windowNodes<Dim>], hoop[windowNodes<Dim>];
	Vec<Dim> gradient[windowNodes<Dim>];

	PointFunctions(const CloudBasis<Dim>& basis, int p, const Patch<Dim>& patch)
	{
		const PatchShape<Dim>& shape = patchShapes<Dim>[patch.span];
		count                        = shape.count;
		for (int n = 0; n < count; ++n) {
			value[n] = 1, hoop[n] = 1, gradient[n] = Vec<Dim>::Ones();
			for (int a = 0; a < Dim; ++a) {
				const auto& axis = basis.axes[p][a];
				const int   i    = shape.along[n][a];
				value[n] *= axis.value[i];
				hoop[n] *= a > 0 ? axis.value[i] : basis.isAxisymmetric() ? basis.hoop[p][i] : 0;
				for (int b = 0; b < Dim; ++b)
					gradient[n][b] *= a == b ? axis.gradient[i] : axis.value[i];
			}
		}
	}
};

/// A point as the step begins.
struct PorePoint {
	double       volume;   ///< [m3]
	double       ratio;    ///< over the initial volume [-]
	double       content;  ///< content of water, over the initial volume [-]
	double       pressure; ///< [Pa]
	const Pores* pores;

	double coupling() const { return pores->coupling(); } ///< coupling of strain and pressure
};

/// At an iterate: F is that of the step.
template <int Dim> struct FlowPoint {
	double              pressure = 0, J = 1, around = 1;     ///< around: stretch along the circle around an axis of symmetry
	Vec<Dim>            pressureGradient = Vec<Dim>::Zero(); ///< in the present configuration
	Mat<Dim>            F                = Mat<Dim>::Identity(), inverse;
	double              density = 1, content = 0; ///< density of the water over that without pressure, and the amount of it that has been stored
	Pores::Conductivity kappa {};

	template <class Displacements, class Pressures>
	FlowPoint(const PorePoint& point, const Patch<Dim>& patch, const PointFunctions<Dim>& f, const Displacements& d, const Pressures& P, double modulus)
	{
		double   grown[Dim][Dim] = {}; // sum of gradients, which stays in registers
		Vec<Dim> first           = Vec<Dim>::Zero();
		for (int n = 0; n < f.count; ++n) {
			const int a = patch.node[n];
			if (a < 0) continue;
			for (int i = 0; i < Dim; ++i)
				for (int j = 0; j < Dim; ++j)
					grown[i][j] += d[Dim * a + i] * f.gradient[n][j];
			around += d[Dim * a] * f.hoop[n];
			pressure += f.value[n] * P[a], first += P[a] * f.gradient[n];
		}
		for (int i = 0; i < Dim; ++i)
			for (int j = 0; j < Dim; ++j)
				F(i, j) += grown[i][j];
		J = F.determinant() * around, inverse = F.inverse();
		pressureGradient = inverse.transpose() * first;
		content          = point.coupling() * point.ratio * (J - 1);
		if (std::isfinite(modulus)) {
			density = std::exp(pressure / modulus);
			content = density * content + point.content * std::expm1((pressure - point.pressure) / modulus);
		}
		if (isPossible(point)) kappa = point.pores->at(point.ratio * J);
	}
	/// Volume over the initial one by which pores change: that of the step's begin where they are rigid.
	double poreRatio(const PorePoint& point) const { return point.ratio * (1 + point.coupling() * (J - 1)); }
	bool   isPossible(const PorePoint& point) const { return J > 0 && around > 0 && point.pores->areOpen(point.ratio * J); }
};

/// Functions of a point at an iterate: all that forces and derivatives need of them.
template <int Dim> struct PresentFunctions {
	Vec<Dim> gradient[windowNodes<Dim>]; ///< along the axes, in the present configuration
	Vec<Dim> dilation[windowNodes<Dim>]; ///< d ln J by the displacement of a node
	double   hoop[windowNodes<Dim>];     ///< over the stretch around the axis
	double   along[windowNodes<Dim>];    ///< gradient along that which drives the water, times the conductivity over the horizontal one

	PresentFunctions(const FlowPoint<Dim>& s, const PointFunctions<Dim>& f, const Vec<Dim>& conducted)
	{
		const Mat<Dim> toPresent = s.inverse.transpose();
		for (int n = 0; n < f.count; ++n) {
			gradient[n] = dilation[n] = toPresent * f.gradient[n];
			hoop[n]                   = f.hoop[n] / s.around;
			dilation[n][0] += hoop[n];
			along[n] = conducted.dot(gradient[n]);
		}
	}
};

} // namespace gimpm
