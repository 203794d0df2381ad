// SPDX-License-Identifier: GPL-2.0-or-later
// F-bar: the kernel against its formulas written down point by point, and what it must leave as it is.
#include "core/materials/kinematics.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/points/point_update.hpp"
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

	/// Gradient of the basis function of a node given by its position along each axis.
	template <int Dim> Vec<Dim> gradient(const PointBasis<Dim>& axes, const Index<Dim>& n)
	{
		Vec<Dim> G = Vec<Dim>::Ones();
		for (int a = 0; a < Dim; ++a)
			for (int k = 0; k < Dim; ++k)
				G[k] *= a == k ? axes[a].gradient[n[a]] : axes[a].value[n[a]];
		return G;
	}

	/// Calls f(node number, gradient at the point, gradient at the centres) for the nodes of a point.
	template <int Dim, class F> void forNodes(const StepSystem<Dim>& system, const Patch<Dim>& patch, int i, F&& f)
	{
		Index<Dim> count;
		for (int a = 0; a < Dim; ++a)
			count[a] = patch.nodesAlong(a);
		int local = 0;
		forIndices<Dim>(Index<Dim>::Zero(), count, [&](const Index<Dim>& n) {
			if (patch.node[local] >= 0) f(patch.node[local], gradient<Dim>(system.basis.axes[i], n), gradient<Dim>(system.points.centres[i], n));
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
				const auto nodes = [&](auto&& f) { forNodes(system, patch, i, f); };
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

	template <class Dimension> using FBar = InBothDimensions<Dimension>;
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

	// The blocks above the diagonal stand for those below: the tangent's test against finite differences sees
	// whether they may.
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

	// The upper side of a cell turns round: J = 0.7 at the lower point, negative at the upper one and at the centre
	// of both.
	TEST(FBar, APointIsInvertedWhereItsCellIs)
	{
		Scene<2> scene;
		scene.cloud      = {};
		scene.model.grid = { 1, Vec<2>::Zero() };
		addPoint<2>(scene.cloud, { 0.5, 0.1 }, { 0.1, 0.1 });
		addPoint<2>(scene.cloud, { 0.5, 0.75 }, { 0.25, 0.25 });
		for (const bool fBar : { false, true }) {
			scene.model.fBar       = fBar;
			const auto      system = scene.system();
			const auto      d      = nodal<2>(system.basis, scene.model.grid, [](const Vec<2>& x) { return Vec<2>(-3 * x[0] * x[1], 0); });
			Eigen::VectorXd force;
			const auto      failure = system.evaluate(d, force, nullptr).value();
			EXPECT_EQ(failure.reason, PointFailure::Reason::inverted);
			EXPECT_EQ(failure.point, fBar ? 0 : 1);
		}
	}

	TYPED_TEST(FBar, CentresAreThoseOfTheMatterInACell)
	{
		constexpr int Dim = TypeParam::value;
		Model<Dim>    model;
		model.materials = { { Hencky(1, 0), 1 } };
		model.fBar      = true;
		// In a cell the lower 0.7 along x, of which the first half is twice as dense with points; a full cell
		// above along y.
		PointCloud<Dim> cloud;
		for (const double x : { 0.175, 0.175, 0.525 })
			addPoint<Dim>(cloud, Vec<Dim>::Constant(0.5) + (x - 0.5) * Vec<Dim>::Unit(0), Vec<Dim>::Constant(0.5) - 0.325 * Vec<Dim>::Unit(0));
		addPoint<Dim>(cloud, Vec<Dim>::Constant(0.5) + Vec<Dim>::Unit(1), Vec<Dim>::Constant(0.5));
		StepReport            report;
		const StepSystem<Dim> system(cloud, model, {}, report);
		for (int i = 0; i < 4; ++i) {
			const auto& values = system.points.centres[i];
			EXPECT_NEAR(values[0].value[1], system.basis.order[i] < 3 ? (2 * 0.175 + 0.525) / 3 : 0.5, 1e-14);
			EXPECT_NEAR(values[1].value[1], 0.5, 1e-14);
			EXPECT_NEAR(values[0].value[0] + values[0].value[1], 1, 1e-14);
		}
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
