// SPDX-License-Identifier: GPL-2.0-or-later
// Cells in which the deformation varies too much for their size.
#include "core/grid/varying_cells.hpp"
#include "scenes.hpp"
#include <Eigen/Geometry>

namespace gimpm::testVaryingCells {
namespace {

	template <class Dimension> using VaryingCellsTest = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(VaryingCellsTest, BothDimensions, DimensionName);

	constexpr int cells = 8;

	/// Two points a cell along each axis of a cube of cells, with a deformation gradient by position in cells.
	template <int Dim, class F> CellErrors<Dim> errors(F&& deformationGradient)
	{
		const Grid<Dim>                  grid { 0.5, Vec<Dim>::Constant(-1.25) };
		std::vector<DeformedVolume<Dim>> points;
		for (int i = 0; i < int(std::pow(2 * cells, Dim)); ++i) {
			Vec<Dim> x;
			for (int a = 0, rest = i; a < Dim; ++a, rest /= 2 * cells)
				x[a] = (rest % (2 * cells) + 0.5) / 2;
			points.push_back({ grid.origin + grid.cellSize * x, 0.1, deformationGradient(x).template topLeftCorner<Dim, Dim>() });
		}
		return CellErrors<Dim>(points, grid);
	}

	template <int Dim, class F> std::vector<Index<Dim>> found(F&& deformationGradient) { return errors<Dim>(deformationGradient).largest(0.02); }

	Mat3 sheared(double by)
	{
		Mat3 F  = Mat3::Identity();
		F(0, 1) = by;
		return F;
	}

	TYPED_TEST(VaryingCellsTest, NoneWhereTheWholeBodyDeformsTurnsOrHangsByItsWeight)
	{
		constexpr int Dim = TypeParam::value;
		EXPECT_TRUE(found<Dim>([](const Vec<Dim>&) { return Mat3(Mat3::Identity()); }).empty());
		EXPECT_TRUE(found<Dim>([](const Vec<Dim>&) { return sheared(0.3); }).empty());
		EXPECT_TRUE(found<Dim>([](const Vec<Dim>&) { return Mat3(Eigen::AngleAxisd(0.7, Vec<3>::UnitZ())); }).empty());
		EXPECT_TRUE(found<Dim>([](const Vec<Dim>& x) { return sheared(0.01 * x[1]); }).empty());
	}

	TYPED_TEST(VaryingCellsTest, ThoseOfASlipSurfaceAndNoOthers)
	{
		constexpr int    Dim  = TypeParam::value;
		const auto       slip = found<Dim>([](const Vec<Dim>& x) { return sheared(x[1] > 3 && x[1] < 4 ? 0.2 : 0.); });
		std::vector<int> rows(cells, 0);
		for (const auto& cell : slip)
			++rows[cell[1]];
		EXPECT_EQ(rows[3], int(std::pow(cells, Dim - 1)));
		EXPECT_GT(rows[2], rows[3] / 2); // of neighbours, part of which is enough
		EXPECT_GT(rows[4], rows[3] / 2);
		EXPECT_EQ(rows[2] + rows[3] + rows[4], int(slip.size()));
	}

	TYPED_TEST(VaryingCellsTest, ErrorOfTheOthersIsThePartAskedFor)
	{
		constexpr int Dim = TypeParam::value;
		const auto    all = errors<Dim>([](const Vec<Dim>& x) { return sheared(0.2 * std::sin(x[1])); });
		for (const double part : { 0.1, 0.05, 0.03 }) {
			const auto large = all.largest(part);
			ASSERT_FALSE(large.empty());
			const auto isLeft = [&](std::size_t without) {
				return all.without(
				        [&](const auto& cell) { return std::find(large.begin(), large.end() - without, cell) != large.end() - without; });
			};
			EXPECT_LE(isLeft(0), part);
			EXPECT_GT(isLeft(1), part);
		}
		EXPECT_TRUE(all.largest(1).empty());
	}

	TYPED_TEST(VaryingCellsTest, TheSameOnesInTheSameOrderAgain)
	{
		constexpr int Dim    = TypeParam::value;
		const auto    corner = [](const Vec<Dim>& x) { return sheared(std::exp(-x.norm())); };
		const auto    first = found<Dim>(corner), again = found<Dim>(corner);
		ASSERT_FALSE(first.empty());
		EXPECT_LT(first.size(), std::pow(cells, Dim) / 2);
		EXPECT_EQ(first, again);
	}

} // namespace
} // namespace gimpm::testVaryingCells
