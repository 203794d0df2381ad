// SPDX-License-Identifier: GPL-2.0-or-later
// Retention curves: values of the published forms, and derivatives.
#include "core/materials/retention.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace gimpm::testRetention {
namespace {

	using Curve        = Retention::Curve;
	using Permeability = Retention::Permeability;

	std::vector<Retention> all()
	{
		return { { Curve::vanGenuchten, Permeability::mualem, 3.35e-4, 2, 0.277, 1 },
			 { Curve::vanGenuchten, Permeability::mualem, 1e-4, 1.3, 0.1, 0.98 },
			 { Curve::vanGenuchten, Permeability::exponential, 1e-5, 2 },
			 { Curve::exponential, Permeability::exponential, 1e-3, 0, 0.15, 1 },
			 { Curve::brooksCorey, Permeability::brooksCorey, 5e-4, 1.7 },
			 { Curve::brooksCorey, Permeability::mualem, 5e-4, 0.5 },
			 { Curve::table, Permeability::table, 0, 0, 0.2, 0.9, { { 0, 0.9 }, { 1.1e3, 0.7 }, { 2e4, 0.2 } }, { { 0, 1 }, { 1e4, 1e-3 } } } };
	}

	TEST(Retention, DerivativesAreThoseOfTheValues)
	{
		for (const Retention& law : all())
			for (const double suction : { 3.0, 123.0, 1e3, 3.3e3, 1.5e4, 3e5 }) {
				const double step = 1e-3 * suction, p = -suction;
				for (const auto curve : { &Retention::effective, &Retention::saturation, &Retention::relativePermeability }) {
					const auto   at    = [&](double steps) { return (law.*curve)(p + steps * step).value; };
					const double slope = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
					EXPECT_NEAR((law.*curve)(p).slope, slope, 1e-6 * std::abs(slope) + 1e-12 / suction) << suction;
				}
			}
	}

	TEST(Retention, PressuresOfWaterSaturate)
	{
		for (const Retention& law : all())
			for (const double pressure : { 0., 1e3, 1e6 }) {
				EXPECT_EQ(law.effective(pressure).value, 1);
				EXPECT_EQ(law.saturation(pressure).value, law.saturated);
				EXPECT_EQ(law.relativePermeability(pressure).value, 1);
				EXPECT_EQ(law.saturation(pressure).slope + law.relativePermeability(pressure).slope, 0);
			}
	}

	/// Celia, Bouloutas and Zarba (1990): at heads of -0.75 m and -10 m.
	TEST(Retention, VanGenuchtenAndMualemAsPublished)
	{
		const Retention law = all()[0];
		for (const double head : { 0.75, 10. }) {
			const double x = std::pow(3.35 * head, 2), Se = 1 / std::sqrt(1 + x);
			EXPECT_NEAR(law.effective(-1e4 * head).value / Se, 1, 1e-14);
			EXPECT_NEAR(law.relativePermeability(-1e4 * head).value / (std::sqrt(Se) * std::pow(1 - std::sqrt(1 - Se * Se), 2)), 1, 1e-9);
		}
	}

	/// Values stay in their range, and fall, in soil as dry as can be.
	TEST(Retention, DrySoilKeepsItsResidualWater)
	{
		for (const Retention& law : all()) {
			double S = law.saturated, k = 1;
			for (double suction = 1; suction < 1e12; suction *= 7) {
				const double less = law.saturation(-suction).value, tighter = law.relativePermeability(-suction).value;
				EXPECT_LE(less, S);
				EXPECT_LE(tighter, k);
				EXPECT_GE(less, law.residual - 1e-15);
				EXPECT_GE(tighter, 0);
				S = less, k = tighter;
			}
		}
	}

} // namespace
} // namespace gimpm::testRetention
