// SPDX-License-Identifier: GPL-2.0-or-later
// Blocks between any nodes and fields: products, reduction, order of elimination and solvers against dense matrices;
// and a body whose ends a spring joins.
#include "core/solvers/field_rows.hpp"
#include "core/solvers/multigrid.hpp"
#include "core/solvers/shared_blocks.hpp"
#include "core/stepping/step_system.hpp"
#include "derivatives.hpp"
#include "springs.hpp"
#include "tendon.hpp"
#include "threads_as_processes.hpp"
#include <numeric>

namespace gimpm::testCouplings {
namespace {

	/// A box of springs with blocks between nodes that are apart, and with another field where that is asked for.
	template <int Dim> struct Coupled {
		Springs<Dim> springs;
		DofMap       map;
		Couplings    beside;
		FreeDofs     dofs;
		Random       random { 5 };
		static Field displacement() { return { "displacement", "m", Dim }; }

		Coupled(const Index<Dim>& size, std::vector<Field> fields, bool isSymmetric = true, double skew = 0.1)
		        : springs(size, 1), map(int(springs.nodes.size()), fields)
		{
			if (!isSymmetric) makeUnsymmetric(skew);
			dofs.number = springs.dofs.number;
			dofs.count  = springs.dofs.count;
			while (int(dofs.number.size()) < map.size())
				dofs.number.push_back(dofs.number.size() % 7 == 3 ? -1 : dofs.count++);
			beside.reset(map, isSymmetric);
		}
		int  nodes() const { return map.nodes(); }
		void makeUnsymmetric(double skew)
		{
			NodeMatrix<Dim> other;
			other.reset(springs.nodes, false, springs.grid);
			for (int a = 0; a < other.nodes(); ++a)
				for (int c = 0; c < other.codes; ++c) {
					if (!springs.K.used(a, c)) continue;
					other.markUsed(a, c);
					std::copy_n(springs.K.at(a, c), other.block, other.at(a, c));
					if (c > 0)
						std::transform(other.at(a, c), other.at(a, c) + other.block, other.skewAt(a, c), [skew](double k) {
							return skew * k;
						});
				}
			springs.K = other;
		}
		/// A spring between two nodes, in all directions alike.
		void join(int a, int b, double stiffness)
		{
			const Mat<Dim> k = stiffness * Mat<Dim>::Identity();
			for (const auto& [row, column, sign] : { std::tuple(a, a, 1), std::tuple(a, b, -1), std::tuple(b, a, -1), std::tuple(b, b, 1) })
				beside.mark({ 0, row }, { 0, column });
			beside.setZero();
			for (const auto& [row, column, sign] : { std::tuple(a, a, 1), std::tuple(a, b, -1), std::tuple(b, a, -1), std::tuple(b, b, 1) })
				beside.add({ 0, row }, { 0, column }, sign * k);
		}
		/// Random blocks between random nodes of all fields; symmetric, if the matrix is.
		void fill(int count)
		{
			std::vector<std::pair<FieldNode, FieldNode>> pairs;
			const auto any = [&]() { return FieldNode { random.integer(0, map.fields() - 1), random.integer(0, nodes() - 1) }; };
			for (int i = 0; i < count; ++i)
				pairs.push_back({ any(), any() }), beside.mark(pairs.back().first, pairs.back().second);
			beside.setZero();
			for (const auto& [row, column] : pairs) {
				Eigen::MatrixXd block  = Eigen::MatrixXd::Zero(map[row.field].width, map[column.field].width);
				const bool      isSame = row.field == column.field && row.node == column.node;
				block                  = block.unaryExpr([&](double) { return random.in(-1, 1); });
				if (isSame) block = (block + block.transpose()).eval();
				beside.add(row, column, block);
				if (beside.isSymmetric() && !isSame) beside.add(column, row, block.transpose());
			}
		}
		Eigen::MatrixXd full() const
		{
			Eigen::MatrixXd full(map.size(), map.size());
			for (int i = 0; i < map.size(); ++i) {
				Eigen::VectorXd column = Eigen::VectorXd::Zero(map.size());
				springs.K.multiplyAdd(Eigen::VectorXd::Unit(map.size(), i), column);
				beside.multiplyAdd(Eigen::VectorXd::Unit(map.size(), i), column);
				full.col(i) = column;
			}
			return full;
		}
		/// Reduced matrix of the free unknowns, scaled.
		Eigen::MatrixXd reducedFull() const
		{
			std::vector<int> free;
			Eigen::VectorXd  scale(map.size());
			for (int i = 0; i < map.size(); ++i) {
				scale[i] = map[map.fieldOf(i)].scale;
				if (dofs.number[i] >= 0) free.push_back(i);
			}
			const Eigen::MatrixXd scaled = scale.asDiagonal() * full() * scale.asDiagonal();
			return principalPart(scaled, free);
		}
		LinearProblem problem() const { return LinearProblem(springs.K, dofs, &beside); }
	};

