// SPDX-License-Identifier: GPL-2.0-or-later
// Results do not depend on the place of the scene on the grid, on its mirror image, on the order of axes or on the
// order of bodies.
#include "scenes.hpp"
#include <algorithm>

namespace gimpm {
namespace {

	/// A step (an L turned upside down in 3D: one part higher than the other) of two materials on a rough floor,
	/// leaning on a wall.
	template <int Dim> struct LScene {
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		Load<Dim>       load;

		LScene()
		{
			model.grid.cellSize    = 0.5;
			model.materials        = { { VonMises(1e6, 0.3, 1.2e4), 2e3 }, { Hencky(1e6, 0.2), 2e3 } };
			model.newton.tolerance = 1e-12;
			load.gravity           = -10 * Vec<Dim>::Unit(1);
			const auto all         = block<Dim>(model.grid, cellsOf<Dim>(4, 4, 2), 2);
			for (std::size_t p = 0; p < all.size(); ++p) {
				const auto& x = all.position[p];
				if (x[1] < 1 || x[0] < 1) addPoint<Dim>(cloud, x, all.halfSize[p], x[0] < 0.5);
			}
			Vec<Dim> max = Vec<Dim>::Constant(infinity);
			max[1]       = 0;
			boxes        = { held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), max, Dim == 2 ? "xy" : "xyz"), wallBelow<Dim>(model.grid, 0, 0) };
		}
		std::vector<ConstrainedBox<Dim>> boxes;

