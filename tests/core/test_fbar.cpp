// SPDX-License-Identifier: GPL-2.0-or-later
// F-bar: the kernel against its formulas written down point by point, and what it must leave as it is.
#include "core/stepping/step_system.hpp"
#include "core/terms/point_update.hpp"
#include "scenes.hpp"
#include <numeric>

namespace gimpm::testFBar {
namespace {

	/// Random overlapping domains of an elastic and a plastic material, strained.
	template <int Dim> struct Scene {
		Random          random { 2 };
		Model<Dim>      model;
		PointCloud<Dim> cloud;

		Scene()
		{
			model.grid      = { 0.7, random.matrix<Dim>() };
			model.materials = { { Hencky(3e3, 0.3), 10 }, { VonMises(1e3, 0.2, 50), 20 } };
			model.fBar      = true;
			for (int i = 0; i < 60; ++i) {
				addPoint<Dim>(cloud, random.matrix<Dim>(2), 0.35 * Vec<Dim>::NullaryExpr([&]() { return random.in(0.1, 1); }), i % 2);
				cloud.elasticStrain.back() = assemble(random.matrix<3>(0.1), random.rotation<Dim>());
			}
		}
		StepSystem<Dim> system() const
		{
			StepReport report;
			return StepSystem<Dim>(cloud, model, {}, report);
		}
		/// Shear, stretch and rotation, and random displacements besides.
		Eigen::VectorXd displacements(const StepSystem<Dim>& system, double scatter)
		{
			Mat<Dim> F = random.rotation<Dim>();
			F.row(0) += 0.3 * F.row(1);
			const auto affine = nodal<Dim>(system.basis, model.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(F * x - x); });
			return affine + random.vector(affine.size(), scatter);
		}
	};

	template <int Dim> Eigen::VectorXd forcesOf(const StepSystem<Dim>& system, const Eigen::VectorXd& d)
	{
		Eigen::VectorXd force;
		EXPECT_FALSE(system.evaluate(d, force, nullptr));
		return force;
	}

	/// Gradients at the point and in the middle of the cells, of the basis function of a node given by its position along each axis.
	template <int Dim> std::pair<Vec<Dim>, Vec<Dim>> gradients(const PointBasis<Dim>& axes, const Index<Dim>& n, double h)
	{
		Vec<Dim> G = Vec<Dim>::Ones(), G0 = G;
		for (int a = 0; a < Dim; ++a) {
			const AxisBasis& basis    = axes[a];
			const double     share[3] = { basis.share(0, h), 1, 1 - basis.share(0, h) };
			for (int k = 0; k < Dim; ++k) {
				G[k] *= a == k ? basis.slope[n[a]] : basis.value[n[a]];
				G0[k] *= a == k ? basis.slope[n[a]] : share[n[a]] / 2;
			}
		}
		return { G, G0 };
	}

	/// Calls f(node number, G, G0) for the nodes of a patch.
	template <int Dim, class F> void forNodes(const Patch<Dim>& patch, const PointBasis<Dim>& axes, double h, F&& f)
	{
		Index<Dim> count;
		for (int a = 0; a < Dim; ++a)
			count[a] = patch.nodesAlong(a);
		int local = 0;
		forIndices<Dim>(Index<Dim>::Zero(), count, [&](const Index<Dim>& n) {
			const auto [G, G0] = gradients<Dim>(axes, n, h);
			if (patch.node[local] >= 0) f(patch.node[local], G, G0);
			++local;
		});
	}

