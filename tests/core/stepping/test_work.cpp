// SPDX-License-Identifier: GPL-2.0-or-later
// Work of gravity against stored energy while an elastic column is loaded and unloaded.
#include "scenes.hpp"
#include <cstdio>

namespace gimpm {
namespace {

	struct Cycle {
		double work = 0, energy = 0;  // at full load [J]
		double netWork = 0, left = 0; // at the end
		double settlement = 0, offset = 0;
	};

	/// Loads the column to a tenth of its weight and unloads it, both in this number of steps.
	template <int Dim> Cycle cycle(int steps)
	{
		Column<Dim> column(16);
		const auto  start  = column.cloud.position;
		const auto  stored = [&]() { // E/2 e:e for nu = 0
                        double sum = 0;
                        for (std::size_t p = 0; p < column.cloud.size(); ++p)
                                sum += column.cloud.volume0[p] * column.young / 2 * column.cloud.elasticStrain[p].full().squaredNorm();
                        return sum;
		};
		Cycle  c;
		double before = 0;
		for (int i = 1; i <= 2 * steps; ++i) {
			const auto positions = column.cloud.position;
			Load<Dim>  load;
			load.gravity      = -10 * Vec<Dim>::Unit(1);
			load.factor.value = 0.1 * (i <= steps ? i : 2 * steps - i) / steps;
			const auto report = loadStep(column.cloud, column.model, load, column.solver);
			EXPECT_TRUE(report.converged()) << report.cause;
			for (std::size_t p = 0; p < start.size(); ++p) // trapezoidal rule for the dead load
				c.netWork -= column.weight * column.cloud.volume0[p] * (before + load.factor.value) / 2
				        * (column.cloud.position[p] - positions[p])[1];
			before = load.factor.value;
			if (i == steps) c.work = c.netWork, c.energy = stored(), c.settlement = (column.cloud.position.back() - start.back()).norm();
		}
		c.left = stored();
		for (std::size_t p = 0; p < start.size(); ++p)
			c.offset = std::max(c.offset, (column.cloud.position[p] - start[p]).norm());
		return c;
	}

	template <class Dimension> using Work = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Work, BothDimensions, DimensionName);

	TYPED_TEST(Work, IsStoredAndGivenBack)
	{
		// The trapezoidal rule makes an error of second order in the load steps, new basis functions in every
		// step one of first order.
		double previous = 0, previousNet = 0;
		for (const int steps : { 4, 8, 16 }) {
			const Cycle  c     = cycle<TypeParam::value>(steps);
			const double error = c.work / c.energy - 1, net = c.netWork / c.energy;
			std::printf(
			        "%2d steps: work/energy - 1 = %.2e, net work %.2e, energy left %.1e, offset %.1e\n", steps, error, net, c.left / c.energy,
			        c.offset / c.settlement);
			if (previous > 0) {
				EXPECT_GT(std::log2(previous / error), 1.5);
				EXPECT_LT(std::log2(previous / error), 2.1);
				EXPECT_GT(std::log2(previousNet / net), 0.5);
			}
			EXPECT_GT(net, 0) << "a cycle must not yield energy";
			EXPECT_LT(net, 1e-3);
			EXPECT_LT(c.left, 1e-4 * c.energy);
			EXPECT_LT(c.offset, 1e-3 * c.settlement);
			previous = error, previousNet = net;
		}
		EXPECT_LT(previous, 1e-3);
	}

} // namespace
} // namespace gimpm
