// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies that move with the soil: of free ones the derivative, balance and momentum; of those with nodes who gets what.
#include "core/terms/contact/contact.hpp"
#include "core/terms/contact/contact_nodes.hpp"
#include "core/terms/contact/contact_surface.hpp"
#include "derivatives.hpp"
#include "touched_soil.hpp"
#include <Eigen/Geometry>
#include <set>

namespace gimpm::testContactFree {
namespace {

	/// A block of soil on a fixed base, with a body on top of it that moves freely.
	template <int Dim> struct Loaded : TouchedSoil<Dim> {
		explicit Loaded(RigidKind kind, double friction, bool isRing = false) : TouchedSoil<Dim>(0, 1e-11, 1.5, isRing)
		{
			Vec<Dim> place = Vec<Dim>::Constant(isRing ? 0 : 0.7);
			place[1]       = 2.5;
			auto& body     = this->add(kind, place, friction);
			body.free      = 0;
			FreeBody<Dim> free { 0, place };
			free.externalLoad[1] = -2e4;
			if (!isRing) free.externalLoad[0] = 1e3;
			for (int i = 0; i < FreeBody<Dim>::unknowns; ++i)
				free.isGiven[i] = isRing && i != 1;
			this->contacts.free = { free };
			this->model.coupledTerms
			        = { [this](const StepContext<Dim>&, const State&) { return std::make_unique<ContactCoupling<Dim>>(this->contacts); } };
			Vec<Dim> top = Vec<Dim>::Constant(infinity);
			top[1]       = 0;
			std::vector<ConstrainedBox<Dim>> base { held<Dim>(
				this->model.grid, Vec<Dim>::Constant(-infinity), top, std::string("xyz").substr(0, Dim)) };
			if (isRing) base.push_back(wallBelow<Dim>(this->model.grid, 0, 0));
			this->model.boundary = Boundary<Dim>(base);
		}
		/// Error of the whole tangent along a direction, from differences. A body without inertia rests on all
		/// of the soil's surface.
		double tangentError()
		{
			const StepSystem<Dim> system(this->cloud, this->model, Load<Dim>(), this->report);
			NodeMatrix<Dim>       K;
			Couplings             beside;
			system.prepare(K, &beside);
			Random                random(5);
			const Eigen::VectorXd d   = random.vector(system.nodalSize(), this->contacts.free[0].inertia.isZero(0) ? 2e-6 : 0.002),
			                      way = random.vector(system.nodalSize(), 1);
			Eigen::VectorXd force, above, below, tangent = Eigen::VectorXd::Zero(d.size());
			EXPECT_FALSE(system.evaluate(d, force, &K, nullptr, &beside));
			K.multiplyAdd(way, tangent);
			beside.multiplyAdd(way, tangent);
			EXPECT_TRUE(this->contacts.free[0].isAtRest) << this->contacts.free[0].imbalance;
			const double step = 1e-7;
			EXPECT_FALSE(system.evaluate(d + step * way, above, nullptr) || system.evaluate(d - step * way, below, nullptr));
			return ((above - below) / (2 * step) - tangent).norm() / tangent.norm();
		}
	};

	template <class T> using FreeOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(FreeOf, BothDimensions, DimensionName);

	template <int Dim> void testTangents(bool isRing)
	{
		for (const double inertia : { 0., 1e6 })
			for (const double friction : { 0.2, 100. })
				for (const RigidKind kind : { RigidKind::block, RigidKind::ball }) {
					Loaded<Dim> block(kind, friction, isRing);
					block.contacts.free[0].inertia.setIdentity();
					block.contacts.free[0].inertia *= inertia;
					if (kind == RigidKind::ball && inertia == 0) block.contacts.free[0].externalLoad[0] = 0; // it would roll
					EXPECT_LT(block.tangentError(), 1e-6) << int(kind) << " " << friction << " " << inertia;
				}
	}
	TYPED_TEST(FreeOf, TangentIsTheDerivative) { testTangents<TypeParam::value>(false); }
	TEST(FreeBody, TangentIsTheDerivativeAroundAnAxis) { testTangents<2>(true); }

	/// The base has what the body weighs, and is pushed as that is.
	TYPED_TEST(FreeOf, WeightGoesThroughTheSoil)
	{
		constexpr int Dim = TypeParam::value;
		Loaded<Dim>   block(RigidKind::block, 0.5);
		ASSERT_TRUE(block.step().converged()) << block.report.cause;
		EXPECT_LE(block.report.iterations, 8);
		Vec<Dim> reaction = Vec<Dim>::Zero();
		for (const auto& box : block.report.reactions)
			reaction += box.template head<Dim>();
		EXPECT_LT((reaction + block.contacts.free[0].externalLoad.template head<Dim>()).norm(), 1e-9 * 2e4);
		EXPECT_LT((block.contacts.loads[0].force.template head<Dim>() + block.contacts.free[0].externalLoad.template head<Dim>()).norm(), 1e-9 * 2e4);
	}

