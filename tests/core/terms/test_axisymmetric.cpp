// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies of revolution: x is the distance from the axis, y goes along it.
#include "core/materials/kinematics.hpp"
#include "core/stepping/restraint.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/points/point_update.hpp"
#include "derivatives.hpp"
#include "scenes.hpp"

namespace gimpm::testAxisymmetric {
namespace {

	constexpr double full = 6.283185307179586;

	/// Boxes become the sections of rings.
	void revolve(PointCloud<2>& cloud)
	{
		cloud.hoopStretch.assign(cloud.size(), 1);
		for (std::size_t p = 0; p < cloud.size(); ++p)
			cloud.volume0[p] *= full * cloud.position[p][0];
	}

	/// Section of a cylinder from the radius `from` on, in domains of random sizes without gaps.
	PointCloud<2> tiling(double from, const Vec<2>& size, unsigned seed)
	{
		Random     random(seed);
		const auto ends = [&](double at, double last) {
			std::vector<double> all { at };
			while (all.back() < last)
				all.push_back(std::min(all.back() + random.in(0.2, 1), last));
			return all;
		};
		const auto    x = ends(from, from + size[0]), y = ends(0, size[1]);
		PointCloud<2> cloud;
		for (std::size_t j = 1; j < y.size(); ++j)
			for (std::size_t i = 1; i < x.size(); ++i)
				addPoint<2>(cloud, { (x[i] + x[i - 1]) / 2, (y[j] + y[j - 1]) / 2 }, { (x[i] - x[i - 1]) / 2, (y[j] - y[j - 1]) / 2 });
		revolve(cloud);
		return cloud;
	}

	Model<2> modelOf(const std::vector<Material>& materials, std::vector<ConstrainedBox<2>> boxes = {})
	{
		Model<2> model;
		model.grid.axisymmetric = true;
		model.materials         = materials;
		model.newton.tolerance  = 1e-13;
		boxes.push_back(ConstrainedBox<2>::ofAxis(model.grid));
		model.boundary = Boundary<2>(boxes);
		return model;
	}

	// u_r = a r, u_z = b z: every point, wherever its domain lies, has the strains a, b and around the axis a, and
	// moves as the field says.
	TEST(Axisymmetric, LinearFieldsAreExactAtEveryPoint)
	{
		const double a = 0.1, b = -0.2;
		for (const bool fBar : { false, true })
			for (const auto basis : { Basis::gimp, Basis::linear }) {
				Model<2> model            = modelOf({ { Hencky(1e6, 0.3), 1 } });
				model.grid.origin         = { -3, 0.3 };
				model.boundary            = Boundary<2>({ ConstrainedBox<2>::ofAxis(model.grid) });
				model.fBar                = fBar;
				model.basis               = basis;
				auto                cloud = tiling(0, { 4.3, 3.1 }, 3);
				StepReport          report;
				const StepSystem<2> system(cloud, model, {}, report);
				const auto          d = nodal<2>(system.basis, model.grid, [&](const Vec<2>& x) { return Vec<2>(a * x[0], b * x[1]); });
				const Vec3          strain(std::log1p(a), std::log1p(b), std::log1p(a));
				forUpdatedPoints<2>(system.basis, system.points, model.materials, d, [&](int p, const PointUpdate<2>& u) {
					const Vec<2>& x = cloud.position[p];
					EXPECT_NEAR(u.hoop, a, 1e-14);
					EXPECT_LT((u.gradient - Mat<2>(Vec<2>(a, b).asDiagonal())).norm(), 1e-13);
					EXPECT_LT((u.displacement - Vec<2>(a * x[0], b * x[1])).norm(), 1e-13);
					EXPECT_LT((u.elasticStrain.full() - Mat3(strain.asDiagonal())).norm(), 1e-13);
				});
			}
	}

