// SPDX-License-Identifier: GPL-2.0-or-later
// Points on the surfaces of rigid bodies: areas and moments in sum, spacing, sides, and names.
#include "core/terms/contact/contact_surface.hpp"
#include "scenes.hpp"
#include <Eigen/Geometry>
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
		Vec<Dim> normal = Vec<Dim>::Zero(), position = Vec<Dim>::Zero();

		explicit Sums(const std::vector<SurfacePoint<Dim>>& points)
		{
			for (const auto& p : points) {
				EXPECT_NEAR(p.normal.norm(), 1, 1e-14);
				area += p.area, normal += p.area * p.normal, position += p.area * p.position, volume += p.area * p.position.dot(p.normal) / Dim;
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
		EXPECT_LT(sums.normal.norm() + sums.position.norm(), 1e-12);
		Mat<Dim> second = Mat<Dim>::Zero(); // a third of the area in space, half of it in the plane, in each direction
		for (const auto& p : pointsOf(shape))
			second += p.area / sums.area * Dim * p.normal * p.normal.transpose();
		EXPECT_LT((second - Mat<Dim>::Identity()).norm(), 1e-3);
	}

	TYPED_TEST(ContactSurfaceOf, PlacesOfABallTurnWithItsAxes)
	{
		constexpr int Dim   = TypeParam::value;
		auto          shape = shapeOf<Dim>(RigidKind::ball);
		const auto    first = pointsOf(shape);
		shape.axes.template topLeftCorner<2, 2>() << 0.8, -0.6, 0.6, 0.8;
		const auto turned = pointsOf(shape);
		ASSERT_EQ(turned.size(), first.size());
		for (std::size_t i = 0; i < first.size(); ++i) {
			EXPECT_EQ(turned[i].number, first[i].number);
			EXPECT_LT(
			        (turned[i].position - shape.axes * first[i].position).norm() + (turned[i].normal - shape.axes * first[i].normal).norm(), 1e-14);
			EXPECT_EQ(turned[i].area, first[i].area);
		}
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
		EXPECT_LT(sums.normal.norm() + sums.position.norm(), 1e-12);
		for (const auto& p : points) {
			const Vec<Dim> beyond = p.position.cwiseAbs() - shape.halfSize;
			int            face;
			EXPECT_NEAR(beyond.maxCoeff(&face), 0, 1e-15);
			EXPECT_EQ(p.normal, (p.position[face] < 0 ? -1 : 1) * Vec<Dim>::Unit(face));
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
			EXPECT_LT((sums.position / sums.area - middle).norm(), 1e-12);
			EXPECT_NEAR(sums.normal.norm(), isTwoSided ? 0 : area, 1e-12);
			RigidBody<Dim> body;
			body.shape = shape;
			for (const auto& p : points)
				EXPECT_EQ(body.sideOf({}, p.position + 0.1 * p.normal), isTwoSided && p.number % 2 ? -1 : 1);
		}
	}

	/// Whatever box of a surface is asked for, its places are the same.
	TYPED_TEST(ContactSurfaceOf, PlacesInABoxAreThoseOfTheWhole)
	{
		constexpr int  Dim = TypeParam::value;
		const Vec<Dim> low = Vec<Dim>::Constant(-0.31), high = Vec<Dim>::Constant(0.55);
		for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::sheet, RigidKind::plane }) {
			const auto                     shape = shapeOf<Dim>(kind);
			const auto                     some  = surfacePoints<Dim>(shape, 0.1, low, high);
			std::vector<SurfacePoint<Dim>> inBox;
			for (const auto& p : pointsOf(shape))
				if ((p.position.array() >= low.array()).all() && (p.position.array() <= high.array()).all()) inBox.push_back(p);
			ASSERT_EQ(some.size(), inBox.size()) << int(kind);
			EXPECT_LT(some.size(), pointsOf(shape).size());
			EXPECT_GT(some.size(), 0u) << int(kind);
			for (std::size_t i = 0; i < some.size(); ++i) {
				EXPECT_EQ(some[i].number, inBox[i].number);
				EXPECT_EQ(some[i].position, inBox[i].position);
			}
		}
	}

	/// The part of the surface around a place has its area, around its middle.
	TYPED_TEST(ContactSurfaceOf, CornersSpanThePartOfAPlace)
	{
		constexpr int Dim = TypeParam::value;
		for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::sheet, RigidKind::plane })
			for (const auto& p : pointsOf(shapeOf<Dim>(kind), 0.05)) {
				double   area   = (p.corners[1] - p.corners[0]).norm();
				Vec<Dim> middle = (p.corners[0] + p.corners[1]) / 2;
				if constexpr (Dim == 3) {
					const Vec3 first = p.corners[2] - p.corners[0], second = p.corners[3] - p.corners[1];
					const bool isTriangle = p.corners[2] == p.corners[3];
					area                  = first.cross(second).norm() / 2;
					middle                = isTriangle ? Vec3((p.corners[0] + p.corners[1] + p.corners[2]) / 3)
					                                   : Vec3((p.corners[0] + p.corners[1] + p.corners[2] + p.corners[3]) / 4);
				}
				const double error = kind == RigidKind::ball ? 0.02 : 1e-12; // flat parts of a curve
				EXPECT_NEAR(area, p.area, error * p.area) << int(kind);
				EXPECT_LT((middle - p.position).norm(), (kind == RigidKind::ball ? 0.02 : 1e-12) * 0.05 + 1e-12) << int(kind);
			}
	}

	/// In the axes of space, of a body that is turned.
	TYPED_TEST(ContactSurfaceOf, OfATurnedBodyTheBoxIsThatOfSpace)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    shape = shapeOf<Dim>(RigidKind::block);
		Pose<Dim>     pose;
		pose.position                            = Vec<Dim>::LinSpaced(1, 2);
		pose.rotation.template block<2, 2>(0, 0) = Eigen::Rotation2D<double>(0.6).toRotationMatrix();
		const Vec<Dim>         low = pose.position - Vec<Dim>::Constant(0.2), high = pose.position + Vec<Dim>::Constant(0.8);
		std::set<std::int64_t> some;
		for (const auto& p : surfacePointsAt<Dim>(shape, pose, 0.4, low, high))
			some.insert(p.number);
		int inBox = 0;
		for (const auto& p : pointsOf(shape)) {
			const Vec<Dim> x = pose.inSpace(p.position);
			if (!((x.array() >= low.array()).all() && (x.array() <= high.array()).all())) continue;
			++inBox;
			EXPECT_EQ(some.count(p.number), 1u);
		}
		EXPECT_GT(inBox, 0);
		EXPECT_LT(some.size(), pointsOf(shape).size());
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
						if (&q != &p && q.normal.dot(p.normal) > 0.1) closest = std::min(closest, (q.position - p.position).norm());
					EXPECT_LE(closest, spacing < 1 ? spacing * (1 + 1e-9) : infinity);
				}
				EXPECT_EQ(numbers.size(), points.size());
				EXPECT_GE(points.size(), Dim == 2 ? 2u : 3u);
			}
	}

} // namespace
} // namespace gimpm::testContactSurface
