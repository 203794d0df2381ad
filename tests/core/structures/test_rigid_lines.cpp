// SPDX-License-Identifier: GPL-2.0-or-later
// Thin rigid bodies as lines that part the soil.
#include "core/structures/rigid_lines.hpp"
#include "core/structures/from_line.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/terms/ghost.hpp"
#include "refined.hpp"

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

	/// Sheets in any order and direction make one line as long as no more than two meet; thick blocks make none.
	TEST(RigidLines, JoinThinBodiesThatShareEnds)
	{
		const auto open = linesOf({ sheet({ 1, 0 }, { 2, 0 }), plank({ 5, 5 }, { 1, 1 }), sheet({ 1, 0 }, { 1, -1 }), sheet({ 3, 1 }, { 2, 0 }) }, equal(0.5));
		ASSERT_EQ(open.size(), 1u);
		EXPECT_EQ(open[0].positions.size(), 4u);
		EXPECT_EQ(open[0].bodies.size(), 3u);
		EXPECT_FALSE(open[0].isClosed);

		const auto ring = linesOf({ sheet({ 0, 0 }, { 1, 0 }), sheet({ 0, 1 }, { 0, 0 }), sheet({ 1, 0 }, { 0, 1 }) }, equal(0.5));
		ASSERT_EQ(ring.size(), 1u);
		EXPECT_TRUE(ring[0].isClosed);

		EXPECT_EQ(linesOf({ sheet({ 0, 0 }, { 1, 0 }), sheet({ 1, 0 }, { 2, 0 }), sheet({ 1, 0 }, { 1, 1 }) }, equal(0.5)).size(), 3u);

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

	/// A block of three sizes of cells that lines go through.
	struct Sides {
		Grid<2>                grid  = cornerGrid<2>();
		PointCloud<2>          cloud = scattered<2>(600);
		std::vector<RigidLine> lines;
		CloudBasis<2>          basis;

		Sides(const Vec<2>& from, const Vec<2>& to)
		{
			lines = linesOf({ sheet(from, to) }, grid);
			partSoil({ &lines[0] }, cloud, grid);
			basis = cloudBasis<2>(cloud, grid, Basis::gimp, Boundary<2>());
		}

		bool isRight(const Vec<2>& x) const { return fromLine(lines[0].positions, x).side < 0; }

		/// Nodal values of two fields, of which nodes that are there twice have one each; tied nodes by their masters.
		template <class F> Eigen::VectorXd fields(F&& f) const
		{
			Eigen::VectorXd d(2 * basis.nodes.size());
			for (std::size_t n = 0; n < basis.nodes.size(); ++n) {
				const Key    node = basis.nodes[n];
				const Vec<2> x    = grid.nodePosition(Grid<2>::index(node));
				const bool   is   = Grid<2>::layer(node) > 0 || (isRight(x) && !grid.parting->isOwn(Parting<2>::in(1, node)));
				d.segment<2>(2 * n) = f(is, x);
			}
			basis.affineConstraints.distribute<2>(d);
			return d;
		}
		std::vector<Vec<2>> valuesAtPoints(const Eigen::VectorXd& d) const
		{
			std::vector<Vec<2>> value(cloud.size(), Vec<2>::Zero());
			forPointNodes(basis, [&](int i, const Patch<2>& patch, const double* weight, int count) {
				for (int n = 0; n < count; ++n)
					value[basis.order[i]] += weight[n] * d.segment<2>(2 * patch.node[n]);
			});
			return value;
		}
		/// The force by which a field strains the ghost faces.
		double ghostForce(const Eigen::VectorXd& d)
		{
			auto faces = ghostFaces<2>(basis.populatedLeaves(), boundaryCells<2>(basis.populatedLeaves(), {}, grid), {}, grid);
			EXPECT_FALSE(faces.empty());
			for (auto& face : faces) {
				for (int i = 0; i < 3; ++i)
					for (int s = 0; s < 2; ++s)
						EXPECT_EQ(basis.nodes.at(face.node[i][s] = position(basis.nodes, face.key(i, s))), face.key(i, s));
				face.stiffness = 1;
			}
			Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
			addGhostForce<2>(faces, grid.cellSize, d, force);
			basis.affineConstraints.condense<2>(force);
			return force.cwiseAbs().maxCoeff();
		}
	};

	/// Through all of a block: each side has its linear field, of which points and ghost faces of the other one have
	/// nothing.
	TEST(RigidLines, SidesOnCellsOfSeveralSizesHaveFieldsOfTheirOwn)
	{
		Random random(4);
		for (const auto& [from, to] : { std::pair(Vec<2>(0.4, -1), Vec<2>(0.4, 4)), std::pair(Vec<2>(-1, -0.7), Vec<2>(5, 2.9)), std::pair(Vec<2>(1, 4), Vec<2>(1, -1)) }) {
			Sides sides(from, to);
			ASSERT_EQ(sides.lines[0].layer, 1);
			const Mat<2> A[2]     = { random.matrix<2, 2>(), random.matrix<2, 2>() };
			const auto   field    = [&](bool isRight, const Vec<2>& x) { return Vec<2>(A[isRight] * x + Vec<2>::Constant(isRight)); };
			const auto   d        = sides.fields(field);
			const auto   value    = sides.valuesAtPoints(d);
			int          count[2] = {};
			for (std::size_t p = 0; p < sides.cloud.size(); ++p) {
				const Vec<2>& x = sides.cloud.position[p];
				EXPECT_LT((value[p] - field(sides.isRight(x), x)).norm(), 1e-12) << x.transpose();
				EXPECT_TRUE(sides.isRight(x) || sides.cloud.layerOf(int(p)) == 0);
				++count[sides.cloud.layerOf(int(p))];
			}
			EXPECT_GT(std::min(count[0], count[1]), 60);
			EXPECT_LT(sides.ghostForce(d), 1e-11);
		}
	}

	/// Around the tip soil is one body, and a linear field of both sides is seen by no ghost face.
	TEST(RigidLines, ATipOnCellsOfSeveralSizesLeavesSoilWhole)
	{
		for (const Vec<2>& tip : { Vec<2>(0.4, 0.4), Vec<2>(0.5, 1.6), Vec<2>(0.45, 1.) }) {
			Sides      sides({ tip[0], 4 }, tip);
			const auto d     = sides.fields([&](bool, const Vec<2>& x) { return Vec<2>(3 * x[0] + x[1], x[0] - 2 * x[1]); });
			const auto value = sides.valuesAtPoints(d);
			for (std::size_t p = 0; p < sides.cloud.size(); ++p) {
				const Vec<2>& x = sides.cloud.position[p];
				EXPECT_LT((value[p] - Vec<2>(3 * x[0] + x[1], x[0] - 2 * x[1])).norm(), 1e-12);
			}
			EXPECT_LT(sides.ghostForce(d), 1e-12);
			const auto own = std::count_if(sides.basis.nodes.begin(), sides.basis.nodes.end(), [&](Key node) { return sides.grid.parting->isOwn(node); });
			EXPECT_GT(own, 3);
			for (const Key node : sides.basis.nodes)
				if (sides.grid.parting->isOwn(node)) EXPECT_GT(sides.grid.nodePosition(Grid<2>::index(node))[1], tip[1] - 1e-9);
		}
	}

} // namespace
} // namespace gimpm::testRigidLines
