// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/base/instruction_set.hpp"
#include "core/terms/patch_stiffness.hpp"
#include <atomic>
#include <limits>

namespace gimpm {
namespace {

/// Offset codes of the node pairs of a patch, a <= b; the nodes count x fastest.
template <int Dim, int Span> struct PairCodes {
	static constexpr int N = nodesOfSpan<Dim, Span>();
	int                  code[N][N];
	PairCodes()
	{
		for (int a = 0; a < N; ++a)
			for (int b = 0; b < N; ++b) {
				std::array<int, Dim> offset;
				for (int k = 0; k < Dim; ++k)
					offset[k] = PatchNodes<Dim, Span>::along(b, k) - PatchNodes<Dim, Span>::along(a, k);
				code[a][b] = NodeMatrix<Dim>::code(offset);
			}
	}
	static const PairCodes& get()
	{
		static const PairCodes codes;
		return codes;
	}
};

/// What a pass over the points reads and writes.
template <int Dim> struct Pass {
	const CloudBasis<Dim>&       basis;
	const StepPoints<Dim>&       points;
	const std::vector<Material>& materials;
	const Eigen::VectorXd&       d;
	const TermSum<Dim>&          sum;
	const bool                   isSymmetric = points.isSymmetric;
};

/// A failure as a number, which is the smaller the smaller the index of its point is.
using FailureCode               = std::int64_t;
constexpr FailureCode noFailure = std::numeric_limits<FailureCode>::max();

constexpr FailureCode  codeOf(const PointFailure& f) { return 2 * FailureCode(f.point) + (f.reason == PointFailure::Reason::noResponse); }
constexpr PointFailure failureOf(FailureCode code) { return { int(code / 2), code % 2 ? PointFailure::Reason::noResponse : PointFailure::Reason::inverted }; }

/// Of the points of a batch whose lanes fail.
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

GIMPM_INLINE FailureCode unansweredIn(const Batch& batch, const std::vector<int>& order, const Lanes& failed)
{
	if (everywhere(failed <= Lanes(0))) return noFailure;
	return firstFailure(batch, order, PointFailure::Reason::noResponse, [&](int lane) { return !(failed[lane] <= 0); });
}

/// Flux and moduli of one batch of a chunk. Returns a point that fails, or noFailure.
///
/// With principal axes q_k and Kirchhoff stresses t_k, and w_k = F^-1 q_k, the flux is V_0 sum_k t_k q_k w_k: current volume times Cauchy
/// stress is initial volume times Kirchhoff stress. It goes with gradients in the configuration at the start of the step.
template <int Dim> GIMPM_INLINE FailureCode respond(const Pass<Dim>& pass, Chunk<Dim>& chunk, int b)
{
	using M = MatrixOf<Dim, Lanes>;
	const Batch batch(chunk.first + b * Lanes::count, chunk.last());
	M           gradient;
	for (int i = 0; i < Dim; ++i)
		for (int j = 0; j < Dim; ++j)
			gradient(i, j) = chunk.gradient[b][i][j];
	const M F = gradient + M::Identity();
	if (const auto inverted = invertedIn(batch, pass.basis.order, F.determinant()); inverted != noFailure) return inverted;
	const BatchResponse<Dim> response(batch, pass.points, pass.materials, gradient);
	if constexpr (LawTraits<Law>::mayFail)
		if (const auto unanswered = unansweredIn(batch, pass.basis.order, response.law.failed); unanswered != noFailure) return unanswered;
	const Lanes volume = batch.load([&](int p) GIMPM_INLINE_LAMBDA { return pass.points.volume0[p]; });
	const M&    q      = response.trial.axes;
	const M     w      = F.inverse().lazyProduct(q);
	for (int i = 0; i < Dim; ++i)
		for (int j = 0; j < Dim; ++j) {
			Lanes flux(0);
			for (int k = 0; k < Dim; ++k)
				flux += volume * response.law.stress[k] * q(i, k) * w(j, k);
			chunk.flux[b][i][j] = flux;
		}
	if (!pass.sum.K) return noFailure;
	const auto a    = moduli<Dim, Lanes>(response.law, response.strain, q, w);
	const auto keep = [&](int i, int k, int pair) GIMPM_INLINE_LAMBDA {
		for (int j = 0; j < Dim; ++j)
			for (int l = 0; l < Dim; ++l)
				chunk.moduli.value[pair][b][j][l] = volume * a(i * Dim + j, k * Dim + l);
	};
	if (pass.isSymmetric) PairModuli<Dim>::template forPairs<true>(keep);
	else
		PairModuli<Dim>::template forPairs<false>(keep);
	return noFailure;
}

/// Internal force (and stiffness) of the points [begin, end) of a patch.
template <class Kernels, int Dim, int Span>
GIMPM_INLINE void addPiece(const Pass<Dim>& pass, const Chunk<Dim>& chunk, const Patch<Dim>& patch, int begin, int end)
{
	using Nodes = PatchNodes<Dim, Span>;
	PatchVectors<Dim, Span> force;
	for (int p = begin; p < end; ++p)
		for (int r = 0; r < Nodes::rows; ++r)
			for (int j = 0; j < Dim; ++j) {
				const Lanes grad = loadLanes(chunk.basisAt(p, j) + r * Nodes::inRow);
				for (int i = 0; i < Dim; ++i)
					force.row[i][r] += Lanes(chunk.fluxAt(p, i, j)) * grad;
			}
	force.scatterAdd(patch, pass.sum.force);
	if (pass.sum.sizes) force.scatterAddSizes(patch, *pass.sum.sizes);
	if (!pass.sum.K) return;
	const auto addStiffness = [&](auto isSymmetric) GIMPM_INLINE_LAMBDA {
		PatchStiffness<Dim, Nodes::N, decltype(isSymmetric)::value> stiffness;
		Kernels::multiply(stiffness, chunk, begin, end);
		stiffness.scatterAdd(patch.node.data(), PairCodes<Dim, Span>::get(), *pass.sum.K);
	};
	if (pass.isSymmetric) addStiffness(std::true_type());
	else
		addStiffness(std::false_type());
}

/// Adds the patches [first, last). Returns a point that fails, or noFailure.
template <class Kernels, int Dim> GIMPM_INLINE FailureCode addPatches(const Pass<Dim>& pass, int first, int last)
{
	FailureCode failure = noFailure;
	forChunks(pass.basis, first, last, [&](Chunk<Dim>& chunk, int patch) GIMPM_INLINE_LAMBDA {
		forPieces(pass.basis, chunk, patch, [&](auto span, const Patch<Dim>& p, int begin, int end) GIMPM_INLINE_LAMBDA {
			prepare(pass.basis, PatchVectors<Dim, decltype(span)::value>(p, pass.d), begin, end, chunk);
		});
		failure = std::min(failure, Kernels::respond(pass, chunk));
		if (failure != noFailure) return; // the rest of the pass is of no use, but for the points it names
		forPieces(pass.basis, chunk, patch, [&](auto span, const Patch<Dim>& p, int begin, int end) GIMPM_INLINE_LAMBDA {
			addPiece<Kernels, Dim, decltype(span)::value>(pass, chunk, p, begin, end);
		});
	});
	return failure;
}

// What does not depend on the kind of patch is not inlined into the code for all kinds.
#define GIMPM_KERNELS(Name, ...)                                                                                                                               \
	struct Name {                                                                                                                                          \
		template <int Dim> [[gnu::flatten, gnu::noinline]] __VA_ARGS__ static FailureCode respond(const Pass<Dim>& pass, Chunk<Dim>& chunk)            \
		{                                                                                                                                              \
			FailureCode failure = noFailure;                                                                                                       \
			for (int batch = 0; batch * Lanes::count < chunk.count; ++batch)                                                                       \
				failure = std::min(failure, gimpm::respond(pass, chunk, batch));                                                               \
			return failure;                                                                                                                        \
		}                                                                                                                                              \
		template <int Dim, int N, bool Symmetric>                                                                                                      \
		[[gnu::noinline]] __VA_ARGS__ static void multiply(PatchStiffness<Dim, N, Symmetric>& stiffness, const Chunk<Dim>& chunk, int begin, int end)  \
		{                                                                                                                                              \
			stiffness.multiply(chunk, begin, end);                                                                                                 \
		}                                                                                                                                              \
		template <int Dim> __VA_ARGS__ static FailureCode addPatches(const Pass<Dim>& pass, int first, int last)                                       \
		{                                                                                                                                              \
			return gimpm::addPatches<Name>(pass, first, last);                                                                                     \
		}                                                                                                                                              \
	};
GIMPM_KERNELS(PortableKernels)
GIMPM_KERNELS(Avx2Kernels, GIMPM_TARGET_AVX2)
#undef GIMPM_KERNELS

void keepSmallest(std::atomic<FailureCode>& smallest, FailureCode value)
{
	FailureCode seen = smallest;
	while (value < seen && !smallest.compare_exchange_weak(seen, value)) { }
}

} // namespace

template <int Dim> StepPoints<Dim> stepPoints(const PointCloud<Dim>& cloud, const std::vector<Material>& materials, const CloudBasis<Dim>& basis)
{
	const int       n = int(cloud.size());
	StepPoints<Dim> s;
	s.leftCauchyGreen.resize(n);
	s.volume0.resize(n);
	s.material.resize(n);
	provideInternals(s.internals, materials, n);
	s.parameters.resize(cloud.parameters.size());
	for (std::size_t c = 0; c < s.parameters.size(); ++c)
		for (const int p : basis.order)
			if (!cloud.parameters[c].empty()) s.parameters[c].push_back(cloud.parameters[c][p]);
#pragma omp parallel for
	for (int i = 0; i < n; ++i) {
		const int p          = basis.order[i];
		s.leftCauchyGreen[i] = leftCauchyGreenMinusOne(cloud.elasticStrain[p]);
		s.volume0[i]         = cloud.volume0[p];
		s.material[i]        = cloud.material[p];
		withLaw(materials[s.material[i]].law, [&](const auto& law) { storeInternals(law, internalsOf(law, cloud.internals, p), s.internals, i); });
	}
	s.isSymmetric = areSymmetric(materials, s.material, s.parameters);
	return s;
}

template <int Dim>
std::optional<PointFailure> addInternalForce(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, const TermSum<Dim>& sum)
{
	std::atomic<FailureCode> failure { noFailure };
	const Pass<Dim>          pass { basis, points, materials, d, sum };
	const auto               add = processorHasAvx2() ? Avx2Kernels::addPatches<Dim> : PortableKernels::addPatches<Dim>;
	// Threads meet after each colour. Of few points a pass is over before they have: alone that costs little, but where another program takes
	// a processor away they wait for its time slice, a thousand times as long as the pass.
	const bool threadsPay = points.volume0.size() >= (Dim == 2 ? 4000 : 1000);
	for (const auto& colour : basis.colours) {
#pragma omp parallel for schedule(dynamic) if (threadsPay)
		for (int range = 0; range < int(colour.size()); ++range)
			keepSmallest(failure, add(pass, colour[range].first, colour[range].second));
	}
	if (failure == noFailure) return std::nullopt;
	return failureOf(failure);
}

template <int Dim> void markPointPattern(const CloudBasis<Dim>& basis, NodeMatrix<Dim>& K)
{
	for (const auto& patch : basis.patches)
		withSpan<Dim>(patch.span, [&](auto span) {
			using Codes       = PairCodes<Dim, decltype(span)::value>;
			const auto& codes = Codes::get();
			for (int a = 0; a < Codes::N; ++a)
				for (int b = a; b < Codes::N; ++b)
					if (patch.node[a] >= 0 && patch.node[b] >= 0) K.markUsed(patch.node[a], codes.code[a][b]);
		});
}

template <int Dim> void addPointForces(const CloudBasis<Dim>& basis, const std::vector<Vec<Dim>>& force, Eigen::VectorXd& f)
{
	for (const auto& patch : basis.patches)
		withSpan<Dim>(patch.span, [&](auto span) {
			using Nodes = PatchNodes<Dim, decltype(span)::value>;
			PatchVectors<Dim, decltype(span)::value> local;
			for (int p = patch.first; p < patch.first + patch.count; ++p)
				for (int r = 0; r < Nodes::rows; ++r) {
					const Lanes value = loadLanes(basis.axes[p][0].value) * Lanes(Nodes::rowFactor(basis.axes[p], r, 0));
					for (int i = 0; i < Dim; ++i)
						local.row[i][r] += Lanes(force[basis.order[p]][i]) * value;
				}
			local.scatterAdd(patch, f);
		});
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template StepPoints<Dim>             stepPoints(const PointCloud<Dim>&, const std::vector<Material>&, const CloudBasis<Dim>&);                         \
	template std::optional<PointFailure> addInternalForce(                                                                                                 \
	        const CloudBasis<Dim>&, const StepPoints<Dim>&, const std::vector<Material>&, const Eigen::VectorXd&, const TermSum<Dim>&);                    \
	template void markPointPattern(const CloudBasis<Dim>&, NodeMatrix<Dim>&);                                                                              \
	template void addPointForces(const CloudBasis<Dim>&, const std::vector<Vec<Dim>>&, Eigen::VectorXd&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
