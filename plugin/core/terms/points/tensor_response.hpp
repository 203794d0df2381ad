// SPDX-License-Identifier: GPL-2.0-or-later
// Points of tensor laws on their way through a pass: one at a time, after the others of their batch.
#pragma once
#include "core/terms/points/fbar.hpp"
#include "core/terms/points/point_pass.hpp"
#include "core/terms/points/point_update.hpp"

namespace gimpm {

/// Function that is called with an update.
template <int Dim> struct Visitor {
	const void* f;
	void (*call)(const void*, int, const PointUpdate<Dim>&);
};

/// The gradient in space of one lane, without displacements across the plane.
template <int Dim, int Axes> Mat3 gradientOf(const Increment<Dim, Axes>& increment, int lane)
{
	Mat3 gradient = Mat3::Zero();
	for (int i = 0; i < Dim; ++i)
		for (int j = 0; j < Dim; ++j)
			gradient(i, j) = increment.gradient(i, j)[lane];
	if constexpr (Axes > Dim) gradient(2, 2) = increment.hoop[lane];
	return gradient;
}

/// Flux and moduli of those points of a batch that have a tensor law, in the place of what is there. Returns a point
/// that fails, or noFailure.
template <int Dim, int Axes> FailureCode respondOfTensors(const Pass<Dim>&, Chunk<Dim, Axes>&, const Batch&, int b);
template <int Dim, int Axes> FailureCode respondOfTensors(const Pass<Dim>&, FBarChunk<Dim, Axes>&, const Batch&, int b);

/// Hands on the update u of point i, in the order of the basis, with what its tensor law answers to the gradient that
/// it sees.
template <int Dim>
void visitWithTensors(
        const StepPoints<Dim>&, const std::vector<Material>&, int i, const Mat3& gradient, PointUpdate<Dim> u, const std::vector<int>& order,
        const Visitor<Dim>&);

} // namespace gimpm