	/// In the air it moves by its inertia alone; without it has no equilibrium.
	TYPED_TEST(FreeOf, WhatNothingHolds)
	{
		constexpr int Dim = TypeParam::value;
		for (const double inertia : { 0., 4e4 }) {
			Loaded<Dim> block(RigidKind::block, 0);
			for (auto* place :
			     { &block.contacts.bodies[0].begin.position, &block.contacts.bodies[0].end.position, &block.contacts.free[0].position })
				(*place)[1] += 5;
			block.contacts.free[0].inertia.setIdentity();
			block.contacts.free[0].inertia *= inertia;
			block.model.newton.tolerance = 1e-9;
			block.step();
			EXPECT_EQ(block.report.converged(), inertia > 0) << block.report.cause;
			if (inertia == 0) continue;
			EXPECT_NEAR(block.contacts.bodies[0].end.position[1], 7.5 - 0.5, 1e-12);
		}
	}

	/// Forces and moments of the nodes are those of the force, wherever it is.
	TEST(Nodes, HaveForceAndMoment)
	{
		Random random(3);
		for (const int nodes : { 2, 3 })
			for (int i = 0; i < 20; ++i) {
				RigidBody<3> body;
				body.nodes        = nodes;
				body.shape.kind   = nodes == 3 ? RigidKind::sheet : RigidKind::capsule;
				body.shape.radius = 0.1;
				for (int n = 0; n < 3; ++n)
					body.shape.corners[n] = random.vector(3, 1), body.end.shift[n] = random.vector(3, 0.05);
				body.begin        = { random.vector(3, 1), rotation({ 1, 2, 3 }, 0.3) };
				body.end.position = random.vector(3, 1), body.end.rotation = rotation({ 1, 2, 3 }, 0.4);
				const ForceOnNodes at { random.vector(3, 5), body.end.position + random.vector(3, 1), Mat3::Identity(), 2, 3 };
				const auto         loads = loadsOnNodes(body, body.begin.position + Vec3(random.vector(3, 1)), at);
				Vec3               force = Vec3::Zero(), moment = Vec3::Zero();
				for (int n = 0; n < nodes; ++n) {
					const Vec3 x = body.end.inSpace(body.shape.corners[n] + body.end.shift[n]);
					force += loads[n].force, moment += x.cross(loads[n].force) + loads[n].torque;
				}
				EXPECT_LT((force - at.force).norm(), 1e-12);
				EXPECT_LT((moment - at.position.cross(at.force)).norm(), 1e-11);
			}
	}

	/// Load on a body with nodes moves as these do: a rigid motion of them is that of the body.
	TEST(Nodes, CarryAsARigidBodyDoes)
	{
		for (const int nodes : { 2, 3 }) {
			RigidBody<3> body;
			body.nodes         = nodes;
			body.shape.kind    = nodes == 3 ? RigidKind::sheet : RigidKind::capsule;
			body.shape.radius  = 0.1;
			body.shape.corners = { Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0) };
			RigidBody<3> rigid;
			body.end.position = rigid.end.position = Vec3(0.3, 0.2, 0.1);
			body.end.rotation = rigid.end.rotation = rotation({ 1, 2, 3 }, 0.4);
			const Vec3 x(0.2, 0.1, 0.15);
			EXPECT_LT((body.carried(x) - rigid.carried(x)).norm(), 1e-14);
			body.end.shift[1] = Vec3(0.2, 0, 0); // stretched from one end
			const Vec3 more   = body.end.rotation.transpose() * (body.carried(x) - rigid.carried(x));
			EXPECT_NEAR(more[0], nodes == 2 ? 0.2 * 0.6 : 0.2 * 0.55, 1e-14);
		}
	}

	/// A capsule on a block is pressed as a ball and a block of its sizes would be: its area is that of both.
	TEST(Nodes, SurfaceOfACapsule)
	{
		RigidShape<3> shape;
		shape.kind                  = RigidKind::capsule;
		shape.radius                = 0.3;
		shape.corners               = { Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3::Zero() };
		double                 area = 0;
		Vec3                   sum  = Vec3::Zero();
		std::set<std::int64_t> numbers;
		for (const auto& point : surfacePoints<3>(shape, 0.05, Vec3::Constant(-9), Vec3::Constant(9))) {
			area += point.area, sum += point.area * point.normal, numbers.insert(point.number);
			EXPECT_NEAR((point.position - Vec3(std::clamp(point.position[0], -1., 1.), 0, 0)).norm(), 0.3, 1e-12);
		}
		EXPECT_NEAR(area, 2 * M_PI * 0.3 * 2 + 4 * M_PI * 0.09, 1e-9);
		EXPECT_LT(sum.norm(), 1e-9);
		EXPECT_EQ(numbers.size(), surfacePoints<3>(shape, 0.05, Vec3::Constant(-9), Vec3::Constant(9)).size());
	}

} // namespace
} // namespace gimpm::testContactFree
