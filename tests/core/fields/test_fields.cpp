// SPDX-License-Identifier: GPL-2.0-or-later
// A second field at the nodes, solved for together with displacements: pressure in pores, or temperature. It is what
// the developer's page tells how to add.
#include "core/grid/point_nodes.hpp"
#include "core/stepping/load_step.hpp"
#include "derivatives.hpp"
#include "moving.hpp"
#include "scenes.hpp"

namespace gimpm::testFields {
namespace {

	/// What flows through the soil, and what it does to it.
	struct Medium {
		/// Of a flow by the gradient of the pressure, times the duration of the step.
		double conductivity = 1;
		double growth       = 0;    ///< of the conductivity, by the pressure [1/Pa]
		double push         = 0;    ///< of the stress, by the pressure: 1 in pores, Young's modulus times expansion for a temperature
		double storage      = 0;    ///< of the balance of what flows, by the volume of the soil: 1 in pores, 0 for a temperature
		double sign         = 1;    ///< of the balance; -1 makes the matrix of pores symmetric
		double ghost        = 0.01; ///< penalty on jumps of the gradient, over the conductivity
	};

	/// Points and their nodes with values and gradients of the functions, along the axes as the step begins.
	template <int Dim, class F> void forGradients(const CloudBasis<Dim>& basis, F&& f)
	{
		forPointNodes(basis, 0, int(basis.patches.size()), [&](int p, const Patch<Dim>& patch, const double* value, int count) {
			Vec<Dim> gradient[windowNodes<Dim>];
			for (int n = 0; n < count; ++n)
				for (int i = 0; i < Dim; ++i) {
					gradient[n][i] = 1;
					for (int a = 0, rest = n; a < Dim; rest /= patch.nodesAlong(a), ++a) {
						const auto& axis = basis.axes[p][a];
						gradient[n][i] *= (a == i ? axis.slope : axis.value)[rest % patch.nodesAlong(a)];
					}
				}
			f(basis.order[p], patch, value, gradient, count);
		});
	}

