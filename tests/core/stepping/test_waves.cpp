// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/step_system.hpp"
#include "core/terms/inertia/absorbing.hpp"
#include "core/terms/inertia/rayleigh.hpp"
#include "derivatives.hpp"
#include "moving.hpp"
#include <complex>

namespace gimpm::testWaves {
namespace {

	template <class T> using Waves = InBothDimensions<T>;
	TYPED_TEST_SUITE(Waves, BothDimensions, DimensionName);

	/// Ground of a depth, along x, free at x = depth, that repeats itself along the other axes.
	template <int Dim> struct Ground : Moving<Dim> {
		static constexpr double young = 1e6, poisson = 0.25, density = 1000;
		// K + 4 G / 3 = 3 G.
		const double shear = young / (2 * (1 + poisson)), cs = std::sqrt(shear / density), cp = std::sqrt(3 * shear / density);
		int          depth;
		double       time = 0;

		std::vector<std::shared_ptr<AbsorbingBoundary<Dim>>> absorbing;
		std::function<double(double)>                        incoming; ///< velocity of the wave from below
		int                                                  along = 1;

		Ground(int cells, TimeScheme scheme = {}, Law law = Hencky(young, poisson)) : Moving<Dim>(1, law, density, scheme), depth(cells)
		{
			this->model.grid.period.setConstant(3);
			this->model.grid.period[0] = 0;
			this->put(block<Dim>(this->model.grid, cellsOf<Dim>(cells, 3, 3), 2), [](const Vec<Dim>&) { return Vec<Dim>(Vec<Dim>::Zero()); });
		}
		ConstrainedBox<Dim> plane(bool isBase) const
		{
			Vec<Dim> min = Vec<Dim>::Constant(-infinity), max = -min;
			if (isBase) max[0] = 0;
			else
				min[0] = depth;
			return ConstrainedBox<Dim>::from(this->model.grid, min, max);
		}
		void absorbAt(const std::vector<ConstrainedBox<Dim>>& boxes)
		{
			this->model.boundary = Boundary<Dim>({}, boxes);
			for (const auto& box : boxes) {
				absorbing.push_back(std::make_shared<AbsorbingBoundary<Dim>>(AbsorbingBoundary<Dim> { box }));
				this->motion->damping.push_back([this, known = absorbing.back()](const StepContext<Dim>& step) {
					return std::make_unique<Absorption<Dim>>(*known, this->model.materials, this->motion->mass, step);
				});
			}
		}
		void damp(double alpha, double beta)
		{
			const auto known = std::make_shared<Rayleigh>(Rayleigh { alpha, beta });
			this->motion->damping.push_back([this, known](const StepContext<Dim>& step) {
				return std::make_unique<RayleighDamping<Dim>>(*known, this->model.materials, this->model.fBar, this->motion->mass, step);
			});
		}
		void                holdBase() { this->model.boundary = Boundary<Dim>({ fixedBase() }); }
		ConstrainedBox<Dim> fixedBase() const
		{
			auto box = plane(true);
			box.fixed.fill(true);
			return box;
		}
		bool advance(double duration)
		{
			const double middle = time + duration / 2;
			const bool   half   = this->motion->scheme.atMiddle;
			for (const auto& boundary : absorbing)
				if (incoming) {
					boundary->incomingBefore[along] = incoming(half ? middle : time);
					boundary->incoming[along]       = incoming(half ? middle : time + duration);
				}
			time += duration;
			return this->steps(1, duration);
		}
		double speedAtTop() const
		{
			double sum   = 0;
			int    count = 0;
			for (std::size_t p = 0; p < this->cloud.size(); ++p)
				if (this->cloud.position[p][0] > depth - 0.5) sum += this->motion->velocity[p][along], ++count;
			return sum / count;
		}
	};

