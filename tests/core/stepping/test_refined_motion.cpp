// SPDX-License-Identifier: GPL-2.0-or-later
// Time steps on cells of several sizes.
#include "core/stepping/critical_step.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/inertia/absorbing.hpp"
#include "core/terms/inertia/nodal_mass.hpp"
#include "core/terms/inertia/rayleigh.hpp"
#include "moving.hpp"
#include "refined.hpp"

namespace gimpm::testRefinedMotion {
namespace {

	template <class T> using RefinedMotion = InBothDimensions<T>;
	TYPED_TEST_SUITE(RefinedMotion, BothDimensions, DimensionName);

	constexpr double lumped = 0, consistent = 0.25;

	/// Schemes with the ghost mass that each goes with.
	std::vector<std::pair<TimeScheme, double>> schemes()
	{
		return { { TimeScheme(), 1e-3 },
			 { TimeScheme::generalisedAlpha(0.8), 1e-3 },
			 { TimeScheme::midpoint(), 1e-3 },
			 { TimeScheme::centralDifferences(), lumped },
			 { TimeScheme::centralDifferences(), consistent } };
	}

	/// Cells of three sizes; the block is away from their lines by `cut` and lies across all sizes.
	template <int Dim, class F> Moving<Dim> flying(const TimeScheme& scheme, double ghostMass, double cut, F&& velocity, double poisson = 0.3)
	{
		Moving<Dim> body(1, Hencky(1e6, poisson), 1000, scheme);
		body.model.grid        = cornerGrid<Dim>();
		body.motion->ghostMass = ghostMass;
		if (ghostMass == lumped) body.model.ghost.factor = 0;
		body.put(shifted<Dim>(refinedBlock<Dim>(body.model.grid, Index<Dim>::Constant(2), 2), Vec<Dim>::Constant(cut)), velocity);
		return body;
	}

	template <int Dim> double critical(const Moving<Dim>& body) { return criticalStep(body.cloud, body.model, body.motion->ghostMass, 0); }

	template <int Dim> double stepOf(const Moving<Dim>& body) { return body.motion->scheme.isExplicit ? critical(body) : 0.0131; }

	template <int Dim> Vec<Dim> spin(const Vec<Dim>& x)
	{
		Vec<Dim> v = Vec<Dim>::Zero();
		v[0] = -x[1], v[1] = x[0];
		return v;
	}

