// SPDX-License-Identifier: GPL-2.0-or-later
// The layer at a position: that of the nearest point.
#pragma once
#include "core/grid/by_cell.hpp"
#include "core/grid/point_cloud.hpp"
#include "core/grid/refinement.hpp"

namespace gimpm {

/// Points by their cells, for the layer at a position.
template <int Dim> class LayerOfNearest {
public:
	LayerOfNearest(const PointCloud<Dim>& cloud, int bitsOfBodies, const Grid<Dim>& grid)
	        : position_(cloud.position), layer_(cloud.layer), bitsOfBodies_(bitsOfBodies), points_(grid.origin, largestCell(grid))
	{
		for (std::size_t p = 0; p < position_.size(); ++p)
			points_.add(points_.cell(position_[p]), int(p));
	}
	int operator()(const Vec<Dim>& x, int ofBody) const
	{
		double least = std::numeric_limits<double>::infinity();
		int    layer = std::max(0, ofBody);
		points_.forNear(x, [&](int p) {
			if (ofBody >= 0 && (layer_[p] & bitsOfBodies_) != ofBody) return;
			if (const double away = (position_[p] - x).squaredNorm(); away < least) least = away, layer = layer_[p];
		});
		return layer;
	}

private:
	std::vector<Vec<Dim>> position_;
	std::vector<int>      layer_;
	int                   bitsOfBodies_;
	ByCell<Dim>           points_;
};

} // namespace gimpm