	/// Cylinder between plates, of which the upper one moves; its surface is free and lies anywhere in a cell, or
	/// is held by a wall that moves along.
	void expectUniform(unsigned seed, bool isConfined, bool fBar)
	{
		const double height = 3, radius = isConfined ? 3 : 2.37, stretch = 0.8, wall = isConfined ? 1.1 : 1, young = 1e6, nu = 0.3;
		Model<2>     model;
		model.grid.axisymmetric = true;
		std::vector<ConstrainedBox<2>> boxes { wallBelow<2>(model.grid, 1, 0),
			                               held<2>(model.grid, { -infinity, height }, { infinity, infinity }, "y", { 0, height * (stretch - 1) }) };
		if (isConfined) boxes.push_back(held<2>(model.grid, { radius, -infinity }, { infinity, infinity }, "x", { radius * (wall - 1), 0 }));
		model           = modelOf({ { Hencky(young, nu), 1 } }, boxes);
		model.ghost     = { 0.1 };
		model.fBar      = fBar;
		auto cloud      = tiling(0, { radius, height }, seed);
		cloud.position0 = cloud.position;
		LinearSolver solver;
		const auto   report = loadStep(cloud, model, {}, solver);
		ASSERT_TRUE(report.converged()) << report.cause;
		ASSERT_EQ(report.reactions.size(), boxes.size());
		const double along = std::log(stretch), across = isConfined ? std::log(wall) : -nu * along;
		const Vec3   strain(across, along, across);
		const double lambda = young * nu / ((1 + nu) * (1 - 2 * nu)), J = std::exp(strain.sum());
		const Vec3   stress = (young / (1 + nu) * strain + lambda * strain.sum() * Vec3::Ones()) / J;
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			EXPECT_LT((cloud.stress[p].full() - Mat3(stress.asDiagonal())).norm(), 1e-10 * stress.norm()) << "point " << p << ", seed " << seed;
			EXPECT_NEAR(cloud.hoopStretch[p], std::exp(across), 1e-12);
		}
		// Load of the plates is the stress on the circle.
		const double area = full / 2 * std::pow(radius * std::exp(across), 2);
		EXPECT_NEAR(report.reactions[1][1], stress[1] * area, 1e-9 * std::abs(stress[1] * area));
	}

	TEST(Axisymmetric, PatchTest)
	{
		for (unsigned seed = 1; seed <= 5; ++seed) {
			expectUniform(seed, true, false);
			expectUniform(seed, true, true);
			expectUniform(seed, false, false);
			expectUniform(seed, false, true);
		}
	}

	/// The largest difference between K and the derivative of the forces (fourth-order central), relative to the
	/// largest entry, and the asymmetry of K.
	std::pair<double, double> tangentErrors(const Material& material, bool fBar, const Vec3& strain)
	{
		Random        random(3);
		Model<2>      model = modelOf({ material });
		PointCloud<2> cloud;
		model.fBar  = fBar;
		model.ghost = { 0.1 };
		for (int i = 0; i < 40; ++i) {
			const Vec<2> l(random.in(0.1, 0.5), random.in(0.1, 0.5));
			addPoint<2>(cloud, { l[0] + random.in(0, 2.2), random.in(0, 2.4) }, l);
		}
		revolve(cloud);
		for (auto& e : cloud.elasticStrain)
			e = assemble(Vec3(strain + random.matrix<3>(0.3 * strain.norm())), random.rotation<2>());
		StepReport          report;
		const StepSystem<2> system(cloud, model, {}, report);
		EXPECT_GT(report.ghostFaces, 5);
		EXPECT_EQ(dense(tangentStiffness(system.cloud, system.model)).rows(), report.dofs);
		Eigen::VectorXd d = nodal<2>(system.basis, model.grid, [&](const Vec<2>& x) { return Vec<2>(0.2 * strain.norm() * (x + Vec<2>(0, x[0]))); });
		d += random.vector(d.size(), 0.1 * strain.norm());
		const auto [K, expected] = tangentAndDerivative(system, d, 1e-3 * strain.norm());
		return { relativeError(K, expected), relativeError(K.transpose(), K) };
	}

	TEST(Axisymmetric, TangentIsTheDerivativeOfTheForces)
	{
		const Vec3 large(0.05, -0.1, 0.08), small(-2e-3, -6e-3, -1e-3);
		for (const bool fBar : { false, true }) {
			for (const auto& [error, asymmetry] :
			     { tangentErrors({ Hencky(1e3, 0.3), 1 }, fBar, large), tangentErrors({ VonMises(1e3, 0.3, 50), 1 }, fBar, large) }) {
				EXPECT_LT(error, 2e-8);
				EXPECT_LT(asymmetry, 1e-12);
			}
			const auto [error, asymmetry]
			        = tangentErrors({ DruckerPrager(1e6, 0.3, DruckerPragerCone::compression(1e2, 0.5, 0.1)), 1 }, fBar, small);
			EXPECT_LT(error, 1e-6);
			EXPECT_GT(asymmetry, 1e-2);
		}
	}