	TYPED_TEST(RefinedMotion, FreeFallIsExact)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& [scheme, ghostMass] : schemes()) {
			auto body           = flying<Dim>(scheme, ghostMass, 0.03, [](const Vec<Dim>&) { return Vec<Dim>(3 * Vec<Dim>::Unit(0)); });
			body.gravity[1]     = -10;
			const Vec<Dim> from = body.cloud.position[0];
			const double   T = stepOf(body), time = (Dim == 2 ? 20 : 5) * T;
			ASSERT_TRUE(body.steps(Dim == 2 ? 20 : 5, T));
			Vec<Dim> moved = Vec<Dim>::Zero(), v = Vec<Dim>::Zero();
			moved[0] = 3 * time, moved[1] = -10 * time * time / 2, v[0] = 3, v[1] = -10 * time;
			for (std::size_t p = 0; p < body.cloud.size(); ++p) {
				EXPECT_LT((body.motion->velocity[p] - v).norm(), 1e-11 * v.norm());
				EXPECT_LT(body.cloud.stress[p].c.norm(), 1e-5) << "of 1e6 Pa";
			}
			EXPECT_LT((body.cloud.position[0] - from - moved).norm(), 1e-11 * moved.norm());
		}
	}

	/// A body that swings by strains of some percent as it flies from small cells into large ones.
	TYPED_TEST(RefinedMotion, MomentumIsKeptToRoundOffAndEnergyWithinBounds)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& [scheme, ghostMass] : schemes()) {
			auto body = flying<Dim>(scheme, ghostMass, 0.2, [](const Vec<Dim>& x) { return Vec<Dim>(2 * Vec<Dim>::Unit(0) + 0.2 * x[1] * x); });
			const Vec<Dim> before = body.momentum();
			const double   energy = body.energy();
			ASSERT_TRUE(body.steps(Dim == 2 ? 30 : 5, body.motion->scheme.isExplicit ? critical(body) / 2 : 0.005));
			EXPECT_LT((body.momentum() - before).norm(), 1e-12 * before.norm());
			EXPECT_GT(body.elastic(), 1e-5 * energy) << "it swings";
			EXPECT_LT(body.energy() / energy, 1 + 1e-3);
			EXPECT_GT(body.energy() / energy, 0.98);
		}
	}

	/// The midpoint rule keeps angular momentum, ties or not.
	TYPED_TEST(RefinedMotion, AngularMomentumOfARigidSpin)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& [scheme, ghostMass] : { std::pair(TimeScheme::midpoint(), 1e-3), { TimeScheme::centralDifferences(), consistent } }) {
			auto         body           = flying<Dim>(scheme, ghostMass, 0, spin<Dim>);
			const double before         = body.angularMomentum();
			body.model.newton.tolerance = 1e-12;
			ASSERT_TRUE(body.steps(1, stepOf(body)));
			EXPECT_NEAR(body.angularMomentum() / before, 1, 1e-13);
		}
	}

	/// The stiffness at free unknowns against the derivative of the condensed forces, with dashpots and damping.
	TYPED_TEST(RefinedMotion, StiffnessIsTheDerivativeOfTheForce)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& scheme : { TimeScheme(), TimeScheme::generalisedAlpha(0.4), TimeScheme::midpoint() }) {
			auto                   body = flying<Dim>(scheme, 1e-3, 0, spin<Dim>);
			AbsorbingBoundary<Dim> edge { wallBelow<Dim>(body.model.grid, 0, 0) };
			Rayleigh               rayleigh { 0.3, 0.01 };
			body.motion->damping.push_back([&](const StepContext<Dim>& step) {
				return std::make_unique<Absorption<Dim>>(edge, body.model.materials, body.motion->mass, step);
			});
			body.motion->damping.push_back([&](const StepContext<Dim>& step) {
				return std::make_unique<RayleighDamping<Dim>>(rayleigh, body.model.materials, false, body.motion->mass, step);
			});
			body.motion->duration = 0.01;
			StepReport            report;
			const StepSystem<Dim> system(body.cloud, body.model, { body.gravity, { 1, 0 } }, report);
			ASSERT_FALSE(system.basis.affineConstraints.empty());
			Random          random;
			Eigen::VectorXd d = random.vector(system.nodalSize(), 1e-4), e = random.vector(system.nodalSize(), 1);
			system.constraints.template distribute<Dim>(system.map, d), system.constraints.template distribute<Dim>(system.map, e);
			NodeMatrix<Dim> K;
			Eigen::VectorXd force, above, below, tangent = Eigen::VectorXd::Zero(d.size());
			system.prepare(K);
			EXPECT_FALSE(
			        system.evaluate(d, force, &K) || system.evaluate(d + 1e-8 * e, above, nullptr)
			        || system.evaluate(d - 1e-8 * e, below, nullptr));
			K.multiplyAdd(e, tangent);
			system.constraints.template condense<Dim>(system.map, tangent);
			EXPECT_LT(((above - below) / 2e-8 - tangent).norm(), 1e-6 * tangent.norm());
		}
	}

	/// 2 / omega_max of a block that cuts cells of three sizes, by power iteration at the free unknowns.
	template <int Dim> double longestStep(const Moving<Dim>& body)
	{
		StepReport            report;
		const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
		const LinearProblem   K = tangentStiffness(system.cloud, system.model);
		NodalMass<Dim>        M(system.basis, body.motion->mass, massFaces(*body.motion, system.context()), body.model.grid.cellSize);
		const auto            free = [&](auto&& f) {
                        for (std::size_t i = 0; i < system.dofs.number.size(); ++i)
                                if (const int number = system.dofs.number[i]; number >= 0) f(Eigen::Index(i), number);
		};
		Eigen::VectorXd x = Random().vector(K.size()), force = Eigen::VectorXd::Zero(system.nodalSize()), y = force;
		double          square = 0;
		for (int i = 0; i < 80; ++i) {
			const Eigen::VectorXd ofFree = K * x;
			free([&](Eigen::Index all, int number) { force[all] = ofFree[number]; });
			EXPECT_TRUE(M.solve({ { force, system.dofs, y } }));
			square = 0;
			free([&](Eigen::Index all, int number) { x[number] = y[all]; });
			square = x.norm();
			x /= square;
		}
		return 2 / std::sqrt(square);
	}

	/// The estimate by the smallest cells is on the safe side wherever the block lies.
	TYPED_TEST(RefinedMotion, CriticalStepIsThatOfTheSmallestCells)
	{
		constexpr int Dim = TypeParam::value;
		for (const double ghostMass : { lumped, consistent }) {
			double closest = infinity;
			for (const double poisson : { 0., 0.49 })
				for (const double cut : { 1e-3, 0.1, 0.25 }) {
					if (Dim == 3 && cut != 0.1) continue;
					const auto body = flying<Dim>(TimeScheme::centralDifferences(), ghostMass, cut, spin<Dim>, poisson);
					closest         = std::min(closest, longestStep(body) / critical(body));
				}
			std::printf("ghost mass %g: longest stable step %.2f of the estimate\n", ghostMass, closest);
			EXPECT_GE(closest, 1);
			EXPECT_LE(closest, 2.5);
		}
	}

	/// Ground of a depth along x, two largest cells wide, with absorbing ends: a pulse comes from below x = 0.
	/// Cells in a range are halved, over a part of the width if `isAcross`; none where the range is empty.
	template <int Dim> struct GradedGround : Moving<Dim> {
		static constexpr double young = 1e6, poisson = 0.25, density = 1000, amplitude = 1e-4, width = 2;
		const double            shear = young / (2 * (1 + poisson)), cs = std::sqrt(shear / density), cp = std::sqrt(3 * shear / density);
		const int               depth, along;
		const double            c    = along == 0 ? cp : cs;
		double                  time = 0;

		std::vector<std::shared_ptr<AbsorbingBoundary<Dim>>> absorbing;

		GradedGround(int depth, double from, double to, bool isAcross, int along, const TimeScheme& scheme)
		        : Moving<Dim>(1, Hencky(young, poisson), density, scheme), depth(depth), along(along)
		{
			Vec<Dim> min = Vec<Dim>::Constant(-infinity), max = -min;
			min[0] = from, max[0] = to;
			if (isAcross) max[1] = 0.5;
			auto&      grid      = this->model.grid;
			const bool isRefined = to > from;
			if (isRefined) grid = refinedGrid<Dim>({ { min, max, 1 } });
			this->model.boundary    = Boundary<Dim>(sides(), { wallBelow<Dim>(grid, 0, 0), wallAbove<Dim>(grid, 0, depth) });
			this->motion->ghostMass = scheme.isExplicit ? consistent : 1e-3;
			for (const auto& end : this->model.boundary.open()) {
				absorbing.push_back(std::make_shared<AbsorbingBoundary<Dim>>(AbsorbingBoundary<Dim> { end }));
				this->motion->damping.push_back([this, known = absorbing.back()](const StepContext<Dim>& step) {
					return std::make_unique<Absorption<Dim>>(*known, this->model.materials, this->motion->mass, step);
				});
			}
			const auto size = cellsOf<Dim>(depth, 2, 2);
			this->put(isRefined ? refinedBlock<Dim>(grid, size, 2) : block<Dim>(grid, size, 2), [](const Vec<Dim>&) {
				return Vec<Dim>(Vec<Dim>::Zero());
			});
		}
		/// Sides on rollers for waves that press, and constrained across the motion for those that shear.
		std::vector<ConstrainedBox<Dim>> sides() const
		{
			std::vector<ConstrainedBox<Dim>> walls;
			for (int axis = 1; axis < Dim; ++axis)
				for (const bool isAbove : { false, true }) {
					walls.push_back(isAbove ? wallAbove<Dim>(this->model.grid, axis, 2) : wallBelow<Dim>(this->model.grid, axis, 0));
					if (axis == along) walls.back().fixed.fill(false), walls.back().fixed[0] = true;
				}
			return walls;
		}
		/// Until the centre of the pulse is at x.
		bool until(double x, double cfl)
		{
			const double start = -3 * width / c; // when the centre of the pulse would be there
			const auto   speed = [&](double t) { return amplitude * std::exp(-std::pow((t + start) * c / width, 2)); };
			for (const double T = cfl / c; time < (x / c - start) - T / 2; time += T) {
				absorbing[0]->incomingBefore[along] = speed(this->model.atMiddle ? time + T / 2 : time);
				absorbing[0]->incoming[along]       = speed(this->model.atMiddle ? time + T / 2 : time + T);
				if (!this->steps(1, T)) return false;
			}
			return true;
		}
		/// Kinetic energy of the points in a range, over that of the pulse; and the centre of their momentum.
		std::pair<double, double> between(double from, double to) const
		{
			double energy = 0, sum = 0, moment = 0;
			for (std::size_t p = 0; p < this->cloud.size(); ++p) {
				const double x = this->cloud.position[p][0], momentum = this->motion->mass[p] * this->motion->velocity[p][along];
				if (x < from || x > to) continue;
				energy += this->motion->mass[p] * this->motion->velocity[p].squaredNorm() / 2;
				sum += momentum, moment += momentum * x;
			}
			const double area = Dim == 2 ? 2 : 4, whole = density * area * amplitude * amplitude / 2 * width * std::sqrt(M_PI / 2);
			return { energy / whole, moment / sum };
		}
	};

	/// A pulse passes a layer of halved cells: it comes when it should, hardly anything is reflected, and it leaves
	/// through an end at which cells have two sizes. With equal cells the same is left behind by dispersion.
	template <int Dim> void expectPassing(const TimeScheme& scheme, int along, double cfl)
	{
		GradedGround<Dim> equal(30, 0, -1, false, along, scheme);
		ASSERT_TRUE(equal.until(24, cfl));
		const auto [behind, none]     = equal.between(0, 12);
		const auto [before, atCentre] = equal.between(12, 30);
		for (const bool isAcross : { false, true }) {
			GradedGround<Dim> graded(30, 13.2, 16.8, isAcross, along, scheme);
			ASSERT_TRUE(graded.until(24, cfl));
			const auto [reflected, nowhere] = graded.between(0, 12);
			const auto [energy, centre]     = graded.between(12, 30);
			std::printf(
			        "reflected %.1e (equal cells %.1e), energy %.4f (%.4f), centre %.3f (%.3f)\n", reflected, behind, energy, before, centre,
			        atCentre);
			EXPECT_LT(reflected, behind + (scheme.isExplicit ? 1e-3 : 2e-4));
			EXPECT_NEAR(energy, before, 5e-3);
			EXPECT_NEAR(centre, scheme.isExplicit ? atCentre : 24, 0.1);
		}
		if (scheme.isExplicit) return; // ghost mass of the ends reflects, in equal cells too
		GradedGround<Dim> atEnd(20, 18.2, infinity, true, along, scheme);
		ASSERT_TRUE(atEnd.until(28, cfl));
		EXPECT_LT(atEnd.between(0, 20).first, 1e-3);
	}

	TYPED_TEST(RefinedMotion, PulsesPassAChangeOfSize)
	{
		constexpr int Dim = TypeParam::value;
		for (const int along : { 0, 1 })
			if (Dim == 2 || along == 1) expectPassing<Dim>({}, along, 0.5);
	}

	TEST(RefinedMotion, PulsesPassAChangeOfSizeUnderEachScheme)
	{
		for (const auto& scheme : { TimeScheme::generalisedAlpha(0.8), TimeScheme::midpoint(), TimeScheme::centralDifferences() })
			scheme.isExplicit ? expectPassing<2>(scheme, 0, 0.1) : expectPassing<2>(scheme, 1, 0.5);
	}

	TEST(RefinedMotion, AbsorbingEndsBetweenNodesOfLargerCellsAreRefused)
	{
		GradedGround<2> ground(20, 5, 6, false, 0, {});
		ground.absorbing[0]->box.lower[0] = ground.absorbing[0]->box.upper[0] = 1;
		const auto report                                                     = ground.step(1e-3);
		EXPECT_EQ(report.failure, Failure::misplaced);
		EXPECT_NE(report.cause.find("lies between the nodes of a larger cell"), std::string::npos) << report.cause;
	}

	/// Points alone in large cells beside small ones: nothing but the lumped mass of loose cells tells velocities
	/// there.
	TYPED_TEST(RefinedMotion, LoosePointsFallExactly)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& scheme : { TimeScheme(), TimeScheme::centralDifferences() }) {
			Moving<Dim> body(1, Hencky(1e6, 0.3), 1000, scheme);
			body.model.grid        = cornerGrid<Dim>();
			body.motion->ghostMass = scheme.isExplicit ? consistent : 1e-3;
			PointCloud<Dim> cloud;
			for (int k = 0; k < 12; ++k) { // a row through all sizes
				Vec<Dim> x = Vec<Dim>::Constant(0.4);
				x[0]       = 0.2 + 0.3 * k;
				addPoint<Dim>(cloud, x, Vec<Dim>::Constant(0.05));
			}
			body.put(cloud, [](const Vec<Dim>&) { return Vec<Dim>(Vec<Dim>::Unit(0)); });
			body.gravity[1] = -10;
			ASSERT_TRUE(body.steps(5, 0.001));
			EXPECT_GT(body.motion->loosePoints, 0);
			for (const auto& v : body.motion->velocity)
				EXPECT_LT((v - Vec<Dim>(Vec<Dim>::Unit(0) - 0.05 * Vec<Dim>::Unit(1))).norm(), 1e-9);
		}
	}

} // namespace
} // namespace gimpm::testRefinedMotion
