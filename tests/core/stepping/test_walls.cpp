// SPDX-License-Identifier: GPL-2.0-or-later
// Nothing lies behind a wall: a face whose nodes are all held along its normal.
#include "core/materials/in_space.hpp"
#include "core/materials/relaxing.hpp"
#include "core/stepping/wall_overhang.hpp"
#include "scenes.hpp"
#include <set>

namespace gimpm::testWalls {
namespace {

	template <int Dim> std::set<Key> keys(const std::vector<Index<Dim>>& cells)
	{
		std::set<Key> k;
		for (const auto& c : cells)
			k.insert(Grid<Dim>::key(c));
		return k;
	}

	template <int Dim> std::set<Key> populated(const PointCloud<Dim>& cloud, const std::vector<ConstrainedBox<Dim>>& boxes, Basis basis = Basis::gimp)
	{
		const auto b = cloudBasis<Dim>(cloud, Grid<Dim>(), basis, Boundary<Dim>(boxes));
		return { b.cells.begin(), b.cells.end() };
	}

	template <int Dim> PointCloud<Dim> onePoint(const Vec<Dim>& x, const Vec<Dim>& l)
	{
		PointCloud<Dim> cloud;
		addPoint<Dim>(cloud, x, l);
		return cloud;
	}

	const Grid<2> plane;
	const Grid<3> space;

	TEST(Wall, ADomainGrownAgainstItPopulatesNothingBehind)
	{
		// 0.1 of the length 0.6 reaches behind x = 0
		const auto cloud = onePoint<2>({ 0.2, 0.5 }, { 0.3, 0.3 });
		EXPECT_EQ(populated<2>(cloud, {}), keys<2>({ { -1, 0 }, { 0, 0 } }));
		const auto basis = cloudBasis<2>(cloud, plane, Basis::gimp, Boundary<2>({ wallBelow<2>(plane, 0, 0) }));
		EXPECT_EQ(basis.cells.size(), 1u);
		EXPECT_EQ(basis.nodes.size(), 4u);
		for (const Key node : basis.nodes)
			EXPECT_GE(Grid<2>::index(node)[0], 0);
		EXPECT_NEAR(basis.largestWallOverlap, 0.1, 1e-15);
	}

	TEST(Wall, ItHidesFromBothSides)
	{
		for (const double x : { 0.2, -0.2 })
			EXPECT_EQ(
			        populated<2>(onePoint<2>({ x, 0.5 }, { 0.3, 0.3 }), { held<2>(plane, { 0, 0 }, { 0, 1 }, "x") }),
			        keys<2>({ { x > 0 ? 0 : -1, 0 } }));
	}

	TEST(Wall, RollersAcrossAreNoWall)
	{
		const auto tangential = held<2>(plane, { -infinity, -infinity }, { 0, infinity }, "y");
		EXPECT_EQ(populated<2>(onePoint<2>({ 0.2, 0.5 }, { 0.3, 0.3 }), { tangential }).size(), 2u);
	}

	TEST(Wall, InACornerOnlyTheCornerCellIsPopulated)
	{
		const auto flat = onePoint<2>({ 0.2, 0.2 }, { 0.3, 0.3 });
		EXPECT_EQ(populated<2>(flat, {}).size(), 4u);
		EXPECT_EQ(populated<2>(flat, { wallBelow<2>(plane, 0, 0), wallBelow<2>(plane, 1, 0) }), keys<2>({ { 0, 0 } }));
		// walls that end in the corner: the cell diagonally behind can only be reached through them
		EXPECT_EQ(populated<2>(flat, { held<2>(plane, { 0, 0 }, { 0, 1 }, "x"), held<2>(plane, { 0, 0 }, { 1, 0 }, "y") }), keys<2>({ { 0, 0 } }));

		const auto solid = onePoint<3>({ 0.2, 0.2, 0.2 }, { 0.3, 0.3, 0.3 });
		EXPECT_EQ(populated<3>(solid, {}).size(), 8u);
		EXPECT_EQ(populated<3>(solid, { wallBelow<3>(space, 0, 0) }).size(), 4u);
		EXPECT_EQ(populated<3>(solid, { wallBelow<3>(space, 0, 0), wallBelow<3>(space, 2, 0) }), keys<3>({ { 0, 0, 0 }, { 0, -1, 0 } }));
		EXPECT_EQ(populated<3>(solid, { wallBelow<3>(space, 0, 0), wallBelow<3>(space, 1, 0), wallBelow<3>(space, 2, 0) }), keys<3>({ { 0, 0, 0 } }));
	}