	// Resultant of the internal forces along the axis, and of all on the ghost faces: zero.
	TEST(Axisymmetric, ForcesAlongTheAxisAreInBalance)
	{
		for (const bool fBar : { false, true }) {
			Model<2> model            = modelOf({ { Hencky(1e6, 0.3), 1 } });
			model.fBar                = fBar;
			model.ghost               = { 1 };
			auto                cloud = tiling(0.4, { 2.3, 2.6 }, 5);
			StepReport          report;
			const StepSystem<2> system(cloud, model, {}, report);
			Eigen::VectorXd     force;
			ASSERT_FALSE(system.evaluate(Random(2).vector(system.nodalSize(), 0.03), force, nullptr));
			double sum = 0;
			for (int i = 1; i < force.size(); i += 2)
				sum += force[i];
			EXPECT_LT(std::abs(sum), 1e-12 * force.lpNorm<1>());
		}
	}

	// K_g of a face is the integral of 2 pi r N_s N_t over it: checked by a field whose normal derivative jumps by
	// a linear function of r.
	TEST(Axisymmetric, GhostFacesCountWithTheirCircumference)
	{
		Model<2> model;
		model.grid.axisymmetric = true;
		std::vector<GhostFace<2>> faces { { 1, Grid<2>::key({ 2, 0 }) }, { 0, Grid<2>::key({ 2, 0 }) } };
		PointCloud<2>             cloud;
		for (const Vec<2>& x : { Vec<2>(2.5, 0.5), Vec<2>(2.5, 1.5), Vec<2>(3.5, 0.5) })
			addPoint<2>(cloud, x, { 0.5, 0.5 });
		revolve(cloud);
		const auto basis = cloudBasis<2>(cloud, model.grid, Basis::gimp, Boundary<2>(std::vector<ConstrainedBox<2>> {}));
		const auto alike = [](int) { return VolumeAndModulus { 1, 3 }; };
		weighGhostFaces<2>(faces, basis, alike, model.grid, 1, GhostScaling::paper);
		// below the face 0, above c + r (y - 1): the jump of the derivative is r
		const auto      d = nodal<2>(basis, model.grid, [](const Vec<2>& x) { return Vec<2>(x[1] > 1.5 ? x[0] : 0, 0); });
		Eigen::VectorXd f = Eigen::VectorXd::Zero(d.size());
		addGhostForce<2>({ faces[0] }, 1, d, f);
		EXPECT_NEAR(d.dot(f), full * (81. - 16) / 4, 1e-10) << "integral of 2 pi r r^2 from 2 to 3";
		const auto beside = nodal<2>(basis, model.grid, [](const Vec<2>& x) { return Vec<2>(0, x[0] > 3.5 ? 1 : 0); });
		f.setZero();
		addGhostForce<2>({ faces[1] }, 1, beside, f);
		EXPECT_NEAR(beside.dot(f), full * 3, 1e-10);
	}

	TEST(Axisymmetric, OnlyTheAxisIsFree)
	{
		const auto cloud  = tiling(0, { 2, 2 }, 1);
		const auto motion = [&](const std::vector<ConstrainedBox<2>>& boxes) {
			Model<2>   model = modelOf({ { Hencky(1e6, 0.3), 1 } }, boxes);
			const auto basis = cloudBasis<2>(cloud, model.grid, Basis::gimp, model.boundary);
			return restraint<2>(basis, model.grid, model.boundary).freeMotion;
		};
		Grid<2> grid;
		EXPECT_EQ(motion({}).substr(0, 19), "translation along y");
		EXPECT_EQ(motion({ held<2>(grid, { 1, 0 }, { 1, 0 }, "y") }), "");
	}

	TEST(Axisymmetric, ARingThatIsPushedThroughTheAxisIsInverted)
	{
		Model<2>            model = modelOf({ { Hencky(1e6, 0.3), 1 } });
		const auto          cloud = tiling(1, { 2, 2 }, 1);
		StepReport          report;
		const StepSystem<2> system(cloud, model, {}, report);
		Eigen::VectorXd     force;
		const auto          d       = nodal<2>(system.basis, model.grid, [](const Vec<2>&) { return Vec<2>(-2.5, 0); });
		const auto          failure = system.evaluate(d, force, nullptr);
		ASSERT_TRUE(failure);
		EXPECT_EQ(failure->reason, PointFailure::Reason::inverted);
	}

} // namespace
} // namespace gimpm::testAxisymmetric
