// SPDX-License-Identifier: GPL-2.0-or-later
// Conjugate gradients with algebraic multigrid: what it is given, what it gains, when it is kept, and what happens
// where it fails or is not there.
#include "core/solvers/block_matrix.hpp"
#include "core/solvers/linear_solver.hpp"
#include "core/solvers/multigrid.hpp"
#include "springs.hpp"

namespace gimpm::testMultigrid {
namespace {

	using Status = LinearSolver::Status;

	/// Multigrid from another file, or the one that was built.
	struct From {
#ifdef MPM_PETSC
		static constexpr const char* built = MPM_PETSC;
#else
		static constexpr const char* built = "mpm_petsc.so";
#endif
		explicit From(const std::string& file) { Multigrid::openFrom(file); }
		~From() { Multigrid::openFrom(built); }
	};

	template <class Dimension> struct MultigridOf : InBothDimensions<Dimension> {
		static constexpr int Dim = Dimension::value;

		void SetUp() override { Multigrid::openFrom(From::built); }

		/// A long bar, for which the diagonal needs many iterations.
		static Springs<Dim> bar(int length = Dim == 2 ? 250 : 160)
		{
			Index<Dim> size = Index<Dim>::Constant(4);
			size[Dim - 1]   = length;
			return Springs<Dim>(size, 1);
		}
		static double error(const LinearProblem& K, const Eigen::VectorXd& b, const Eigen::VectorXd& x) { return (K * x - b).norm() / b.norm(); }
	};
	TYPED_TEST_SUITE(MultigridOf, BothDimensions, DimensionName);

#define REQUIRE_PETSC()                                                                                                                                        \
	if (const auto absence = Multigrid::absence(); !absence.empty()) GTEST_SKIP() << "without PETSc: " << absence

	template <int Dim> void expectSameMatrix(const Springs<Dim>& springs)
	{
		const LinearProblem   K(springs.K, springs.dofs);
		const NodeRows        rows  = *K.overNodes()->rows();
		const Eigen::MatrixXd all   = dense(K);
		Eigen::MatrixXd       found = Eigen::MatrixXd::Zero(rows.rows(), rows.rows());
		for (int r = 0; r < rows.rows(); ++r)
			for (int e = rows.start[r]; e < rows.start[r + 1]; ++e) {
				EXPECT_TRUE(e == rows.start[r] || rows.column[e] > rows.column[e - 1]);
				found(r, rows.column[e]) = rows.value[e];
			}
		for (int r = 0; r < rows.rows(); ++r)
			for (int c = 0; c < rows.rows(); ++c) {
				const int i = springs.dofs.number[rows.dof[r]], j = springs.dofs.number[rows.dof[c]];
				if (r == c && i < 0) continue;
				ASSERT_DOUBLE_EQ(found(r, c), i >= 0 && j >= 0 ? all(i, j) : 0) << r << ' ' << c;
			}
		for (const auto& held : rows.held) {
			EXPECT_LT(springs.dofs.number[rows.dof[held.row]], 0);
			EXPECT_EQ(found(held.row, held.row), held.diagonal);
			EXPECT_GT(held.diagonal, 0);
		}
		EXPECT_EQ(rows.rows(), springs.dofs.count + int(rows.held.size()));
		EXPECT_EQ(rows.position.empty(), springs.grid.isPeriodic());
		EXPECT_EQ(rows.rows() % Dim, 0);
	}

	TYPED_TEST(MultigridOf, RowsAreThoseOfTheMatrix)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    hole = [](const Index<Dim>& i) { return (i.array() == 2).all(); };
		for (const int reach : { 1, 2 }) {
			expectSameMatrix(Springs<Dim>(Index<Dim>::Constant(5), reach, hole));
			expectSameMatrix(Springs<Dim>(Index<Dim>::Constant(6), reach, hole, Index<Dim>::Unit(0) * 6));
			// Two springs between the same nodes.
			expectSameMatrix(Springs<Dim>(Index<Dim>::Constant(3), reach, hole, Index<Dim>::Unit(0) * 3));
		}
	}

