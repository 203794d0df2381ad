// SPDX-License-Identifier: GPL-2.0-or-later
// Work of the ghost stabilisation in a static step, and points that nothing restrains.
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"

namespace gimpm::testGhostShare {
namespace {

	/// A block of 3 x 3 cells on a rough floor, free at its sides, which its weight loads.
	struct Block {
		Model<2>         model;
		PointCloud<2>    cloud;
		LinearSolver     solver;
		LastIncrement<2> last;

		explicit Block(const Law& law)
		{
			model.grid.cellSize = 1;
			model.materials     = { { law, 2e3 } };
			model.boundary      = Boundary<2>({ held<2>(model.grid, { -infinity, -infinity }, { infinity, 0 }, "xy") });
			cloud               = block<2>(model.grid, { 3, 3 }, 2);
		}
		Load<2> load(double from, double to) const
		{
			Load<2> load;
			load.gravity = { 0, -10 };
			load.factor  = { to, to - from };
			return load;
		}
		StepReport step(double from, double to) { return loadStep(cloud, model, load(from, to), solver, &last); }
	};
	const Law elastic = Hencky(1e7, 0.3), sand = MohrCoulomb(1e7, 0.3, 10, 0.5, 0), stiffSand = MohrCoulomb(1e9, 0.3, 10, 0.5, 0);

	TEST(GhostShare, IsThatOfTheWork)
	{
		Block      scene(sand);
		const auto begin  = scene.cloud;
		const auto load   = scene.load(0, 1);
		const auto report = scene.step(0, 1);
		ASSERT_TRUE(report.converged());
		// Sums by hand: at free nodes stress and stabilisation bear the weight, constrained ones do not move.
		const auto& grid  = scene.model.grid;
		const auto  basis = cloudBasis<2>(begin, grid, Basis::gimp, scene.model.boundary);
		auto        faces = ghostFaces<2>(basis.cells, boundaryCells<2>(basis.cells, scene.model.boundary), scene.model.boundary);
		weighGhostFaces<2>(
		        faces, basis,
		        [&](int p) {
			        return VolumeAndModulus { begin.volume0[p], 1e7 };
		        },
		        grid, 1e-2, GhostScaling::meshIndependent);
		ASSERT_EQ(basis.nodes, scene.last.nodes);
		const Eigen::VectorXd& d      = scene.last.displacement;
		Eigen::VectorXd        weight = Eigen::VectorXd::Zero(d.size()), ghost = weight;
		addPointForces(basis, pointForces(begin, scene.model, load), weight);
		addGhostForce<2>(faces, 1, d, ghost);
		const double byGhost = std::abs(d.dot(ghost)), byPoints = (ghost.array() != 0).select(d.cwiseProduct(weight - ghost), 0).lpNorm<1>();
		EXPECT_GT(byGhost, 0);
		EXPECT_NEAR(report.ghostShare, byGhost / (byGhost + byPoints), 1e-5 * report.ghostShare);
	}

	TEST(GhostShare, IsNoneWithoutStabilisation)
	{
		Block scene(elastic);
		scene.model.ghost.factor = 0;
		EXPECT_EQ(scene.step(0, 1).ghostShare, 0);
	}

	/// A block of sand without cohesion cannot stand. Stiff sand seems to, in steps as few; where the stabilisation
	/// may not carry much, no step is made.
	TEST(GhostShare, TellsWhatOnlyTheStabilisationHolds)
	{
		Block scene(stiffSand), strict(stiffSand);
		for (int step = 0; step < 4; ++step) {
			const auto report = scene.step(step / 4., (step + 1) / 4.);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_GT(report.ghostShare, 0.05);
		}
		EXPECT_LT(3 - scene.cloud.position.back()[1], 0.35) << "it has hardly moved";

		const auto before                = strict.cloud.position;
		strict.model.ghost.workTolerance = 0.03;
		const auto report                = strict.step(0, 0.25);
		EXPECT_EQ(report.failure, Failure::stabilised);
		EXPECT_NE(report.cause.find("workTolerance = 0.03"), std::string::npos) << report.cause;
		EXPECT_EQ(strict.cloud.position, before);
	}