	/// Balance of what flows, its work on the soil, and a ghost penalty. The flow is that through the soil as the
	/// step begins.
	template <int Dim> class Flow : public CoupledTerm<Dim> {
	public:
		static constexpr int field = 1;

		Flow(const Medium& medium, const Beginning<Dim>& step) : medium_(medium), basis_(step.basis), h_(step.grid.cellSize), faces_(step.faces)
		{
			for (std::size_t p = 0; p < step.cloud.size(); ++p)
				volume_.push_back(step.cloud.volume0[p] * step.cloud.volumeRatio(p));
			for (auto& face : faces_)
				face.stiffness = medium.sign * medium.ghost * medium.conductivity * h_ / 3;
		}
		bool isSymmetric() const override { return medium_.growth == 0 && medium_.push == -medium_.sign * medium_.storage; }

		void mark(NodeMatrix<Dim>& K) const override
		{
			for (const auto& patch : basis_.patches)
				forPairs(patch, [&](int a, int, int, int, int code) {
					if (code >= 0) K.markUsed(patch.node[a], code);
				});
		}
		void markCouplings(Couplings& K) const override
		{
			for (const auto& patch : basis_.patches)
				forPairs(patch, [&](int, int, int a, int b, int) {
					K.mark({ field, a }, { field, b });
					K.mark({ 0, a }, { field, b });
				});
			forGhostPairs<Dim>(faces_, h_, [&](int a, int b, int, double) { K.mark({ field, a }, { field, b }); });
		}
		std::optional<PointFailure> addCoupled(const State& state, const FieldSum<Dim>& sum) const override
		{
			const Eigen::VectorXd& d = state.displacements();
			const Eigen::VectorXd  P = state.value(field);
			forGradients(basis_, [&](int point, const Patch<Dim>& patch, const double* S, const Vec<Dim>* G, int count) {
				PointState s(volume_[point]);
				for (int n = 0; n < count; ++n) {
					const int a = patch.node[n];
					if (a < 0) continue;
					s.F += d.template segment<Dim>(Dim * a) * G[n].transpose();
					s.pressure += S[n] * P[a], s.slope += P[a] * G[n];
				}
				s.finish();
				addForces(s, patch, S, G, count, sum);
				if (sum.K) addStiffness(s, patch, S, G, sum);
			});
			addGhost(P, sum);
			return std::nullopt;
		}
		void addCoupledRoundOff(const State& state, std::vector<Eigen::VectorXd>& sizes) const override
		{
			constexpr double      roundOff = 10 * precision;
			const Eigen::VectorXd P        = state.value(field);
			forGradients(basis_, [&](int point, const Patch<Dim>& patch, const double*, const Vec<Dim>* G, int count) {
				double slope = 0;
				for (int n = 0; n < count; ++n)
					if (patch.node[n] >= 0) slope += G[n].norm() * std::abs(P[patch.node[n]]);
				for (int n = 0; n < count; ++n)
					if (patch.node[n] >= 0)
						sizes[field][patch.node[n]] += roundOff * medium_.conductivity * volume_[point] * slope * G[n].norm();
			});
		}

	private:
		struct PointState {
			double   volume, pressure = 0, J = 1;
			Vec<Dim> slope = Vec<Dim>::Zero();
			Mat<Dim> F     = Mat<Dim>::Identity(), inverse; // of the deformation in the step
			explicit PointState(double volume) : volume(volume) { }
			void     finish() { J = F.determinant(), inverse = F.inverse(); }
			Vec<Dim> now(const Vec<Dim>& gradient) const { return inverse.transpose() * gradient; }
		};

		void addForces(const PointState& s, const Patch<Dim>& patch, const double* S, const Vec<Dim>* G, int count, const FieldSum<Dim>& sum) const
		{
			const double conductivity = medium_.conductivity * (1 + medium_.growth * s.pressure);
			for (int n = 0; n < count; ++n) {
				const int a = patch.node[n];
				if (a < 0) continue;
				const Vec<Dim> push   = -medium_.push * s.pressure * s.volume * s.J * s.now(G[n]);
				const double   flow   = medium_.sign * conductivity * s.volume * s.slope.dot(G[n]);
				const double   stored = medium_.sign * medium_.storage * s.volume * (s.J - 1) * S[n];
				sum.force[0].template segment<Dim>(Dim * a) += push;
				sum.sizes[0].template segment<Dim>(Dim * a) += push.cwiseAbs();
				sum.force[field][a] += flow + stored;
				sum.sizes[field][a] += std::abs(flow) + std::abs(stored);
			}
		}
		void addStiffness(const PointState& s, const Patch<Dim>& patch, const double* S, const Vec<Dim>* G, const FieldSum<Dim>& sum) const
		{
			const double conductivity = medium_.conductivity * (1 + medium_.growth * s.pressure), growth = medium_.conductivity * medium_.growth;
			forPairs(patch, [&](int m, int n, int a, int b, int code) {
				const Vec<Dim> ga = s.now(G[m]), gb = s.now(G[n]);
				const Mat<Dim> work = -medium_.push * s.pressure * s.volume * s.J * (ga * gb.transpose() - gb * ga.transpose());
				sum.K->add(a, b, code, work);
				const Vec<Dim> push   = -medium_.push * s.volume * s.J * S[n] * ga;
				const Vec<Dim> stored = medium_.sign * medium_.storage * s.volume * s.J * S[m] * gb;
				sum.couplings->add({ 0, a }, { field, b }, push);
				sum.couplings->add({ field, a }, { 0, b }, stored.transpose());
				sum.couplings->add(
				        { field, a }, { field, b }, medium_.sign * s.volume * (conductivity * G[n] + growth * S[n] * s.slope).dot(G[m]));
			});
		}
		void addGhost(const Eigen::VectorXd& P, const FieldSum<Dim>& sum) const
		{
			forGhostPairs<Dim>(faces_, h_, [&](int a, int b, int, double k) {
				for (const auto& [row, column] : { std::pair(a, b), std::pair(b, a) }) {
					sum.force[field][row] += k * P[column];
					if (sum.couplings) sum.couplings->add({ field, row }, { field, column }, k);
					if (a == b) break;
				}
			});
		}
		/// Calls f(local node, local node, node, node, code of the offset between them).
		template <class F> static void forPairs(const Patch<Dim>& patch, F&& f)
		{
			int count = 1;
			for (int a = 0; a < Dim; ++a)
				count *= patch.nodesAlong(a);
			for (int m = 0; m < count; ++m)
				for (int n = 0; n < count; ++n) {
					Index<Dim> offset;
					for (int a = 0, i = m, j = n; a < Dim; i /= patch.nodesAlong(a), j /= patch.nodesAlong(a), ++a)
						offset[a] = j % patch.nodesAlong(a) - i % patch.nodesAlong(a);
					if (patch.node[m] >= 0 && patch.node[n] >= 0) f(m, n, patch.node[m], patch.node[n], NodeMatrix<Dim>::code(offset));
				}
		}

		const Medium&               medium_;
		const CloudBasis<Dim>&      basis_;
		double                      h_;
		std::vector<GhostFace<Dim>> faces_;
		std::vector<double>         volume_;
	};

