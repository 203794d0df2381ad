// SPDX-License-Identifier: GPL-2.0-or-later
// Free faces that limit analysis does not let stand.
#include "core/stepping/plane_slip.hpp"
#include "scenes.hpp"

namespace gimpm::testPlaneSlip {
namespace {

	constexpr double unitWeight = 2e4;

	/// Ground of 6 x 3 m, in space 1.5 m wide, between rollers on a rough base, dug away to a depth where `isDug`
	/// says so.
	template <int Dim> struct Cut {
		Grid<Dim>                        grid;
		PointCloud<Dim>                  cloud;
		std::vector<ConstrainedBox<Dim>> boxes;
		Vec<Dim>                         down = -Vec<Dim>::Unit(Dim - 1);

		explicit Cut(
		        double height, double size = 0.5, std::function<bool(const Vec<Dim>&)> isDug = [](const Vec<Dim>& x) { return x[0] > 3; })
		{
			grid.cellSize   = size;
			Vec<Dim> extent = Vec<Dim>::Constant(3);
			extent[0]       = 6;
			if (Dim == 3) extent[1] = 1.5;
			for (const auto& x : block<Dim>(grid, (extent / size).array().round().matrix().template cast<int>(), 2).position)
				if (!isDug(x) || x[Dim - 1] < 3 - height) addPoint<Dim>(cloud, x, Vec<Dim>::Constant(size / 4));
			Vec<Dim>   low = Vec<Dim>::Constant(-infinity), high = Vec<Dim>::Constant(infinity);
			const auto hold = [&](int axis, double from, double to, const char* along) {
				Vec<Dim> a = low, b = high;
				a[axis] = from, b[axis] = to;
				boxes.push_back(held<Dim>(grid, a, b, along));
			};
			hold(0, -infinity, 0, "x"), hold(0, 6, infinity, "x"), hold(Dim - 1, -infinity, 0, Dim == 2 ? "xy" : "xyz");
			if (Dim == 3) hold(1, -infinity, 0, "y"), hold(1, 1.5, infinity, "y");
		}
		std::optional<PlaneSlip<Dim>> worst(const std::vector<std::optional<Strength>>& strength) const
		{
			std::vector<double> weight;
			for (const double volume : cloud.volume0)
				weight.push_back(unitWeight * volume);
			return worstPlaneSlip<Dim>(cloud, grid, Boundary<Dim>(boxes), strength, weight, down);
		}
	};

	/// The weight over that which a vertical face bears: height 4 c / unit weight tan(45 + phi / 2).
	double exact(double height, const Strength& strength)
	{
		return unitWeight * height / (4 * strength.cohesion * std::tan(M_PI / 4 + strength.frictionAngle / 2));
	}

	TEST(PlaneSlip, IsCoulombsOfAVerticalFace)
	{
		for (const double size : { 0.5, 0.25 })
			for (const double height : { 0.5, 1., 2. })
				for (const Strength strength : { Strength { 1e3, 0.5 }, Strength { 100, 0.7 } }) {
					const auto slip = Cut<2>(height, size).worst({ strength });
					ASSERT_TRUE(slip);
					EXPECT_NEAR(slip->excess / exact(height, strength), 1, 2e-3);
					EXPECT_NEAR(slip->height, height, 1e-12);
					EXPECT_NEAR(slip->angle, M_PI / 4 + strength.frictionAngle / 2, M_PI / 90);
					EXPECT_LT((slip->foot - Vec<2>(3, 3 - height)).norm(), 1e-12);
				}
	}

	TEST(PlaneSlip, IsNoneOfWhatStands)
	{
		for (const double cohesion : { 0.99, 1.01 }) {
			Strength strength { 1e3, 0.5 };
			strength.cohesion *= cohesion * exact(1, strength);
			EXPECT_EQ(Cut<2>(1).worst({ strength }).has_value(), cohesion < 1);
		}
	}

