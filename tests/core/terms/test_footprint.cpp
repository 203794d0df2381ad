// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes that a contact point presses on: common properties of functions of the cell and wider ones, and where soil
// ends.
#include "core/stepping/step_system.hpp"
#include "core/terms/contact/force_distribution.hpp"
#include "touched_soil.hpp"

namespace gimpm::testFootprint {
namespace {

	template <class T> using FootprintOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(FootprintOf, BothDimensions, DimensionName);

	/// Sum of the weights times a power of the distance from the place along an axis [cells].
	template <int Dim> double moment(const ForceDistribution<Dim>& f, const Vec<Dim>& place, int axis, int power)
	{
		double sum = 0;
		for (int n = 0; n < f.nodes; ++n)
			sum += f.weight[n] * std::pow(f.index(n)[axis] - place[axis] / TouchedSoil<Dim>::h, power);
		return sum;
	}

	/// Splines are one in sum, reproduce the place, and are as wide at a node as between two; a part of them is
	/// that much of it. The functions of the cell are not.
	TYPED_TEST(FootprintOf, SplinesAreAsWideEverywhere)
	{
		constexpr int         Dim = TypeParam::value;
		TouchedSoil<Dim>      scene(1000, 1e-10);
		const StepSystem<Dim> system(scene.cloud, scene.model, Load<Dim>(), scene.report);
		for (const double s : { 0., 0.03, 0.3, 0.49, 0.5, 0.62, 0.97, 1. })
			for (const double share : { 1., 0.25 }) {
				const Vec<Dim> place    = Vec<Dim>::Constant((1 + s) * TouchedSoil<Dim>::h);
				const auto     attached = attach(place, system.basis, scene.model.grid);
				ASSERT_TRUE(attached);
				Vec<Dim> shares = Vec<Dim>::Constant(share);
				shares[1]       = 0;
				const ForceDistribution<Dim> wide(*attached, shares, system.basis, scene.model.grid, 0);
				EXPECT_NEAR(moment(wide, place, 0, 0), 1, 1e-14);
				for (int a = 0; a < Dim; ++a) {
					EXPECT_NEAR(moment(wide, place, a, 1), 0, 1e-14);
					EXPECT_NEAR(moment(wide, place, a, 2), shares[a] / 4 + (1 - shares[a]) * s * (1 - s), 1e-14) << s;
				}
			}
	}

	/// Beyond the last node there is nothing to press on.
	TYPED_TEST(FootprintOf, WithoutNodesItIsThatOfTheCell)
	{
		constexpr int         Dim = TypeParam::value;
		TouchedSoil<Dim>      scene(1000, 1e-10);
		const StepSystem<Dim> system(scene.cloud, scene.model, Load<Dim>(), scene.report);
		const auto            attached = attach(Vec<Dim>(Vec<Dim>::Constant(2.8 * TouchedSoil<Dim>::h)), system.basis, scene.model.grid);
		ASSERT_TRUE(attached);
		const ForceDistribution<Dim> wide(*attached, Vec<Dim>::Ones(), system.basis, scene.model.grid, 0);
		EXPECT_EQ(wide.nodes, attached->nodes);
		for (int n = 0; n < attached->nodes; ++n) {
			EXPECT_EQ(wide.weight[n], attached->weight[n]);
			EXPECT_EQ(wide.node[n], attached->node[n]);
		}
	}

} // namespace
} // namespace gimpm::testFootprint