	/// True if there is a library for it.
	bool hasMultigrid()
	{
#ifdef MPM_PETSC
		Multigrid::openFrom(MPM_PETSC);
#endif
		return Multigrid::absence().empty();
	}

	template <class Dimension> using CouplingsOf = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(CouplingsOf, BothDimensions, DimensionName);

	TYPED_TEST(CouplingsOf, AreReducedAsADenseMatrix)
	{
		constexpr int Dim   = TypeParam::value;
		const Field   other = { "pressure", "Pa", 1, 1e3 }, third = { "rotation", "", 2, 0.1 };
		for (const bool isSymmetric : { true, false })
			for (const auto& fields :
			     { std::vector<Field> { Coupled<Dim>::displacement() }, std::vector<Field> { Coupled<Dim>::displacement(), other, third } }) {
				Coupled<Dim> c(Index<Dim>::Constant(4), fields, isSymmetric);
				c.fill(300);
				const LinearProblem   K    = c.problem();
				const Eigen::MatrixXd full = c.full(), expected = c.reducedFull(), found = dense(K);
				EXPECT_EQ(full.isApprox(full.transpose()), isSymmetric);
				EXPECT_LT((found - expected).norm(), 1e-14 * expected.norm());
				EXPECT_LT((dense(reduced(c.springs.K, c.dofs, &c.beside)) - expected).norm(), 1e-14 * expected.norm());
				const auto& [start, row, value] = K.stored();
				for (int column = 0; column < c.dofs.count; ++column)
					EXPECT_TRUE(std::is_sorted(row.begin() + start[column], row.begin() + start[column + 1]));
			}
	}

	/// Nodes that follow others take what they are coupled to along.
	TYPED_TEST(CouplingsOf, OfTiedNodesBelongToTheirMasters)
	{
		constexpr int Dim = TypeParam::value;
		Coupled<Dim>  c(Index<Dim>::Constant(3), { Coupled<Dim>::displacement(), { "pressure", "Pa", 1, 1e3 } });
		c.fill(200);
		const AffineConstraints affineConstraints { { 4 }, { 0, 2 }, { 1, 7 }, { 0.25, 0.75 } };
		Constraints             held;
		held.reset(c.map, affineConstraints);
		for (int i = 0; i < c.map.size(); ++i)
			if (const int f = c.map.fieldOf(i); (i - c.map.begin(f)) / c.map[f].width != 4) held.free(i);
		Eigen::MatrixXd P = Eigen::MatrixXd::Zero(c.map.size(), held.dofs.count);
		for (int i = 0; i < c.map.size(); ++i)
			if (held.dofs.number[i] >= 0) P(i, held.dofs.number[i]) = c.map[c.map.fieldOf(i)].scale;
		for (int i = 0; i < P.cols(); ++i) {
			Eigen::VectorXd column = P.col(i);
			held.template distribute<Dim>(c.map, column);
			P.col(i) = column;
		}
		const Eigen::MatrixXd expected = P.transpose() * c.full() * P;
		EXPECT_LT((dense(reduced(c.springs.K, held.dofs, &c.beside)) - expected).norm(), 1e-13 * expected.norm());
		Eigen::VectorXd forces = Random(2).vector(c.map.size()), folded = forces;
		held.template condense<Dim>(c.map, folded);
		Eigen::VectorXd x = Random(3).vector(c.map.size());
		held.template distribute<Dim>(c.map, x);
		EXPECT_NEAR(folded.dot(x) / forces.dot(x), 1, 1e-13) << "the one is the transpose of the other";
	}

