// SPDX-License-Identifier: GPL-2.0-or-later
// Nodal forces of a cloud: balance, virial, external forces, and independence of the number of threads.
#include "core/materials/kinematics.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/points/point_update.hpp"
#include "scenes.hpp"
#include <algorithm>
#include <omp.h>

namespace gimpm {
namespace {

	template <int Dim> struct RandomScene {
		Random          random { 2 };
		Model<Dim>      model;
		PointCloud<Dim> cloud;

		explicit RandomScene(int points)
		{
			model.grid      = { 0.7, random.matrix<Dim>() };
			model.materials = { { Hencky(3e3, 0.3), 10 }, { VonMises(1e3, 0.2, 50), 20 } };
			for (int i = 0; i < points; ++i) {
				addPoint<Dim>(cloud, random.matrix<Dim>(3), 0.35 * Vec<Dim>::NullaryExpr([&]() { return random.in(0.1, 1); }), i % 2);
				cloud.elasticStrain.back() = assemble(random.matrix<3>(0.1), random.rotation<Dim>());
			}
		}
		StepSystem<Dim> system(const Load<Dim>& load = {}) const
		{
			StepReport report;
			return StepSystem<Dim>(cloud, model, load, report);
		}
		/// Displacements of an affine deformation (shear and rotation) plus random ones.
		Eigen::VectorXd displacements(const StepSystem<Dim>& system)
		{
			Mat<Dim> F = random.rotation<Dim>();
			F.row(0) += 0.3 * F.row(1);
			const auto affine = nodal<Dim>(system.basis, model.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(F * x - x); });
			return affine + random.vector(affine.size(), 0.03);
		}
	};

	/// sum f_a (x) x_a over the nodes.
	template <int Dim> Mat<Dim> firstMoment(const Eigen::VectorXd& force, const Eigen::VectorXd& x)
	{
		Mat<Dim> sum = Mat<Dim>::Zero();
		for (int i = 0; i < force.size(); i += Dim)
			sum += force.segment<Dim>(i) * x.segment<Dim>(i).transpose();
		return sum;
	}

	template <int Dim> Vec<Dim> total(const Eigen::VectorXd& force)
	{
		return Eigen::Map<const Eigen::Matrix<double, Dim, Eigen::Dynamic>>(force.data(), Dim, force.size() / Dim).rowwise().sum();
	}

