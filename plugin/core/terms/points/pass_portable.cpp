// SPDX-License-Identifier: GPL-2.0-or-later
// The pass for all processors. Without fused multiplications the compiler may optimise as little as it likes: results
// keep their bits.
#include "core/terms/points/pass_kernels.hpp"

namespace gimpm {

GIMPM_KERNELS(PortableKernels)
GIMPM_INSTANTIATE(PortableKernels, Chunk)
GIMPM_INSTANTIATE(PortableKernels, FBarChunk)

} // namespace gimpm
