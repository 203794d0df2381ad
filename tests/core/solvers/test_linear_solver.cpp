// SPDX-License-Identifier: GPL-2.0-or-later
// Cholesky, its fallback to LU, what is singular, and conjugate gradients.
#include "matrices.hpp"
#include <Eigen/LU>

namespace gimpm {
namespace {

	using Status = LinearSolver::Status;

	/// The entries of the lower triangle that are not zero, and the whole diagonal.
	SymmetricCsc sparse(const Eigen::MatrixXd& full)
	{
		return gimpm::sparse<SymmetricCsc>(full, [&](int r, int c) { return r > c && full(r, c) != 0; });
	}

	/// Random symmetric matrix with a share of entries that are not zero.
	Eigen::MatrixXd symmetric(int size, double filling, unsigned seed)
	{
		Random          random(seed);
		Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size, size);
		for (int c = 0; c < size; ++c)
			for (int r = c; r < size; ++r)
				if (r == c || random.in(0, 1) < filling) m(r, c) = m(c, r) = random.in(-1, 1);
		return m;
	}

	Eigen::MatrixXd definite(int size, double filling, unsigned seed) { return withDominantDiagonal(symmetric(size, filling, seed)); }

	/// Laplace's difference operator on n^3 nodes: large enough for a supernodal factorisation.
	SymmetricCsc laplace(int n, double diagonal)
	{
		SymmetricCsc K;
		K.start = { 0 };
		for (int i = 0; i < n * n * n; ++i) {
			K.row.push_back(i), K.value.push_back(diagonal);
			if (i % n < n - 1) K.row.push_back(i + 1), K.value.push_back(-1);
			if (i / n % n < n - 1) K.row.push_back(i + n), K.value.push_back(-1);
			if (i / (n * n) < n - 1) K.row.push_back(i + n * n), K.value.push_back(-1);
			K.start.push_back(int(K.row.size()));
		}
		return K;
	}

	TEST(LinearSolver, SolvesDefiniteMatricesByCholesky)
	{
		LinearSolver solver;
		for (const int size : { 1, 2, 10, 300 })
			expectSolves(solver, sparse(definite(size, 0.1, size)), Status::cholesky);
		expectSolves(solver, laplace(12, 6), Status::cholesky); // supernodal
	}

	TEST(LinearSolver, AgreesWithADenseSolution)
	{
		LinearSolver          solver;
		const Eigen::MatrixXd m = definite(80, 0.2, 3), indefinite = symmetric(80, 0.3, 4);
		const Eigen::VectorXd b = Random(5).vector(80);
		Eigen::VectorXd       x;
		ASSERT_EQ(solver.solve(sparse(m), b, x), Status::cholesky);
		EXPECT_LT((x - m.partialPivLu().solve(b)).norm(), 1e-13 * x.norm());
		ASSERT_EQ(solver.solve(sparse(indefinite), b, x), Status::lu);
		EXPECT_LT((x - indefinite.partialPivLu().solve(b)).norm(), 1e-10 * x.norm());
	}

	TEST(LinearSolver, SolvesIndefiniteMatricesByLu)
	{
		LinearSolver solver;
		expectSolves(solver, sparse(-definite(50, 0.2, 1)), Status::lu);
		expectSolves(solver, sparse((Eigen::MatrixXd(2, 2) << 0, 1, 1, 0).finished()), Status::lu);
		expectSolves(solver, sparse((Eigen::MatrixXd(3, 3) << 1e-20, 1, 0, 1, 1e-20, 1, 0, 1, 2).finished()), Status::lu);
		expectSolves(solver, laplace(12, 3.3), Status::lu, 1e-9); // supernodal refused
	}

