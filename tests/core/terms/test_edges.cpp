// SPDX-License-Identifier: GPL-2.0-or-later
// Where edges of rigid bodies are found.
#include "core/terms/contact/edges.hpp"
#include "scenes.hpp"
#include <Eigen/Geometry>

namespace gimpm::testEdges {
namespace {

	RigidBody<2> segment(const Vec<2>& from, const Vec<2>& to)
	{
		RigidBody<2> body;
		body.shape.kind    = RigidKind::sheet;
		body.shape.corners = { from, to };
		return body;
	}

	/// A closed line, as sheets.
	std::vector<RigidBody<2>> polygon(int sides, double radius)
	{
		std::vector<RigidBody<2>> bodies;
		const auto corner = [&](int i) { return Vec<2>(radius * std::cos(2 * M_PI * i / sides), radius * std::sin(2 * M_PI * i / sides)); };
		for (int i = 0; i < sides; ++i)
			bodies.push_back(segment(corner(i), corner((i + 1) % sides)));
		return bodies;
	}

	TEST(Edges, BlocksHaveThemAtTheirCornersWhereverTheyAreTurned)
	{
		RigidBody<2> body;
		body.shape.kind     = RigidKind::block;
		body.shape.halfSize = { 2, 1 };
		body.begin.position = { 5, 7 };
		body.begin.rotation = Eigen::Rotation2Dd(M_PI / 2).toRotationMatrix();
		const auto edges    = edgesOf<2>({ body }, 0.1, false);
		ASSERT_EQ(edges.size(), 4u);
		for (const auto& x : edges)
			EXPECT_LT(((x - Vec<2>(5, 7)).cwiseAbs() - Vec<2>(1, 2)).norm(), 1e-14);
	}

	TEST(Edges, LinesOfSheetsHaveThemAtSharpCornersAndEndsOnly)
	{
		EXPECT_TRUE(edgesOf<2>(polygon(36, 1), 0.1, false).empty());
		EXPECT_EQ(edgesOf<2>(polygon(6, 1), 0.1, false).size(), 6u);
		auto open = polygon(36, 1);
		open.pop_back();
		EXPECT_EQ(edgesOf<2>(open, 0.1, false).size(), 2u);
	}

	TEST(Edges, AConeHasThemAtItsTipAndItsShoulderAndAPileAtItsFootOnly)
	{
		const std::vector<RigidBody<2>> cone = { segment({ 0, 0 }, { 1, 1.7 }), segment({ 1, 1.7 }, { 1, 9 }), segment({ 1, 9 }, { 0, 9 }) };
		EXPECT_EQ(edgesOf<2>(cone, 0.1, true).size(), 3u); // with that of the shaft's upper end
		const std::vector<RigidBody<2>> pile  = { segment({ 0, 0 }, { 1, 0 }), segment({ 1, 0 }, { 1, 9 }), segment({ 1, 9 }, { 0, 9 }) };
		const auto                      edges = edgesOf<2>(pile, 0.1, true);
		ASSERT_EQ(edges.size(), 2u);
		for (const auto& x : edges)
			EXPECT_EQ(x[0], 1);
	}

	TEST(Edges, InSpaceTheyAreNoFartherApartThanTheSpacing)
	{
		RigidBody<3> body;
		body.shape.kind     = RigidKind::block;
		body.shape.halfSize = { 1, 1, 1 };
		const auto edges    = edgesOf<3>({ body }, 0.3, false);
		EXPECT_EQ(edges.size(), 12u * 8);
		for (const auto& x : edges)
			EXPECT_GE((x.cwiseAbs().array() == 1).count(), 2);
	}

	TEST(Edges, TrianglesInOnePlaneHaveThemAroundThatPlaneOnly)
	{
		RigidBody<3> one, other;
		one.shape.kind = other.shape.kind = RigidKind::sheet;
		one.shape.corners                 = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0) };
		other.shape.corners               = { Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0) };
		for (const auto& x : edgesOf<3>({ one, other }, 0.1, false))
			EXPECT_TRUE(x[0] == 0 || x[1] == 0 || std::abs(x[0] - 1) < 1e-12 || std::abs(x[1] - 1) < 1e-12) << x.transpose();
		other.shape.corners[2][2] = 0.5; // now they turn
		bool isOnDiagonal         = false;
		for (const auto& x : edgesOf<3>({ one, other }, 0.1, false))
			isOnDiagonal = isOnDiagonal || (x[0] > 0.2 && x[0] < 0.8 && std::abs(x[0] - x[1]) < 1e-12);
		EXPECT_TRUE(isOnDiagonal);
	}

	TEST(Edges, RoundBodiesHaveThemAllAroundAndPlanesNowhere)
	{
		RigidBody<2> ball, plane;
		ball.shape.radius   = 1;
		ball.begin.position = { 3, 0 };
		plane.shape.kind    = RigidKind::plane;
		const auto edges    = edgesOf<2>({ ball, plane }, 0.25, false);
		EXPECT_GE(edges.size(), 26u);
		Vec<2> sum = Vec<2>::Zero();
		for (const auto& x : edges) {
			EXPECT_NEAR((x - Vec<2>(3, 0)).norm(), 1, 1e-12);
			sum += x - Vec<2>(3, 0);
		}
		EXPECT_LT(sum.norm(), 1e-10);
	}

} // namespace
} // namespace gimpm::testEdges
