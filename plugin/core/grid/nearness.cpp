// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/nearness.hpp"
#include "core/grid/cells_around.hpp"
#include "core/grid/refinement.hpp"

namespace gimpm {
namespace {

/// Positions by the cells that the centres of near points may be in, of the largest cells.
template <int Dim> class PositionsByCell {
public:
	PositionsByCell(const std::vector<Vec<Dim>>& positions, const Grid<Dim>& grid)
	        : grid_(grid)
	        , step_(1 << (grid.refinement ? grid.refinement->largest() : 0))
	        , low_(Vec<Dim>::Constant(std::numeric_limits<double>::infinity()))
	        , high_(-low_)
	{
		for (std::size_t i = 0; i < positions.size(); ++i) {
			const Index<Dim> own = cell(positions[i]);
			for (int n = 0; n < cellsAround<Dim>; ++n)
				near_.emplace_back(Grid<Dim>::key(grid.first(own + step_ * offsetAround<Dim>(n))), int(i));
			low_ = low_.cwiseMin(positions[i]), high_ = high_.cwiseMax(positions[i]);
		}
		std::sort(near_.begin(), near_.end());
		const Vec<Dim> farthest = Vec<Dim>::Constant(2 * grid.cellSize * step_);
		low_ -= farthest, high_ += farthest;
	}

	/// f(number) of each position that a domain with this centre may be near.
	template <class F> void forNear(const Vec<Dim>& middle, F&& f) const
	{
		if (!grid_.isPeriodic() && ((middle - low_).minCoeff() < 0 || (high_ - middle).minCoeff() < 0)) return;
		const Key key = Grid<Dim>::key(grid_.first(cell(middle)));
		for (auto position = std::lower_bound(near_.begin(), near_.end(), std::pair(key, 0)); position != near_.end() && position->first == key;
		     ++position)
			f(position->second);
	}

private:
	/// In coordinates of the smallest cells, its lowest node.
	Index<Dim> cell(const Vec<Dim>& x) const
	{
		return step_ * ((x - grid_.origin) / (grid_.cellSize * step_)).array().floor().template cast<int>().matrix();
	}

	const Grid<Dim>&                 grid_;
	int                              step_; // smallest cells along a side of the largest
	Vec<Dim>                         low_, high_;
	std::vector<std::pair<Key, int>> near_;
};

} // namespace

template <int Dim>
std::vector<std::int64_t> areFarFromMaterial(
        const std::vector<Vec<Dim>>& positions, const std::vector<double>& reach, const PointCloud<Dim>& cloud, const Grid<Dim>& grid, int layer)
{
	const PositionsByCell<Dim> byCell(positions, grid);
	std::vector<std::int64_t>  isFar(positions.size(), 1);
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		if (layer >= 0 && cloud.layerOf(int(p)) != layer) continue;
		byCell.forNear(cloud.position[p], [&](int i) {
			bool isNear = true;
			for (int a = 0; a < Dim; ++a) {
				const double length = grid.cellSize * grid.period[a], apart = positions[i][a] - cloud.position[p][a];
				const double nearest = length > 0 ? apart - length * std::round(apart / length) : apart;
				isNear               = isNear && std::abs(nearest) <= cloud.halfSize[p][a] + reach[i];
			}
			if (isNear) isFar[i] = 0;
		});
	}
	return isFar;
}

template std::vector<std::int64_t> areFarFromMaterial(const std::vector<Vec<2>>&, const std::vector<double>&, const PointCloud<2>&, const Grid<2>&, int);
template std::vector<std::int64_t> areFarFromMaterial(const std::vector<Vec<3>>&, const std::vector<double>&, const PointCloud<3>&, const Grid<3>&, int);

} // namespace gimpm
