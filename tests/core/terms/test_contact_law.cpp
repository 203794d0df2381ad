// SPDX-License-Identifier: GPL-2.0-or-later
// Gap between a contact point and a rigid body, and the contact force, with derivatives against finite differences.
#include "core/terms/contact/contact_law.hpp"
#include "scenes.hpp"
#include <Eigen/Geometry>

namespace gimpm::testContactLaw {
namespace {

	template <int Dim> Mat<Dim> turned(double angle)
	{
		if constexpr (Dim == 2) return planeRotation(angle);
		else
			return rotation({ 1, 2, 3 }, angle);
	}

	template <int Dim> RigidBody<Dim> bodyOf(RigidKind kind)
	{
		RigidBody<Dim> body;
		body.shape.kind       = kind;
		body.shape.radius     = kind == RigidKind::ball ? 0.7 : 0.05;
		body.shape.halfSize   = Vec<Dim>::LinSpaced(0.4, 0.6);
		body.shape.normal     = Vec<Dim>::Unit(1);
		body.shape.isTwoSided = kind == RigidKind::sheet;
		for (int i = 0; i < Dim; ++i)
			body.shape.corners[i] = 0.5 * Vec<Dim>::Unit(i) - 0.1 * Vec<Dim>::Ones();
		body.begin.position = 0.3 * Vec<Dim>::Ones();
		body.begin.rotation = kind == RigidKind::plane ? Mat<Dim>(Mat<Dim>::Identity()) : turned<Dim>(0.4);
		body.end            = { body.begin.position + 0.01 * Vec<Dim>::LinSpaced(1, 2), turned<Dim>(0.02) * body.begin.rotation };
		return body;
	}

	/// Derivative of f: place -> vector.
	template <int Dim, class F> Mat<Dim> slopeOf(F&& f, const Vec<Dim>& x)
	{
		constexpr double step = 1e-6;
		Mat<Dim>         tangent;
		for (int a = 0; a < Dim; ++a)
			tangent.col(a) = (f(x + step * Vec<Dim>::Unit(a)) - f(x - step * Vec<Dim>::Unit(a))) / (2 * step);
		return tangent;
	}

	template <int Dim> void expectGradients(const RigidBody<Dim>& body, const Vec<Dim>& x)
	{
		const auto at = body.proximity(body.end, x, 1);
		EXPECT_NEAR(at.normal.norm(), 1, 1e-14);
		for (int a = 0; a < Dim; ++a) {
			const Vec<Dim> step = 1e-6 * Vec<Dim>::Unit(a);
			const double   gap  = (body.proximity(body.end, x + step, 1).gap - body.proximity(body.end, x - step, 1).gap) / 2e-6;
			EXPECT_NEAR(gap, at.normal[a], 1e-8);
		}
		const Mat<Dim> tangent = slopeOf<Dim>([&](const Vec<Dim>& y) { return body.proximity(body.end, y, 1).normal; }, x);
		EXPECT_LT((tangent - at.normalDerivative).norm(), 1e-7 * (1 + tangent.norm()));
	}

