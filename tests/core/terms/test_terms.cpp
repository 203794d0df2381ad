// SPDX-License-Identifier: GPL-2.0-or-later
// A term from outside the core, given to it by Model::terms alone: springs between nodes and the ground. It is what the
// developer's page tells how to add.
#include "core/stepping/step_control.hpp"
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"
#include <map>

namespace gimpm::testTerms {
namespace {

	/// Memory of the springs at nodes of the grid from step to step: how far each is stretched.
	template <int Dim> struct Springs {
		/// Force on the node over its displacement; not symmetric if it also pushes sideways one way [N/m].
		Mat<Dim>                stiffness;
		std::map<Key, Vec<Dim>> elongation; ///< elongation by node [m]

		Vec<Dim> total() const
		{
			Vec<Dim> force = Vec<Dim>::Zero();
			for (const auto& [node, e] : elongation)
				force += stiffness * e;
			return force;
		}
	};

	template <int Dim> class SpringForce : public Term<Dim> {
	public:
		SpringForce(Springs<Dim>& springs, const CloudBasis<Dim>& basis) : springs_(springs)
		{
			for (auto& [key, elongation] : springs.elongation)
				if (const int n = position(basis.nodes, key); n < int(basis.nodes.size()) && basis.nodes[n] == key)
					ends_.push_back({ n, elongation });
		}
		void mark(NodeMatrix<Dim>& K) const override
		{
			for (const auto& end : ends_)
				K.markUsed(end.node, itself);
		}
		std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum) override
		{
			for (const auto& end : ends_) {
				const Vec<Dim> f = force(end, d);
				sum.force.template segment<Dim>(Dim * end.node) += f;
				if (sum.absoluteContributions) sum.absoluteContributions->template segment<Dim>(Dim * end.node) += f.cwiseAbs();
				if (sum.K) Eigen::Map<Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>>(sum.K->at(end.node, itself)) += springs_.stiffness;
			}
			return std::nullopt;
		}
		bool   isSymmetric() const override { return springs_.stiffness == springs_.stiffness.transpose(); }
		double fromOutside(const Eigen::VectorXd& d) override
		{
			double squares = 0;
			for (const auto& end : ends_)
				squares += force(end, d).squaredNorm();
			return std::sqrt(squares);
		}
		void restrain(const typename Term<Dim>::Constrain& constrain) override
		{
			for (const auto& end : ends_)
				for (int a = 0; a < Dim; ++a)
					if (springs_.stiffness(a, a) > 0) constrain(end.node, Vec<Dim>::Unit(a), Vec<Dim>::Zero());
		}
		void commit(const Eigen::VectorXd& d) override
		{
			for (const auto& end : ends_)
				end.elongation += d.template segment<Dim>(Dim * end.node);
		}

	private:
		static constexpr int itself = 0; // code of a node's own block

		struct End {
			int       node;
			Vec<Dim>& elongation; // at the start of the step
		};
		Vec<Dim> force(const End& end, const Eigen::VectorXd& d) const
		{
			return springs_.stiffness * (end.elongation + d.template segment<Dim>(Dim * end.node));
		}
		Springs<Dim>&    springs_;
		std::vector<End> ends_;
	};

	/// Two cells in each direction, with a spring at each node of the base.
	template <int Dim> struct Raft {
		static constexpr double stiffness = 2e5;
		Model<Dim>              model;
		PointCloud<Dim>         cloud;
		Springs<Dim>            springs { stiffness * Mat<Dim>::Identity(), {} };
		LinearSolver            solver;

		Raft()
		{
			model.grid.cellSize    = 0.5;
			model.materials        = { { Hencky(1e7, 0.3), 2000 } };
			model.newton.tolerance = 1e-9;
			model.terms            = { [this](const StepContext<Dim>& step) { return std::make_unique<SpringForce<Dim>>(springs, step.basis); } };
			cloud                  = block<Dim>(model.grid, Index<Dim>::Constant(2), 2);
			Index<Dim> base        = Index<Dim>::Constant(3);
			base[1]                = 1;
			forIndices<Dim>(Index<Dim>::Zero(), base, [&](const Index<Dim>& n) { springs.elongation[Grid<Dim>::key(n)].setZero(); });
		}
		double     weight() const { return 10 * 2000; } // 1 m wide in every direction
		Load<Dim>  load(double factor) const { return { -10 * Vec<Dim>::Unit(1), factor }; }
		StepReport step(double factor) { return loadStep(cloud, model, load(factor), solver); }
	};

