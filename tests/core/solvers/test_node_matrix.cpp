// SPDX-License-Identifier: GPL-2.0-or-later
// The matrix over the nodes, symmetric or not: products and reduction against a dense one.
#include "core/solvers/reduce.hpp"
#include "matrices.hpp"

namespace gimpm::testNodeMatrix {
namespace {

	/// Random blocks between the nodes of a grid with gaps, and the same in a dense matrix.
	template <int Dim> struct RandomMatrix {
		Random           random;
		std::vector<Key> nodes;
		NodeMatrix<Dim>  K;
		Eigen::MatrixXd  full;

		RandomMatrix(unsigned seed, bool isSymmetric) : random(seed)
		{
			forIndices<Dim>(Index<Dim>::Constant(-2), Index<Dim>::Constant(Dim == 2 ? 5 : 4), [&](const Index<Dim>& i) {
				if (random.in(0, 1) < 0.8) nodes.push_back(Grid<Dim>::key(i));
			});
			K.reset(nodes, isSymmetric);
			full = Eigen::MatrixXd::Zero(Dim * K.nodes(), Dim * K.nodes());
			forPairs([&](int a, int b, int code) { addSymmetric(a, b, code); });
		}
		/// Some of the pairs a <= b.
		template <class F> void forPairs(F&& f)
		{
			for (int a = 0; a < K.nodes(); ++a)
				for (int code = 0; code < NodeMatrix<Dim>::codes; ++code)
					if (const int b = K.neighbour(a, code); b >= 0 && (b == a || random.in(0, 1) < 0.4)) f(a, b, code);
		}
		/// Adds a block as a term does that knows of nothing else.
		void addSymmetric(int a, int b, int code)
		{
			Mat<Dim> block = random.matrix<Dim, Dim>();
			if (a == b) block = (block + block.transpose()).eval();
			K.markUsed(a, code);
			for (int i = 0; i < Dim; ++i)
				for (int j = 0; j < Dim; ++j)
					K.at(a, code)[i * Dim + j] += block(i, j);
			full.block<Dim, Dim>(Dim * a, Dim * b) += block;
			if (a != b) full.block<Dim, Dim>(Dim * b, Dim * a) += block.transpose();
		}
		/// Given the one or the other first.
		void addUnsymmetric()
		{
			forPairs([&](int a, int b, int code) {
				const Mat<Dim> ab = random.matrix<Dim, Dim>(), ba = random.matrix<Dim, Dim>();
				K.markUsed(a, code);
				const bool isFirst = random.in(0, 1) < 0.5;
				if (isFirst) K.add(a, b, code, ab);
				if (a != b) K.add(b, a, -code, ba);
				if (!isFirst) K.add(a, b, code, ab);
				full.block<Dim, Dim>(Dim * a, Dim * b) += ab;
				if (a != b) full.block<Dim, Dim>(Dim * b, Dim * a) += ba;
			});
		}
		/// All but some, and the columns and rows of the dense matrix that are left.
		FreeDofs hold(Eigen::MatrixXd& rest)
		{
			FreeDofs         dofs;
			std::vector<int> free;
			for (int i = 0; i < Dim * K.nodes(); ++i) {
				const bool isFree = random.in(0, 1) < 0.7;
				dofs.number.push_back(isFree ? dofs.count++ : -1);
				if (isFree) free.push_back(i);
			}
			rest = principalPart(full, free);
			return dofs;
		}
	};

	template <class Dimension> using NodeMatrixOf = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(NodeMatrixOf, BothDimensions, DimensionName);

	TYPED_TEST(NodeMatrixOf, BlocksMultiplyAsADenseMatrix)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool isSymmetric : { true, false }) {
			RandomMatrix<Dim> m(1, isSymmetric);
			if (!isSymmetric) m.addUnsymmetric(), m.addUnsymmetric();
			EXPECT_EQ(m.K.isSymmetric(), isSymmetric);
			const Eigen::VectorXd x = m.random.vector(int(m.full.cols())), y = m.random.vector(int(m.full.cols()));
			Eigen::VectorXd       sum = y;
			m.K.multiplyAdd(x, sum);
			EXPECT_LT((sum - y - m.full * x).norm(), 1e-13 * sum.norm());
			EXPECT_EQ((m.full - m.full.transpose()).isZero(1e-13), isSymmetric);
			m.K.setZero();
			m.K.multiplyAdd(x, sum = y);
			EXPECT_EQ(sum, y);
		}
	}

	TYPED_TEST(NodeMatrixOf, IsReducedToTheFreeRowsAndColumns)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool isSymmetric : { true, false }) {
			RandomMatrix<Dim> m(2, isSymmetric);
			if (!isSymmetric) m.addUnsymmetric();
			Eigen::MatrixXd       rest;
			const FreeDofs        dofs = m.hold(rest);
			const LinearProblem   K    = reduced(m.K, dofs);
			const Eigen::VectorXd x    = m.random.vector(dofs.count);
			ASSERT_EQ(K.isSymmetric(), isSymmetric);
			ASSERT_EQ(K.size(), dofs.count);
			EXPECT_LT((dense(K) - rest).cwiseAbs().maxCoeff(), 1e-14);
			EXPECT_LT((K * x - rest * x).norm(), 1e-13 * x.norm());
			if (!isSymmetric) {
				EXPECT_LT((K.general().transposedTimes(x) - rest.transpose() * x).norm(), 1e-13 * x.norm());
			}
			for (int c = 0; c < K.size(); ++c)
				for (int e = K.stored().start[c] + 1; e < K.stored().start[c + 1]; ++e)
					ASSERT_LT(K.stored().row[e - 1], K.stored().row[e]);
		}
	}

	TYPED_TEST(NodeMatrixOf, HasTheSameTriangleInBothForms)
	{
		constexpr int     Dim = TypeParam::value;
		RandomMatrix<Dim> symmetric(3, true), general(3, false);
		Eigen::MatrixXd   rest;
		const FreeDofs    dofs = symmetric.hold(rest);
		const auto        a = reduced(symmetric.K, dofs), b = reduced(general.K, dofs);
		const GeneralCsc  both = bothTriangles(a.symmetric());
		EXPECT_EQ(both.start, b.general().start);
		EXPECT_EQ(both.row, b.general().row);
		EXPECT_EQ(both.value, b.general().value);
		SymmetricCsc upper; // upper triangle of the matrix in the opposite order
		for (int c = a.size(); c >= 0; --c)
			upper.start.push_back(int(a.stored().row.size()) - a.stored().start[c]);
		upper.value.assign(a.stored().value.rbegin(), a.stored().value.rend());
		for (auto r = a.stored().row.rbegin(); r != a.stored().row.rend(); ++r)
			upper.row.push_back(a.size() - 1 - *r);
		EXPECT_EQ(dense(LinearProblem(bothTriangles(upper))).reverse(), dense(a));
	}

	TYPED_TEST(NodeMatrixOf, NothingHasNoEntries)
	{
		constexpr int   Dim = TypeParam::value;
		NodeMatrix<Dim> K;
		for (const bool isSymmetric : { true, false }) {
			K.reset({}, isSymmetric);
			EXPECT_EQ(reduced(K, {}).size(), 0);
			EXPECT_EQ(reduced(K, {}).isSymmetric(), isSymmetric);
		}
	}

} // namespace
} // namespace gimpm::testNodeMatrix
