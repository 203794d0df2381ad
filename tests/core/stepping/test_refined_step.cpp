// SPDX-License-Identifier: GPL-2.0-or-later
// Load steps on cells of several sizes.
#include "core/stepping/step_system.hpp"
#include "core/terms/points/centres.hpp"
#include "derivatives.hpp"
#include "refined.hpp"
#include <omp.h>

namespace gimpm::testRefinedStep {
namespace {

	template <int Dim> Model<Dim> model(const Grid<Dim>& grid)
	{
		Model<Dim> m;
		m.grid             = grid;
		m.materials        = { { Hencky(2.6e6, 0.3), 1 }, { VonMises(2.6e6, 0.3, 2e4), 1 } };
		m.newton.tolerance = 1e-12;
		return m;
	}

	/// Rollers on all sides of the block but the last one along y, which is pushed.
	template <int Dim> Boundary<Dim> pressed(const Grid<Dim>& grid, double displacement)
	{
		const Vec<Dim>                   size = cornerSize<Dim>().template cast<double>();
		std::vector<ConstrainedBox<Dim>> boxes;
		for (int a = 0; a < Dim; ++a) {
			boxes.push_back(wallBelow<Dim>(grid, a, 0));
			if (a != 1) boxes.push_back(wallAbove<Dim>(grid, a, size[a]));
		}
		boxes.push_back(wallAbove<Dim>(grid, 1, size[1]));
		boxes.back().displacement[1] = displacement;
		return Boundary<Dim>(boxes);
	}

	template <class Dimension> using RefinedStep = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(RefinedStep, BothDimensions, DimensionName);

	/// Patch test: nodes on the surface are moved linearly, and the stress of all points is that of the strain,
	/// elastic and plastic, with and without F-bar.
	TYPED_TEST(RefinedStep, AffineMotionOfTheSurfaceGivesUniformStress)
	{
		constexpr int Dim = TypeParam::value;
		Random        random(3);
		for (int i = 0; i < 4; ++i) {
			Model<Dim>     m = model<Dim>(cornerGrid<Dim>());
			const Mat<Dim> F = Mat<Dim>::Identity() + random.matrix<Dim, Dim>(0.02);
			m.fBar           = i >= 2;
			m.boundary = Boundary<Dim>(prescribedLeaves<Dim>(m.grid, cornerSize<Dim>(), [&](const Vec<Dim>& x) { return Vec<Dim>(F * x - x); }));
			auto       cloud  = refinedBlock<Dim>(m.grid, cornerSize<Dim>(), 2);
			const auto before = cloud;
			std::fill(cloud.material.begin(), cloud.material.end(), i % 2);
			LinearSolver solver;
			const auto   report = loadStep<Dim>(cloud, m, {}, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_EQ(report.parts, 1);
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				EXPECT_LT((cloud.position[p] - F * before.position[p]).norm(), 1e-12);
				EXPECT_LT((cloud.defGrad[p] - F).norm(), 1e-12);
				EXPECT_LT((cloud.stress[p].full() - cloud.stress[0].full()).norm(), 1e-5);
			}
			EXPECT_GT(cloud.stress[0].full().norm(), 1e3);
		}
	}

	/// K on the free degrees of freedom against the derivative of the folded forces there, of points of all sizes
	/// anywhere.
	TYPED_TEST(RefinedStep, TheTangentIsTheDerivativeOfTheForces)
	{
		constexpr int Dim = TypeParam::value;
		for (const int kind : { 0, 1, 2 }) { // plain, with F-bar, not symmetric
			Model<Dim> m = model<Dim>(refinedGrid<Dim>({ { Vec<Dim>::Constant(0.1), Vec<Dim>::Constant(0.2), 1 } }));
			m.fBar       = kind == 1;
			if (kind == 2) m.materials[1].law = DruckerPrager(2.6e6, 0.3, DruckerPragerCone::planeStrain(2e4, 0.5, 0));
			m.ghost    = { 0.1 };
			m.boundary = Boundary<Dim>({ wallBelow<Dim>(m.grid, 0, 0) });
			Random          random(4);
			PointCloud<Dim> cloud;
			for (int i = 0; i < (Dim == 2 ? 60 : 25); ++i)
				addPoint<Dim>(
				        cloud, random.matrix<Dim>() + Vec<Dim>::Ones(), Vec<Dim>::NullaryExpr([&]() { return random.in(0.05, 0.5); }), i % 2);
			StepReport            report;
			const StepSystem<Dim> system(cloud, m, {}, report);
			EXPECT_GT(report.ghostFaces, 5);
			EXPECT_EQ(system.isSymmetric(), kind != 2);
			ASSERT_GT(system.basis.affineConstraints.node.size(), 5u);
			const auto all = [&](const Eigen::VectorXd& x) {
				Eigen::VectorXd d = Eigen::VectorXd::Zero(system.nodalSize());
				for (int i = 0; i < d.size(); ++i)
					if (system.dofs.number[i] >= 0) d[i] = x[system.dofs.number[i]];
				system.basis.affineConstraints.template distribute<Dim>(d);
				return d;
			};
			const auto forces = [&](const Eigen::VectorXd& x) {
				Eigen::VectorXd f, reduced(system.dofs.count);
				EXPECT_FALSE(system.evaluate(all(x), f, nullptr));
				for (int i = 0; i < f.size(); ++i)
					if (system.dofs.number[i] >= 0) reduced[system.dofs.number[i]] = f[i];
				return reduced;
			};
			const Eigen::VectorXd x = random.vector(system.dofs.count, 0.02);
			NodeMatrix<Dim>       K;
			Eigen::VectorXd       f;
			system.prepare(K);
			ASSERT_FALSE(system.evaluate(all(x), f, &K));
			EXPECT_LT(relativeError(dense(reduced(K, system.dofs)), derivative(forces, x, 1e-5)), 1e-7);
		}
	}

