// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/elimination_order.hpp"
#include <algorithm>
#include <limits>
#include <numeric>

namespace gimpm {
namespace {

using Nodes = std::vector<int>::iterator;

constexpr int    fewNodes  = 16; ///< number of nodes that are taken as they come
constexpr double leastPart = .2; ///< part of the nodes on either side of a cut
constexpr int    farthest  = 2;  ///< layers that couplings reach

struct Cut {
	int    axis = -1, position = 0; ///< its first layer above; no axis: there is no cut
	bool   isBelow = true;          ///< the separator
	double cost    = std::numeric_limits<double>::infinity();
};

/// Numbers of nodes that lie in each layer across an axis, and are coupled across the plane below it: from below and
/// from above.
struct Layers {
	int              lowest;
	std::vector<int> nodes, fromBelow, fromAbove;

	Layers(int low, int high) : lowest(low), nodes(high - low + 1 + farthest, 0), fromBelow(nodes), fromAbove(nodes) { }
	int  last() const { return int(nodes.size()) - farthest; }
	void add(int position, int up, int down)
	{
		const int layer = position - lowest;
		++nodes[layer];
		for (int i = 1; i <= up; ++i)
			++fromBelow[layer + i];
		for (int i = 0; i < std::min(down, layer + 1); ++i)
			++fromAbove[layer - i];
	}
};

class Dissection {
public:
	explicit Dissection(const NodeGraph& graph) : graph_(graph), side_(graph.positions.size(), 0), up_(graph.positions.size(), NodePosition {}), down_(up_)
	{
		for (std::size_t a = 0; a < graph.positions.size(); ++a)
			for (int n = graph.start[a]; n < graph.start[a + 1]; ++n)
				for (int axis = 0; axis < 3; ++axis) {
					const int distance = graph.positions[graph.neighbours[n]][axis] - graph.positions[a][axis];
					int&      reach    = (distance > 0 ? up_ : down_)[a][axis];
					reach              = std::clamp(std::abs(distance), reach, farthest);
				}
	}

	/// Ends of the two parts.
	std::pair<Nodes, Nodes> order(Nodes begin, Nodes end)
	{
		const Cut cut = end - begin > fewNodes ? thinnestCut(begin, end) : Cut();
		if (cut.axis < 0) return { begin, begin };
		const int below = ++sides_, above = ++sides_;
		for (Nodes n = begin; n != end; ++n)
			side_[*n] = graph_.positions[*n][cut.axis] < cut.position ? below : above;
		const int   thin = cut.isBelow ? below : above, other = cut.isBelow ? above : below;
		const Nodes separator = std::stable_partition(begin, end, [&](int n) { return side_[n] != thin || !isCoupledTo(other, n); });
		const Nodes second    = std::stable_partition(begin, separator, [&](int n) { return side_[n] == below; });
		order(begin, second);
		order(second, separator);
		return { second, separator };
	}

private:
	bool isCoupledTo(int side, int node) const
	{
		const auto neighbours = graph_.neighbours.begin();
		return std::any_of(neighbours + graph_.start[node], neighbours + graph_.start[node + 1], [&](int n) { return side_[n] == side; });
	}

	Cut thinnestCut(Nodes begin, Nodes end) const
	{
		Cut best;
		for (int axis = 0; axis < 3; ++axis) {
			const auto position    = [&](int a, int b) { return graph_.positions[a][axis] < graph_.positions[b][axis]; };
			const auto [low, high] = std::minmax_element(begin, end, position);
			Layers layers(graph_.positions[*low][axis], graph_.positions[*high][axis]);
			for (Nodes n = begin; n != end; ++n)
				layers.add(graph_.positions[*n][axis], up_[*n][axis], down_[*n][axis]);
			improve(best, axis, layers, int(end - begin));
		}
		return best;
	}

	/// Improves the cut by the nodes to be cut out: somewhat more of them are admitted where the parts are alike.
	static void improve(Cut& best, int axis, const Layers& layers, int count)
	{
		int below = 0;
		for (int i = 1; i < layers.last(); ++i) {
			below += layers.nodes[i - 1];
			const bool   isBelow   = layers.fromBelow[i] <= layers.fromAbove[i];
			const int    separator = isBelow ? layers.fromBelow[i] : layers.fromAbove[i];
			const int    first = below - (isBelow ? separator : 0), second = count - below - (isBelow ? 0 : separator);
			const double unlike = std::abs(first - second) / double(count), cost = separator * (1 + unlike * unlike);
			if (std::min(first, second) >= leastPart * count && cost < best.cost) best = { axis, layers.lowest + i, isBelow, cost };
		}
	}

	const NodeGraph&          graph_;
	std::vector<int>          side_; // last cut that each node was part of
	int                       sides_ = 0;
	std::vector<NodePosition> up_, down_; // layers that each node's couplings reach along each axis
};

} // namespace

Order eliminationOrder(const NodeGraph& graph)
{
	Order order { std::vector<int>(graph.positions.size()) };
	auto& nodes = order.numbers;
	std::iota(nodes.begin(), nodes.end(), 0);
	const auto [first, second] = Dissection(graph).order(nodes.begin(), nodes.end());
	order.first = int(first - nodes.begin()), order.second = int(second - first);
	return order;
}

} // namespace gimpm
