// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/lost_constraint.hpp"
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

namespace gimpm {
namespace {

/// The nodes at the front of a box that pushes along an axis, and the nearest soil before each of them.
template <int Dim> class Front {
public:
	Front(const ConstrainedBox<Dim>& box, int axis, double direction) : box(box), axis(axis), sign(direction < 0 ? -1 : 1)
	{
		const int front       = sign < 0 ? box.lower[axis] : box.upper[axis];
		const int period      = box.period[axis];
		exists                = period == 0 ? std::abs(front) <= Grid<Dim>::indexLimit : box.upper[axis] - box.lower[axis] < period - 1;
		this->box.lower[axis] = this->box.upper[axis] = front;
	}
	bool exists; ///< not of a box that reaches to infinity, or around a periodic grid

	struct Loss {
		Index<Dim> node;
		double     gap; ///< [cells]
	};
	/// The widest gap that has opened between a node and the soil before it, if one has.
	std::optional<Loss> loss(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, const Division& division)
	{
		for (std::size_t p = 0; p < cloud.size(); ++p)
			if (box.isOf(cloud.layerOf(int(p)))) recordGap(cloud, int(p), grid);
		takeFromOthers(division);
		std::optional<Loss> widest;
		for (const auto& [node, gap] : gaps)
			if (gap.hasOpened() && (!widest || gap.now > widest->gap)) widest = Loss { Grid<Dim>::index(node), gap.now };
		return widest;
	}

private:
	void takeFromOthers(const Division& division)
	{
		std::vector<NodeGap> own;
		for (const auto& [node, gap] : gaps)
			own.push_back({ node, gap });
		gaps.clear();
		for (const auto& [node, gap] : division.joined(std::move(own)))
			keep(node, gap);
	}

	/// Between a node and the soil before it, in cells; `first`: to the same soil before it ever moved.
	struct Gap {
		double now, first;

		/// Half a cell away the soil has taken part in 95 % of the movement, and soon it takes part in less
		/// than half of it. Soil that was about as far from the beginning, as beside the crest of an
		/// embankment, is not lost.
		bool hasOpened() const { return now > 0.5 + 1e-9 && now > std::max(first, 0.) + 0.25; }
	};

	struct NodeGap {
		Key node;
		Gap gap;
	};

	/// Distance of a point from its nearest image before or behind the front.
	double distance(const Vec<Dim>& x, const Grid<Dim>& grid, double h) const
	{
		const int front = box.lower[axis];
		return sign * (grid.imageNear(x[axis] - grid.origin[axis], front, axis) / h - front * (grid.cellSize / h));
	}

	/// Records the gap of a point. Soil that is not near counts only if it has been in the first cell. Straight
	/// before a node is what lies within a quarter of a cell beside it: soil further out moves with other nodes
	/// too.
	void recordGap(const PointCloud<Dim>& cloud, int p, const Grid<Dim>& grid)
	{
		const double h      = 2 * largestHalf<Dim>(grid, cloud.position[p]); // cells that the soil is in
		const double centre = distance(cloud.position[p], grid, h), half = cloud.halfSize[p][axis] / h;
		const double moved = sign * (cloud.position[p] - cloud.position0[p])[axis] / h;
		const Gap    gap { centre - half, centre - moved - cloud.halfSize0[p][axis] / h };
		if (centre + half <= 0 || (gap.now > 0.5 && gap.first > 1 - 1e-9)) return;
		Index<Dim> low = box.lower, high = box.upper; // range of the nodes that the point is before
		for (int a = 0; a < Dim; ++a) {
			if (a == axis) continue;
			const double position = (cloud.position[p][a] - grid.origin[a]) / grid.cellSize, reach = cloud.halfSize[p][a] / grid.cellSize + 0.25;
			const int    first = -floorToInt(reach - position), last = floorToInt(position + reach);
			const bool   isPeriodic = box.period[a] != 0; // then those beyond the sides count too
			low[a]                  = isPeriodic ? first : std::max(low[a], first);
			high[a]                 = isPeriodic ? last : std::min(high[a], last);
			if (low[a] > high[a]) return;
		}
		forNodes(low, high, [&](const Index<Dim>& node) {
			if (!box.contains(node)) return;
			keep(Grid<Dim>::key(grid.first(node)), gap);
		});
	}
	void keep(Key node, const Gap& gap)
	{
		const auto [found, isNew] = gaps.try_emplace(node, gap);
		if (!isNew && gap.now < found->second.now) found->second = gap;
	}
	template <class F> static void forNodes(const Index<Dim>& low, const Index<Dim>& high, F&& f)
	{
		Index<Dim> node = low;
		for (int a = 0; a < Dim;) {
			f(node);
			for (a = 0; a < Dim && ++node[a] > high[a]; ++a)
				node[a] = low[a];
		}
	}

	ConstrainedBox<Dim> box; // box of the nodes
	int                 axis;
	double              sign;
	std::map<Key, Gap>  gaps;
};

template <int Dim> bool holdsSoil(const ConstrainedBox<Dim>& box, const CloudBasis<Dim>& basis)
{
	return std::any_of(basis.nodes.begin(), basis.nodes.end(), [&](Key key) { return box.contains(key); });
}

/// A box that reaches a leaf and none of its corners, or only those that hang on others and follow these.
template <int Dim> bool liesBetweenNodes(const ConstrainedBox<Dim>& box, const CloudBasis<Dim>& basis)
{
	for (int node = 0; node < int(basis.nodes.size()); ++node)
		if (box.contains(basis.nodes[node]) && !basis.affineConstraints.contains(node)) return false;
	return std::any_of(basis.leaves.begin(), basis.leaves.end(), [&](Key leaf) {
		const Index<Dim> low = Grid<Dim>::index(leaf), high = low + Index<Dim>::Constant(1 << Grid<Dim>::level(leaf));
		return (low.cwiseMax(box.lower).array() <= high.cwiseMin(box.upper).array()).all();
	});
}

template <class V> std::string listed(const V& x)
{
	std::ostringstream text;
	for (int a = 0; a < x.size(); ++a)
		text << (a == 0 ? "(" : ", ") << x[a] + 0.; // not -0
	return text.str() + ")";
}

template <int Dim> std::string withoutSoil(const ConstrainedBox<Dim>& box, const PointCloud<Dim>& cloud, const Grid<Dim>& grid, const Division& division)
{
	Vec<Dim> low = Vec<Dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		if (!box.isOf(cloud.layerOf(int(p)))) continue;
		low  = low.cwiseMin(cloud.position[p] - cloud.halfSize[p]);
		high = high.cwiseMax(cloud.position[p] + cloud.halfSize[p]);
	}
	for (int a = 0; a < Dim; ++a)
		low[a] = -division.largest(-low[a]), high[a] = division.largest(high[a]);
	const auto position = [&](const Index<Dim>& node) {
		Vec<Dim> x = grid.nodePosition(node);
		for (int a = 0; a < Dim; ++a)
			if (std::abs(node[a]) > Grid<Dim>::indexLimit) x[a] = std::copysign(std::numeric_limits<double>::infinity(), node[a]);
		return listed(x);
	};
	return "none of its nodes, from " + position(box.lower) + " to " + position(box.upper) + ", carries soil, which lies between " + listed(low) + " and "
	        + listed(high);
}

template <int Dim>
std::string withdrawn(const ConstrainedBox<Dim>& box, const PointCloud<Dim>& cloud, const Grid<Dim>& grid, const LoadFactor& load, const Division& division)
{
	if (division.largest(double(cloud.position0.size())) == 0) return "";             // no process knows
	const double before = load.before(), factor = before != 0 ? before : load.growth; // load that has pushed, or begins to
	for (int a = 0; a < Dim; ++a) {
		const double push = factor * box.displacement[a];
		Front<Dim>   front(box, a, push);
		if (push == 0 || !front.exists) continue;
		const auto loss = front.loss(cloud, grid, division);
		if (!loss) continue;
		std::ostringstream text;
		text.precision(3);
		text << "the soil that it pushes along " << (push < 0 ? '-' : '+') << "xyz"[a] << " is " << loss->gap << " cells away from its node at "
		     << listed(grid.nodePosition(loss->node)) << " and no longer follows";
		return text.str();
	}
	return "";
}

} // namespace

