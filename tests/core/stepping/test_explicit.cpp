// SPDX-License-Identifier: GPL-2.0-or-later
// Central differences: closed forms, what is kept, and how long a step may be.
#include "core/stepping/critical_step.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/inertia/nodal_mass.hpp"
#include "moving.hpp"

namespace gimpm::testExplicit {
namespace {

	template <class T> using Explicit = InBothDimensions<T>;
	TYPED_TEST_SUITE(Explicit, BothDimensions, DimensionName);

	constexpr double lumped = 0, consistent = 0.25;

	/// Either mass; ghost stiffness only with ghost mass.
	template <int Dim> void setMass(Moving<Dim>& body, double ghostMass)
	{
		body.motion->ghostMass = ghostMass;
		if (ghostMass == 0) body.model.ghost.factor = 0;
	}

	template <int Dim> double critical(const Moving<Dim>& body) { return criticalStep(body.cloud, body.model, body.motion->ghostMass, 0); }

	/// A block of 3 cells along each axis that fills the part `cut` of cells on two sides.
	template <int Dim, class F> Moving<Dim> flying(double ghostMass, double cut, F&& velocity, double poisson = 0.3)
	{
		Moving<Dim> body(1, Hencky(1e6, poisson), 1000, TimeScheme::centralDifferences());
		setMass(body, ghostMass);
		body.put(shifted<Dim>(block<Dim>(body.model.grid, Index<Dim>::Constant(3), 2), Vec<Dim>::Constant(cut)), velocity);
		return body;
	}

	TYPED_TEST(Explicit, FreeFallIsExact)
	{
		constexpr int Dim = TypeParam::value;
		for (const double ghostMass : { lumped, consistent }) {
			auto body           = flying<Dim>(ghostMass, 0.3, [](const Vec<Dim>&) { return Vec<Dim>(3 * Vec<Dim>::Unit(0)); });
			body.gravity[1]     = -10;
			const Vec<Dim> from = body.cloud.position[0];
			ASSERT_TRUE(body.steps(70, 0.01));
			Vec<Dim> moved = Vec<Dim>::Zero(), v = Vec<Dim>::Zero();
			moved[0] = 3 * 0.7, moved[1] = -10 * 0.49 / 2, v[0] = 3, v[1] = -7;
			for (std::size_t p = 0; p < body.cloud.size(); ++p) {
				EXPECT_LT((body.motion->velocity[p] - v).norm(), 1e-11 * v.norm());
				EXPECT_LT(body.cloud.stress[p].c.norm(), 1e-5) << "of 1e6 Pa";
			}
			EXPECT_LT((body.cloud.position[0] - from - moved).norm(), 1e-12 * moved.norm());
		}
	}

	TYPED_TEST(Explicit, FreeBlockKeepsItsVelocityThroughTheGrid)
	{
		constexpr int Dim = TypeParam::value;
		for (const double ghostMass : { lumped, consistent }) {
			Vec<Dim> v = Vec<Dim>::Constant(0.7);
			v[0]       = 5;
			auto body  = flying<Dim>(ghostMass, 0, [&](const Vec<Dim>&) { return v; });
			ASSERT_TRUE(body.steps(30, critical(body))); // 1.9 cells
			for (const auto& velocity : body.motion->velocity)
				EXPECT_LT((velocity - v).norm(), 1e-12 * v.norm());
		}
	}

	/// A body that swings by strains of 5 % as it flies: what energy is above that of the beginning falls with the
	/// square of the step.
	TYPED_TEST(Explicit, MomentumIsKeptToRoundOffAndEnergyWithinBounds)
	{
		constexpr int Dim = TypeParam::value;
		for (const double ghostMass : { lumped, consistent }) {
			double excess[2] = {};
			for (const int half : { 0, 1 }) {
				auto body = flying<Dim>(ghostMass, 0.2, [](const Vec<Dim>& x) { return Vec<Dim>(2 * Vec<Dim>::Unit(0) + 0.2 * x[1] * x); });
				const Vec<Dim> before = body.momentum();
				const double   energy = body.energy(), T = critical(body) * (half ? 0.45 : 0.9);
				for (int i = 0; i < (half ? 200 : 100); ++i) {
					ASSERT_TRUE(body.steps(1, T));
					excess[half] = std::max(excess[half], body.energy() / energy - 1);
				}
				EXPECT_LT((body.momentum() - before).norm(), 1e-12 * before.norm());
				EXPECT_GT(body.elastic(), 1e-5 * energy) << "it swings";
			}
			std::printf("ghost mass %g: excess %.5f %.5f\n", ghostMass, excess[0], excess[1]);
			EXPECT_LT(excess[0], 8e-3);
			EXPECT_LT(excess[1], (ghostMass == 0 ? 0.4 : 0.7) * excess[0]);
		}
	}