	template <int Dim> void testGradients()
	{
		Random random(3);
		for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::plane, RigidKind::sheet })
			for (int i = 0; i < 20; ++i)
				expectGradients<Dim>(bodyOf<Dim>(kind), bodyOf<Dim>(kind).end.position + random.template matrix<Dim>(0.9));
	}

	/// Force on a place that was at `from`, and is at x.
	template <int Dim> std::optional<Touch<Dim>> touchAt(const RigidBody<Dim>& body, const ContactLaw<Dim>& law, const Vec<Dim>& from, const Vec<Dim>& x)
	{
		const Approach<Dim> approach { body.proximity(body.end, x, 1), x - from, 0.2 * Vec<Dim>::Ones() };
		return touch(law, approach, 1e-9);
	}

	/// Returns whether it slips.
	template <int Dim> bool testForce(RigidKind kind, double friction, double cap)
	{
		const auto            body = bodyOf<Dim>(kind);
		const ContactLaw<Dim> law { 100, 50, friction, cap };
		Vec<Dim>              x = body.end.position + 0.75 * turned<Dim>(0.42) * Vec<Dim>::Unit(1);
		for (int i = 0; i < 5; ++i) // 0.01 deep
			x -= (body.proximity(body.end, x, 1).gap + 0.01) * body.proximity(body.end, x, 1).normal;
		const Vec<Dim> from    = x + 0.003 * Vec<Dim>::LinSpaced(1, 2);
		const auto     touched = touchAt(body, law, from, x);
		EXPECT_TRUE(touched);
		EXPECT_NEAR(touched->normalForce, 1, 1e-10);
		EXPECT_LE(touched->tangentialForce.norm(), std::min(friction, cap) + 1e-12);
		EXPECT_NEAR(touched->tangentialForce.dot(touched->normal), 0, 1e-12);
		const Mat<Dim> tangent = slopeOf<Dim>([&](const Vec<Dim>& y) { return touchAt(body, law, from, y)->force(); }, x);
		EXPECT_LT((tangent - touched->tangent).norm(), 1e-7 * tangent.norm());
		return touched->slips;
	}

	template <int Dim> void testForces()
	{
		constexpr double none = std::numeric_limits<double>::infinity();
		for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::plane, RigidKind::sheet }) {
			EXPECT_FALSE(testForce<Dim>(kind, 0, none));
			EXPECT_FALSE(testForce<Dim>(kind, 10, none));
			EXPECT_TRUE(testForce<Dim>(kind, 0.01, none));
			EXPECT_TRUE(testForce<Dim>(kind, 10, 0.02));
		}
	}

	/// Pressure as large as that of its surroundings; not farther off than it reaches.
	template <int Dim> void testAround()
	{
		const auto body = bodyOf<Dim>(RigidKind::ball);
		Vec<Dim>   x    = body.end.position + 0.75 * turned<Dim>(0.42) * Vec<Dim>::Unit(1);
		for (int i = 0; i < 5; ++i) // 0.01 off
			x -= (body.proximity(body.end, x, 1).gap - 0.01) * body.proximity(body.end, x, 1).normal;
		const Vec<Dim>        from = x + 0.3 * Vec<Dim>::LinSpaced(1, 2);
		const ContactLaw<Dim> law { 100, 50, 0.5, 2, 3, 0.02 }, capped { 100, 50, 0.5, 0.2, 3, 0.02 }, near { 100, 50, 0.5, 2, 3, 0.005 };
		const auto            rubs = touchAt(body, law, from, x), rubsLess = touchAt(body, capped, from, x);
		ASSERT_TRUE(rubs && rubsLess);
		EXPECT_EQ(rubs->normalForce, 0);
		EXPECT_TRUE(rubs->slips);
		EXPECT_NEAR(rubs->tangentialForce.norm(), 1.5, 1e-12);
		EXPECT_NEAR(rubsLess->tangentialForce.norm(), 0.2, 1e-12);
		const Mat<Dim> tangent = slopeOf<Dim>([&](const Vec<Dim>& y) { return touchAt(body, law, from, y)->force(); }, x);
		EXPECT_LT((tangent - rubs->tangent).norm(), 1e-7 * tangent.norm());
		EXPECT_FALSE(touchAt(body, near, from, x));
	}

	TEST(ContactLaw, WhatIsPressedAroundAPlaceLetsItRub)
	{
		testAround<2>();
		testAround<3>();
	}

	TEST(ContactLaw, GapNormalAndItsSlopeInThePlane) { testGradients<2>(); }
	TEST(ContactLaw, GapNormalAndItsSlopeInSpace) { testGradients<3>(); }
	TEST(ContactLaw, ForceAndItsSlopeInThePlane) { testForces<2>(); }
	TEST(ContactLaw, ForceAndItsSlopeInSpace) { testForces<3>(); }

	TEST(ContactLaw, WhatIsOpenHasNoForceAndWhatOnlyTouchesIsHeld)
	{
		const auto body = bodyOf<2>(RigidKind::ball);
		const auto law  = ContactLaw<2> { 100, 50, 0.5, 1e9 };
		const auto at   = [&](double gap) {
                        const Vec<2> x = body.end.position + (0.7 + gap) * Vec<2>::Unit(1);
                        return touchAt<2>(body, law, x, x);
		};
		EXPECT_FALSE(at(1e-8));
		ASSERT_TRUE(at(0.5e-9));
		EXPECT_EQ(at(0.5e-9)->force().norm(), 0);
		EXPECT_NEAR(at(0.5e-9)->tangent(1, 1), -100, 1e-9);
		EXPECT_NEAR(at(0.5e-9)->tangent(0, 0), -50, 0.1);
	}

	/// Only members of a shape that belong to its kind count.
	TEST(ContactLaw, MotionOfABodyIsThatOfItsFarthestPlace)
	{
		constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
		for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::plane, RigidKind::sheet }) {
			auto body = bodyOf<3>(kind);
			if (kind != RigidKind::sheet) body.shape.corners.fill(Vec3::Constant(nothing));
			if (kind != RigidKind::block) body.shape.halfSize.setConstant(nothing);
			const double shift = (body.end.position - body.begin.position).norm();
			EXPECT_GE(body.motion(), shift);
			EXPECT_LT(body.motion(), shift + 0.1);
		}
	}

	TEST(ContactLaw, ATurnWithTheBodyIsNoSlip)
	{
		const auto body = bodyOf<3>(RigidKind::block);
		const Vec3 from = body.begin.position + Vec3(0.3, 0.5, -0.2);
		const Vec3 now  = body.end.inSpace(body.begin.inBody(from));
		EXPECT_LT((body.carried(from) - (now - from)).norm(), 1e-15);
	}

	TEST(ContactLaw, OfASheetItCountsWhetherAPlaceIsStraightBehindIt)
	{
		RigidBody<3> body;
		body.shape.kind       = RigidKind::sheet;
		body.shape.isTwoSided = true;
		body.shape.corners    = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0) };
		EXPECT_EQ(body.sideOf(body.begin, { 0.2, 0.2, 0.1 }), 1);
		EXPECT_EQ(body.sideOf(body.begin, { 0.2, 0.2, -0.1 }), -1);
		EXPECT_NEAR(body.proximity(body.begin, { 0.2, 0.2, -0.1 }, -1).gap, 0.1, 1e-15);
		EXPECT_NEAR(body.proximity(body.begin, { 0.2, 0.2, -0.1 }, 1).beside, -0.2, 1e-15);
		EXPECT_NEAR(body.proximity(body.begin, { 0.5, -0.3, 0 }, 1).beside, 0.3, 1e-15);
		EXPECT_NEAR(body.proximity(body.begin, { 1, 1, 0 }, 1).beside, std::sqrt(0.5), 1e-15);
		body.soilSide = 1, body.slack = 0.02;
		EXPECT_EQ(body.sideOf(body.begin, { 0.2, 0.2, -0.01 }), 1);
		EXPECT_EQ(body.sideOf(body.begin, { 0.2, 0.2, -0.03 }), -1);
		body.soilSide = -1;
		EXPECT_EQ(body.sideOf(body.begin, { 0.2, 0.2, 0.01 }), -1);
		EXPECT_EQ(body.sideOf(body.begin, { 0.2, 0.2, 0.03 }), 1);
	}

} // namespace
} // namespace gimpm::testContactLaw
