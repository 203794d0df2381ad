// SPDX-License-Identifier: GPL-2.0-or-later
// The material point as seen by a patch with a number of nodes known at compile time.
#pragma once
#include "core/assembly.hpp"
#include "core/kinematics.hpp"

namespace gimpm {

template <int Dim, int Span> constexpr int nodesOfSpan()
{
	int n = 1;
	for (int a = 0; a < Dim; ++a)
		n *= 2 + (Span >> a & 1);
	return n;
}

/// Basis functions of all nodes of a patch, x fastest, or their gradients: tensor products of the axes.
template <int Dim, int Span> struct PatchBasis {
	static constexpr int N = nodesOfSpan<Dim, Span>();
	using Values           = Eigen::Matrix<double, N, 1>;
	using Gradients        = Eigen::Matrix<double, N, Dim>;

	static Gradients gradients(const std::array<AxisBasis, Dim>& axes)
	{
		Gradients g;
		forNodes([&](int local, const std::array<int, Dim>& n) {
			for (int a = 0; a < Dim; ++a) {
				g(local, a) = axes[a].slope[n[a]];
				for (int b = 0; b < Dim; ++b)
					if (b != a) g(local, a) *= axes[b].value[n[b]];
			}
		});
		return g;
	}
	static Values values(const std::array<AxisBasis, Dim>& axes)
	{
		Values s;
		forNodes([&](int local, const std::array<int, Dim>& n) {
			s[local] = 1;
			for (int a = 0; a < Dim; ++a)
				s[local] *= axes[a].value[n[a]];
		});
		return s;
	}
	template <class F> static void forNodes(F&& f)
	{
		std::array<int, Dim> n {};
		for (int local = 0; local < N; ++local) {
			f(local, n);
			for (int a = 0; a < Dim; ++a) {
				if (++n[a] < 2 + (Span >> a & 1)) break;
				n[a] = 0;
			}
		}
	}
	/// Nodal vectors of a patch; zero beyond walls.
	static Gradients gather(const Patch<Dim>& patch, const Eigen::VectorXd& x)
	{
		Gradients local = Gradients::Zero();
		for (int n = 0; n < N; ++n)
			if (patch.node[n] >= 0) local.row(n) = x.template segment<Dim>(Dim * patch.node[n]).transpose();
		return local;
	}
	static void scatterAdd(const Patch<Dim>& patch, const Gradients& local, Eigen::VectorXd& x)
	{
		for (int n = 0; n < N; ++n)
			if (patch.node[n] >= 0) x.template segment<Dim>(Dim * patch.node[n]) += local.row(n).transpose();
	}
};

/// Response of a point to the gradient of the incremental displacement.
template <int Dim> struct PointResponse {
	Principal<Dim> trial; ///< of b - 1
	Vec3           strain;
	Response       law;
};

template <int Dim> PointResponse<Dim> respond(const StepPoints<Dim>& points, int i, const std::vector<Material>& materials, const Mat<Dim>& gradient)
{
	PointResponse<Dim> r;
	r.trial  = principal(pushForward(points.leftCauchyGreen[i], gradient));
	r.strain = logStrain(r.trial.value);
	r.law    = std::visit([&](const auto& l) { return l.respond(r.strain, points.plasticStrain[i]); }, materials[points.material[i]].law);
	return r;
}

/// Calls f(std::integral_constant<int, span>) with the patch's span as a compile-time constant.
template <int Dim, int Span = (1 << Dim) - 1, class F> void withSpan(int span, F&& f)
{
	if constexpr (Span >= 0) {
		if (span == Span) f(std::integral_constant<int, Span>());
		else
			withSpan<Dim, Span - 1>(span, f);
	}
}

template <int Dim, class F>
void forUpdatedPoints(const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, F&& f)
{
#pragma omp parallel for schedule(dynamic, 16)
	for (int p = 0; p < int(basis.patches.size()); ++p)
		withSpan<Dim>(basis.patches[p].span, [&](auto span) {
			using B           = PatchBasis<Dim, decltype(span)::value>;
			const auto& patch = basis.patches[p];
			const auto  local = B::gather(patch, d);
			for (int i = patch.first; i < patch.first + patch.count; ++i) {
				const Mat<Dim> gradient = local.transpose() * B::gradients(basis.axes[i]);
				const auto     r        = respond(points, i, materials, gradient);
				f(basis.order[i],
				  PointUpdate<Dim> { local.transpose() * B::values(basis.axes[i]), gradient, assemble(r.law.elasticStrain, r.trial.axes),
				                     assemble(r.law.stress, r.trial.axes), r.law.plasticStrain });
			}
		});
}

} // namespace gimpm
