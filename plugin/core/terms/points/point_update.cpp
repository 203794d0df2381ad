// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/point_update.hpp"
#include "core/terms/points/point_update_kernel.hpp"

namespace gimpm {
namespace {

template <class ChunkOfPoints, int Dim>
void visitPoints(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d,
        const Visitor<Dim>& visitor)
{
	constexpr int patchesAtOnce = 64;
	const int     patches       = int(basis.patches.size());
#pragma omp parallel for schedule(dynamic)
	for (int first = 0; first < patches; first += patchesAtOnce) {
		const int last = std::min(first + patchesAtOnce, patches);
		if constexpr (isPortable)
			if (!processorHasAvx2()) {
				visitPortably<ChunkOfPoints>(basis, points, materials, d, first, last, visitor);
				continue;
			}
		callAvx2([&] { visitPatches<ChunkOfPoints>(basis, points, materials, d, first, last, visitor); });
	}
}

} // namespace

template <int Dim>
void forUpdatedPoints(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, const void* f,
        void (*call)(const void*, int, const PointUpdate<Dim>&))
{
	const auto with = [&](auto axes) {
		constexpr int      Axes = decltype(axes)::value;
		const Visitor<Dim> visitor { f, call };
		if (points.hasFBar()) visitPoints<FBarChunk<Dim, Axes>>(basis, points, materials, d, visitor);
		else
			visitPoints<Chunk<Dim, Axes>>(basis, points, materials, d, visitor);
	};
	if constexpr (Dim == 2)
		if (basis.isAxisymmetric()) return with(std::integral_constant<int, 3>());
	with(std::integral_constant<int, Dim>());
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template void forUpdatedPoints(                                                                                                                        \
	        const CloudBasis<Dim>&, const StepPoints<Dim>&, const std::vector<Material>&, const Eigen::VectorXd&, const void*,                             \
	        void (*)(const void*, int, const PointUpdate<Dim>&));
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