		PointCloud<Dim> run()
		{
			model.boundary = Boundary<Dim>(boxes);
			LinearSolver solver;
			for (int i = 1; i <= 4; ++i) {
				load.factor.value = i / 4.;
				const auto report = loadStep(cloud, model, load, solver);
				EXPECT_TRUE(report.converged()) << report.cause;
			}
			return cloud;
		}
		void shift(const Index<Dim>& cells)
		{
			for (auto& x : cloud.position)
				x += model.grid.cellSize * cells.template cast<double>();
			for (auto& box : boxes)
				for (int a = 0; a < Dim; ++a) {
					if (box.lower[a] > -Grid<Dim>::indexLimit) box.lower[a] += cells[a];
					if (box.upper[a] < Grid<Dim>::indexLimit) box.upper[a] += cells[a];
				}
		}
		/// x[a] -> x[axis of a], along with everything else.
		void permute(const std::array<int, Dim>& to)
		{
			const auto vector = [&](const auto& v) {
				auto w = v;
				for (int a = 0; a < Dim; ++a)
					w[to[a]] = v[a];
				return w;
			};
			for (auto& x : cloud.position)
				x = vector(x);
			for (auto& box : boxes)
				box.lower = vector(box.lower), box.upper = vector(box.upper), box.fixed = vector(box.fixed);
			load.gravity = vector(load.gravity);
		}
		void mirror(int axis)
		{
			for (auto& x : cloud.position)
				x[axis] = -x[axis];
			for (auto& box : boxes) {
				const int lower = box.lower[axis];
				box.lower[axis] = -box.upper[axis];
				box.upper[axis] = -lower;
			}
			load.gravity[axis] *= -1;
		}
	};

	/// Compares two runs with map(position, tensor) applied to the first.
	template <int Dim, class MapVector, class MapTensor>
	void expectSame(const PointCloud<Dim>& a, const PointCloud<Dim>& b, MapVector&& vector, MapTensor&& tensor, double tolerance)
	{
		ASSERT_EQ(a.size(), b.size());
		double flow = 0;
		for (std::size_t p = 0; p < a.size(); ++p) {
			EXPECT_LT((vector(a.position[p]) - b.position[p]).norm(), tolerance) << "point " << p;
			EXPECT_LT((tensor(a.stress[p].full()) - b.stress[p].full()).norm(), 1e6 * tolerance) << "point " << p;
			EXPECT_NEAR(plasticStrains(a)[p], plasticStrains(b)[p], tolerance) << "point " << p;
			flow = std::max(flow, plasticStrains(a)[p]);
		}
		EXPECT_GT(flow, 1e-3) << "this should test plastic points as well";
	}

	template <class Dimension> using Invariance = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Invariance, BothDimensions, DimensionName);

	const auto same = [](const auto& x) { return x; };

	TYPED_TEST(Invariance, TranslationByWholeCells)
	{
		constexpr int Dim      = TypeParam::value;
		const auto    expected = LScene<Dim>().run();
		for (const auto& cells : { cellsOf<Dim>(7, 1, -5), cellsOf<Dim>(-1000, 3333, 77) }) {
			LScene<Dim> moved;
			moved.shift(cells);
			const Vec<Dim> by  = 0.5 * cells.template cast<double>();
			const auto     map = [&](const Vec<Dim>& x) { return Vec<Dim>(x + by); };
			expectSame<Dim>(expected, moved.run(), map, same, 1e-10);
		}
	}

	TYPED_TEST(Invariance, OriginOfTheGrid)
	{
		constexpr int  Dim      = TypeParam::value;
		const auto     expected = LScene<Dim>().run();
		LScene<Dim>    moved;
		const Vec<Dim> by = Random(1).matrix<Dim>(100);
		moved.model.grid.origin += by;
		for (auto& x : moved.cloud.position)
			x += by;
		const auto map = [&](const Vec<Dim>& x) { return Vec<Dim>(x + by); };
		expectSame<Dim>(expected, moved.run(), map, same, 1e-10);
	}

	TYPED_TEST(Invariance, MirrorImages)
	{
		constexpr int Dim      = TypeParam::value;
		const auto    expected = LScene<Dim>().run();
		for (int axis = 0; axis < Dim; ++axis) {
			LScene<Dim> mirrored;
			mirrored.mirror(axis);
			Mat3 M        = Mat3::Identity();
			M(axis, axis) = -1;
			expectSame<Dim>(
			        expected, mirrored.run(), [&](const Vec<Dim>& x) { return Vec<Dim>(M.topLeftCorner<Dim, Dim>() * x); },
			        [&](const Mat3& s) { return Mat3(M * s * M); }, 1e-10);
		}
	}

	TYPED_TEST(Invariance, OrderOfAxes)
	{
		constexpr int        Dim      = TypeParam::value;
		const auto           expected = LScene<Dim>().run();
		std::array<int, Dim> to;
		for (int a = 0; a < Dim; ++a)
			to[a] = a;
		while (std::next_permutation(to.begin(), to.end())) {
			LScene<Dim> permuted;
			permuted.permute(to);
			Mat3 P = Mat3::Zero();
			for (int a = 0; a < 3; ++a)
				P(a < Dim ? to[a] : a, a) = 1;
			expectSame<Dim>(
			        expected, permuted.run(), [&](const Vec<Dim>& x) { return Vec<Dim>(P.topLeftCorner<Dim, Dim>() * x); },
			        [&](const Mat3& s) { return Mat3(P * s * P.transpose()); }, 1e-10);
		}
	}

	TYPED_TEST(Invariance, OrderOfBodies)
	{
		constexpr int   Dim      = TypeParam::value;
		const auto      expected = LScene<Dim>().run();
		LScene<Dim>     reversed;
		PointCloud<Dim> cloud;
		for (int p = int(reversed.cloud.size()) - 1; p >= 0; --p)
			addPoint<Dim>(cloud, reversed.cloud.position[p], reversed.cloud.halfSize[p], reversed.cloud.material[p]);
		reversed.cloud = cloud;
		auto result    = reversed.run();
		std::reverse(result.position.begin(), result.position.end());
		std::reverse(result.stress.begin(), result.stress.end());
		for (auto& column : result.internals)
			std::reverse(column.begin(), column.end());
		expectSame<Dim>(expected, result, same, same, 1e-10);
	}

	TYPED_TEST(Invariance, OrderOfBoundaries)
	{
		constexpr int Dim      = TypeParam::value;
		const auto    expected = LScene<Dim>().run();
		LScene<Dim>   reversed;
		std::reverse(reversed.boxes.begin(), reversed.boxes.end());
		const auto result = reversed.run();
		EXPECT_TRUE(result.position == expected.position);
	}

} // namespace
} // namespace gimpm