	/// Half of it goes to each end.
	template <int Dim> double leftOfPulse(int cells, double width, int along, const TimeScheme& scheme, double cfl)
	{
		Ground<Dim> ground(cells, scheme);
		ground.absorbAt({ ground.plane(true), ground.plane(false) });
		ground.put(ground.cloud, [&](const Vec<Dim>& x) {
			return Vec<Dim>(1e-4 * std::exp(-std::pow((x[0] - cells / 2.) / width, 2)) * Vec<Dim>::Unit(along));
		});
		const double before = ground.energy(), c = along == 0 ? ground.cp : ground.cs;
		EXPECT_TRUE(ground.steps(int(std::lround((cells / 2. + 4 * width) / cfl)), cfl / c));
		return ground.energy() / before;
	}

	TYPED_TEST(Waves, PulsesLeaveThroughAbsorbingEnds)
	{
		constexpr int Dim = TypeParam::value;
		for (const int along : { 0, 1 }) {
			const double left = Dim == 2 ? leftOfPulse<Dim>(24, 4, along, {}, 0.5) : leftOfPulse<Dim>(10, 2.5, along, {}, 1);
			EXPECT_LT(left, 1e-2) << "along " << along;
			::testing::Test::RecordProperty("energy left along " + std::to_string(along), std::to_string(left));
			std::printf("energy left: %.2e\n", left);
		}
	}

	TEST(Waves, PulsesLeaveUnderEachScheme)
	{
		for (const auto& scheme : { TimeScheme::generalisedAlpha(0.8), TimeScheme::midpoint() })
			for (const int along : { 0, 1 })
				EXPECT_LT(leftOfPulse<2>(24, 4, along, scheme, 0.5), 1e-2);
	}

