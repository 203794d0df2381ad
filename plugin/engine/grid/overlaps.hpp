// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Material points that claim the same place.
#include "core/grid/point_cloud.hpp"
#include "yade_api/types.hpp"
#include <array>

namespace yade {

struct Overlaps {
	using Pair = std::array<int, 2>; // positions in the list of points, the lower first
	static constexpr Pair none { -1, -1 };

	// Pair of points that have not been deformed: two nearly at the same position, or one that others cover wholly
	// and one of those.
	Pair ofFills = none;

	// Pair of any points, deformed ones too: the volume that is counted more than once [m3] where others cover a
	// point wholly, and such a point with one of those. Sheared neighbours, or two fills of different lattices
	// where they meet, covers points in part.
	Pair ofAny  = none;
	Real volume = 0;
};

// In a time that grows with the number of points, whatever their sizes.
template <int Dim> Overlaps findOverlaps(const gimpm::PointCloud<Dim>&);

} // namespace yade
