// SPDX-License-Identifier: GPL-2.0-or-later
// Linear systems that are not symmetric: LU, what is singular, and GMRES.
#include "core/solvers/supernodal_factor.hpp"
#include "matrices.hpp"
#include <Eigen/LU>
#include <Eigen/SVD>

namespace gimpm::testGeneralMatrix {
namespace {

	using Status = LinearSolver::Status;

	/// The entries that are not zero on one side of the diagonal or the other, and the diagonal.
	GeneralCsc sparse(const Eigen::MatrixXd& full)
	{
		return gimpm::sparse<GeneralCsc>(full, [&](int r, int c) { return full(r, c) != 0 || full(c, r) != 0; });
	}

	/// Random matrix with a share of entries that are not zero.
	Eigen::MatrixXd random(int size, double filling, unsigned seed)
	{
		Random          numbers(seed);
		Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
		for (int c = 0; c < size; ++c)
			for (int r = 0; r < size; ++r)
				if (r == c || numbers.in(0, 1) < filling) m(r, c) = numbers.in(-1, 1);
		return m;
	}

	Eigen::MatrixXd dominant(int size, double filling, unsigned seed) { return withDominantDiagonal(random(size, filling, seed)); }

	/// Convection and diffusion on n^3 nodes.
	GeneralCsc convection(int n, double diagonal = 6)
	{
		GeneralCsc K;
		K.start = { 0 };
		for (int i = 0; i < n * n * n; ++i) {
			const auto add = [&](bool is, int row, double value) {
				if (is) K.row.push_back(row), K.value.push_back(value);
			};
			const int x = i % n, y = i / n % n, z = i / (n * n);
			add(z > 0, i - n * n, -0.6), add(y > 0, i - n, -0.7), add(x > 0, i - 1, -0.8);
			add(true, i, diagonal);
			add(x < n - 1, i + 1, -1.2), add(y < n - 1, i + n, -1.3), add(z < n - 1, i + n * n, -1.4);
			K.start.push_back(int(K.row.size()));
		}
		return K;
	}

	void expectSolves(LinearSolver& solver, const LinearProblem& K, double tolerance = 1e-12) { gimpm::expectSolves(solver, K, Status::lu, tolerance); }

	TEST(GeneralMatrix, IsSolvedByLu)
	{
		LinearSolver solver;
		for (const int size : { 1, 2, 10, 300 })
			expectSolves(solver, sparse(dominant(size, 0.1, size)));
		expectSolves(solver, sparse(random(80, 0.3, 4)), 1e-10);
		expectSolves(solver, convection(12));
		expectSolves(solver, convection(12, 3.3), 1e-9);
		// pivots off the diagonal
		expectSolves(solver, sparse((Eigen::MatrixXd(2, 2) << 0, 1, 2, 0).finished()));
		expectSolves(solver, sparse((Eigen::MatrixXd(3, 3) << 1e-20, 1, 0, 3, 1e-20, 1, 0, 1, 2).finished()));
	}

	TEST(GeneralMatrix, AgreesWithADenseSolution)
	{
		LinearSolver          solver;
		const Eigen::MatrixXd m = random(80, 0.3, 4);
		const Eigen::VectorXd b = Random(5).vector(80), c = Random(6).vector(80);
		Eigen::VectorXd       x;
		const auto            expect = [&](const Eigen::VectorXd& expected) { EXPECT_LT((x - expected).norm(), 1e-10 * x.norm()); };
		ASSERT_EQ(solver.solve(sparse(m), b, x), Status::lu);
		expect(m.partialPivLu().solve(b));
		ASSERT_TRUE(solver.solveAgain(c, x));
		expect(m.partialPivLu().solve(c));
		ASSERT_TRUE(solver.solveAgain(c, x, true));
		expect(m.transpose().partialPivLu().solve(c));
	}

