// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/predictor.hpp"
#include "core/grid/parting.hpp"

namespace gimpm {
namespace {

/// Mean over the neighbours along the axes that are known; false if there are none.
template <int Dim>
bool meanOfNeighbours(
        const std::vector<Key>& nodes, const Grid<Dim>& grid, const std::vector<char>& known, const Eigen::VectorXd& d, int width, int node,
        Eigen::VectorXd& mean)
{
	const auto step  = [level = Grid<Dim>::level(nodes[node])](int axis) { return Grid<Dim>::keyStep(axis, level); };
	int        count = 0;
	mean.setZero(width);
	for (int a = 0; a < Dim; ++a)
		for (const Key neighbour : { nodes[node] - step(a), nodes[node] + step(a) })
			if (const int n = find(nodes, grid.first(neighbour)); n >= 0 && known[n]) mean += d.segment(width * n, width), ++count;
	if (count > 0) mean /= count;
	return count > 0;
}

/// Number of a node among those before, or of the one in its place from which it has been parted since; -1: it is new.
template <int Dim> int numberBefore(const std::vector<Key>& nodesBefore, Key node, const Grid<Dim>& grid)
{
	const int same = find(nodesBefore, node);
	return same < 0 && grid.parting ? find(nodesBefore, grid.parting->ofBody(node)) : same;
}

} // namespace

template <int Dim>
Eigen::VectorXd continued(
        const std::vector<Key>& nodesBefore, const Eigen::VectorXd& before, double times, int width, const std::vector<Key>& nodes, const Grid<Dim>& grid)
{
	Eigen::VectorXd   d = Eigen::VectorXd::Zero(width * nodes.size()), mean;
	std::vector<char> known(nodes.size(), 0);
	std::vector<int>  open;
	for (int n = 0; n < int(nodes.size()); ++n) {
		const int at = numberBefore(nodesBefore, nodes[n], grid);
		known[n]     = at >= 0;
		if (known[n]) d.segment(width * n, width) = times * before.segment(width * at, width);
		else
			open.push_back(n);
	}
	while (!open.empty()) {
		std::vector<int> layer, rest;
		for (const int n : open)
			if (!meanOfNeighbours<Dim>(nodes, grid, known, d, width, n, mean)) rest.push_back(n);
			else
				layer.push_back(n), d.segment(width * n, width) = mean;
		if (layer.empty()) break; // a part of the body that is new: it starts from zero
		for (const int n : layer)
			known[n] = 1;
		open = std::move(rest);
	}
	return d;
}

template <int Dim> Eigen::VectorXd predict(const LastIncrement<Dim>& last, const std::vector<Key>& nodes, double load, const Grid<Dim>& grid)
{
	if (last.nodes.empty() || !(last.load * load > 0)) return {};
	return continued<Dim>(last.nodes, last.displacement, load / last.load, Dim, nodes, grid);
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template Eigen::VectorXd predict(const LastIncrement<Dim>&, const std::vector<Key>&, double, const Grid<Dim>&);                                        \
	template Eigen::VectorXd continued(const std::vector<Key>&, const Eigen::VectorXd&, double, int, const std::vector<Key>&, const Grid<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
