// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/near_points.hpp"
#include <cmath>

namespace gimpm {
namespace {

/// Patches by their lowest cells.
template <int Dim> class PatchesOfCells {
public:
	PatchesOfCells(const CloudBasis<Dim>& basis, const Grid<Dim>& grid) : grid_(grid)
	{
		for (std::size_t i = 0; i < basis.patches.size(); ++i)
			contactPoints_.emplace_back(basis.patches[i].cell, int(i));
		std::sort(contactPoints_.begin(), contactPoints_.end());
	}

	/// Calls f(patch) for the patches with a cell in the box, and for others where that is as quick.
	template <class F> void inBox(const Vec<Dim>& low, const Vec<Dim>& high, F&& f) const
	{
		constexpr double limit = Grid<Dim>::indexLimit;
		const auto     cell = [&](const Vec<Dim>& x) { return Vec<Dim>(((x - grid_.origin) / grid_.cellSize).array().floor().min(limit).max(-limit)); };
		const Vec<Dim> first = cell(low) - Vec<Dim>::Ones(), last = cell(high);
		if (((last - first).array() + 1).prod() > double(contactPoints_.size()) || grid_.isPeriodic() || grid_.refinement || hasLayers()) {
			for (const auto& [cell, patch] : contactPoints_)
				f(patch);
			return;
		}
		const Index<Dim> from = first.template cast<int>(), to = last.template cast<int>();
		Index<Dim>       row = from; // the cells of a row have keys that follow each other
		for (int a = 0; a < Dim;) {
			Index<Dim> end = row;
			end[0]         = to[0];
			auto i         = std::lower_bound(contactPoints_.begin(), contactPoints_.end(), std::pair(Grid<Dim>::key(row), -1));
			for (const Key stop = Grid<Dim>::key(end); i != contactPoints_.end() && i->first <= stop; ++i)
				f(i->second);
			for (a = 1; a < Dim && ++row[a] > to[a]; ++a)
				row[a] = from[a];
		}
	}

private:
	bool hasLayers() const { return !contactPoints_.empty() && Grid<Dim>::layer(contactPoints_.back().first) > 0; }

	const Grid<Dim>&                 grid_;
	std::vector<std::pair<Key, int>> contactPoints_;
};

} // namespace

template <int Dim>
std::vector<NearPoint> nearPoints(
        const std::vector<RigidBody<Dim>>& bodies, const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, double motionOfSoil)
{
	const PatchesOfCells<Dim> patches(basis, grid);
	std::vector<NearPoint>    found;
	for (std::size_t b = 0; b < bodies.size(); ++b) {
		const auto&  body      = bodies[b];
		const double reach     = searchReach(body, grid) + motionOfSoil;
		const auto [low, high] = body.bounds(body.begin);
		const Vec<Dim> margin  = Vec<Dim>::Constant(reach);
		patches.inBox(low - margin, high + margin, [&](int patch) {
			const auto& p = basis.patches[patch];
			for (int i = p.first; i < p.first + p.count; ++i) {
				const int            point = basis.order[i], side = body.sideOf(body.begin, cloud.position[point]);
				const Proximity<Dim> near = body.proximity(body.begin, cloud.position[point], side);
				if (std::max(near.gap, near.beside) <= reach + cloud.halfSize[point].norm()) found.push_back({ int(b), point, side });
			}
		});
	}
	return found;
}

template std::vector<NearPoint> nearPoints(const std::vector<RigidBody<2>>&, const PointCloud<2>&, const CloudBasis<2>&, const Grid<2>&, double);
template std::vector<NearPoint> nearPoints(const std::vector<RigidBody<3>>&, const PointCloud<3>&, const CloudBasis<3>&, const Grid<3>&, double);

} // namespace gimpm
