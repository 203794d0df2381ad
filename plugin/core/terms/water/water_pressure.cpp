// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/water/water_pressure.hpp"
#include "core/grid/refinement.hpp"
#include <array>

namespace gimpm {
namespace {

/// The hat functions of one axis averaged over [x - l, x + l], with first and second derivatives by x.
struct AveragedHats {
	int                   first = 0, count = 0;
	std::array<double, 4> value {}, gradient {}, bend {};

	AveragedHats() = default;
	AveragedHats(double x, double l, double h) // from the grid's origin
	{
		const double low = (x - l) / h, high = (x + l) / h, w = high - low;
		first = int(std::floor(low));
		count = std::min(int(std::floor(high)) + 2 - first, 4);
		for (int i = 0; i < count; ++i) {
			const double a = low - (first + i), b = high - (first + i);
			value[i]    = (integral(b) - integral(a)) / w;
			gradient[i] = (hat(b) - hat(a)) / (w * h);
			bend[i]     = (rise(b) - rise(a)) / (w * h * h);
		}
	}

private:
	static double hat(double t) { return std::max(0., 1 - std::abs(t)); }
	static double rise(double t) { return std::abs(t) >= 1 ? 0 : t < 0 ? 1 : -1; }
	static double integral(double t)
	{
		if (t <= -1) return 0;
		if (t >= 1) return 1;
		return t < 0 ? 0.5 * (1 + t) * (1 + t) : 1 - 0.5 * (1 - t) * (1 - t);
	}
};

/// The product over the axes of values, but of first derivatives along the axes a and b, where they are given; along
/// both, if they are the same, of second derivatives.
template <int Dim> double product(const std::array<AveragedHats, Dim>& hats, const Index<Dim>& node, int a = -1, int b = -1)
{
	double result = 1;
	for (int k = 0; k < Dim; ++k) {
		const auto& of = hats[k];
		result *= (k == a && k == b ? of.bend : k == a || k == b ? of.gradient : of.value)[node[k]];
	}
	return result;
}

template <int Dim> void addNode(PressureAround<Dim>& sum, double pressure, const std::array<AveragedHats, Dim>& hats, const Index<Dim>& node)
{
	sum.value += pressure * product<Dim>(hats, node);
	for (int a = 0; a < Dim; ++a) {
		sum.gradient[a] += pressure * product<Dim>(hats, node, a);
		for (int b = 0; b < Dim; ++b)
			sum.hessian(a, b) += pressure * product<Dim>(hats, node, a, b);
	}
}

} // namespace

// Mean over a box with the wet part o of its height 2 l: that of weight (level - s) is weight o^2 / 4 l, and its
// derivative is that of o.
template <int Dim> std::optional<PressureAround<Dim>> StillWater<Dim>::around(const Vec<Dim>& x, const Vec<Dim>& half) const
{
	PressureAround<Dim> p;
	const double        l = half[axis_], depth = level_ - up_ * x[axis_];
	if (depth <= -l) return p;
	const bool   isUnder = depth >= l;
	const double wet     = isUnder ? 2 * l : depth + l;
	p.value              = weight_ * (isUnder ? depth : wet * wet / (4 * l));
	p.gradient[axis_]    = -up_ * weight_ * wet / (2 * l);
	if (!isUnder) p.hessian(axis_, axis_) = weight_ / (2 * l);
	return p;
}

/// Gain from the first period to the one that this node is in.
template <int Dim> double TabulatedWater<Dim>::sincePeriod(const Index<Dim>& node, const Index<Dim>& first) const
{
	double gain = 0;
	for (int a = 0; a < Dim; ++a)
		if (fall_[a] != 0) gain += fall_[a] * ((node[a] - first[a]) / grid_.period[a]);
	return gain;
}

/// Interpolates in cells of the size of the leaf there, or of the next size of which all values are known.
template <int Dim> std::optional<PressureAround<Dim>> TabulatedWater<Dim>::around(const Vec<Dim>& x, const Vec<Dim>& half) const
{
	const Vec<Dim> from = (x - grid_.origin) / grid_.cellSize;
	if (!(from.array().abs() < Grid<Dim>::indexLimit).all()) return std::nullopt;
	if (!grid_.refinement) return aroundIn(0, x, half);
	const Key leaf = grid_.refinement->leafOf(Grid<Dim>::key(Index<Dim>(from.array().floor().template cast<int>())));
	const int own  = Grid<Dim>::level(leaf);
	for (int away = 0; away <= grid_.refinement->largest(); ++away)
		for (const int level : { own - away, own + away })
			if (0 <= level && level <= grid_.refinement->largest())
				if (auto found = aroundIn(level, x, half)) return found;
	return std::nullopt;
}

template <int Dim> std::optional<PressureAround<Dim>> TabulatedWater<Dim>::aroundIn(int level, const Vec<Dim>& x, const Vec<Dim>& half) const
{
	const double                  h = grid_.size(level);
	std::array<AveragedHats, Dim> hats;
	int                           count = 1;
	for (int a = 0; a < Dim; ++a) {
		hats[a] = AveragedHats(x[a] - grid_.origin[a], std::min(half[a], 0.5 * h), h);
		count *= hats[a].count;
	}
	PressureAround<Dim> sum;
	for (int n = 0; n < count; ++n) {
		Index<Dim> node, at;
		for (int a = 0, rest = n; a < Dim; rest /= hats[a].count, ++a)
			node[a] = rest % hats[a].count, at[a] = (hats[a].first + node[a]) * (1 << level);
		const Index<Dim> first    = grid_.first(at);
		const int        position = find(nodes_, Grid<Dim>::key(first));
		if (position < 0) return std::nullopt;
		addNode<Dim>(sum, values_[position] + sincePeriod(at, first), hats, node);
	}
	return sum;
}

template class StillWater<2>;
template class StillWater<3>;
template class TabulatedWater<2>;
template class TabulatedWater<3>;

} // namespace gimpm
