// SPDX-License-Identifier: GPL-2.0-or-later
// Random small scenes, hostile ones among them: a load step ends, with a state that is finite and complete or with the
// old one.
#include "core/stepping/restraint.hpp"
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"
#include <Eigen/LU>
#include <cstdlib>
#include <cstring>

namespace gimpm::testRandomScenes {
namespace {

	constexpr int failures = int(Failure::interrupted) + 1; // kinds of them

	template <int Dim> struct RandomScene {
		Random          random;
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		Load<Dim>       load;

		explicit RandomScene(unsigned seed) : random(seed)
		{
			const double h = std::pow(10, random.in(-9, 9)), young = std::pow(10, random.in(-9, 9));
			model.grid                 = { h, h * random.matrix<Dim>(std::pow(10, random.in(0, 5))) };
			model.basis                = random.integer(0, 4) ? Basis::gimp : Basis::linear;
			model.ghost                = { random.integer(0, 2) ? std::pow(10, random.in(-8, 2)) : 0 };
			model.newton.tolerance     = std::pow(10, random.in(-12, -2));
			model.newton.maxIterations = random.integer(1, 20);
			model.materials.push_back({ Hencky(young, random.in(-0.99, 0.4999)), young / h });
			model.materials.push_back(
			        { VonMises(young * std::pow(10, random.in(-3, 3)), random.in(-0.5, 0.49), young * std::pow(10, random.in(-6, 0))), 0 });
			addPoints();
			addBoundaries();
			load.gravity       = random.matrix<Dim>(std::pow(10, random.in(-6, 1)));
			load.factor.growth = random.in(-1, 1);
		}
		/// A coordinate somewhere in the scene, at or next to a face, in cells.
		double coordinate()
		{
			const double near = random.integer(0, 4), offset = std::pow(10, random.in(-16, -1)) * (random.integer(0, 1) ? 1 : -1);
			const double at[] = { random.in(0, 4), near, near + offset };
			return at[random.integer(0, 2)];
		}
		void addPoints()
		{
			const double h = model.grid.cellSize;
			if (random.integer(0, 1)) {
				cloud = block<Dim>(model.grid, Index<Dim>::NullaryExpr([&]() { return random.integer(1, 4); }), random.integer(1, 3));
				const Vec<Dim> by = h * Vec<Dim>::NullaryExpr([&]() { return random.integer(0, 1) ? coordinate() : 0; });
				for (auto& x : cloud.position)
					x += by;
			} else
				for (int i = 0, count = random.integer(0, 40); i < count; ++i) {
					const Vec<Dim> l = h * Vec<Dim>::NullaryExpr([&]() {
						                   return random.integer(0, 3) ? random.in(0.05, 0.5) : 0.5 * std::pow(10, random.in(-12, 0));
					                   });
					addPoint<Dim>(cloud, model.grid.origin + h * Vec<Dim>::NullaryExpr([&]() { return coordinate(); }), l);
				}
			for (auto& m : cloud.material)
				m = random.integer(0, 1);
			if (random.integer(0, 1))
				cloud.force.assign(cloud.size(), random.matrix<Dim>(model.materials[0].young({}, 0) * std::pow(h, Dim - 1) * 1e-4));
		}
		void addBoundaries()
		{
			const double                     h = model.grid.cellSize;
			std::vector<ConstrainedBox<Dim>> boxes;
			for (int axis = 0; axis < Dim; ++axis) {
				if (random.integer(0, 5)) boxes.push_back(wallBelow<Dim>(model.grid, axis, model.grid.origin[axis] + h * random.integer(0, 2)));
				if (random.integer(0, 1)) boxes.push_back(wallAbove<Dim>(model.grid, axis, model.grid.origin[axis] + h * random.integer(2, 5)));
			}
			for (auto& box : boxes) {
				if (random.integer(0, 2) == 0) box.fixed.fill(true);
				if (random.integer(0, 4) == 0) box.displacement = h * random.matrix<Dim>(std::pow(10, random.in(-12, 0.5)));
			}
			model.boundary = Boundary<Dim>(boxes);
		}
	};

	template <class T> std::string bytes(const std::vector<T>& v) { return { reinterpret_cast<const char*>(v.data()), v.size() * sizeof(T) }; }

	template <int Dim> std::string bytes(const PointCloud<Dim>& c)
	{
		return bytes(c.position) + bytes(c.halfSize) + bytes(c.defGrad) + bytes(c.elasticStrain) + bytes(c.stress) + bytes(plasticStrains(c));
	}

	template <int Dim> void expectSound(const PointCloud<Dim>& c, const Grid<Dim>& grid)
	{
		for (std::size_t p = 0; p < c.size(); ++p) {
			ASSERT_TRUE(c.position[p].allFinite() && c.defGrad[p].allFinite() && c.stress[p].c.allFinite() && c.elasticStrain[p].c.allFinite());
			ASSERT_GT(c.defGrad[p].determinant(), 0);
			ASSERT_GT(c.halfSize[p].minCoeff(), 0);
			ASSERT_LE(c.halfSize[p].maxCoeff(), grid.cellSize / 2);
			ASSERT_LT((c.position[p] - grid.origin).cwiseAbs().maxCoeff(), grid.cellSize * Grid<Dim>::indexLimit);
			ASSERT_GE(plasticStrains(c)[p], 0);
		}
	}

	/// Norms of the out-of-balance forces, and of what they are compared with.
	template <int Dim> std::pair<double, double> balance(const StepSystem<Dim>& system, const Eigen::VectorXd& d)
	{
		Eigen::VectorXd force, residual, others = system.external;
		system.evaluate(d, force, nullptr);
		residual = system.external - force;
		for (int i = 0; i < int(system.dofs.number.size()); ++i)
			if (system.dofs.number[i] < 0) residual[i] = 0, others[i] = force[i];
		return { residual.stableNorm(), others.stableNorm() };
	}

