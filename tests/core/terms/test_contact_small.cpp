// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies that are small beside the cells, on soil that goes on beside them: wider shape functions, with derivative,
// balance and memory of these, and none where soil ends.
#include "core/terms/contact/contact.hpp"
#include "derivatives.hpp"
#include "touched_soil.hpp"
#include <Eigen/Geometry>

namespace gimpm::testContactSmall {
namespace {

	constexpr RigidKind kinds[] = { RigidKind::ball, RigidKind::block };

	/// Soil of eight by two (by eight) cells, but for the first ones along x that are cut off, and on its top a
	/// ball of radius 0.8 h or a block 2 h wide, the first places of which are in the lower halves of cells.
	template <int Dim> struct Small : TouchedSoil<Dim> {
		const int first; ///< index of the first of these cells

		Small(RigidKind kind, double friction, int cutOff = 0) : TouchedSoil<Dim>(0, 1e-11), first(kind == RigidKind::ball ? 4 : 3)
		{
			this->cloud    = block<Dim>(this->model.grid, cellsOf<Dim>(8, 2, 8), 2, Index<Dim>(cutOff * Index<Dim>::Unit(0)));
			Vec<Dim> place = Vec<Dim>::Constant(kind == RigidKind::ball ? 4.56 : 4.3), base = Vec<Dim>::Constant(infinity);
			place[1] = kind == RigidKind::ball ? 2.8 : 3, base[1] = 0;
			auto& body           = this->add(kind, this->h * place, friction);
			body.shape.radius    = this->h * (kind == RigidKind::ball ? 0.8 : 0.05);
			body.shape.halfSize  = Vec<Dim>::Constant(this->h);
			this->model.boundary = Boundary<Dim>({ held<Dim>(this->model.grid, -Vec<Dim>::Constant(infinity), base, Dim == 3 ? "xyz" : "xy") });
		}
		/// It is moved into the soil and turned.
		Small& press()
		{
			auto& end = this->contacts.bodies[0].end;
			end.position[0] += 0.004, end.position[1] -= 0.03;
			end.rotation = turn<Dim>(0.02);
			return *this;
		}
		/// Its push presses it in; a ball would roll.
		Small& letGo(double inertia)
		{
			auto& body = this->contacts.bodies[0];
			body.free  = 0;
			FreeBody<Dim> free { 0, body.begin.position };
			free.externalLoad.template head<2>() << (body.shape.kind == RigidKind::ball ? 0 : 1e3), -2e4;
			free.inertia        = inertia * FreeBody<Dim>::Matrix::Identity();
			this->contacts.free = { free };
			this->model.coupledTerms
			        = { [this](const StepContext<Dim>&, const State&) { return std::make_unique<ContactCoupling<Dim>>(this->contacts); } };
			return *this;
		}
		StepSystem<Dim> system() { return { this->cloud, this->model, Load<Dim>(), this->report }; }

		/// On the nodes, with which they resist, in the step that is being made.
		Eigen::VectorXd forces(const Eigen::VectorXd& d) const
		{
			Eigen::VectorXd f = Eigen::VectorXd::Zero(d.size());
			EXPECT_FALSE(this->contacts.acting->add(d, { f }));
			return f;
		}
		/// Lowest node along an axis that gets a force where no soil moves; 99: none gets one.
		int lowestNode(int axis)
		{
			const auto            step   = system();
			const Eigen::VectorXd f      = forces(Eigen::VectorXd::Zero(step.nodalSize()));
			int                   lowest = 99;
			for (std::size_t n = 0; n < step.basis.nodes.size(); ++n)
				if (f.template segment<Dim>(Dim * n).norm() > 1e-6 * f.norm())
					lowest = std::min(lowest, Grid<Dim>::index(step.basis.nodes[n])[axis]);
			return lowest;
		}
		void expectWide()
		{
			EXPECT_EQ(lowestNode(0), first - 1) << "along x";
			EXPECT_EQ(lowestNode(Dim == 3 ? 2 : 0), first - 1) << "along z";
		}
	};

	template <class T> using SmallOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(SmallOf, BothDimensions, DimensionName);

	TYPED_TEST(SmallOf, TangentIsTheDerivative)
	{
		for (const RigidKind kind : kinds)
			for (const double friction : { 0., 0.05, 100. }) {
				Small<TestFixture::dim> scene(kind, friction);
				scene.press().expectWide();
				EXPECT_LT(tangentErrorOfLastTerm(scene.system(), scene.model.grid, 1e-7), 1e-6) << int(kind) << " " << friction;
			}
	}

	/// Tangent of all of the step, along a direction in which all nodes move: a free body joins them.
	TYPED_TEST(SmallOf, TangentOfFreeOnesIsTheDerivative)
	{
		for (const RigidKind kind : kinds)
			for (const double inertia : { 0., 1e6 }) {
				Small<TestFixture::dim> scene(kind, 0.2);
				scene.letGo(inertia).expectWide();
				const auto                   system = scene.system();
				NodeMatrix<TestFixture::dim> K;
				Couplings                    beside;
				system.prepare(K, &beside);
				const Eigen::VectorXd d = Random(5).vector(system.nodalSize(), inertia > 0 ? 2e-3 : 2e-6), way = Random(6).vector(d.size());
				Eigen::VectorXd       force, above, below, tangent = Eigen::VectorXd::Zero(d.size());
				EXPECT_FALSE(system.evaluate(d, force, &K, nullptr, &beside));
				K.multiplyAdd(way, tangent);
				beside.multiplyAdd(way, tangent);
				EXPECT_FALSE(system.evaluate(d + 1e-7 * way, above, nullptr) || system.evaluate(d - 1e-7 * way, below, nullptr));
				EXPECT_LT(((above - below) / 2e-7 - tangent).norm(), 1e-6 * tangent.norm()) << int(kind) << " " << inertia;
			}
	}