	TEST(Wall, MaterialReachesAroundAWallThatEndsInTheDomain)
	{
		// a wall along x = 0 that ends at y = 0, as a sheet pile does, in all mirror images
		for (const int side : { -1, 1 })
			for (const int up : { -1, 1 }) {
				const auto pile  = held<2>(plane, { 0, up > 0 ? 0 : -infinity }, { 0, up > 0 ? infinity : 0 }, "x");
				const auto floor = held<2>(plane, { -1, 0 }, { 1, 0 }, "y");
				const auto point = [&](double y) { return onePoint<2>({ side * 0.2, up * y }, { 0.3, 0.3 }); };
				const int  near = side > 0 ? 0 : -1, above = up > 0 ? 0 : -1, below = -1 - above;
				EXPECT_EQ(populated<2>(point(0.2), { pile }).size(), 4u) << "around the tip";
				EXPECT_EQ(populated<2>(point(-0.2), { pile }).size(), 4u) << "around the tip";
				EXPECT_EQ(populated<2>(point(0.5), { pile }), keys<2>({ { near, above } })) << "away from the tip";
				EXPECT_EQ(populated<2>(point(-0.5), { pile }), keys<2>({ { -1, below }, { 0, below } })) << "below the tip";
				EXPECT_EQ(populated<2>(point(0.2), { pile, floor }), keys<2>({ { near, above } })) << "a floor at the tip bars the way";
			}
	}

	TEST(Wall, MaterialReachesAroundTheEdgeOfAPlateIn3D)
	{
		// the quarter plane x = 0, y > 0, z > 0
		const auto plate = held<3>(space, { 0, 0, 0 }, { 0, infinity, infinity }, "x");
		for (const int side : { -1, 1 }) {
			EXPECT_EQ(populated<3>(onePoint<3>({ side * 0.2, 0.2, 0.2 }, { 0.3, 0.3, 0.3 }), { plate }).size(), 8u) << "around the corner";
			EXPECT_EQ(populated<3>(onePoint<3>({ side * 0.2, 0.2, 0.5 }, { 0.3, 0.3, 0.3 }), { plate }).size(), 4u) << "around the edge";
			EXPECT_EQ(populated<3>(onePoint<3>({ side * 0.2, 0.5, 0.5 }, { 0.3, 0.3, 0.3 }), { plate }).size(), 1u);
		}
		// a floor on one quarter bars the direct way down, not the way past the plate's other edge
		const auto floor = held<3>(space, { 0, 0, 0 }, { infinity, infinity, 0 }, "z");
		EXPECT_EQ(populated<3>(onePoint<3>({ 0.2, 0.2, 0.2 }, { 0.3, 0.3, 0.3 }), { plate, floor }).size(), 8u);
	}

	TEST(Wall, APointOnItBelongsToTheSideOfTheMaterial)
	{
		for (const Basis basis : { Basis::gimp, Basis::linear })
			for (const double offset : { 0., 1e-17, -1e-17, 1e-10, -1e-10 }) {
				const auto cloud = onePoint<2>({ 3 + offset, 0.5 }, { 0.3, 0.3 });
				EXPECT_EQ(populated<2>(cloud, { wallBelow<2>(plane, 0, 3) }, basis), keys<2>({ { 3, 0 } })) << offset;
				EXPECT_EQ(populated<2>(cloud, { wallAbove<2>(plane, 0, 3) }, basis), keys<2>({ { 2, 0 } })) << offset;
				const auto high = onePoint<3>({ 0.5, 0.5, 3 + offset }, { 0.3, 0.3, 0.3 });
				EXPECT_EQ(populated<3>(high, { wallBelow<3>(space, 2, 3) }, basis), keys<3>({ { 0, 0, 3 } })) << offset;
				EXPECT_EQ(populated<3>(high, { wallAbove<3>(space, 2, 3) }, basis), keys<3>({ { 0, 0, 2 } })) << offset;
			}
	}

