// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of a load step, by sequences of outcomes.
#include "core/stepping/step_control.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace gimpm {
namespace {

	constexpr int maxIterations = 20;

	StepReport outcome(Failure failure, int iterations)
	{
		StepReport report;
		report.failure    = failure;
		report.iterations = iterations;
		return report;
	}
	const StepReport easy = outcome(Failure::none, 6), hard = outcome(Failure::none, 7), fails = outcome(Failure::tooManyIterations, maxIterations);

	// The parts that are tried.
	std::vector<double> partsOf(StepControl& control, const std::vector<StepReport>& outcomes)
	{
		std::vector<double> parts;
		for (const StepReport& report : outcomes) {
			EXPECT_FALSE(control.isDone());
			parts.push_back(control.part());
			EXPECT_TRUE(control.take(report));
		}
		return parts;
	}
	using Parts = std::vector<double>;

	TEST(StepControl, aStepThatConvergesIsMadeAsAWhole)
	{
		StepControl control(1, 1. / 1024, maxIterations);
		EXPECT_EQ(control.goal(), 1);
		EXPECT_EQ(partsOf(control, { hard }), Parts { 1 });
		EXPECT_TRUE(control.isDone());
		EXPECT_EQ(control.cuts(), 0);
		EXPECT_EQ(control.nextPart(), 1);
	}

	TEST(StepControl, failuresHalveThePartAndEasyOnesDoubleIt)
	{
		StepControl control(1, 1. / 1024, maxIterations);
		EXPECT_EQ(partsOf(control, { fails, fails, fails, easy, hard, hard, easy }), (Parts { 1, .5, .25, .125, .25, .25, .25 }));
		EXPECT_EQ(control.cuts(), 3);
		EXPECT_EQ(control.goal(), 1); // 0.125 are left, though 0.5 would be tried
		EXPECT_EQ(control.part(), .125);
		EXPECT_TRUE(control.take(hard));
		EXPECT_TRUE(control.isDone());
		EXPECT_EQ(control.nextPart(), .5); // the next step begins with it
	}

	TEST(StepControl, thePartOfTheStepBeforeIsTheFirst)
	{
		StepControl control(.5, 1. / 1024, maxIterations);
		EXPECT_EQ(partsOf(control, { hard, easy }), (Parts { .5, .5 }));
		EXPECT_TRUE(control.isDone());
		EXPECT_EQ(control.nextPart(), 1);
	}

	TEST(StepControl, theRestIsCutAsAnyPart)
	{
		StepControl control(.25, 1. / 1024, maxIterations);
		EXPECT_EQ(partsOf(control, { easy, easy, fails, easy, easy }), (Parts { .25, .5, .25, .125, .125 }));
		EXPECT_TRUE(control.isDone());
	}

	TEST(StepControl, theLocalErrorSaysHowFarToCutAndWhenToGrow)
	{
		const auto inaccurate = [](double error) {
			StepReport report = outcome(error > 1 ? Failure::inaccurate : Failure::none, 6);
			report.localError = error;
			return report;
		};
		StepControl control(1, 1. / 1024, maxIterations);
		EXPECT_EQ(partsOf(control, { inaccurate(65), inaccurate(.13), inaccurate(.12) }), (Parts { 1, .125, .125 }));
		EXPECT_EQ(control.part(), .25);
		EXPECT_EQ(control.cuts(), 1);
		EXPECT_EQ(partsOf(control, { inaccurate(1.1), inaccurate(.1) }), (Parts { .25, .125 }));
		// Not further than to the least part, and no further than once.
		StepControl coarse(1, .25, maxIterations);
		EXPECT_EQ(partsOf(coarse, { inaccurate(1e6) }), Parts { 1 });
		EXPECT_EQ(coarse.part(), .25);
		EXPECT_FALSE(coarse.take(inaccurate(1e6)));
	}

	TEST(StepControl, anErrorOfSecondOrderCutsFurther)
	{
		StepReport inaccurate = outcome(Failure::inaccurate, 6), grows = easy;
		inaccurate.localError = 15, inaccurate.errorOrder = 2;
		grows.localError = .12, grows.errorOrder = 2;
		StepControl control(1, 1. / 1024, maxIterations);
		EXPECT_EQ(partsOf(control, { inaccurate, grows, easy }), (Parts { 1, .25, .5 }));
	}

