// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/mohr_coulomb.hpp"
#include "core/solvers/condition.hpp"
#include "moving.hpp"

namespace gimpm::testLoosePoints {
namespace {

	template <class T> using LoosePoints = InBothDimensions<T>;
	TYPED_TEST_SUITE(LoosePoints, BothDimensions, DimensionName);

	/// A row of points, a quarter of a cell in half size, along a direction from x on.
	template <int Dim> PointCloud<Dim> row(int count, const Vec<Dim>& step, const Vec<Dim>& from = Vec<Dim>::Constant(10.3))
	{
		PointCloud<Dim> cloud;
		for (int i = 0; i < count; ++i)
			addPoint<Dim>(cloud, from + i * step, Vec<Dim>::Constant(0.25));
		return cloud;
	}
	template <int Dim> Vec<Dim> along() { return 0.5 * Vec<Dim>::Unit(0); }

	template <int Dim> Vec<Dim> middle(const PointCloud<Dim>& cloud)
	{
		return std::accumulate(cloud.position.begin(), cloud.position.end(), Vec<Dim>(Vec<Dim>::Zero())) / cloud.size();
	}

	template <int Dim> struct Mass {
		Grid<Dim>                   grid;
		CloudBasis<Dim>             basis;
		std::vector<GhostFace<Dim>> faces;
		std::vector<double>         masses;

		explicit Mass(const PointCloud<Dim>& cloud) : basis(cloudBasis(cloud, grid, Basis::gimp, Boundary<Dim>())), masses(cloud.size(), 1)
		{
			faces                        = ghostFaces<Dim>(basis.cells, boundaryCells<Dim>(basis.cells, Boundary<Dim>()), Boundary<Dim>());
			const PointStiffness density = [&](int) { return VolumeAndModulus { cloud.volume0[0], 1 / cloud.volume0[0] }; };
			weighGhostFaces(faces, basis, density, grid, 1e-3, GhostScaling::paper);
		}
		std::vector<LooseCell<Dim>> loose() const { return looseCells(basis, masses, faces, grid); }
		MassMatrix<Dim>             matrix(double share = usualLooseShare) const { return { basis, masses, faces, 1, loose(), share }; }
		double                      condition(double share) const
		{
			FreeDofs dofs;
			for (dofs.count = 0; dofs.count < int(Dim * basis.nodes.size()); ++dofs.count)
				dofs.number.push_back(dofs.count);
			return conditionNumber(LinearProblem(matrix(share).reduced(dofs, 0)));
		}
	};

	TYPED_TEST(LoosePoints, BodiesHaveNoLooseCellsButFarFromTheirEdge)
	{
		constexpr int   Dim = TypeParam::value;
		const Grid<Dim> grid;
		const auto      body = block<Dim>(grid, Index<Dim>::Constant(3), 2);
		for (const double cut : { 0., 1e-6, 0.3, 0.7 })
			EXPECT_TRUE(Mass<Dim>(shifted<Dim>(body, Vec<Dim>::Constant(cut))).loose().empty()) << cut;
		for (const auto& [tail, loose] : { std::pair(4, 0), { 12, 6 - Dim } }) { // two points in a cell
			auto cloud = body;
			for (int i = 0; i < tail; ++i)
				addPoint<Dim>(cloud, Vec<Dim>(Vec<Dim>::Constant(0.3) + (2.95 + 0.5 * i) * Vec<Dim>::Unit(0)), Vec<Dim>::Constant(0.25));
			EXPECT_EQ(Mass<Dim>(cloud).loose().size(), loose);
		}
	}

	/// However they lie in their cells. It is singular without the share.
	TYPED_TEST(LoosePoints, ConditionOfTheirMassIsBounded)
	{
		constexpr int Dim = TypeParam::value;
		for (const int count : { 1, 2, 3, 6 })
			for (const double place : { 0.25 + 1e-7, 0.3, 0.5, 0.75, 0.999 })
				for (const double slope : { 0., 0.1 }) {
					const Mass<Dim> mass(row<Dim>(count, along<Dim>() + slope * Vec<Dim>::Unit(1), Vec<Dim>::Constant(place)));
					EXPECT_LT(mass.condition(usualLooseShare), Dim == 2 ? 1e9 : 1e10) << count << " from " << place;
					EXPECT_GT(mass.condition(0), 1e13);
				}
	}

	TYPED_TEST(LoosePoints, TheirMassIsThatOfThePointsForUniformVelocities)
	{
		constexpr int         Dim = TypeParam::value;
		const Mass<Dim>       mass(row<Dim>(3, along<Dim>()));
		const Eigen::VectorXd ones = Eigen::VectorXd::Ones(Dim * mass.basis.nodes.size());
		EXPECT_GT((mass.matrix(1) * Random().vector(ones.size()) - mass.matrix(0) * Random().vector(ones.size())).norm(), 0.01);
		EXPECT_LT((mass.matrix(1) * ones - mass.matrix(0) * ones).norm(), 1e-14);
	}

