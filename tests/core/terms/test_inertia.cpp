// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/step_system.hpp"
#include "derivatives.hpp"
#include "moving.hpp"
#include <omp.h>

namespace gimpm::testInertia {
namespace {

	template <class T> using InertiaTerm = InBothDimensions<T>;
	TYPED_TEST_SUITE(InertiaTerm, BothDimensions, DimensionName);

	/// A block of 3 cells along each axis, moved off the lines of the grid so that it fills the part `cut` of cells
	/// on two sides.
	template <int Dim> PointCloud<Dim> cutBlock(const Grid<Dim>& grid, double cut)
	{
		return shifted<Dim>(block<Dim>(grid, Index<Dim>::Constant(3), 2), Vec<Dim>::Constant(cut * grid.cellSize));
	}

	template <int Dim> struct Mass {
		CloudBasis<Dim>             basis;
		std::vector<GhostFace<Dim>> faces;
		std::vector<double>         masses;

		Mass(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, double ghost, double density = 2000)
		        : basis(cloudBasis(cloud, grid, Basis::gimp, Boundary<Dim>()))
		{
			faces = ghostFaces<Dim>(basis.cells, boundaryCells<Dim>(basis.cells, Boundary<Dim>()), Boundary<Dim>());
			for (const double volume : cloud.volume0)
				masses.push_back(density * volume);
			const PointStiffness densityOf = [&](int p) { return VolumeAndModulus { cloud.volume0[p], density }; };
			weighGhostFaces(faces, basis, densityOf, grid, ghost, GhostScaling::paper);
		}
		MassMatrix<Dim> matrix(double h) const { return { basis, masses, faces, h }; }
		MassMatrix<Dim> ofGhost(double h) const { return { basis, std::vector<double>(masses.size(), 0), faces, h }; }
		FreeDofs        allFree() const
		{
			FreeDofs dofs;
			for (dofs.count = 0; dofs.count < int(Dim * basis.nodes.size()); ++dofs.count)
				dofs.number.push_back(dofs.count);
			return dofs;
		}
	};

	TYPED_TEST(InertiaTerm, MassIsThatOfThePointsAndGhostMassNeedsAnOtherThanLinearVelocity)
	{
		constexpr int Dim = TypeParam::value;
		Grid<Dim>     grid;
		grid.cellSize               = 0.5;
		const auto            cloud = cutBlock<Dim>(grid, 0.3);
		const Mass<Dim>       mass(cloud, grid, 0.25);
		const Eigen::VectorXd ones  = nodal(mass.basis, grid, [](const Vec<Dim>&) { return Vec<Dim>(Vec<Dim>::Ones()); });
		const double          total = std::accumulate(mass.masses.begin(), mass.masses.end(), 0.);
		EXPECT_NEAR(ones.dot(mass.matrix(0.5) * ones) / (Dim * total), 1, 1e-14);

		const Mat<Dim>        slope  = Random().matrix<Dim, Dim>();
		const Eigen::VectorXd linear = nodal(mass.basis, grid, [&](const Vec<Dim>& x) { return Vec<Dim>(slope * x); });
		const auto            ghost  = mass.ofGhost(0.5);
		const double          size   = ghost.absoluteTimes(linear).maxCoeff();
		EXPECT_GT(size, 0);
		EXPECT_LT((ghost * ones).template lpNorm<Eigen::Infinity>(), 4 * precision * ghost.absoluteTimes(ones).maxCoeff());
		EXPECT_LT((ghost * linear).template lpNorm<Eigen::Infinity>(), 4 * precision * size);
		const Eigen::VectorXd square = linear.cwiseProduct(linear);
		EXPECT_GT(square.dot(ghost * square), 1e-3 * square.dot(mass.matrix(0.5) * square)) << "other fields have some";
	}

