// SPDX-License-Identifier: GPL-2.0-or-later
// Soil against rigid bodies: equilibrium, tangent, restraint, what is remembered, and what is refused.
#include "core/stepping/step_system.hpp"
#include "derivatives.hpp"
#include "touched_soil.hpp"

namespace gimpm::testContact {
namespace {

	constexpr double young = TouchedSoil<2>::young;

	template <int Dim> struct Block : TouchedSoil<Dim> {
		explicit Block(bool isRing = false) : TouchedSoil<Dim>(0, 1e-9, 1.5, isRing) { }

		StepSystem<Dim> system() { return { this->cloud, this->model, Load<Dim>(), this->report }; }
	};

	template <class T> using ContactOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(ContactOf, BothDimensions, DimensionName);

	template <int Dim> double tangentError(Block<Dim>& block) { return tangentErrorOfLastTerm(block.system(), block.model.grid, 1e-7); }

	/// A body of each kind that comes down on the block; friction that makes all places slip, some, and none, and a
	/// cap.
	template <int Dim> void testTangents(bool isRing)
	{
		const double limit = infinity;
		for (const auto& [friction, cap] :
		     { std::pair(0., limit), std::pair(0.01, limit), std::pair(0.3, limit), std::pair(100., limit), std::pair(100., 500.) })
			for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::plane, RigidKind::sheet }) {
				Block<Dim> block(isRing);
				Vec<Dim>   place = Vec<Dim>::Constant(isRing ? 0 : 0.7);
				place[1]         = kind == RigidKind::plane || kind == RigidKind::sheet ? 1.5 : 2.5;
				auto& body       = block.add(kind, place, friction);
				body.adhesion    = cap;
				body.end.position[1] -= 0.03;
				if (!isRing && kind != RigidKind::plane) body.end.rotation = turn<Dim>(0.02);
				EXPECT_LT(tangentError(block), 1e-6) << int(kind) << " " << friction << " " << cap;
				EXPECT_EQ(block.system().isSymmetric(), friction == 0);
			}
	}

	TYPED_TEST(ContactOf, TangentIsTheDerivative) { testTangents<TypeParam::value>(false); }
	TEST(Contact, TangentIsTheDerivativeAroundAnAxis) { testTangents<2>(true); }

	/// Pressed to 0.75 of its height, nu = 0: E ln l / l.
	TYPED_TEST(ContactOf, PlateOnABlock)
	{
		constexpr int Dim   = TypeParam::value;
		const double  exact = young * std::log(0.75) / 0.75 * std::pow(1.5, Dim - 1);
		double        last  = 1;
		for (const double stiffness : { 50., 500., 5000. }) {
			Block<Dim> block;
			block.rollers();
			auto& plate     = block.add(RigidKind::plane, 1.5 * Vec<Dim>::Unit(1));
			plate.stiffness = stiffness;
			for (int i = 1; i <= 8; ++i) {
				plate.end.position[1] = 1.5 * (1 - 0.25 * i / 8);
				ASSERT_TRUE(block.step().converged()) << block.report.cause;
				EXPECT_LE(block.report.iterations, 7);
			}
			const double error = std::abs(-block.contacts.loads[0].force[1] / exact - 1);
			EXPECT_LT(error, Dim == 2 ? 0.75 / stiffness * 2 : 0.75 / stiffness * 2) << stiffness;
			EXPECT_LT(error, last / 5);
			EXPECT_NEAR(block.contacts.loads[0].force[1] / -block.report.reactions[1][1], -1, 1e-6);
			last = error;
		}
	}

	/// Those of the last step, wherever the body goes in this one.
	TYPED_TEST(ContactOf, ForcesAsTheStepBegins)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    block;
		block.rollers();
		auto& plate = block.add(RigidKind::plane, 1.5 * Vec<Dim>::Unit(1), 0.3);
		plate.end.position[1] -= 0.05;
		ASSERT_TRUE(block.step().converged()) << block.report.cause;
		const Vec<Dim> force = -block.contacts.loads[0].force.template head<Dim>();
		EXPECT_LT(force[1], -1e4);
		plate.end.position[1] -= 0.05;
		EXPECT_LT((resultantBefore(block.system()) - force).norm(), 1e-12 * force.norm());
		EXPECT_NEAR(block.contacts.work / (-0.05 * force[1]), 1, 0.1);
	}

	/// The floor, looking up, at the height where the block begins.
	template <int Dim> RigidBody<Dim>& addFloor(Block<Dim>& block, double friction = 0)
	{
		auto& floor        = block.add(RigidKind::plane, Vec<Dim>::Zero(), friction);
		floor.shape.normal = Vec<Dim>::Unit(1);
		return floor;
	}

	template <int Dim> Load<Dim> weight(double slope = 0)
	{
		Load<Dim> load;
		load.gravity[0] = 10 * std::sin(slope), load.gravity[1] = -10 * std::cos(slope);
		load.factor = { 1, 1 };
		return load;
	}

	template <int Dim> double massOf(const Block<Dim>& block) { return block.model.materials[0].density * std::pow(1.5, Dim); }

	TYPED_TEST(ContactOf, WhatOnlyTouchesCarries)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    block;
		block.model.materials[0].density = 1000;
		addFloor(block, 0.5); // friction is all that holds it sideways
		ASSERT_TRUE(block.step(weight<Dim>()).converged()) << block.report.cause;
		EXPECT_NEAR(block.contacts.loads[0].force[1] / (-10 * massOf(block)), 1, 1e-8);
		EXPECT_LE(block.report.iterations, 6);
		EXPECT_FALSE(block.contacts.records.empty());
	}

	TYPED_TEST(ContactOf, WhatIsLeftIsReported)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    block;
		block.model.materials[0].density = 1000;
		addFloor(block, 0.5);
		ASSERT_TRUE(block.step(weight<Dim>()).converged());
		block.contacts.bodies[0].begin.position[1] -= 0.1; // erased, and appended anew
		block.contacts.bodies[0].end = block.contacts.bodies[0].begin;
		block.contacts.records.clear();
		EXPECT_EQ(block.step(weight<Dim>()).failure, Failure::unrestrained);
		EXPECT_NE(block.report.cause.find("translation along x"), std::string::npos) << block.report.cause;
	}

	/// On a slope, which is gravity turned: it holds up to tan b = mu.
	TYPED_TEST(ContactOf, FrictionHoldsUpToItsAngle)
	{
		constexpr int Dim = TypeParam::value;
		for (const double part : { 0.98, 1.02 }) {
			Block<Dim> block;
			block.model.materials[0].density = 1000;
			const double slope               = 0.35;
			addFloor(block, std::tan(slope) / part);
			block.step(weight<Dim>(slope));
			if (part < 1) {
				EXPECT_TRUE(block.report.converged()) << block.report.cause;
				EXPECT_NEAR(block.contacts.loads[0].force[0] / (10 * std::sin(slope) * massOf(block)), 1, 1e-8);
			} else {
				EXPECT_EQ(block.report.failure, Failure::slides) << block.report.cause;
			}
		}
	}

	/// A floor of two sheets, and soil over their common edge, which is on a line of the grid or between two.
	TEST(Contact, SheetsInOnePlaneActAsOne)
	{
		double height[2];
		for (const double middle : { 0.5, 0.6 }) {
			Block<2> block;
			block.model.materials[0].density = 1000;
			const Vec<2> places[]            = { { -1, 0 }, { middle, 0 }, { 3, 0 } };
			for (int i = 0; i < 2; ++i) {
				auto& sheet            = block.add(RigidKind::sheet, places[i], 0.5);
				sheet.shape.corners    = { Vec<2>(0, 0), Vec<2>(places[i + 1] - places[i]) };
				sheet.shape.isTwoSided = true;
			}
			ASSERT_TRUE(block.step(weight<2>()).converged()) << block.report.cause;
			EXPECT_NEAR((block.contacts.loads[0].force[1] + block.contacts.loads[1].force[1]) / (-10 * massOf(block)), 1, 1e-8);
			height[middle > 0.55] = block.cloud.position[0][1];
		}
		const double pressedIn = 1.5 * 1e4 * 0.5 / (100 * young); // penetration by the weight; contact points of the sheets differ in their cells
		EXPECT_NEAR(height[0], height[1], 0.03 * pressedIn);
	}

	/// Overlap at first sight fits, whether the body has just come or not. A body around the centre
	/// of a point is misplaced when it comes.
	TEST(Contact, WishedInPlace)
	{
		for (const bool isNew : { true, false }) {
			Block<2> block;
			block.rollers();
			block.add(RigidKind::ball, { 0.75, 2.45 }).isNew = isNew;
			ASSERT_TRUE(block.step().converged()) << block.report.cause;
			EXPECT_EQ(block.contacts.loads[0].force.norm(), 0);
			EXPECT_FALSE(block.contacts.records.empty());
			block.contacts.bodies[0].end.position[1] -= 0.01;
			ASSERT_TRUE(block.step().converged()) << block.report.cause;
			EXPECT_GT(block.contacts.loads[0].force[1], 1e3);
			for (const auto& record : block.contacts.records)
				EXPECT_GT(record.gap, -0.01) << "what it overlapped is not pushed out";
		}
		for (const bool isNew : { true, false }) {
			Block<2> deep;
			deep.rollers();
			deep.add(RigidKind::ball, { 0.75, 2.2 }).isNew = isNew;
			EXPECT_EQ(deep.step().failure == Failure::misplaced, isNew);
			EXPECT_EQ(deep.report.cause.find("body #0 has the middle of a material point inside of it, at (") != std::string::npos, isNew)
			        << deep.report.cause;
		}
	}

	/// Soft enough to let soil in.
	TEST(Contact, ThatLetsAPointInIsRefused)
	{
		Block<2> block;
		block.rollers();
		auto& plate     = block.add(RigidKind::plane, { 0, 1.5 });
		plate.stiffness = 0.01;
		plate.end.position[1] -= 0.4;
		const auto before = block.cloud.position;
		EXPECT_EQ(block.step().failure, Failure::penetrated);
		EXPECT_NE(block.report.cause.find("body #0 would get soil inside of it, which moves "), std::string::npos) << block.report.cause;
		EXPECT_NE(block.report.cause.find("and the body up to 0.4 m, at ("), std::string::npos) << block.report.cause;
		EXPECT_EQ(before, block.cloud.position);
	}

	/// The middles of the highest points are 0.125 m from it. A tenth of a cell is 0.05 m.
	TEST(Contact, SoilOnOneSideOfASheetMayGetBehindItALittle)
	{
		Block<2> block;
		block.rollers();
		auto& sheet            = block.add(RigidKind::sheet, { 0, 1.5 });
		sheet.shape.isTwoSided = true;
		sheet.stiffness        = 0.01;
		sheet.end.position[1] -= 0.15;
		EXPECT_EQ(block.step().failure, Failure::penetrated) << "which side is the soil's is not known yet";
		EXPECT_NE(block.report.cause.find("body #0 would let soil through"), std::string::npos) << block.report.cause;
		for (const double down : { 0.05, 0.15, 0.16 }) {
			sheet.end.position[1] = 1.5 - down;
			EXPECT_TRUE(block.step().converged()) << block.report.cause;
			EXPECT_GT(block.contacts.loads[0].force[1], 0);
		}
		EXPECT_GT(block.cloud.position.back()[1], sheet.end.position[1]);
		for (const auto& record : block.contacts.records)
			EXPECT_EQ(record.number % 2, block.contacts.records[0].number % 2) << "its other side does not see what is behind it";
		sheet.end.position[1] = 1.5 - 0.2;
		EXPECT_EQ(block.step().failure, Failure::penetrated);
	}

	/// A pile made of two sheets, whose inside nothing may press: soil below it is beside its side only as seen
	/// through its bottom.
	TEST(Contact, SoilBehindAnotherSheetIsNotSeen)
	{
		Block<2> block;
		block.rollers();
		const Vec<2> corner(0.75, 1.5);
		for (const auto& [from, to] : { std::pair<Vec<2>, Vec<2>>({ -1, 1.5 }, corner), std::pair<Vec<2>, Vec<2>>({ 0.75, 1.6 }, corner) }) {
			auto& sheet            = block.add(RigidKind::sheet, corner);
			sheet.shape.isTwoSided = true;
			sheet.shape.corners    = { from - corner, to - corner };
		}
		for (int step = 0; step < 3; ++step) {
			for (auto& sheet : block.contacts.bodies)
				sheet.end.position[1] -= 0.02;
			ASSERT_TRUE(block.step().converged()) << block.report.cause;
			EXPECT_GT(block.contacts.loads[0].force[1], 0);
			for (const auto& record : block.contacts.records)
				EXPECT_FALSE(record.body == 1 && record.normal[0] < 0) << "seen at " << record.position.transpose();
		}
	}

	TYPED_TEST(ContactOf, WhatIsCrossed)
	{
		constexpr int  Dim   = TypeParam::value;
		const Vec<Dim> above = Vec<Dim>::Unit(1) * 1.01, below = -above, beside = Vec<Dim>::Unit(0) * 1.01;
		RigidBody<Dim> body;
		body.shape.radius   = 1;
		body.shape.halfSize = Vec<Dim>::Ones();
		for (const auto kind : { RigidKind::block, RigidKind::ball }) {
			body.shape.kind = kind;
			if (kind == RigidKind::block) body.shape.radius = 0.1;
			EXPECT_TRUE(body.isCrossed(above, below));
			EXPECT_TRUE(body.isCrossed(above, 0.8 * below)) << "it would be pushed out there";
			EXPECT_FALSE(body.isCrossed(above, 0.8 * above));
			EXPECT_FALSE(body.isCrossed(above, beside)) << "around an edge";
			EXPECT_FALSE(body.isCrossed(above + 2 * beside, below + 2 * beside)) << "past it";
			body.end.position[1] += 1.5;
			EXPECT_TRUE(body.isCrossed(above, above)) << "it moves by more than half its thickness";
			body.end.position[1] -= 1.5;
			body.shape.radius = 1;
		}
		body.shape.kind   = RigidKind::plane;
		body.shape.normal = Vec<Dim>::Unit(1);
		EXPECT_FALSE(body.isCrossed(above, below)) << "its side is known";
	}

	/// The places on its lower side push down, however far it goes in a step and however thin it is.
	TYPED_TEST(ContactOf, WhatIsThinDoesNotLetSoilThrough)
	{
		constexpr int Dim = TypeParam::value;
		for (const double way : { 0.04, 0.11, 0.3 }) { // the thickness is 0.02
			Block<Dim> block;
			block.rollers();
			Vec<Dim> place         = Vec<Dim>::Constant(0.75);
			place[1]               = 1.51;
			auto& body             = block.add(RigidKind::block, place);
			body.shape.halfSize    = Vec<Dim>::Constant(3);
			body.shape.halfSize[1] = 0.01;
			body.end.position[1] -= way;
			ASSERT_TRUE(block.step().converged()) << block.report.cause;
			for (const Vec<Dim>& x : block.cloud.position)
				EXPECT_LT(x[1], 1.5 - way);
		}
	}

	/// There and back: what has stuck pulls back, what has slipped stays behind.
	TEST(Contact, FrictionRemembers)
	{
		for (const double friction : { 10., 0.01 }) {
			Block<2> block;
			block.rollers();
			auto& plate = block.add(RigidKind::plane, { 0, 1.5 }, friction);
			plate.end.position[1] -= 0.02;
			ASSERT_TRUE(block.step().converged());
			double largest = 0;
			for (const double shift : { 0.0005, 0.0005, -0.0005, -0.0005 }) {
				block.contacts.bodies[0].end.position[0] += shift;
				ASSERT_TRUE(block.step().converged()) << block.report.cause;
				largest = std::max(largest, std::abs(block.contacts.loads[0].force[0]));
			}
			const double last = block.contacts.loads[0].force[0], limit = 0.01 * block.contacts.loads[0].force[1];
			if (friction > 1) EXPECT_LT(std::abs(last), 1e-2 * largest);
			else
				EXPECT_NEAR(last / limit, 1, 1e-6); // moved to the left, the plate is held by what it rubs on
		}
	}

	/// In space, forces and torques on the owner are what the soil gets.
	TEST(Contact, GivesItsOwnerForceTorqueAndStiffness)
	{
		Block<3> block;
		block.rollers();
		auto& ball = block.add(RigidKind::ball, { 0.7, 2.5, 0.8 }, 0.3);
		ball.end.position += Vec3(0.02, -0.05, 0.01);
		ASSERT_TRUE(block.step().converged()) << block.report.cause;
		const ContactLoad& load  = block.contacts.loads[0];
		Vec3               force = Vec3::Zero(), reactions = Vec3::Zero();
		for (const auto& record : block.contacts.records)
			force += record.normalForce * record.normal + record.tangentialForce;
		for (const Vec3& r : block.report.reactions)
			reactions += r;
		EXPECT_LT((force + load.force).norm(), 1e-12 * force.norm());
		EXPECT_LT((force + reactions).norm(), 1e-7 * force.norm());
		EXPECT_LT((load.stiffness - load.stiffness.transpose()).norm(), 1e-12 * load.stiffness.norm());
		EXPECT_GT(load.stiffness(1, 1), load.force[1] / 0.06);
	}

} // namespace
} // namespace gimpm::testContact
