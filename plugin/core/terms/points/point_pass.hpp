// SPDX-License-Identifier: GPL-2.0-or-later
// A pass over the points that adds their forces, and their stiffness, to the nodes: the same text with F-bar and
// without, and around an axis.
#pragma once
#include "core/base/instruction_set.hpp"
#include "core/terms/points/internal_force.hpp"
#include <atomic>
#include <limits>

namespace gimpm {

/// Data that a pass over the points reads and writes.
template <int Dim> struct Pass {
	const CloudBasis<Dim>&       basis;
	const StepPoints<Dim>&       points;
	const std::vector<Material>& materials;
	const Eigen::VectorXd&       d;
	const AssembledTerms<Dim>&   sum;
	const Colours<Dim>&          colours     = basis.colours; ///< or what one process does of them
	const double                 duration    = 0;             ///< duration of the step until now
	const bool                   isBeginning = false;         ///< none of the step has gone by
	const bool                   isSymmetric = points.isSymmetric;
};

/// A failure as a number, which is the smaller the smaller the index of its point is.
using FailureCode               = std::int64_t;
constexpr FailureCode noFailure = std::numeric_limits<FailureCode>::max();

constexpr FailureCode  codeOf(const PointFailure& f) { return 2 * FailureCode(f.point) + (f.reason == PointFailure::Reason::noResponse); }
constexpr PointFailure failureOf(FailureCode code) { return { int(code / 2), code % 2 ? PointFailure::Reason::noResponse : PointFailure::Reason::inverted }; }

/// For each kind of processor compiled in files of its own: the patches [first, last). Returns a point that fails, or
/// noFailure.
struct PortableKernels {
	template <class ChunkOfPoints, int Dim> static FailureCode addPatches(const Pass<Dim>&, int first, int last);
};
struct Avx2Kernels {
	template <class ChunkOfPoints, int Dim> GIMPM_TARGET_AVX2 static FailureCode addPatches(const Pass<Dim>&, int first, int last);
};

inline void keepSmallest(std::atomic<FailureCode>& smallest, FailureCode value)
{
	FailureCode seen = smallest;
	while (value < seen && !smallest.compare_exchange_weak(seen, value)) { }
}

/// The kernel for this processor.
template <class ChunkOfPoints, int Dim> auto kernelForProcessor()
{
	if constexpr (isPortable)
		if (!processorHasAvx2()) return PortableKernels::addPatches<ChunkOfPoints, Dim>;
	return Avx2Kernels::addPatches<ChunkOfPoints, Dim>;
}

/// Fails where a point does. The result does not depend on the number of threads.
template <class ChunkOfPoints, int Dim> std::optional<PointFailure> addPoints(const Pass<Dim>& pass)
{
	std::atomic<FailureCode> failure { noFailure };
	const auto               add = kernelForProcessor<ChunkOfPoints, Dim>();
	// Threads meet after each colour. Of few points a pass is over before they have: alone that costs little, but
	// where another program takes a processor away they wait for its time slice, a thousand times as long as the
	// pass.
	const bool threadsPay = pass.points.volume0.size() >= (Dim == 2 ? 4000 : 1000);
	for (const auto& colour : pass.colours) {
#pragma omp parallel for schedule(dynamic) if (threadsPay)
		for (int range = 0; range < int(colour.size()); ++range)
			keepSmallest(failure, add(pass, colour[range].first, colour[range].second));
	}
	if (failure == noFailure) return std::nullopt;
	return failureOf(failure);
}

} // namespace gimpm
