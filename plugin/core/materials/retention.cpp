// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/retention.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

using Value = Retention::Value;

/// Chord of a table at a suction, and constants beyond its ends. The slope is that by the suction.
Value interpolated(const Retention::Table& table, double suction)
{
	const auto above = std::upper_bound(table.begin(), table.end(), suction, [](double s, const auto& knot) { return s < knot.first; });
	if (above == table.begin()) return { table.front().second, 0 };
	if (above == table.end()) return { table.back().second, 0 };
	const auto&  below = *(above - 1);
	const double slope = (above->second - below.second) / (above->first - below.first);
	return { below.second + slope * (suction - below.first), slope };
}

/// The same of the logarithm of the values.
Value interpolatedLogarithm(const Retention::Table& table, double suction)
{
	const auto above = std::upper_bound(table.begin(), table.end(), suction, [](double s, const auto& knot) { return s < knot.first; });
	if (above == table.begin()) return { table.front().second, 0 };
	if (above == table.end()) return { table.back().second, 0 };
	const auto&  below = *(above - 1);
	const double rate  = std::log(above->second / below.second) / (above->first - below.first),
	             value = below.second * std::exp(rate * (suction - below.first));
	return { value, rate * value };
}

} // namespace

Value Retention::effective(double pressure) const
{
	const double s = -pressure;
	if (s <= 0) return { 1, 0 };
	if (curve == Curve::exponential) {
		const double value = std::exp(-alpha * s);
		return { value, alpha * value };
	}
	if (curve == Curve::brooksCorey) {
		if (alpha * s <= 1) return { 1, 0 };
		const double value = std::pow(alpha * s, -exponent);
		return { value, exponent * value / s };
	}
	if (curve == Curve::table) {
		const double range = retained.front().second - retained.back().second;
		const auto   found = interpolated(retained, s);
		return { (found.value - retained.back().second) / range, -found.slope / range };
	}
	const double m = 1 - 1 / exponent, x = std::pow(alpha * s, exponent), value = std::pow(1 + x, -m);
	return { value, m * exponent * x / (s * (1 + x)) * value };
}

Value Retention::saturation(double pressure) const
{
	const Value  part  = effective(pressure);
	const double range = saturated - residual;
	return { saturated - range * (1 - part.value), range * part.slope };
}

/// Mualem's relative permeability: S_e^(2.5 + 2/n) with Brooks and Corey's curve. With van Genuchten's its slope has no
/// bounds at s = 0 for n < 2, where a chord takes the place of its first part (Vogel and others 2000 change the curve).
Value Retention::mualem(double s) const
{
	if (curve == Curve::brooksCorey) {
		const Value  part  = effective(-s);
		const double power = 2.5 + 2 / exponent, value = std::pow(part.value, power);
		return { value, power * value / part.value * part.slope };
	}
	const double shortest = 0.02 / alpha;
	if (exponent < 2 && s < shortest) {
		const double slope = (1 - mualem(shortest).value) / shortest;
		return { 1 - slope * s, slope };
	}
	const double m = 1 - 1 / exponent, x = std::pow(alpha * s, exponent), root = std::pow(1 + x, -m / 2);
	const double full = std::exp(-m * std::log1p(1 / x)), rest = -std::expm1(-m * std::log1p(1 / x));
	const double value = root * rest * rest;
	const double fall  = m * exponent / (s * (1 + x)); // derivative of the logarithm of `full` by the suction
	return { value, fall * (x / 2 * value + 2 * root * rest * full) };
}

Value Retention::relativePermeability(double pressure) const
{
	const double s = -pressure;
	if (s <= 0) return { 1, 0 };
	if (permeability == Permeability::mualem) return mualem(s);
	if (permeability == Permeability::exponential) {
		const double value = std::exp(-alpha * s);
		return { value, alpha * value };
	}
	if (permeability == Permeability::table) {
		const Value found = interpolatedLogarithm(conducted, s);
		return { found.value, -found.slope };
	}
	const Value  part  = effective(pressure);
	const double power = 3 + 2 / exponent, value = std::pow(part.value, power);
	return { value, power * value / part.value * part.slope };
}

} // namespace gimpm
