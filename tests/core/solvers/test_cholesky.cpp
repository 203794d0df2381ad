// SPDX-License-Identifier: GPL-2.0-or-later
// Cholesky's method in two halves against the whole.
#include "core/solvers/cholesky.hpp"
#include "core/solvers/linear_solver.hpp"
#include "core/solvers/reversed.hpp"
#include "springs.hpp"
#include <omp.h>

namespace gimpm::testCholesky {
namespace {

	template <class Dimension> using CholeskyOf = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(CholeskyOf, BothDimensions, DimensionName);

	/// Long, so that few nodes separate its halves.
	template <int Dim> Index<Dim> slender()
	{
		Index<Dim> size = Index<Dim>::Constant(Dim == 2 ? 32 : 6);
		size[0]         = 70;
		return size;
	}

	/// The matrix as Cholesky's method is given it, and the order.
	template <int Dim> struct Reversed {
		Csc   K;
		Order order;

		explicit Reversed(const Springs<Dim>& springs)
		{
			const LinearProblem problem(springs.K, springs.dofs);
			reverse(problem.stored(), K);
			scale(problem.stored(), K.value);
			order = problem.overNodes()->ordering();
			for (int& number : order.numbers)
				number = K.size() - 1 - number;
		}
		Order whole() const { return { order.numbers }; }
	};

	struct Solved {
		Eigen::VectorXd x;
		double          rcond, flops;

		Solved(const Csc& K, const Order& order, const Eigen::VectorXd& b)
		{
			Cholesky cholesky;
			cholesky.analyse(K, order);
			EXPECT_TRUE(cholesky.factorise(K));
			EXPECT_TRUE(cholesky.solve(b, x));
			rcond = cholesky.rcond(), flops = cholesky.flops();
		}
	};

	template <int Dim> void expectHalvesSolveAsTheWholeDoes(const Springs<Dim>& springs)
	{
		const Reversed<Dim>   matrix(springs);
		const Eigen::VectorXd b = Random(1).vector(matrix.K.size());
		const Solved          whole(matrix.K, matrix.whole(), b), halved(matrix.K, matrix.order, b);
		EXPECT_GT(matrix.order.first, 0);
		const auto parts = std::size_t(matrix.order.first + matrix.order.second);
		EXPECT_TRUE(parts == matrix.order.numbers.size() || whole.x != halved.x)
		        << "it was not halved"; // halves that nothing separates may be the same to the bit
		EXPECT_LT((whole.x - halved.x).norm(), 1e-12 * whole.x.norm());
		EXPECT_NEAR(halved.rcond / whole.rcond, 1, 0.9);
		EXPECT_NEAR(halved.flops / whole.flops, 1, 0.1);
		const int threads = omp_get_max_threads();
		for (const int n : { 1, 2 }) {
			omp_set_num_threads(n);
			EXPECT_EQ(Solved(matrix.K, matrix.order, b).x, halved.x) << n << " threads";
		}
		omp_set_num_threads(threads);
	}

	TYPED_TEST(CholeskyOf, HalvesSolveAsTheWholeDoes)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    size = slender<Dim>();
		expectHalvesSolveAsTheWholeDoes(Springs<Dim>(size, 1));
		expectHalvesSolveAsTheWholeDoes(Springs<Dim>(size, 1, [](const Index<Dim>& i) { return (i.array() == 3).all(); }));
		// Nothing has to separate them.
		expectHalvesSolveAsTheWholeDoes(Springs<Dim>(size, 1, [](const Index<Dim>& i) { return i[0] == 35; }));
		expectHalvesSolveAsTheWholeDoes(
		        Springs<Dim>(size, 1, [](const Index<Dim>& i) { return i[0] > 33 && i[0] < 37 && i[1] == 2; })); // parts of the separator apart
	}

	TYPED_TEST(CholeskyOf, HalvesRefuseWhatIsNotDefinite)
	{
		constexpr int   Dim = TypeParam::value;
		Reversed<Dim>   matrix(Springs<Dim>(slender<Dim>(), 1));
		auto&           K = matrix.K;
		Eigen::VectorXd x, b = Random(2).vector(K.size());
		Cholesky        cholesky;
		cholesky.analyse(K, matrix.order);
		const auto last = matrix.order.numbers.back(), first = matrix.order.numbers.front(), second = matrix.order.numbers[matrix.order.first];
		for (const int spoilt : { first, second, last }) { // column in either half, and in the separator
			double& diagonal = K.value[K.start[spoilt + 1] - 1];
			ASSERT_EQ(K.row[K.start[spoilt + 1] - 1], spoilt);
			const double before = std::exchange(diagonal, -diagonal);
			EXPECT_FALSE(cholesky.factorise(K)) << spoilt;
			diagonal = before;
			EXPECT_TRUE(cholesky.factorise(K) && cholesky.solve(b, x));
			EXPECT_EQ(x, Solved(K, matrix.order, b).x);
		}
	}

	// The separator is where it shows: halves with one held end each are definite, and so is each half with the
	// separator.
	TYPED_TEST(CholeskyOf, FreeBodiesAreSingularInHalves)
	{
		constexpr int         Dim = TypeParam::value;
		Springs<Dim>          springs(slender<Dim>(), 1);
		LinearSolver          solver;
		Eigen::VectorXd       x;
		const Eigen::VectorXd b = Random(3).vector(Dim * int(springs.nodes.size()));
		EXPECT_EQ(solver.solve(LinearProblem(springs.K, springs.dofs), b.head(springs.dofs.count), x), LinearSolver::Status::cholesky);
		springs.dofs.count = 0;
		for (int& number : springs.dofs.number)
			number = springs.dofs.count++;
		ASSERT_GE(springs.dofs.count, 4000) << "smaller ones are left to CHOLMOD";
		EXPECT_EQ(solver.solve(LinearProblem(springs.K, springs.dofs), b, x), LinearSolver::Status::singular);
	}

} // namespace
} // namespace gimpm::testCholesky
