// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/centres.hpp"
#include "core/terms/points/fbar.hpp"
#include "core/terms/points/pair_codes.hpp"
#include "core/terms/points/point_pass.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// The water's part of the stress grows with the volumetric strain from what it is as the step begins.
template <int Dim> void keepWater(StepPoints<Dim>& s, const PointCloud<Dim>& cloud, const std::vector<Material>& materials, const CloudBasis<Dim>& basis)
{
	s.water.assign(cloud.size(), 0);
	for (std::size_t i = 0; i < cloud.size(); ++i) {
		const double modulus = materials[s.material[i]].waterModulus;
		if (modulus == 0) continue;
		const int    p      = basis.order[i];
		const double before = cloud.excessPressure.empty() ? 0 : -cloud.excessPressure[p] * cloud.volumeRatio(p);
		s.water[i]          = before - modulus * volumetricStrain(s.leftCauchyGreen[i]);
	}
}

} // namespace

template <int Dim> StepPoints<Dim> stepPoints(const PointCloud<Dim>& cloud, const std::vector<Material>& materials, const CloudBasis<Dim>& basis, bool fBar)
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
		materials[s.material[i]].law->copyInternals(cloud.internals, p, s.internals, i);
	}
	s.isSymmetric   = areSymmetric(materials, s.material, s.parameters);
	s.hasTensorLaws = std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.law->isTensorLaw; });
	if (std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.waterModulus > 0; })) keepWater(s, cloud, materials, basis);
	if (fBar) s.centres = basisAtCentres(cloud, basis);
	if (fBar && basis.isAxisymmetric()) s.hoopCentres = hoopAtCentres(cloud, basis);
	return s;
}

template <int Dim>
std::optional<PointFailure> addInternalForce(
        const CloudBasis<Dim>& basis, const Colours<Dim>& colours, const StepPoints<Dim>& points, const std::vector<Material>& materials,
        const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum, double part)
{
	const Pass<Dim> pass { basis, points, materials, d, sum, colours, part * points.duration, part == 0 };
	if constexpr (Dim == 2)
		if (basis.isAxisymmetric()) return points.hasFBar() ? addPoints<FBarChunk<2, 3>>(pass) : addPoints<Chunk<2, 3>>(pass);
	return points.hasFBar() ? addPoints<FBarChunk<Dim, Dim>>(pass) : addPoints<Chunk<Dim, Dim>>(pass);
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
	template StepPoints<Dim>             stepPoints(const PointCloud<Dim>&, const std::vector<Material>&, const CloudBasis<Dim>&, bool);                   \
	template std::optional<PointFailure> addInternalForce(                                                                                                 \
	        const CloudBasis<Dim>&, const Colours<Dim>&, const StepPoints<Dim>&, const std::vector<Material>&, const Eigen::VectorXd&,                     \
	        const AssembledTerms<Dim>&, double);                                                                                                           \
	template void markPointPattern(const CloudBasis<Dim>&, NodeMatrix<Dim>&);                                                                              \
	template void addPointForces(const CloudBasis<Dim>&, const std::vector<Vec<Dim>>&, Eigen::VectorXd&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