	/// The order knows of nodes that are apart: no entry joins the two parts that it leaves.
	TYPED_TEST(CouplingsOf, AreKnownToTheOrderOfElimination)
	{
		constexpr int Dim   = TypeParam::value;
		const Field   other = { "pressure", "Pa" };
		for (const auto& fields : { std::vector<Field> { Coupled<Dim>::displacement() }, std::vector<Field> { Coupled<Dim>::displacement(), other } }) {
			Coupled<Dim> c(Index<Dim>::Constant(Dim == 2 ? 20 : 7), fields);
			c.fill(12);
			const LinearProblem K     = c.problem();
			const Order         order = K.ordering();
			std::vector<int>    part(K.size(), 0), all(K.size()), numbers = order.numbers;
			std::iota(all.begin(), all.end(), 0);
			std::sort(numbers.begin(), numbers.end());
			EXPECT_EQ(numbers, all);
			for (int i = 0; i < order.first + order.second; ++i)
				part[order.numbers[i]] = i < order.first ? 1 : 2;
			EXPECT_GT(std::min(order.first, order.second), K.size() / 8);
			K.forEntries([&](int row, int column, double) { ASSERT_NE(part[row] + part[column], 3); });
		}
	}

	template <int Dim> void expectSolved(const Coupled<Dim>& c, LinearMethod method, LinearSolver::Status expected)
	{
		const LinearProblem   K = c.problem();
		const Eigen::VectorXd b = Random(4).vector(K.size());
		Eigen::VectorXd       x;
		LinearSolver          solver;
		EXPECT_EQ(solver.solve(K, b, x, method, 1e-11), expected) << solver.iterativeEffort().reason;
		EXPECT_LT((K * x - b).norm(), 2e-11 * b.norm());
	}

	TYPED_TEST(CouplingsOf, AreSolvedWithByAllMethods)
	{
		constexpr int Dim = TypeParam::value;
		using Status      = LinearSolver::Status;
		for (const int size : { 6, Dim == 2 ? 50 : 12 }) { // the larger ones by dissection of the grid
			Coupled<Dim> c(Index<Dim>::Constant(size), { Coupled<Dim>::displacement() });
			c.join(c.nodes() - 1, c.nodes() - size, 3);
			EXPECT_EQ(c.dofs.count >= 4000, size > 6);
			expectSolved(c, LinearMethod::direct, Status::cholesky);
			expectSolved(c, LinearMethod::iterative, Status::iterative);
			if (hasMultigrid()) expectSolved(c, LinearMethod::multigrid, Status::iterative);
			Coupled<Dim> other(Index<Dim>::Constant(size), { Coupled<Dim>::displacement() }, false);
			other.join(other.nodes() - 1, other.nodes() - size, 3);
			expectSolved(other, LinearMethod::direct, Status::lu);
			// Larger ones take GMRES too long.
			if (size == 6) expectSolved(other, LinearMethod::iterative, Status::iterative);
		}
	}

	/// Displacements and a pressure, as of a step in which water leaves a body: symmetric and indefinite, by itself
	/// or by the sign of the pressure's rows, or with the signs that make it neither.
	template <int Dim> Coupled<Dim> saturated(int size, bool isSymmetric, int signOfRows = 1)
	{
		Coupled<Dim> c(Index<Dim>::Constant(size), { Coupled<Dim>::displacement(), { "pressure", "Pa", 1, 10, signOfRows } }, isSymmetric, 0.01);
		for (int n = 0; n < c.nodes(); ++n)
			for (const int other : { n, std::max(n - 1, 0) })
				c.beside.mark({ 1, n }, { 1, other }), c.beside.mark({ 0, n }, { 1, other });
		c.beside.setZero();
		const double sign = isSymmetric && signOfRows > 0 ? -1 : 1;
		for (int n = 0; n < c.nodes(); ++n) {
			const int before = std::max(n - 1, 0);
			c.beside.add({ 1, n }, { 1, n }, sign * 0.01);
			for (const auto& [row, column, k] :
			     { std::tuple(n, n, 1), std::tuple(n, before, -1), std::tuple(before, n, -1), std::tuple(before, before, 1) })
				c.beside.add({ 1, row }, { 1, column }, sign * k * 0.002);
			const Vec<Dim> gradient = c.random.template matrix<Dim>(0.03);
			c.beside.add({ 0, n }, { 1, n }, gradient);
			c.beside.add({ 1, n }, { 0, n }, (-sign * gradient).transpose());
		}
		return c;
	}

