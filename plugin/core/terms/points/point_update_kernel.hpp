// SPDX-License-Identifier: GPL-2.0-or-later
// The update of the points of some patches, for the files that compile it for a kind of processor.
#pragma once
#include "core/terms/points/batch_response.hpp"
#include "core/terms/points/fbar.hpp"
#include "core/terms/points/tensor_response.hpp"

namespace gimpm {

/// visitPatches() for all processors.
template <class ChunkOfPoints, int Dim>
void visitPortably(
        const CloudBasis<Dim>&, const StepPoints<Dim>&, const std::vector<Material>&, const Eigen::VectorXd& d, int first, int last, const Visitor<Dim>&);

namespace {

/// Value at one point of a field given by nodal vectors; `along`: the functions of x, if not those of the point's axes.
template <int Dim, int Span> GIMPM_INLINE Vec<Dim> interpolate(const PointBasis<Dim>& axes, const PatchVectors<Dim, Span>& u, const double* along = nullptr)
{
	using Nodes = PatchNodes<Dim, Span>;
	Vec<Dim> value;
	for (int i = 0; i < Dim; ++i) {
		Lanes products(0);
		for (int r = 0; r < Nodes::rows; ++r)
			products += u.row[i][r] * Lanes(Nodes::rowFactor(axes, r, 0));
		value[i] = sum(products * loadLanes(along ? along : axes[0].value));
	}
	return value;
}

/// Displacement in the centre of a domain. Of a ring the functions of the hoop strain give it over the radius, which is
/// one over their sum.
template <int Axes, int Dim, int Span> GIMPM_INLINE Vec<Dim> displacementOf(const CloudBasis<Dim>& basis, int point, const PatchVectors<Dim, Span>& u)
{
	if constexpr (Axes > Dim) {
		const AxisValues& hoop = basis.hoop[point];
		return interpolate<Dim, Span>(basis.axes[point], u, hoop.data()) / (hoop[0] + hoop[1] + hoop[2]);
	}
	return interpolate<Dim, Span>(basis.axes[point], u);
}

/// For which spans a part of the update is compiled for all processors, in functions of its own. Elsewhere its
/// multiplications and additions may be fused, which rounds otherwise. Left to the compiler, the choice and with it the
/// last bits of the results would change with any line near it.
template <int Dim> struct PortableParts {
	static constexpr bool ofPiece(int span) { return Dim == 3 && (span == 2 || span == 4); }
	static constexpr bool ofInterpolation(int span) { return Dim == 2 ? span == 1 || span == 2 : span == 1 || span >= 5; }
};
/// noipa: where GCC knows that f leaves the upper halves of the vector registers alone it does not clear them before
/// the call, and f, which has instructions of older processors, takes several times as long.
template <class F> [[gnu::noipa]] void              callApart(F&& f) { f(); }
template <bool Portable, class F> GIMPM_INLINE void callPart(F&& f)
{
	if constexpr (Portable) callApart(f);
	else
		f();
}

/// Increment that the laws of a batch see.
template <int Dim, int Axes> GIMPM_INLINE const Increment<Dim, Axes>& seenByLaws(const Chunk<Dim, Axes>&, int, const Increment<Dim, Axes>& increment)
{
	return increment;
}
template <int Dim, int Axes> GIMPM_INLINE Increment<Dim, Axes> seenByLaws(const FBarChunk<Dim, Axes>& chunk, int b, const Increment<Dim, Axes>&)
{
	return FBarIncrement<Dim, Axes>(chunk, b).seen;
}

/// Visits the points of a batch of a chunk, given the displacements of all points of the chunk.
template <class ChunkOfPoints, int Dim>
GIMPM_INLINE void visitBatch(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const ChunkOfPoints& chunk, int b,
        const Vec<Dim> (&displacement)[ChunkOfPoints::capacity], const Visitor<Dim>& visitor)
{
	constexpr int              Axes = ChunkOfPoints::axes;
	const Batch                batch(chunk.first + b * Lanes::count, chunk.last());
	const Increment<Dim, Axes> increment(chunk.gradient[b]);
	const auto& [gradient, hoop]  = increment;
	const auto&              seen = seenByLaws(chunk, b, increment);
	const BatchResponse<Dim> response(batch, points, materials, seen);
	const auto               elasticStrain = assemble<Lanes, Dim>(response.law.elasticStrain, response.trial.axes);
	const auto               stress        = assemble<Lanes, Dim>(response.effectiveStress(points), response.trial.axes);
	for (int lane = 0, q = b * Lanes::count; lane < Lanes::count && q < chunk.count; ++lane, ++q) {
		const auto                                                  one = [lane](const Lanes& x) { return x[lane]; };
		const Law&                                                  law = materials[points.material[chunk.first + q]].law;
		std::array<double, LawTraits<PrincipalLaws>::mostVariables> internals;
		for (std::size_t k = 0; k < internals.size(); ++k)
			internals[k] = response.law.internals[k][lane];
		PointUpdate<Dim> u { displacement[q], gradient.unaryExpr(one), { elasticStrain.c.unaryExpr(one) }, { stress.c.unaryExpr(one) }, law,
			             internals.data() };
		if constexpr (Axes > Dim) u.hoop = hoop[lane];
		u.water = response.water[lane];
		if (points.hasTensorLaws && law->isTensorLaw) {
			visitWithTensors<Dim>(points, materials, chunk.first + q, gradientOf(seen, lane), u, basis.order, visitor);
			continue;
		}
		visitor.call(visitor.f, basis.order[chunk.first + q], u);
	}
}

/// For the points of the patches [first, last).
template <class ChunkOfPoints, int Dim>
void visitPatches(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, int first, int last,
        const Visitor<Dim>& visitor)
{
	constexpr int Axes = ChunkOfPoints::axes;
	forChunks<ChunkOfPoints>(basis, first, last, [&](ChunkOfPoints& chunk, int patch) {
		Vec<Dim> displacement[ChunkOfPoints::capacity];
		forPieces(basis, chunk, patch, [&](auto span, const Patch<Dim>& p, int begin, int end) GIMPM_INLINE_LAMBDA {
			constexpr int Span = decltype(span)::value;
			callPart<PortableParts<Dim>::ofPiece(Span)>([&]() GIMPM_INLINE_LAMBDA {
				const PatchVectors<Dim, Span> u(p, d);
				prepare(basis, points, u, begin, end, chunk);
				for (int q = begin; q < end; ++q)
					callPart<PortableParts<Dim>::ofInterpolation(Span)>(
					        [&]() GIMPM_INLINE_LAMBDA { displacement[q - chunk.first] = displacementOf<Axes, Dim, Span>(basis, q, u); });
			});
		});
		for (int b = 0; b * Lanes::count < chunk.count; ++b)
			visitBatch(basis, points, materials, chunk, b, displacement, visitor);
	});
}

} // namespace
} // namespace gimpm
