// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/last_increment.hpp"
#include "core/grid/refinement.hpp"
#include <algorithm>

namespace yade {

namespace {
	// The first coordinate of a node is counted from so much times its layer, farther than coordinates go.
	constexpr Real layerStep = 4294967296;
	Real           layerOf(Real first) { return std::round(first / layerStep); }
	Real           coordinate(const Real* place, int axis) { return axis == 0 ? place[0] - layerStep * layerOf(place[0]) : place[axis]; }
}

bool isIncrement(const vector<Real>& numbers)
{
	if (numbers.size() % 6 != 0) return false;
	for (size_t i = 0; i < numbers.size(); ++i) {
		if (!std::isfinite(numbers[i])) return false;
		if (i % 6 == 0 && (layerOf(numbers[i]) < 0 || layerOf(numbers[i]) > gimpm::Grid<2>::mostLayer)) return false;
		if (i % 6 < 3 && std::abs(coordinate(&numbers[i - i % 6], i % 6)) > gimpm::Grid<2>::indexLimit) return false;
	}
	return true;
}

template <int Dim> std::optional<gimpm::Key> nodeAt(const Real* place, const gimpm::Grid<Dim>& grid)
{
	const int         most = grid.refinement ? grid.refinement->largest() : 0;
	gimpm::Index<Dim> node;
	for (int a = 0; a < Dim; ++a) {
		const Real smallest = std::ldexp(coordinate(place, a), most);
		if (std::abs(smallest) > gimpm::Grid<Dim>::indexLimit || smallest != std::round(smallest)) return std::nullopt;
		node[a] = int(smallest);
	}
	const int layer = int(layerOf(place[0]));
	if (layer > gimpm::Grid<Dim>::mostLayer) return std::nullopt;
	if (!grid.refinement) return gimpm::Grid<Dim>::key(node, 0, layer);
	const int level = grid.refinement->largestAt(node);
	for (int a = 0; a < Dim; ++a)
		if (gimpm::floorTo(node[a], level) != node[a]) return std::nullopt;
	return gimpm::Grid<Dim>::key(node, level, layer);
}

template <int Dim> void putPlace(gimpm::Key node, const gimpm::Grid<Dim>& grid, Real* place)
{
	const auto index = gimpm::Grid<Dim>::index(node);
	for (int a = 0; a < Dim; ++a)
		place[a] = std::ldexp(index[a], grid.refinement ? -grid.refinement->largest() : 0);
	place[0] += layerStep * gimpm::Grid<Dim>::layer(node);
}

template <int Dim> gimpm::LastIncrement<Dim> fromNumbers(const vector<Real>& numbers, Real load, const gimpm::Grid<Dim>& grid)
{
	vector<std::pair<gimpm::Key, const Real*>> found;
	for (size_t i = 0; i < numbers.size(); i += 6)
		if (const auto node = nodeAt(&numbers[i], grid)) found.emplace_back(*node, &numbers[i + 3]);
	std::sort(found.begin(), found.end());
	gimpm::LastIncrement<Dim> last { {}, Eigen::VectorXd(Dim * found.size()), load };
	for (const auto& [node, displacement] : found) {
		last.displacement.template segment<Dim>(Dim * last.nodes.size()) = Eigen::Map<const gimpm::Vec<Dim>>(displacement);
		last.nodes.push_back(node);
	}
	return last;
}

template <int Dim> vector<Real> toNumbers(const gimpm::LastIncrement<Dim>& last, const gimpm::Grid<Dim>& grid)
{
	vector<Real> numbers(6 * last.nodes.size(), 0);
	for (size_t n = 0; n < last.nodes.size(); ++n) {
		putPlace(last.nodes[n], grid, &numbers[6 * n]);
		for (int a = 0; a < Dim; ++a)
			numbers[6 * n + 3 + a] = last.displacement[Dim * n + a];
	}
	return numbers;
}

template std::optional<gimpm::Key> nodeAt(const Real*, const gimpm::Grid<2>&);
template std::optional<gimpm::Key> nodeAt(const Real*, const gimpm::Grid<3>&);
template void                      putPlace(gimpm::Key, const gimpm::Grid<2>&, Real*);
template void                      putPlace(gimpm::Key, const gimpm::Grid<3>&, Real*);

template gimpm::LastIncrement<2> fromNumbers(const vector<Real>&, Real, const gimpm::Grid<2>&);
template gimpm::LastIncrement<3> fromNumbers(const vector<Real>&, Real, const gimpm::Grid<3>&);
template vector<Real>            toNumbers(const gimpm::LastIncrement<2>&, const gimpm::Grid<2>&);
template vector<Real>            toNumbers(const gimpm::LastIncrement<3>&, const gimpm::Grid<3>&);

} // namespace yade
