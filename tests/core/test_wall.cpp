// SPDX-License-Identifier: GPL-2.0-or-later
// Walls off the lines of the grid: tangent, history, and bodies that they hold.
#include "core/stepping/restraint.hpp"
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"
#include <memory>

namespace gimpm::testWall {
namespace {

	template <int Dim> Surface<Dim> surfaceOf(const std::vector<Vec<Dim>>& vertices, std::vector<typename Surface<Dim>::Piece> pieces)
	{
		return { vertices, vertices, std::move(pieces) };
	}

	/// A flat wall from the first to the second point, in 3D along z from -1 to 3 too; the body is on its left.
	template <int Dim> Surface<Dim> flat(const Vec<2>& a, const Vec<2>& b)
	{
		if constexpr (Dim == 2) return surfaceOf<2>({ a, b }, { { 0, 1 } });
		else
			return surfaceOf<3>({ { a[0], a[1], -1 }, { a[0], a[1], 3 }, { b[0], b[1], 3 }, { b[0], b[1], -1 } }, { { 0, 1, 2 }, { 0, 2, 3 } });
	}

	/// Points of a regular pattern of its own, turned by an angle about the origin, in a rectangle (prism).
	template <int Dim> PointCloud<Dim> turnedBlock(double width, double height, double spacing, double angle)
	{
		PointCloud<Dim> cloud;
		const Index<Dim> count = cellsOf<Dim>(int(std::lround(width / spacing)), int(std::lround(height / spacing)), int(std::lround(width / spacing)));
		forIndices<Dim>(Index<Dim>::Zero(), count, [&](const Index<Dim>& i) {
			Vec<Dim> x              = spacing * (i.template cast<double>() + Vec<Dim>::Constant(0.5));
			x.template head<2>()    = planeRotation(angle) * x.template head<2>().eval();
			addPoint<Dim>(cloud, x, Vec<Dim>::Constant(spacing / 2));
		});
		return cloud;
	}

	template <int Dim> struct Scene {
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		LinearSolver    solver;

		explicit Scene(double nu = 0)
		{
			model.grid.cellSize    = 0.5;
			model.materials        = { { Hencky(1e6, nu), 1000 } };
			model.newton.tolerance = 1e-9;
			cloud                  = block<Dim>(model.grid, Index<Dim>::Constant(3), 2);
		}
		Wall<Dim>& add(const Surface<Dim>& surface, const std::string& fix = "n")
		{
			const auto wall = std::make_shared<Wall<Dim>>(surface, model.grid.cellSize);
			if (fix != "n")
				for (const char letter : fix)
					wall->fixed[letter - 'x'] = true;
			model.walls[int(model.boundary.boxes().size())] = wall;
			auto         boxes                              = model.boundary.boxes();
			HeldBox<Dim> nothing;
			nothing.lower.setOnes();
			nothing.upper.setZero();
			boxes.push_back(nothing);
			model.boundary = Boundary<Dim>(boxes);
			return *wall;
		}
		StepReport step(const Load<Dim>& load = {}) { return loadStep(cloud, model, load, solver); }
		/// Weight at this factor.
		StepReport step(double before, double after, const Vec<Dim>& gravity) { return step({ gravity, { after, after - before } }); }
	};

	template <class T> class WallOf : public ::testing::Test {
	};
	TYPED_TEST_SUITE(WallOf, BothDimensions, DimensionName);

	TYPED_TEST(WallOf, TangentIsTheDerivative)
	{
		constexpr int Dim = TypeParam::value;
		for (const std::string fix : { "n", "x", "xy" }) {
			Scene<Dim> scene;
			Wall<Dim>& wall = scene.add(flat<Dim>({ 0.2, -0.3 }, { 1.7, 1.1 }), fix);
			wall.motion.setConstant(0.01);
			StepReport            report;
			const StepSystem<Dim> system(scene.cloud, scene.model, {}, report);
			const auto&           term = *system.terms.back();
			const Eigen::VectorXd d    = Random(3).vector(system.nodalSize(), 0.05);
			NodeMatrix<Dim>       K;
			Eigen::VectorXd       f = Eigen::VectorXd::Zero(d.size()), zero = f;
			K.reset(system.basis.nodes, true, scene.model.grid);
			term.mark(K);
			term.add(d, { f, &K });
			term.add(Eigen::VectorXd::Zero(d.size()), { zero });
			const Eigen::MatrixXd full = dense(K);
			EXPECT_LT((full * d + zero - f).norm(), 1e-12 * f.norm()) << "it is linear";
			EXPECT_GT(full.norm(), 1e6);
			EXPECT_NEAR(system.fromOutside(d) / f.norm(), 1, 1e-14);
		}
	}