	TEST(Wall, APointInACornerBelongsToTheSideOfTheMaterial)
	{
		const auto cloud = onePoint<2>({ 3, 3 }, { 0.3, 0.3 });
		EXPECT_EQ(populated<2>(cloud, { wallBelow<2>(plane, 0, 3), wallBelow<2>(plane, 1, 3) }), keys<2>({ { 3, 3 } }));
		EXPECT_EQ(populated<2>(cloud, { wallAbove<2>(plane, 0, 3), wallBelow<2>(plane, 1, 3) }), keys<2>({ { 2, 3 } }));
		EXPECT_EQ(populated<2>(cloud, { wallAbove<2>(plane, 0, 3), wallAbove<2>(plane, 1, 3) }), keys<2>({ { 2, 2 } }));
	}

	TEST(Wall, ARegularBlockBetweenWallsTouchesThemAndPopulatesItsOwnCells)
	{
		const Grid<2>                  tenths { 0.1, { 0.3, 0.3 } };
		std::vector<ConstrainedBox<2>> walls;
		for (int axis = 0; axis < 2; ++axis)
			walls.push_back(wallBelow<2>(tenths, axis, 0.3)), walls.push_back(wallAbove<2>(tenths, axis, 0.6)); // 0.3 + 3 * 0.1 > 0.6
		const auto basis = cloudBasis<2>(block<2>(tenths, { 3, 3 }, 3), tenths, Basis::gimp, Boundary<2>(walls));
		EXPECT_EQ(basis.cells.size(), 9u);
		EXPECT_EQ(basis.nodes.size(), 16u);
		EXPECT_EQ(basis.largestWallOverlap, 0);
	}

	/// Averaged over its domain, half of which lies behind the wall, it would move through it; another one stays as
	/// it is.
	TEST(Wall, AMiddleThatIsCarriedToItStaysBefore)
	{
		PointCloud<2> before;
		addPoint<2>(before, { 0.02, 0.5 }, { 0.5, 0.3 });
		addPoint<2>(before, { 0.45, 0.5 }, { 0.5, 0.3 });
		Model<2> model;
		model.materials = { { Hencky(1, 0), 1 } };
		model.boundary  = Boundary<2>({ wallBelow<2>(model.grid, 0, 0) });
		StepReport          report;
		const StepSystem<2> system(before, model, {}, report);
		const auto          d      = nodal<2>(system.basis, model.grid, [](const Vec<2>& x) { return Vec<2>(-0.5 * x[0], 0.1); });
		const Vec<2>        passed = { 0.02 - 0.5 * 0.52 * 0.52 / 2, 0.6 }, beside = { 0.2, 0.6 };
		ASSERT_LT(passed[0], 0);
		PointCloud<2> after = before;
		after.position      = { passed, beside };
		keepBeforeWalls(after, before, system, d);
		EXPECT_NEAR(after.position[0][0], 0.01, 1e-12);
		EXPECT_EQ(after.position[0][1], passed[1]);
		EXPECT_EQ(after.position[1], beside);
	}

	TEST(Wall, TheLargestOverlapOfAllPointsAndAxesIsReported)
	{
		PointCloud<2> cloud;
		addPoint<2>(cloud, { 0.45, 0.45 }, { 0.5, 0.5 }); // 0.05 behind both
		addPoint<2>(cloud, { 0.45, 0.3 }, { 0.5, 0.5 });  // 0.2 behind y = 0
		addPoint<2>(cloud, { 0.4, 0.45 }, { 0.5, 0.5 });  // 0.1 behind x = 0
		const Boundary<2> corner({ wallBelow<2>(plane, 0, 0), wallBelow<2>(plane, 1, 0) });
		EXPECT_NEAR(cloudBasis<2>(cloud, plane, Basis::gimp, corner).largestWallOverlap, 0.2, 1e-15);
		EXPECT_EQ(cloudBasis<2>(cloud, plane, Basis::gimp, Boundary<2>()).largestWallOverlap, 0);
	}

