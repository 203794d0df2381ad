// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact_sight.hpp"
#include <algorithm>
#include <limits>

namespace gimpm {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Distance at which a line enters a box; infinite if it passes by. A line along a face of it just passes by.
template <int Dim> double entry(const Vec<Dim>& position, const Vec<Dim>& along, const SoilDomain<Dim>& domain)
{
	double first = -infinite, last = infinite;
	for (int a = 0; a < Dim; ++a) {
		const double away = domain.centre[a] - position[a];
		if (std::abs(along[a]) < 1e-12) {
			if (std::abs(away) >= domain.half[a]) return infinite;
			continue;
		}
		const double middle = away / along[a], half = std::abs(domain.half[a] / along[a]);
		first = std::max(first, middle - half), last = std::min(last, middle + half);
	}
	return first < last ? first : infinite;
}

/// Distance at which a line is beside a domain that it misses by less than this: in the middle of its way through a
/// wider one; infinite if it passes by farther away.
template <int Dim> double beside(const Vec<Dim>& position, const Vec<Dim>& along, SoilDomain<Dim> domain, double margin)
{
	domain.half.array() += margin;
	const double first = entry(position, along, domain);
	return first == infinite ? infinite : (first - entry(position, Vec<Dim>(-along), domain)) / 2;
}

} // namespace

template <int Dim>
SoilNear<Dim>::SoilNear(std::vector<SoilDomain<Dim>> domains, double cellSize, bool isSmall)
        : domains_(std::move(domains)), cellSize_(cellSize), isSmall_(isSmall)
{
	low_ = Vec<Dim>::Constant(infinite), high_ = -low_;
	for (const auto& d : domains_) {
		low_ = low_.cwiseMin(d.centre), high_ = high_.cwiseMax(d.centre);
		largest_ = std::max(largest_, d.half.maxCoeff());
		if (d.gap < 0) inside_.push_back(d);
	}
	if (domains_.empty()) return;
	size_ = bin(high_) + Index<Dim>::Ones();
	for (std::size_t i = 0; i < domains_.size(); ++i) {
		const Index<Dim> at  = bin(domains_[i].centre);
		std::int64_t     key = 0;
		for (int a = Dim - 1; a >= 0; --a)
			key = key * size_[a] + at[a];
		bins_.emplace_back(key, int(i));
	}
	std::sort(bins_.begin(), bins_.end());
}

/// Calls f for the domains with their centres in the box, and others beside.
template <int Dim> template <class F> void SoilNear<Dim>::forIn(const Vec<Dim>& low, const Vec<Dim>& high, F&& f) const
{
	if ((low.array() > high_.array()).any() || (high.array() < low_.array()).any()) return;
	const Index<Dim> from = bin(low.cwiseMax(low_)), to = bin(high.cwiseMin(high_));
	Index<Dim>       row = from;
	for (int a = 0; a < Dim;) {
		std::int64_t key = 0;
		for (int b = Dim - 1; b > 0; --b)
			key = key * size_[b] + row[b];
		key *= size_[0];
		const std::int64_t last = key + to[0];
		for (auto i = std::lower_bound(bins_.begin(), bins_.end(), std::pair(key + from[0], -1)); i != bins_.end() && i->first <= last; ++i)
			f(domains_[i->second]);
		for (a = 1; a < Dim && ++row[a] > to[a]; ++a)
			row[a] = from[a];
	}
}

/// The line along the normal may pass between domains, which do not tile the soil where it is sheared or stretched:
/// then those count which it misses by a quarter of a cell. Before a small ball a domain that it enters counts if it
/// is not far behind one of those, where the line is beside them: corners of soil oblique to the line lie beside it.
template <int Dim> double SoilNear<Dim>::gapFrom(const Vec<Dim>& position, const Vec<Dim>& normal, double reach, const Hides& hides) const
{
	const double   aside = 0.25 * cellSize_;
	double         hit = infinite, near = infinite, missed = infinite;
	const Vec<Dim> margin = Vec<Dim>::Constant(largest_ + aside), end = position + reach * normal;
	forIn(position.cwiseMin(end) - margin, position.cwiseMax(end) + margin, [&](const SoilDomain<Dim>& d) {
		if (!d.isInFrontOf(normal)) return;
		const double straight = entry(position, normal, d);
		const double here     = d.isPassed(position, normal, aside) ? infinite : (d.centre - position).dot(normal) - normal.cwiseAbs().dot(d.half);
		if ((straight >= hit && here >= near) || (hides && hides(d.centre))) return;
		hit = std::min(hit, straight), near = std::min(near, here);
	});
	if (hit < infinite && hit < near + 2 * aside) return hit;
	if (hit == infinite || !isSmall_) return near;
	forIn(position.cwiseMin(end) - margin, position.cwiseMax(end) + margin, [&](const SoilDomain<Dim>& d) {
		if (!d.isInFrontOf(normal) || entry(position, normal, d) < infinite || (hides && hides(d.centre))) return;
		missed = std::min(missed, beside(position, normal, d, aside));
	});
	return hit < missed + 2 * aside ? hit : near;
}

/// Finds the soil in front of a contact point. Its amount is a volume, which does not jump: that in a box in front of
/// the position where the soil begins. A quarter of the box is nothing, three quarters are full, so that over the
/// contact points on both sides of where soil ends the parts add up to the area that it covers. How much of the box
/// that end leaves along an axis is told by the centre of the soil in it; what is missing besides are gaps.
template <int Dim> std::optional<Sight> SoilNear<Dim>::from(const Vec<Dim>& position, const Vec<Dim>& normal, double reach, const Hides& hides) const
{
	const double half = 0.25 * cellSize_, gap = gapFrom(position, normal, reach, hides);
	if (!(gap <= reach)) return std::nullopt;
	const Vec<Dim> size = Vec<Dim>::Constant(half), middle = position + (std::max(0., gap) + half) * normal, margin = Vec<Dim>::Constant(largest_);
	double         volume = 0, stiff = 0;
	Vec<Dim>       moment = Vec<Dim>::Zero();
	forIn(middle - size - margin, middle + size + margin, [&](const SoilDomain<Dim>& d) {
		if (!d.isInFrontOf(normal)) return;
		const Vec<Dim> low = (middle - size).cwiseMax(d.centre - d.half), high = (middle + size).cwiseMin(d.centre + d.half);
		const double   part = (high - low).cwiseMax(0).prod();
		if (part == 0 || (hides && hides(d.centre))) return;
		volume += part, stiff += part * d.young, moment += part * ((low + high) / 2 - middle);
	});
	if (volume == 0) return std::nullopt;
	const auto counts       = [](double part) { return std::clamp(2 * part - 0.5, 0., 1.); };
	double     areaFraction = 1, tiled = volume / std::pow(2 * half, Dim);
	int        across;
	normal.cwiseAbs().maxCoeff(&across);
	for (int a = 0; a < Dim; ++a) {
		if (a == across) continue;
		const double left = 1 - std::abs(moment[a]) / (volume * half);
		areaFraction *= counts(left), tiled /= left;
	}
	return Sight { gap, areaFraction * counts(tiled), stiff / volume };
}

template <int Dim> double SoilNear<Dim>::deepest(const Vec<Dim>& position, const Vec<Dim>& normal, double gap) const
{
	for (const auto& d : inside_)
		if (d.isInFrontOf(normal) && !d.isPassed(position, normal, 0.25 * cellSize_)) gap = std::min(gap, d.gap);
	return gap;
}

template class SoilNear<2>;
template class SoilNear<3>;

} // namespace gimpm
