// SPDX-License-Identifier: GPL-2.0-or-later
// Points on the surfaces of rigid bodies: areas and moments in sum, spacing, sides, and names.
#include "core/terms/contact_surface.hpp"
#include "scenes.hpp"
#include <set>

namespace gimpm::testContactSurface {
namespace {

	template <class T> using ContactSurfaceOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(ContactSurfaceOf, BothDimensions, DimensionName);

	template <int Dim> RigidShape<Dim> shapeOf(RigidKind kind)
	{
		RigidShape<Dim> shape;
		shape.kind     = kind;
		shape.radius   = 0.7;
		shape.halfSize = Vec<Dim>::LinSpaced(0.4, 0.66);
		shape.normal   = Vec<Dim>::Unit(1);
		for (int i = 0; i < Dim; ++i)
			shape.corners[i] = 0.9 * Vec<Dim>::Unit(i) - 0.1 * Vec<Dim>::LinSpaced(1, 2);
		return shape;
	}
	template <int Dim> std::vector<SurfacePoint<Dim>> pointsOf(const RigidShape<Dim>& shape, double spacing = 0.1)
	{
		return surfacePoints<Dim>(shape, spacing, Vec<Dim>::Constant(-1), Vec<Dim>::Constant(1));
	}

	/// Areas, of places and normals too: of a closed surface the normals add up to nothing, and place times normal
	/// to Dim times the volume.
	template <int Dim> struct Sums {
		double   area = 0, volume = 0;
		Vec<Dim> normal = Vec<Dim>::Zero(), place = Vec<Dim>::Zero();

		explicit Sums(const std::vector<SurfacePoint<Dim>>& points)
		{
			for (const auto& p : points) {
				EXPECT_NEAR(p.normal.norm(), 1, 1e-14);
				area += p.area, normal += p.area * p.normal, place += p.area * p.place, volume += p.area * p.place.dot(p.normal) / Dim;
			}
		}
	};

	TYPED_TEST(ContactSurfaceOf, ABallHasItsAreaAndVolume)
	{
		constexpr int   Dim   = TypeParam::value;
		const auto      shape = shapeOf<Dim>(RigidKind::ball);
		const double    r     = shape.radius;
		const Sums<Dim> sums(pointsOf(shape));
		EXPECT_NEAR(sums.area, Dim == 2 ? 2 * M_PI * r : 4 * M_PI * r * r, 1e-12);
		EXPECT_NEAR(sums.volume, Dim == 2 ? M_PI * r * r : 4 * M_PI / 3 * r * r * r, 1e-12);
		EXPECT_LT(sums.normal.norm() + sums.place.norm(), 1e-12);
		Mat<Dim> second = Mat<Dim>::Zero(); // a third of the area in space, half of it in the plane, in each direction
		for (const auto& p : pointsOf(shape))
			second += p.area / sums.area * Dim * p.normal * p.normal.transpose();
		EXPECT_LT((second - Mat<Dim>::Identity()).norm(), 1e-3);
	}

	TYPED_TEST(ContactSurfaceOf, ABlockHasThatOfItsFacesAndNoneOnItsEdges)
	{
		constexpr int   Dim    = TypeParam::value;
		const auto      shape  = shapeOf<Dim>(RigidKind::block);
		const Vec<Dim>  size   = 2 * shape.halfSize;
		const auto      points = pointsOf(shape);
		const Sums<Dim> sums(points);
		EXPECT_NEAR(sums.area, 2 * (size.prod() / size.array()).sum(), 1e-12);
		EXPECT_NEAR(sums.volume, size.prod(), 1e-12);
		EXPECT_LT(sums.normal.norm() + sums.place.norm(), 1e-12);
		for (const auto& p : points) {
			const Vec<Dim> beyond = p.place.cwiseAbs() - shape.halfSize;
			int            face;
			EXPECT_NEAR(beyond.maxCoeff(&face), 0, 1e-15);
			EXPECT_EQ(p.normal, (p.place[face] < 0 ? -1 : 1) * Vec<Dim>::Unit(face));
			EXPECT_EQ((beyond.array() > -1e-9).count(), 1);
		}
	}