	TEST(PlaneSlip, IsTheSameInSpace)
	{
		const Strength strength { 1e3, 0.6 };
		const auto     slip = Cut<3>(1).worst({ strength });
		ASSERT_TRUE(slip);
		EXPECT_NEAR(slip->excess / exact(1, strength), 1, 2e-3);
		// Beside ground that stays a face is not free all across.
		EXPECT_FALSE(Cut<3>(1, 0.5, [](const Vec<3>& x) { return x[0] > 3 && x[1] > 0.5; }).worst({ strength }));
	}

	TEST(PlaneSlip, IsLookedForOnBothSidesAndUpsideDown)
	{
		const Strength strength { 1e3, 0.6 };
		Cut<2>         mirrored(1), turned(1);
		for (auto& x : mirrored.cloud.position)
			x[0] = 6 - x[0];
		for (auto& x : turned.cloud.position)
			x[1] = 3 - x[1];
		turned.down = Vec<2>(0, 1), turned.boxes[2] = held<2>(turned.grid, { -infinity, 3 }, { infinity, infinity }, "xy");
		const double excess = Cut<2>(1).worst({ strength })->excess;
		EXPECT_NEAR(mirrored.worst({ strength })->excess, excess, 1e-9 * excess);
		EXPECT_NEAR(turned.worst({ strength })->excess, excess, 1e-9 * excess);
	}

	TEST(PlaneSlip, WithoutCohesionIsAlwaysThere)
	{
		EXPECT_EQ(Cut<2>(1).worst({ Strength { 0, 0.6 } })->excess, infinity);
		EXPECT_FALSE(Cut<2>(0).worst({ Strength { 0, 0.6 } }));
	}

	TEST(PlaneSlip, IsNoneOfWhatIsHeld)
	{
		const Strength strength { 1e3, 0.6 };
		Cut<2>         wall(1), prop(1), before(1);
		wall.boxes.push_back(held<2>(wall.grid, { 3, 1.5 }, { 3, infinity }, "x"));
		prop.boxes.push_back(held<2>(prop.grid, { 3, 3 }, { 3, 3 }, "x"));
		before.boxes.push_back(held<2>(before.grid, { 3, -infinity }, { 6, 2 }, "xy")); // below the foot
		EXPECT_FALSE(wall.worst({ strength }));
		EXPECT_FALSE(prop.worst({ strength }));
		EXPECT_TRUE(before.worst({ strength }));
	}

	TEST(PlaneSlip, GoesThroughNoOtherMaterialAndNoCavity)
	{
		const Strength strength { 1e3, 0.6 };
		Cut<2>         rock(1), base(1), cave(1), open(1);
		PointCloud<2>  left;
		for (std::size_t p = 0; p < rock.cloud.size(); ++p) {
			const auto x           = rock.cloud.position[p];
			rock.cloud.material[p] = x[0] < 3 && x[0] > 2.7 && x[1] > 2;
			base.cloud.material[p] = x[1] < 2;
			if (x[0] < 2.4 || x[0] > 2.9 || x[1] < 2.2 || x[1] > 2.8) addPoint<2>(left, x, Vec<2>::Constant(0.125));
		}
		cave.cloud = left;
		EXPECT_FALSE(rock.worst({ strength, std::nullopt }));
		EXPECT_NEAR(base.worst({ strength, std::nullopt })->excess, open.worst({ strength })->excess, 1e-9);
		EXPECT_FALSE(cave.worst({ strength }));
		// The larger strength of two kinds of sand counts.
		EXPECT_NEAR(rock.worst({ strength, Strength { 2e3, 0.5 } })->excess, open.worst({ Strength { 2e3, 0.6 } })->excess, 1e-9);
	}

	TEST(PlaneSlip, IsSteeperThanTheAngleOfFriction)
	{
		// A slope of single steps of less than nine tenths of a cell has no face.
		Cut<2>        slope(0);
		PointCloud<2> left;
		for (const auto& x : slope.cloud.position)
			if (x[1] < 3 - 0.5 * std::max(0., x[0] - 2)) addPoint<2>(left, x, Vec<2>::Constant(0.125));
		slope.cloud = left;
		EXPECT_FALSE(slope.worst({ Strength { 0, 0.6 } }));
	}

} // namespace
} // namespace gimpm::testPlaneSlip
