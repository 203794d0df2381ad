// SPDX-License-Identifier: GPL-2.0-or-later
// Walls off the lines of the grid: tangent, history, and bodies that they hold.
#include "core/stepping/restraint.hpp"
#include "core/stepping/step_system.hpp"
#include "derivatives.hpp"
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
		PointCloud<Dim>  cloud;
		const Index<Dim> count = cellsOf<Dim>(int(std::lround(width / spacing)), int(std::lround(height / spacing)), int(std::lround(width / spacing)));
		forIndices<Dim>(Index<Dim>::Zero(), count, [&](const Index<Dim>& i) {
			Vec<Dim> x           = spacing * (i.template cast<double>() + Vec<Dim>::Constant(0.5));
			x.template head<2>() = planeRotation(angle) * x.template head<2>().eval();
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
			auto                boxes                       = model.boundary.boxes();
			ConstrainedBox<Dim> nothing;
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

	template <class T> using WallOf = InBothDimensions<T>;
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
			auto&                 term = *system.terms.back();
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

	TYPED_TEST(WallOf, ForcesAsTheStepBegins)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene;
		Wall<Dim>&    wall = scene.add(flat<Dim>({ 0.2, -0.3 }, { 1.7, 1.1 }), "xy");
		Random        random;
		for (auto& traction : wall.tractions)
			traction = random.matrix<Dim>();
		StepReport     report;
		const auto     at    = [&] { return resultantBefore(StepSystem<Dim>(scene.cloud, scene.model, {}, report)); };
		const Vec<Dim> still = at();
		EXPECT_GT(still.norm(), 1e-3);
		wall.motion.setConstant(0.01);
		EXPECT_LT((at() - still).norm(), 1e-14);
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

	/// A column on rollers under its own weight, all turned by an angle against the grid: how well it is balanced,
	/// and the stresses of its points along its axis.
	template <int Dim> class Column {
	public:
		static constexpr double width = 1, height = 4, spacing = Dim == 2 ? 0.125 : 0.25, weight = 2e4;

		explicit Column(double angle) : down(planeRotation(angle) * Vec<2>(0, -1)), angle_(angle)
		{
			scene.model.grid.cellSize = 2 * spacing;
			scene.cloud               = turnedBlock<Dim>(width, height, spacing, angle);
			scene.model.materials     = { { Hencky(1e6, 0), weight / 10 } };
			if (Dim == 3) scene.model.boundary = Boundary<Dim>({ wallBelow<Dim>(scene.model.grid, Dim - 1, 0) });
		}
		void rollers()
		{
			foot = &scene.add(flat<Dim>(turned(-1, 0), turned(width + 1, 0)));
			scene.add(flat<Dim>(turned(0, height + 1), turned(0, -1)));
			scene.add(flat<Dim>(turned(width, -1), turned(width, height + 1)));
		}
		/// The same where the grid has nodes.
		void boxes()
		{
			auto walls = scene.model.boundary.boxes();
			walls.push_back(wallBelow<Dim>(scene.model.grid, 1, 0));
			walls.push_back(wallBelow<Dim>(scene.model.grid, 0, 0));
			walls.push_back(wallAbove<Dim>(scene.model.grid, 0, width));
			scene.model.boundary = Boundary<Dim>(walls);
		}
		void load(int steps)
		{
			Vec<Dim> gravity           = Vec<Dim>::Zero();
			gravity.template head<2>() = 10 * down;
			for (int i = 0; i < steps; ++i) {
				const auto report = scene.step(double(i) / steps, (i + 1.) / steps, gravity);
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_LT(report.iterations, 6);
				Vec3 sum = Vec3::Zero();
				for (const Vec3& reaction : report.reactions)
					sum += reaction;
				EXPECT_NEAR(-sum.head<2>().dot(down) / total() * steps / (i + 1), 1, 1e-7);
			}
		}
		double total() const { return weight * height * (Dim == 2 ? width : width * width); }
		/// Mean error of the stress along the column over the largest one; exact is the weight above.
		double error(const std::vector<Vec<Dim>>& original) const
		{
			double sum = 0;
			for (std::size_t p = 0; p < original.size(); ++p) {
				const double above = height + original[p].template head<2>().dot(down);
				sum += std::abs(down.dot(scene.cloud.stress[p].inPlane().template topLeftCorner<2, 2>() * down) + weight * above);
			}
			return sum / (double(original.size()) * weight * height);
		}

		Scene<Dim>       scene;
		const Wall<Dim>* foot = nullptr;
		Vec<2>           down;

	private:
		Vec<2> turned(double x, double y) const { return planeRotation(angle_) * Vec<2>(x, y); }
		double angle_;
	};

	TYPED_TEST(WallOf, ObliqueColumnIsAsTheAlignedOne)
	{
		constexpr int Dim = TypeParam::value;
		Column<Dim>   aligned(0), oblique(0.35);
		const auto    atFirst = aligned.scene.cloud.position, obliqueAtFirst = oblique.scene.cloud.position;
		aligned.boxes();
		oblique.rollers();
		aligned.load(4);
		oblique.load(4);
		EXPECT_NEAR(-oblique.foot->reaction.template head<2>().dot(oblique.down) / oblique.total(), 1, 5e-3);
		EXPECT_LT(oblique.error(obliqueAtFirst), Dim == 2 ? 1e-2 : 2e-2) << "16 cells in the plane, 8 in 3D, where the aligned one has 2.2e-2";
		EXPECT_LT(oblique.error(obliqueAtFirst), aligned.error(atFirst) + 5e-3) << "which is the grid's own error";
	}

	/// Confined by walls, nu = 0; the lid goes down: E ln(l) / l. Each step is forgotten by none of the later ones.
	TYPED_TEST(WallOf, PushesAndRemembers)
	{
		constexpr int Dim = TypeParam::value;
		for (const int steps : { 2, 8 }) {
			Scene<Dim>                       scene;
			std::vector<ConstrainedBox<Dim>> boxes;
			for (int a = 0; a < Dim; ++a) {
				boxes.push_back(wallBelow<Dim>(scene.model.grid, a, 0));
				if (a != 1) boxes.push_back(wallAbove<Dim>(scene.model.grid, a, 1.5));
			}
			scene.model.boundary = Boundary<Dim>(boxes);
			Wall<Dim>& lid       = scene.add(flat<Dim>({ 3, 1.5 }, { -1, 1.5 }));
			lid.penalty          = 1e4;
			for (int i = 0; i < steps; ++i) {
				lid.motion[1]     = -0.15 / steps;
				const auto report = scene.step();
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_NEAR(report.reactions[boxes.size()][1], lid.reaction[1], 0);
				// Reaction is as exact as the forces of the penalty at first.
				EXPECT_NEAR(report.reactions[2][1] / -lid.reaction[1], 1, 1e-7);
			}
			EXPECT_NEAR(lid.surface.vertices[0][1], 1.35, 1e-12);
			const double area = std::pow(1.5, Dim - 1), exact = 1e6 * std::log(0.9) / 0.9;
			EXPECT_NEAR(lid.reaction[1] / area / exact, 1, 2e-3);
			for (const auto& stress : scene.cloud.stress)
				EXPECT_NEAR(stress.inPlane()(1, 1) / exact, 1, 2e-3);
			const auto before = scene.cloud.position;
			lid.motion.setZero();
			EXPECT_TRUE(scene.step().converged());
			for (std::size_t p = 0; p < before.size(); ++p)
				EXPECT_LT((scene.cloud.position[p] - before[p]).norm(), 1e-6);
		}
	}

	TYPED_TEST(WallOf, WithoutMaterialHoldsNothingAndMayNotPush)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene;
		scene.model.boundary = Boundary<Dim>(
		        { wallBelow<Dim>(scene.model.grid, 0, 0.), wallBelow<Dim>(scene.model.grid, 1, 0.), wallBelow<Dim>(scene.model.grid, Dim - 1, 0.) });
		Wall<Dim>& wall = scene.add(flat<Dim>({ 3, 2.5 }, { -1, 2.5 }));
		std::fill(wall.tractions.begin(), wall.tractions.end(), Vec<Dim>::Constant(7.));
		EXPECT_TRUE(scene.step().converged());
		for (const auto& traction : wall.tractions)
			EXPECT_TRUE(traction.isZero(0));
		wall.motion[1]    = -0.1;
		const auto report = scene.step();
		EXPECT_EQ(report.failure, Failure::misplaced);
		EXPECT_EQ(report.cause, "a wall moves, but none of it is where the grid holds material");
		EXPECT_EQ(wall.surface.vertices[0][1], 2.5);
	}

	/// Rollers all around a circle let the body turn.
	TEST(Wall, RestrainsWhatItHolds)
	{
		const auto motionIn = [](const Surface<2>& surface, const std::string& fix) {
			Scene<2> scene;
			scene.add(surface, fix);
			return scene.step().cause;
		};
		std::vector<Vec<2>>            circle;
		std::vector<Surface<2>::Piece> pieces;
		for (int i = 0; i < 64; ++i) {
			circle.push_back(Vec<2>(0.75, 0.75) + planeRotation(2 * M_PI * i / 64) * Vec<2>(0.7, 0));
			pieces.push_back({ i, (i + 1) % 64 });
		}
		const auto around = surfaceOf<2>(circle, pieces);
		EXPECT_EQ(motionIn(around, "n").substr(0, 34), "nothing restrains the rotation of ");
		EXPECT_EQ(motionIn(around, "xy"), "");
		EXPECT_EQ(motionIn(flat<2>({ -1, 0.1 }, { 3, 0.1 }), "n").substr(0, 43), "nothing restrains the translation along x o");
		EXPECT_EQ(motionIn(flat<2>({ -1, 0.1 }, { 3, 0.1 }), "xy"), "");
	}

	/// A ring that is pushed apart by a wall around the axis bears the weight of its area.
	TEST(Wall, AroundAnAxisActsOnRings)
	{
		Scene<2> scene;
		scene.model.grid.axisymmetric = true;
		scene.cloud.hoopStretch.assign(scene.cloud.size(), 1);
		for (std::size_t p = 0; p < scene.cloud.size(); ++p)
			scene.cloud.volume0[p] *= 2 * M_PI * scene.cloud.position[p][0];
		Wall<2>& foot  = scene.add(flat<2>({ -0.4, 0.1 }, { 2, 0.1 }), "y");
		auto     boxes = scene.model.boundary.boxes();
		boxes.push_back(ConstrainedBox<2>::ofAxis(scene.model.grid));
		scene.model.boundary = Boundary<2>(boxes);
		ASSERT_TRUE(scene.step(0, 1, { 0, -10 }).converged());
		EXPECT_NEAR(foot.reaction[1] / (1e4 * M_PI * std::pow(1.5, 3)), 1, 1e-8);
	}

} // namespace
} // namespace gimpm::testWall
