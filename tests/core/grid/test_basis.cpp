// SPDX-License-Identifier: GPL-2.0-or-later
// Basis functions of one axis: hat functions, and hat functions averaged over a domain.
#include "scenes.hpp"

namespace gimpm {
namespace {

	struct GimpBasis : AxisBasis {
		int cell, cells;
	};

	GimpBasis gimpBasis(double x, double l, double h)
	{
		const auto cells = AxisCells::reached(x, l, h);
		GimpBasis  b;
		b.setGimp(x, l, h, cells);
		b.cell = cells.lowest, b.cells = cells.count;
		return b;
	}

	struct Domain {
		double x, l, h;
	};

	/// Random domains at most `reach` cells from the origin, and domains whose centre or end lies exactly on a cell
	/// face; half lengths down to 1e-6 of a cell.
	std::vector<Domain> domains(int reach)
	{
		std::vector<Domain> all;
		Random              random;
		for (const double h : { 1., 0.1, 0.3, 1e-9, 7e8 })
			for (int i = 0; i < 2000; ++i) {
				const double face = random.integer(-reach, reach) * h;
				const double l    = i % 4 == 0 ? h / 2 : h * std::pow(10, random.in(-6, std::log10(0.5)));
				const double x[]  = { face + random.in(-1, 1) * h, face, face + l, face - l, face + random.in(-1, 1) * l };
				all.push_back({ x[i % 5], l, h });
			}
		return all;
	}

	double hat(double x, double h) { return std::max(0., 1 - std::abs(x) / h); }

	/// Average of the hat function of the node at `node` over the domain: Simpson's rule between the kinks, exact
	/// for its linear pieces.
	double averagedHat(const Domain& d, double node)
	{
		double       ends[] = { d.x - d.l, node - d.h, node, node + d.h, d.x + d.l }, sum = 0;
		const double lowest = ends[0], highest = ends[4];
		for (double& e : ends)
			e = std::clamp(e, lowest, highest);
		for (int i = 0; i < 4; ++i) {
			const double a = ends[i], b = ends[i + 1];
			sum += (b - a) / 6 * (hat(a - node, d.h) + 4 * hat((a + b) / 2 - node, d.h) + hat(b - node, d.h));
		}
		return sum / (2 * d.l);
	}

	/// Round-off of positions at this distance from the origin, in cells.
	double positionNoise(const Domain& d) { return 8 * precision * (1 + std::abs(d.x) / d.h); }

	TEST(GimpBasis, ValuesSumToOneAndSlopesToZero)
	{
		for (const Domain& d : domains(100000000)) {
			const GimpBasis b     = gimpBasis(d.x, d.l, d.h);
			double          value = 0, slope = 0;
			for (int n = 0; n <= b.cells; ++n)
				value += b.value[n], slope += b.gradient[n];
			EXPECT_NEAR(value, 1, 4 * precision) << d.x << " " << d.l << " " << d.h;
			EXPECT_NEAR(slope * d.h, 0, 4 * precision) << d.x << " " << d.l << " " << d.h;
		}
	}

	TEST(GimpBasis, ReproducesLinearFieldsExactly)
	{
		for (const Domain& d : domains(100000000)) {
			const GimpBasis b     = gimpBasis(d.x, d.l, d.h);
			double          value = 0, slope = 0;
			for (int n = 0; n <= b.cells; ++n) {
				value += b.value[n] * ((b.cell + n) - d.x / d.h);
				slope += b.gradient[n] * n * d.h; // whatever the distance from the origin
			}
			EXPECT_NEAR(value, 0, positionNoise(d)) << d.x << " " << d.l << " " << d.h;
			EXPECT_NEAR(slope, 1, 8 * precision) << d.x << " " << d.l << " " << d.h;
		}
	}

	TEST(GimpBasis, IsTheAverageOfTheHatFunction)
	{
		for (const Domain& d : domains(2)) {
			const GimpBasis b = gimpBasis(d.x, d.l, d.h);
			for (int n = -1; n <= b.cells + 1; ++n) {
				const bool   active = n >= 0 && n <= b.cells;
				const double node   = (b.cell + n) * d.h;
				// Noise of the differences between ends and jumps of the gradient.
				const double noise = positionNoise(d) * d.h / d.l;
				EXPECT_NEAR(active ? b.value[n] : 0, averagedHat(d, node), noise) << d.x << " " << d.l << " " << d.h << " node " << n;
				const double slope = (hat(d.x + d.l - node, d.h) - hat(d.x - d.l - node, d.h)) / (2 * d.l);
				// a smaller overlap counts as none.
				EXPECT_NEAR(active ? b.gradient[n] * d.h : 0, slope * d.h, overlapTolerance + noise)
				        << d.x << " " << d.l << " " << d.h << " node " << n;
			}
		}
	}

