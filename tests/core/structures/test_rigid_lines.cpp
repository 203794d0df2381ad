// SPDX-License-Identifier: GPL-2.0-or-later
// Thin rigid bodies as lines that part the soil.
#include "core/structures/rigid_lines.hpp"
#include "scenes.hpp"
#include <set>

namespace gimpm::testRigidLines {
namespace {

	Grid<2> equal(double cellSize)
	{
		Grid<2> grid;
		grid.cellSize = cellSize;
		return grid;
	}

	RigidBody<2> sheet(const Vec<2>& from, const Vec<2>& to)
	{
		RigidBody<2> body;
		body.shape.kind       = RigidKind::sheet;
		body.shape.corners    = { from, to };
		body.shape.isTwoSided = true;
		return body;
	}

	RigidBody<2> plank(const Vec<2>& middle, const Vec<2>& half)
	{
		RigidBody<2> body;
		body.shape.kind     = RigidKind::block;
		body.shape.halfSize = half;
		body.begin.position = middle;
		return body;
	}

	/// Sheets in any order and direction make one line where two meet, or where they go straight on; thick blocks
	/// make none.
	TEST(RigidLines, JoinThinBodiesThatShareEnds)
	{
		const auto open
		        = linesOf({ sheet({ 1, 0 }, { 2, 0 }), plank({ 5, 5 }, { 1, 1 }), sheet({ 1, 0 }, { 1, -1 }), sheet({ 3, 1 }, { 2, 0 }) }, equal(0.5));
		ASSERT_EQ(open.size(), 1u);
		EXPECT_EQ(open[0].positions.size(), 4u);
		EXPECT_EQ(open[0].bodies.size(), 3u);
		EXPECT_FALSE(open[0].isClosed);

		const auto ring = linesOf({ sheet({ 0, 0 }, { 1, 0 }), sheet({ 0, 1 }, { 0, 0 }), sheet({ 1, 0 }, { 0, 1 }) }, equal(0.5));
		ASSERT_EQ(ring.size(), 1u);
		EXPECT_TRUE(ring[0].isClosed);

		EXPECT_EQ(linesOf({ sheet({ 0, 0 }, { 1, 0 }), sheet({ 1, 0 }, { 2, 0 }), sheet({ 1, 0 }, { 1, 1 }) }, equal(0.5)).size(), 2u);
		EXPECT_EQ(linesOf({ sheet({ 0, 0 }, { 1, 0 }), sheet({ 1, 0 }, { 2, 1 }), sheet({ 1, 0 }, { 1, 1 }) }, equal(0.5)).size(), 3u);

		const auto alone = linesOf({ plank({ 1, 2 }, { 0.1, 2 }) }, equal(0.5));
		ASSERT_EQ(alone.size(), 1u);
		EXPECT_LT((alone[0].positions[0] - alone[0].positions[1] - Vec<2>(0, 4)).norm(), 1e-12);
	}

	/// The cut of a sheet ends at the first line of the grid beyond its tip, and goes through at the top.
	TEST(RigidLines, PartSoilToTheLineBeyondTheTip)
	{
		for (const auto& [tip, last] : { std::pair(1., 3), std::pair(0.8, 2), std::pair(1.2, 3) }) {
			Grid<2>       grid  = equal(0.5);
			PointCloud<2> cloud = block<2>(grid, { 6, 4 }, 2);
			auto          lines = linesOf({ sheet({ 1.5, tip }, { 1.5, 2.2 }) }, grid);
			partSoil({ &lines[0] }, cloud, grid);
			ASSERT_EQ(lines[0].layer, 1);
			const auto isOwn = [&](int y) { return grid.parting->isOwn(Grid<2>::key({ 3, y }, 0, 1)); };
			EXPECT_TRUE(isOwn(last) && isOwn(4)) << tip;
			EXPECT_FALSE(isOwn(last - 1)) << tip;
		}
	}

	/// Layers of points beside thin bodies that part soil all the way.
	std::vector<int> layersAt(const std::vector<RigidBody<2>>& bodies, const std::vector<Vec<2>>& positions)
	{
		Grid<2>                   grid  = equal(0.5);
		PointCloud<2>             cloud = block<2>(grid, { 8, 8 }, 2);
		auto                      lines = linesOf(bodies, grid);
		std::vector<PartingLine*> those;
		for (auto& line : lines)
			those.push_back(&line);
		partSoil(those, cloud, grid, true);
		std::vector<int> layers;
		for (const Vec<2>& x : positions)
			layers.push_back(grid.parting->layerAt(x));
		return layers;
	}

	/// Between two sheets half a cell to three cells apart, and beyond each, soil has a layer of its own.
	TEST(RigidLines, PartSoilOnBothSidesOfTwoNearSheets)
	{
		for (const double gap : { 0.25, 0.5, 1., 1.5 }) {
			const auto layers = layersAt(
			        { sheet({ 1.6, -1 }, { 1.6, 5 }), sheet({ 1.6 + gap, -1 }, { 1.6 + gap, 5 }) },
			        { { 1.5, 2 }, { 1.6 + gap / 2, 2 }, { 1.7 + gap, 2 } });
			const std::set<int> unlike(layers.begin(), layers.end());
			EXPECT_EQ(unlike.size(), 3u) << gap;
			EXPECT_EQ(layers[0] & layers[2], 0) << gap;
		}
	}

	/// Four quarters around a cross have four layers; beyond a sheet at which another one ends soil is whole.
	TEST(RigidLines, PartSoilAtJunctions)
	{
		const std::vector<Vec<2>> quarters { { 1.8, 1.8 }, { 2.2, 1.8 }, { 1.8, 2.2 }, { 2.2, 2.2 } };
		const auto                cross = layersAt({ sheet({ -1, 2 }, { 5, 2 }), sheet({ 2, -1 }, { 2, 5 }) }, quarters);
		EXPECT_EQ(std::set<int>(cross.begin(), cross.end()).size(), 4u);
		for (const double end : { 1.9, 2., 2.1 })
			for (const bool isUpwards : { false, true }) {
				const Vec<2> from = isUpwards ? Vec<2>(2, -1) : Vec<2>(2, end), to = isUpwards ? Vec<2>(2, end) : Vec<2>(2, -1);
				const auto   tee = layersAt({ sheet({ -1, 2 }, { 5, 2 }), sheet(from, to) }, quarters);
				EXPECT_EQ(std::set<int>(tee.begin(), tee.end()).size(), 3u) << end;
				EXPECT_EQ(tee[2], tee[3]) << end;
			}
	}

} // namespace
} // namespace gimpm::testRigidLines