	/// Held until then, ground stays at rest where what held it is taken away. Points that have moved on the grid
	/// are not in balance to the last digit before further steps without load.
	TYPED_TEST(Waves, StaticReactionsGoOnActing)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& scheme : { TimeScheme(), TimeScheme::generalisedAlpha(0.8), TimeScheme::midpoint() }) {
			Ground<Dim> ground(6, scheme);
			ground.gravity                = -0.01 * Vec<Dim>::Unit(0);
			ground.gravity[1]             = 0.001;
			ground.model.newton.tolerance = 1e-13;
			ground.holdBase();
			auto still  = ground.model;
			still.terms = {}, still.inertia = nullptr, still.atMiddle = false;
			LinearSolver solver;
			for (const double growth : { 1, 0, 0, 0, 0 })
				ASSERT_TRUE(loadStep(ground.cloud, still, { ground.gravity, { 1, growth } }, solver).converged());
			const auto held = ground.cloud.position;
			ground.absorbAt({ ground.plane(true) });
			ASSERT_TRUE(ground.steps(10, 0.1 / ground.cp));
			const auto&  boundary = *ground.absorbing[0];
			const double error    = (boundary.force + ground.mass() * ground.gravity).norm() / (ground.mass() * ground.gravity).norm();
			std::printf("reaction: error %.1e\n", error);
			EXPECT_LT(error, 1e-9);
			for (std::size_t p = 0; p < held.size(); ++p)
				EXPECT_LT((ground.cloud.position[p] - held[p]).norm(), 1e-9);
		}
	}

	/// The free surface moves with twice the velocity of the wave that comes from below, and the wave goes back
	/// through the base.
	TEST(Waves, FreeSurfaceOverACompliantBaseDoublesTheWave)
	{
		for (const auto& scheme : { TimeScheme(), TimeScheme::midpoint() })
			for (const int along : { 0, 1 }) {
				Ground<2>    ground(20, scheme);
				const double c = along == 0 ? ground.cp : ground.cs, width = 8 / c, start = 3 * width;
				ground.along    = along;
				ground.incoming = [&](double t) { return 1e-4 * std::exp(-std::pow((t - start) / width, 2)); };
				ground.absorbAt({ ground.plane(true) });
				double error = 0, work = 0, most = 0;
				while (ground.time < start + 40 / c + 4 * width) {
					ASSERT_TRUE(ground.advance(0.5 / c));
					const double x = ground.depth - 0.25;
					const double expected
					        = ground.incoming(ground.time - x / c) + ground.incoming(ground.time - (2 * ground.depth - x) / c);
					error = std::max(error, std::abs(ground.speedAtTop() - expected) / 2e-4);
					work += ground.absorbing[0]->work;
					most = std::max(most, ground.energy());
				}
				std::printf("surface: error %.2e of the peak, energy left %.1e\n", error, ground.energy() / most);
				EXPECT_LT(error, 1e-2);
				EXPECT_NEAR(work, ground.energy(), 1e-3 * most) << "the work of the boundary is all that there is";
				EXPECT_LT(ground.energy(), 1e-3 * most);
			}
	}

	/// Shakes ground on a rigid base that moves along y with the velocity history(time).
	template <class F> bool shake(Ground<2>& ground, F&& history, double duration)
	{
		const int    parts = 20; // displacement by Simpson's rule
		const double t = ground.time, each = duration / parts;
		double       moved = 0;
		for (int i = 0; i < parts; ++i)
			moved += each / 6 * (history(t + i * each) + 4 * history(t + (i + 0.5) * each) + history(t + (i + 1) * each));
		ground.motion->bases    = { { ground.fixedBase(), Vec<2>(0, history(t)), Vec<2>(0, (history(t + duration) - history(t)) / duration) } };
		ground.motion->duration = duration;
		ground.time += duration;
		Load<2> load { ground.gravity, { 1, 0 } };
		load.boxMotion[0] = Vec<2>(0, moved);
		load.motion       = duration;
		return loadStep(ground.cloud, ground.model, load, ground.solver).converged();
	}

	/// After a jerk of the base ground swings with c_s / (4 H).
	TEST(Waves, GroundOnARigidBaseSwingsWithItsFirstFrequency)
	{
		Ground<2>    ground(10);
		const double period = 40 / ground.cs, T = period / 80, jerk = period / 2;
		ground.holdBase();
		std::vector<double> rises;
		double              last = 0;
		ground.damp(0, 2 * 0.005 * period / (2 * M_PI)); // half a percent of critical; higher modes die away
		const auto history = [&](double t) { return t < jerk ? 1e-4 * (1 - std::cos(2 * M_PI * t / jerk)) : 0; };
		for (int i = 0; i < 80 * 12; ++i) {
			ASSERT_TRUE(shake(ground, history, T));
			const double v = ground.speedAtTop();
			if (last < 0 && v >= 0 && ground.time > 4 * period) rises.push_back(ground.time - T * v / (v - last));
			last = v;
		}
		ASSERT_GT(rises.size(), 5u);
		const double measured = (rises.back() - rises.front()) / double(rises.size() - 1);
		std::printf("period: %.5f of 4 H / c_s\n", measured / period);
		EXPECT_NEAR(measured / period, 1, 3e-3);
	}

	/// Kelvin and Voigt's: G (1 + i omega beta); amplification 1 / |cos k H|.
	TEST(Waves, AmplificationWithStiffnessProportionalDamping)
	{
		for (const double ratio : { 0.6, 1., 1.7 }) { // ratio of the frequency and c_s / (4 H)
			Ground<2>    ground(10);
			const double first = 2 * M_PI * ground.cs / 40, omega = ratio * first, beta = 2 * 0.1 / first, T = 2 * M_PI / omega / 60;
			ground.holdBase();
			ground.damp(0, beta);
			const std::complex<double> i(0, 1), k = omega / ground.cs / std::sqrt(1. + i * omega * beta);
			// At a quarter of a cell under the surface.
			const double         closed  = std::abs(std::cos(0.25 * k) / std::cos(10. * k));
			const auto           history = [&](double t) { return 1e-5 * std::sin(omega * t) * std::min(t * first / (4 * M_PI), 1.); };
			std::complex<double> sum     = 0;
			const int            swing   = int(60 * std::ceil(14 * std::max(ratio, 1.)));
			for (int n = 0; n < swing; ++n) {
				ASSERT_TRUE(shake(ground, history, T));
				if (n >= swing - 60) sum += ground.speedAtTop() * std::exp(-i * omega * ground.time);
			}
			const double measured = std::abs(sum) / 30 / 1e-5;
			std::printf("amplification at %.1f f_1: %.4f, closed form %.4f\n", ratio, measured, closed);
			EXPECT_NEAR(measured / closed, 1, 0.01);
		}
	}

	TYPED_TEST(Waves, MassProportionalDampingSlowsAFreeBodyDown)
	{
		constexpr int Dim = TypeParam::value;
		Ground<Dim>   ground(3);
		ground.damp(0.7, 1e-3);
		ground.put(ground.cloud, [](const Vec<Dim>&) { return Vec<Dim>(Vec<Dim>::Unit(0)); });
		ASSERT_TRUE(ground.steps(50, 0.01));
		EXPECT_NEAR(ground.motion->velocity[0][0] / std::exp(-0.35), 1, 1e-5);
	}

	TYPED_TEST(Waves, StiffnessIsTheDerivativeOfTheForce)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& scheme : { TimeScheme::newmark(0.3025, 0.6), TimeScheme::generalisedAlpha(0.4), TimeScheme::midpoint() })
			for (const bool isAssociated : { true, false }) {
				const MohrCoulomb law(1e6, 0.25, 1e3, 0.5, isAssociated ? 0.5 : 0.);
				Ground<Dim>       ground(3, scheme, law);
				Random            random;
				ground.absorbAt({ ground.plane(true) });
				ground.damp(0.3, 0.01);
				ground.motion->duration = 0.01;
				ground.put(ground.cloud, [&](const Vec<Dim>&) { return random.matrix<Dim>(); });
				StepReport            report;
				const StepSystem<Dim> system(ground.cloud, ground.model, { ground.gravity, { 1, 0 } }, report);
				EXPECT_EQ(system.isSymmetric(), isAssociated);
				const Eigen::VectorXd d = random.vector(system.nodalSize(), 1e-4), e = random.vector(system.nodalSize(), 1);
				EXPECT_LT(tangentErrorAlong(system, d, e, 1e-8), 1e-6);
			}
	}

	/// On both sides of its nodes, or on none.
	TEST(Waves, BoundariesAwayFromTheEdgeAreRefused)
	{
		for (const auto& [place, cause] : { std::pair(2., "on both sides"), { -3., "no face" } }) {
			Ground<2>    ground(4);
			const double inf = infinity;
			ground.absorbAt({ ConstrainedBox<2>::from(ground.model.grid, { place, -inf }, { place, inf }) });
			const auto report = ground.step(0.01);
			EXPECT_EQ(report.failure, Failure::misplaced);
			EXPECT_NE(report.cause.find(cause), std::string::npos) << report.cause;
			EXPECT_FALSE(ground.absorbing[0]->hasBegun);
		}
	}

	/// Within yield they are those of elasticity, wherever the state is; Cam clay's grow with the pressure.
	TEST(Waves, ModuliOfWavesAreElastic)
	{
		const double young = 1e6, poisson = 0.2, shear = young / 2.4, pressure = young / 1.8 + 4 * shear / 3;
		for (const Law& law : { Law(Hencky(young, poisson)), Law(VonMises(young, poisson, 1e3)), Law(MohrCoulomb(young, poisson, 0, 0.5, 0.1)),
		                        Law(DruckerPrager(young, poisson, DruckerPragerCone::planeStrain(1e3, 0.5, 0.1))) })
			for (const double strain : { -1e-2, 0., 1e-2 }) {
				auto cloud = block<2>(Grid<2>(), { 1, 1 }, 1);
				cloud.elasticStrain[0].c << strain, -0.3 * strain, 2 * strain, strain;
				const std::vector<Material> materials { { law, 2000 } };
				provideInternals(cloud.internals, materials, 1);
				const auto moduli = waveModuli(materials, cloud, 0);
				EXPECT_NEAR(moduli.pressure / pressure, 1, 1e-12);
				EXPECT_NEAR(moduli.shear / shear, 1, 1e-12);
			}
	}

} // namespace
} // namespace gimpm::testWaves
