// SPDX-License-Identifier: GPL-2.0-or-later
// Central differences: closed forms, what is kept, and how long a step may be.
#include "core/stepping/critical_step.hpp"
#include "core/stepping/explicit_step.hpp"
#include "moving.hpp"
#include <Eigen/Dense>

namespace gimpm::testExplicit {
namespace {

	template <class T> using Explicit = InBothDimensions<T>;
	TYPED_TEST_SUITE(Explicit, BothDimensions, DimensionName);

	constexpr double lumped = 0, consistent = 0.25;

	/// Either mass; ghost stiffness only with ghost mass.
	template <class Body> Body explicitly(Body body, double ghostMass)
	{
		body.motion->scheme    = TimeScheme::centralDifferences();
		body.motion->ghostMass = ghostMass;
		body.model.terms.clear();
		if (ghostMass == 0) body.model.ghost.factor = 0;
		return body;
	}

	template <int Dim> StepReport step(Moving<Dim>& body, double duration)
	{
		body.motion->duration = duration;
		return explicitStep<Dim>(body.cloud, body.model, { body.gravity, { 1, 0 } }, *body.motion);
	}

	template <int Dim> bool steps(Moving<Dim>& body, int count, double duration)
	{
		for (int i = 0; i < count; ++i)
			if (const auto report = step(body, duration); !report.converged()) {
				ADD_FAILURE() << "step " << i << ": " << report.cause;
				return false;
			}
		return true;
	}

	template <int Dim> double critical(const Moving<Dim>& body) { return criticalStep(body.cloud, body.model, body.motion->ghostMass, 0); }

	/// A block of 3 cells along each axis that fills the part `cut` of cells on two sides.
	template <int Dim, class F> Moving<Dim> flying(double ghostMass, double cut, F&& velocity, double poisson = 0.3)
	{
		auto body = explicitly(Moving<Dim>(1, Hencky(1e6, poisson), 1000), ghostMass);
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
			ASSERT_TRUE(steps(body, 70, 0.01));
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
			ASSERT_TRUE(steps(body, 30, critical(body))); // 1.9 cells
			for (const auto& velocity : body.motion->velocity)
				EXPECT_LT((velocity - v).norm(), 1e-12 * v.norm());
		}
	}

	/// A body that swings as it flies.
	TYPED_TEST(Explicit, MomentumIsKeptToRoundOffAndEnergyWithinBounds)
	{
		constexpr int Dim = TypeParam::value;
		for (const double ghostMass : { lumped, consistent }) {
			auto body = flying<Dim>(ghostMass, 0.2, [](const Vec<Dim>& x) { return Vec<Dim>(2 * Vec<Dim>::Unit(0) + 0.2 * x[1] * x); });
			const Vec<Dim> before = body.momentum();
			const double   energy = body.energy();
			double         most   = 0;
			for (int i = 0; i < 200; ++i) {
				ASSERT_TRUE(steps(body, 1, 0.9 * critical(body)));
				most = std::max(most, body.energy());
			}
			EXPECT_LT((body.momentum() - before).norm(), 1e-12 * before.norm());
			EXPECT_GT(body.elastic(), 1e-5 * energy) << "it swings";
			EXPECT_LT(most, (1 + 1e-3) * energy);
			std::printf("ghost mass %g: energy %.5f, most %.5f\n", ghostMass, body.energy() / energy, most / energy);
		}
	}

	TEST(Explicit, PeriodOfABarConvergesWithTheSquareOfTheStep)
	{
		for (const double ghostMass : { lumped, consistent }) {
			const auto error = [&](double courant) {
				Bar<2>       bar(12.3);
				auto         body = explicitly(bar, ghostMass);
				const double T    = courant / body.wave;
				// angular frequency by v- + v+ = 2 cos(w T) v
				double top = 0, bottom = 0, v[3] = { 0, body.ofFirstMode(), 0 };
				for (int i = 0; i * T < body.period(); ++i) {
					EXPECT_TRUE(step(body, T).converged());
					v[2] = body.ofFirstMode();
					if (i > 0) top += (v[0] + v[2]) * v[1], bottom += 2 * v[1] * v[1];
					v[0] = v[1], v[1] = v[2];
				}
				return 2 * M_PI * T / std::acos(top / bottom) / body.period() - 1;
			};
			const double inSpace = error(0.05), coarse = error(0.4) - inSpace, fine = error(0.2) - inSpace;
			std::printf("ghost mass %g: %g %g %g\n", ghostMass, inSpace, coarse, fine);
			EXPECT_NEAR(coarse / fine, 4.2, 0.4);
			EXPECT_LT(std::abs(inSpace), 3e-3);
		}
	}

} // namespace
} // namespace gimpm::testExplicit