	TYPED_TEST(CouplingsOf, OfSeveralFieldsAreSolvedWithByAllMethods)
	{
		constexpr int Dim = TypeParam::value;
		using Status      = LinearSolver::Status;
		for (const bool isSymmetric : { true, false })
			for (const int size : { 8, Dim == 2 ? 50 : 12 }) {
				const auto c = saturated<Dim>(size, isSymmetric);
				EXPECT_EQ(
				        dense(saturated<Dim>(3, isSymmetric).problem()).isApprox(dense(saturated<Dim>(3, isSymmetric).problem()).transpose()),
				        isSymmetric);
				for (const auto method : { LinearMethod::direct, LinearMethod::automatic })
					expectSolved(c, method, Status::lu);
				if (size == 8) expectSolved(c, LinearMethod::iterative, Status::iterative);
				expectSolved(c, LinearMethod::multigrid, hasMultigrid() ? Status::iterative : Status::lu);
			}
	}

	/// Leaves a node next to nothing that resists its first displacement, but for the pressure there: the pivot is
	/// lost where displacements come before pressures. Returns the number of that displacement.
	template <int Dim> int soften(Coupled<Dim>& c, double left)
	{
		int node = c.nodes() / 2;
		while (c.dofs.number[Dim * node] < 0 || c.dofs.number[c.map.at(1, node)] < 0)
			++node;
		auto& K = c.springs.K;
		for (int a = 0; a < c.nodes(); ++a)
			for (int code = 0; code < K.codes; ++code)
				for (int i = 0; i < Dim; ++i)
					for (int j = 0; j < Dim && K.used(a, code); ++j)
						if ((a == node && i == 0) || (K.neighbour(a, code) == node && j == 0)) {
							double& k = K.at(a, code)[Dim * i + j];
							k         = code == 0 && i == j ? left * k : 0;
						}
		return c.dofs.number[Dim * node];
	}

	/// Block of the displacements of a node and its pressure.
	template <int Dim> Vec<Dim> blockOf(const Coupled<Dim>& c, int node)
	{
		Vec<Dim> block = Vec<Dim>::Zero();
		c.beside.forBlocksOf({ 0, node }, [&](const FieldNode& column, const double* values) {
			if (column.field == 1 && column.node == node) block = Eigen::Map<const Vec<Dim>>(values);
		});
		return block;
	}

	TYPED_TEST(CouplingsOf, AreSolvedAlsoWhereAPivotIsLost)
	{
		constexpr int Dim = TypeParam::value;
		for (const double left : { 1., 1e-9, 1e-12, 0. }) {
			auto          c    = saturated<Dim>(6, true, -1);
			const int     soft = soften(c, left);
			LinearProblem K    = c.problem();
			ASSERT_TRUE(K.hasSigns() && K.isSymmetric());
			EXPECT_EQ(dense(K)(soft, soft) == 0, left == 0);
			// Again with the same pattern, and another right side with the same factor.
			LinearSolver    solver;
			Eigen::VectorXd x, b = K * Random(6).vector(K.size());
			for (int again = 0; again < 2; ++again) {
				EXPECT_EQ(solver.solve(K, b, x), LinearSolver::Status::lu);
				EXPECT_LT((K * x - b).norm(), 2e-11 * b.norm());
			}
			ASSERT_TRUE(solver.solveAgain(2 * b, b));
			EXPECT_LT((b - 2 * x).norm(), 1e-9 * x.norm());
		}
		// without the pressure that held it, it is singular
		auto      c    = saturated<Dim>(6, true, -1);
		const int soft = soften(c, 0);
		for (int node = 0; node < c.nodes(); ++node)
			if (c.dofs.number[Dim * node] == soft) c.beside.add({ 0, node }, { 1, node }, (-blockOf<Dim>(c, node)).eval());
		LinearSolver    solver;
		Eigen::VectorXd x;
		EXPECT_EQ(solver.solve(c.problem(), Eigen::VectorXd::Ones(c.dofs.count), x), LinearSolver::Status::singular);
	}

