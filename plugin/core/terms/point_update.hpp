// SPDX-License-Identifier: GPL-2.0-or-later
// Step 5 of the method: nodes to points.
#pragma once
#include "core/base/instruction_set.hpp"
#include "core/terms/fbar.hpp"

namespace gimpm {

/// State of one point for displacements d.
template <int Dim> struct PointUpdate {
	Vec<Dim>                                          displacement;
	Mat<Dim>                                          gradient; ///< of the increment, with respect to the configuration at the start of the step
	SymTensor<Dim>                                    elasticStrain, kirchhoffStress;
	const Law&                                        law;
	std::array<double, LawTraits<Law>::mostVariables> internals; ///< in the order of the law
};

/// Value at one point of a field given by nodal vectors.
template <int Dim, int Span> GIMPM_INLINE Vec<Dim> interpolate(const PointBasis<Dim>& axes, const PatchVectors<Dim, Span>& u)
{
	using Nodes = PatchNodes<Dim, Span>;
	Vec<Dim> value;
	for (int i = 0; i < Dim; ++i) {
		Lanes products(0);
		for (int r = 0; r < Nodes::rows; ++r)
			products += u.row[i][r] * Lanes(Nodes::rowFactor(axes, r, 0));
		value[i] = sum(products * loadLanes(axes[0].value));
	}
	return value;
}

/// For which spans a part of the update is compiled for all processors, in functions of its own. Elsewhere its multiplications and additions may
/// be fused, which rounds otherwise. Left to the compiler, the choice and with it the last bits of the results would change with any line near it.
template <int Dim> struct PortableParts {
	static constexpr bool ofPiece(int span) { return Dim == 3 && (span == 2 || span == 4); }
	static constexpr bool ofInterpolation(int span) { return Dim == 2 ? span == 1 || span == 2 : span == 1 || span >= 5; }
};
/// noipa: where GCC knows that f leaves the upper halves of the vector registers alone it does not clear them before the call, and f, which has
/// instructions of older processors, takes several times as long.
template <class F> [[gnu::noipa]] void              callApart(F&& f) { f(); }
template <bool Portable, class F> GIMPM_INLINE void callPart(F&& f)
{
	if constexpr (Portable) callApart(f);
	else
		f();
}

/// What the laws of a batch see of the increment.
template <int Dim> GIMPM_INLINE const MatrixOf<Dim, Lanes>& seenByLaws(const Chunk<Dim>&, int, const MatrixOf<Dim, Lanes>& gradient) { return gradient; }
template <int Dim> GIMPM_INLINE MatrixOf<Dim, Lanes> seenByLaws(const FBarChunk<Dim>& chunk, int b, const MatrixOf<Dim, Lanes>&)
{
	return FBarIncrement<Dim>(chunk, b).gradient;
}

/// Calls f(index in the cloud, PointUpdate) for the points of the patches [first, last).
template <class ChunkOfPoints, int Dim, class F>
void forUpdatedPoints(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, int first, int last,
        F&& f)
{
	forChunks<ChunkOfPoints>(basis, first, last, [&](ChunkOfPoints& chunk, int patch) {
		Vec<Dim> displacement[Chunk<Dim>::capacity];
		forPieces(basis, chunk, patch, [&](auto span, const Patch<Dim>& p, int begin, int end) GIMPM_INLINE_LAMBDA {
			constexpr int Span = decltype(span)::value;
			callPart<PortableParts<Dim>::ofPiece(Span)>([&]() GIMPM_INLINE_LAMBDA {
				const PatchVectors<Dim, Span> u(p, d);
				prepare(basis, points, u, begin, end, chunk);
				for (int q = begin; q < end; ++q)
					callPart<PortableParts<Dim>::ofInterpolation(Span)>(
					        [&]() GIMPM_INLINE_LAMBDA { displacement[q - chunk.first] = interpolate<Dim, Span>(basis.axes[q], u); });
			});
		});
		for (int b = 0; b * Lanes::count < chunk.count; ++b) {
			const Batch          batch(chunk.first + b * Lanes::count, chunk.last());
			MatrixOf<Dim, Lanes> gradient;
			for (int i = 0; i < Dim; ++i)
				for (int j = 0; j < Dim; ++j)
					gradient(i, j) = chunk.gradient[b][i][j];
			const BatchResponse<Dim> response(batch, points, materials, seenByLaws(chunk, b, gradient));
			const auto               elasticStrain = assemble<Lanes, Dim>(response.law.elasticStrain, response.trial.axes);
			const auto               stress        = assemble<Lanes, Dim>(response.law.stress, response.trial.axes);
			for (int lane = 0, q = b * Lanes::count; lane < Lanes::count && q < chunk.count; ++lane, ++q) {
				const auto       one = [lane](const Lanes& x) { return x[lane]; };
				const Law&       law = materials[points.material[chunk.first + q]].law;
				PointUpdate<Dim> u {
					displacement[q], gradient.unaryExpr(one), { elasticStrain.c.unaryExpr(one) }, { stress.c.unaryExpr(one) }, law, {}
				};
				for (std::size_t k = 0; k < u.internals.size(); ++k)
					u.internals[k] = response.law.internals[k][lane];
				f(basis.order[chunk.first + q], u);
			}
		}
	});
}

template <class ChunkOfPoints, int Dim, class F>
void forUpdatedPoints(const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, F&& f)
{
	constexpr int patchesAtOnce = 64;
	const int     patches       = int(basis.patches.size());
#pragma omp parallel for schedule(dynamic)
	for (int first = 0; first < patches; first += patchesAtOnce)
		callForProcessor([&] { forUpdatedPoints<ChunkOfPoints>(basis, points, materials, d, first, std::min(first + patchesAtOnce, patches), f); });
}

/// The same for every point, from several threads; f must not touch other points.
template <int Dim, class F>
void forUpdatedPoints(const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, F&& f)
{
	if (points.hasFBar()) forUpdatedPoints<FBarChunk<Dim>>(basis, points, materials, d, f);
	else
		forUpdatedPoints<Chunk<Dim>>(basis, points, materials, d, f);
}

} // namespace gimpm
