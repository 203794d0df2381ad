// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies of points that meet: stresses where they press, derivatives, and that layers change nothing by themselves.
#include "core/stepping/step_system.hpp"
#include "core/terms/bodies/body_contact.hpp"
#include "scenes.hpp"
#include <Eigen/Geometry>

namespace gimpm::testBodyContact {
namespace {

	template <int Dim> Surface<Dim> surfaceOf(const Vec<Dim>& low, const Vec<Dim>& high)
	{
		Surface<Dim> s;
		for (int c = 0; c < 1 << Dim; ++c) {
			Vec<Dim> x = low;
			for (int a = 0; a < Dim; ++a)
				if (c >> a & 1) x[a] = high[a];
			s.vertices.push_back(x);
		}
		if constexpr (Dim == 2) s.pieces = { { 0, 1 }, { 1, 3 }, { 3, 2 }, { 2, 0 } };
		else
			s.pieces = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
				     { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
		s.vertices0 = s.vertices;
		return s;
	}

	/// A block of points that fills a box in whole rows, all in one layer, and of one material.
	template <int Dim> void addBlock(PointCloud<Dim>& cloud, const Vec<Dim>& low, const Vec<Dim>& high, const Index<Dim>& points, int layer)
	{
		const Vec<Dim> half = (high - low).cwiseQuotient(points.template cast<double>()) / 2;
		forIndices<Dim>(Index<Dim>::Zero(), points, [&](const Index<Dim>& i) {
			addPoint<Dim>(cloud, low + half + 2 * half.cwiseProduct(i.template cast<double>()), half, layer);
			cloud.layer.push_back(layer);
		});
	}

	/// Two blocks on each other between smooth walls; the upper one is pressed down by its upper nodes.
	template <int Dim> struct Pressed {
		static constexpr double h = 0.25, width = 0.5, top = 1;

		Model<Dim>        model;
		PointCloud<Dim>   cloud;
		BodyContacts<Dim> contacts;

		Pressed(double face, double ratio, double stiffness, double friction = 0)
		{
			model.grid.cellSize    = h;
			model.materials        = { { Hencky(1e6, 0.3), 0 }, { Hencky(ratio * 1e6, 0.3), 0 } };
			model.newton.tolerance = 1e-11;
			model.layers           = { 0, 0, 1 };
			Vec<Dim> down          = Vec<Dim>::Zero();
			down[1]                = -0.02;
			std::vector<ConstrainedBox<Dim>> boxes;
			for (int a = 0; a < Dim; ++a) {
				boxes.push_back(wallBelow<Dim>(model.grid, a, 0));
				if (a != 1) boxes.push_back(wallAbove<Dim>(model.grid, a, width));
			}
			boxes.push_back(wallAbove<Dim>(model.grid, 1, top));
			boxes.back().displacement = down;
			model.boundary            = Boundary<Dim>(boxes);
			Vec<Dim>   low = Vec<Dim>::Zero(), high = Vec<Dim>::Constant(width);
			Index<Dim> points = Index<Dim>::Constant(4);
			for (int body = 0; body < 2; ++body) {
				low[1]    = body == 0 ? 0 : face;
				high[1]   = body == 0 ? face : top;
				points[1] = int(std::ceil((high[1] - low[1]) / (h / 2)));
				addBlock<Dim>(cloud, low, high, points, body);
				contacts.bodies.push_back({ body == 0 ? "lower" : "upper", body, surfaceOf<Dim>(low, high) });
				contacts.bodies.back().refine(h);
			}
			contacts.meetings.push_back({ 0, 1, friction, infinity, stiffness });
			model.coupledTerms = { [this](const StepContext<Dim>& step, const State& begin) {
				return std::make_unique<BodyContact<Dim>>(contacts, step, begin);
			} };
		}
		/// Without equilibrium: nodes go where they are told to. The force on the lower body.
		template <class F> Vec<Dim> go(F&& displacementOf)
		{
			StepReport            report;
			const StepSystem<Dim> system(cloud, model, {}, report);
			Eigen::VectorXd       d(system.nodalSize());
			for (std::size_t n = 0; n < system.basis.nodes.size(); ++n) {
				const Key key                = system.basis.nodes[n];
				d.segment<Dim>(Dim * int(n)) = displacementOf(model.grid.nodePosition(Grid<Dim>::index(key)), Grid<Dim>::layer(key));
			}
			system.commit(d);
			return contacts.meetings[0].force;
		}
		StepReport step(double part = 1)
		{
			LinearSolver solver;
			return loadStep<Dim>(cloud, model, { Vec<Dim>::Zero(), { part, part } }, solver);
		}
		double spread() const
		{
			double low = infinity, high = -infinity;
			for (const auto& stress : cloud.stress)
				low = std::min(low, stress.c[1]), high = std::max(high, stress.c[1]);
			return (high - low) / std::abs(low);
		}
	};

	template <class Dimension> using BodyContactTest = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(BodyContactTest, BothDimensions, DimensionName);
	template <class Dimension> using LayersTest = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(LayersTest, BothDimensions, DimensionName);

	TYPED_TEST(BodyContactTest, StressIsEvenWhereverTheFaceLies)
	{
		constexpr int Dim = TypeParam::value;
		for (const double cut : { 0., 0.5, 0.1, 1e-2 })
			for (const double ratio : { 1., 1000. }) {
				Pressed<Dim> pressed(0.5 + cut * Pressed<Dim>::h, ratio, 50);
				const auto   report = pressed.step();
				ASSERT_TRUE(report.converged()) << report.cause << ", cut " << cut << ", ratio " << ratio;
				EXPECT_LT(pressed.spread(), 1e-9) << "cut " << cut << ", ratio " << ratio;
				EXPECT_LT(pressed.cloud.stress[0].c[1], -1e4);
			}
	}

	/// Symmetry of the tangent before it is exact, and near it at sticking contact points, makes it worth while.
	TYPED_TEST(BodyContactTest, TheDerivativeIsThatOfTheForces)
	{
		constexpr int Dim = TypeParam::value;
		for (const double friction : { 0., 0.1, 5. }) {
			Pressed<Dim> pressed(0.6, 2, 50, friction);
			ASSERT_TRUE(pressed.step(0.5).converged());
			pressed.contacts.meetings[0].slipping = 0; // the first derivatives are exact with many of them
			StepReport            report;
			const StepSystem<Dim> system(pressed.cloud, pressed.model, {}, report);
			NodeMatrix<Dim>       K;
			Couplings             beside;
			const double          e = 1e-7;
			Random                random(2);
			const Eigen::VectorXd d = random.vector(system.map.size(), 1e-5);
			Eigen::VectorXd       force, plus, minus, way = random.vector(system.map.size());
			for (int i = 0; i < d.size(); ++i)
				if (system.dofs.number[i] < 0) way[i] = 0;
			const auto error = [&] {
				system.prepare(K, &beside);
				EXPECT_FALSE(system.evaluate(d, force, &K, nullptr, &beside));
				Eigen::VectorXd free(system.dofs.count), tangent(system.dofs.count);
				for (int i = 0; i < d.size(); ++i)
					if (const int n = system.dofs.number[i]; n >= 0) free[n] = way[i], tangent[n] = (plus[i] - minus[i]) / (2 * e);
				return (reduced(K, system.dofs, &beside) * free - tangent).norm() / tangent.norm();
			};
			ASSERT_FALSE(system.evaluate(d + e * way, plus, nullptr));
			ASSERT_FALSE(system.evaluate(d - e * way, minus, nullptr));
			EXPECT_TRUE(system.isSymmetric());
			EXPECT_LT(error(), friction == 0 ? 1e-6 : friction > 1 ? 1e-2 : 0.2) << "friction " << friction;
			EXPECT_EQ(system.makeExact(), friction > 0);
			EXPECT_EQ(system.isSymmetric(), friction == 0);
			EXPECT_LT(error(), 1e-6) << "friction " << friction;
			Eigen::VectorXd product = Eigen::VectorXd::Zero(d.size());
			beside.multiplyAdd(way, product);
			EXPECT_GT(product.norm(), 0.01 * (plus - minus).norm() / (2 * e)) << "contact is part of it";
		}
	}

	TYPED_TEST(BodyContactTest, ForcesHaveNoResultant)
	{
		constexpr int Dim = TypeParam::value;
		Pressed<Dim>  pressed(0.6, 2, 50, 0.3);
		ASSERT_TRUE(pressed.step(0.5).converged());
		StepReport            report;
		const StepSystem<Dim> system(pressed.cloud, pressed.model, {}, report);
		Random                random(3);
		const Eigen::VectorXd d     = random.vector(system.map.size(), 1e-3);
		Eigen::VectorXd       force = Eigen::VectorXd::Zero(d.size());
		pressed.contacts.acting->addUnweighted(&d, force);
		Vec<Dim> sum = Vec<Dim>::Zero();
		for (int i = 0; i < d.size(); ++i)
			sum[i % Dim] += force[i];
		EXPECT_GT(force.norm(), 100);
		EXPECT_LT(sum.norm(), 1e-12 * force.norm());
	}

	/// Both are pressed and sheared, and then turned as they are, once around. Without walls, behind which points
	/// do not reach, all surfaces go along. Where faces of the two end at the same place, small parts of them see
	/// an edge in some steps.
	TYPED_TEST(BodyContactTest, ForcesTurnWithTheBodies)
	{
		constexpr int Dim = TypeParam::value;
		Pressed<Dim>  pressed(0.6, 1, 10, 0.5);
		pressed.model.boundary = Boundary<Dim>();
		const Vec<Dim> first   = pressed.go([](const Vec<Dim>&, int layer) {
                        Vec<Dim> moved = Vec<Dim>::Zero();
                        if (layer == 1) moved[0] = 1e-3, moved[1] = -1e-3;
                        return moved;
                });
		EXPECT_GT(std::abs(first[0]), 0.2 * std::abs(first[1]));
		const int steps = Dim == 2 ? 90 : 24;
		Mat<Dim>  turn = Mat<Dim>::Identity(), all = turn;
		turn.template topLeftCorner<2, 2>() = Eigen::Rotation2Dd(2 * M_PI / steps).toRotationMatrix();
		for (int step = 0; step < steps; ++step) {
			const Vec<Dim> force = pressed.go([&](const Vec<Dim>& x, int) { return Vec<Dim>(turn * x - x); });
			for (auto& x : pressed.cloud.position)
				x = turn * x;
			all                 = turn * all;
			const Vec<Dim> then = all * first;
			ASSERT_GT(force.dot(then), std::cos(M_PI / 180) * force.norm() * then.norm()) << "step " << step;
			ASSERT_NEAR(force.norm(), first.norm(), 0.01 * first.norm()) << "step " << step;
		}
	}

	TYPED_TEST(LayersTest, TheyAloneChangeNothing)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    step = [](int layer) {
                        Model<Dim> model;
                        model.grid.cellSize = 0.5;
                        model.materials     = { { Hencky(1e6, 0.3), 2000 } };
                        Vec<Dim> top = Vec<Dim>::Constant(infinity), g = Vec<Dim>::Zero();
                        top[1] = 0, g[1] = -10;
                        model.boundary = Boundary<Dim>({ held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), top, std::string("xyz").substr(0, Dim)) });
                        auto cloud     = block<Dim>(model.grid, cellsOf<Dim>(6, 3, 2), 2);
                        if (layer >= 0) cloud.layer.assign(cloud.size(), layer);
                        LinearSolver solver;
                        EXPECT_TRUE(loadStep<Dim>(cloud, model, { g, { 1, 1 } }, solver).converged());
                        cloud.layer.clear();
                        return checksumOf(cloud);
		};
		EXPECT_EQ(step(-1), step(0));
		EXPECT_EQ(step(-1), step(1));
		EXPECT_EQ(step(-1), step(Grid<Dim>::mostLayer));
	}

	TEST(LayersOfKeysTest, KeysHaveALayerAboveTheLevel)
	{
		const auto test = [](auto dim) {
			constexpr int Dim = decltype(dim)::value;
			using G           = Grid<Dim>;
			for (const int layer : { 0, 1, G::mostLayer })
				for (int level = 0; level <= G::mostLevel; ++level)
					for (const int i : { -G::indexLimit, -8, 0, 16, G::indexLimit }) {
						const Key key = G::key(Index<Dim>::Constant(i), level, layer);
						EXPECT_EQ(G::layer(key), layer);
						EXPECT_EQ(G::level(key), level);
						EXPECT_EQ(G::index(key), Index<Dim>::Constant(i));
					}
		};
		test(std::integral_constant<int, 2>());
		test(std::integral_constant<int, 3>());
	}

} // namespace
} // namespace gimpm::testBodyContact