	TEST(GhostShare, IsNothingWhereItsForcesAreSmall)
	{
		Block scene(elastic);
		EXPECT_EQ(scene.step(0, 1).ghostShare, 0);
		EXPECT_EQ(scene.step(1, 1).ghostShare, 0) << "hardly anything moves";
	}

	/// Soft sand comes to rest as a heap.
	TEST(GhostShare, StopsAtTheTolerance)
	{
		Block free(sand), scene(sand);
		scene.model.ghost.workTolerance = 0.05;
		const auto before = free.step(0, 1), report = scene.step(0, 1);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_GT(before.ghostShare, 0.05);
		EXPECT_EQ(before.passes, 0);
		EXPECT_GT(report.passes, 0);
		EXPECT_LE(report.ghostShare, 0.05);
		EXPECT_LT(scene.cloud.position.back()[1], free.cloud.position.back()[1]) << "it has gone on";
	}

	/// A point that has come off stays where it is, and the rest is as without it.
	TEST(LoosePoints, AreHeldWhereTheyAre)
	{
		Block alone(elastic), beside(elastic);
		addPoint<2>(beside.cloud, { 7.3, 5.2 }, { 0.25, 0.25 });
		const auto one = alone.step(0, 1), other = beside.step(0, 1);
		ASSERT_TRUE(other.converged()) << other.cause;
		EXPECT_EQ(one.loosePoints, 0);
		EXPECT_EQ(other.loosePoints, 1);
		EXPECT_EQ(other.parts, 2);
		EXPECT_EQ(beside.cloud.position.back(), Vec<2>(7.3, 5.2));
		for (std::size_t p = 0; p < alone.cloud.size(); ++p)
			EXPECT_LT((alone.cloud.position[p] - beside.cloud.position[p]).norm(), 1e-9) << p;
	}

	/// Block that is connected by a corner of a cell turns about it freely, so that no equilibrium tells where
	/// it goes. It is constrained, and that force, with the floor's, bears the weight of all. The rest feels it by
	/// that one node.
	TEST(LoosePoints, HangByACorner)
	{
		Block alone(elastic), scene(elastic);
		addPoint<2>(scene.cloud, { 3.5, 3.5 }, { 0.25, 0.25 });
		const auto report = scene.step(0, 1);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_EQ(report.parts, 1);
		EXPECT_EQ(report.loosePoints, 1);
		EXPECT_EQ(report.loosePosition, "(3.5, 3.5)");
		const double weight = (9 + 0.25) * 2e3 * 10;
		EXPECT_NEAR(report.reactions[0][1] + report.looseForce[1], weight, 1e-6 * weight);
		EXPECT_GT(report.looseForce[1], 0.75 * 0.25 * 2e3 * 10) << "what of its weight is at nodes that only it moves";
		ASSERT_TRUE(alone.step(0, 1).converged());
		EXPECT_LT((alone.cloud.position[0] - scene.cloud.position[0]).norm(), 1e-4) << "far from the corner";
	}

	/// Stabilisation holds a block that is connected by a face of a cell.
	TEST(LoosePoints, AreNotThoseBesideAFace)
	{
		Block scene(elastic);
		addPoint<2>(scene.cloud, { 3.5, 2.5 }, { 0.25, 0.25 });
		const auto report = scene.step(0, 1);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_EQ(report.loosePoints, 0);
		EXPECT_EQ(report.looseForce, Vec3(0, 0, 0));
	}

	TEST(LoosePoints, AreNoBodies)
	{
		Block beside(elastic);
		for (const double x : { 7.25, 7.75 })
			for (const double y : { 5.25, 5.75 })
				addPoint<2>(beside.cloud, { x, y }, { 0.25, 0.25 });
		EXPECT_EQ(beside.step(0, 1).failure, Failure::unrestrained);
		Block few(elastic);
		few.cloud = {};
		addPoint<2>(few.cloud, { 7.3, 5.2 }, { 0.25, 0.25 });
		EXPECT_EQ(few.step(0, 1).failure, Failure::unrestrained) << "the whole of the body";
	}

} // namespace
} // namespace gimpm::testGhostShare
