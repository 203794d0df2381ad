// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/point_kernel.hpp"
#include <atomic>
#include <climits>

namespace gimpm {
namespace {

/// Offset codes of the node pairs of a patch, a <= b; the nodes count x fastest.
template <int Dim, int Span> struct PairCodes {
	static constexpr int N = nodesOfSpan<Dim, Span>();
	int                  code[N][N];
	PairCodes()
	{
		std::array<int, Dim> place[N];
		PatchBasis<Dim, Span>::forNodes([&](int local, const std::array<int, Dim>& n) { place[local] = n; });
		for (int a = 0; a < N; ++a)
			for (int b = 0; b < N; ++b) {
				std::array<int, Dim> offset;
				for (int k = 0; k < Dim; ++k)
					offset[k] = place[b][k] - place[a][k];
				code[a][b] = NodeMatrix<Dim>::code(offset);
			}
	}
	static const PairCodes& get()
	{
		static const PairCodes codes;
		return codes;
	}
};

/// Stiffness of a patch, by pairs of displacement components (i <= k): block(i, k)(a, b) = K_(a,i)(b,k).
template <int Dim, int N> struct PatchStiffness {
	using Nodal = Eigen::Matrix<double, N, N>;
	Nodal block[Dim][Dim];

	PatchStiffness()
	{
		for (int i = 0; i < Dim; ++i)
			for (int k = i; k < Dim; ++k)
				block[i][k].setZero();
	}
	/// K_ab,ik += grad_a,j A_ijkl grad_b,l
	void add(const Eigen::Matrix<double, N, Dim>& grad, const Moduli<Dim>& A)
	{
		for (int i = 0; i < Dim; ++i)
			for (int k = i; k < Dim; ++k) {
				const Eigen::Matrix<double, Dim, N> flux = A.template block<Dim, Dim>(i * Dim, k * Dim).lazyProduct(grad.transpose());
				block[i][k] += grad.lazyProduct(flux);
			}
	}
	template <class Codes> void scatterAdd(const int* node, const Codes& codes, NodeMatrix<Dim>& K) const
	{
		for (int a = 0; a < N; ++a)
			for (int b = a; b < N; ++b) {
				if (node[a] < 0 || node[b] < 0) continue;
				double* out = K.at(node[a], codes.code[a][b]);
				for (int i = 0; i < Dim; ++i)
					for (int k = 0; k < Dim; ++k)
						out[i * Dim + k] += i <= k ? block[i][k](a, b) : block[k][i](b, a);
			}
	}
};

/// Internal force (and stiffness) of the points of one patch. Returns the first inverted point (index in the cloud), or INT_MAX.
template <int Dim, int Span, bool WithStiffness>
int addPatch(
        const Patch<Dim>&            patch,
        const CloudBasis<Dim>&       basis,
        const StepPoints<Dim>&       points,
        const std::vector<Material>& materials,
        const Eigen::VectorXd&       d,
        Eigen::VectorXd&             f,
        NodeMatrix<Dim>*             K)
{
	using B           = PatchBasis<Dim, Span>;
	const auto  local = B::gather(patch, d);
	auto        force = B::Gradients::Zero().eval();
	std::conditional_t<WithStiffness, PatchStiffness<Dim, B::N>, int> stiffness {};
	for (int i = patch.first; i < patch.first + patch.count; ++i) {
		const auto     grad     = B::gradients(basis.axes[i]);
		const Mat<Dim> gradient = local.transpose().lazyProduct(grad);
		const Mat<Dim> dF       = Mat<Dim>::Identity() + gradient;
		const double   J        = dF.determinant();
		if (!(J > 0) || !std::isfinite(J)) return basis.order[i];
		const auto r      = respond(points, i, materials, gradient);
		const auto stress = assemble(r.law.stress, r.trial.axes).inPlane().eval();
		// current volume times Cauchy stress is initial volume times Kirchhoff stress; the same holds for the moduli
		const typename B::Gradients spatial = grad.lazyProduct(dF.inverse());
		force += spatial.lazyProduct(points.volume0[i] * stress);
		if constexpr (WithStiffness) stiffness.add(spatial, points.volume0[i] * spatialModuli<Dim>(r.law, r.strain, r.trial.axes));
	}
	B::scatterAdd(patch, force, f);
	if constexpr (WithStiffness) stiffness.scatterAdd(patch.node.data(), PairCodes<Dim, Span>::get(), *K);
	return INT_MAX;
}

void keepSmallest(std::atomic<int>& smallest, int value)
{
	int seen = smallest;
	while (value < seen && !smallest.compare_exchange_weak(seen, value)) { }
}

} // namespace

template <int Dim> StepPoints<Dim> stepPoints(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	const int       n = int(cloud.size());
	StepPoints<Dim> s;
	s.leftCauchyGreen.resize(n);
	s.volume0.resize(n);
	s.plasticStrain.resize(n);
	s.material.resize(n);
#pragma omp parallel for
	for (int i = 0; i < n; ++i) {
		const int p          = basis.order[i];
		s.leftCauchyGreen[i] = leftCauchyGreenMinusOne(cloud.elasticStrain[p]);
		s.volume0[i]         = cloud.volume0[p];
		s.plasticStrain[i]   = cloud.plasticStrain[p];
		s.material[i]        = cloud.material[p];
	}
	return s;
}

template <int Dim>
InvertedPoint addInternalForce(
        const CloudBasis<Dim>&       basis,
        const StepPoints<Dim>&       points,
        const std::vector<Material>& materials,
        const Eigen::VectorXd&       d,
        Eigen::VectorXd&             f,
        NodeMatrix<Dim>*             K)
{
	std::atomic<int> inverted { INT_MAX };
	for (const auto& colour : basis.colours) {
#pragma omp parallel for schedule(dynamic, 4)
		for (int range = 0; range < int(colour.size()); ++range)
			for (int p = colour[range].first; p < colour[range].second; ++p)
				withSpan<Dim>(basis.patches[p].span, [&](auto span) {
					constexpr int S = decltype(span)::value;
					keepSmallest(
					        inverted,
					        K ? addPatch<Dim, S, true>(basis.patches[p], basis, points, materials, d, f, K)
					          : addPatch<Dim, S, false>(basis.patches[p], basis, points, materials, d, f, K));
				});
	}
	return inverted == INT_MAX ? -1 : int(inverted);
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
			using B    = PatchBasis<Dim, decltype(span)::value>;
			auto local = B::Gradients::Zero().eval();
			for (int i = patch.first; i < patch.first + patch.count; ++i)
				local += B::values(basis.axes[i]) * force[basis.order[i]].transpose();
			B::scatterAdd(patch, local, f);
		});
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template StepPoints<Dim> stepPoints(const PointCloud<Dim>&, const CloudBasis<Dim>&);                                                                   \
	template InvertedPoint   addInternalForce(                                                                                                             \
                const CloudBasis<Dim>&, const StepPoints<Dim>&, const std::vector<Material>&, const Eigen::VectorXd&, Eigen::VectorXd&, NodeMatrix<Dim>*);     \
	template void markPointPattern(const CloudBasis<Dim>&, NodeMatrix<Dim>&);                                                                              \
	template void addPointForces(const CloudBasis<Dim>&, const std::vector<Vec<Dim>>&, Eigen::VectorXd&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
