// SPDX-License-Identifier: GPL-2.0-or-later
// Kernels of a pass over the points of a patch.
#pragma once
#include "core/terms/points/batch_response.hpp"
#include "core/terms/points/fbar.hpp"
#include "core/terms/points/pair_codes.hpp"
#include "core/terms/points/patch_stiffness.hpp"
#include "core/terms/points/point_pass.hpp"
#include "core/terms/points/tensor_response.hpp"

namespace gimpm {

/// First failure of the points of a batch whose lanes fail.
template <class F> FailureCode firstFailure(const Batch& batch, const std::vector<int>& order, PointFailure::Reason reason, F&& fails)
{
	FailureCode first = noFailure;
	for (int lane = 0; lane < batch.count; ++lane)
		if (fails(lane)) first = std::min(first, codeOf({ order[batch.point[lane]], reason }));
	return first;
}

GIMPM_INLINE FailureCode invertedIn(const Batch& batch, const std::vector<int>& order, const Lanes& J)
{
	if (everywhere(J > Lanes(0)) && everywhere(J <= Lanes(std::numeric_limits<double>::max()))) return noFailure;
	return firstFailure(batch, order, PointFailure::Reason::inverted, [&](int lane) { return !(J[lane] > 0) || !std::isfinite(J[lane]); });
}

/// The radius of a ring, too, has to stay positive.
template <int Dim, int Axes> GIMPM_INLINE FailureCode invertedAround(const Batch& batch, const std::vector<int>& order, const Increment<Dim, Axes>& increment)
{
	if constexpr (Axes > Dim) return invertedIn(batch, order, Lanes(1) + increment.hoop);
	return noFailure;
}

GIMPM_INLINE FailureCode unansweredIn(const Batch& batch, const std::vector<int>& order, const Lanes& failed)
{
	if (everywhere(failed <= Lanes(0))) return noFailure;
	return firstFailure(batch, order, PointFailure::Reason::noResponse, [&](int lane) { return !(failed[lane] <= 0); });
}

/// Principal axes q_k, and w_k = F^-1 q_k with F of the increment. Of a body of revolution the third axis goes around,
/// and F^-1 along it is `around`.
template <int Dim, int Axes> struct Frame {
	const MatrixOf<Dim, Lanes>& q;
	MatrixOf<Dim, Lanes>        w;
	Lanes                       around;

	GIMPM_INLINE Frame(const MatrixOf<Dim, Lanes>& axes, const MatrixOf<Dim, Lanes>& F, const Increment<Dim, Axes>& increment)
	        : q(axes), w(F.inverse().lazyProduct(axes))
	{
		if constexpr (Axes > Dim) around = Lanes(1) / (Lanes(1) + increment.hoop);
	}
};

/// sum_k value_k q_k w_k
template <int Dim, int Axes>
GIMPM_INLINE void dyads(Lanes (&sum)[Dim][Axes], const PrincipalValues<Lanes>& value, const Lanes& volume, const Frame<Dim, Axes>& frame)
{
	for (int i = 0; i < Dim; ++i)
		for (int j = 0; j < Dim; ++j) {
			Lanes flux(0);
			for (int k = 0; k < Dim; ++k)
				flux += volume * value[k] * frame.q(i, k) * frame.w(j, k);
			sum[i][j] = flux;
		}
	if constexpr (Axes > Dim) sum[0][Dim] = volume * value[2] * frame.around;
}

/// Between the gradients of component i and the hoop strain, with the derivatives of the principal stresses by it, or
/// of its stress by the principal strains.
template <int Dim> GIMPM_INLINE Lanes hoopModulus(const Lanes (&tangent)[Dim], const Frame<Dim, Dim + 1>& frame, int i, int j)
{
	Lanes sum(0);
	for (int k = 0; k < Dim; ++k)
		sum += tangent[k] * frame.q(i, k) * frame.w(j, k);
	return sum * frame.around;
}

/// The moduli that the hoop strain takes part in: J a_iijj = D_ij - t_i delta_ij, as of the other principal axes.
template <int Dim>
GIMPM_INLINE void keepHoopModuli(
        Chunk<Dim, Dim + 1>& chunk, int i, int k, int pair, int b, const Lanes& volume, const ResponseOf<Lanes>& law, const Frame<Dim, Dim + 1>& frame)
{
	auto& value = chunk.moduli.value[pair][b];
	Lanes byHoop[Dim], ofHoop[Dim];
	for (int m = 0; m < Dim; ++m)
		byHoop[m] = law.tangent(m, 2), ofHoop[m] = law.tangent(2, m);
	for (int j = 0; j < Dim; ++j) {
		if (k == 0) value[j][Dim] = volume * hoopModulus<Dim>(byHoop, frame, i, j);
		if (i == 0) value[Dim][j] = volume * hoopModulus<Dim>(ofHoop, frame, k, j);
	}
	if (i == 0 && k == 0) value[Dim][Dim] = volume * (law.tangent(2, 2) - law.stress[2]) * frame.around * frame.around;
}

template <int Dim, int Axes>
GIMPM_INLINE void keepModuli(
        const Pass<Dim>& pass, Chunk<Dim, Axes>& chunk, int b, const Lanes& volume, const ResponseOf<Lanes>& law, const PrincipalValues<Lanes>& strain,
        const Frame<Dim, Axes>& frame)
{
	const auto a    = moduli<Dim, Lanes>(law, strain, frame.q, frame.w);
	const auto keep = [&](int i, int k, int pair) GIMPM_INLINE_LAMBDA {
		for (int j = 0; j < Dim; ++j)
			for (int l = 0; l < Dim; ++l)
				chunk.moduli.value[pair][b][j][l] = volume * a(i * Dim + j, k * Dim + l);
		if constexpr (Axes > Dim) keepHoopModuli(chunk, i, k, pair, b, volume, law, frame);
	};
	if (pass.isSymmetric) PairModuli<Dim>::template forPairs<true>(keep);
	else
		PairModuli<Dim>::template forPairs<false>(keep);
}

/// Flux and moduli of one batch of a chunk. Returns a point that fails, or noFailure.
///
/// The flux for principal axes q_k and Kirchhoff stresses t_k, with w_k = F^-1 q_k, is V_0 sum_k t_k q_k w_k: current
/// volume times Cauchy stress is initial volume times Kirchhoff stress. It goes with gradients in the configuration at
/// the start of the step.
template <int Dim, int Axes> GIMPM_INLINE FailureCode respond(const Pass<Dim>& pass, Chunk<Dim, Axes>& chunk, int b)
{
	using M = MatrixOf<Dim, Lanes>;
	const Batch                batch(chunk.first + b * Lanes::count, chunk.last());
	const Increment<Dim, Axes> increment(chunk.gradient[b]);
	const M                    F = increment.gradient + M::Identity();
	if (const auto inverted = invertedIn(batch, pass.basis.order, F.determinant()); inverted != noFailure) return inverted;
	if (const auto inverted = invertedAround(batch, pass.basis.order, increment); inverted != noFailure) return inverted;
	const BatchResponse<Dim> response(batch, pass.points, pass.materials, increment);
	if constexpr (LawTraits<PrincipalLaws>::mayFail)
		if (const auto unanswered = unansweredIn(batch, pass.basis.order, response.law.failed); unanswered != noFailure) return unanswered;
	const Lanes            volume = batch.load([&](int p) GIMPM_INLINE_LAMBDA { return pass.points.volume0[p]; });
	const Frame<Dim, Axes> frame(response.trial.axes, F, increment);
	dyads(chunk.flux[b], response.law.stress, volume, frame);
	if (pass.sum.K) keepModuli(pass, chunk, b, volume, response.law, response.strain, frame);
	return pass.points.hasTensorLaws ? respondOfTensors(pass, chunk, batch, b) : noFailure;
}

/// The same with F-bar. What changes shapes goes with the gradients at the points, what changes volumes with those at
/// the centres.
template <int Dim, int Axes> GIMPM_INLINE FailureCode respond(const Pass<Dim>& pass, FBarChunk<Dim, Axes>& chunk, int b)
{
	const Batch                    batch(chunk.first + b * Lanes::count, chunk.last());
	const FBarIncrement<Dim, Axes> increment(chunk, b);
	const auto&                    order    = pass.basis.order;
	const FailureCode              inverted = std::min(invertedIn(batch, order, increment.J), invertedIn(batch, order, increment.J0));
	if (inverted != noFailure) return inverted;
	const FailureCode around = std::min(invertedAround(batch, order, increment.own), invertedAround(batch, order, increment.centre));
	if (around != noFailure) return around;
	const BatchResponse<Dim> response(batch, pass.points, pass.materials, increment.seen);
	if constexpr (LawTraits<PrincipalLaws>::mayFail)
		if (const auto unanswered = unansweredIn(batch, pass.basis.order, response.law.failed); unanswered != noFailure) return unanswered;
	const Lanes                      volume = batch.load([&](int p) GIMPM_INLINE_LAMBDA { return pass.points.volume0[p]; });
	const Frame<Dim, Axes>           frame(response.trial.axes, increment.F, increment.own);
	const VolumetricSplit<Dim, Axes> split(response.law);
	chunk.turn(b, increment.F0.inverse(), Axes > Dim ? Lanes(1) / (Lanes(1) + increment.centre.hoop) : Lanes(1));
	dyads(chunk.flux[b], split.deviator.stress, volume, frame);
	chunk.meanStress[b] = volume * split.mean;
	if (!pass.sum.K) return pass.points.hasTensorLaws ? respondOfTensors(pass, chunk, batch, b) : noFailure;
	keepModuli(pass, chunk, b, volume, split.deviator, response.strain, frame);
	dyads(chunk.meanOfStrain[b], split.meanOfStrain, volume, frame);
	dyads(chunk.stressOfDilation[b], split.stressOfDilation, volume, frame);
	chunk.bulk[b] = volume * split.bulk;
	return pass.points.hasTensorLaws ? respondOfTensors(pass, chunk, batch, b) : noFailure;
}

/// Internal force (and stiffness) of the points [begin, end) of a patch.
template <class Kernels, int Span, class ChunkOfPoints, int Dim>
GIMPM_INLINE void addPiece(const Pass<Dim>& pass, const ChunkOfPoints& chunk, const Patch<Dim>& patch, int begin, int end)
{
	using Nodes                    = PatchNodes<Dim, Span>;
	constexpr bool          isRing = ChunkOfPoints::axes > Dim;
	PatchVectors<Dim, Span> force;
	for (int p = begin; p < end; ++p)
		for (int r = 0; r < Nodes::rows; ++r) {
			for (int j = 0; j < Dim; ++j) {
				const Lanes grad = loadLanes(chunk.basisAt(p, j) + r * Nodes::inRow);
				for (int i = 0; i < Dim; ++i)
					force.row[i][r] += Lanes(chunk.fluxAt(p, i, j)) * grad;
			}
			if constexpr (isRing) force.row[0][r] += Lanes(chunk.fluxAt(p, 0, Dim)) * loadLanes(chunk.basisAt(p, Dim) + r * Nodes::inRow);
			if constexpr (ChunkOfPoints::hasCentres)
				for (int i = 0; i < Dim; ++i)
					force.row[i][r] += Lanes(chunk.meanStressAt(p)) * loadLanes(chunk.centreAt(p, i) + r * Nodes::inRow);
			if constexpr (ChunkOfPoints::hasCentres && isRing)
				force.row[0][r] += Lanes(chunk.meanStressAt(p)) * loadLanes(chunk.centreAt(p, Dim) + r * Nodes::inRow);
		}
	force.scatterAdd(patch, pass.sum.force);
	if (pass.sum.absoluteContributions) force.scatterAddAbsolute(patch, *pass.sum.absoluteContributions);
	if (!pass.sum.K) return;
	const auto addStiffness = [&](auto isSymmetric) GIMPM_INLINE_LAMBDA {
		PatchStiffness<ChunkOfPoints, Nodes::N, decltype(isSymmetric)::value> stiffness;
		Kernels::multiply(stiffness, chunk, begin, end);
		stiffness.scatterAdd(patch.node.data(), PairCodes<Dim, Span>::get(), *pass.sum.K);
	};
	if (pass.isSymmetric) addStiffness(std::true_type());
	else
		addStiffness(std::false_type());
}

/// Adds the patches [first, last). Returns a point that fails, or noFailure.
template <class Kernels, class ChunkOfPoints, int Dim> GIMPM_INLINE FailureCode addPatches(const Pass<Dim>& pass, int first, int last)
{
	FailureCode failure = noFailure;
	forChunks<ChunkOfPoints>(pass.basis, first, last, [&](ChunkOfPoints& chunk, int patch) GIMPM_INLINE_LAMBDA {
		forPieces(pass.basis, chunk, patch, [&](auto span, const Patch<Dim>& p, int begin, int end) GIMPM_INLINE_LAMBDA {
			prepare(pass.basis, pass.points, PatchVectors<Dim, decltype(span)::value>(p, pass.d), begin, end, chunk);
		});
		failure = std::min(failure, Kernels::respond(pass, chunk));
		if (failure != noFailure) return; // the rest of the pass is of no use, but for the points it names
		forPieces(pass.basis, chunk, patch, [&](auto span, const Patch<Dim>& p, int begin, int end) GIMPM_INLINE_LAMBDA {
			addPiece<Kernels, decltype(span)::value>(pass, chunk, p, begin, end);
		});
	});
	return failure;
}

// Code that does not depend on the kind of patch is not inlined into the code for all kinds.
#define GIMPM_KERNELS(Name, ...)                                                                                                                               \
	struct Name##Parts {                                                                                                                                   \
		template <class C, int Dim>[[GIMPM_FLATTEN gnu::noinline]] __VA_ARGS__ static FailureCode respond(const Pass<Dim>& pass, C& chunk)             \
		{                                                                                                                                              \
			FailureCode failure = noFailure;                                                                                                       \
			for (int batch = 0; batch * Lanes::count < chunk.count; ++batch)                                                                       \
				failure = std::min(failure, gimpm::respond(pass, chunk, batch));                                                               \
			return failure;                                                                                                                        \
		}                                                                                                                                              \
		template <class C, int N, bool Symmetric>                                                                                                      \
		[[gnu::noinline]] __VA_ARGS__ static void multiply(PatchStiffness<C, N, Symmetric>& stiffness, const C& chunk, int begin, int end)             \
		{                                                                                                                                              \
			stiffness.multiply(chunk, begin, end);                                                                                                 \
		}                                                                                                                                              \
	};                                                                                                                                                     \
	template <class C, int Dim> __VA_ARGS__ FailureCode Name::addPatches(const Pass<Dim>& pass, int first, int last)                                       \
	{                                                                                                                                                      \
		return gimpm::addPatches<Name##Parts, C>(pass, first, last);                                                                                   \
	}

/// Instances for plane strain, for an axis of symmetry, and for 3D.
#define GIMPM_INSTANTIATE(Name, Chunk)                                                                                                                         \
	template FailureCode Name::addPatches<Chunk<2, 2>, 2>(const Pass<2>&, int, int);                                                                       \
	template FailureCode Name::addPatches<Chunk<2, 3>, 2>(const Pass<2>&, int, int);                                                                       \
	template FailureCode Name::addPatches<Chunk<3, 3>, 3>(const Pass<3>&, int, int);

} // namespace gimpm