	/// A step that says it has converged ends with displacements whose residual is small beside the forces there or
	/// at the start, or both are small beside what prescribed displacements cause by themselves, as in a rigid
	/// motion; or it is round-off.
	template <int Dim>
	void expectEquilibrium(const PointCloud<Dim>& before, const Model<Dim>& model, const Load<Dim>& load, const Eigen::VectorXd& d, int loosePoints)
	{
		StepReport      report;
		StepSystem<Dim> system(before, model, load, report);
		LoosePoints     loose = restraint(system.basis, model.grid, model.boundary, system.terms, *model.division).loose;
		if (loose.points != loosePoints) loose = hinged(system.basis, model.grid, model.boundary, system.terms, *model.division);
		ASSERT_EQ(loose.points, loosePoints);
		if (loosePoints > 0) system.fixNodes(loose.nodes); // same as in a step
		ASSERT_EQ(d.size(), system.nodalSize());
		const auto [residual, forces]  = balance(system, d);
		const auto [imbalance, loaded] = balance(system, Eigen::VectorXd(Eigen::VectorXd::Zero(d.size())));
		const double    h = model.grid.cellSize, tolerance = model.newton.tolerance * (1 + 1e-6);
		const double    strain = system.prescribed.template lpNorm<Eigen::Infinity>() / h;
		Eigen::VectorXd stiffness(before.size()), strains(before.size());
		for (int p = 0; p < int(before.size()); ++p) {
			stiffness[p] = system.points.volume0[p] * model.materials[system.points.material[p]].young(system.points.internals, p) / h;
			strains[p]   = system.points.leftCauchyGreen[p].c.norm() + strain;
		}
		const bool   isSmall  = residual <= tolerance * std::max({ forces, imbalance, loaded });
		const bool   isRigid  = std::max(residual, forces) <= tolerance * strain * stiffness.stableNorm();
		const double roundOff = 10 * precision * stiffness.cwiseProduct(strains).stableNorm();
		EXPECT_TRUE(isSmall || isRigid || residual <= roundOff)
		        << residual << " N beside " << forces << " N, at the start " << imbalance << " and " << loaded << " N";
	}

	/// Up to three load steps of a scene; counts how they ended.
	template <int Dim> void expectSoundSteps(unsigned seed, int (&ended)[failures])
	{
		SCOPED_TRACE("seed " + std::to_string(seed));
		RandomScene<Dim>   scene(seed);
		Random             choice(seed + 1);
		const bool         predicts = choice.integer(0, 1);
		LinearSolver       solver;
		LastIncrement<Dim> last;
		scene.model.newton.linearSolver     = LinearMethod(choice.integer(0, 2));
		scene.model.newton.lineSearchTrials = choice.integer(0, 5);
		for (int i = 1; i <= 3; ++i) {
			const auto before = scene.cloud;
			if (!predicts) last = {};
			const auto report = loadStep(scene.cloud, scene.model, scene.load, solver, &last);
			++ended[int(report.failure)];
			ASSERT_LE(report.iterations, scene.model.newton.maxIterations * (predicts ? 2 : 1));
			ASSERT_EQ(report.cause.empty(), report.converged());
			if (report.converged()) {
				ASSERT_LE(report.residual(), scene.model.newton.tolerance);
				expectEquilibrium(before, scene.model, scene.load, last.displacement, report.loosePoints);
			} else
				ASSERT_TRUE(bytes(scene.cloud) == bytes(before)) << report.cause;
			expectSound(scene.cloud, scene.model.grid);
			if (::testing::Test::HasFailure() || !report.converged()) return;
			scene.load.factor.value *= 1.3;
		}
	}

	template <class Dimension> using RandomScenes = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(RandomScenes, BothDimensions, DimensionName);

	TYPED_TEST(RandomScenes, EndInAFiniteStateOrInTheOldOne)
	{
		constexpr int Dim = TypeParam::value;
		// For longer searches: number of scenes and, after a comma, the first seed.
		const char* asked = std::getenv("RANDOM_SCENES");
		const char* comma = asked ? std::strchr(asked, ',') : nullptr;
		const int   count = asked ? std::atoi(asked) : Dim == 2 ? 400 : 60, first = comma ? std::atoi(comma + 1) : 0;
		int         ended[failures] = {};
		for (int seed = first; seed < first + count; ++seed)
			expectSoundSteps<Dim>(seed, ended);
		EXPECT_GT(ended[int(Failure::none)], count / 4) << "too few scenes are sane";
		EXPECT_GT(ended[int(Failure::unrestrained)], 0);
		if (asked)
			for (const int n : ended)
				std::printf("%d ", n);
	}

	// Found by longer searches.
	TEST(RandomScene, PointsThrownOffTheGridFailTheStep)
	{
		int ended[failures] = {};
		for (const unsigned seed : { 16216, 19862, 22081, 24801, 25178 })
			expectSoundSteps<2>(seed, ended);
		EXPECT_GE(ended[int(Failure::diverging)], 3);
	}

	TEST(RandomScene, PrescribedDisplacementsDoNotPassForceThatIsNotTheirs)
	{
		int ended[failures] = {};
		expectSoundSteps<2>(2130, ended);
		for (const unsigned seed : { 6463, 9920 })
			expectSoundSteps<3>(seed, ended);
	}

	TEST(RandomScene, FlattenedPointsHaveASize)
	{
		int ended[failures] = {};
		for (const unsigned seed : { 134106, 202938 })
			expectSoundSteps<3>(seed, ended);
	}

} // namespace
} // namespace gimpm::testRandomScenes
