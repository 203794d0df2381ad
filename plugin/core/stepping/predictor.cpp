// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/predictor.hpp"

namespace gimpm {
namespace {

/// Mean over the neighbours along the axes that are known; false if there are none.
template <int Dim>
bool meanOfNeighbours(const std::vector<Key>& nodes, const Grid<Dim>& grid, const std::vector<char>& known, const Eigen::VectorXd& d, int node, Vec<Dim>& mean)
{
	const auto step  = [level = Grid<Dim>::level(nodes[node])](int axis) { return Grid<Dim>::keyStep(axis, level); };
	int        count = 0;
	mean.setZero();
	for (int a = 0; a < Dim; ++a)
		for (const Key neighbour : { nodes[node] - step(a), nodes[node] + step(a) })
			if (const int n = find(nodes, grid.first(neighbour)); n >= 0 && known[n]) mean += d.template segment<Dim>(Dim * n), ++count;
	if (count > 0) mean /= count;
	return count > 0;
}

} // namespace

template <int Dim> Eigen::VectorXd predict(const LastIncrement<Dim>& last, const std::vector<Key>& nodes, double load, const Grid<Dim>& grid)
{
	if (last.nodes.empty() || !(last.load * load > 0)) return {};
	Eigen::VectorXd   d = Eigen::VectorXd::Zero(Dim * nodes.size());
	std::vector<char> known(nodes.size(), 0);
	std::vector<int>  open;
	for (int n = 0; n < int(nodes.size()); ++n) {
		const int before = find(last.nodes, nodes[n]);
		known[n]         = before >= 0;
		if (known[n]) d.template segment<Dim>(Dim * n) = load / last.load * last.displacement.template segment<Dim>(Dim * before);
		else
			open.push_back(n);
	}
	while (!open.empty()) {
		std::vector<int> layer, rest;
		for (const int n : open) {
			Vec<Dim> mean;
			if (!meanOfNeighbours<Dim>(nodes, grid, known, d, n, mean)) rest.push_back(n);
			else
				layer.push_back(n), d.template segment<Dim>(Dim * n) = mean;
		}
		if (layer.empty()) break; // a part of the body that is new: it starts from zero
		for (const int n : layer)
			known[n] = 1;
		open = std::move(rest);
	}
	return d;
}

template Eigen::VectorXd predict(const LastIncrement<2>&, const std::vector<Key>&, double, const Grid<2>&);
template Eigen::VectorXd predict(const LastIncrement<3>&, const std::vector<Key>&, double, const Grid<3>&);

} // namespace gimpm
