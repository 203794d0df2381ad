// SPDX-License-Identifier: GPL-2.0-or-later
// Soil in front of a contact point on a body: how far it is, and how much of it.
#include "core/terms/contact/contact_sight.hpp"
#include "scenes.hpp"

namespace gimpm::testContactSight {
namespace {

	constexpr double h = 0.4, spacing = h / 2, reach = h / 2;

	template <class T> using ContactSightOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(ContactSightOf, BothDimensions, DimensionName);

	/// Domains above y = gap, from x = -2 to the edge; what they fill of their spacing.
	template <int Dim> std::vector<SoilDomain<Dim>> soil(double gap, double edge = 2, double part = 1)
	{
		std::vector<SoilDomain<Dim>> domains;
		const int                    n = int(std::round(4 / spacing));
		forIndices<Dim>(cellsOf<Dim>(-n, 0, -n / 2), cellsOf<Dim>(n, 4, n), [&](const Index<Dim>& i) {
			Vec<Dim> x = spacing * (i.template cast<double>() + Vec<Dim>::Constant(0.5));
			x[0] += edge, x[1] += gap;
			if (x[0] > -2) domains.push_back({ x, Vec<Dim>::Constant(part * spacing / 2), 1e6, Vec<Dim>::Unit(1) });
		});
		return domains;
	}

	/// Along a surface whose places are h/4 apart, wherever among them the soil ends.
	TYPED_TEST(ContactSightOf, PresenceAddsUpToTheAreaThatIsCovered)
	{
		constexpr int  Dim = TypeParam::value;
		const Vec<Dim> up  = Vec<Dim>::Unit(1);
		for (int k = 0; k <= 20; ++k) {
			const double        edge = 0.5 + k * h / 4 / 20;
			const SoilNear<Dim> near(soil<Dim>(0.01, edge), h);
			double              covered = 0;
			for (int i = 0; i < 40; ++i)
				if (const auto sight = near.from((i + 0.5) * h / 4 * Vec<Dim>::Unit(0), up, reach)) {
					covered += sight->areaFraction * h / 4;
					EXPECT_NEAR(sight->gap, 0.01, 1e-12);
				}
			EXPECT_NEAR(covered, edge, 1e-12);
		}
	}

	/// Under a ball of 0.8 h that lies on even soil, or is a little above or in it: oblique contact points see the
	/// soil where their normal goes through its surface, not corners of domains beside that.
	TYPED_TEST(ContactSightOf, ObliquePointsOfASmallBallSeeEvenSoilWhereItIs)
	{
		constexpr int Dim    = TypeParam::value;
		const double  radius = 0.8 * h;
		int           seen   = 0;
		for (const double above : { 0., 0.05 * h, -0.1 * h })
			for (const double beside : { 0., 0.13 * h }) {
				auto     domains = soil<Dim>(0);
				Vec<Dim> centre  = beside * Vec<Dim>::Unit(0) - (radius + above) * Vec<Dim>::Unit(1);
				for (auto& domain : domains)
					domain.outward = (domain.centre - centre).normalized();
				const SoilNear<Dim> near(domains, h, true);
				for (int i = 0; i < 32 * 32; ++i) {
					const double a = (i % 32 + 0.5) / 32 * 2 * M_PI, b = (i / 32 + 0.5) / 32 * M_PI;
					Vec<Dim>     normal = Vec<Dim>::Zero();
					normal[0] = std::cos(a), normal[1] = std::sin(a);
					if constexpr (Dim == 3) normal *= std::sin(b), normal[2] = std::cos(b);
					if (normal[1] < 0.3) continue;
					const Vec<Dim> on    = centre + radius * normal;
					const auto     sight = near.from(on, normal, reach);
					if (!sight || sight->areaFraction <= 1e-9) continue;
					EXPECT_NEAR(sight->gap, -on[1] / normal[1], 0.05 * h) << normal.transpose();
					++seen;
				}
			}
		EXPECT_GT(seen, 100);
	}

	TYPED_TEST(ContactSightOf, TheGapIsThatOfTheClosestDomainInFront)
	{
		constexpr int  Dim = TypeParam::value;
		const Vec<Dim> up  = Vec<Dim>::Unit(1);
		for (const double gap : { -0.05, 0., 0.1, 0.19 }) {
			const auto sight = SoilNear<Dim>(soil<Dim>(gap), h).from(0.03 * Vec<Dim>::Ones() - 0.03 * up, up, reach);
			ASSERT_TRUE(sight);
			EXPECT_NEAR(sight->gap, gap, 1e-12);
			EXPECT_EQ(sight->areaFraction, 1);
			EXPECT_NEAR(sight->young, 1e6, 1e-6);
		}
		EXPECT_FALSE(SoilNear<Dim>(soil<Dim>(1.01 * reach), h).from(Vec<Dim>::Zero(), up, reach));
		EXPECT_FALSE(SoilNear<Dim>(soil<Dim>(0), h).from(Vec<Dim>::Zero(), -up, reach)) << "it is behind the place";
		EXPECT_FALSE(SoilNear<Dim>({}, h).from(Vec<Dim>::Zero(), up, reach));
	}

	/// Domains that have been stretched along the normal are thinner across it.
	TYPED_TEST(ContactSightOf, SoilIsFoundThroughGapsBetweenDomains)
	{
		constexpr int  Dim = TypeParam::value;
		const Vec<Dim> up  = Vec<Dim>::Unit(1);
		for (const double part : { 0.9, 0.7 }) {
			const SoilNear<Dim> near(soil<Dim>(0, 2, part), h);
			for (int k = 0; k < 10; ++k) {
				const auto sight = near.from((-0.2 + 0.02 * k) * Vec<Dim>::Unit(0), up, reach);
				ASSERT_TRUE(sight);
				EXPECT_NEAR(sight->gap, (1 - part) * spacing / 2, 1e-12) << "not that of the row behind";
				EXPECT_GT(sight->areaFraction, Dim == 2 ? 0.4 : 0.15);
			}
		}
	}

	/// Beside an edge the closest side of the body is another one, behind a thin body the opposite one.
	TYPED_TEST(ContactSightOf, SoilOfAnotherSideDoesNotCount)
	{
		constexpr int  Dim = TypeParam::value;
		const Vec<Dim> up  = Vec<Dim>::Unit(1);
		for (const Vec<Dim>& outward : { Vec<Dim>(Vec<Dim>::Unit(0)), Vec<Dim>(-up) }) {
			auto domains = soil<Dim>(0);
			for (auto& d : domains)
				d.outward = outward;
			EXPECT_FALSE(SoilNear<Dim>(domains, h).from(Vec<Dim>::Zero(), up, reach));
		}
	}

	/// The mean over what is seen, by volume.
	TYPED_TEST(ContactSightOf, TheModulusIsThatOfWhatIsSeen)
	{
		constexpr int Dim     = TypeParam::value;
		auto          domains = soil<Dim>(0);
		for (auto& d : domains)
			d.young = d.centre[0] < 0 ? 1e6 : 3e6;
		const SoilNear<Dim> near(domains, h);
		for (const auto& [x, young] : { std::pair(-0.3, 1e6), std::pair(0., 2e6), std::pair(0.05, 2.5e6), std::pair(0.3, 3e6) }) {
			const auto sight = near.from(x * Vec<Dim>::Unit(0), Vec<Dim>::Unit(1), reach);
			ASSERT_TRUE(sight);
			EXPECT_NEAR(sight->young, young, 1e-3);
		}
	}

} // namespace
} // namespace gimpm::testContactSight
