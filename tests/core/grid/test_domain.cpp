// SPDX-License-Identifier: GPL-2.0-or-later
// Half lengths of the boxes of points in homogeneous deformations.
#include "core/grid/domain.hpp"
#include "scenes.hpp"
#include <Eigen/LU>

namespace gimpm {
namespace {

	template <class Dimension> class DomainRules : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Random random;

		/// Initial half lengths, all different.
		static Vec<Dim> box()
		{
			Vec<Dim> half = Vec<Dim>::Constant(0.2);
			half[0]       = 0.25;
			half[Dim - 1] *= 0.8;
			return half;
		}
		static Mat<Dim> shear(int along, int across, double amount)
		{
			Mat<Dim> F       = Mat<Dim>::Identity();
			F(along, across) = amount;
			return F;
		}
		static Vec<Dim> tiling(const Mat<Dim>& F, const Vec<Dim>& half) { return domainOf<Dim>(F, half, DomainRule::tiling); }
		static Vec<Dim> stretched(const Mat<Dim>& F) { return domainOf<Dim>(F, Vec<Dim>::Ones(), DomainRule::stretch); }
	};
	TYPED_TEST_SUITE(DomainRules, BothDimensions, DimensionName);

	TYPED_TEST(DomainRules, HasTheVolumeOfThePoint)
	{
		constexpr int Dim = TypeParam::value;
		for (int i = 0; i < 200; ++i) {
			const Mat<Dim> F = Mat<Dim>::Identity() + this->random.template matrix<Dim, Dim>(i % 4);
			if (!(F.determinant() > 0.01)) continue;
			const double volume = this->tiling(F, this->box()).prod();
			EXPECT_NEAR(volume / (F.determinant() * this->box().prod()), 1, 1e-12) << F;
		}
	}

	TYPED_TEST(DomainRules, IsExactInStretchAlongTheAxesAndThenShearAlongOne)
	{
		constexpr int Dim     = TypeParam::value;
		Vec<Dim>      stretch = Vec<Dim>::Constant(0.9);
		stretch[0]            = 1.5;
		const Vec<Dim> half   = this->box().cwiseProduct(stretch);
		for (int i = 0; i < Dim; ++i)
			for (int j = 0; j < Dim; ++j)
				for (const double amount : { -3.3, 0., 0.5, 1., 2.7, 5., 200. }) {
					if (i == j) continue;
					const Mat<Dim> F = this->shear(i, j, amount) * stretch.asDiagonal();
					EXPECT_LT((this->tiling(F, this->box()) - half).norm(), 1e-12) << i << j << ' ' << amount;
				}
	}

	TYPED_TEST(DomainRules, TurnsWithAQuarterTurnOfABoxThatIsNotSquare)
	{
		constexpr int Dim  = TypeParam::value;
		Mat<Dim>      turn = Mat<Dim>::Identity();
		turn.template topLeftCorner<2, 2>() << 0, -1, 1, 0;
		Vec<Dim> half = this->box();
		std::swap(half[0], half[1]);
		EXPECT_LT((this->tiling(turn, this->box()) - half).norm(), 1e-14);
	}

	TYPED_TEST(DomainRules, IsThatOfTheLatticeAndNotOfItsBasis)
	{
		constexpr int Dim = TypeParam::value;
		for (int i = 0; i < 50; ++i) {
			const Mat<Dim> F = Mat<Dim>::Identity() + this->random.template matrix<Dim, Dim>(0.4);
			if (!(F.determinant() > 0.3)) continue;
			Mat<Dim> same = F; // a lattice with equal spacings after a shear of 1: its points have other neighbours
			same.col(0) += same.col(1);
			same.col(Dim - 1) -= same.col(0);
			const Vec<Dim> half = Vec<Dim>::Constant(0.25);
			EXPECT_LT((this->tiling(F, half) - this->tiling(same, half)).norm(), 1e-9) << F;
		}
	}

	TYPED_TEST(DomainRules, ScalesWithItsLatticeToTheLastBit)
	{
		constexpr int Dim = TypeParam::value;
		for (int i = 0; i < 100; ++i) {
			const Mat<Dim> F = Mat<Dim>::Identity() + this->random.template matrix<Dim, Dim>(0.4);
			for (const double scale : { 0.125, 2., 1024. })
				EXPECT_EQ(Vec<Dim>(scale * this->tiling(F, this->box())), this->tiling(F, scale * this->box()));
		}
	}

	TYPED_TEST(DomainRules, ThatIsFlattenedHasNoSizeOrANumber)
	{
		constexpr int Dim = TypeParam::value;
		for (int i = 0; i < 100; ++i) {
			const Mat<Dim> R = this->random.template rotation<Dim>(), F = 1e9 * R.col(0) * R.col(Dim - 1).transpose();
			for (const DomainRule rule : { DomainRule::tiling, DomainRule::stretch }) {
				const auto size = domainOf<Dim>(F + 1e-9 * Mat<Dim>::Identity(), Vec<Dim>::Ones(), rule);
				EXPECT_GE(size.minCoeff(), 0) << size.transpose();
			}
		}
	}

