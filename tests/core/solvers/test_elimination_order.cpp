// SPDX-License-Identifier: GPL-2.0-or-later
// The order in which nodes are eliminated: of all unknowns, with a factor that is no larger than those of other orders,
// and the same solutions.
#include "core/solvers/linear_solver.hpp"
#include "springs.hpp"
#include <numeric>

namespace gimpm::testEliminationOrder {
namespace {

	template <class Dimension> using EliminationOrderOf = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(EliminationOrderOf, BothDimensions, DimensionName);

	template <int Dim> void expectEachUnknownOnce(const Springs<Dim>& springs)
	{
		std::vector<int> order = LinearProblem(springs.K, springs.dofs).overNodes()->ordering().numbers, all(order.size());
		ASSERT_EQ(int(order.size()), springs.dofs.count);
		std::iota(all.begin(), all.end(), 0);
		std::sort(order.begin(), order.end());
		EXPECT_EQ(order, all);
	}

	/// The separator parts the others: no entry of K is in a row of the one part and a column of the other.
	template <int Dim> void expectParted(const Springs<Dim>& springs)
	{
		const LinearProblem K(springs.K, springs.dofs);
		const Order         order = K.overNodes()->ordering();
		std::vector<int>    part(K.size(), 0);
		for (int i = 0; i < order.first + order.second; ++i)
			part[order.numbers[i]] = i < order.first ? 1 : 2;
		EXPECT_GT(std::min(order.first, order.second), K.size() / 5 - Dim * 20);
		K.forEntries([&](int row, int column, double) { ASSERT_NE(part[row] + part[column], 3); });
	}

	TYPED_TEST(EliminationOrderOf, HasEachUnknownOnce)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    hole = [](const Index<Dim>& i) { return (i.array() == 2).all(); };
		for (const int reach : { 1, 2 }) {
			expectEachUnknownOnce(Springs<Dim>(Index<Dim>::Constant(2), reach));
			expectEachUnknownOnce(Springs<Dim>(Index<Dim>::Constant(9), reach, hole));
			// Around.
			expectEachUnknownOnce(Springs<Dim>(Index<Dim>::Constant(9), reach, hole, Index<Dim>::Unit(0) * 9));
			expectParted(Springs<Dim>(Index<Dim>::Constant(20 - 5 * Dim), reach, hole));
		}
	}

	/// Operations of the factor over those in the order that CHOLMOD finds, which knows nothing of nodes in a
	/// matrix that is compressed.
	template <int Dim> double flopsOverThoseOfCholmod(const Springs<Dim>& springs)
	{
		LinearSolver one, other;
		EXPECT_GE(springs.dofs.count, 4000) << "smaller ones are left to CHOLMOD";
		return one.analyse(LinearProblem(springs.K, springs.dofs)).flops / other.analyse(reduced(springs.K, springs.dofs)).flops;
	}

	TEST(EliminationOrder, KeepsTheFactorAsSmallAsCholmodDoes)
	{
		constexpr double atMost = 1.2; // 0.72 to 1.11 are found
		const auto       slope  = [](const auto& i) { return i[0] > 40 && i[1] > 30 - i[0] / 4; };
		EXPECT_LT(flopsOverThoseOfCholmod(Springs<2>({ 60, 60 }, 1)), atMost);
		EXPECT_LT(flopsOverThoseOfCholmod(Springs<2>({ 100, 40 }, 2, slope)), atMost);
		EXPECT_LT(flopsOverThoseOfCholmod(Springs<3>({ 14, 14, 14 }, 1)), atMost);
		EXPECT_LT(flopsOverThoseOfCholmod(Springs<3>({ 50, 20, 3 }, 2, slope)), atMost);
	}

	TYPED_TEST(EliminationOrderOf, SolutionsAreTheSameToRoundOff)
	{
		constexpr int Dim    = TypeParam::value;
		const auto    hole   = [](const Index<Dim>& i) { return (i.array() > 5 && i.array() < 8).all(); };
		const auto    expect = [](const LinearProblem& over, const LinearProblem& compressed, LinearSolver::Status expected) {
                        const Eigen::VectorXd b = Random(3).vector(over.size());
                        Eigen::VectorXd       x, y;
                        LinearSolver          one, other;
                        ASSERT_EQ(one.solve(over, b, x), expected);
                        ASSERT_EQ(other.solve(compressed, b, y), expected);
                        EXPECT_LT((x - y).norm(), 1e-12 * y.norm());
                        EXPECT_NE(x, y) << "the order was not another";
		};
		Springs<Dim> springs(Index<Dim>::Constant(Dim == 2 ? 60 : 13), 1, hole);
		expect(LinearProblem(springs.K, springs.dofs), reduced(springs.K, springs.dofs), LinearSolver::Status::cholesky);
		NodeMatrix<Dim> skew; // the same, and a tenth is missing on one side of the diagonal
		skew.reset(springs.nodes, false, springs.grid);
		for (int a = 0; a < skew.nodes(); ++a)
			for (int c = 0; c < skew.codes; ++c) {
				if (!springs.K.used(a, c)) continue;
				skew.markUsed(a, c);
				const int                                                                b = skew.neighbour(a, c);
				const Eigen::Map<const Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>> k(springs.K.at(a, c));
				skew.add(a, b, c, k);
				if (c > 0) skew.add(b, a, -c, 0.9 * k.transpose());
			}
		expect(LinearProblem(skew, springs.dofs), reduced(skew, springs.dofs), LinearSolver::Status::lu);
	}

} // namespace
} // namespace gimpm::testEliminationOrder
