// SPDX-License-Identifier: GPL-2.0-or-later
// A body that can move as a rigid one is named before the stiffness is found singular.
#include "core/stepping/restraint.hpp"
#include "scenes.hpp"

namespace gimpm::testRestraint {
namespace {

	template <int Dim> struct Body {
		Grid<Dim> grid { 0.5, Vec<Dim>::Ones() };
		// From (1, 1) to (2, 2), its middle at 1.5.
		PointCloud<Dim> cloud = block<Dim>(grid, Index<Dim>::Constant(2), 2);

		Restraint restraint(const std::vector<ConstrainedBox<Dim>>& boxes) const
		{
			const Boundary<Dim> boundary(boxes);
			return gimpm::restraint<Dim>(cloudBasis<Dim>(cloud, grid, Basis::gimp, boundary), grid, boundary);
		}
		std::string motion(const std::vector<ConstrainedBox<Dim>>& boxes) const { return restraint(boxes).freeMotion; }
		int         parts() const { return restraint({}).parts; }
		/// One node held.
		ConstrainedBox<Dim> pin(const Vec<Dim>& place, const std::string& fix) const { return held<Dim>(grid, place, place, fix); }
	};

	TEST(Restraint, NamesTheFreeTranslationIn2D)
	{
		const Body<2> body;
		EXPECT_EQ(body.motion({}), "translation along x of the material around (1.5, 1.5)");
		EXPECT_EQ(body.motion({ wallBelow<2>(body.grid, 0, 1) }), "translation along y of the material around (1.5, 1.5)");
		EXPECT_EQ(body.motion({ wallBelow<2>(body.grid, 1, 1) }), "translation along x of the material around (1.5, 1.5)");
	}

	TEST(Restraint, NamesTheFreeRotationIn2D)
	{
		const Body<2> body;
		EXPECT_EQ(body.motion({ body.pin({ 1, 1 }, "xy") }), "rotation of the material around (1.5, 1.5)");
		EXPECT_EQ(body.motion({ body.pin({ 1.5, 1 }, "x"), body.pin({ 1, 1.5 }, "y") }), "rotation of the material around (1.5, 1.5)");
	}

	TEST(Restraint, FindsEnoughIn2D)
	{
		const Body<2> body;
		EXPECT_EQ(body.motion({ body.pin({ 1, 1 }, "xy"), body.pin({ 2, 1 }, "y") }), "");
		EXPECT_EQ(body.motion({ wallBelow<2>(body.grid, 0, 1), wallBelow<2>(body.grid, 1, 1) }), "");
		EXPECT_NE(body.motion({ body.pin({ 1, 1 }, "xy"), body.pin({ 2, 1 }, "x") }), "") << "a roller that points at the pin";
		EXPECT_NE(body.motion({ held<2>(body.grid, { 10, 10 }, { 11, 11 }, "xy") }), "") << "held nodes without material";
	}

	TEST(Restraint, NamesFreeMotionsIn3D)
	{
		const Body<3>           body;
		const ConstrainedBox<3> x = wallBelow<3>(body.grid, 0, 1), y = wallBelow<3>(body.grid, 1, 1), z = wallBelow<3>(body.grid, 2, 1);
		const std::string       where = " of the material around (1.5, 1.5, 1.5)";
		EXPECT_EQ(body.motion({}), "translation along x" + where);
		EXPECT_EQ(body.motion({ x, y }), "translation along z" + where);
		EXPECT_EQ(body.motion({ y, z }), "translation along x" + where);
		EXPECT_EQ(body.motion({ x, y, z }), "");
		EXPECT_EQ(body.motion({ held<3>(body.grid, { 1, 1, -infinity }, { 1, 1, infinity }, "xyz") }), "rotation" + where) << "hinged along an edge";
		EXPECT_EQ(body.motion({ body.pin({ 1, 1, 1 }, "xyz") }), "rotation" + where);
		EXPECT_EQ(body.motion({ body.pin({ 1, 1, 1 }, "xyz"), body.pin({ 2, 1, 1 }, "yz"), body.pin({ 1, 2, 1 }, "z") }), "");
	}

	TEST(Restraint, LooksAtEveryIsland)
	{
		Body<2>    body;
		const auto island = block<2>(body.grid, { 2, 2 }, 2, { 10, 0 }); // from (6, 1) to (7, 2)
		for (const auto& x : island.position)
			addPoint<2>(body.cloud, x, island.halfSize[0]);
		const auto left = held<2>(body.grid, { 1, 1 }, { 1, 2 }, "xy"), right = held<2>(body.grid, { 7, 1 }, { 7, 2 }, "xy");
		EXPECT_EQ(body.motion({ left }), "translation along x of the material around (6.5, 1.5)");
		EXPECT_EQ(body.motion({ right }), "translation along x of the material around (1.5, 1.5)");
		EXPECT_EQ(body.motion({ left, right }), "");
		EXPECT_EQ(body.parts(), 2);
		// a roller below both leaves both
		EXPECT_EQ(body.motion({ wallBelow<2>(body.grid, 1, 1) }), "translation along x of the material around (1.5, 1.5)");
	}

	TEST(Restraint, IslandsInNeighbouringCellsAreJoinedByTheirNodes)
	{
		Body<2>    body;
		const auto neighbour = block<2>(body.grid, { 2, 2 }, 2, { 2, 0 });
		for (const auto& x : neighbour.position)
			addPoint<2>(body.cloud, x, neighbour.halfSize[0]);
		EXPECT_EQ(body.motion({ held<2>(body.grid, { 1, 1 }, { 1, 2 }, "xy") }), "");
		EXPECT_EQ(body.parts(), 1);
	}

	TEST(Restraint, FarAndLargeBodiesAreJudgedAlike)
	{
		for (const int cells : { 1, 10, 300 }) {
			const Grid<2> grid { 1e-3, { 1e3, -1e3 } };
			Body<2>       body;
			body.grid           = grid;
			body.cloud          = block<2>(grid, { cells, 1 }, 1, { 5000, 0 });
			const Vec<2> corner = grid.nodePosition({ 5000, 0 });
			const auto   pin = body.pin(corner, "xy"), roller = body.pin(corner + Vec<2>(1e-3, 0), "y");
			EXPECT_EQ(body.motion({ pin, roller }), "") << cells;
			EXPECT_EQ(body.motion({ pin }).substr(0, 8), "rotation") << cells;
		}
	}

	TEST(Restraint, ALoadStepReportsItAndChangesNothing)
	{
		Body<2>  body;
		Model<2> model;
		model.grid      = body.grid;
		model.materials = { { Hencky(1e6, 0.3), 1e3 } };
		LinearSolver solver;
		const auto   start  = body.cloud.position;
		const auto   report = loadStep<2>(body.cloud, model, { { 0, -10 } }, solver);
		EXPECT_EQ(report.failure, Failure::unrestrained);
		EXPECT_EQ(report.cause, "nothing restrains the translation along x of the material around (1.5, 1.5)");
		EXPECT_EQ(report.iterations, 0);
		EXPECT_TRUE(body.cloud.position == start);
	}

} // namespace
} // namespace gimpm::testRestraint