	TEST(StepControl, whatBeginsAnewBeginsSmall)
	{
		StepControl control(1, 1. / 1024, maxIterations);
		control.beginAnew();
		EXPECT_EQ(partsOf(control, { easy, easy, hard, hard }), (Parts { .125, .25, .5, .125 }));
		EXPECT_TRUE(control.isDone());
		EXPECT_EQ(control.cuts(), 0);
		StepControl small(1. / 16, 1. / 1024, maxIterations), uncut(1, 1, maxIterations), coarse(1, .25, maxIterations);
		small.beginAnew(), uncut.beginAnew(), coarse.beginAnew();
		EXPECT_EQ(small.part(), 1. / 16);
		EXPECT_EQ(uncut.part(), 1);
		EXPECT_EQ(coarse.part(), .25);
	}

	TEST(StepControl, anAcceptedPartCounts)
	{
		StepReport accepted = fails;
		accepted.accepted   = true;
		StepControl control(1, 1, maxIterations);
		EXPECT_TRUE(control.isLeast());
		EXPECT_TRUE(control.take(accepted));
		EXPECT_TRUE(control.isDone());
		EXPECT_EQ(control.cuts(), 0);
	}

	TEST(StepControl, givesUpAtTheLeastPart)
	{
		StepControl control(1, .25, maxIterations);
		EXPECT_FALSE(control.isLeast());
		EXPECT_EQ(partsOf(control, { fails, fails }), (Parts { 1, .5 }));
		EXPECT_TRUE(control.isLeast());
		EXPECT_FALSE(control.take(fails));
		EXPECT_EQ(control.cuts(), 2);
		EXPECT_FALSE(control.isDone());
		EXPECT_EQ(control.nextPart(), 1); // whatever comes next is tried as a whole

		StepControl uncut(1, 1, maxIterations);
		EXPECT_FALSE(uncut.take(fails));
		EXPECT_EQ(uncut.cuts(), 0);
	}

	TEST(StepControl, cutsOnlyWhereLessLoadMayHelp)
	{
		for (const Failure failure : { Failure::singular, Failure::inverted, Failure::notFinite, Failure::diverging, Failure::tooManyIterations }) {
			StepControl control(1, .25, maxIterations);
			EXPECT_TRUE(control.take(outcome(failure, 3)));
			EXPECT_EQ(control.part(), .5);
		}
		for (const Failure failure : { Failure::detached, Failure::unrestrained, Failure::stalled, Failure::interrupted }) {
			StepControl control(.5, .25, maxIterations);
			EXPECT_FALSE(control.take(outcome(failure, 3)));
			EXPECT_EQ(control.cuts(), 0);
			EXPECT_EQ(control.nextPart(), 1);
		}
	}

	// Steps that are done are kept: a run that is interrupted goes on from there.
	TEST(StepControl, anInterruptionLeavesTheRest)
	{
		StepControl control(1, 1. / 1024, maxIterations);
		EXPECT_EQ(partsOf(control, { fails, easy }), (Parts { 1, .5 }));
		EXPECT_FALSE(control.take(outcome(Failure::interrupted, 2)));
		EXPECT_FALSE(control.isDone());
		EXPECT_EQ(control.goal(), 1);
	}

	// Whatever happens: a rest that is cut may be no half of a half of the whole, but has few digits, and all add
	// up to the bit.
	TEST(StepControl, partsAddUpExactly)
	{
		std::mt19937 random(1);
		for (int trial = 0; trial < 200; ++trial) {
			StepControl control(std::ldexp(1., -int(random() % 11)), 1. / 1024, maxIterations);
			double      sum = 0;
			while (!control.isDone()) {
				const double     part   = control.part();
				const StepReport report = random() % 3 == 0 && !control.isLeast() ? fails : random() % 2 == 0 ? easy : hard;
				EXPECT_EQ(std::ldexp(part, 40), std::floor(std::ldexp(part, 40)));
				ASSERT_TRUE(control.take(report));
				if (report.converged()) sum += part;
			}
			EXPECT_EQ(sum, 1);
		}
	}

} // namespace
} // namespace gimpm
