// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/last_increment.hpp"
#include "core/grid/refinement.hpp"
#include <algorithm>
#include <optional>

namespace yade {

bool isIncrement(const vector<Real>& numbers)
{
	for (size_t i = 0; i < numbers.size(); ++i)
		if (!std::isfinite(numbers[i]) || (i % 6 < 3 && std::abs(numbers[i]) > gimpm::Grid<2>::indexLimit)) return false;
	return numbers.size() % 6 == 0;
}

namespace {
	// Nodes that are tied to none, and so are of the level of the largest cell around them.
	template <int Dim> std::optional<gimpm::Key> nodeAt(const Real* place, const gimpm::Grid<Dim>& grid)
	{
		const int         most = grid.refinement ? grid.refinement->largest() : 0;
		gimpm::Index<Dim> node;
		for (int a = 0; a < Dim; ++a) {
			const Real smallest = std::ldexp(place[a], most);
			if (std::abs(smallest) > gimpm::Grid<Dim>::indexLimit || smallest != std::round(smallest)) return std::nullopt;
			node[a] = int(smallest);
		}
		if (!grid.refinement) return gimpm::Grid<Dim>::key(node);
		const int level = grid.refinement->largestAt(node);
		for (int a = 0; a < Dim; ++a)
			if (gimpm::floorTo(node[a], level) != node[a]) return std::nullopt;
		return gimpm::Grid<Dim>::key(node, level);
	}
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
		const auto place = gimpm::Grid<Dim>::index(last.nodes[n]);
		for (int a = 0; a < Dim; ++a) {
			numbers[6 * n + a]     = std::ldexp(place[a], grid.refinement ? -grid.refinement->largest() : 0);
			numbers[6 * n + 3 + a] = last.displacement[Dim * n + a];
		}
	}
	return numbers;
}

template gimpm::LastIncrement<2> fromNumbers(const vector<Real>&, Real, const gimpm::Grid<2>&);
template gimpm::LastIncrement<3> fromNumbers(const vector<Real>&, Real, const gimpm::Grid<3>&);
template vector<Real>            toNumbers(const gimpm::LastIncrement<2>&, const gimpm::Grid<2>&);
template vector<Real>            toNumbers(const gimpm::LastIncrement<3>&, const gimpm::Grid<3>&);

} // namespace yade