	/// Force and moment on the nodes, where these are in the end, are those that the owner is told of.
	TYPED_TEST(SmallOf, OwnersAreToldWhatTheSoilGets)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool isFree : { false, true })
			for (const RigidKind kind : kinds) {
				Small<Dim> scene(kind, 0.3);
				(isFree ? scene.letGo(0) : scene.press()).expectWide();
				const auto            system = scene.system();
				const Eigen::VectorXd d = Random(7).vector(system.nodalSize(), isFree ? 2e-6 : 0.005), f = scene.forces(d);
				system.commit(d);
				const auto         nodes = nodePositions(system.basis, scene.model.grid);
				const ContactLoad& load  = scene.contacts.loads[0];
				Vec3               force = Vec3::Zero(), moment = Vec3::Zero();
				for (std::size_t n = 0; n < nodes.size(); ++n) {
					Vec3 arm = Vec3::Zero(), part = Vec3::Zero();
					arm.head<Dim>()  = nodes[n] + d.template segment<Dim>(Dim * n) - scene.contacts.owners[0];
					part.head<Dim>() = f.template segment<Dim>(Dim * n);
					force += part, moment += arm.cross(part);
				}
				EXPECT_GT(load.force[1], 1e3);
				EXPECT_LT((load.force - force).norm(), 1e-12 * force.norm());
				EXPECT_LT((load.torque - moment).norm(), 1e-12 * scene.h * force.norm());
				for (const auto& free : scene.contacts.free)
					EXPECT_LT(
					        (load.force.head<Dim>() + free.externalLoad.template head<Dim>()).norm() + load.torque.norm(),
					        1e-9 * force.norm());
			}
	}

	/// Nodal forces at the beginning of a step are those at the end of the step before, where nothing moves any
	/// more.
	TYPED_TEST(SmallOf, ForcesOfBeforeAreThoseThatWere)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool isFree : { false, true })
			for (const RigidKind kind : kinds) {
				Small<Dim> scene(kind, 0.3);
				scene.contacts.kind = StepKind::dynamic; // a time step, which asks for the forces of before
				(isFree ? scene.letGo(0) : scene.press()).expectWide();
				Eigen::VectorXd f, before;
				for (int step = 0; step < 5; ++step) {
					const auto            system = scene.system();
					const Eigen::VectorXd none   = Eigen::VectorXd::Zero(system.nodalSize());
					scene.contacts.acting->addBefore(before = none);
					if (step == 4) break; // free bodies are in balance to 1e-8 by then
					f = scene.forces(none);
					system.commit(none);
					scene.contacts.bodies[0].begin = scene.contacts.bodies[0].end;
					for (auto& free : scene.contacts.free)
						free.position += free.motion.template head<Dim>(), free.motion.setZero();
				}
				scene.expectWide();
				EXPECT_GT(f.norm(), 1e3);
				EXPECT_LT((before - f).norm(), (isFree ? 1e-7 : 1e-12) * f.norm()) << int(kind) << " " << isFree;
			}
	}

	/// Along the axis along which there are not two cells of soil beside it; far from soil there is no force.
	TYPED_TEST(SmallOf, WhereSoilEndsItPressesByCells)
	{
		constexpr int Dim = TypeParam::value;
		for (const RigidKind kind : kinds) {
			const int  first = Small<Dim>(kind, 0).first;
			Small<Dim> goesOn(kind, 0, first - 2), ends(kind, 0, first - 1), far(kind, 0.3);
			goesOn.press().expectWide();
			EXPECT_EQ(ends.press().lowestNode(0), first) << int(kind);
			EXPECT_EQ(ends.lowestNode(Dim == 3 ? 2 : 0), Dim == 3 ? first - 1 : first) << int(kind);
			far.contacts.bodies[0].begin.position[1] += 5, far.contacts.bodies[0].end.position[1] += 5;
			EXPECT_EQ(far.press().lowestNode(0), 99) << int(kind);
		}
	}

	/// A block on all of a column: all of a layer is pressed alike.
	TYPED_TEST(SmallOf, EvenPressureStaysEven)
	{
		constexpr int Dim = TypeParam::value;
		Small<Dim>    scene(RigidKind::block, 0);
		scene.cloud = block<Dim>(scene.model.grid, Index<Dim>::Constant(2), 2);
		scene.rollers();
		auto& body          = scene.contacts.bodies[0];
		body.begin.position = scene.h * (Vec<Dim>::Ones() + 2 * Vec<Dim>::Unit(1));
		body.end.position   = body.begin.position - 0.05 * Vec<Dim>::Unit(1);
		const auto before   = scene.cloud.position;
		ASSERT_TRUE(scene.step().converged()) << scene.report.cause;
		for (std::size_t p = 0; p < scene.cloud.size(); ++p)
			EXPECT_NEAR(scene.cloud.position[p][1] / before[p][1], scene.cloud.position[0][1] / before[0][1], 1e-9);
		EXPECT_NEAR(scene.cloud.position[0][1] / before[0][1], 0.95, 0.01);
	}

} // namespace
} // namespace gimpm::testContactSmall
