// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/grip.hpp"
#include <algorithm>
#include <limits>
#include <sstream>
#include <unordered_map>

namespace gimpm {
namespace {

/// The nodes at the front of a box that pushes along an axis, and the nearest soil before each of them.
template <int Dim> class Front {
public:
	Front(const HeldBox<Dim>& box, int axis, double direction)
	        : lower(box.lower)
	        , upper(box.upper)
	        , axis(axis)
	        , sign(direction < 0 ? -1 : 1)
	{
		lower[axis] = upper[axis] = sign < 0 ? lower[axis] : upper[axis];
	}
	bool isOnGrid() const { return std::abs(lower[axis]) <= Grid<Dim>::indexLimit; }

	/// Looks at all points; false: no node has lost its soil.
	bool findsGap(const PointCloud<Dim>& cloud, const Grid<Dim>& grid)
	{
		for (std::size_t p = 0; p < cloud.size(); ++p)
			look(cloud, int(p), grid);
		widest = gaps.end();
		for (auto g = gaps.begin(); g != gaps.end(); ++g)
			if (isLost(g->second) && (widest == gaps.end() || wider(*g, *widest))) widest = g;
		return widest != gaps.end();
	}
	Index<Dim> node() const { return Grid<Dim>::index(widest->first); }
	double     gap() const { return widest->second.now; }

private:
	/// Between a node and the soil before it, in cells; `first`: to the same soil before it ever moved.
	struct Gap {
		double now, first;
	};

	/// Soil that was in the cell before the node and has withdrawn: half a cell away it takes part in 95 % of the movement, and in less than half
	/// of it not much later. Soil that was far from the beginning, as beside the crest of an embankment, has never been the node's.
	static bool isLost(const Gap& g) { return g.first < 1 - 1e-9 && g.now > 0.5 + 1e-9 && g.now > std::max(g.first, 0.) + 0.25; }
	static bool wider(const std::pair<const Key, Gap>& a, const std::pair<const Key, Gap>& b)
	{
		return std::pair(a.second.now, b.first) > std::pair(b.second.now, a.first);
	}

	double distance(const Vec<Dim>& x, const Grid<Dim>& grid) const { return sign * ((x[axis] - grid.origin[axis]) / grid.cellSize - lower[axis]); }

	/// Straight before a node is what lies within a quarter of a cell beside it: soil further out hangs on to other nodes too.
	void look(const PointCloud<Dim>& cloud, int p, const Grid<Dim>& grid)
	{
		const Vec<Dim> &x = cloud.position[p], reach = cloud.halfSize[p] / grid.cellSize + Vec<Dim>::Constant(0.25);
		const double    centre = distance(x, grid), half = cloud.halfSize[p][axis] / grid.cellSize;
		if (centre + half <= 0) return; // behind the nodes
		Index<Dim> low = lower, high = upper; // of the nodes that the point is before
		for (int a = 0; a < Dim; ++a) {
			if (a == axis) continue;
			const double place = (x[a] - grid.origin[a]) / grid.cellSize;
			low[a]             = std::max(low[a], -floorToInt(reach[a] - place));
			high[a]            = std::min(high[a], floorToInt(place + reach[a]));
			if (low[a] > high[a]) return;
		}
		const double first = distance(cloud.position0[p], grid) - cloud.halfSize0[p][axis] / grid.cellSize;
		forNodes(low, high, [&](Key node) {
			const auto [found, isNew] = gaps.try_emplace(node, Gap { centre - half, first });
			if (!isNew && centre - half < found->second.now) found->second = { centre - half, first };
		});
	}
	template <class F> static void forNodes(const Index<Dim>& low, const Index<Dim>& high, F&& f)
	{
		Index<Dim> node = low;
		for (int a = 0; a < Dim;) {
			f(Grid<Dim>::key(node));
			for (a = 0; a < Dim && ++node[a] > high[a]; ++a)
				node[a] = low[a];
		}
	}

	using Gaps = std::unordered_map<Key, Gap>;

	Index<Dim>              lower, upper;
	int                     axis;
	double                  sign;
	Gaps                    gaps;
	typename Gaps::iterator widest;
};

template <int Dim> bool holdsSoil(const HeldBox<Dim>& box, const CloudBasis<Dim>& basis)
{
	return std::any_of(basis.nodes.begin(), basis.nodes.end(), [&](Key key) {
		const Index<Dim> node = Grid<Dim>::index(key);
		return (node.array() >= box.lower.array()).all() && (node.array() <= box.upper.array()).all();
	});
}

template <class V> std::string listed(const V& x)
{
	std::ostringstream text;
	for (int a = 0; a < x.size(); ++a)
		text << (a == 0 ? "(" : ", ") << x[a];
	return text.str() + ")";
}

template <int Dim> std::string withoutSoil(const HeldBox<Dim>& box, const PointCloud<Dim>& cloud, const Grid<Dim>& grid)
{
	Vec<Dim> low = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		low  = low.cwiseMin(cloud.position[p] - cloud.halfSize[p]);
		high = high.cwiseMax(cloud.position[p] + cloud.halfSize[p]);
	}
	const auto place = [&](const Index<Dim>& node) {
		Vec<Dim> x = grid.nodePosition(node);
		for (int a = 0; a < Dim; ++a)
			if (std::abs(node[a]) > Grid<Dim>::indexLimit) x[a] = std::copysign(std::numeric_limits<double>::infinity(), node[a]);
		return listed(x);
	};
	return "none of its nodes, from " + place(box.lower) + " to " + place(box.upper) + ", carries soil, which lies between " + listed(low) + " and " + listed(high);
}

template <int Dim> std::string whatIsWrong(const HeldBox<Dim>& box, const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis, const Model<Dim>& model, const Load<Dim>& load)
{
	if (!holdsSoil(box, basis)) return withoutSoil(box, cloud, model.grid);
	if (cloud.position0.empty()) return "";
	const double before = load.factor.before(), factor = before != 0 ? before : load.factor.growth;
	for (int a = 0; a < Dim; ++a) {
		if (factor * box.displacement[a] == 0) continue;
		Front<Dim> front(box, a, factor * box.displacement[a]);
		if (!front.isOnGrid() || !front.findsGap(cloud, model.grid)) continue;
		std::ostringstream text;
		text.precision(3);
		text << "the soil that it pushes along " << (factor * box.displacement[a] < 0 ? '-' : '+') << "xyz"[a] << " is " << front.gap()
		     << " cells away from its node at " << listed(model.grid.nodePosition(front.node())) << " and no longer follows";
		return text.str();
	}
	return "";
}

} // namespace

template <int Dim> std::string lostGrip(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis, const Model<Dim>& model, const Load<Dim>& load)
{
	const auto& boxes = model.boundary.boxes();
	for (std::size_t b = 0; b < boxes.size(); ++b) {
		if (boxes[b].displacement.isZero(0)) continue;
		const std::string wrong = whatIsWrong(boxes[b], cloud, basis, model, load);
		if (!wrong.empty()) return "boundaries[" + std::to_string(b) + "] moves by " + listed(boxes[b].displacement) + " m, but " + wrong;
	}
	return "";
}

template std::string lostGrip(const PointCloud<2>&, const CloudBasis<2>&, const Model<2>&, const Load<2>&);
template std::string lostGrip(const PointCloud<3>&, const CloudBasis<3>&, const Model<3>&, const Load<3>&);

} // namespace gimpm