	/// A body of four cells by two on rollers, with a layer on top that fills so much of its cells. The pressure is
	/// given at both ends.
	template <int Dim> struct Body {
		static constexpr double h = 0.5, length = 4 * h, young = 1e6;
		Model<Dim>              model;
		PointCloud<Dim>         cloud;
		LinearSolver            solver;
		Medium                  medium;
		double                  before = 0, ends[2] = { 3e3, 7e3 };
		std::vector<Vec<Dim>>   nodes; // of the last step that was accepted
		Eigen::VectorXd         value, flow;

		explicit Body(double cut, const std::vector<HeldBox<Dim>>& more = {})
		{
			model.grid.cellSize    = h;
			model.grid.origin      = Vec<Dim>::Constant(0.2);
			model.materials        = { { Hencky(young, 0), 1 } };
			model.newton.tolerance = 1e-10;
			std::vector<HeldBox<Dim>> walls;
			for (int a = 0; a < Dim; ++a)
				walls.push_back(wallBelow<Dim>(model.grid, a, model.grid.origin[a]));
			walls.insert(walls.end(), more.begin(), more.end());
			model.boundary = Boundary<Dim>(walls);
			cloud          = block<Dim>(model.grid, cellsOf<Dim>(4, 2, 2), 2);
			addLayer(cut);
			model.fields       = { { { "pressure", "Pa", 1, young / h },
				                 [this](const PointCloud<Dim>&, const CloudBasis<Dim>& basis, const Grid<Dim>& grid) { return start(basis, grid); },
				           [this](const CloudBasis<Dim>& basis, const Eigen::VectorXd& v, const Eigen::VectorXd& f) {
				                   nodes= nodePositions(basis, model.grid), value = v, flow = f;
				           } } };
			model.coupledTerms = { [this](const Beginning<Dim>& step, const State&) { return std::make_unique<Flow<Dim>>(medium, step); } };
		}
		static HeldBox<Dim> farEnd(const Model<Dim>& model, double displacement)
		{
			Vec<Dim> min = Vec<Dim>::Constant(-infinity);
			min[0]       = model.grid.origin[0] + length;
			return held<Dim>(model.grid, min, Vec<Dim>::Constant(infinity), "x", displacement * Vec<Dim>::Unit(0));
		}
		StepReport step() { return loadStep<Dim>(cloud, model, { Vec<Dim>::Zero(), { 1, 1 } }, solver); }

		/// Between those at both ends.
		double linear(const Vec<Dim>& x) const { return ends[0] + (ends[1] - ends[0]) * (x - model.grid.origin)[0] / length; }

	private:
		void addLayer(double cut)
		{
			const double spacing = h / 2;
			forIndices<Dim>(cellsOf<Dim>(0, 0, 0), cellsOf<Dim>(8, 1, 4), [&](const Index<Dim>& i) {
				Vec<Dim> x    = model.grid.origin + spacing * (i.template cast<double>() + Vec<Dim>::Constant(0.5)),
				         half = Vec<Dim>::Constant(spacing / 2);
				x[1]          = model.grid.origin[1] + 2 * h + cut * h / 2;
				half[1]       = cut * h / 2;
				addPoint<Dim>(cloud, x, half);
			});
		}
		FieldStart start(const CloudBasis<Dim>& basis, const Grid<Dim>& grid) const
		{
			const auto x = nodePositions(basis, grid);
			FieldStart start { Eigen::VectorXd::Constant(Eigen::Index(x.size()), before), {} };
			for (std::size_t n = 0; n < x.size(); ++n)
				for (const int end : { 0, 1 })
					if (std::abs(x[n][0] - grid.origin[0] - end * length) < 1e-9) start.given[int(n)] = ends[end];
			return start;
		}
	};