	TYPED_TEST(DomainRules, OfThePaperFollowsTheStretchAndNotTheRotation)
	{
		constexpr int Dim     = TypeParam::value;
		Vec<Dim>      stretch = Vec<Dim>::Constant(0.8);
		stretch[0]            = 1.5;
		for (int i = 0; i < 20; ++i)
			EXPECT_LT((this->stretched(this->random.template rotation<Dim>() * stretch.asDiagonal()) - stretch).norm(), 1e-14);
		// F = 1 + g e_x e_y: C = [1 g; g 1 + g^2]; sqrt(C) = (C + 1 sqrt(det C)) / sqrt(tr C + 2 sqrt(det C))
		// with det C = 1
		const double g = 1.7, root = std::sqrt(4 + g * g);
		const auto   size = this->stretched(this->shear(0, 1, g));
		EXPECT_NEAR(size[0], 2 / root, 1e-14);
		EXPECT_NEAR(size[1], (2 + g * g) / root, 1e-14);
		if (Dim == 3) {
			EXPECT_NEAR(size[Dim - 1], 1, 1e-14);
		}
	}

	/// Points of a lattice with 2 x 2 points in a cell of size 1, deformed by F, within three cells of the origin.
	std::vector<Vec<2>> latticePoints(const Mat<2>& F)
	{
		std::vector<Vec<2>> points;
		const int           most = int(16 * F.inverse().norm()) + 12;
		for (int i = -most; i <= most; ++i)
			for (int j = -most; j <= most; ++j)
				if (const Vec<2> x = F * Vec<2>(i / 2. + 0.07, j / 2. + 0.07); x.cwiseAbs().maxCoeff() < 3.2) points.push_back(x);
		return points;
	}

	/// Nodal force of a uniform stress of 1 on inner nodes over a cell face: 0 where boxes tile.
	double largestForce(const Mat<2>& F, DomainRule rule)
	{
		const Vec<2> half = domainOf<2>(F, Vec<2>::Constant(0.25), rule).cwiseMin(0.5);
		double       most = 0;
		for (const Vec<2>& node : { Vec<2>(0, 0), Vec<2>(1, 0), Vec<2>(0, 1), Vec<2>(1, 1) }) {
			Vec<2> force = Vec<2>::Zero();
			for (const Vec<2>& x : latticePoints(F)) {
				Vec<2> value, slope;
				for (int a = 0; a < 2; ++a) {
					const auto   integral = [](double t) { return std::abs(t) >= 1 ? (t > 0 ? 1. : 0.) : 0.5 + t - 0.5 * t * std::abs(t); };
					const auto   hat      = [](double t) { return std::max(0., 1 - std::abs(t)); };
					const double low = x[a] - node[a] - half[a], high = x[a] - node[a] + half[a];
					value[a] = (integral(high) - integral(low)) / (2 * half[a]);
					slope[a] = (hat(high) - hat(low)) / (2 * half[a]);
				}
				force += F.determinant() / 4 * Vec<2>(slope[0] * value[1], value[0] * slope[1]);
			}
			most = std::max(most, force.cwiseAbs().maxCoeff());
		}
		return most;
	}

	/// Simple shear along a line at an angle to the grid [rad].
	Mat<2> obliqueShear(double amount, double angle)
	{
		const Vec<2> along(std::cos(angle), std::sin(angle)), across(-along[1], along[0]);
		return Mat<2>::Identity() + amount * along * across.transpose();
	}

	TEST(DomainInObliqueShear, LeavesASmallPartOfTheForcesThatOverlapMakes)
	{
		const double degrees[]  = { 0, 5, 10, 15, 22.5, 30, 37, 45, 60, 75 };
		const double parts[][2] = { { 0.6, 0.5 }, { 1, 0.4 }, { 1.5, 0.45 } }; // shear; largest mean over the rule of the paper
		for (const auto& [amount, part] : parts) {
			double tiling = 0, stretch = 0;
			for (const double angle : degrees) {
				const Mat<2> F = obliqueShear(amount, angle * M_PI / 180);
				tiling += largestForce(F, DomainRule::tiling);
				stretch += largestForce(F, DomainRule::stretch);
			}
			EXPECT_LT(tiling, part * stretch) << amount << ": " << tiling / 10 << ' ' << stretch / 10;
		}
		EXPECT_LT(largestForce(obliqueShear(0.6, 0), DomainRule::tiling), 1e-12);
	}

	/// Sum of the overlaps of the box at the origin with all others over its own area.
	double overlapOf(const Mat<2>& F, DomainRule rule)
	{
		const Vec<2> half = domainOf<2>(F, Vec<2>::Constant(0.25), rule);
		double       area = 0;
		for (const Vec<2>& x : latticePoints(F)) {
			const Vec<2> from = x - F * Vec<2>(0.07, 0.07);
			if (from.norm() < 1e-9) continue;
			const Vec<2> common = (2 * half - from.cwiseAbs()).cwiseMax(0);
			area += common.prod();
		}
		return area / (4 * half.prod());
	}

	TEST(DomainInObliqueShear, OverlapsLessThanThatOfThePaper)
	{
		for (const double amount : { 0.5, 1., 2. }) {
			EXPECT_LT(overlapOf(obliqueShear(amount, 0), DomainRule::tiling), 1e-12);
			double tiling = 0, stretch = 0;
			for (double degrees = 0; degrees < 90; degrees += 7.5) {
				tiling += overlapOf(obliqueShear(amount, degrees * M_PI / 180), DomainRule::tiling);
				stretch += overlapOf(obliqueShear(amount, degrees * M_PI / 180), DomainRule::stretch);
			}
			EXPECT_LT(tiling, 0.8 * stretch) << amount << ": " << tiling / 12 << ' ' << stretch / 12;
		}
	}

} // namespace
} // namespace gimpm