	TYPED_TEST(MultigridOf, GetsToTheSolutionInFewIterations)
	{
		REQUIRE_PETSC();
		const auto            springs = this->bar();
		const LinearProblem   K(springs.K, springs.dofs);
		const Eigen::VectorXd b = Random(1).vector(K.size());
		Eigen::VectorXd       x, expected;
		LinearSolver          solver, diagonal, direct;
		ASSERT_EQ(solver.solve(K, b, x, LinearMethod::multigrid, 1e-10), Status::iterative) << solver.iterativeEffort().reason;
		ASSERT_NE(direct.solve(K, b, expected), Status::singular);
		EXPECT_LT(this->error(K, b, x), 1.1e-10);
		EXPECT_LT((x - expected).norm(), 1e-6 * expected.norm());
		EXPECT_EQ(solver.iterativeEffort().hierarchies, 1);
		EXPECT_GT(solver.times().factorise, 0);
		diagonal.solveIteratively(K, b, x, 1e-10);
		EXPECT_LT(10 * solver.iterativeEffort().iterations, diagonal.iterativeEffort().iterations);
	}

	TYPED_TEST(MultigridOf, IsTakenWhereTheDiagonalDoesNotGetThere)
	{
		REQUIRE_PETSC();
		const auto            springs = this->bar();
		const LinearProblem   K(springs.K, springs.dofs);
		const Eigen::VectorXd b = Random(1).vector(K.size());
		Eigen::VectorXd       x, y;
		LinearSolver          solver, diagonal;
		ASSERT_TRUE(solver.solveIteratively(K, b, x, 1e-8, LinearMethod::automatic));
		EXPECT_LT(this->error(K, b, x), 1.1e-8);
		EXPECT_EQ(solver.iterativeEffort().hierarchies, 1);
		EXPECT_GT(solver.iterativeEffort().iterations, 300);
		EXPECT_LT(solver.iterativeEffort().iterations, 350);
		ASSERT_TRUE(solver.solveIteratively(K, b, x, 1e-8, LinearMethod::automatic)) << "kept, and taken from the start";
		EXPECT_EQ(solver.iterativeEffort().hierarchies, 1);
		EXPECT_LT(solver.iterativeEffort().iterations, 400);
		const auto          longer = this->bar(170);
		const LinearProblem other(longer.K, longer.dofs);
		const int           before = solver.iterativeEffort().iterations;
		ASSERT_TRUE(solver.solveIteratively(other, Eigen::VectorXd::Ones(other.size()), x, 1e-8, LinearMethod::automatic))
		        << "made anew, without trying";
		EXPECT_EQ(solver.iterativeEffort().hierarchies, 2);
		EXPECT_LT(solver.iterativeEffort().iterations - before, 100);
		LinearSolver bent;
		ASSERT_TRUE(bent.solveIteratively(K, Eigen::VectorXd::Ones(K.size()), x, 1e-8, LinearMethod::automatic));
		EXPECT_GT(bent.iterativeEffort().iterations, 100);
		EXPECT_LT(bent.iterativeEffort().iterations, 150) << "where the residual grows, the diagonal is given up soon";
		ASSERT_TRUE(diagonal.solveIteratively(K, b, x, 1e-1, LinearMethod::automatic) && solver.solveIteratively(K, b, y, 1e-1));
		EXPECT_EQ(x, y) << "where the diagonal suffices, nothing changes";
	}

	TYPED_TEST(MultigridOf, ThreadsDoNotMatter)
	{
		REQUIRE_PETSC();
		expectSameInThreads<TypeParam::value>(1e-6, LinearMethod::multigrid);
	}