	template <class T> using SpringTerm = InBothDimensions<T>;
	TYPED_TEST_SUITE(SpringTerm, BothDimensions, DimensionName);

	TYPED_TEST(SpringTerm, ForceAndStiffnessAreAddedToTheOthers)
	{
		constexpr int Dim = TypeParam::value;
		Raft<Dim>     raft;
		auto          bare = raft.model;
		bare.terms.clear();
		StepReport            report;
		const StepSystem<Dim> with(raft.cloud, raft.model, raft.load(1), report), without(raft.cloud, bare, raft.load(1), report);
		ASSERT_EQ(with.terms.size(), without.terms.size() + 1);

		Random                random;
		const Eigen::VectorXd d = random.vector(with.nodalSize(), 1e-3);
		NodeMatrix<Dim>       K, K0;
		Eigen::VectorXd       force, force0, absoluteContributions, absoluteContributions0;
		with.prepare(K), without.prepare(K0);
		ASSERT_FALSE(with.evaluate(d, force, &K, &absoluteContributions) || without.evaluate(d, force0, &K0, &absoluteContributions0));
		Eigen::VectorXd k = Eigen::VectorXd::Zero(d.size()); // the springs' stiffness at each degree of freedom
		for (const auto& [key, elongation] : raft.springs.elongation)
			k.template segment<Dim>(Dim * position(with.basis.nodes, key)).fill(raft.stiffness);
		const Eigen::VectorXd expected = k.cwiseProduct(d);
		EXPECT_LT((force - force0 - expected).norm(), 1e-10 * force.norm());
		EXPECT_LT((absoluteContributions - absoluteContributions0 - expected.cwiseAbs()).norm(), 1e-10 * absoluteContributions.norm());
		EXPECT_LT((dense(K) - dense(K0) - Eigen::MatrixXd(k.asDiagonal())).norm(), 1e-12 * dense(K).norm());
		EXPECT_NEAR(with.fromOutside(d) / expected.norm(), 1, 1e-12);
		EXPECT_TRUE(with.isSymmetric());
	}

	TYPED_TEST(SpringTerm, SpringsAloneHoldABody)
	{
		Raft<TypeParam::value> raft;
		const auto             report = raft.step(1);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_LE(report.iterations, 4) << "their stiffness is that of the force";
		EXPECT_NEAR(raft.springs.total()[1] / -raft.weight(), 1, 1e-8);

		Raft<TypeParam::value> sliding;
		sliding.springs.stiffness(0, 0) = 0;
		EXPECT_EQ(sliding.step(1).cause.substr(0, 43), "nothing restrains the translation along x o");
		Raft<TypeParam::value> loose;
		loose.model.terms.clear();
		EXPECT_EQ(loose.step(1).failure, Failure::unrestrained);
	}

	TYPED_TEST(SpringTerm, TheResidualIsComparedWithTheirForces)
	{
		constexpr int Dim = TypeParam::value;
		Raft<Dim>     raft;
		ASSERT_TRUE(raft.step(1).converged());
		StepReport            numbers;
		const StepSystem<Dim> system(raft.cloud, raft.model, raft.load(1.01), numbers);
		const Eigen::VectorXd start = Eigen::VectorXd::Zero(system.nodalSize());
		Eigen::VectorXd       force;
		ASSERT_FALSE(system.evaluate(start, force, nullptr));
		const double outside = system.fromOutside(start), residual = (system.external - force).norm();
		EXPECT_GT(outside, 0.5 * system.external.norm());
		const auto report = raft.step(1.01);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_NEAR(report.residuals.front() * std::hypot(system.external.norm(), outside) / residual, 1, 1e-9);
	}

