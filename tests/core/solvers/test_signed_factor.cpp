// SPDX-License-Identifier: GPL-2.0-or-later
// Factors of matrices that are not definite, or not symmetric.
#include "core/solvers/supernodal_factor.hpp"
#include "matrices.hpp"
#include <numeric>

namespace gimpm {
namespace {

	/// [K, -Q^T; -Q, -C] with K and C positive definite, rows and columns of both mixed; a band, of which a part is
	/// filled.
	Eigen::MatrixXd ofTwoFields(int nodes, double stored, unsigned seed, double filled = 0.7)
	{
		Random          random(seed);
		const int       size = 3 * nodes;
		Eigen::MatrixXd m    = Eigen::MatrixXd::Zero(size, size);
		for (int c = 0; c < size; ++c)
			for (int r = 0; r < c; ++r)
				if (std::abs(r / 3 - c / 3) < 5 && random.in(0, 1) < filled) m(r, c) = m(c, r) = random.in(-0.1, 0.1);
		for (int i = 0; i < size; ++i)
			for (int j = 0; j < size; ++j)
				if (i % 3 == 2 && j % 3 == 2) m(i, j) *= i == j ? 0 : stored;
		for (int i = 0; i < size; ++i)
			m(i, i) = i % 3 == 2 ? -2 * stored : 2;
		return m;
	}

	/// Upper triangle.
	Csc upper(const Eigen::MatrixXd& full)
	{
		return gimpm::sparse<Csc>(full, [&](int r, int c) { return r < c && full(r, c) != 0; });
	}

	/// A pressure after the displacements of its node.
	std::vector<int> inTheirOrder(const Csc& K)
	{
		std::vector<int> order(K.size());
		std::iota(order.begin(), order.end(), 0);
		return order;
	}

	TEST(SignedFactor, SolvesWhatHasPivotsOfBothSigns)
	{
		for (const int nodes : { 1, 7, 40, 200 })
			for (const double stored : { 1., 1e-3, 1e-6 }) {
				const Eigen::MatrixXd m = ofTwoFields(nodes, stored, nodes);
				const Csc             K = upper(m);
				SupernodalFactor      factor;
				factor.analyse(K, inTheirOrder(K), 0, false);
				ASSERT_TRUE(factor.factoriseSigned(K, 1e-12));
				const Eigen::VectorXd b = Random(5).vector(3 * nodes);
				Eigen::VectorXd       x;
				ASSERT_TRUE(factor.solveSigned(b, x));
				EXPECT_LT((m * x - b).norm(), 1e-12 * (b.norm() + x.norm())) << nodes << " nodes, " << stored;
				EXPECT_LT((timesSymmetric(K, x) - m * x).norm(), 1e-14 * (b.norm() + x.norm()));
				auto twice = K;
				for (double& value : twice.value)
					value *= 2;
				Eigen::VectorXd half;
				ASSERT_TRUE(factor.factoriseSigned(twice, 1e-12) && factor.solveSigned(b, half)) << "the pattern is kept";
				EXPECT_LT((2 * half - x).norm(), 1e-12 * x.norm());
			}
	}

	/// Large enough for its products to be left to the BLAS.
	TEST(SignedFactor, SolvesWhatIsDense)
	{
		constexpr int   size = 1100;
		Random          random(2);
		Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
		for (int c = 0; c < size; ++c) {
			for (int r = 0; r < c; ++r)
				m(r, c) = m(c, r) = random.in(-0.01, 0.01);
			m(c, c) = c % 3 == 2 ? -2 : 2;
		}
		const Csc        K = upper(m);
		SupernodalFactor factor;
		factor.analyse(K, inTheirOrder(K), 0, false);
		ASSERT_TRUE(factor.factoriseSigned(K, 1e-12));
		const Eigen::VectorXd b = random.vector(size);
		Eigen::VectorXd       x;
		ASSERT_TRUE(factor.solveSigned(b, x));
		EXPECT_LT((m * x - b).norm(), 1e-12 * (b.norm() + x.norm()));
	}

	/// Nodes of which some unknowns are held, the last ones first.
	TEST(SignedFactor, FindsItsPatternFromThatOfNodes)
	{
		constexpr int    nodes = 60;
		Random           random(3);
		std::vector<int> kept, widths, order;
		for (int n = 0; n < nodes; ++n) {
			const auto before = kept.size();
			for (int i = 0; i < 3; ++i)
				if (i == 2 || random.in(0, 1) < 0.6) kept.push_back(3 * n + i);
			widths.insert(widths.begin(), int(kept.size() - before));
		}
		for (std::size_t end = kept.size(), n = nodes; n > 0; end -= widths[nodes - n--])
			for (int i = widths[nodes - n]; i > 0; --i)
				order.push_back(int(end) - i);
		const Eigen::MatrixXd m = principalPart(ofTwoFields(nodes, 1e-3, 4, 1), kept);
		const Csc             K = upper(m);
		SupernodalFactor      factor, other;
		factor.analyse(K, order, 0, false);
		ASSERT_TRUE(factor.isAnalysed() && factor.factoriseSigned(K, 1e-12));
		const Eigen::VectorXd b = Random(5).vector(m.rows());
		Eigen::VectorXd       x;
		ASSERT_TRUE(factor.solveSigned(b, x));
		EXPECT_LT((m * x - b).norm(), 1e-12 * (b.norm() + x.norm()));
		other.analyse(K, order);
		EXPECT_GE(factor.entries(), other.entries()) << "with zeros that make supernodes larger";
		EXPECT_LT(factor.entries(), 2 * other.entries()) << "all of the triangle would be six times";
		factor.analyse(K, order);
		EXPECT_EQ(factor.entries(), other.entries());
		EXPECT_EQ(factor.flops(), other.flops()) << "what is set for nodes does not last";
	}

