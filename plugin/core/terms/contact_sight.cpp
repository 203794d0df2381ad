// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact_sight.hpp"
#include <algorithm>
#include <limits>

namespace gimpm {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Where a line enters a box; infinite if it passes by. A line along a face of it just passes by.
template <int Dim> double entry(const Vec<Dim>& place, const Vec<Dim>& along, const SoilDomain<Dim>& domain)
{
	double first = -infinite, last = infinite;
	for (int a = 0; a < Dim; ++a) {
		const double away = domain.centre[a] - place[a];
		if (std::abs(along[a]) < 1e-12) {
			if (std::abs(away) >= domain.half[a]) return infinite;
			continue;
		}
		const double middle = away / along[a], half = std::abs(domain.half[a] / along[a]);
		first = std::max(first, middle - half), last = std::min(last, middle + half);
	}
	return first < last ? first : infinite;
}

} // namespace

template <int Dim> SoilNear<Dim>::SoilNear(std::vector<SoilDomain<Dim>> domains, double cellSize) : domains_(std::move(domains)), cellSize_(cellSize)
{
	low_ = Vec<Dim>::Constant(infinite), high_ = -low_;
	for (const auto& d : domains_) {
		low_ = low_.cwiseMin(d.centre), high_ = high_.cwiseMax(d.centre);
		largest_ = std::max(largest_, d.half.maxCoeff());
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

/// Calls f for the domains with their middles in the box, and others beside.
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
/// then those count which it misses by a quarter of a cell. How much soil there is is a volume, which does not jump:
/// that in a box in front of the place where the soil begins. A quarter of the box is nothing, three quarters are full,
/// so that over the places on both sides of where soil ends the parts add up to the area that it covers. Along each
/// axis of the face it is another box, which is narrow along the other one: so it is also at corners of the soil.
template <int Dim> std::optional<Sight> SoilNear<Dim>::from(const Vec<Dim>& place, const Vec<Dim>& normal, double reach) const
{
	const double   beside = 0.25 * cellSize_;
	double         hit = infinite, near = infinite;
	const Vec<Dim> margin = Vec<Dim>::Constant(largest_ + beside), end = place + reach * normal;
	const auto     isInFront = [&](const SoilDomain<Dim>& d) { return d.outward.dot(normal) > 0.7; };
	forIn(place.cwiseMin(end) - margin, place.cwiseMax(end) + margin, [&](const SoilDomain<Dim>& d) {
		if (!isInFront(d)) return;
		const double distance = entry(place, normal, d);
		if (distance < infinite) hit = std::min(hit, distance);
		const Vec<Dim> away   = d.centre - place;
		const double   across = away.dot(normal);
		const bool     passes = ((away - across * normal).array().abs() > d.half.array() + beside).any();
		if (!passes) near = std::min(near, across - normal.cwiseAbs().dot(d.half));
	});
	const double gap = hit < infinite && hit < near + 2 * beside ? hit : near;
	if (!(gap <= reach)) return std::nullopt;
	const Vec<Dim> middle = place + (std::max(0., gap) + beside) * normal;
	const auto     soilIn = [&](const Vec<Dim>& size, double& stiff) {
                double volume = 0;
                forIn(middle - size - margin, middle + size + margin, [&](const SoilDomain<Dim>& d) {
                        if (!isInFront(d)) return;
                        const Vec<Dim> low = (middle - size).cwiseMax(d.centre - d.half), high = (middle + size).cwiseMin(d.centre + d.half);
                        const double   part = (high - low).cwiseMax(0).prod();
                        volume += part, stiff += part * d.young;
                });
                return volume;
	};
	double       stiff = 0, presence = 1;
	const double volume = soilIn(Vec<Dim>::Constant(beside), stiff);
	if (volume == 0) return std::nullopt;
	int across;
	normal.cwiseAbs().maxCoeff(&across);
	for (int a = 0; a < Dim; ++a) {
		if (a == across) continue;
		Vec<Dim> size = Vec<Dim>::Constant(beside / 2);
		size[a] = size[across] = beside;
		double unused          = 0;
		presence *= std::clamp(2 * soilIn(size, unused) / (std::pow(2., Dim) * size.prod()) - 0.5, 0., 1.);
	}
	return Sight { gap, presence, stiff / volume };
}

template class SoilNear<2>;
template class SoilNear<3>;

} // namespace gimpm
