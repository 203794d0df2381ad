// SPDX-License-Identifier: GPL-2.0-or-later
// The tangent of a step in which everything acts at once that resists displacements, against the derivative of its
// forces.
#include "core/terms/contact/contact.hpp"
#include "core/terms/traction.hpp"
#include "core/terms/water/water.hpp"
#include "derivatives.hpp"
#include "refined.hpp"

namespace gimpm::testAllTerms {
namespace {

	/// A block of 1.5 m in all directions: a pressure on top, water in the pores and outside, an oblique wall, a
	/// plate that presses from below.
	template <int Dim> struct Scene {
		Model<Dim>         model;
		PointCloud<Dim>    cloud;
		SurfaceLoad<Dim>   load;
		Water<Dim>         pores, outside;
		ContactSystem<Dim> contacts;
		StepReport         report;

		explicit Scene(const Grid<Dim>& grid = { 0.5 })
		{
			const bool isRing = grid.axisymmetric;
			model.grid        = grid;
			model.materials   = { { Hencky(1e6, 0.2), 2000 }, { MohrCoulomb(1e6, 0.2, 2e3, 0.5, 0.1), 2000 } };
			model.ghost       = { 0.1 };
			cloud = grid.refinement ? refinedBlock<Dim>(grid, Index<Dim>::Constant(2), 2) : block<Dim>(grid, Index<Dim>::Constant(3), 2);
			Random random(5);
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				cloud.material[p] = int(p % 2);
				cloud.elasticStrain[p].c += 1e-3 * random.vector(int(cloud.elasticStrain[p].c.size()));
			}
			if (isRing) cloud.hoopStretch.assign(cloud.size(), 1);
			for (std::size_t p = 0; isRing && p < cloud.size(); ++p)
				cloud.volume0[p] *= 2 * M_PI * cloud.position[p][0];
			addConditions();
		}
		void addConditions()
		{
			load.surface = top();
			load.surface.refine(pieceLimit * model.grid.cellSize);
			load.pressure = 3e4, load.traction = -1e4 * Vec<Dim>::Unit(0);
			pores.domain = WaterDomain::pores, outside.domain = WaterDomain::outside;
			pores.pressure = pores.before = std::make_shared<StillWater<Dim>>(1, 1, 1.1, 2e4);
			outside.pressure = outside.before = std::make_shared<StillWater<Dim>>(1, 1, 0.9, 1e4);
			model.terms                       = { [this](const StepContext<Dim>& step) { return std::make_unique<Traction<Dim>>(load, step); },
				        [this](const StepContext<Dim>& step) { return std::make_unique<WaterForce<Dim>>(pores, step); },
				        [this](const StepContext<Dim>& step) { return std::make_unique<WaterForce<Dim>>(outside, step); },
				        [this](const StepContext<Dim>& step) { return std::make_unique<Contact<Dim>>(contacts, step); } };
			RigidBody<Dim> plate;
			plate.shape.kind          = RigidKind::plane;
			plate.shape.normal        = Vec<Dim>::Unit(1);
			plate.frictionCoefficient = 0.3, plate.stiffness = 100;
			plate.end.position[1] = 0.02;
			contacts.bodies.push_back(plate);
			contacts.owners.push_back(plate.end.position);
		}
		Surface<Dim> top() const
		{
			if constexpr (Dim == 2) return { { { 1.3, 1.4 }, { 0.2, 1.4 } }, { { 1.3, 1.4 }, { 0.2, 1.4 } }, { { 0, 1 } } };
			else {
				const std::vector<Vec3> corners { { 0.2, 1.4, 0.1 }, { 0.2, 1.4, 1.3 }, { 1.3, 1.4, 1.3 } };
				return { corners, corners, { { 0, 1, 2 } } };
			}
		}
		void addWall()
		{
			ConstrainedBox<Dim> nothing;
			nothing.lower.setOnes();
			nothing.upper.setZero();
			Surface<Dim> side;
			if constexpr (Dim == 2) side = { { { 1.2, 1.3 }, { 1.3, 0.1 } }, { { 1.2, 1.3 }, { 1.3, 0.1 } }, { { 0, 1 } } };
			else {
				const std::vector<Vec3> corners { { 1.2, 1.3, 0.2 }, { 1.3, 0.1, 0.2 }, { 1.25, 0.7, 1.2 } };
				side = { corners, corners, { { 0, 1, 2 } } };
			}
			model.walls[int(model.boundary.boxes().size())] = std::make_shared<Wall<Dim>>(side, model.grid.cellSize);
			auto boxes                                      = model.boundary.boxes();
			boxes.push_back(nothing);
			model.boundary = Boundary<Dim>(boxes);
		}
		/// Error of the tangent at random displacements. All terms act: without each of them it differs.
		double error(std::size_t terms)
		{
			const StepSystem<Dim> system(cloud, model, {}, report);
			EXPECT_EQ(system.terms.size(), terms);
			EXPECT_FALSE(system.isSymmetric());
			const Eigen::VectorXd d = Random(7).vector(system.nodalSize(), 1e-3);
			for (const auto& term : system.terms) {
				Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
				EXPECT_FALSE(term->add(d, { force }));
				EXPECT_GT(force.norm(), 1);
			}
			return relativeError(
			        tangent(system, d), derivative([&](const Eigen::VectorXd& x) { return forces(system, x); }, free(system, d), 1e-8));
		}