	TYPED_TEST(ContactSurfaceOf, ASheetHasItsAreaOnOneSideOrOnBoth)
	{
		constexpr int  Dim   = TypeParam::value;
		auto           shape = shapeOf<Dim>(RigidKind::sheet);
		const Vec<Dim> u = shape.corners[1] - shape.corners[0], v = shape.corners[Dim - 1] - shape.corners[0];
		const double   area   = Dim == 2 ? u.norm() : std::sqrt(u.squaredNorm() * v.squaredNorm() - std::pow(u.dot(v), 2)) / 2;
		Vec<Dim>       middle = Vec<Dim>::Zero();
		for (const auto& corner : shape.corners)
			middle += corner / Dim;
		for (const bool isTwoSided : { false, true }) {
			shape.isTwoSided       = isTwoSided;
			const auto      points = pointsOf(shape);
			const Sums<Dim> sums(points);
			EXPECT_NEAR(sums.area, (isTwoSided ? 2 : 1) * area, 1e-12);
			EXPECT_LT((sums.place / sums.area - middle).norm(), 1e-12);
			EXPECT_NEAR(sums.normal.norm(), isTwoSided ? 0 : area, 1e-12);
			RigidBody<Dim> body;
			body.shape = shape;
			for (const auto& p : points)
				EXPECT_EQ(body.sideOf({}, p.place + 0.1 * p.normal), isTwoSided && p.number % 2 ? -1 : 1);
		}
	}

	/// Whatever box of it is asked for, its points are the same.
	TYPED_TEST(ContactSurfaceOf, APlaneIsALatticeThatStaysWhereItIs)
	{
		constexpr int  Dim   = TypeParam::value;
		const auto     shape = shapeOf<Dim>(RigidKind::plane);
		const Vec<Dim> low   = Vec<Dim>::Constant(-0.31);
		const auto     all = pointsOf(shape), some = surfacePoints<Dim>(shape, 0.1, low, -low);
		for (const auto& p : some) {
			const auto same = std::find_if(all.begin(), all.end(), [&](const auto& q) { return q.number == p.number; });
			ASSERT_NE(same, all.end());
			EXPECT_EQ(same->place, p.place);
			EXPECT_EQ(p.place[1], 0);
		}
		EXPECT_LT(some.size(), all.size());
		Sums<Dim> sums(some);
		EXPECT_NEAR(sums.area, std::pow(0.8, Dim - 1), 1e-12) << "whole places of .1 that touch the box";
	}

	TYPED_TEST(ContactSurfaceOf, PlacesAreNoFartherApartThanTheSpacingAndHaveNamesOfTheirOwn)
	{
		constexpr int Dim = TypeParam::value;
		for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::sheet, RigidKind::plane })
			for (const double spacing : { 0.1, 5. }) {
				const auto             points = pointsOf(shapeOf<Dim>(kind), kind == RigidKind::plane ? 0.1 : spacing);
				std::set<std::int64_t> numbers;
				for (const auto& p : points) {
					numbers.insert(p.number);
					EXPECT_EQ(std::int64_t(double(p.number)), p.number) << "they are kept as real numbers";
					double closest = infinity;
					for (const auto& q : points)
						if (&q != &p && q.normal.dot(p.normal) > 0.1) closest = std::min(closest, (q.place - p.place).norm());
					if (spacing < 1) {
						EXPECT_LE(closest, spacing * (1 + 1e-9));
					}
				}
				EXPECT_EQ(numbers.size(), points.size());
				EXPECT_GE(points.size(), Dim == 2 ? 2u : 3u);
			}
	}

} // namespace
} // namespace gimpm::testContactSurface