	template <class Dimension> using WallReactions = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(WallReactions, BothDimensions, DimensionName);

	/// Soft soil on a rough base, along smooth walls, that a weight which acts obliquely shears away from one of
	/// them; and a point load.
	template <int Dim> void expectBalance(const Law& law)
	{
		Model<Dim> model;
		auto       cloud = block<Dim>(model.grid, Index<Dim>::Constant(2), 2);
		Vec<Dim>   base  = Vec<Dim>::Constant(infinity);
		base[1]          = 0;
		std::vector<ConstrainedBox<Dim>> boxes { wallBelow<Dim>(model.grid, 0, 0),
			                                 held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), base, Dim == 2 ? "xy" : "xyz") };
		if (Dim == 3) boxes.push_back(wallBelow<Dim>(model.grid, 2, 0));
		model.boundary         = Boundary<Dim>(boxes);
		model.materials        = { { law, 10 } };
		model.newton.tolerance = 1e-10;
		cloud.force.assign(cloud.size(), Vec<Dim>::Zero());
		cloud.force.back()[1] = -20;
		LinearSolver solver;
		Load<Dim>    load;
		load.gravity  = 14 * Vec<Dim>::Unit(0) - 16 * Vec<Dim>::Unit(1);
		load.duration = 0.25;
		StepReport report;
		for (int i = 1; i <= 4; ++i) {
			load.factor.value = i / 4.;
			report            = loadStep(cloud, model, load, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
			Vec<Dim> sum = load.factor.value * cloud.force.back();
			for (std::size_t p = 0; p < cloud.size(); ++p)
				sum += 10 * cloud.volume0[p] * load.factor.value * load.gravity;
			const double size = sum.norm();
			for (const Vec3& reaction : report.reactions)
				sum += reaction.template head<Dim>();
			EXPECT_LT(sum.norm(), 1e-9 * size);
		}
		EXPECT_GT(report.largestWallOverlap, 5e-4);
	}

	TYPED_TEST(WallReactions, BalanceTheLoadsThoughDomainsReachBehind) { expectBalance<TypeParam::value>(Hencky(1e3, 0.3)); }

	/// A law whose points are computed one by one, and whose stress depends on the duration of the step.
	TYPED_TEST(WallReactions, BalanceTheLoadsOfViscousSoil)
	{
		const InSpace<VonMises> plastic(VonMises(1e3, 0.3, 100), 0.3);
		expectBalance<TypeParam::value>(Relaxing<InSpace<VonMises>>(plastic, 0.5));
	}

	TEST(Wall, PointsAtItAndPointsAwayFromItShareTheNodesOnIt)
	{
		// the first point's window reaches behind the wall, the second one's does not
		PointCloud<2> cloud;
		addPoint<2>(cloud, { 0.2, 0.5 }, { 0.3, 0.3 });
		addPoint<2>(cloud, { 0.6, 0.5 }, { 0.3, 0.3 });
		const auto basis = cloudBasis<2>(cloud, plane, Basis::gimp, Boundary<2>({ wallBelow<2>(plane, 0, 0) }));
		EXPECT_EQ(basis.cells.size(), 1u);
		EXPECT_EQ(basis.nodes.size(), 4u);
		ASSERT_EQ(basis.patches.size(), 2u);
		const bool  inOrder = basis.patches[0].span == 1;
		const auto &clipped = basis.patches[inOrder ? 0 : 1], &whole = basis.patches[inOrder ? 1 : 0];
		EXPECT_EQ(Grid<2>::index(clipped.cell), Index<2>(-1, 0)); // three nodes along x
		EXPECT_EQ(clipped.node[0], -1);
		EXPECT_EQ(clipped.node[3], -1);
		EXPECT_EQ(clipped.node[1], whole.node[0]);
		EXPECT_EQ(clipped.node[5], whole.node[3]);
	}

} // namespace
} // namespace gimpm::testWalls