	TYPED_TEST(SpringTerm, WhatTheyRememberIsWrittenByAcceptedStepsOnly)
	{
		Raft<TypeParam::value> raft;
		ASSERT_TRUE(raft.step(0.5).converged());
		const auto   half = raft.springs.elongation;
		const double top  = raft.cloud.position.back()[1];
		EXPECT_NEAR(raft.springs.total()[1] / (-0.5 * raft.weight()), 1, 1e-8);

		raft.model.newton.maxIterations = 1;
		ASSERT_EQ(raft.step(1).failure, Failure::tooManyIterations);
		EXPECT_EQ(raft.springs.elongation, half);

		raft.model.newton.maxIterations = 20;
		ASSERT_TRUE(raft.step(1).converged());
		EXPECT_NEAR(raft.springs.total()[1] / -raft.weight(), 1, 1e-8) << "the second step goes on where the first one ended";
		ASSERT_TRUE(raft.step(0).converged());
		EXPECT_NEAR(raft.springs.total()[1], 0, 1e-8 * raft.weight());
		EXPECT_GT(raft.cloud.position.back()[1], top) << "it has come back";
	}

	/// Springs that break.
	template <int Dim> class BrittleSprings : public SpringForce<Dim> {
	public:
		BrittleSprings(Springs<Dim>& springs, const CloudBasis<Dim>& basis, double strength) : SpringForce<Dim>(springs, basis), strength_(strength) { }

		Refusal refusal(const Eigen::VectorXd& d) override
		{
			if (this->fromOutside(d) <= strength_) return {};
			return { Failure::refused, "springs would break", "Stronger springs would bear it." };
		}

	private:
		double strength_;
	};

	TYPED_TEST(SpringTerm, WhatItRefusesIsToldInItsWords)
	{
		constexpr int Dim = TypeParam::value;
		Raft<Dim>     raft;
		const double  strength = raft.weight() / 4;
		raft.model.terms = { [&](const StepContext<Dim>& step) { return std::make_unique<BrittleSprings<Dim>>(raft.springs, step.basis, strength); } };
		ASSERT_TRUE(raft.step(0.1).converged());
		const auto half   = raft.springs.elongation;
		const auto report = raft.step(1);
		EXPECT_EQ(report.failure, Failure::refused);
		EXPECT_EQ(report.cause, "springs would break");
		EXPECT_EQ(report.advice, "Stronger springs would bear it.");
		EXPECT_TRUE(canBeCut(report.failure));
		EXPECT_EQ(raft.springs.elongation, half) << "the step has been turned down";
	}

	TYPED_TEST(SpringTerm, WithAnUnsymmetricStiffnessNewtonsMethodConvergesQuadratically)
	{
		for (const auto method : { LinearMethod::direct, LinearMethod::iterative }) {
			Raft<TypeParam::value> raft;
			// Settles by a tenth, and leans.
			raft.model.materials           = { { Hencky(1e5, 0.3), 2000 } };
			raft.springs.stiffness(0, 1)   = 0.3 * raft.stiffness;
			raft.springs.stiffness(1, 0)   = -0.1 * raft.stiffness;
			raft.model.newton.reuseFactor  = false; // it converges linearly
			raft.model.newton.linearSolver = method;
			raft.model.newton.tolerance    = 1e-11;
			const auto report              = raft.step(1);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_NEAR(raft.springs.total()[1] / -raft.weight(), 1, 1e-8);
			EXPECT_NEAR(raft.springs.total()[0] / raft.weight(), 0, 1e-8);
			std::printf("unsymmetric, %dD, %s:", TypeParam::value, method == LinearMethod::direct ? "LU" : "GMRES");
			for (const double r : report.residuals)
				std::printf(" %.1e", r);
			std::printf(", order %.2f, %d iterations of GMRES\n", convergenceOrder(report.residuals, 1e-13), report.conjugateGradients.iterations);
			EXPECT_GT(convergenceOrder(report.residuals, 1e-13), 1.8);
			EXPECT_EQ(report.luSolves > 0, method == LinearMethod::direct);
			EXPECT_EQ(report.conjugateGradients.iterations > 0, method == LinearMethod::iterative);
		}
	}

} // namespace
} // namespace gimpm::testTerms
