// SPDX-License-Identifier: GPL-2.0-or-later
// Contact force between a contact point on one body and a facet of another.
#include "core/terms/bodies/body_pair.hpp"
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <random>

namespace gimpm::testBodyPair {
namespace {

	template <class T> struct BodyPairTest : testing::Test {
		static constexpr int Dim = T::value;
		using Places             = PairPositions<Dim>;
		using Force              = PairForce<Dim>;

		static Places places()
		{
			if constexpr (Dim == 2) return { Vec<2>(.4, -.03), Vec<2>(1.1, .2), Vec<2>(0, 0) };
			else
				return { Vec3(.4, .3, .02), Vec3(0, 0, .1), Vec3(1.1, 0, .2), Vec3(.1, 1.2, 0) };
		}
		static Places moved(Places x, double size, unsigned seed)
		{
			std::mt19937                     random(seed);
			std::normal_distribution<double> normal(0, size);
			for (auto& place : x)
				for (int a = 0; a < Dim; ++a)
					place[a] += normal(random);
			return x;
		}
		static Eigen::VectorXd forces(const Force& f)
		{
			Eigen::VectorXd all(Force::size);
			for (int i = 0; i <= Dim; ++i)
				all.segment<Dim>(Dim * i) = f.force[i];
			return all;
		}
		static Vec3 inSpace(const Vec<Dim>& x)
		{
			Vec3 all                 = Vec3::Zero();
			all.template head<Dim>() = x;
			return all;
		}

		const Places   start  = places();
		const Places   now    = moved(start, .02, 1);
		const Vec<Dim> before = Vec<Dim>::Constant(.05);

		Force at(const Places& x, double friction, double cap = 1e9, double closed = 0) const
		{
			const auto found = pairForce<Dim>({ 7, 3, friction, cap }, start, before, x, closed, 1e-9, PairJacobian::exact);
			EXPECT_TRUE(found) << "the place is behind the piece";
			return found.value_or(Force());
		}
		void compareTangent(double friction, double cap = 1e9, double closed = 0) const
		{
			const Force     f = at(now, friction, cap, closed);
			Eigen::MatrixXd tangent(Force::size, Force::size);
			for (int i = 0; i < Force::size; ++i) {
				Places plus = now, minus = now;
				plus[i / Dim][i % Dim] += 1e-6, minus[i / Dim][i % Dim] -= 1e-6;
				tangent.col(i) = (forces(at(plus, friction, cap, closed)) - forces(at(minus, friction, cap, closed))) / 2e-6;
			}
			EXPECT_LT((tangent - f.tangent).cwiseAbs().maxCoeff(), 1e-8 * tangent.cwiseAbs().maxCoeff());
		}
	};
	using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
	TYPED_TEST_SUITE(BodyPairTest, Dimensions);

	TYPED_TEST(BodyPairTest, DerivativesAreThoseOfTheForces)
	{
		this->compareTangent(0);
		this->compareTangent(10);
		EXPECT_FALSE(this->at(this->now, 10).slips);
		this->compareTangent(.02);
		EXPECT_TRUE(this->at(this->now, .02).slips);
		this->compareTangent(10, .01);
		EXPECT_TRUE(this->at(this->now, 10, .01).slips) << "at the cap";
	}