	TYPED_TEST(CouplingsOf, JoinNodesFarApartInALoadStep)
	{
		constexpr int                                   Dim    = TypeParam::value;
		constexpr int                                   length = 12; // beyond what neighbours on the grid reach
		std::vector<std::pair<double, PointCloud<Dim>>> found;
		for (const auto method : { LinearMethod::direct, LinearMethod::iterative, LinearMethod::multigrid }) {
			if (method == LinearMethod::multigrid && !hasMultigrid()) continue;
			Braced<Dim>      braced(length, method);
			LinearSolver     solver;
			const StepReport report = loadStep<Dim>(braced.cloud, braced.model, {}, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_EQ(report.conjugateGradients.iterations > 0, method != LinearMethod::direct);
			EXPECT_EQ(report.luSolves, 0);
			EXPECT_LE(report.iterations, 6);
			EXPECT_LT(braced.tendon.force, braced.tendon.stiffness * braced.tendon.shortening) << "its ends have come closer";
			EXPECT_NEAR(report.reactions[0][0], 0, 1e-6 * braced.tendon.force);
			found.push_back({ braced.tendon.force, braced.cloud });
		}
		for (const auto& [force, cloud] : found) {
			EXPECT_NEAR(force / found[0].first, 1, 1e-8);
			for (std::size_t p = 0; p < cloud.size(); ++p)
				EXPECT_LT((cloud.position[p] - found[0].second.position[p]).norm(), 1e-9);
		}
		Braced<Dim> loose(length, LinearMethod::direct);
		loose.model.coupledTerms.clear();
		LinearSolver solver;
		const auto   before = loose.cloud.position;
		ASSERT_TRUE(loadStep<Dim>(loose.cloud, loose.model, {}, solver).converged());
		EXPECT_EQ(loose.cloud.position, before);
		EXPECT_GT((found[0].second.position.back() - before.back()).norm(), 1e-3);
	}

	TYPED_TEST(CouplingsOf, HaveTheTangentOfTheirForces)
	{
		constexpr int         Dim = TypeParam::value;
		Braced<Dim>           braced(7, LinearMethod::direct);
		StepReport            report;
		const StepSystem<Dim> system(braced.cloud, braced.model, {}, report);
		const Eigen::VectorXd d      = Random(3).vector(system.nodalSize(), 0.01);
		const auto            forces = [&](const Eigen::VectorXd& at) {
                        Eigen::VectorXd force;
                        EXPECT_FALSE(system.evaluate(at, force, nullptr));
                        return force;
		};
		NodeMatrix<Dim> K;
		Couplings       beside;
		Eigen::VectorXd force;
		system.prepare(K, &beside);
		ASSERT_FALSE(system.evaluate(d, force, &K, nullptr, &beside));
		Eigen::MatrixXd full = dense(K);
		for (int i = 0; i < full.cols(); ++i) {
			Eigen::VectorXd column = full.col(i);
			beside.multiplyAdd(Eigen::VectorXd::Unit(full.cols(), i), column);
			full.col(i) = column;
		}
		EXPECT_LT(relativeError(full, derivative(forces, d, 1e-4)), 1e-8);
	}

	/// Each of three processes has its rows of a product, and is told by the others of nodes that are apart.
	TYPED_TEST(CouplingsOf, AreSharedByProcesses)
	{
		constexpr int Dim = TypeParam::value;
		Coupled<Dim>  c(Index<Dim>::Constant(6), { Coupled<Dim>::displacement() });
		c.join(c.nodes() - 1, c.nodes() / 2, 3);
		const LinearProblem K     = c.problem();
		const auto          whole = K.overNodes()->blocks();
		Eigen::VectorXd     x = Random(1).vector(Dim * c.nodes()), y, diagonal = whole->diagonal(), found = x, foundDiagonal = x;
		whole->multiply(x, y);
		inThreads(3, [&](const std::shared_ptr<const Processes>& process) {
			const OwnedNodes        ownedNodes { *process, { 0, c.nodes() / 4, 2 * c.nodes() / 3, c.nodes() } };
			const SharedBlocks<Dim> part(c.springs.K, c.dofs, ownedNodes, &c.beside);
			const Eigen::VectorXd   own = ownedNodes.own(x);
			Eigen::VectorXd         product;
			part.multiply(own, product);
			ownedNodes.own(found)         = product;
			ownedNodes.own(foundDiagonal) = part.diagonal();
		});
		EXPECT_LT((found - y).norm(), 1e-14 * y.norm());
		EXPECT_LT((foundDiagonal - diagonal).norm(), 1e-14 * diagonal.norm());
	}

	struct OneOf : OneProcess {
		int number;
		explicit OneOf(int number) : number(number) { }
		int rank() const override { return number; }
		int size() const override { return 2; }
	};

	/// Couplings as multigrid and factors of several processes get them.
	TYPED_TEST(CouplingsOf, AreInTheRowsOfProcesses)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool isSymmetric : { true, false }) {
			Coupled<Dim> c(Index<Dim>::Constant(5), { Coupled<Dim>::displacement() }, isSymmetric);
			c.fill(60);
			const Eigen::MatrixXd full   = c.full();
			const NodeRows        whole  = *nodeRows(c.springs.K, c.dofs, OwnedNodes::whole(c.nodes()), &c.beside);
			const auto            isFree = [&](int i) { return c.dofs.number[i] >= 0; };
			double                sum = 0, expected = 0;
			for (const int rank : { 0, 1 }) {
				const OneOf      process(rank);
				const OwnedNodes ownedNodes { process, { 0, c.nodes() / 3, c.nodes() } };
				const NodeRows   rows = *nodeRows(c.springs.K, c.dofs, ownedNodes, &c.beside);
				for (int r = 0; r < rows.rows(); ++r)
					for (int e = rows.start[r]; e < rows.start[r + 1]; ++e) {
						const int i = rows.dof[r], j = whole.dof[rows.column[e]];
						EXPECT_TRUE(e == rows.start[r] || rows.column[e] > rows.column[e - 1]);
						if (!isFree(i) || !isFree(j)) continue;
						EXPECT_NEAR(rows.value[e], full(i, j), 1e-13);
						if (!isSymmetric) {
							EXPECT_NEAR(rows.symmetricPart[e], (full(i, j) + full(j, i)) / 2, 1e-13);
						}
						sum += std::abs(rows.value[e]);
					}
			}
			for (int i = 0; i < full.rows(); ++i)
				for (int j = 0; j < full.cols(); ++j)
					if (isFree(i) && isFree(j)) expected += std::abs(full(i, j));
			EXPECT_NEAR(sum / expected, 1, 1e-12) << "none is missing";
		}
	}