	private:
		/// Free degrees of freedom, which nodes tied to others follow.
		static Eigen::VectorXd free(const StepSystem<Dim>& system, const Eigen::VectorXd& nodal)
		{
			Eigen::VectorXd x(system.dofs.count);
			for (int i = 0; i < nodal.size(); ++i)
				if (system.dofs.number[i] >= 0) x[system.dofs.number[i]] = nodal[i];
			return x;
		}
		static Eigen::VectorXd ofNodes(const StepSystem<Dim>& system, const Eigen::VectorXd& x)
		{
			Eigen::VectorXd d = Eigen::VectorXd::Zero(system.nodalSize());
			for (int i = 0; i < d.size(); ++i)
				if (system.dofs.number[i] >= 0) d[i] = x[system.dofs.number[i]];
			system.basis.affineConstraints.template distribute<Dim>(d);
			return d;
		}
		static Eigen::VectorXd forces(const StepSystem<Dim>& system, const Eigen::VectorXd& x)
		{
			Eigen::VectorXd force;
			EXPECT_FALSE(system.evaluate(ofNodes(system, x), force, nullptr));
			return free(system, force);
		}
		static Eigen::MatrixXd tangent(const StepSystem<Dim>& system, const Eigen::VectorXd& d)
		{
			NodeMatrix<Dim> K;
			Eigen::VectorXd force;
			system.prepare(K);
			EXPECT_FALSE(system.evaluate(ofNodes(system, free(system, d)), force, &K));
			return dense(reduced(K, system.dofs));
		}
	};

	template <class T> using TangentOfAll = InBothDimensions<T>;
	TYPED_TEST_SUITE(TangentOfAll, BothDimensions, DimensionName);

	constexpr double roundOff = 1e-6; // relative to forces of 1e4 N by steps of 1e-8 m

	TYPED_TEST(TangentOfAll, IsTheDerivative)
	{
		for (const bool fBar : { false, true }) {
			Scene<TypeParam::value> scene;
			scene.model.fBar = fBar;
			scene.addWall();
			EXPECT_LT(scene.error(7), roundOff) << fBar;
		}
	}

	TYPED_TEST(TangentOfAll, WithAPeriod)
	{
		Grid<TypeParam::value> grid { 0.5 };
		grid.period[0] = 3;
		Scene<TypeParam::value> scene(grid);
		scene.addWall();
		EXPECT_LT(scene.error(7), roundOff);
	}

	/// Cells of half the size where the load acts, whose pieces stay among cells of one size; walls and water are
	/// not there yet.
	TYPED_TEST(TangentOfAll, WithCellsOfSeveralSizes)
	{
		constexpr int   Dim = TypeParam::value;
		RefinedBox<Dim> box;
		box.min = 0.1 * Vec<Dim>::Ones(), box.max = 1.5 * Vec<Dim>::Ones();
		box.halvings = 1;
		Scene<Dim> scene(refinedGrid<Dim>({ box }));
		scene.model.terms.erase(scene.model.terms.begin() + 1, scene.model.terms.begin() + 3);
		EXPECT_LT(scene.error(4), roundOff);
	}

	TEST(TangentOfAll, AroundAnAxis)
	{
		for (const bool fBar : { false, true }) {
			Grid<2> grid { 0.5 };
			grid.axisymmetric = true;
			Scene<2> scene(grid);
			scene.model.boundary = Boundary<2>({ ConstrainedBox<2>::ofAxis(scene.model.grid) });
			scene.model.fBar     = fBar;
			scene.addWall();
			EXPECT_LT(scene.error(7), roundOff) << fBar;
		}
	}

} // namespace
} // namespace gimpm::testAllTerms