	TEST(GimpBasis, SharesOfTheDomainInTheCells)
	{
		const GimpBasis two = gimpBasis(4.1, 0.4, 1); // 3.7 ... 4.5
		EXPECT_EQ(two.cell, 3);
		EXPECT_EQ(two.cells, 2);
		EXPECT_NEAR(two.share(0, 1), 0.3 / 0.8, 1e-14);
		EXPECT_NEAR(two.share(1, 1), 0.5 / 0.8, 1e-14);
		const GimpBasis one = gimpBasis(4.5, 0.4, 1);
		EXPECT_EQ(one.cell, 4);
		EXPECT_EQ(one.cells, 1);
	}

	TEST(GimpBasis, DomainEndingOnAFaceStaysInItsCell)
	{
		// Points of regular fillings, computed in the ways that differ by round-off: 3 * 0.1 > 0.3, sums,
		// offsets below precision.
		for (const double h : { 0.1, 0.3, 1. / 3, 1., 1e-9, 7e8 })
			for (const int perCell : { 1, 2, 3, 4, 7 }) {
				double sum = h / (2 * perCell);
				for (int i = 0; i < 300; ++i, sum += h / perCell) {
					const double l = h / (2 * perCell), x = (i + 0.5) * (h / perCell), cell = i / perCell;
					for (const double variant :
					     { x, (i + 0.5) / perCell * h, sum, x + 1e-17 * h, x - 1e-17 * h, x * (1 + precision), x * (1 - precision) })
						for (const double half : { l, l * (1 + 2 * precision), l * (1 - 2 * precision) }) {
							const GimpBasis b = gimpBasis(variant, half, h);
							EXPECT_EQ(b.cell, cell) << h << " " << perCell << " " << i;
							EXPECT_EQ(b.cells, 1) << h << " " << perCell << " " << i;
						}
				}
			}
	}

	TEST(GimpBasis, PointOnAFaceBelongsToBothCells)
	{
		for (const double offset : { 0., 1e-17, -1e-17, 1e-12, -1e-12 }) {
			const GimpBasis b = gimpBasis(0.3 + offset, 0.04, 0.1);
			EXPECT_EQ(b.cell, 2);
			ASSERT_EQ(b.cells, 2);
			EXPECT_NEAR(b.value[0], 0.1, 1e-10); // l / 4h
			EXPECT_NEAR(b.value[1], 0.8, 1e-10);
			EXPECT_NEAR(b.value[2], 0.1, 1e-10);
		}
	}

	TEST(GimpBasis, DomainOfACellsLengthReachesTwoCells)
	{
		for (int i = -50; i < 50; ++i) {
			const double x = 0.1 * i;
			EXPECT_EQ(gimpBasis(x, 0.05, 0.1).cells, 2) << i;        // centred on a face
			EXPECT_EQ(gimpBasis(x + 0.05, 0.05, 0.1).cells, 1) << i; // centred in a cell
			EXPECT_EQ(gimpBasis(x + 0.05, 0.05, 0.1).cell, i) << i;
		}
	}

	TEST(GimpBasis, NeglectedOverlapMovesNoResult)
	{
		const double l = 0.25, h = 1;
		const double largest = overlapTolerance * l;
		const auto   counted = gimpBasis(1 - l + 1.01 * largest, l, h), neglected = gimpBasis(1 - l + 0.99 * largest, l, h);
		ASSERT_EQ(counted.cells, 2);
		ASSERT_EQ(neglected.cells, 1);
		for (int n = 0; n < 2; ++n)
			EXPECT_NEAR(counted.value[n], neglected.value[n], largest);
		EXPECT_LT(counted.value[2], 1e-15);
	}

	TEST(LinearBasis, InterpolatesInItsCell)
	{
		AxisBasis b;
		b.setLinear(2.75, 0.5, 5);
		EXPECT_DOUBLE_EQ(b.value[0], 0.5);
		EXPECT_DOUBLE_EQ(b.value[1], 0.5);
		EXPECT_DOUBLE_EQ(b.gradient[0], -2);
		EXPECT_DOUBLE_EQ(b.gradient[1], 2);
	}

	TEST(LinearBasis, PointOnAFaceBelongsToTheLowerCell)
	{
		EXPECT_EQ(centreCell(3 * 0.1, 0.1), 2); // 3 * 0.1 > 0.3
		for (int i = -100; i <= 100; ++i)
			for (const double offset : { 0., 1e-17, -1e-17, precision, -precision }) {
				EXPECT_EQ(centreCell(i * 0.1 + offset, 0.1), i - 1);
				EXPECT_EQ(centreCell(i * 0.1 + 0.05 + offset, 0.1), i);
			}
	}

} // namespace
} // namespace gimpm