	/// A pattern that is symmetric, values that are not, and pivots of both signs.
	Eigen::MatrixXd unsymmetric(int size, double filling, double largest, unsigned seed)
	{
		Random          random(seed);
		Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
		for (int c = 0; c < size; ++c) {
			for (int r = 0; r < c; ++r)
				if (random.in(0, 1) < filling) m(r, c) = random.in(-largest, largest), m(c, r) = random.in(-largest, largest);
			m(c, c) = c % 3 == 2 ? -2 : 2;
		}
		return m;
	}

	Csc whole(const Eigen::MatrixXd& full)
	{
		return gimpm::sparse<Csc>(full, [&](int r, int c) { return full(r, c) != 0; });
	}

	/// The last one is large enough for the BLAS.
	TEST(SignedFactor, SolvesWhatIsNotSymmetric)
	{
		for (const auto& [size, filling] : { std::pair(1, 0.), std::pair(2, 1.), std::pair(30, 0.3), std::pair(400, 0.02), std::pair(1100, 1.) }) {
			Eigen::MatrixXd       m = unsymmetric(size, filling, 5. / (20 + size * filling), size);
			const Eigen::VectorXd b = Random(5).vector(size);
			Csc                   K = whole(m);
			SupernodalFactor      factor;
			Eigen::VectorXd       x;
			factor.analyse(K, {}, 0, false);
			for (const double last : { 2., -3. }) {
				m(size - 1, size - 1) = K.value.back() = last;
				ASSERT_TRUE(factor.factoriseGeneral(K, 1e-10));
				ASSERT_TRUE(factor.solveSigned(b, x));
				EXPECT_LT((m * x - b).norm(), 1e-13 * (b.norm() + x.norm())) << size << ", " << last;
				ASSERT_TRUE(factor.solveSigned(b, x, true));
				EXPECT_LT((m.transpose() * x - b).norm(), 1e-13 * (b.norm() + x.norm())) << size << ", " << last;
			}
		}
	}

	TEST(SignedFactor, OfASymmetricMatrixIsTheSameFromAllOfItsEntries)
	{
		const Eigen::MatrixXd m = ofTwoFields(60, 1e-3, 4);
		const Csc             K = whole(m);
		SupernodalFactor      factor;
		Eigen::VectorXd       x, y, z;
		factor.analyse(K, inTheirOrder(K), 0, false);
		const Eigen::VectorXd b = Random(5).vector(m.rows());
		ASSERT_TRUE(factor.factoriseSigned(K, 1e-12) && factor.solveSigned(b, x));
		ASSERT_TRUE(factor.factoriseGeneral(K, 1e-12) && factor.solveSigned(b, y));
		ASSERT_TRUE(factor.factoriseSigned(K, 1e-12) && factor.solveSigned(b, z));
		EXPECT_LT((x - y).norm(), 1e-14 * x.norm());
		EXPECT_TRUE(x == z) << "nothing is left of the other kind";
	}

	/// Two blocks that only an entry below the diagonal joins.
	TEST(SignedFactor, RefusesAPatternThatIsNotSymmetric)
	{
		constexpr int   half        = 60;
		Eigen::MatrixXd m           = Eigen::MatrixXd::Zero(2 * half, 2 * half);
		m.topLeftCorner(half, half) = m.bottomRightCorner(half, half) = unsymmetric(half, 1., 0.02, 3);
		SupernodalFactor factor;
		factor.analyse(whole(m), {}, 0, false);
		ASSERT_TRUE(factor.factoriseGeneral(whole(m), 1e-10));
		m(2 * half - 1, 0) = 1;
		factor.analyse(whole(m), {}, 0, false);
		EXPECT_FALSE(factor.factoriseGeneral(whole(m), 1e-10));
	}

	TEST(SignedFactor, RefusesWhatNeedsPivoting)
	{
		Eigen::MatrixXd m(2, 2);
		m << 0, 1, 1, 0;
		SupernodalFactor factor;
		Csc              K = upper(m);
		factor.analyse(K, {}, 0, false);
		EXPECT_FALSE(factor.factoriseSigned(K, 1e-12));
		EXPECT_FALSE(factor.factoriseGeneral(whole(m), 1e-10));
		m << 1, 2, 2, 4; // singular
		K = upper(m);
		EXPECT_FALSE(factor.factoriseSigned(K, 1e-12));
		m(0, 0) = std::numeric_limits<double>::quiet_NaN();
		K       = upper(m);
		EXPECT_FALSE(factor.factoriseSigned(K, 1e-12));
	}

} // namespace
} // namespace gimpm
