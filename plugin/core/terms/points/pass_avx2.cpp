// SPDX-License-Identifier: GPL-2.0-or-later
// The pass for processors with AVX2.
#include "core/terms/points/pass_kernels.hpp"

namespace gimpm {

GIMPM_KERNELS(Avx2Kernels, GIMPM_TARGET_AVX2)
GIMPM_INSTANTIATE(Avx2Kernels, Chunk)

} // namespace gimpm
