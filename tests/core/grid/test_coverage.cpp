// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/coverage.hpp"
#include "core/grid/domain.hpp"
#include <gtest/gtest.h>

namespace gimpm {
namespace {

	struct Boxes {
		std::vector<Vec<2>> centres, halfLengths;
	};

	/// Points 2 x 2 to a cell of size 1 around the origin, deformed by F.
	Boxes deformed(const Mat<2>& F, DomainRule rule)
	{
		Boxes boxes;
		for (int i = -24; i < 24; ++i)
			for (int j = -24; j < 24; ++j) {
				const Vec<2> x = F * Vec<2>(i / 2. + 0.25, j / 2. + 0.25);
				if (x.cwiseAbs().maxCoeff() > 4.01) continue;
				boxes.centres.push_back(x);
				boxes.halfLengths.push_back(domainOf<2>(F, Vec<2>::Constant(0.25), rule).cwiseMin(0.5));
			}
		return boxes;
	}
	Coverage coverageOf(const Boxes& boxes) { return coverage<2>(boxes.centres, boxes.halfLengths); }

	TEST(Coverage, IsWholeWhereDomainsTile)
	{
		const auto square = coverageOf(deformed(Mat<2>::Identity(), DomainRule::tiling));
		EXPECT_EQ(square.cells, 36); // cells with neighbours on all sides, out of 8 x 8
		EXPECT_LT(square.largest, 1e-14);
		const auto sheared = coverageOf(deformed((Mat<2>() << 1, 0.6, 0, 1).finished(), DomainRule::tiling));
		EXPECT_GT(sheared.cells, 20);
		EXPECT_LT(sheared.largest, 1e-12);
	}

	TEST(Coverage, TellsGapsAndOverlaps)
	{
		auto boxes = deformed(Mat<2>::Identity(), DomainRule::tiling);
		for (std::size_t p = 0; p < boxes.centres.size(); ++p)
			if (boxes.centres[p][0] > 0 && boxes.centres[p][0] < 1) boxes.halfLengths[p][0] *= 0.8;
		const auto thinner = coverageOf(boxes);
		EXPECT_NEAR(thinner.largest, 0.2, 1e-12); // one row of cells in six
		EXPECT_NEAR(thinner.mean, 0.2 / 6, 1e-12);
		const auto stretched = coverageOf(deformed((Mat<2>() << 1, 0.6, 0, 1).finished(), DomainRule::stretch));
		EXPECT_GT(stretched.mean, 0.01);
	}

} // namespace
} // namespace gimpm