	constexpr double cuts[] = { 1e-1, 1e-3, 1e-5, 1e-8 };

	template <class Dimension> using Fields = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Fields, BothDimensions, DimensionName);

	/// Displacements and pressure beside each other, as far as the last digits.
	TYPED_TEST(Fields, LinearOnesAreExactAtAnyCutOfTheCells)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto method : { LinearMethod::direct, LinearMethod::iterative })
			for (const double cut : cuts) {
				const double    strain = 0.02;
				const Body<Dim> plain(cut);
				Body<Dim>       body(cut, { Body<Dim>::farEnd(plain.model, strain * plain.length) });
				const auto      before         = body.cloud.position;
				body.model.newton.linearSolver = method;
				const StepReport report        = body.step();
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_EQ(report.luSolves, 0);
				EXPECT_EQ(report.conjugateGradients.iterations > 0, method == LinearMethod::iterative);
				for (std::size_t n = 0; n < body.nodes.size(); ++n)
					ASSERT_NEAR(body.value[n], body.linear(body.nodes[n]), 1e-8 * body.ends[1]) << cut;
				for (std::size_t p = 0; p < before.size(); ++p)
					for (int a = 0; a < Dim; ++a) {
						const double x = before[p][a] - body.model.grid.origin[a];
						ASSERT_NEAR(body.cloud.position[p][a] - before[p][a], a == 0 ? strain * x : 0, 1e-9 * strain * body.length)
						        << cut;
					}
				const double area = Dim == 2 ? (2 + cut) * body.h : (2 + cut) * body.h * 2 * body.h,
				             flow = (body.ends[1] - body.ends[0]) / body.length * area;
				double in         = 0;
				for (std::size_t n = 0; n < body.nodes.size(); ++n)
					if (body.nodes[n][0] > body.model.grid.origin[0] + body.length - 1e-9) in += body.flow[n];
				EXPECT_NEAR(in / flow, 1, 1e-9) << "what holds the pressure at one end feeds the flow";
			}
	}

	TYPED_TEST(Fields, TheirGhostPenaltyBoundsTheConditionNumber)
	{
		constexpr int Dim       = TypeParam::value;
		const auto    condition = [](double cut, double ghost) {
                        Body<Dim> body(cut);
                        body.medium.ghost = ghost;
                        // As large as the stiffness, with the scale of the field.
                        body.medium.conductivity = 1 / body.young;
                        body.model.boundary      = Boundary<Dim>(
                                prescribedSurface<Dim>(body.model.grid, cellsOf<Dim>(4, 1, 2), [](const Vec<Dim>&) -> Vec<Dim> { return Vec<Dim>::Zero(); }));
                        return conditionEstimate(tangentStiffness(body.cloud, body.model));
		};
		EXPECT_LT(condition(1e-8, 0.01), 1.05 * condition(1e-4, 0.01));
		EXPECT_GT(condition(1e-8, 0), 1e3 * condition(1e-4, 0));
	}

	/// A temperature that is the same everywhere expands the body alike along all axes: E ln l = push T J, J =
	/// l^Dim.
	TYPED_TEST(Fields, WarmthExpandsTheBodyAsInTheClosedForm)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto method : { LinearMethod::direct, LinearMethod::iterative })
			for (const double cut : cuts) {
				Body<Dim> body(cut);
				body.medium.push = 20;
				body.ends[0] = body.ends[1]    = 1e3;
				body.before                    = 300;
				body.model.newton.linearSolver = method;
				body.model.newton.reuseFactor  = false;
				const auto       before        = body.cloud.position;
				const StepReport report        = body.step();
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_EQ(report.luSolves > 0, method == LinearMethod::direct)
				        << "the matrix is not symmetric: nothing cools by being stretched";
				EXPECT_LE(report.iterations, 6);
				double stretch = 1;
				for (int i = 0; i < 60; ++i)
					stretch = std::exp(20 * 1e3 / body.young * std::pow(stretch, Dim));
				for (std::size_t n = 0; n < body.nodes.size(); ++n)
					ASSERT_NEAR(body.value[n], 1e3, 1e-7) << cut;
				for (std::size_t p = 0; p < before.size(); ++p) {
					const Vec<Dim> expected = (stretch - 1) * (before[p] - body.model.grid.origin);
					ASSERT_LT((body.cloud.position[p] - before[p] - expected).norm(), 1e-8 * body.length) << cut;
				}
			}
	}

	/// Coupled one way, both ways, and so that the matrix is symmetric: each block of it along directions in one of
	/// the fields.
	TYPED_TEST(Fields, TheTangentIsThatOfTheForces)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& [push, storage, sign, growth] : { std::tuple(20., 0., 1., 0.), std::tuple(1., 1., 1., 1e-4), std::tuple(1., 1., -1., 0.) }) {
			Body<Dim> body(0.3);
			body.medium = { 1e-7, growth, push, storage, sign, 0.01 };
			StepReport            report;
			const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
			const double          sizes[] = { 0.03, 5e3 };
			Random                random(3);
			const auto            inField = [&](int field, double part) {
                                Eigen::VectorXd x       = Eigen::VectorXd::Zero(system.map.size());
                                system.map.of(field, x) = random.vector(system.map.end(field) - system.map.begin(field), part * sizes[field]);
                                return x;
			};
			const Eigen::VectorXd x = inField(0, 1) + inField(1, 1);
			NodeMatrix<Dim>       K;
			Couplings             beside;
			Eigen::VectorXd       force;
			system.prepare(K, &beside);
			ASSERT_FALSE(system.evaluate(x, force, &K, nullptr, &beside));
			const auto at = [&](const Eigen::VectorXd& place) -> Eigen::VectorXd {
				system.evaluate(place, force, nullptr);
				return force;
			};
			const auto product = [&](const Eigen::VectorXd& direction) {
				Eigen::VectorXd result = Eigen::VectorXd::Zero(x.size());
				K.multiplyAdd(direction, result);
				beside.multiplyAdd(direction, result);
				return result;
			};
			for (const int column : { 0, 1 }) {
				const Eigen::VectorXd step = inField(column, 3e-3), tangent = product(step);
				const Eigen::VectorXd slope = (8 * (at(x + step) - at(x - step)) - (at(x + 2 * step) - at(x - 2 * step))) / 12;
				for (const int row : { 0, 1 }) {
					const double size  = system.map.of(row, slope).norm(),
					             error = (system.map.of(row, tangent) - system.map.of(row, slope)).norm();
					EXPECT_LE(error, 1e-7 * size) << row << column;
					EXPECT_EQ(size > 0, !(row == 1 && column == 0 && storage == 0)) << row << column;
				}
			}
			const Eigen::VectorXd a = inField(0, 1) + inField(1, 1), b = inField(0, 1) + inField(1, 1);
			const double          ab = a.dot(product(b)), ba = b.dot(product(a));
			EXPECT_EQ(system.isSymmetric(), sign < 0);
			EXPECT_EQ(std::abs(ab - ba) < 1e-11 * a.norm() * product(b).norm(), sign < 0);
		}
	}

	/// What leaves the body is what its volume loses, and the order of convergence is that of Newton's method,
	/// whether or not the matrix is symmetric.
	TYPED_TEST(Fields, WaterThatLeavesIsTheLossOfVolume)
	{
		constexpr int Dim = TypeParam::value;
		for (const double sign : { 1., -1. }) {
			Body<Dim> body(0.3);
			body.medium = { 1e-8, 0, 1, 1, sign, 0.01 };
			// Above that at the ends: the body has been swollen by nothing, and now it shrinks.
			body.before  = 4e4;
			body.ends[0] = -2e4, body.ends[1] = -5e4;
			body.model.newton.reuseFactor = false;
			body.model.newton.tolerance   = 1e-12;
			const auto volume             = [&] {
                                double sum = 0;
                                for (std::size_t p = 0; p < body.cloud.size(); ++p)
                                        sum += body.cloud.volume0[p] * body.cloud.volumeRatio(p);
                                return sum;
			};
			const double     before = volume();
			const StepReport report = body.step();
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_GT(report.luSolves, 0) << "symmetric, but not positive definite";
			EXPECT_GT(std::abs(volume() / before - 1), 0.004);
			EXPECT_NEAR(sign * body.flow.sum() / (volume() - before), 1, 1e-10);
			EXPECT_GT(convergenceOrder(report.residuals, 1e-13), 1.7);
		}
	}

	/// The flow is smaller than the forces by 16 powers of ten, and in balance all the same.
	TYPED_TEST(Fields, EachIsMeasuredByItself)
	{
		constexpr int   Dim = TypeParam::value;
		const Body<Dim> plain(0.3);
		Body<Dim>       body(0.3, { Body<Dim>::farEnd(plain.model, 0.02 * plain.length) });
		body.medium.conductivity      = 1e-20;
		body.medium.growth            = 1e-3;
		body.model.newton.reuseFactor = false;
		const StepReport report       = body.step();
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_GT(report.iterations, 3);
		const double P0 = body.ends[0], P1 = body.ends[1], b = body.medium.growth, slope = (P1 - P0) * (1 + b * (P0 + P1) / 2) / body.length;
		double       in = 0, out = 0;
		for (std::size_t n = 0; n < body.nodes.size(); ++n)
			if (const double x = body.nodes[n][0] - body.model.grid.origin[0]; x < 1e-9) out -= body.flow[n];
			else if (x > body.length - 1e-9)
				in += body.flow[n];
		EXPECT_NEAR(in / out, 1, 1e-9);
		EXPECT_NEAR(in / (1e-20 * slope * 2.3 * body.h * (Dim == 3 ? 2 * body.h : 1)), 1, 0.01);
		body.model.newton.maxIterations = 2;
		body.ends[1]                    = 9e3;
		const StepReport other          = body.step();
		EXPECT_EQ(other.failure, Failure::tooManyIterations);
		EXPECT_EQ(other.worst.axis, -1);
		EXPECT_EQ(other.worst.field, "pressure");
		EXPECT_NE(other.cause.find("most of it is of the pressure"), std::string::npos) << other.cause;
	}

	/// A large value that is the same everywhere leaves flows of round-off, which are none.
	TYPED_TEST(Fields, RoundOffOfLargeValuesIsNoFlow)
	{
		Body<TypeParam::value> body(1e-3);
		body.before = body.ends[0] = body.ends[1] = 1. / 3 * 1e9;
		ASSERT_TRUE(body.step().converged());
		body.ends[0] = body.ends[1]    = 1. / 7 * 1e9;
		body.model.newton.linearSolver = LinearMethod::iterative;
		const StepReport report        = body.step();
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_LE(report.iterations, 3);
	}

	TEST(Fields, AreRefusedByNameWhereTheyAreNotKnown)
	{
		Body<2> body(0.3);
		body.model.coupledTerms.clear();
		EXPECT_EQ(body.step().cause, "no term is for the field 'pressure'");

		struct FirstOfTwo : OneProcess {
			int size() const override { return 2; }
		};
		Body<2> shared(0.3);
		shared.model.processes  = std::make_shared<FirstOfTwo>();
		const StepReport report = shared.step();
		EXPECT_EQ(report.failure, Failure::misplaced);
		EXPECT_EQ(report.cause, "several processes can share displacements only, and there is the field 'pressure'");

		Body<2>   field(0.3);
		Moving<2> inTime(1, Hencky(1e6, 0), 1000, TimeScheme::centralDifferences());
		inTime.put(field.cloud, [](const Vec<2>&) { return Vec<2>(Vec<2>::Zero()); });
		inTime.model.grid           = field.model.grid;
		inTime.model.fields         = field.model.fields;
		inTime.model.coupledTerms   = field.model.coupledTerms;
		const StepReport explicitly = inTime.step(1e-4);
		EXPECT_EQ(explicitly.failure, Failure::misplaced);
		EXPECT_EQ(explicitly.cause, "explicit steps are for displacements only, and there is the field 'pressure'");
	}

	/// Of a column on an impermeable base under a load, which drains at its top: the settlement is that of
	/// Terzaghi's series.
	TEST(Fields, AColumnConsolidates)
	{
		constexpr int cells = 10, steps = 40;
		// Up to T = 0.5.
		constexpr double h = 0.1, young = 1e6, kappa = 1e-8, load = 100, duration = 0.5 / (kappa * young) / steps;
		Model<2>         model;
		model.grid.cellSize = h;
		model.materials     = { { Hencky(young, 0), 0 } };
		model.boundary      = Boundary<2>({ wallBelow<2>(model.grid, 1, 0), wallBelow<2>(model.grid, 0, 0), wallAbove<2>(model.grid, 0, h) });
		PointCloud<2> cloud = block<2>(model.grid, { 1, cells }, 2);
		cloud.force.assign(cloud.size(), Vec<2>::Zero());
		cloud.force[cloud.size() - 1][1] = cloud.force[cloud.size() - 2][1] = -load * h / 2;
		const double    top                                                 = cloud.position.back()[1];
		const Medium    medium { kappa * duration, 0, 1, 1, -1, 0.01 };
		Eigen::VectorXd pressure;
		const auto      start = [&](const PointCloud<2>&, const CloudBasis<2>& basis, const Grid<2>& grid) {
                        FieldStart start { pressure.size() > 0 ? pressure : Eigen::VectorXd::Zero(Eigen::Index(basis.nodes.size())), {} };
                        const auto x = nodePositions(basis, grid);
                        for (std::size_t n = 0; n < x.size(); ++n)
                                if (x[n][1] > cells * h - 1e-9) start.given[int(n)] = 0;
                        return start;
		};
		const auto keep    = [&](const CloudBasis<2>&, const Eigen::VectorXd& value, const Eigen::VectorXd&) { pressure = value; };
		model.fields       = { { { "pressure", "Pa", 1, young / h }, start, keep } };
		model.coupledTerms = { [&](const Beginning<2>& step, const State&) { return std::make_unique<Flow<2>>(medium, step); } };
		LinearSolver solver;
		for (int step = 0; step < steps; ++step) {
			const auto report = loadStep<2>(cloud, model, { Vec<2>::Zero(), { 1, step == 0 ? 1. : 0. } }, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
		}
		double degree = 1;
		for (int k = 0; k < 50; ++k) {
			const double m = M_PI * (2 * k + 1) / 2;
			degree -= 2 / (m * m) * std::exp(-m * m * 0.5);
		}
		// a quarter of the load acts at the lower nodes of the uppermost cell
		const double settled = (top - cloud.position.back()[1]) / (load / young * ((cells - 1) * h + 0.75 * 0.75 * h));
		EXPECT_NEAR(settled / degree, 1, 0.02);
	}

} // namespace
} // namespace gimpm::testFields