	/// The formulas, point by point. Kirchhoff stresses in the order of the cloud.
	template <int Dim> Eigen::VectorXd pointByPoint(const StepSystem<Dim>& system, const Eigen::VectorXd& d, std::vector<Mat<Dim>>& stresses)
	{
		Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
		for (const auto& patch : system.basis.patches)
			for (int i = patch.first; i < patch.first + patch.count; ++i) {
				Mat<Dim>   F = Mat<Dim>::Identity(), F0 = F;
				const auto nodes = [&](auto&& f) { forNodes(patch, system.basis.axes[i], system.model.grid.cellSize, f); };
				nodes([&](int n, const Vec<Dim>& G, const Vec<Dim>& G0) {
					F += d.template segment<Dim>(Dim * n) * G.transpose(), F0 += d.template segment<Dim>(Dim * n) * G0.transpose();
				});
				const Mat<Dim> Fbar  = F * std::pow(F0.determinant() / F.determinant(), 1. / Dim);
				const auto     trial = principal(pushForward(system.points.leftCauchyGreen[i], Mat<Dim>(Fbar - Mat<Dim>::Identity())));
				const auto     t     = withLaw(system.model.materials[system.points.material[i]].law, [&](const auto& law) -> Mat<Dim> {
                                        return assemble<double, Dim>(law.template respond<double>(logStrain(trial.value), {}).stress, trial.axes).inPlane();
                                });
				const Mat<Dim> mean  = t.trace() / Dim * Mat<Dim>::Identity();
				nodes([&](int n, const Vec<Dim>& G, const Vec<Dim>& G0) {
					force.template segment<Dim>(Dim * n) += system.points.volume0[i]
					        * ((t - mean) * (F.inverse().transpose() * G) + mean * (F0.inverse().transpose() * G0));
				});
				stresses[system.basis.order[i]] = t;
			}
		return force;
	}

	template <class Dimension> class FBar : public ::testing::Test {
	};
	TYPED_TEST_SUITE(FBar, BothDimensions, DimensionName);

	TYPED_TEST(FBar, PointsSideBySideDoAsPointByPoint)
	{
		constexpr int Dim = TypeParam::value;
		for (const double scatter : { 0.04, 1e-7 }) {
			Scene<Dim> scene;
			scene.model.ghost.factor     = 0; // the points' forces only
			scene.model.boundary         = Boundary<Dim>({ wallBelow<Dim>(scene.model.grid, 0, scene.model.grid.origin[0]) });
			const auto            system = scene.system();
			const auto            d      = scene.random.vector(system.nodalSize(), scatter);
			std::vector<Mat<Dim>> expected(60), stresses(60);
			const auto            force = pointByPoint(system, d, expected);
			EXPECT_LT((forcesOf(system, d) - force).norm(), 1e-13 * force.norm());
			forUpdatedPoints<Dim>(system.basis, system.points, scene.model.materials, d, [&](int p, const PointUpdate<Dim>& u) {
				stresses[p] = u.kirchhoffStress.inPlane();
			});
			for (int p = 0; p < 60; ++p)
				EXPECT_LT((stresses[p] - expected[p]).norm(), 1e-12 * (1 + expected[p].norm()));
		}
	}