	/// Over more nodes than a block of the sweeps has, with other nodes held for each side, to round-off and with
	/// the same bits in two threads.
	TYPED_TEST(InertiaTerm, ConjugateGradientsSolveForSeveralSidesAtOnce)
	{
		constexpr int         Dim = TypeParam::value;
		const Grid<Dim>       grid;
		const Mass<Dim>       mass(shifted<Dim>(block<Dim>(grid, Index<Dim>::Constant(Dim == 2 ? 70 : 16), 2), Vec<Dim>::Constant(1e-6)), grid, 1e-3);
		const auto            matrix = mass.matrix(1);
		const FreeDofs        all    = mass.allFree();
		FreeDofs              some   = all;
		Random                random;
		const Eigen::VectorXd right = random.vector(all.count), smooth = matrix * (Eigen::VectorXd::Ones(all.count) + 0.1 * random.vector(all.count));
		for (int i = 0; i < all.count; i += 7)
			some.number[i] = -1;
		ASSERT_GT(matrix.nodes(), 4000);
		std::vector<Eigen::VectorXd> found;
		const int                    threads = omp_get_max_threads();
		for (const int count : { 1, 2 }) {
			omp_set_num_threads(count);
			NodalMass<Dim>  M(matrix);
			Eigen::VectorXd x = Eigen::VectorXd::Constant(all.count, 0.5), y = x, z = x;
			ASSERT_TRUE(M.solve({ { right, some, x }, { smooth, all, y }, { smooth, some, z } }));
			EXPECT_LT(M.iterations(), 50);
			if (count == 1) std::cout << M.iterations() << " iterations\n";
			for (const Eigen::VectorXd& each : { x, y, z })
				found.push_back(each);
		}
		omp_set_num_threads(threads);
		Eigen::VectorXd weight(all.count); // weight of momenta, m^-1/2
		matrix.forEntries([&](int a, int b, int, double m) {
			if (a == b) weight.segment<Dim>(Dim * a).setConstant(1 / std::sqrt(m));
		});
		EXPECT_LT((matrix * found[1] - smooth).norm(), 1e-12 * smooth.norm());
		for (const int side : { 0, 2 }) {
			Eigen::VectorXd error = matrix * found[side] - (side == 0 ? right : smooth), size = (error - matrix * found[side]).cwiseProduct(weight);
			for (int i = 0; i < all.count; ++i)
				if (some.number[i] < 0) {
					EXPECT_EQ(found[side][i], 0.5);
					error[i] = 0;
				}
			EXPECT_LT(error.cwiseProduct(weight).norm(), 1e-11 * size.norm());
		}
		for (int side = 0; side < 3; ++side)
			EXPECT_EQ(found[side], found[side + 3]);
		Eigen::VectorXd rough = Eigen::VectorXd::Zero(all.count);
		ASSERT_TRUE(NodalMass<Dim>(matrix).solve({ { smooth, all, rough } }, { 1e-6 }));
		const Eigen::VectorXd error = matrix * rough - smooth;
		EXPECT_GT(error.norm(), 1e-10 * smooth.norm());
		for (int axis = 0; axis < Dim; ++axis)
			EXPECT_LT(std::abs(error.reshaped(Dim, matrix.nodes()).row(axis).sum()), 1e-13 * smooth.sum()) << "momentum";
	}

	TYPED_TEST(InertiaTerm, ReducedMassIsSymmetricAndTheSameAsTheProduct)
	{
		constexpr int         Dim = TypeParam::value;
		const Grid<Dim>       grid;
		const Mass<Dim>       mass(cutBlock<Dim>(grid, 0.4), grid, 0.1);
		const auto            matrix = mass.matrix(1);
		const Eigen::VectorXd x = Random().vector(Dim * matrix.nodes()), y = matrix * x;
		const auto            reduced = matrix.reduced(mass.allFree(), 1);
		Eigen::VectorXd       along(matrix.nodes()), expected(matrix.nodes());
		for (int n = 0; n < matrix.nodes(); ++n)
			along[n] = x[Dim * n + 1], expected[n] = y[Dim * n + 1];
		EXPECT_LT((reduced * along - expected).norm(), 1e-13 * expected.norm());
	}

