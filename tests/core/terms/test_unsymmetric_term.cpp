// SPDX-License-Identifier: GPL-2.0-or-later
// A term whose stiffness is not symmetric, beside those whose are: Newton's method stays quadratic, with LU and with
// GMRES.
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"
#include <cstdio>

namespace gimpm::testUnsymmetricTerm {
namespace {

	/// Nodes push their neighbours, a cell away along an axis, and themselves sideways: f_a = c (1 + |d_b|^2 / h^2)
	/// R d_b, with a matrix R that is not symmetric. No energy has such forces.
	template <int Dim> class SidewaysForce : public Term<Dim> {
	public:
		SidewaysForce(double stiffness, const CloudBasis<Dim>& basis, const Grid<Dim>& grid) : stiffness_(stiffness), h_(grid.cellSize)
		{
			for (int a = 0; a < int(basis.nodes.size()); ++a) {
				pairs_.push_back({ a, a, 0 });
				for (int axis = 0; axis < Dim; ++axis) {
					const Key key = basis.nodes[a] - Grid<Dim>::keyStep(axis);
					const int b   = position(basis.nodes, key);
					if (b < a && basis.nodes[b] == key)
						pairs_.push_back({ a, b, NodeMatrix<Dim>::code(Index<Dim>(-Index<Dim>::Unit(axis))) });
				}
			}
		}
		void mark(NodeMatrix<Dim>& K) const override
		{
			for (const auto& p : pairs_)
				K.markUsed(p.b, -p.code);
		}
		std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum) override
		{
			for (const auto& [a, b, code] : pairs_) {
				const Vec<Dim> da = d.template segment<Dim>(Dim * a), db = d.template segment<Dim>(Dim * b);
				push(sum, a, db);
				if (a != b) push(sum, b, da);
				if (sum.K) sum.K->add(a, b, code, derivative(db));
				if (sum.K && a != b) sum.K->add(b, a, -code, derivative(da));
			}
			return std::nullopt;
		}
		bool isSymmetric() const override { return false; }

	private:
		struct Pair {
			int a, b, code;
		};
		static Mat<Dim> sideways()
		{
			Mat<Dim> R = 0.2 * Mat<Dim>::Identity();
			for (int i = 0; i < Dim; ++i)
				R(i, (i + 1) % Dim) += 1;
			if (Dim == 2) R(1, 0) = -1;
			return R;
		}
		double   growth(const Vec<Dim>& d) const { return 1 + d.squaredNorm() / (h_ * h_); }
		Mat<Dim> derivative(const Vec<Dim>& d) const
		{
			return stiffness_ * sideways() * (growth(d) * Mat<Dim>::Identity() + 2 / (h_ * h_) * d * d.transpose());
		}
		void push(const AssembledTerms<Dim>& sum, int node, const Vec<Dim>& d) const
		{
			const Vec<Dim> f = stiffness_ * growth(d) * sideways() * d;
			sum.force.template segment<Dim>(Dim * node) += f;
			if (sum.absoluteContributions) sum.absoluteContributions->template segment<Dim>(Dim * node) += f.cwiseAbs();
		}

		double            stiffness_, h_;
		std::vector<Pair> pairs_;
	};

