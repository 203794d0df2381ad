// SPDX-License-Identifier: GPL-2.0-or-later
// The estimated error of a quasi-static step against motions of known acceleration.
#include "bench/scenes.hpp"
#include "core/stepping/load_step.hpp"
#include "core/stepping/rate_change.hpp"
#include <gtest/gtest.h>

namespace gimpm {
namespace {

	constexpr double young = 1e6, before = .25, now = .5; // growths of the load in two steps

	Eigen::VectorXd nodal(const StepSystem<2>& system, double shear, const Vec<2>& all)
	{
		Eigen::VectorXd d(system.nodalSize());
		for (std::size_t n = 0; n < system.basis.nodes.size(); ++n) {
			const Vec<2> x      = Grid<2>::index(system.basis.nodes[n]).cast<double>() * system.model.grid.cellSize;
			d.segment<2>(2 * n) = Vec<2>(shear * x[1], 0) + all;
		}
		return d;
	}

	/// The estimate for a body in shear whose points, besides, move with an acceleration a.
	double estimate(const Law& law, const Vec<2>& a, bool fBar = false)
	{
		auto scene = slope<2>(1, 2);
		for (Material& material : scene.model.materials)
			material.law = law;
		scene.model.fBar = fBar;
		StepReport             report;
		const StepSystem<2>    system(scene.cloud, scene.model, Load<2>(), report);
		const LastIncrement<2> last { system.basis.nodes, {}, before };
		const Eigen::VectorXd  d = nodal(system, .01, a * (before + now) / 2 * now), prediction = nodal(system, .01, Vec<2>::Zero());
		const LocalError       error = rateChange(system, last, now, prediction, d);
		EXPECT_EQ(error.order, 2);
		return error.size;
	}

	TEST(RateChange, isTheSecondOrderTermOfTheMotion)
	{
		const Vec<2> a(.3, -.4);
		const double flowing = estimate(VonMises(young, .3, 1), a);
		EXPECT_NEAR(flowing, a.norm() * now * now / 2, .01 * flowing); // nearly all of the strain is plastic
		EXPECT_NEAR(estimate(VonMises(young, .3, 1), -3 * a), 3 * flowing, 1e-9 * flowing);
		EXPECT_NEAR(estimate(VonMises(young, .3, 1), a, true), flowing, .01 * flowing);
	}

	TEST(RateChange, countsPlasticStrainOnly)
	{
		const Vec<2> a(.3, -.4);
		EXPECT_EQ(estimate(Hencky(young, .3), a), 0);
		for (const bool fBar : { false, true })
			EXPECT_LT(estimate(VonMises(young, .3, 1e9), a, fBar), 1e-12);
		// half of the shear strain of 0.005 yields
		EXPECT_NEAR(estimate(VonMises(young, .3, std::sqrt(2) * young / 1.3 * .0025), a), a.norm() * now * now / 4, .002);
	}

	TEST(RateChange, isAskedForOnlyWithATolerance)
	{
		auto             scene = slope<2>(1, 2);
		LastIncrement<2> last;
		const auto       step = [&](double value, double growth) {
                        const StepReport report = loadStep(scene.cloud, scene.model, Load<2> { scene.gravity, { value, growth } }, scene.solver, &last);
                        return report;
		};
		EXPECT_TRUE(step(.25, .25).converged());
		EXPECT_EQ(step(.5, .25).localError, 0);
		scene.model.newton.stepTolerance = 1e-9;
		const auto       positions       = scene.cloud.position;
		const StepReport refused         = step(1, .5);
		EXPECT_EQ(refused.failure, Failure::inaccurate);
		EXPECT_GT(refused.localError, 1e3);
		EXPECT_EQ(positions, scene.cloud.position); // nothing has moved
		EXPECT_EQ(last.load, .25);
		scene.model.newton.stepTolerance = 1;
		EXPECT_TRUE(step(1, .5).converged());
	}

} // namespace
} // namespace gimpm