	TYPED_TEST(MultigridOf, IsRenewedWhereTheMatrixHasBecomeAnother)
	{
		REQUIRE_PETSC();
		constexpr int   Dim     = TypeParam::value;
		auto            springs = this->bar();
		LinearSolver    solver;
		Eigen::VectorXd x;
		const auto      solve = [&](const Springs<Dim>& s) {
                        const LinearProblem   K(s.K, s.dofs);
                        const Eigen::VectorXd b = Eigen::VectorXd::Ones(K.size());
                        EXPECT_TRUE(solver.solveIteratively(K, b, x, 1e-8, LinearMethod::multigrid));
                        EXPECT_LT(this->error(K, b, x), 1.1e-8);
		};
		solve(springs);
		auto scaled = springs;
		scaled.K.multiplyBy(1e3);
		solve(scaled);
		EXPECT_EQ(solver.iterativeEffort().hierarchies, 1) << "the same up to a factor";
		for (int a = 0; a < springs.K.nodes(); ++a)
			for (int c = 0; c < springs.K.codes; ++c)
				if (springs.K.used(a, c) && Grid<Dim>::index(springs.nodes[a])[Dim - 1] % 8 < 4
				    && Grid<Dim>::index(springs.nodes[a])[Dim - 1] > 4)
					for (int i = 0; i < Dim * Dim; ++i)
						springs.K.at(a, c)[i] *= c == 0 ? 1 : 1e-3; // layers that hardly hold together
		solve(springs);
		solve(springs);
		EXPECT_EQ(solver.iterativeEffort().hierarchies, 2);
	}

	TYPED_TEST(MultigridOf, FailuresHaveReasons)
	{
		REQUIRE_PETSC();
		auto                  springs = this->bar(20);
		Eigen::VectorXd       x;
		const Eigen::VectorXd b       = Eigen::VectorXd::Ones(springs.dofs.count);
		const auto            failure = [&](Springs<TypeParam::value> s, double first) {
                        s.K.at(s.K.nodes() / 2, 0)[0] = first;
                        const LinearProblem K(s.K, s.dofs);
                        LinearSolver        solver;
                        EXPECT_FALSE(solver.solveIteratively(K, b, x, 1e-8, LinearMethod::multigrid));
                        return solver.iterativeEffort().reason;
		};
		EXPECT_EQ(failure(springs, -1), "the matrix is not positive definite");
		EXPECT_NE(failure(springs, 1e-3), "") << "not as easy to see";
		EXPECT_NE(failure(springs, std::nan("")), "");
		springs.K.at(springs.K.nodes() / 2, 0)[0] = 1e-3;
		const LinearProblem K(springs.K, springs.dofs);
		LinearSolver        solver;
		EXPECT_EQ(solver.solve(K, b, x, LinearMethod::multigrid, 1e-8), Status::lu) << "solved all the same";
		EXPECT_LT(this->error(K, b, x), 1e-10);
		EXPECT_EQ(solver.iterativeEffort().fallbacks, 1);
	}

	TYPED_TEST(MultigridOf, AbsentItIsNamedAndDoneWithout)
	{
		const auto            springs = this->bar();
		const LinearProblem   K(springs.K, springs.dofs);
		const Eigen::VectorXd b = Random(1).vector(K.size());
		const From            nowhere("/nowhere/mpm_petsc.so");
		EXPECT_NE(Multigrid::absence().find("/nowhere/mpm_petsc.so"), std::string::npos);
		Eigen::VectorXd x, y;
		LinearSolver    solver, diagonal, demanding;
		ASSERT_TRUE(solver.solveIteratively(K, b, x, 1e-8, LinearMethod::automatic));
		ASSERT_TRUE(diagonal.solveIteratively(K, b, y, 1e-8));
		EXPECT_EQ(x, y);
		EXPECT_EQ(solver.iterativeEffort().iterations, diagonal.iterativeEffort().iterations);
		EXPECT_EQ(demanding.solve(K, b, x, LinearMethod::multigrid, 1e-8), Status::iterative);
		EXPECT_EQ(x, y) << "with the diagonal";
		EXPECT_EQ(demanding.iterativeEffort().reason.rfind("multigrid: ", 0), 0u) << demanding.iterativeEffort().reason;
	}

	TEST(Multigrid, AnotherLibraryIsNotTaken)
	{
		const From other("libm.so.6");
		EXPECT_NE(Multigrid::absence(), "");
	}

} // namespace
} // namespace gimpm::testMultigrid