template <int Dim> std::string lostConstraint(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis, const Model<Dim>& model, const Load<Dim>& load)
{
	const auto&     boxes    = model.boundary.boxes();
	const Division& division = *model.division;
	for (std::size_t b = 0; b < boxes.size(); ++b) {
		if (boxes[b].displacement.isZero(0)) continue;
		const std::string wrong = holdsSoil(boxes[b], basis) ? withdrawn(boxes[b], cloud, model.grid, load.ofBox(int(b)), division)
		                                                     : withoutSoil(boxes[b], cloud, model.grid, division);
		if (!wrong.empty()) return "boundaries[" + std::to_string(b) + "] moves by " + listed(boxes[b].displacement) + " m, but " + wrong;
	}
	return "";
}

template <int Dim> std::string boxBetweenNodes(const CloudBasis<Dim>& basis, const Boundary<Dim>& boundary)
{
	if (basis.leaves.empty()) return ""; // all cells are equal
	for (const auto& box : boundary.boxes())
		if (liesBetweenNodes(box, basis))
			return "boundaries[" + std::to_string(&box - boundary.boxes().data())
			        + "] lies between the nodes of larger cells, and holds none: let it reach them, or halve the cells there";
	return "";
}

template std::string boxBetweenNodes(const CloudBasis<2>&, const Boundary<2>&);
template std::string boxBetweenNodes(const CloudBasis<3>&, const Boundary<3>&);
template std::string lostConstraint(const PointCloud<2>&, const CloudBasis<2>&, const Model<2>&, const Load<2>&);
template std::string lostConstraint(const PointCloud<3>&, const CloudBasis<3>&, const Model<3>&, const Load<3>&);

} // namespace gimpm