	TEST(Explicit, PeriodOfABarConvergesWithTheSquareOfTheStep)
	{
		for (const double ghostMass : { lumped, consistent }) {
			const auto error = [&](double courant) {
				Bar<2> body(12.3, TimeScheme::centralDifferences());
				setMass(body, ghostMass);
				return body.measuredPeriod(1, courant / body.wave) / body.period() - 1;
			};
			const double inSpace = error(0.05), coarse = error(0.4) - inSpace, fine = error(0.2) - inSpace;
			std::printf("ghost mass %g: %g %g %g\n", ghostMass, inSpace, coarse, fine);
			EXPECT_NEAR(coarse / fine, 4.2, 0.4);
			EXPECT_LT(std::abs(inSpace), ghostMass == 0 ? 4e-3 : 5e-4);
		}
	}

	/// The longest stable step of a block of so many cells that cuts cells on all sides, 2 / omega_max, by power
	/// iteration.
	template <int Dim> double longestStep(Moving<Dim>& body, int cells, int perAxis, double cut)
	{
		body.put(shifted<Dim>(block<Dim>(body.model.grid, Index<Dim>::Constant(cells), perAxis), Vec<Dim>::Constant(cut)), [](const Vec<Dim>& x) {
			return x;
		});
		StepReport            report;
		const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
		const LinearProblem   K = tangentStiffness(system.cloud, system.model);
		NodalMass<Dim>        M(system.basis, body.motion->mass, massFaces(*body.motion, system.context()), 1);
		Eigen::VectorXd       x = Random().vector(K.size()), y = x;
		double                square = 0;
		for (int i = 0; i < 80; ++i) {
			EXPECT_TRUE(M.solve({ { K * x, system.dofs, y } }));
			square = y.norm() / x.norm();
			x      = y / y.norm();
		}
		return 2 / std::sqrt(square);
	}