	/// However little of a cell is filled. Without ghost mass it grows with the inverse of the cut's square and
	/// more.
	TYPED_TEST(InertiaTerm, ConditionOfTheMassDoesNotDependOnTheCut)
	{
		constexpr int   Dim = TypeParam::value;
		const Grid<Dim> grid;
		const auto      condition = [&](double cut, double ghost) {
                        const Mass<Dim> mass(cutBlock<Dim>(grid, cut), grid, ghost);
                        return conditionNumber(LinearProblem(mass.matrix(1).reduced(mass.allFree(), 0)));
		};
		EXPECT_GT(condition(1e-4, 0), 1e9);
		for (const double ghost : { 1e-3, 0.25 }) {
			double least = infinity, most = 0;
			for (const double cut : { 1e-7, 1e-4, 0.01, 0.1, 0.3, 0.6, 0.9 }) {
				const double k = condition(cut, ghost);
				least = std::min(least, k), most = std::max(most, k);
			}
			EXPECT_LT(most, ghost < 0.1 ? 4e4 : 400);
		}
	}

	TYPED_TEST(InertiaTerm, StiffnessIsTheDerivativeOfTheForce)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& scheme : { TimeScheme::newmark(0.3025, 0.6), TimeScheme::generalisedAlpha(0.4), TimeScheme::midpoint() }) {
			Moving<Dim> body(1, Hencky(1e6, 0.3), 2000, scheme);
			body.gravity[1]       = -10;
			body.motion->duration = 0.01;
			Random random;
			body.put(cutBlock<Dim>(body.model.grid, 0.3), [&](const Vec<Dim>&) { return random.matrix<Dim>(); });
			StepReport            report;
			const StepSystem<Dim> system(body.cloud, body.model, { body.gravity, { 1, 0 } }, report);
			const Eigen::VectorXd d = random.vector(system.nodalSize(), 1e-2), e = random.vector(system.nodalSize(), 1);
			EXPECT_LT(tangentErrorAlong(system, d, e, 1e-6), 1e-7);
		}
	}

	TYPED_TEST(InertiaTerm, FreeFallIsExact)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& scheme : { TimeScheme(), TimeScheme::generalisedAlpha(0.8), TimeScheme::midpoint() }) {
			Moving<Dim> body(1, Hencky(1e6, 0.3), 2000, scheme);
			body.gravity[1] = -10;
			body.put(cutBlock<Dim>(body.model.grid, 0.3), [](const Vec<Dim>&) { return Vec<Dim>(3 * Vec<Dim>::Unit(0)); });
			const Vec<Dim> from = body.cloud.position[0];
			ASSERT_TRUE(body.steps(10, 0.07));
			Vec<Dim> moved = Vec<Dim>::Zero(), v = Vec<Dim>::Zero();
			moved[0] = 3 * 0.7, moved[1] = -10 * 0.49 / 2, v[0] = 3, v[1] = -7;
			for (std::size_t p = 0; p < body.cloud.size(); ++p) {
				EXPECT_LT((body.motion->velocity[p] - v).norm(), 1e-12 * v.norm());
				EXPECT_LT(body.cloud.stress[p].c.norm(), 1e-6) << "of 1e6 Pa";
			}
			EXPECT_LT((body.cloud.position[0] - from - moved).norm(), 1e-12 * moved.norm());
		}
	}

	TYPED_TEST(InertiaTerm, FreeBlockKeepsItsVelocityThroughTheGrid)
	{
		constexpr int Dim = TypeParam::value;
		Moving<Dim>   body(1, Hencky(1e6, 0.3), 2000);
		Vec<Dim>      v = Vec<Dim>::Constant(0.7);
		v[0]            = 5;
		body.put(cutBlock<Dim>(body.model.grid, 0), [&](const Vec<Dim>&) { return v; });
		ASSERT_TRUE(body.steps(25, 0.0131)); // 1.6 cells
		for (const auto& velocity : body.motion->velocity)
			EXPECT_LT((velocity - v).norm(), 1e-12 * v.norm());
	}

	/// A body that swings as it flies.
	TYPED_TEST(InertiaTerm, MomentumIsKeptToRoundOff)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& scheme : { TimeScheme(), TimeScheme::generalisedAlpha(0.8), TimeScheme::midpoint() }) {
			Moving<Dim> body(1, Hencky(1e6, 0.3), 2000, scheme);
			body.put(cutBlock<Dim>(body.model.grid, 0.2), [](const Vec<Dim>& x) { return Vec<Dim>(2 * Vec<Dim>::Unit(0) + 0.2 * x[1] * x); });
			const Vec<Dim> before = body.momentum();
			const double   energy = body.energy();
			ASSERT_TRUE(body.steps(20, 0.03));
			EXPECT_LT((body.momentum() - before).norm(), 1e-12 * before.norm());
			EXPECT_GT(body.elastic(), 1e-5 * energy) << "it swings";
		}
	}

	/// A body that turns by 1 rad/s about the origin.
	template <int Dim> Moving<Dim> turning(const TimeScheme& scheme, double centre)
	{
		Moving<Dim> body(1, Hencky(1e9, 0.3), 1000, scheme);
		body.put(shifted<Dim>(block<Dim>(body.model.grid, Index<Dim>::Constant(2), 2), Vec<Dim>::Constant(centre - 1)), [](const Vec<Dim>& x) {
			Vec<Dim> v = Vec<Dim>::Zero();
			v[0] = -x[1], v[1] = x[0];
			return v;
		});
		return body;
	}

	/// Trapezoidal rule: a stiff body loses (omega T)^2 / 2 of it in the first step, while it has no stress yet.
	/// Midpoint rule: nothing, but for what ghost mass takes from velocities that are not linear, when it swings.
	TYPED_TEST(InertiaTerm, AngularMomentumOfARigidSpin)
	{
		constexpr int Dim = TypeParam::value;
		for (const double angle : { 0.04, 0.02, 0.01 }) {
			auto         body   = turning<Dim>({}, 0);
			const double before = body.angularMomentum();
			ASSERT_TRUE(body.steps(1, angle));
			EXPECT_NEAR((1 - body.angularMomentum() / before) / (angle * angle / 2), 1, 0.02);
		}
		for (const auto& [steps, tolerance] : { std::pair(1, 1e-13), { 10, 1e-8 } }) {
			auto         body           = turning<Dim>(TimeScheme::midpoint(), 0.3);
			const double before         = body.angularMomentum();
			body.model.newton.tolerance = 1e-12;
			ASSERT_TRUE(body.steps(steps, 0.04));
			EXPECT_NEAR(body.angularMomentum() / before, 1, tolerance);
		}
	}

	TYPED_TEST(InertiaTerm, FirstPeriodOfABar)
	{
		constexpr int Dim = TypeParam::value;
		Bar<Dim>      bar(Dim == 2 ? 19.3 : 9.3);
		EXPECT_NEAR(bar.measuredPeriod(1, 1 / bar.wave) / bar.period(), 1, Dim == 2 ? 1e-3 : 4e-3) << "CFL 1";
	}

	TEST(Inertia, PeriodConvergesWithTheSquareOfTheStep)
	{
		const auto error = [](const TimeScheme& scheme, double cfl) {
			Bar<2> bar(12, scheme);
			return bar.measuredPeriod(1, cfl / bar.wave) / bar.period() - 1;
		};
		for (const auto& scheme : { TimeScheme(), TimeScheme::generalisedAlpha(0.8), TimeScheme::midpoint() }) {
			const double inSpace = error(scheme, 0.125), coarse = error(scheme, 4) - inSpace, fine = error(scheme, 2) - inSpace;
			EXPECT_NEAR(coarse / fine, 4, 0.5);
		}
	}

	TEST(Inertia, EnergyOfABarIsKept)
	{
		for (const auto& [scheme, kept] :
		     { std::pair(TimeScheme(), 0.9995), { TimeScheme::midpoint(), 0.9995 }, { TimeScheme::generalisedAlpha(0.8), 0.995 } }) {
			Bar<2>       bar(12.3, scheme);
			const double before = bar.energy();
			ASSERT_TRUE(bar.steps(int(10 * bar.period() * bar.wave), 1 / bar.wave));
			EXPECT_GT(bar.energy() / before, kept);
			EXPECT_LT(bar.energy() / before, 1 + 1e-4);
		}
	}

	/// A load that acts suddenly: the first step already is of second order.
	TEST(Inertia, BeginsWithTheAccelerationOfEquilibrium)
	{
		const auto velocity = [](const TimeScheme& scheme, int steps) {
			Bar<2> bar(8, scheme, 0);
			bar.gravity[0] = 1e-3;
			EXPECT_TRUE(bar.steps(steps, 16 / bar.wave / steps)); // half a period
			return bar.ofFirstMode();
		};
		for (const auto& scheme : { TimeScheme(), TimeScheme::generalisedAlpha(0.8) }) {
			const double exact = velocity(scheme, 256), coarse = velocity(scheme, 8) - exact, fine = velocity(scheme, 16) - exact;
			EXPECT_NEAR(coarse / fine, 4, 0.2);
		}
	}

	/// Inertia is nothing beside the rest in a step that takes forever.
	TYPED_TEST(InertiaTerm, LongStepsAreStatic)
	{
		constexpr int Dim = TypeParam::value;
		Column<Dim>   still(5), moving(5);
		const auto    motion = std::make_shared<Motion<Dim>>();
		motion->duration     = 1e9;
		motion->velocity.assign(still.cloud.size(), Vec<Dim>::Zero());
		motion->acceleration = motion->velocity;
		for (const double volume : still.cloud.volume0)
			motion->mass.push_back(80 * volume);
		motion->scheme       = TimeScheme::midpoint();
		moving.model.inertia = [motion](const StepContext<Dim>& step) { return std::make_unique<Inertia<Dim>>(*motion, step); };
		ASSERT_TRUE(still.step(1, 10).converged());
		const auto report = moving.step(1, 10);
		ASSERT_TRUE(report.converged()) << report.cause;
		for (std::size_t p = 0; p < still.cloud.size(); ++p)
			EXPECT_LT((still.cloud.position[p] - moving.cloud.position[p]).norm(), 1e-9);
	}

	/// Nodes that hardly any mass is near have no velocity to speak of without ghost mass.
	TEST(Inertia, CutCellsNeedGhostMass)
	{
		for (const double ghostMass : { 0., 1e-3 }) {
			Moving<3> body(1, Hencky(1e6, 0.3), 1000);
			body.motion->ghostMass = ghostMass;
			body.put(cutBlock<3>(body.model.grid, 1e-7), [](const Vec<3>&) { return Vec<3>(1, 0, 0); });
			EXPECT_EQ(body.step(0.01).converged(), ghostMass > 0);
		}
	}

	TEST(Inertia, AFailedStepChangesNothing)
	{
		Moving<2> body(1, Hencky(1e6, 0.3), 2000);
		body.put(block<2>(body.model.grid, { 3, 3 }, 2), [](const Vec<2>& x) { return Vec<2>(-4 * x); });
		body.model.newton.maxIterations = 1;
		body.model.newton.tolerance     = 1e-15;
		const auto velocity = body.motion->velocity, position = body.cloud.position;
		ASSERT_FALSE(body.step(0.1).converged());
		EXPECT_EQ(body.motion->velocity, velocity);
		EXPECT_EQ(body.cloud.position, position);
	}

	/// A body flies against held nodes, which keep it: reactions, here those of the middle of steps, are the whole
	/// change of its momentum, the first blow included.
	TYPED_TEST(InertiaTerm, ReactionsAreTheChangeOfMomentum)
	{
		constexpr int Dim = TypeParam::value;
		Moving<Dim>   body(1, Hencky(1e6, 0.3), 1000, TimeScheme::midpoint());
		Vec<Dim>      v = Vec<Dim>::Zero();
		v[0] = -3, v[1] = 0.5;
		body.put(cutBlock<Dim>(body.model.grid, 0.2), [&](const Vec<Dim>&) { return v; });
		body.model.boundary  = Boundary<Dim>({ wallBelow<Dim>(body.model.grid, 0, 0) });
		const double before  = body.momentum()[0];
		double       impulse = 0;
		for (int i = 0; i < 15; ++i) {
			const auto report = body.step(0.01);
			ASSERT_TRUE(report.converged()) << report.cause;
			impulse += 0.01 * report.reactions[0][0];
		}
		EXPECT_GT(impulse, -before) << "it has turned back";
		EXPECT_NEAR((body.momentum()[0] - before) / impulse, 1, 1e-9);
		EXPECT_NEAR(body.momentum()[1], 0.5 * body.mass(), 1e-9 * body.mass());
	}

	/// Points that come to held nodes with another velocity have theirs afterwards; with nodes that move at 1 m/s
	/// half of the mass is lost as energy, not its work.
	TYPED_TEST(InertiaTerm, HeldNodesTakeEnergyByTheirBlow)
	{
		constexpr int Dim = TypeParam::value;
		Moving<Dim>   body(1, Hencky(1e6, 0.3), 1000);
		body.put(cutBlock<Dim>(body.model.grid, 0), [&](const Vec<Dim>&) { return Vec<Dim>(2 * Vec<Dim>::Unit(0)); });
		body.motion->duration      = 0.01;
		auto everywhere            = held<Dim>(body.model.grid, Vec<Dim>::Constant(-infinity), Vec<Dim>::Constant(infinity), Dim == 2 ? "xy" : "xyz");
		everywhere.displacement[0] = 0.01;
		body.model.boundary        = Boundary<Dim>({ everywhere });
		ASSERT_TRUE(loadStep<Dim>(body.cloud, body.model, { body.gravity, { 1, 1 } }, body.solver).converged());
		EXPECT_NEAR(body.momentum()[0] / body.mass(), 1, 1e-12);
		EXPECT_NEAR(body.motion->impactWork / (0.5 * body.mass()), 1, 1e-10);
	}

	/// A block flies against a wall and back: what its nodes take is booked.
	TEST(Inertia, EnergyBalancesWhenABodyMeetsHeldNodes)
	{
		Moving<2> body(1, Hencky(1e6, 0.3), 1000, TimeScheme::midpoint());
		body.put(cutBlock<2>(body.model.grid, 0.2), [&](const Vec<2>&) { return Vec<2>(-3, 0); });
		body.model.boundary = Boundary<2>({ wallBelow<2>(body.model.grid, 0, 0) });
		const double before = body.energy();
		double       taken = 0, byBlow = 0;
		for (int i = 0; i < 60; ++i) {
			ASSERT_TRUE(body.step(0.0025).converged());
			taken += body.motion->ghostWork + body.motion->impactWork, byBlow += body.motion->impactWork;
		}
		EXPECT_GT(byBlow, 0.02 * before);
		EXPECT_NEAR((body.energy() + taken) / before, 1, 1e-3);
	}

	/// Body that a boundary carries along gets its speed, all of it.
	TEST(Inertia, ABoundaryThatStartsAtOnceCarriesTheBodyAlong)
	{
		Moving<2> body(1, Hencky(1e8, 0), 1000, TimeScheme::generalisedAlpha(0));
		body.put(block<2>(body.model.grid, { 3, 3 }, 2), [](const Vec<2>&) { return Vec<2>(0, 0); });
		body.model.boundary = Boundary<2>({ held<2>(body.model.grid, { -infinity, -infinity }, { 0, infinity }, "x", { 1, 0 }) });
		for (int i = 0; i < 40; ++i) {
			body.motion->duration = 0.01;
			ASSERT_TRUE(loadStep<2>(body.cloud, body.model, { { 0, 0 }, { 0.002 * (i + 1), 0.002 } }, body.solver).converged());
		}
		for (const auto& v : body.motion->velocity)
			EXPECT_NEAR(v[0], 0.2, 1e-3);
	}

	/// Reactions contain the inertia of what is held.
	TEST(Inertia, ReactionsOfAPrescribedMotionCarryTheAcceleratedMass)
	{
		Moving<2> body(1, Hencky(1e8, 0), 1000);
		body.put(block<2>(body.model.grid, { 4, 1 }, 2), [](const Vec<2>&) { return Vec<2>(2, 0); });
		body.model.boundary = Boundary<2>({ held<2>(body.model.grid, { -infinity, -infinity }, { infinity, infinity }, "y") });
		body.gravity        = { 3, 7 };
		const auto report   = body.step(0.01);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_NEAR(report.reactions[0][1] / (-7 * body.mass()), 1, 1e-10);
		EXPECT_NEAR(body.momentum()[0] / body.mass(), 2.03, 1e-12);
		EXPECT_NEAR(body.momentum()[1], 0, 1e-9);
	}

} // namespace
} // namespace gimpm::testInertia
