// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/point_update_kernel.hpp"

namespace gimpm {

template <class ChunkOfPoints, int Dim>
void visitPortably(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, int first, int last,
        const Visitor<Dim>& visitor)
{
	callPortable([&] { visitPatches<ChunkOfPoints>(basis, points, materials, d, first, last, visitor); });
}

#define GIMPM_INSTANTIATE(Dim, ...)                                                                                                                            \
	template void visitPortably<__VA_ARGS__>(                                                                                                              \
	        const CloudBasis<Dim>&, const StepPoints<Dim>&, const std::vector<Material>&, const Eigen::VectorXd&, int, int, const Visitor<Dim>&);
GIMPM_INSTANTIATE(2, Chunk<2, 2>)
GIMPM_INSTANTIATE(2, Chunk<2, 3>)
GIMPM_INSTANTIATE(3, Chunk<3, 3>)
GIMPM_INSTANTIATE(2, FBarChunk<2, 2>)
GIMPM_INSTANTIATE(2, FBarChunk<2, 3>)
GIMPM_INSTANTIATE(3, FBarChunk<3, 3>)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