	TEST(GeneralMatrix, ThatNeedsPivotsIsNoticedByItsResidual)
	{
		Eigen::MatrixXd m = random(60, 1, 6);
		m.diagonal().setConstant(1e-5);
		const Eigen::VectorXd b = Random(5).vector(60);
		Eigen::VectorXd       x;
		SupernodalFactor      withoutPivots;
		const auto            residual = [&](const Eigen::MatrixXd& of) { return (of * x - b).norm() / (b.norm() + x.norm()); };
		withoutPivots.analyse(sparse(m), {}, 0, false);
		ASSERT_TRUE(withoutPivots.factoriseGeneral(sparse(m), 1e-10) && withoutPivots.solveSigned(b, x));
		ASSERT_GT(residual(m), 1e-12) << "no pivot tells";
		LinearSolver solver;
		ASSERT_EQ(solver.solve(sparse(m), b, x), Status::lu);
		EXPECT_LT(residual(m), 1e-14);
		ASSERT_TRUE(solver.solveAgain(b, x, true));
		EXPECT_LT(residual(m.transpose()), 1e-14);
	}

	TEST(GeneralMatrix, WithSymmetricValuesHasTheSolutionOfTheSymmetricOne)
	{
		Eigen::MatrixXd m = dominant(60, 0.1, 7);
		m                 = (m + m.transpose()).eval();
		SymmetricCsc lower;
		lower.start = { 0 };
		for (int c = 0; c < 60; ++c) {
			for (int r = c; r < 60; ++r)
				lower.row.push_back(r), lower.value.push_back(m(r, c));
			lower.start.push_back(int(lower.row.size()));
		}
		LinearSolver          solver;
		const Eigen::VectorXd b = Random(5).vector(60);
		Eigen::VectorXd       x, y;
		ASSERT_EQ(solver.solve(lower, b, x), Status::cholesky);
		ASSERT_EQ(solver.solve(bothTriangles(lower), b, y), Status::lu);
		EXPECT_LT((x - y).norm(), 1e-13 * x.norm());
	}

	TEST(GeneralMatrix, ThatIsSingularIsFound)
	{
		LinearSolver    solver;
		Eigen::VectorXd x;
		// columns that sum up to zero, a zero row, a zero matrix, a row three times, a row twice but for
		// round-off
		Eigen::MatrixXd closed = dominant(6, 0.5, 1), empty = dominant(5, 1, 1);
		closed.row(2) -= closed.colwise().sum();
		empty.row(2).setZero();
		const Eigen::MatrixXd thrice = Eigen::Vector3d(1, 2, 3) * Eigen::RowVector3d(1, 0.5, 4);
		const Eigen::MatrixXd twice  = (Eigen::MatrixXd(2, 2) << 1, 3, 2, 6 + 4 * precision).finished();
		for (const auto& m : { closed, empty, Eigen::MatrixXd(Eigen::MatrixXd::Zero(3, 3)), thrice, twice })
			EXPECT_EQ(solver.solve(sparse(m), Eigen::VectorXd::Ones(m.rows()), x), Status::singular) << m;
		for (const double bad : { std::nan(""), infinity }) {
			auto K      = sparse(dominant(20, 0.3, 1));
			K.value[30] = bad;
			EXPECT_EQ(solver.solve(K, Eigen::VectorXd::Ones(20), x), Status::singular) << bad;
			EXPECT_EQ(solver.solve(K, Eigen::VectorXd::Ones(20), x, LinearMethod::iterative, 1e-6), Status::singular) << bad;
		}
		expectSolves(solver, sparse(dominant(20, 0.3, 1)));
	}

	TEST(GeneralMatrix, IsSolvedWhateverItsUnits)
	{
		LinearSolver solver;
		for (const double unit : { 1e-150, 1e-30, 1e30, 1e150 })
			expectSolves(solver, sparse(unit * random(40, 0.3, 4)), 1e-10);
		// Scale of rows and columns: nodes that are hardly touched, whose displacements may be large for that.
		const Eigen::VectorXd scale = Eigen::VectorXd::NullaryExpr(40, [](Eigen::Index i) { return std::pow(10., -double(i % 12)); });
		const Eigen::MatrixXd m     = scale.asDiagonal() * dominant(40, 0.2, 4) * scale.asDiagonal();
		const Eigen::VectorXd x     = Random(3).vector(40);
		Eigen::VectorXd       found;
		ASSERT_EQ(solver.solve(sparse(m), m * x, found), Status::lu);
		EXPECT_LT(scale.cwiseProduct(found - x).norm(), 1e-13);
	}

