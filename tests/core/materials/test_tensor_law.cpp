// SPDX-License-Identifier: GPL-2.0-or-later
// Laws with tensors, by one of these tests: kinematic hardening. One point, and bodies of such points beside others.
#include "core/terms/points/point_update.hpp"
#include "derivatives.hpp"
#include "law/kinematic_hardening.hpp"
#include "scenes.hpp"

namespace gimpm::testTensorLaw {
namespace {

	constexpr double E = 2.6e3, nu = .3, G = 1e3, yield = 20, H = 300;
	const double     root2 = std::sqrt(2.);

	KinematicHardening hardening(double viscosity = 0) { return { E, nu, yield, H, viscosity }; }

	/// One point on a path of deformation gradients.
	struct Path {
		Law             law;
		InternalColumns internals {};
		SymTensor<3>    elasticStrain {};
		Mat3            stress = Mat3::Zero();

		explicit Path(const Law& of) : law(of) { provideInternals(internals, { { law, 1 } }, 1); }

		TensorPoint at(const Mat3& gradient, bool wantsRates = false, double duration = 0) const
		{
			return respondInSpace(law, { {}, internals, 0 }, { leftCauchyGreenMinusOne(elasticStrain), gradient, duration, wantsRates });
		}
		void apply(const Mat3& gradient, double duration = 0)
		{
			const TensorPoint now = at(gradient, false, duration);
			elasticStrain = SymTensor<3>::from(now.elasticStrain), stress = now.stress;
			storeInternals(law, now.state.numbers(), internals, 0);
		}
		Mat3 backStress() const
		{
			SymTensor<3> t;
			for (int k = 0; k < 6; ++k)
				t.c[k] = internals[law->columns[1 + k]][0];
			return t.full();
		}
	};

	Mat3 shearing(double g)
	{
		Mat3 gradient  = Mat3::Zero();
		gradient(0, 1) = g;
		return gradient;
	}

	/// Shear stress and back stress of a path of small shear strains, exactly: loops of two straight lines.
	struct Loop {
		double stress = 0, back = 0;
		void   apply(double g)
		{
			const double trial = stress + G * g, limit = yield / root2, excess = std::abs(trial - back) - limit;
			// Plastic flow of the tensor's component.
			const double flow = excess > 0 ? std::copysign(excess / (2 * G + H), trial - back) : 0;
			stress            = trial - 2 * G * flow;
			back += H * flow;
		}
	};

	TEST(TensorLaw, HasItsVariablesAmongTheOthers)
	{
		const Law law = hardening();
		ASSERT_EQ(law->columns.size(), 7u);
		EXPECT_EQ(law->columns[0], internalVariables.find("plasticStrain")); // shared with other laws
		for (const char* end : { "XX", "YY", "ZZ", "XY", "YZ", "ZX" })
			EXPECT_GE(internalVariables.find(std::string("backStress") + end), 0);
		EXPECT_STREQ(internalVariables[law->columns[4]].name, "backStressXY");
		EXPECT_STREQ(internalVariables[law->columns[4]].unit, "Pa");
		EXPECT_TRUE(internalVariables[law->columns[4]].admits(-1e9));
		EXPECT_EQ(law->columns, Law(hardening())->columns);
	}

	// Stress and strain in units of the modulus: with 1e-6 of strain at yield, products of strains are below the
	// tolerance.
	TEST(TensorLaw, CyclicShearFollowsTheLoopOfBilinearKinematicHardening)
	{
		constexpr double scale = 1e-6;
		Path             path(KinematicHardening(E, nu, scale * yield, H));
		Loop             loop;
		const double     amplitude = 4 * yield / root2 / G;
		int              flowing   = 0;
		for (int step = 0; step < 500; ++step) {
			const double g = (step / 50 % 4 == 1 || step / 50 % 4 == 2 ? -1 : 1) * amplitude / 50;
			path.apply(shearing(scale * g));
			const double before = loop.back;
			loop.apply(g);
			flowing += loop.back != before;
			ASSERT_NEAR(path.stress(0, 1), scale * loop.stress, 2e-5 * scale * yield) << step;
			ASSERT_NEAR(path.backStress()(0, 1), scale * loop.back, 2e-5 * scale * yield) << step;
		}
		EXPECT_GT(flowing, 250);
		EXPECT_LT(flowing, 450);
	}