	/// A soft block on a floor that holds it, under its own weight.
	template <int Dim> struct Block {
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		LinearSolver    solver;

		/// Block of 3 m with 10 kPa a metre of it.
		Block(int cells, double young)
		{
			model.grid.cellSize    = 3. / cells;
			model.materials        = { { Hencky(young, 0.3), 1e3 } };
			model.newton.tolerance = 1e-10;
			model.terms.push_back([young](const StepContext<Dim>& step) {
				return std::make_unique<SidewaysForce<Dim>>(0.02 * young * std::pow(step.grid.cellSize, Dim - 2), step.basis, step.grid);
			});
			Vec<Dim> max   = Vec<Dim>::Constant(infinity);
			max[1]         = 0;
			model.boundary = Boundary<Dim>({ held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), max, Dim == 2 ? "xy" : "xyz") });
			cloud          = block<Dim>(model.grid, Index<Dim>::Constant(cells), 2);
		}
		StepReport step(LinearMethod method, bool reuseFactor = false)
		{
			model.newton.linearSolver = method;
			model.newton.reuseFactor  = reuseFactor;
			Load<Dim> load;
			load.gravity      = -10 * Vec<Dim>::Unit(1);
			const auto report = loadStep(cloud, model, load, solver);
			std::printf("%d unknowns in %dD:", report.dofs, Dim);
			for (const double r : report.residuals)
				std::printf(" %.2e", r);
			std::printf(
			        ", order %.2f; %d solves, %d by LU, %d with the factor before, %d iterations of GMRES, %d fallbacks; analyse %.2f s, factorise %.2f s, "
			        "solve %.2f s\n",
			        convergenceOrder(report.residuals, 1e-13), report.iterations, report.luSolves, report.reusedFactors,
			        report.conjugateGradients.iterations, report.conjugateGradients.fallbacks, report.times.linear.analyse,
			        report.times.linear.factorise, report.times.linear.solve);
			return report;
		}
	};

	template <class Dimension> using UnsymmetricTerm = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(UnsymmetricTerm, BothDimensions, DimensionName);

	TYPED_TEST(UnsymmetricTerm, StiffnessIsTheDerivativeOfTheForce)
	{
		constexpr int         Dim = TypeParam::value;
		Block<Dim>            body(2, 1e5);
		StepReport            report;
		const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
		ASSERT_FALSE(system.isSymmetric());
		NodeMatrix<Dim>       K;
		Eigen::VectorXd       force, above, below;
		const Eigen::VectorXd d = Random(1).vector(system.nodalSize(), 0.1);
		system.prepare(K);
		ASSERT_FALSE(system.evaluate(d, force, &K));
		const Eigen::MatrixXd full = dense(K);
		EXPECT_FALSE(full.isApprox(full.transpose(), 1e-3));
		const double step = 1e-5;
		for (int i = 0; i < d.size(); ++i) {
			system.evaluate(d + step * Eigen::VectorXd::Unit(d.size(), i), above, nullptr);
			system.evaluate(d - step * Eigen::VectorXd::Unit(d.size(), i), below, nullptr);
			EXPECT_LT(((above - below) / (2 * step) - full.col(i)).norm(), 1e-6 * full.norm()) << i;
		}
		EXPECT_EQ(tangentStiffness(body.cloud, body.model).size(), system.dofs.count);
		EXPECT_FALSE(tangentStiffness(body.cloud, body.model).isSymmetric());
	}

	TYPED_TEST(UnsymmetricTerm, NewtonsMethodConvergesQuadratically)
	{
		constexpr int    Dim = TypeParam::value;
		Block<Dim>       directly(3, 15e4), iteratively(3, 15e4), withFactor(3, 15e4);
		const StepReport byLu = directly.step(LinearMethod::direct);
		ASSERT_TRUE(byLu.converged()) << byLu.cause;
		EXPECT_GT(convergenceOrder(byLu.residuals, 1e-13), 1.8);
		EXPECT_EQ(byLu.luSolves, byLu.iterations);
		EXPECT_EQ(byLu.definiteness, Definiteness::notChecked);
		const StepReport byGmres = iteratively.step(LinearMethod::iterative);
		ASSERT_TRUE(byGmres.converged()) << byGmres.cause;
		EXPECT_LE(byGmres.iterations, byLu.iterations);
		EXPECT_EQ(byGmres.luSolves, 0);
		EXPECT_EQ(byGmres.conjugateGradients.fallbacks, 0);
		EXPECT_GT(byGmres.conjugateGradients.iterations, byGmres.iterations);
		// At which the last factor suffices for the last solve.
		withFactor.model.newton.tolerance = Dim == 2 ? 1e-7 : 1e-5;
		const StepReport twice            = withFactor.step(LinearMethod::direct, true);
		ASSERT_TRUE(twice.converged()) << twice.cause;
		EXPECT_GT(twice.reusedFactors, 0);
		for (std::size_t p = 0; p < directly.cloud.size(); ++p) {
			EXPECT_LT((iteratively.cloud.position[p] - directly.cloud.position[p]).norm(), 1e-8);
			EXPECT_LT((withFactor.cloud.position[p] - directly.cloud.position[p]).norm(), 1e-4);
		}
	}

	TEST(UnsymmetricTerm, IsSolvedByGmresInLarge3D)
	{
		Block<3>         body(20, 8e4);
		const StepReport report = body.step(LinearMethod::automatic);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_LE(report.iterations, 4);
		EXPECT_GT(convergenceOrder(report.residuals, 1e-13), 1.8);
		EXPECT_EQ(report.luSolves, 0);
		EXPECT_GT(report.conjugateGradients.iterations, report.iterations);
	}

} // namespace
} // namespace gimpm::testUnsymmetricTerm