	TEST(GeneralMatrix, HasTheSameSolutionWhateverWasSolvedBefore)
	{
		const auto            K = convection(12);
		const Eigen::VectorXd b = Random(7).vector(K.size());
		Eigen::VectorXd       expected, x;
		ASSERT_EQ(LinearSolver().solve(K, b, expected), Status::lu);
		LinearSolver solver;
		const auto   expectSame = [&](const char* after) {
                        ASSERT_EQ(solver.solve(K, b, x), Status::lu);
                        EXPECT_TRUE(x == expected) << after;
		};
		auto other = K;
		for (double& v : other.value)
			v *= v;
		solver.solve(other, b, x);
		expectSame("after other values");
		other.value.assign(other.value.size(), 0);
		EXPECT_EQ(solver.solve(other, b, x), Status::singular);
		expectSame("after a singular matrix");
		SymmetricCsc definite { { { 0, 2, 3 }, { 0, 1, 1 }, { 2, 1, 2 } } }, indefinite = definite;
		indefinite.value[1] = 5;
		EXPECT_EQ(solver.solve(definite, Eigen::VectorXd::Ones(2), x), Status::cholesky);
		expectSame("after a symmetric matrix");
		EXPECT_EQ(solver.solve(indefinite, Eigen::VectorXd::Ones(2), x), Status::lu);
		EXPECT_LT((x - Eigen::VectorXd::Constant(2, 1. / 7)).norm(), 1e-14);
		ASSERT_TRUE(solver.solveAgain(Eigen::Vector2d(0, 21), x));
		EXPECT_LT((x - Eigen::Vector2d(5, -2)).norm(), 1e-13);
		expectSame("after an indefinite one");
	}

	TEST(GeneralMatrix, IsAnalysedOnce)
	{
		LinearSolver    solver;
		const auto      K = convection(12);
		Eigen::VectorXd x;
		solver.solve(K, Eigen::VectorXd::Ones(K.size()), x);
		EXPECT_GT(solver.times().analyse, 0);
		solver.resetTimes();
		solver.solve(K, Eigen::VectorXd::Ones(K.size()), x);
		EXPECT_EQ(solver.times().analyse, 0);
		EXPECT_GT(solver.times().factorise, 0);
		EXPECT_GT(solver.times().solve, 0);
	}

	TEST(GeneralMatrix, IsSolvedIterativelyToTheTolerance)
	{
		LinearSolver          solver;
		const auto            K = convection(12);
		const Eigen::VectorXd b = Random(7).vector(K.size());
		Eigen::VectorXd       x;
		for (const double tolerance : { 1e-2, 1e-6, 1e-10 }) {
			const int before = solver.iterativeEffort().iterations;
			ASSERT_EQ(solver.solve(K, b, x, LinearMethod::iterative, tolerance), Status::iterative);
			const double residual = (K * x - b).norm() / b.norm();
			EXPECT_LE(residual, 1.01 * tolerance);
			EXPECT_GT(residual, 1e-3 * tolerance) << "more iterations than asked for";
			EXPECT_GT(solver.iterativeEffort().iterations, before);
		}
		EXPECT_EQ(solver.iterativeEffort().fallbacks, 0);
		ASSERT_EQ(solver.solve(convection(3), Eigen::VectorXd::Zero(27), x, LinearMethod::iterative, 1e-6), Status::iterative);
		EXPECT_EQ(x, Eigen::VectorXd::Zero(27));
		for (const int size : { 1, 2, 3 }) {
			const auto small = dominant(size, 1, size);
			ASSERT_EQ(solver.solve(sparse(small), Eigen::VectorXd::Ones(size), x, LinearMethod::iterative, 1e-10), Status::iterative);
			EXPECT_LT((small * x).cwiseAbs().maxCoeff() - 1, 1e-10);
		}
	}

