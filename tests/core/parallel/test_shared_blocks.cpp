// SPDX-License-Identifier: GPL-2.0-or-later
// A symmetric matrix of which several processes have the rows of their nodes: threads stand for the processes.
#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/shared_blocks.hpp"
#include "springs.hpp"
#include "threads_as_processes.hpp"

namespace gimpm::testSharedBlocks {
namespace {

	/// The rows and columns of the own nodes, as a process has them; of the rest not even the memory.
	template <int Dim> NodeMatrix<Dim> ownPart(const Springs<Dim>& springs, const OwnedNodes& ownedNodes)
	{
		NodeMatrix<Dim> K;
		K.reset(springs.nodes, true, springs.grid, { ownedNodes.first(), ownedNodes.last() });
		for (int a = 0; a < K.nodes(); ++a)
			for (int c = 0; c < K.codes; ++c) {
				if (!springs.K.used(a, c)) continue;
				K.markUsed(a, c);
				EXPECT_TRUE(K.keeps(a) || !(ownedNodes.owns(a) || ownedNodes.owns(K.neighbour(a, c))));
				if (K.keeps(a)) std::copy_n(springs.K.at(a, c), K.block, K.at(a, c));
			}
		return K;
	}

	/// Calls f(share, matrix) for each of three processes, of which the first one has no nodes.
	template <int Dim, class F> void forProcesses(const Springs<Dim>& springs, F&& f)
	{
		const int nodes = springs.K.nodes();
		inThreads(3, [&](const std::shared_ptr<const Processes>& process) {
			const OwnedNodes ownedNodes { *process, { 0, 0, nodes / 3, nodes } };
			const auto       part = ownPart(springs, ownedNodes);
			f(ownedNodes, SharedBlocks<Dim>(part, springs.dofs, ownedNodes));
		});
	}

	template <class Dimension> struct SharedBlocksOf : InBothDimensions<Dimension> {
		static constexpr int Dim = Dimension::value;

		static Springs<Dim> springs(int size, int period)
		{
			const auto hole = [](const Index<Dim>& i) { return (i.array() == 2).all(); };
			return Springs<Dim>(Index<Dim>::Constant(period ? period : size), 2, hole, Index<Dim>::Unit(Dim - 1) * period);
		}
	};
	TYPED_TEST_SUITE(SharedBlocksOf, BothDimensions, DimensionName);

	TYPED_TEST(SharedBlocksOf, MultiplyAsInOneProcess)
	{
		constexpr int Dim = TypeParam::value;
		for (const int period : { 0, 3, 6 }) {
			const auto             springs = TestFixture::springs(6, period);
			const BlockMatrix<Dim> whole(springs.K, springs.dofs);
			Eigen::VectorXd        x = Random(1).vector(Dim * springs.K.nodes()), y, diagonal = whole.diagonal(), found = x, foundDiagonal = x;
			whole.multiply(x, y);
			forProcesses(springs, [&](const OwnedNodes& ownedNodes, const SharedBlocks<Dim>& K) {
				const Eigen::VectorXd own = ownedNodes.own(x);
				Eigen::VectorXd       product;
				K.multiply(own, product);
				ownedNodes.own(found)         = product;
				ownedNodes.own(foundDiagonal) = K.diagonal();
				EXPECT_NEAR(K.norm(own), x.norm(), 1e-14 * x.norm());
				double sums[] = { 1, double(own.size()) };
				K.complete(sums, 2);
				EXPECT_EQ(sums[0], 3);
				EXPECT_EQ(sums[1], double(x.size()));
			});
			EXPECT_LT((found - y).norm(), 1e-15 * y.norm()) << period;
			EXPECT_EQ(foundDiagonal, diagonal);
		}
	}

	TYPED_TEST(SharedBlocksOf, ConjugateGradientsDoTheSame)
	{
		constexpr int          Dim     = TypeParam::value;
		const auto             springs = TestFixture::springs(Dim == 2 ? 30 : 10, 0);
		const BlockMatrix<Dim> whole(springs.K, springs.dofs);
		Eigen::VectorXd        b = Random(1).vector(Dim * springs.K.nodes()), x, found = b;
		for (int i = 0; i < b.size(); ++i)
			if (springs.dofs.number[i] < 0) b[i] = 0;
		ConjugateGradients alone(whole, b, 1e-10);
		alone.iterate(mostIterations);
		ASSERT_EQ(alone.take(x), "");
		forProcesses(springs, [&](const OwnedNodes& ownedNodes, const SharedBlocks<Dim>& K) {
			ConjugateGradients together(K, ownedNodes.own(b), 1e-10);
			together.iterate(mostIterations);
			Eigen::VectorXd own;
			EXPECT_EQ(together.take(own), "");
			EXPECT_NEAR(together.made(), alone.made(), 1);
			ownedNodes.own(found) = own;
		});
		EXPECT_LT((found - x).norm(), 1e-9 * x.norm());
	}

	TYPED_TEST(SharedBlocksOf, WhatOneProcessFindsStopsAll)
	{
		constexpr int         Dim                 = TypeParam::value;
		auto                  springs             = TestFixture::springs(6, 0);
		const Eigen::VectorXd b                   = Eigen::VectorXd::Ones(Dim * springs.K.nodes());
		springs.K.at(springs.K.nodes() - 1, 0)[0] = -1; // block of the last one
		forProcesses(springs, [&](const OwnedNodes& ownedNodes, const SharedBlocks<Dim>& K) {
			Eigen::VectorXd    all = b, x;
			ConjugateGradients together(K, ownedNodes.own(all), 1e-10);
			EXPECT_TRUE(together.hasBrokenDown());
			EXPECT_EQ(together.take(x), "the matrix is not positive definite");
		});
	}

} // namespace
} // namespace gimpm::testSharedBlocks