	/// Pressure that is kept from the last step, with surfaces cut anew, acts at any gap below the one at
	/// which it began, on either side of the piece, until that gap is reached.
	TYPED_TEST(BodyPairTest, AKeptPressureActsFromTheGapAtWhichItBegan)
	{
		constexpr int Dim = TypeParam::value;
		auto          x   = this->now;
		for (const double gap : { -.05, .04 }) {
			x[0] += (gap - Facing<Dim>(x).gap) * Facing<Dim>(x).normal;
			for (const double kept : { .2, 1. }) {
				const double closed = gap + kept / 7;
				EXPECT_NEAR(this->at(x, 0, 1e9, closed).normalForce, kept, 1e-14) << "as the step began";
				const auto   f   = this->at(x, .1, 1e9, closed);
				const double cap = .1 * kept;
				EXPECT_NEAR(f.tangentialForce.norm(), f.slips ? cap : f.tangentialForce.norm(), 1e-14);
				EXPECT_LE(f.tangentialForce.norm(), cap * (1 + 1e-12)) << "the limit of friction is that of the kept pressure";
				auto apart = x;
				apart[0] += (closed - gap + 1e-3) * Facing<Dim>(x).normal;
				EXPECT_FALSE(pairForce<Dim>({ 7, 3, .1, 1e9 }, this->start, this->before, apart, closed, 1e-9, PairJacobian::exact))
				        << "nothing pulls";
			}
		}
		const double behind = Facing<Dim>(this->now).gap;
		for (const double friction : { 0., .02, 10. })
			this->compareTangent(friction, 1e9, std::abs(behind) + .1);
	}

	TYPED_TEST(BodyPairTest, WithoutFrictionTheDerivativeIsSymmetric)
	{
		const auto K = this->at(this->now, 0).tangent;
		EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-14 * K.cwiseAbs().maxCoeff());
	}

	TYPED_TEST(BodyPairTest, ForcesHaveNeitherResultantNorMoment)
	{
		constexpr int Dim = TypeParam::value;
		for (const double friction : { 0., .02, 10. }) {
			const auto f      = this->at(this->now, friction);
			Vec<Dim>   sum    = Vec<Dim>::Zero();
			Vec3       moment = Vec3::Zero();
			for (int i = 0; i <= Dim; ++i) {
				sum += f.force[i];
				moment += this->inSpace(this->now[i]).cross(this->inSpace(f.force[i]));
			}
			EXPECT_GT(f.force[0].norm(), .01);
			EXPECT_LT(sum.norm(), 1e-15);
			EXPECT_LT(moment.norm(), 1e-15);
		}
	}

	TYPED_TEST(BodyPairTest, FrictionTurnsWithThePiece)
	{
		constexpr int Dim  = TypeParam::value;
		Mat<Dim>      turn = Mat<Dim>::Identity();
		turn.template topLeftCorner<2, 2>() << std::cos(2.), -std::sin(2.), std::sin(2.), std::cos(2.);
		auto turned = this->start;
		for (auto& x : turned)
			x = turn * x;
		const auto still = this->at(this->start, 10), after = this->at(turned, 10);
		EXPECT_LT((after.tangentialForce - turn * still.tangentialForce).norm(), 1e-14);
		EXPECT_LT(after.slip.norm(), 1e-14);
		EXPECT_GT(still.tangentialForce.norm(), .03);
	}

	TYPED_TEST(BodyPairTest, NothingPullsTogether)
	{
		constexpr int Dim = TypeParam::value;
		auto          x   = this->start;
		x[0] += 2 * std::abs(Facing<Dim>(x).gap) * Facing<Dim>(x).normal;
		EXPECT_FALSE(pairForce<Dim>({ 7, 3, 10, 1e9 }, this->start, this->before, x, 0, 1e-9, PairJacobian::exact));
	}

	TYPED_TEST(BodyPairTest, ClosestWeightsAreThoseOfTheLeastDistance)
	{
		constexpr int                          Dim = TypeParam::value;
		std::mt19937                           random(3);
		std::uniform_real_distribution<double> even(-1, 2);
		auto                                   x = this->start;
		for (int scene = 0; scene < 100; ++scene) {
			for (int a = 0; a < Dim; ++a)
				x[0][a] = even(random);
			const auto weight = closestWeights(x);
			Vec<Dim>   foot   = Vec<Dim>::Zero();
			double     sum    = 0;
			for (int i = 0; i < Dim; ++i) {
				EXPECT_GE(weight[i], 0);
				foot += weight[i] * x[i + 1], sum += weight[i];
			}
			EXPECT_NEAR(sum, 1, 1e-14);
			EXPECT_NEAR((x[0] - foot).squaredNorm(), squaredDistance(x), 1e-13);
		}
	}

} // namespace
} // namespace gimpm::testBodyPair
