// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/last_increment.hpp"

namespace yade {

bool isIncrement(const vector<Real>& numbers)
{
	for (size_t i = 0; i < numbers.size(); ++i)
		if (!std::isfinite(numbers[i]) || (i % 6 < 3 && std::abs(numbers[i]) > gimpm::Grid<2>::indexLimit)) return false;
	return numbers.size() % 6 == 0;
}

template <int Dim> gimpm::LastIncrement<Dim> fromNumbers(const vector<Real>& numbers, Real load)
{
	const size_t              nodes = numbers.size() / 6;
	gimpm::LastIncrement<Dim> last { vector<gimpm::Key>(nodes), Eigen::VectorXd(Dim * nodes), load };
	for (size_t n = 0; n < nodes; ++n) {
		gimpm::Index<Dim> place;
		for (int a = 0; a < Dim; ++a) {
			place[a]                       = int(numbers[6 * n + a]);
			last.displacement[Dim * n + a] = numbers[6 * n + 3 + a];
		}
		last.nodes[n] = gimpm::Grid<Dim>::key(place);
	}
	return last;
}

template <int Dim> vector<Real> toNumbers(const gimpm::LastIncrement<Dim>& last)
{
	vector<Real> numbers(6 * last.nodes.size(), 0);
	for (size_t n = 0; n < last.nodes.size(); ++n) {
		const auto place = gimpm::Grid<Dim>::index(last.nodes[n]);
		for (int a = 0; a < Dim; ++a) {
			numbers[6 * n + a]     = place[a];
			numbers[6 * n + 3 + a] = last.displacement[Dim * n + a];
		}
	}
	return numbers;
}

template gimpm::LastIncrement<2> fromNumbers(const vector<Real>&, Real);
template gimpm::LastIncrement<3> fromNumbers(const vector<Real>&, Real);
template vector<Real>            toNumbers(const gimpm::LastIncrement<2>&);
template vector<Real>            toNumbers(const gimpm::LastIncrement<3>&);

} // namespace yade