	TYPED_TEST(FBar, ForcesBalanceAndAreTheSumOfVolumeTimesStress)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene;
		scene.model.ghost.factor     = 0;
		const auto            system = scene.system();
		const auto            d      = scene.displacements(system, 0.03);
		const Eigen::VectorXd force  = forcesOf(system, d);
		const auto            x      = nodal<Dim>(system.basis, scene.model.grid, [](const Vec<Dim>& place) { return place; });
		Vec<Dim>              total  = Vec<Dim>::Zero();
		Mat<Dim>              moment = Mat<Dim>::Zero();
		std::vector<Mat<Dim>> stresses(60);
		for (int i = 0; i < force.size(); i += Dim) {
			total += force.segment<Dim>(i);
			moment += force.segment<Dim>(i) * (x + d).template segment<Dim>(i).transpose();
		}
		pointByPoint(system, d, stresses);
		for (std::size_t p = 0; p < stresses.size(); ++p)
			moment -= scene.cloud.volume0[p] * stresses[p];
		EXPECT_LT(total.norm(), 1e-12 * force.norm());
		EXPECT_LT(moment.norm(), 1e-12 * force.norm());
	}

	// Away from walls, all dilations are the same then.
	TYPED_TEST(FBar, ChangesNoStressInAffineDeformations)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene;
		const auto    with                     = scene.system();
		scene.model.fBar                       = false;
		const auto                   without   = scene.system();
		const StepSystem<Dim>* const systems[] = { &with, &without };
		const auto                   d         = scene.displacements(with, 0);
		std::vector<Mat<Dim>>        stresses[2] { std::vector<Mat<Dim>>(60), std::vector<Mat<Dim>>(60) };
		for (int k = 0; k < 2; ++k)
			forUpdatedPoints<Dim>(systems[k]->basis, systems[k]->points, scene.model.materials, d, [&](int p, const PointUpdate<Dim>& u) {
				stresses[k][p] = u.kirchhoffStress.inPlane();
			});
		for (int p = 0; p < 60; ++p)
			EXPECT_LT((stresses[0][p] - stresses[1][p]).norm(), 1e-11 * stresses[1][p].norm());
	}

	TYPED_TEST(FBar, RigidRotationTurnsTheStress)
	{
		constexpr int  Dim = TypeParam::value;
		Scene<Dim>     scene;
		const auto     system = scene.system();
		const Mat<Dim> R      = scene.random.template rotation<Dim>();
		const auto     turned = [&](const Mat<Dim>& turn) {
                        std::vector<Mat<Dim>> stresses(60);
                        const auto            d = nodal<Dim>(system.basis, scene.model.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(turn * x - x); });
                        forUpdatedPoints<Dim>(system.basis, system.points, scene.model.materials, d, [&](int p, const PointUpdate<Dim>& u) {
                                stresses[p] = u.kirchhoffStress.inPlane();
                        });
                        return stresses;
		};
		const auto before = turned(Mat<Dim>::Identity()), after = turned(R);
		for (int p = 0; p < 60; ++p)
			EXPECT_LT((after[p] - R * before[p] * R.transpose()).norm(), 1e-11 * before[p].norm());
	}

	// The blocks above the diagonal stand for those below: the tangent's test against finite differences sees whether they may.
	TYPED_TEST(FBar, DiagonalBlocksOfTheStiffnessAreSymmetric)
	{
		constexpr int   Dim = TypeParam::value;
		Scene<Dim>      scene;
		const auto      system = scene.system();
		NodeMatrix<Dim> K;
		Eigen::VectorXd force;
		system.prepare(K);
		system.evaluate(scene.displacements(system, 0.03), force, &K);
		for (int n = 0; n < K.nodes(); ++n) {
			const Eigen::Map<const Mat<Dim>> block(K.at(n, 0));
			EXPECT_LE((block - block.transpose()).norm(), 1e-13 * block.norm());
		}
	}

	// J = 0.7 at the point, near the bottom of a cell of which the upper side turns round: J_0 = -0.5.
	TEST(FBar, APointIsInvertedWhereTheMiddleOfItsCellIs)
	{
		Scene<2> scene;
		scene.cloud      = {};
		scene.model.grid = { 1, Vec<2>::Zero() };
		addPoint<2>(scene.cloud, { 0.5, 0.1 }, { 0.1, 0.1 });
		const auto d = [&](const StepSystem<2>& system) {
			return nodal<2>(system.basis, scene.model.grid, [](const Vec<2>& x) { return Vec<2>(-3 * x[0] * x[1], 0); });
		};
		Eigen::VectorXd force;
		const auto      with = scene.system();
		EXPECT_EQ(with.evaluate(d(with), force, nullptr).value().reason, PointFailure::Reason::inverted);
		scene.model.fBar   = false;
		const auto without = scene.system();
		EXPECT_FALSE(without.evaluate(d(without), force, nullptr));
	}

	TYPED_TEST(FBar, LeavesAColumnAsItIs)
	{
		constexpr int Dim = TypeParam::value;
		Column<Dim>   plain(8), withFBar(8);
		withFBar.model.fBar = true;
		for (int step = 1; step <= 10; ++step) {
			ASSERT_TRUE(plain.step(step, 10).converged());
			ASSERT_TRUE(withFBar.step(step, 10).converged());
		}
		for (std::size_t p = 0; p < plain.cloud.size(); ++p) {
			EXPECT_LT((plain.cloud.position[p] - withFBar.cloud.position[p]).norm(), 1e-6);
			EXPECT_LT((plain.cloud.stress[p].full() - withFBar.cloud.stress[p].full()).norm(), 1e-6 * plain.young);
		}
	}

} // namespace
} // namespace gimpm::testFBar