	TEST(LinearSolver, ReportsSingularMatrices)
	{
		LinearSolver    solver;
		Eigen::VectorXd x;
		// a free chain of springs, a zero row, a zero matrix, a singular indefinite one, a row twice but for
		// round-off
		Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(5, 5);
		for (int i = 0; i < 4; ++i)
			chain.block<2, 2>(i, i) += (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
		Eigen::MatrixXd empty = definite(5, 1, 1);
		empty.row(2).setZero(), empty.col(2).setZero();
		const Eigen::MatrixXd saddle = (Eigen::MatrixXd(3, 3) << 1, 2, 1, 2, 1, 2, 1, 2, 1).finished();
		const Eigen::MatrixXd twice  = (Eigen::MatrixXd(2, 2) << -1, 1, 1, -1 - precision / 2).finished();
		for (const auto& m : { chain, empty, Eigen::MatrixXd(Eigen::MatrixXd::Zero(3, 3)), saddle, twice })
			EXPECT_EQ(solver.solve(sparse(m), Eigen::VectorXd::Ones(m.rows()), x), Status::singular) << m;
	}

	// Whatever of Cholesky and LU gets to the end: what remains of the last pivots is round-off.
	template <int Dim> void expectFreeBodiesAreSingular()
	{
		Random random(1);
		for (int i = 0; i < 30; ++i) {
			Model<Dim> model;
			model.materials.push_back({ Hencky(1e6, 0.3), 1 });
			model.ghost     = { i % 2 ? 1e-2 : 0 };
			auto       body = block<Dim>(model.grid, Index<Dim>::NullaryExpr([&]() { return random.integer(1, 4); }), 2);
			const auto by   = random.matrix<Dim>();
			for (auto& x : body.position)
				x += by;
			LinearSolver    solver;
			Eigen::VectorXd x;
			const auto      K = tangentStiffness(body, model);
			EXPECT_EQ(solver.solve(K, random.vector(K.size()), x), Status::singular) << i;
		}
	}

	TEST(LinearSolver, ReportsBodiesThatNothingHolds)
	{
		expectFreeBodiesAreSingular<2>();
		expectFreeBodiesAreSingular<3>();
	}

	TEST(LinearSolver, SolvesWhereNodesAreHardlyTouched)
	{
		// overlaps of 1e-7 of a cell, without ghost stabilisation: the condition number is 1e15, but every row
		// is well behaved in its own scale
		for (const double a : { 1e-3, 1e-5, 1e-7, 1e-8 }) {
			Model<2> model;
			model.materials.push_back({ Hencky(1e6, 0.3), 1 });
			model.ghost    = { 0 };
			model.boundary = Boundary<2>({ held<2>(model.grid, { -infinity, -infinity }, { infinity, 0 }, "xy") });
			auto body      = block<2>(model.grid, { 4, 4 }, 2);
			for (auto& x : body.position)
				x += Vec<2>(a, a);
			const auto            K = tangentStiffness(body, model);
			const Eigen::VectorXd x = Random(3).vector(K.size());
			LinearSolver          solver;
			Eigen::VectorXd       found;
			if (a < 1e-6) {
				EXPECT_GT(conditionNumber(K), 1e14);
			}
			ASSERT_EQ(solver.solve(K, K * x, found), Status::cholesky) << a;
			// Large where a node is hardly touched, but without energy.
			const Eigen::VectorXd error = found - x;
			EXPECT_LT(error.dot(K * error), 1e-20 * x.dot(K * x)) << a;
		}
	}

	TEST(LinearSolver, SolvesStiffOnSoft)
	{
		for (const double contrast : { 1e3, 1e8 }) {
			Model<2> model;
			for (const double young : { 1., contrast })
				model.materials.push_back({ Hencky(young, 0.3), 1 });
			model.boundary = Boundary<2>({ held<2>(model.grid, { -infinity, -infinity }, { infinity, 0 }, "xy") });
			auto body      = block<2>(model.grid, { 4, 4 }, 2);
			for (std::size_t p = 0; p < body.size(); ++p)
				body.material[p] = body.position[p][1] > 2;
			LinearSolver solver;
			expectSolves(solver, tangentStiffness(body, model), Status::cholesky, 1e-14 * contrast);
		}
	}

	TEST(LinearSolver, ReportsMatricesThatAreNotNumbers)
	{
		for (const double bad : { std::nan(""), infinity, -infinity }) {
			LinearSolver    solver;
			Eigen::VectorXd x;
			auto            K = sparse(definite(20, 0.3, 1));
			K.value[30]       = bad;
			EXPECT_EQ(solver.solve(K, Eigen::VectorXd::Ones(20), x), Status::singular) << bad;
			K.value[0] = bad;
			EXPECT_EQ(solver.solve(K, Eigen::VectorXd::Ones(20), x), Status::singular) << bad;
			expectSolves(solver, sparse(definite(20, 0.3, 1)), Status::cholesky);
		}
	}

	TEST(LinearSolver, AnswersDoNotDependOnWhatWasSolvedBefore)
	{
		const auto small = sparse(definite(60, 0.2, 1)), large = laplace(12, 6.1);
		for (const auto& K : { small, large }) {
			const Eigen::VectorXd b = Random(7).vector(K.size());
			Eigen::VectorXd       expected, x;
			ASSERT_EQ(LinearSolver().solve(K, b, expected), Status::cholesky);

			LinearSolver solver;
			auto         scaled = K, indefinite = K;
			for (double& v : scaled.value)
				v *= 3.7;
			for (int c = 0; c < K.size(); ++c)
				indefinite.value[K.start[c]] -= 3.5;
			solver.solve(scaled, b, x); // same pattern
			ASSERT_EQ(solver.solve(K, b, x), Status::cholesky);
			EXPECT_TRUE(x == expected) << "after other values";
			EXPECT_EQ(solver.solve(indefinite, b, x), Status::lu);
			ASSERT_EQ(solver.solve(K, b, x), Status::cholesky);
			EXPECT_TRUE(x == expected) << "after a failed factorisation";
			solver.solve(sparse(definite(30, 0.5, 8)), Eigen::VectorXd::Ones(30), x);
			ASSERT_EQ(solver.solve(K, b, x), Status::cholesky);
			EXPECT_TRUE(x == expected) << "after another pattern";
		}
	}

	TEST(LinearSolver, PatternsOfTheSameSizeAreToldApart)
	{
		Eigen::MatrixXd a = 4 * Eigen::MatrixXd::Identity(4, 4), b = a;
		a(1, 0) = a(0, 1) = 1;
		b(3, 2) = b(2, 3) = 1;
		LinearSolver solver;
		expectSolves(solver, sparse(a), Status::cholesky);
		expectSolves(solver, sparse(b), Status::cholesky);
	}

	TEST(LinearSolver, AnalysesAPatternOnce)
	{
		LinearSolver    solver;
		const auto      K = laplace(12, 6.1);
		Eigen::VectorXd x;
		solver.solve(K, Eigen::VectorXd::Ones(K.size()), x);
		EXPECT_GT(solver.times().analyse, 0);
		solver.resetTimes();
		solver.solve(K, Eigen::VectorXd::Ones(K.size()), x);
		EXPECT_EQ(solver.times().analyse, 0);
		EXPECT_GT(solver.times().factorise, 0);
	}

	TEST(LinearSolver, UnitsDoNotMatter)
	{
		LinearSolver solver;
		for (const double unit : { 1e-150, 1e-30, 1e30, 1e150 }) {
			expectSolves(solver, sparse(unit * definite(40, 0.2, 1)), Status::cholesky);
			expectSolves(solver, sparse(unit * symmetric(40, 0.3, 4)), Status::lu, 1e-10);
		}
	}

	// Status of conjugate gradients: problems that they solve, and those that they leave to the direct solver.
	Status iteratively(LinearSolver& solver, const LinearProblem& K, double tolerance, double* residual = nullptr)
	{
		const Eigen::VectorXd b = Random(7).vector(K.size());
		Eigen::VectorXd       x;
		const Status          status = solver.solve(K, b, x, LinearMethod::iterative, tolerance);
		if (residual) *residual = (K * x - b).norm() / b.norm();
		return status;
	}

	TEST(LinearSolver, SolvesIterativelyToTheTolerance)
	{
		LinearSolver solver;
		double       residual = 0;
		for (const double tolerance : { 1e-2, 1e-6, 1e-10 }) {
			const int before = solver.iterativeEffort().iterations;
			ASSERT_EQ(iteratively(solver, laplace(12, 6), tolerance, &residual), Status::iterative);
			EXPECT_LE(residual, 1.01 * tolerance);
			EXPECT_GT(residual, 1e-3 * tolerance) << "more iterations than asked for";
			EXPECT_GT(solver.iterativeEffort().iterations, before);
		}
		EXPECT_EQ(solver.iterativeEffort().fallbacks, 0);
		Eigen::VectorXd x;
		ASSERT_EQ(solver.solve(laplace(3, 6), Eigen::VectorXd::Zero(27), x, LinearMethod::iterative, 1e-6), Status::iterative);
		EXPECT_EQ(x, Eigen::VectorXd::Zero(27));
	}

	TEST(LinearSolver, UnitsDoNotMatterToConjugateGradients)
	{
		LinearSolver          solver;
		const auto            m = definite(40, 0.2, 1);
		const Eigen::VectorXd b = Random(5).vector(40);
		Eigen::VectorXd       expected, x;
		ASSERT_EQ(solver.solve(sparse(m), b, expected), Status::cholesky);
		for (const double unit : { 1e-200, 1., 1e200 }) {
			ASSERT_EQ(solver.solve(sparse(unit * m), unit * b, x, LinearMethod::iterative, 1e-10), Status::iterative);
			EXPECT_LT((x - expected).norm(), 1e-8 * expected.norm()) << unit;
		}
	}

	TEST(LinearSolver, LeavesWhatIsNotDefiniteToTheDirectSolver)
	{
		LinearSolver solver;
		double       residual = 0;
		// negative on the diagonal; negative curvature behind a positive diagonal; nothing on the diagonal
		EXPECT_EQ(iteratively(solver, sparse(-definite(50, 0.2, 1)), 1e-6, &residual), Status::lu);
		EXPECT_LT(residual, 1e-12);
		EXPECT_EQ(iteratively(solver, laplace(12, 3.3), 1e-6, &residual), Status::lu);
		EXPECT_LT(residual, 1e-9);
		EXPECT_EQ(iteratively(solver, sparse((Eigen::MatrixXd(2, 2) << 0, 1, 1, 0).finished()), 1e-6), Status::lu);
		EXPECT_EQ(solver.iterativeEffort().fallbacks, 3);
		auto K     = sparse(definite(20, 0.3, 1));
		K.value[3] = std::numeric_limits<double>::quiet_NaN();
		EXPECT_EQ(iteratively(solver, K, 1e-6), Status::singular);
	}

	TEST(LinearSolver, LeavesWhatIsTooIllConditionedToTheDirectSolver)
	{
		// a chain of 6000 springs held at one end: as many iterations as unknowns
		SymmetricCsc chain;
		chain.start = { 0 };
		for (int i = 0; i < 6000; ++i) {
			chain.row.push_back(i), chain.value.push_back(i < 5999 ? 2 : 1);
			if (i < 5999) chain.row.push_back(i + 1), chain.value.push_back(-1);
			chain.start.push_back(int(chain.row.size()));
		}
		LinearSolver solver;
		double       residual = 0;
		EXPECT_EQ(iteratively(solver, chain, 1e-8, &residual), Status::cholesky);
		EXPECT_LT(residual, 1e-8);
		EXPECT_EQ(solver.iterativeEffort().fallbacks, 1);
	}

	TEST(LinearSolver, ChoosesByTheSizeOfTheFactor)
	{
		LinearSolver solver;
		EXPECT_FALSE(solver.prefersIterative(laplace(12, 6)));
		EXPECT_TRUE(solver.prefersIterative(laplace(45, 6)));
		EXPECT_EQ(solver.times().factorise, 0);
		Eigen::VectorXd x;
		const auto      small = laplace(12, 6);
		EXPECT_EQ(solver.solve(small, Eigen::VectorXd::Ones(small.size()), x, LinearMethod::automatic, 1e-6), Status::cholesky);
		EXPECT_EQ(solver.solve(small, Eigen::VectorXd::Ones(small.size()), x, LinearMethod::direct, 1e-6), Status::cholesky);
		EXPECT_EQ(solver.iterativeEffort().iterations, 0);
	}

	TEST(LinearSolver, PrintsNothing)
	{
		LinearSolver    solver;
		Eigen::VectorXd x;
		testing::internal::CaptureStdout();
		testing::internal::CaptureStderr();
		solver.solve(laplace(12, 3.3), Eigen::VectorXd::Ones(1728), x);
		solver.solve(sparse(-definite(20, 0.2, 1)), Eigen::VectorXd::Ones(20), x);
		solver.solve(sparse(Eigen::MatrixXd::Zero(3, 3)), Eigen::VectorXd::Ones(3), x);
		solver.solve(sparse(Eigen::MatrixXd::Constant(3, 3, std::nan(""))), Eigen::VectorXd::Ones(3), x);
		EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
		EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
	}

	TEST(ConditionNumber, IsTheRatioOfTheLargestToTheSmallestEigenvalue)
	{
		EXPECT_NEAR(conditionNumber(sparse(Eigen::Vector3d(2, -8, 0.5).asDiagonal())), 16, 1e-13);
		EXPECT_NEAR(conditionNumber(sparse((Eigen::MatrixXd(2, 2) << 2, 1, 1, 2).finished())), 3, 1e-14);
	}

} // namespace
} // namespace gimpm
