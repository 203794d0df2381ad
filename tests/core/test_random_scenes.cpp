// SPDX-License-Identifier: GPL-2.0-or-later
// Random small scenes, hostile ones among them: a load step ends, with a state that is finite and complete or with the old one.
#include "scenes.hpp"
#include <cstdlib>
#include <cstring>

namespace gimpm {
namespace {

	template <int Dim> struct RandomScene {
		Random          random;
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		Load<Dim>       load;

		explicit RandomScene(unsigned seed)
		        : random(seed)
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
			load.gravity   = random.matrix<Dim>(std::pow(10, random.in(-6, 1)));
			load.increment = random.in(-1, 1);
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
				cloud.force.assign(cloud.size(), random.matrix<Dim>(model.materials[0].young() * std::pow(h, Dim - 1) * 1e-4));
		}
		void addBoundaries()
		{
			const double              h = model.grid.cellSize;
			std::vector<HeldBox<Dim>> boxes;
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
		return bytes(c.position) + bytes(c.halfSize) + bytes(c.defGrad) + bytes(c.elasticStrain) + bytes(c.stress) + bytes(c.plasticStrain);
	}

	template <int Dim> void expectSound(const PointCloud<Dim>& c, const Grid<Dim>& grid)
	{
		for (std::size_t p = 0; p < c.size(); ++p) {
			ASSERT_TRUE(c.position[p].allFinite() && c.defGrad[p].allFinite() && c.stress[p].c.allFinite() && c.elasticStrain[p].c.allFinite());
			ASSERT_GT(c.halfSize[p].minCoeff(), 0);
			ASSERT_LE(c.halfSize[p].maxCoeff(), grid.cellSize / 2);
			ASSERT_LT((c.position[p] - grid.origin).cwiseAbs().maxCoeff(), grid.cellSize * Grid<Dim>::indexLimit);
			ASSERT_GE(c.plasticStrain[p], 0);
		}
	}

	/// Up to three load steps of a scene; counts how they ended.
	template <int Dim> void expectSoundSteps(unsigned seed, int (&ended)[8])
	{
		SCOPED_TRACE("seed " + std::to_string(seed));
		RandomScene<Dim> scene(seed);
		LinearSolver     solver;
		for (int i = 1; i <= 3; ++i) {
			const auto before = bytes(scene.cloud);
			const auto report = loadStep(scene.cloud, scene.model, scene.load, solver);
			++ended[int(report.failure)];
			ASSERT_LE(report.iterations, scene.model.newton.maxIterations);
			ASSERT_EQ(report.cause.empty(), report.converged());
			if (report.converged()) {
				ASSERT_LE(report.residual(), scene.model.newton.tolerance);
			} else
				ASSERT_TRUE(bytes(scene.cloud) == before) << report.cause;
			expectSound(scene.cloud, scene.model.grid);
			if (::testing::Test::HasFatalFailure() || !report.converged()) return;
			scene.load.factor *= 1.3;
		}
	}

	template <class Dimension> class RandomScenes : public ::testing::Test {
	};
	TYPED_TEST_SUITE(RandomScenes, BothDimensions, DimensionName);

	TYPED_TEST(RandomScenes, EndInAFiniteStateOrInTheOldOne)
	{
		constexpr int Dim      = TypeParam::value;
		const char*   asked    = std::getenv("RANDOM_SCENES"); // for longer searches
		const int     count    = asked ? std::atoi(asked) : Dim == 2 ? 400 : 60;
		int           ended[8] = {};
		for (int seed = 0; seed < count && !this->HasFatalFailure(); ++seed)
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
		int ended[8] = {};
		for (const unsigned seed : { 16216, 19862, 22081, 24801, 25178 })
			expectSoundSteps<2>(seed, ended);
		EXPECT_GE(ended[int(Failure::diverging)], 3);
	}

} // namespace
} // namespace gimpm