	// Large strains in any axes: stresses turn with the observer, and a rotation by itself turns
	// stress and back stress.
	TEST(TensorLaw, IsObjective)
	{
		Random random(5);
		Path   ours(hardening()), theirs(hardening());
		Mat3   Q = Mat3::Identity();
		for (int step = 0; step < 20; ++step) {
			const Mat3 F = Mat3::Identity() + random.matrix<3, 3>(.05), turn = random.rotation<3>();
			ours.apply(F - Mat3::Identity());
			// The observer has turned by Q before, and turns to `turn`.
			theirs.apply(turn * F * Q.transpose() - Mat3::Identity());
			Q = turn;
			EXPECT_LT((theirs.stress - Q * ours.stress * Q.transpose()).norm(), 1e-11 * E);
			EXPECT_LT((theirs.backStress() - Q * ours.backStress() * Q.transpose()).norm(), 1e-11 * E);
		}
		EXPECT_GT(ours.backStress().norm(), yield / 4);
		const Mat3 stress = ours.stress, back = ours.backStress(), R = random.rotation<3>();
		ours.apply(R - Mat3::Identity());
		EXPECT_LT((ours.stress - R * stress * R.transpose()).norm(), 1e-11 * E);
		EXPECT_LT((ours.backStress() - R * back * R.transpose()).norm(), 1e-11 * E);
		ours.apply(Mat3::Zero());
		// a step without motion changes nothing.
		EXPECT_LT((ours.stress - R * stress * R.transpose()).norm(), 1e-11 * E);
	}

	TEST(TensorLaw, RatesAreDerivativesOfTheStress)
	{
		Random     random(7);
		const Mat3 I = Mat3::Identity();
		for (int trial = 0; trial < 20; ++trial) {
			Path path(hardening());
			for (int step = 0; step < 3; ++step)
				path.apply(random.matrix<3, 3>(.05));
			const Mat3        F     = I + random.matrix<3, 3>(.1);
			const TensorPoint point = path.at(F - I, true);
			constexpr double  s     = 1e-4;
			for (int k = 0; k < 9; ++k) {
				Mat3 l          = Mat3::Zero();
				l(k / 3, k % 3) = 1;
				const auto at   = [&](double by) { return path.at((I + by * s * l) * F - I).stress; };
				const Mat3 rate = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * s);
				for (int i = 0; i < 9; ++i)
					EXPECT_NEAR(point.rates(i, k), rate(i / 3, i % 3), 1e-7 * E) << trial;
			}
		}
	}

	// Without time nothing flows, and in a long time all of it.
	TEST(TensorLaw, KnowsTheStepOfTime)
	{
		const auto after = [](double viscosity, double duration) {
			Path path(hardening(viscosity));
			path.apply(shearing(.1), duration);
			return path.stress(0, 1);
		};
		EXPECT_DOUBLE_EQ(after(1e4, 0), after(1e30, 1));
		EXPECT_NEAR(after(1e4, 1e12), after(0, 0), 1e-6 * yield);
		EXPECT_GT(after(1e4, 0), after(1e4, 1) + .5 * yield);
		EXPECT_GT(after(1e4, 1), after(1e4, 100) + .1 * yield);
	}