	/// A uniform strain with an undisturbed normal displacement at the wall: u = a (n . (x - x0)) n + b (t . x) t.
	TYPED_TEST(WallOf, WhatTheWallAdmitsCostsNoForce)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene;
		const Vec<2>  a(0.2, -0.3), b(1.7, 1.1), t = (b - a).normalized(), n(t[1], -t[0]);
		scene.add(flat<Dim>(a, b));
		StepReport            report;
		const StepSystem<Dim> system(scene.cloud, scene.model, {}, report);
		const Eigen::VectorXd d = nodal(system.basis, scene.model.grid, [&](const Vec<Dim>& x) {
			Vec<Dim>     u       = Vec<Dim>::Zero();
			const Vec<2> r       = x.template head<2>() - a;
			u.template head<2>() = 0.02 * n.dot(r) * n + 0.03 * t.dot(r) * t;
			return u;
		});
		EXPECT_LT(system.fromOutside(d), 1e-6);
		EXPECT_GT(system.fromOutside(Eigen::VectorXd::Constant(d.size(), 0.01)), 1e3);
	}

	/// A block between rollers that are turned with it, under its own weight along its axis: E (ln l) / l = sigma, and the wall at its foot bears the weight.
	TYPED_TEST(WallOf, ObliqueColumnIsAsTheAlignedOne)
	{
		constexpr int    Dim = TypeParam::value;
		constexpr double angle = 0.35, width = 1.2, height = 2.4, spacing = 0.2, weight = 1e5;
		Scene<Dim>       scene;
		scene.cloud             = turnedBlock<Dim>(width, height, spacing, angle);
		scene.model.materials   = { { Hencky(1e6, 0), weight / 10 } };
		const auto     turned   = [&](double x, double y) { return Vec<2>(planeRotation(angle) * Vec<2>(x, y)); };
		const Vec<2>   down     = turned(0, -1);
		Wall<Dim>&     foot     = scene.add(flat<Dim>(turned(-1, 0), turned(width + 1, 0)));
		scene.add(flat<Dim>(turned(0, height + 1), turned(0, -1)));
		scene.add(flat<Dim>(turned(width, -1), turned(width, height + 1)));
		Vec<Dim> gravity             = Vec<Dim>::Zero();
		gravity.template head<2>()   = 10 * down;
		if (Dim == 3) {
			auto boxes = scene.model.boundary.boxes();
			boxes.push_back(wallBelow<Dim>(scene.model.grid, Dim - 1, 0));
			scene.model.boundary = Boundary<Dim>(boxes);
		}
		const auto   original = scene.cloud.position;
		const double area = Dim == 2 ? width : width * width, steps = 4;
		for (int i = 0; i < steps; ++i) {
			const auto report = scene.step(i / steps, (i + 1) / steps, gravity);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_LT(report.iterations, 6);
			const Vec<Dim> sum = (report.reactions[0] + report.reactions[1] + report.reactions[2]).template head<Dim>();
			EXPECT_NEAR(-sum.template head<2>().dot(down) / (weight * height * area * (i + 1) / steps), 1, 1e-6);
		}
		EXPECT_NEAR(-foot.reaction.template head<2>().dot(down) / (weight * height * area), 1, 1e-2);
		double error = 0;
		for (std::size_t p = 0; p < scene.cloud.size(); ++p) {
			const double above = height + original[p].template head<2>().dot(down), stress = down.dot(scene.cloud.stress[p].inPlane().template topLeftCorner<2, 2>() * down);
			error += std::abs(stress + weight * above) / scene.cloud.size();
		}
		EXPECT_LT(error / (weight * height), Dim == 2 ? 1e-2 : 2e-2);
		std::cout << "error " << error / (weight * height) << "\n";
	}

} // namespace
} // namespace gimpm::testWall