	TEST(GeneralMatrix, UnitsDoNotMatterToGmres)
	{
		LinearSolver          solver;
		const auto            m = dominant(40, 0.2, 1);
		const Eigen::VectorXd b = Random(5).vector(40);
		Eigen::VectorXd       x, expected = m.partialPivLu().solve(b);
		for (const double unit : { 1e-200, 1., 1e200 }) {
			ASSERT_EQ(solver.solve(sparse(unit * m), unit * b, x, LinearMethod::iterative, 1e-10), Status::iterative);
			EXPECT_LT((x - expected).norm(), 1e-8 * expected.norm()) << unit;
		}
	}

	TEST(GeneralMatrix, IsLeftToTheDirectSolverWhereGmresFails)
	{
		LinearSolver    solver;
		Eigen::VectorXd x;
		// nothing on the diagonal; and a shift by one node, which every Krylov space sees too late, with a
		// diagonal too small to help
		ASSERT_EQ(
		        solver.solve(sparse((Eigen::MatrixXd(2, 2) << 0, 1, 2, 0).finished()), Eigen::Vector2d(3, 4), x, LinearMethod::iterative, 1e-6),
		        Status::lu);
		EXPECT_LT((x - Eigen::Vector2d(2, 3)).norm(), 1e-15);
		EXPECT_EQ(solver.iterativeEffort().fallbacks, 1);
		const int             n = 400;
		const Eigen::MatrixXd m = random(n, 0.02, 3);
		const Eigen::VectorXd b = Random(4).vector(n);
		ASSERT_EQ(solver.solve(sparse(m), b, x, LinearMethod::iterative, 1e-10), Status::lu);
		EXPECT_LT((m * x - b).norm(), 1e-10 * b.norm());
		EXPECT_EQ(solver.iterativeEffort().fallbacks, 2);
	}

	TEST(GeneralMatrix, IsSolvedByWhatTheSizeOfTheFactorSuggests)
	{
		LinearSolver    solver;
		Eigen::VectorXd x;
		const auto      small = convection(12), large = convection(30);
		EXPECT_FALSE(solver.prefersIterative(small));
		EXPECT_TRUE(solver.prefersIterative(large));
		EXPECT_EQ(solver.times().factorise, 0);
		EXPECT_EQ(solver.solve(small, Eigen::VectorXd::Ones(small.size()), x, LinearMethod::automatic, 1e-6), Status::lu);
		EXPECT_EQ(solver.iterativeEffort().iterations, 0);
		EXPECT_EQ(solver.solve(large, Eigen::VectorXd::Ones(large.size()), x, LinearMethod::automatic, 1e-6), Status::iterative);
	}

	TEST(GeneralMatrix, PrintsNothing)
	{
		LinearSolver    solver;
		Eigen::VectorXd x;
		testing::internal::CaptureStdout();
		testing::internal::CaptureStderr();
		solver.solve(convection(12), Eigen::VectorXd::Ones(1728), x);
		solver.solve(sparse(Eigen::MatrixXd::Zero(3, 3)), Eigen::VectorXd::Ones(3), x);
		solver.solve(sparse(Eigen::MatrixXd::Constant(3, 3, std::nan(""))), Eigen::VectorXd::Ones(3), x);
		EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
		EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
	}

	TEST(GeneralMatrix, HasTheConditionOfItsSingularValues)
	{
		EXPECT_NEAR(conditionNumber(sparse((Eigen::MatrixXd(2, 2) << 0, 2, -8, 0).finished())), 4, 1e-14);
		const Eigen::MatrixXd m     = random(200, 0.1, 8);
		const Eigen::VectorXd s     = Eigen::JacobiSVD<Eigen::MatrixXd>(m).singularValues();
		const double          exact = s[0] / s[199];
		EXPECT_NEAR(conditionNumber(sparse(m)) / exact, 1, 1e-9);
		EXPECT_NEAR(conditionEstimate(sparse(m)) / exact, 1, 0.05);
		EXPECT_EQ(conditionEstimate(sparse(Eigen::MatrixXd::Zero(3, 3))), infinity);
	}

} // namespace
} // namespace gimpm::testGeneralMatrix