	TYPED_TEST(LoosePoints, FallExactly)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& scheme : { TimeScheme(), TimeScheme::generalisedAlpha(0.8), TimeScheme::midpoint() })
			for (const int count : { 1, 2, 3 }) {
				Moving<Dim> body(1, Hencky(1e6, 0.3), 2000, scheme);
				body.gravity[1] = -10;
				body.put(row<Dim>(count, along<Dim>()), [](const Vec<Dim>&) { return Vec<Dim>(3 * Vec<Dim>::Unit(0)); });
				const auto from = body.cloud.position;
				ASSERT_TRUE(body.steps(10, 0.07)); // through the grid
				const Vec<Dim> moved = 3 * 0.7 * Vec<Dim>::Unit(0) - 10 * 0.49 / 2 * Vec<Dim>::Unit(1),
				               v     = 3 * Vec<Dim>::Unit(0) - 7 * Vec<Dim>::Unit(1);
				for (int p = 0; p < count; ++p) {
					EXPECT_LT((body.motion->velocity[p] - v).norm(), 1e-11 * v.norm());
					EXPECT_LT((body.cloud.position[p] - from[p] - moved).norm(), 1e-11 * moved.norm());
				}
			}
	}

	/// One that flies, and one whose neighbours tell the velocities of their nodes.
	TYPED_TEST(LoosePoints, AreCounted)
	{
		constexpr int Dim = TypeParam::value;
		for (const int count : { 0, 1, 2 }) {
			Moving<Dim> body(1, Hencky(1e6, 0.3), 2000);
			auto        cloud = block<Dim>(body.model.grid, Index<Dim>::Constant(2), 2);
			for (int i = 0; i < count; ++i)
				addPoint<Dim>(cloud, Vec<Dim>::Constant(10.3 + 5 * i), Vec<Dim>::Constant(0.25));
			body.put(std::move(cloud), [](const Vec<Dim>&) { return Vec<Dim>(Vec<Dim>::Zero()); });
			ASSERT_TRUE(body.steps(1, 0.01));
			EXPECT_EQ(body.motion->loosePoints, count);
		}
	}

	/// Sand that hardly sticks falls on held nodes, bounces along them and lies there: without the inertia of its
	/// extent Newton's method goes round, as nothing tells what the point does not see of its nodes.
	TYPED_TEST(LoosePoints, SandComesToRestAlone)
	{
		constexpr int    Dim     = TypeParam::value;
		constexpr double density = 1600, young = 8e6, cohesion = 16;
		Moving<Dim>      body(0.1, MohrCoulomb(young, 0.3, cohesion, 0.644, 0), density);
		auto             ground = wallBelow<Dim>(body.model.grid, 1, 0);
		for (int axis = 0; axis < Dim; ++axis)
			ground.fixed[axis] = true;
		body.model.boundary         = Boundary<Dim>({ ground });
		body.model.newton.tolerance = 1e-6;
		body.gravity[1]             = -10;
		PointCloud<Dim> cloud;
		addPoint<Dim>(cloud, 0.1 * (2 * Vec<Dim>::Unit(0) + Vec<Dim>::Constant(0.35)), Vec<Dim>::Constant(0.025));
		body.put(std::move(cloud), [](const Vec<Dim>&) { return Vec<Dim>(0.4 * Vec<Dim>::Unit(0)); });
		int    most = 0;
		double last = 1;
		for (int i = 0; i < 60; ++i) {
			const auto report = body.step(0.0067);
			ASSERT_TRUE(report.converged()) << "step " << i << ": " << report.cause;
			most = std::max(most, report.iterations);
			last = body.motion->velocity[0].norm();
		}
		EXPECT_LE(most, 12);
		EXPECT_LT(last, 0.4);
		EXPECT_GT(body.cloud.position[0][1], 0);
	}

	/// A row that turns by 1 rad/s as it flies: 3.4e-6 of the angular momentum of four points in two cells are lost
	/// in a step with Newmark's rule. Where soil may flow, the inertia of its extent takes more.
	TYPED_TEST(LoosePoints, ARowSpins)
	{
		constexpr int Dim  = TypeParam::value;
		const Law     clay = MohrCoulomb::tresca(1e6, 0.3, 1e5);
		for (const auto& [scheme, law] :
		     { std::pair(TimeScheme(), Law(Hencky(1e6, 0.3))), { TimeScheme::midpoint(), Law(Hencky(1e6, 0.3)) }, { TimeScheme(), clay } }) {
			Moving<Dim>    body(1, law, 1000, scheme);
			const bool     isElastic = law->isElastic;
			const auto     cloud     = row<Dim>(4, along<Dim>());
			const Vec<Dim> centre = middle(cloud), drift = 3 * Vec<Dim>::Unit(0);
			body.put(cloud, [&](const Vec<Dim>& x) {
				return Vec<Dim>(drift - (x - centre)[1] * Vec<Dim>::Unit(0) + (x - centre)[0] * Vec<Dim>::Unit(1));
			});
			const double spin = body.angularMomentum() + centre[1] * 3 * body.mass(), energy = body.energy();
			ASSERT_TRUE(body.steps(60, 0.003));
			EXPECT_LT((body.momentum() / body.mass() - drift).norm(), 1e-12);
			EXPECT_NEAR((body.angularMomentum() + middle(body.cloud)[1] * 3 * body.mass()) / spin, 1, isElastic ? 4e-4 : 1e-2);
			EXPECT_NEAR(body.energy() / energy, 1, isElastic ? 1e-4 : 2e-3);
			EXPECT_NEAR((body.cloud.position[3] - body.cloud.position[0]).norm(), 1.5, 2e-3);
			EXPECT_NEAR(std::asin((body.cloud.position[3] - body.cloud.position[0])[1] / 1.5), 0.18, 1e-3);
		}
	}

} // namespace
} // namespace gimpm::testLoosePoints
