// SPDX-License-Identifier: GPL-2.0-or-later
// The parts of the domain of a point in the cells that it lies in, by its basis functions.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include <algorithm>

namespace gimpm {

/// The parts of a domain in the lower (0) and the upper cell (1) along one axis.
struct AxisParts {
	double share[2];  ///< part of the domain
	double centre[2]; ///< centre of the part, in its cell: 0 to 1

	AxisParts(const AxisBasis& basis, bool isInTwo)
	{
		if (isInTwo) { // the slopes are in proportion to the lengths of the parts, the values to their squares
			const double perLength = basis.gradient[2] - basis.gradient[0];
			share[1]               = basis.gradient[2] / perLength;
			centre[0]              = 1 + basis.value[0] / basis.gradient[0] * perLength;
			centre[1]              = basis.value[2] / basis.gradient[2] * perLength;
		} else
			share[1] = 0, centre[0] = basis.value[1], centre[1] = 0.5;
		share[0] = 1 - share[1];
	}
};

/// Calls f(cell of the window, its number, parts, share of the domain) for the cells that a point's domain lies in.
template <int Dim, class F> void forParts(const Patch<Dim>& patch, const PointBasis<Dim>& axes, F&& f)
{
	std::array<AxisParts, Dim> parts = [&] {
		if constexpr (Dim == 2) return std::array { AxisParts(axes[0], patch.span & 1), AxisParts(axes[1], patch.span & 2) };
		else
			return std::array { AxisParts(axes[0], patch.span & 1), AxisParts(axes[1], patch.span & 2), AxisParts(axes[2], patch.span & 4) };
	}();
	for (int c = 0; c < windowCells<Dim>; ++c) {
		if (patch.reached[c] < 0) continue;
		double share = 1;
		for (int a = 0; a < Dim; ++a)
			share *= parts[a].share[c >> a & 1];
		f(c, patch.reached[c], parts, share);
	}
}

/// The parts of a ring's section in the lower and the upper cell along x.
struct RingParts {
	double size, face; ///< size of a cell, and radius of the face in or above the section [m]
	double radius[2];  ///< radii of the centres of the parts [m]

	/// In a refined grid a domain reaches no farther than half a cell.
	RingParts(const AxisBasis& ring, const AxisValues& hoop, double halfSize, bool isInTwo, bool isRefined)
	{
		const double r = 1 / (hoop[0] + hoop[1] + hoop[2]);
		size           = 1 / (isInTwo ? ring.gradient[2] - ring.gradient[0] : ring.gradient[1]);
		const double l = isRefined ? std::min(halfSize, size / 2) : halfSize;
		face           = r + size * r * (hoop[0] - hoop[2]);
		radius[0]      = isInTwo ? (face + r - l) / 2 : r;
		radius[1]      = (face + r + l) / 2;
	}
};

} // namespace gimpm