	/// Random points against a wall, of which every second has a tensor law.
	template <int Dim> struct Scene {
		Random          random { 11 };
		Model<Dim>      model;
		PointCloud<Dim> cloud;

		explicit Scene(bool fBar, bool isRing = false)
		{
			model.materials = { { VonMises(1e3, .2, 50), 1 }, { hardening(), 1 } };
			model.ghost     = { .1 };
			model.fBar      = fBar;
			model.boundary  = Boundary<Dim>({ wallBelow<Dim>(model.grid, 0, 0) });
			for (int i = 0; i < (Dim == 2 ? 40 : 25); ++i) {
				const Vec<Dim> half = Vec<Dim>::NullaryExpr([&]() { return random.in(.1, .5); });
				const Vec<Dim> x    = 1.2 * (random.matrix<Dim>() + Vec<Dim>::Ones());
				addPoint<Dim>(cloud, isRing ? Vec<Dim>(x.cwiseMax(half)) : x, half, i % 2);
			}
			if (isRing) {
				model.grid.axisymmetric = true;
				cloud.hoopStretch.assign(cloud.size(), 1);
				for (std::size_t p = 0; p < cloud.size(); ++p)
					cloud.volume0[p] *= 2 * M_PI * cloud.position[p][0];
			}
			provideInternals(cloud.internals, model.materials, cloud.size());
			for (auto& e : cloud.elasticStrain)
				e = assemble(Vec3(Vec3(.05, -.03, .01) + random.matrix<3>(.05)), random.rotation<Dim>());
			const auto column = [&](const char* end) -> auto& { return cloud.internals[internalVariables.find(std::string("backStress") + end)]; };
			for (const char* end : { "XX", "YY", "XY" })
				for (double& value : column(end))
					value = random.in(-30, 30);
			for (std::size_t p = 0; p < cloud.size(); ++p)
				column("ZZ")[p] = -column("XX")[p] - column("YY")[p]; // a deviator
		}
		double error(double size)
		{
			StepReport            report;
			const StepSystem<Dim> system(cloud, model, {}, report);
			EXPECT_FALSE(system.isSymmetric());
			Eigen::VectorXd d
			        = nodal<Dim>(system.basis, model.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(size * x.sum() * Vec<Dim>::Unit(0)); });
			d += random.vector(d.size(), size / 2);
			const auto [K, expected] = tangentAndDerivative(system, d, 1e-4);
			return relativeError(K, expected);
		}
	};
	template <class Dimension> using TensorLawBody = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(TensorLawBody, BothDimensions, DimensionName);

	TYPED_TEST(TensorLawBody, TangentIsTheDerivativeOfTheForces)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool fBar : { false, true })
			EXPECT_LT(Scene<Dim>(fBar).error(.1), 1e-7) << fBar;
	}
	TEST(TensorLawRing, TangentIsTheDerivativeOfTheForces)
	{
		for (const bool fBar : { false, true })
			EXPECT_LT(Scene<2>(fBar, true).error(.05), 1e-7) << fBar;
	}

	/// Law that is principal, too.
	class VonMisesBySixNumbers : public KinematicHardening {
	public:
		VonMisesBySixNumbers(double young, double poisson, double yieldStress) : KinematicHardening(young, poisson, yieldStress, 0) { }
		VonMisesBySixNumbers with(const Parameters&) const { return *this; }
		bool                 isSymmetric() const { return true; }
	};

	// Isotropic, so that both ways through the kernels have to come to the same.
	template <int Dim> void expectSameAsPrincipal(bool fBar, bool isRing)
	{
		Scene<Dim> scene(fBar, isRing), same = scene;
		scene.model.materials = { { VonMises(1e3, .2, 50), 1 }, { VonMises(1e3, .2, 50), 1 } };
		same.model.materials  = { { VonMises(1e3, .2, 50), 1 }, { VonMisesBySixNumbers(1e3, .2, 50), 1 } };
		for (auto* one : { &scene, &same })
			for (auto& column : one->cloud.internals)
				std::fill(column.begin(), column.end(), 0);
		StepReport            report;
		const StepSystem<Dim> a(scene.cloud, scene.model, {}, report), b(same.cloud, same.model, {}, report);
		const Eigen::VectorXd d = Random(2).vector(a.nodalSize(), .05);
		Eigen::VectorXd       f, g;
		NodeMatrix<Dim>       K, L;
		a.prepare(K), b.prepare(L);
		ASSERT_FALSE(a.evaluate(d, f, &K) || b.evaluate(d, g, &L));
		EXPECT_LT((f - g).norm(), 1e-12 * f.norm());
		EXPECT_LT(relativeError(dense(L), dense(K)), 1e-11);
		std::vector<double> flow(scene.cloud.size());
		forUpdatedPoints<Dim>(a.basis, a.points, scene.model.materials, d, [&](int p, const PointUpdate<Dim>& u) { flow[p] = u.internals[0]; });
		forUpdatedPoints<Dim>(b.basis, b.points, same.model.materials, d, [&](int p, const PointUpdate<Dim>& u) { flow[p] -= u.internals[0]; });
		for (const double difference : flow)
			EXPECT_NEAR(difference, 0, 1e-13);
	}
	TYPED_TEST(TensorLawBody, IsTheSameAsAPrincipalLaw)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool fBar : { false, true })
			expectSameAsPrincipal<Dim>(fBar, false);
	}
	TEST(TensorLawRing, IsTheSameAsAPrincipalLaw)
	{
		for (const bool fBar : { false, true })
			expectSameAsPrincipal<2>(fBar, true);
	}

	// A body that is sheared to and fro as a whole, by its nodes.
	TYPED_TEST(TensorLawBody, CyclicShearOfABody)
	{
		constexpr int    Dim   = TypeParam::value;
		constexpr double scale = 1e-6;
		Model<Dim>       model;
		PointCloud<Dim>  cloud = block<Dim>(model.grid, cellsOf<Dim>(2, 2, 2), 2);
		model.materials        = { { KinematicHardening(E, nu, scale * yield, H), 1 } };
		const double      inf = infinity, amplitude = 3 * yield / root2 / G;
		LinearSolver      solver;
		Loop              loop;
		const std::size_t column = Law(hardening())->columns[4];
		for (int step = 0; step < 16; ++step) {
			const double                     g = (step / 4 % 4 == 1 || step / 4 % 4 == 2 ? -1 : 1) * amplitude / 4;
			std::vector<ConstrainedBox<Dim>> boxes;
			for (int row = 0; row <= 2; ++row) { // each row of nodes goes by what its height asks for
				Vec<Dim> low = Vec<Dim>::Constant(-inf), high = Vec<Dim>::Constant(inf);
				low[1] = row == 0 ? -inf : row - .1, high[1] = row == 2 ? inf : row + .1;
				boxes.push_back(held<Dim>(model.grid, low, high, Dim == 2 ? "xy" : "xyz", scale * g * row * Vec<Dim>::Unit(0)));
			}
			model.boundary          = Boundary<Dim>(boxes);
			const StepReport report = loadStep<Dim>(cloud, model, Load<Dim> { Vec<Dim>::Zero(), { 1, 1 } }, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
			loop.apply(g);
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				ASSERT_NEAR(cloud.stress[p].c[Dim == 2 ? 2 : 3], scale * loop.stress, 2e-5 * scale * yield) << step;
				ASSERT_NEAR(cloud.internals[column][p], scale * loop.back, 2e-5 * scale * yield) << step;
			}
		}
		EXPECT_GT(std::abs(loop.back), yield / 20);
	}

} // namespace
} // namespace gimpm::testTensorLaw
