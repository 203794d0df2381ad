// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/dissection.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

using Nodes = std::vector<NodePosition>::iterator;

/// To eliminate s unknowns that are coupled to b others.
double cost(double s, double b) { return s * s * s / 3 + s * s * b + s * b * b; }

/// No less than for the nodes in a full box: as if there were separators on all its sides from the beginning.
double boundOf(std::array<double, 3> length, double unknownsPerNode, double reach)
{
	const auto volume = [&] { return unknownsPerNode * length[0] * length[1] * length[2]; };
	double     flops = 0, parts = 1, beside = 0;
	for (;; parts *= 2) {
		beside = 0;
		for (const double l : length)
			if (l > 1) beside += 2 * reach * volume() / l;
		double& longest = *std::max_element(length.begin(), length.end());
		if (longest <= 2 * reach || volume() <= 64 * unknownsPerNode) break;
		flops += parts * cost(reach * volume() / longest, beside);
		longest /= 2;
	}
	return flops + parts * cost(volume(), beside);
}

void includeIn(NodePosition& low, NodePosition& high, const NodePosition& n)
{
	for (int a = 0; a < 3; ++a) {
		low[a]  = std::min(low[a], n[a]);
		high[a] = std::max(high[a], n[a]);
	}
}

class Dissection {
public:
	Dissection(double unknownsPerNode, double reach, double enough) : perNode_(unknownsPerNode), reach_(reach), enough_(enough) { }

	/// Bit 2a of `sides`: below the nodes along axis a there is a separator; bit 2a + 1: above.
	void dissect(Nodes begin, Nodes end, unsigned sides)
	{
		if (begin == end || flops_ > enough_) return;
		NodePosition low = *begin, high = *begin;
		for (Nodes n = begin; n != end; ++n)
			includeIn(low, high, *n);
		const double beside  = boundary(begin, end, low, high, sides);
		int          longest = 0;
		for (int a = 1; a < 3; ++a)
			if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
		if (end - begin <= 64 || high[longest] - low[longest] <= 2 * reach_) return eliminate(double(end - begin), beside);
		const int   cut   = thinnestLayer(begin, end, longest, low[longest], high[longest]);
		const Nodes first = std::partition(begin, end, [=](const NodePosition& n) { return n[longest] < cut; });
		const Nodes last  = std::partition(first, end, [=](const NodePosition& n) { return n[longest] == cut; });
		eliminate(reach_ * double(last - first), beside);
		dissect(begin, first, sides | 2u << (2 * longest));
		dissect(last, end, sides | 1u << (2 * longest));
	}
	double flops() const { return flops_; }

private:
	/// Position along an axis at which the fewest nodes have to be cut out, next to the centre if that is the same,
	/// so that a quarter of them is left on either side.
	static int thinnestLayer(Nodes begin, Nodes end, int axis, int low, int high)
	{
		std::vector<int> layer(high - low + 1, 0);
		for (Nodes n = begin; n != end; ++n)
			++layer[(*n)[axis] - low];
		const int           count = int(end - begin);
		std::pair<int, int> best { count + 1, 0 }; // nodes of the layer, and how far it is from the centre
		int                 thinnest = 0, below = 0;
		for (int i = 0; i < int(layer.size()); below += layer[i++]) {
			const int                 above = count - below - layer[i];
			const std::pair<int, int> found { layer[i], std::abs(above - below) };
			if (above < 3 * count / 4 && below < 3 * count / 4 && found < best) best = found, thinnest = i;
		}
		return low + thinnest;
	}

	/// Nodes of the separators beside these.
	double boundary(Nodes begin, Nodes end, const NodePosition& low, const NodePosition& high, unsigned sides) const
	{
		double count = 0;
		for (int a = 0; a < 3; ++a)
			for (int side = 0; side < 2; ++side)
				if (sides >> (2 * a + side) & 1)
					count += double(std::count_if(begin, end, [&](const NodePosition& n) { return n[a] == (side ? high : low)[a]; }));
		return reach_ * count;
	}
	void eliminate(double nodes, double beside) { flops_ += cost(perNode_ * nodes, perNode_ * beside); }

	double perNode_, reach_, enough_;
	double flops_ = 0;
};

} // namespace

bool needsMoreFlops(std::vector<NodePosition> nodes, double unknownsPerNode, double reach, double flops)
{
	if (nodes.empty()) return false;
	NodePosition low = nodes[0], high = nodes[0];
	for (const NodePosition& n : nodes)
		includeIn(low, high, n);
	if (boundOf({ high[0] - low[0] + 1., high[1] - low[1] + 1., high[2] - low[2] + 1. }, unknownsPerNode, reach) <= flops) return false;
	Dissection dissection(unknownsPerNode, reach, flops);
	dissection.dissect(nodes.begin(), nodes.end(), 0);
	return dissection.flops() > flops;
}

} // namespace gimpm