	/// Node after node, scaled, and complete; multigrid is made of each field by itself.
	TYPED_TEST(CouplingsOf, OfSeveralFieldsAreInTheRowsOfProcesses)
	{
		constexpr int Dim   = TypeParam::value;
		const Field   other = { "pressure", "Pa", 1, 1e3 }, third = { "rotation", "", 2, 0.1 };
		for (const bool isSymmetric : { true, false }) {
			Coupled<Dim> c(Index<Dim>::Constant(4), { Coupled<Dim>::displacement(), other, third }, isSymmetric);
			c.fill(300);
			Eigen::VectorXd scale(c.map.size());
			for (int i = 0; i < c.map.size(); ++i)
				scale[i] = c.map[c.map.fieldOf(i)].scale;
			const auto            isFree   = [&](int i) { return c.dofs.number[i] >= 0; };
			const Eigen::MatrixXd expected = scale.asDiagonal() * c.full() * scale.asDiagonal();
			Eigen::MatrixXd       found = Eigen::MatrixXd::Zero(c.map.size(), c.map.size()), forMultigrid = found;
			inThreads(2, [&](const std::shared_ptr<const Processes>& process) {
				const OwnedNodes ownedNodes { *process, { 0, c.nodes() / 3, c.nodes() } };
				const NodeRows   rows = *fieldRows(c.springs.K, c.dofs, ownedNodes, c.beside);
				EXPECT_EQ(rows.dim, Dim + 3);
				for (int r = 0; r < rows.rows(); ++r)
					for (int e = rows.start[r]; e < rows.start[r + 1]; ++e) {
						const int i = rows.dof[r], j = rows.columnDof[rows.column[e]];
						EXPECT_TRUE(e == rows.start[r] || rows.column[e] > rows.column[e - 1]);
						EXPECT_EQ(rows.columnDof[rows.first + r], i);
						EXPECT_TRUE(isFree(i) == isFree(j) || rows.value[e] == 0);
						if (isFree(i)) found(i, j) = rows.value[e], forMultigrid(i, j) = rows.symmetricPart[e];
					}
			});
			for (int i = 0; i < c.map.size(); ++i)
				for (int j = 0; j < c.map.size(); ++j) {
					if (!isFree(i) || !isFree(j)) continue;
					const int f      = c.map.fieldOf(i);
					double    wanted = f == c.map.fieldOf(j) ? (expected(i, j) + expected(j, i)) / 2 : expected(i, j);
					for (int u = 0; u < c.map.end(0) && i == j && f > 0; ++u)
						if (isFree(u)) wanted -= 2 * expected(i, u) * expected(u, i) / expected(u, u);
					ASSERT_NEAR(found(i, j), expected(i, j), 1e-12 * scale[i] * scale[j]);
					ASSERT_NEAR(forMultigrid(i, j), wanted, 1e-12 * std::max(scale[i] * scale[j], std::abs(wanted)));
				}
		}
	}

} // namespace
} // namespace gimpm::testCouplings
