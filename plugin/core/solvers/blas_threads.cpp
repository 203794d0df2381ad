// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/blas_threads.hpp"
#include <omp.h>

// OpenBLAS functions; null beside any other BLAS, which is left as it is.
extern "C" __attribute__((weak)) int  openblas_get_num_threads();
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);

namespace gimpm {
namespace {

/// Operations of a factorisation above which the threads of the BLAS have enough to do. Beside another program, which
/// keeps one of two waiting, two take several times as long as one: a gain of a fifth is not worth that.
constexpr double flopsForThreads = 2e10;

} // namespace

OneBlasThread::OneBlasThread(bool isWanted) : before_(openblas_get_num_threads && openblas_set_num_threads && isWanted ? openblas_get_num_threads() : 1)
{
	if (before_ > 1) openblas_set_num_threads(1);
}

OneBlasThread::~OneBlasThread()
{
	if (before_ > 1) openblas_set_num_threads(before_);
}

FewerThreads::FewerThreads(double flops) : levels_(omp_get_max_active_levels()), blas_(flops < flopsForThreads) { omp_set_max_active_levels(0); }

FewerThreads::~FewerThreads() { omp_set_max_active_levels(levels_); }

} // namespace gimpm
