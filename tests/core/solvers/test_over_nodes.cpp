// SPDX-License-Identifier: GPL-2.0-or-later
// Operations on a matrix that belongs to nodes: products by blocks, conjugate gradients without compressing it,
// the size of its factor.
#include "core/solvers/block_matrix.hpp"
#include "core/solvers/dissection.hpp"
#include "core/solvers/linear_solver.hpp"
#include "springs.hpp"

namespace gimpm::testOverNodes {
namespace {

	template <class Dimension> using OverNodesOf = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(OverNodesOf, BothDimensions, DimensionName);

	template <int Dim> void expectSameProduct(const Springs<Dim>& springs)
	{
		const LinearProblem    K(springs.K, springs.dofs);
		const BlockMatrix<Dim> blocks(springs.K, springs.dofs);
		const Eigen::VectorXd  x = Random(1).vector(K.size());
		Eigen::VectorXd        y;
		blocks.multiply(K.overNodes()->expanded(x), y);
		EXPECT_LT((K.overNodes()->ofFreeDofs(y) - K * x).norm(), 1e-14 * y.norm());
		EXPECT_LT((K.overNodes()->expanded(K * x) - y).norm(), 1e-14 * y.norm()) << "held degrees of freedom";
		EXPECT_EQ(K.overNodes()->ofFreeDofs(blocks.diagonal()), dense(K).diagonal());
	}

	TYPED_TEST(OverNodesOf, BlocksMultiplyAsColumnsDo)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    hole = [](const Index<Dim>& i) { return (i.array() == 2).all(); };
		for (const int reach : { 1, 2 }) {
			expectSameProduct(Springs<Dim>(Index<Dim>::Constant(5), reach, hole));
			// Around.
			expectSameProduct(Springs<Dim>(Index<Dim>::Constant(6), reach, hole, Index<Dim>::Unit(0) * 6));
		}
		Index<Dim> slender = Index<Dim>::Constant(3);
		slender[Dim - 1]   = 40; // many slabs
		expectSameProduct(Springs<Dim>(slender, 1));
	}

	TYPED_TEST(OverNodesOf, ThreadsDoNotMatter) { expectSameInThreads<TypeParam::value>(1e-2, LinearMethod::iterative); }

	TYPED_TEST(OverNodesOf, ConjugateGradientsTakeTheSameIterations)
	{
		constexpr int         Dim = TypeParam::value;
		const Springs<Dim>    springs(Index<Dim>::Constant(Dim == 2 ? 40 : 10), 2);
		const LinearProblem   over(springs.K, springs.dofs), compressed = reduced(springs.K, springs.dofs);
		const Eigen::VectorXd b = Random(2).vector(over.size());
		Eigen::VectorXd       x, y;
		LinearSolver          one, other;
		EXPECT_EQ(one.solve(over, b, x, LinearMethod::iterative, 1e-9), LinearSolver::Status::iterative);
		EXPECT_EQ(other.solve(compressed, b, y, LinearMethod::iterative, 1e-9), LinearSolver::Status::iterative);
		EXPECT_NEAR(one.iterativeEffort().iterations, other.iterativeEffort().iterations, 1);
		EXPECT_LT((x - y).norm(), 1e-7 * y.norm());
	}

	/// Operations that the places of the nodes stand for, over those that the analysis of the matrix finds.
	template <int Dim> double estimateOverAnalysis(const Springs<Dim>& springs)
	{
		const LinearProblem K(springs.K, springs.dofs);
		LinearSolver        solver;
		const double        found = solver.analyse(reduced(springs.K, springs.dofs)).flops / double(K.stored().row.size());
		double              low = 0.01, high = 100;
		while (high / low > 1.01)
			(K.overNodes()->needsMoreFlopsPerEntry(std::sqrt(low * high) * found) ? low : high) = std::sqrt(low * high);
		return low;
	}

	TEST(Dissection, TellsTheSizeOfTheFactor)
	{
		const auto corner = [](const Index<3>& i) { return i[0] > 6 && i[1] > 6; };
		const auto range  = [](double ratio) { return ratio > 0.4 && ratio < 2; };
		EXPECT_PRED1(range, estimateOverAnalysis(Springs<3>({ 12, 12, 12 }, 1)));
		EXPECT_PRED1(range, estimateOverAnalysis(Springs<3>({ 9, 9, 9 }, 2)));
		EXPECT_PRED1(range, estimateOverAnalysis(Springs<3>({ 30, 6, 10 }, 1)));
		EXPECT_PRED1(range, estimateOverAnalysis(Springs<3>({ 16, 16, 10 }, 1, corner))) << "L-shaped";
		EXPECT_PRED1(range, estimateOverAnalysis(Springs<2>({ 60, 60 }, 1)));
		EXPECT_PRED1(range, estimateOverAnalysis(Springs<2>({ 150, 20 }, 2)));
	}

	TEST(Dissection, DecidesWithoutAnalysisWhereItIsBeyondDoubt)
	{
		LinearSolver     solver;
		const Springs<3> large({ 34, 34, 34 }, 1);
		EXPECT_TRUE(solver.prefersIterative(LinearProblem(large.K, large.dofs)));
		EXPECT_EQ(solver.times().analyse, 0);
		const Springs<3> small({ 10, 10, 10 }, 1);
		EXPECT_FALSE(solver.prefersIterative(LinearProblem(small.K, small.dofs)));
		EXPECT_GT(solver.times().analyse, 0);
	}

} // namespace
} // namespace gimpm::testOverNodes