	template <class Dimension> using Assembly = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Assembly, BothDimensions, DimensionName);

	TYPED_TEST(Assembly, InternalForcesBalance)
	{
		constexpr int    Dim = TypeParam::value;
		RandomScene<Dim> scene(100);
		const auto       system = scene.system();
		Eigen::VectorXd  force;
		ASSERT_FALSE(system.evaluate(scene.displacements(system), force, nullptr));
		EXPECT_LT(total<Dim>(force).norm(), 1e-12 * force.norm());
	}

	TYPED_TEST(Assembly, FirstMomentOfInternalForcesIsTheSumOfVolumeTimesStress)
	{
		// sum f_a (x) x_a = sum_p V_0 tau_p with the nodes' displaced positions; symmetric, so there is no
		// moment either
		constexpr int    Dim = TypeParam::value;
		RandomScene<Dim> scene(100);
		scene.model.ghost.factor = 0;
		const auto      system   = scene.system();
		const auto      d        = scene.displacements(system);
		Eigen::VectorXd force;
		ASSERT_FALSE(system.evaluate(d, force, nullptr));
		const auto            x = nodal<Dim>(system.basis, scene.model.grid, [](const Vec<Dim>& place) { return place; });
		std::vector<Mat<Dim>> stresses(100);
		forUpdatedPoints<Dim>(system.basis, system.points, scene.model.materials, d, [&](int p, const PointUpdate<Dim>& u) {
			stresses[p] = scene.cloud.volume0[p] * u.kirchhoffStress.inPlane();
		});
		Mat<Dim> sum = Mat<Dim>::Zero();
		for (const auto& s : stresses)
			sum += s;
		EXPECT_LT((firstMoment<Dim>(force, x + d) - sum).norm(), 1e-12 * sum.norm());
	}

	TYPED_TEST(Assembly, ExternalForcesCarryWeightAndPointLoads)
	{
		constexpr int    Dim = TypeParam::value;
		RandomScene<Dim> scene(100);
		Load<Dim>        load;
		load.gravity      = scene.random.template matrix<Dim>();
		load.factor.value = 0.7;
		Vec<Dim> sum      = Vec<Dim>::Zero();
		Mat<Dim> moment   = Mat<Dim>::Zero();
		for (int p = 0; p < 100; ++p) {
			scene.cloud.force.push_back(scene.random.template matrix<Dim>());
			const Vec<Dim> f = 0.7 * (scene.model.materials[p % 2].density * scene.cloud.volume0[p] * load.gravity + scene.cloud.force[p]);
			sum += f;
			moment += f * scene.cloud.position[p].transpose();
		}
		const auto system = scene.system(load);
		const auto x      = nodal<Dim>(system.basis, scene.model.grid, [](const Vec<Dim>& place) { return place; });
		EXPECT_LT((total<Dim>(system.external) - sum).norm(), 1e-13 * sum.norm());
		EXPECT_LT((firstMoment<Dim>(system.external, x) - moment).norm(), 1e-13 * moment.norm());
	}

	TYPED_TEST(Assembly, PointsTakeTheDisplacementsAndGradientsOfLinearFields)
	{
		constexpr int    Dim = TypeParam::value;
		RandomScene<Dim> scene(100);
		const auto       shift = scene.random.template matrix<Dim>();
		const Mat<Dim>   G     = scene.random.template matrix<Dim, Dim>(0.3);
		for (const Basis basis : { Basis::gimp, Basis::linear }) {
			scene.model.basis          = basis;
			const auto          system = scene.system();
			const auto          d      = nodal<Dim>(system.basis, scene.model.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(shift + G * x); });
			std::vector<double> error(100);
			forUpdatedPoints<Dim>(system.basis, system.points, scene.model.materials, d, [&](int p, const PointUpdate<Dim>& u) {
				error[p] = (u.displacement - shift - G * scene.cloud.position[p]).norm() + (u.gradient - G).norm();
			});
			for (const double e : error)
				EXPECT_LT(e, 1e-13);
		}
	}

	TYPED_TEST(Assembly, StiffnessIsSymmetric)
	{
		constexpr int    Dim = TypeParam::value;
		RandomScene<Dim> scene(60);
		const auto       system = scene.system();
		NodeMatrix<Dim>  K;
		Eigen::VectorXd  force;
		system.prepare(K);
		system.evaluate(scene.displacements(system), force, &K);
		// Blocks above the diagonal are stored, so that only those on it can go wrong.
		for (int n = 0; n < K.nodes(); ++n) {
			const Eigen::Map<const Mat<Dim>> block(K.at(n, 0));
			EXPECT_LE((block - block.transpose()).norm(), 1e-14 * block.norm());
		}
	}

	TYPED_TEST(Assembly, PatternHoldsEveryBlockThatIsWritten)
	{
		constexpr int    Dim = TypeParam::value;
		RandomScene<Dim> scene(60);
		const auto       system = scene.system();
		NodeMatrix<Dim>  K;
		Eigen::VectorXd  force;
		system.prepare(K);
		system.evaluate(scene.displacements(system), force, &K);
		for (int n = 0; n < K.nodes(); ++n)
			for (int code = 0; code < NodeMatrix<Dim>::codes; ++code) {
				const bool written = (Eigen::Map<const Mat<Dim>>(K.at(n, code)).array() != 0).any();
				EXPECT_TRUE(!written || K.used(n, code));
				EXPECT_TRUE(!K.used(n, code) || K.neighbour(n, code) >= n);
			}
	}

	TYPED_TEST(Assembly, AnyNumberOfThreadsGivesTheSameBits)
	{
		constexpr int    Dim = TypeParam::value;
		RandomScene<Dim> scene(4500); // enough for threads to pay
		const auto       d      = scene.displacements(scene.system());
		const int        before = omp_get_max_threads();
		Eigen::VectorXd  expected;
		Eigen::MatrixXd  expectedK;
		for (int threads = 1; threads <= 3; ++threads) {
			omp_set_num_threads(threads);
			const auto      system = scene.system();
			NodeMatrix<Dim> K;
			Eigen::VectorXd force, product = Eigen::VectorXd::Zero(d.size());
			system.prepare(K);
			system.evaluate(d, force, &K);
			Eigen::MatrixXd blocks(NodeMatrix<Dim>::block, K.nodes() * NodeMatrix<Dim>::codes);
			for (int i = 0; i < blocks.cols(); ++i)
				blocks.col(i) = Eigen::Map<const Eigen::VectorXd>(K.at(0, 0) + i * blocks.rows(), blocks.rows());
			if (threads == 1) expected = force, expectedK = blocks;
			EXPECT_TRUE(force == expected) << threads;
			EXPECT_TRUE(blocks == expectedK) << threads;
		}
		omp_set_num_threads(before);
	}

	TYPED_TEST(Assembly, TheFirstInvertedPointIsNamed)
	{
		constexpr int    Dim = TypeParam::value;
		RandomScene<Dim> scene(300);
		const auto       system = scene.system();
		Eigen::VectorXd  force;
		// mirrors the half space x > 0: points there turn inside out
		const auto d
		        = nodal<Dim>(system.basis, scene.model.grid, [](const Vec<Dim>& x) { return Vec<Dim>(-2 * std::max(0., x[0]) * Vec<Dim>::Unit(0)); });
		const int inverted = system.evaluate(d, force, nullptr).value().point;
		ASSERT_GE(inverted, 0);
		std::vector<char> isInverted(300);
		forUpdatedPoints<Dim>(system.basis, system.points, scene.model.materials, d, [&](int p, const PointUpdate<Dim>& u) {
			isInverted[p] = (Mat<Dim>::Identity() + u.gradient).determinant() <= 0;
		});
		const int first = int(std::find(isInverted.begin(), isInverted.end(), 1) - isInverted.begin());
		EXPECT_EQ(inverted, first);
	}

	// Points are handled sixteen at a time, four side by side. The last one of seventeen is alone, beside what is
	// left of those before.
	TEST(Assembly, APointIsNotInvertedBesideInvertedOnes)
	{
		RandomScene<2> scene(0);
		scene.model.grid = { 1, Vec<2>::Zero() };
		// Reaches the next cell, and is sorted behind the others for that.
		addPoint<2>(scene.cloud, { 0.9, 0.5 }, { 0.2, 0.2 });
		for (int i = 0; i < 16; ++i)
			addPoint<2>(scene.cloud, { 0.5, 0.5 }, { 0.2, 0.2 });
		const auto      system = scene.system();
		Eigen::VectorXd force;
		const auto      d = nodal<2>(system.basis, scene.model.grid, [](const Vec<2>& x) { return x[0] == 1 ? Vec<2>(-1.5, 0) : Vec<2>(0, 0); });
		EXPECT_EQ(system.evaluate(d, force, nullptr).value().point, 1);
	}

} // namespace
} // namespace gimpm