	/// The estimate is on the safe side wherever the block lies, and not by much where it lies worst. Printed: what
	/// it is over h / c, and the least that was found.
	TYPED_TEST(Explicit, CriticalStepIsThatOfTheHighestFrequency)
	{
		constexpr int Dim = TypeParam::value;
		for (const double ghostMass : { lumped, 0.01, consistent }) {
			double closest = infinity, least = infinity, estimate = 0;
			for (const double poisson : { 0., 0.49 })
				for (const double cut : { 1e-3, 0.5 })
					for (const int perAxis : { 2, 3 }) {
						if (Dim == 3 && perAxis == 3) continue;
						Moving<Dim> body(1, Hencky(1e6, poisson), 1000, TimeScheme::centralDifferences());
						setMass(body, ghostMass);
						const double wave  = std::sqrt(1e3 * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)));
						const double found = longestStep(body, Dim == 2 ? 7 : 3, perAxis, cut);
						estimate           = critical(body) * wave;
						closest = std::min(closest, found / critical(body)), least = std::min(least, found * wave);
					}
			std::printf("ghost mass %g: estimate %.3f h / c, least found %.3f\n", ghostMass, estimate, least);
			EXPECT_GE(closest, 1);
			EXPECT_LE(closest, 1.7);
		}
	}

	/// Steps that are too long grow without end, those estimated to be stable do not.
	TEST(Explicit, LongerStepsAreUnstable)
	{
		for (const double ghostMass : { lumped, consistent }) {
			double unstable = 0;
			for (const double factor : { 1., 2.5, 6. }) {
				auto body = flying<2>(
				        ghostMass, 0.4, [](const Vec<2>& x) { return Vec<2>(1e-3 * std::sin(3 * x[0]), 1e-3 * std::cos(5 * x[1] + x[0])); });
				const double energy = body.energy(), T = factor * critical(body);
				int          made = 0;
				while (made < 500 && body.energy() < 2 * energy && body.step(T).converged())
					++made;
				EXPECT_TRUE(factor > 1 || made == 500) << made;
				if (made < 500 && unstable == 0) unstable = factor;
			}
			std::printf("ghost mass %g: unstable with %g times the estimate\n", ghostMass, unstable);
			EXPECT_GT(unstable, 1);
		}
	}

	/// Whatever the step is, as internal forces exert no torque on the points where they are at its end. Lumping
	/// loses some: by 0.1 in this spin of a radian.
	TYPED_TEST(Explicit, AngularMomentumOfASpinIsKept)
	{
		constexpr int Dim    = TypeParam::value;
		auto          body   = flying<Dim>(consistent, 0.3, [](const Vec<Dim>& x) {
                        Vec<Dim> v = Vec<Dim>::Zero();
                        v[0] = -x[1], v[1] = x[0];
                        return v;
                });
		const double  before = body.angularMomentum();
		ASSERT_TRUE(body.steps(100, critical(body)));
		std::printf("angular momentum %.1e\n", body.angularMomentum() / before - 1);
		EXPECT_NEAR(body.angularMomentum() / before, 1, 1e-6);
	}

	/// A body flies against held nodes, which keep it: reactions, by the trapezoidal rule, are the change of its
	/// momentum, the first blow included.
	TYPED_TEST(Explicit, ReactionsAreTheChangeOfMomentum)
	{
		constexpr int Dim = TypeParam::value;
		for (const double ghostMass : { lumped, consistent }) {
			Vec<Dim> v = Vec<Dim>::Zero();
			v[0] = -3, v[1] = 0.5;
			auto body           = flying<Dim>(ghostMass, 0.2, [&](const Vec<Dim>&) { return v; });
			body.model.boundary = Boundary<Dim>({ wallBelow<Dim>(body.model.grid, 0, 0) });
			const double T = critical(body), before = body.momentum()[0];
			double       impulse = 0, last = 0;
			for (int i = 0; i < 0.15 / T; ++i) {
				const auto report = body.step(T);
				ASSERT_TRUE(report.converged()) << report.cause;
				impulse += T * (last = report.reactions[0][0]);
			}
			impulse -= T / 2 * last;
			EXPECT_GT(impulse, -before) << "it has turned back";
			EXPECT_NEAR((body.momentum()[0] - before) / impulse, 1, 3e-3);
			EXPECT_NEAR(body.momentum()[1], 0.5 * body.mass(), 1e-9 * body.mass());
		}
	}

	TEST(Explicit, SmallStepsAreThoseOfNewmark)
	{
		const auto end = [](const TimeScheme& scheme) {
			Bar<2> body(8.3, scheme);
			EXPECT_TRUE(body.steps(800, 0.02 / body.wave));
			return body.motion->velocity;
		};
		const auto ours = end(TimeScheme::centralDifferences()), others = end({});
		double     difference = 0, most = 0;
		for (std::size_t p = 0; p < ours.size(); ++p)
			difference = std::max(difference, (ours[p] - others[p]).norm()), most = std::max(most, ours[p].norm());
		std::printf("difference from Newmark %.2e\n", difference / most);
		EXPECT_LT(difference, 2e-3 * most);
	}

	TEST(Explicit, AFailedStepChangesNothing)
	{
		auto       body     = flying<2>(consistent, 0.1, [](const Vec<2>& x) { return Vec<2>(-15 * x[0], 0); });
		const auto velocity = body.motion->velocity, position = body.cloud.position;
		const auto report = body.step(0.1);
		EXPECT_EQ(report.failure, Failure::inverted);
		EXPECT_EQ(body.motion->velocity, velocity);
		EXPECT_EQ(body.cloud.position, position);
	}

} // namespace
} // namespace gimpm::testExplicit
