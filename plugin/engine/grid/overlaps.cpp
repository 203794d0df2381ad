// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/overlaps.hpp"
#include "core/grid/cells_around.hpp"
#include "engine/points/parallel.hpp"
#include <cmath>
#include <set>

namespace yade {

namespace {
	// Points by their place, for each power of two of their sizes in a lattice of that width: a point reaches only
	// into cells next to its own.
	template <int Dim> class Lattices {
	public:
		using Cell = Eigen::Matrix<int64_t, Dim, 1>;

		explicit Lattices(const gimpm::PointCloud<Dim>& cloud) : cloud(cloud), level(cloud.size()), cell(cloud.size()), next(cloud.size())
		{
			size_t buckets = 1;
			while (buckets < 2 * cloud.size())
				buckets *= 2;
			first.assign(buckets, -1);
			for (int p = int(cloud.size()); p-- > 0;) { // so that a bucket lists the lowest first
				level[p]  = std::ilogb(2 * cloud.halfSize[p].maxCoeff()) + 1;
				cell[p]   = cellOf(cloud.position[p], level[p]);
				int& head = first[bucket(cell[p], level[p])];
				next[p]   = head;
				head      = p;
				levels.insert(level[p]);
			}
		}

		// f(q) for all others that may touch p and are of its size or larger, until it returns false
		template <class F> void forLargerNeighbours(int p, F f) const
		{
			for (auto l = levels.lower_bound(level[p]); l != levels.end(); ++l) {
				const Cell centre = cellOf(cloud.position[p], *l);
				for (int n = 0; n < gimpm::cellsAround<Dim>; ++n) {
					const Cell c = centre + gimpm::offsetAround<Dim>(n).template cast<int64_t>();
					for (int q = first[bucket(c, *l)]; q >= 0; q = next[q])
						if (q != p && level[q] == *l && cell[q] == c && !f(q)) return;
				}
			}
		}
		bool areAlike(int p, int q) const { return level[p] == level[q]; }

	private:
		static Cell cellOf(const gimpm::Vec<Dim>& x, int level)
		{
			return (x * std::ldexp(1., -level)).array().floor().matrix().template cast<int64_t>();
		}
		size_t bucket(const Cell& c, int level) const
		{
			uint64_t hash = uint64_t(level);
			for (int a = 0; a < Dim; ++a)
				hash = (hash ^ uint64_t(c[a])) * 0x9e3779b97f4a7c15;
			return (hash >> 32) & (first.size() - 1);
		}

		const gimpm::PointCloud<Dim>& cloud;
		std::vector<int>              level;
		std::vector<Cell>             cell;
		std::vector<int>              first, next; // first point of a bucket; next point after a point
		std::set<int>                 levels;
	};

	// Cover of a point by others: its own view of it.
	struct Cover {
		double share     = 0;  // part of its volume that larger or equal ones cover
		double twice     = 0;  // [m3], shared with those who see it, too
		int    by        = -1; // one of them
		int    samePlace = -1; // one that is nearly in the same place, neither being deformed
	};

	template <int Dim> double commonVolume(const gimpm::PointCloud<Dim>& cloud, int p, int q)
	{
		const gimpm::Vec<Dim> apart = (cloud.position[p] - cloud.position[q]).cwiseAbs();
		const auto&           a     = cloud.halfSize[p];
		const auto&           b     = cloud.halfSize[q];
		return (a + b - apart).cwiseMin(2 * a.cwiseMin(b)).cwiseMax(0).prod();
	}

	// Neighbours that fill a cell with others are a whole domain apart.
	template <int Dim> bool areInSamePlace(const gimpm::PointCloud<Dim>& cloud, int p, int q)
	{
		const gimpm::Vec<Dim> apart = (cloud.position[p] - cloud.position[q]).cwiseAbs();
		return (apart.array() < 0.75 * cloud.halfSize[p].cwiseMax(cloud.halfSize[q]).array()).all();
	}

	template <int Dim> Cover coverOf(int p, const gimpm::PointCloud<Dim>& cloud, const Lattices<Dim>& lattices, const std::vector<char>& isDeformed)
	{
		Cover        cover;
		const double own = (2 * cloud.halfSize[p]).prod();
		lattices.forLargerNeighbours(p, [&](int q) {
			const double common = commonVolume(cloud, p, q);
			if (common == 0) return true;
			if (cover.by < 0) cover.by = q;
			cover.share += common / own;
			cover.twice += lattices.areAlike(p, q) ? common / 2 : common;
			if (!isDeformed[p] && !isDeformed[q] && areInSamePlace(cloud, p, q)) cover.samePlace = q;
			// This much is enough to know, and thousands may be at one position.
			return cover.samePlace < 0 && cover.share < 2;
		});
		return cover;
	}
}

template <int Dim> Overlaps findOverlaps(const gimpm::PointCloud<Dim>& cloud)
{
	constexpr double    wholly = 0.999;
	const Lattices<Dim> lattices(cloud);
	std::vector<char>   isDeformed(cloud.size());
	for (size_t p = 0; p < cloud.size(); ++p)
		isDeformed[p] = cloud.defGrad[p] != gimpm::Mat<Dim>::Identity();
	std::vector<Cover> covers(cloud.size());
	inRanges(cloud.size(), [&](size_t begin, size_t end) {
		for (size_t p = begin; p < end; ++p)
			covers[p] = coverOf(int(p), cloud, lattices, isDeformed);
	});
	Overlaps   found;
	const auto take = [](Overlaps::Pair& pair, int p, int q) {
		if (pair == Overlaps::none) pair = { std::min(p, q), std::max(p, q) };
	};
	for (int p = 0; p < int(cloud.size()); ++p) {
		const Cover& cover = covers[p];
		if (cover.samePlace >= 0) take(found.ofFills, p, cover.samePlace);
		if (cover.share < wholly) continue;
		if (!isDeformed[p]) take(found.ofFills, p, cover.by);
		take(found.ofAny, p, cover.by);
		// Volume with the thickness that the point stands for.
		found.volume += cover.twice * cloud.volume0[p] / (2 * cloud.halfSize0[p]).prod();
	}
	return found;
}

template Overlaps findOverlaps(const gimpm::PointCloud<2>&);
template Overlaps findOverlaps(const gimpm::PointCloud<3>&);

} // namespace yade