	/// Block that yields around its small cells.
	template <int Dim> struct Pressed {
		PointCloud<Dim> cloud;
		StepReport      report;

		explicit Pressed(int threads, bool fBar = false)
		{
			omp_set_num_threads(threads);
			Model<Dim> m = model<Dim>(cornerGrid<Dim>());
			m.fBar       = fBar;
			m.boundary   = pressed<Dim>(m.grid, -0.05);
			cloud        = refinedBlock<Dim>(m.grid, cornerSize<Dim>(), 2);
			for (std::size_t p = 0; p < cloud.size(); ++p)
				cloud.material[p] = cloud.position[p].norm() < 2;
			LinearSolver       solver;
			LastIncrement<Dim> last;
			for (int step = 1; step <= 2; ++step)
				report = loadStep<Dim>(cloud, m, { Vec<Dim>::Zero(), { step / 2., 0.5 } }, solver, &last);
			omp_set_num_threads(1);
		}
	};

	TYPED_TEST(RefinedStep, AFewIterationsSufficeWhereItYields)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool fBar : { false, true }) {
			const Pressed<Dim> scene(1, fBar);
			ASSERT_TRUE(scene.report.converged()) << scene.report.cause;
			EXPECT_TRUE(scene.report.predicted);
			EXPECT_LT(scene.report.iterations, 8);
			const auto plastic = plasticStrains(scene.cloud);
			EXPECT_GT(*std::max_element(plastic.begin(), plastic.end()), 1e-3);
		}
	}

	TYPED_TEST(RefinedStep, TheNumberOfThreadsChangesNoBit)
	{
		constexpr int      Dim = TypeParam::value;
		const Pressed<Dim> one(1), two(2);
		for (std::size_t p = 0; p < one.cloud.size(); ++p) {
			EXPECT_EQ(one.cloud.position[p], two.cloud.position[p]);
			EXPECT_EQ(one.cloud.stress[p].c, two.cloud.stress[p].c);
		}
	}

	/// Reactions balance the weight, and the whole moves by what it is pushed.
	TYPED_TEST(RefinedStep, ReactionsBalanceTheWeight)
	{
		constexpr int  Dim     = TypeParam::value;
		Model<Dim>     m       = model<Dim>(cornerGrid<Dim>());
		const Vec<Dim> size    = cornerSize<Dim>().template cast<double>();
		m.materials[0].density = 2000;
		std::vector<ConstrainedBox<Dim>> boxes;
		for (int a = 0; a < Dim; ++a)
			boxes.push_back(wallBelow<Dim>(m.grid, a, 0));
		m.boundary         = Boundary<Dim>(boxes);
		auto         cloud = refinedBlock<Dim>(m.grid, cornerSize<Dim>(), 2);
		LinearSolver solver;
		const auto   report = loadStep<Dim>(cloud, m, { -10 * Vec<Dim>::Unit(1), { 1, 1 } }, solver);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_NEAR(report.reactions[1][1] / (size.prod() * 2e4), 1, 1e-10);
		EXPECT_NEAR(report.reactions[0][0] / (size.prod() * 2e4), 0, 1e-10);
	}

	/// The stiffness of a block that overlaps the next cells by a little. Some cells are small: none, all, those
	/// that are cut or the others.
	enum class Small { none, all, cut, others };
	template <int Dim> double condition(double overlap, Small small, double factor)
	{
		const double edge = small == Small::none ? 100 : small == Small::all ? -100 : 2;
		Vec<Dim>     low = Vec<Dim>::Constant(-infinity), high = Vec<Dim>::Constant(infinity);
		(small == Small::others ? high : low)[0] = edge;
		Model<Dim> m                             = model<Dim>(refinedGrid<Dim>({ { low, high, 1 } }));
		m.materials                              = { { Hencky(1, 0), 1 } };
		m.ghost                                  = { factor };
		std::vector<ConstrainedBox<Dim>> boxes;
		for (int a = 0; a < Dim; ++a)
			boxes.push_back(wallBelow<Dim>(m.grid, a, 0));
		m.boundary = Boundary<Dim>(boxes);
		auto cloud = refinedBlock<Dim>(m.grid, cellsOf<Dim>(2, 2, 1), 2);
		for (auto& x : cloud.position)
			x[0] += overlap;
		return conditionNumber(tangentStiffness(cloud, m));
	}

	TYPED_TEST(RefinedStep, ConditionIsBoundedHoweverSmallTheOverlapOfLargeAndSmallCells)
	{
		constexpr int Dim   = TypeParam::value;
		const double  equal = std::max(condition<Dim>(1e-5, Small::none, 1e-2), condition<Dim>(1e-5, Small::all, 1e-2));
		for (const Small small : { Small::cut, Small::others }) {
			const double bound = condition<Dim>(1e-5, small, 1e-2);
			EXPECT_LT(bound, 2 * equal);
			for (const double overlap : { 1e-6, 1e-7 })
				EXPECT_NEAR(condition<Dim>(overlap, small, 1e-2) / bound, 1, 1e-3);
			EXPECT_GT(condition<Dim>(1e-5, small, 0), 100 * equal) << "without the stabilisation";
		}
	}

	/// A box between the lines of large cells.
	TYPED_TEST(RefinedStep, ABoxThatHoldsOnlyHangingNodesIsRefused)
	{
		constexpr int Dim   = TypeParam::value;
		Model<Dim>    m     = model<Dim>(cornerGrid<Dim>());
		auto          cloud = refinedBlock<Dim>(m.grid, cornerSize<Dim>(), 2);
		// On the face of a cell that has been halved once.
		const Vec<Dim> hanging = Vec<Dim>::Unit(0) + 0.25 * Vec<Dim>::Unit(1);
		m.boundary             = Boundary<Dim>({ wallBelow<Dim>(m.grid, 0, 0), held<Dim>(m.grid, hanging, hanging, "x") });
		LinearSolver solver;
		const auto   report = loadStep<Dim>(cloud, m, {}, solver);
		EXPECT_EQ(report.failure, Failure::misplaced);
		EXPECT_NE(report.cause.find("boundaries[1] lies between the nodes"), std::string::npos) << report.cause;
	}

	/// Ghost faces between leaves of one size and of two: their forces vanish for linear fields, and not for
	/// others.
	TYPED_TEST(RefinedStep, GhostForcesOfLinearFieldsVanish)
	{
		constexpr int         Dim   = TypeParam::value;
		Model<Dim>            m     = model<Dim>(cornerGrid<Dim>());
		const auto            cloud = refinedBlock<Dim>(m.grid, cornerSize<Dim>(), 2);
		StepReport            report;
		const StepSystem<Dim> system(cloud, m, {}, report);
		int                   levels[3] = {}, between = 0;
		for (const auto& face : system.faces) {
			++levels[face.level()];
			const auto [lower, upper] = cellsAt(face, system.basis, m.grid);
			between += Grid<Dim>::level(system.basis.populatedLeaves()[lower]) != Grid<Dim>::level(system.basis.populatedLeaves()[upper]);
		}
		EXPECT_GT(levels[0], 4);
		EXPECT_GT(levels[1], 4);
		EXPECT_GT(levels[2], 4);
		EXPECT_GT(between, 4);
		Random          random(1);
		const Mat<Dim>  A = random.matrix<Dim, Dim>();
		const auto      d = nodal<Dim>(system.basis, m.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(A * x); });
		Eigen::VectorXd f = Eigen::VectorXd::Zero(d.size()), other = f;
		addGhostForce<Dim>(system.faces, m.grid.cellSize, d, f);
		addGhostForce<Dim>(system.faces, m.grid.cellSize, d.cwiseAbs2(), other);
		EXPECT_LT(f.norm(), 1e-12 * other.norm());
	}

} // namespace
} // namespace gimpm::testRefinedStep
