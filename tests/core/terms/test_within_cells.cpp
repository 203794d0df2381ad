// SPDX-License-Identifier: GPL-2.0-or-later
// Pressures of points that F-bar leaves apart within cells: what is taken out of them, and what stays.
#include "core/stepping/step_system.hpp"
#include "core/terms/points/pressure_filter.hpp"
#include "scenes.hpp"

namespace gimpm::testWithinCells {
namespace {

	/// Random overlapping domains of three materials with mean stresses of their own.
	template <int Dim> struct Scene {
		Random          random { 5 };
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		StepReport      report;

		Scene()
		{
			model.grid      = { 0.7, random.matrix<Dim>() };
			model.materials = { { Hencky(3e3, 0.3), 10 }, { VonMises(1e3, 0.45, 50), 20 }, { MohrCoulomb(2e3, 0.3, 10, 0.5, 0.1), 20 } };
			model.fBar      = true;
			for (int i = 0; i < (Dim == 2 ? 90 : 300); ++i) { // more than cells
				addPoint<Dim>(
				        cloud, random.matrix<Dim>(Dim == 2 ? 1.5 : 0.6), 0.35 * Vec<Dim>::NullaryExpr([&]() { return random.in(0.1, 1); }),
				        i % 3);
				setMeanStrain(i, random.in(-0.1, 0.1));
			}
		}
		double bulk(int p) const { return std::array { 3e3 / (3 * 0.4), 1e3 / (3 * 0.1), 2e3 / (3 * 0.4) }[cloud.material[p]]; }
		double mean(int p) const { return bulk(p) * cloud.elasticStrain[p].full().trace(); }
		/// And the stress that goes with it.
		void setMeanStrain(int p, double strain)
		{
			cloud.elasticStrain[p] = SymTensor<Dim>::from(Mat3(strain / 3 * Mat3::Identity()));
			cloud.stress[p]        = SymTensor<Dim>::from(Mat3(bulk(p) * strain / cloud.volumeRatio(p) * Mat3::Identity()));
		}
		/// After a step in which points have moved by so many cells.
		PointCloud<Dim> relaxed(double cells) const
		{
			PointCloud<Dim> after = cloud;
			for (auto& x : after.position)
				x[0] += cells * model.grid.cellSize;
			StepReport            none;
			const StepSystem<Dim> system(cloud, model, {}, none);
			relaxPressures(after, cloud, model.materials, system.basis, model.grid, *model.division);
			return after;
		}
		Eigen::VectorXd forces() const
		{
			StepReport            none;
			const StepSystem<Dim> system(cloud, model, {}, none);
			Eigen::VectorXd       force = Eigen::VectorXd::Zero(system.nodalSize());
			EXPECT_FALSE(system.terms[0]->add(Eigen::VectorXd::Zero(system.nodalSize()), { force }));
			return force;
		}
		double energy(int material) const
		{
			double sum = 0;
			for (std::size_t p = 0; p < cloud.size(); ++p)
				if (cloud.material[p] == material) sum += cloud.volume0[p] * mean(int(p)) * mean(int(p)) / (2 * bulk(int(p)));
			return sum;
		}
		double sum(int material) const
		{
			double all = 0;
			for (std::size_t p = 0; p < cloud.size(); ++p)
				if (cloud.material[p] == material) all += cloud.volume0[p] * mean(int(p));
			return all;
		}
	};

	template <class Dimension> using WithinCells = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(WithinCells, BothDimensions, DimensionName);

	TYPED_TEST(WithinCells, SumsStayAndEnergyIsLost)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    before, after;
		const auto    start = before.cloud;
		for (const double cells : { 0.1, 1. }) {
			after.cloud          = before.relaxed(cells);
			after.cloud.position = start.position;
			for (const int m : { 0, 1 }) {
				EXPECT_NEAR(after.sum(m), before.sum(m), 1e-10 * before.energy(m));
				EXPECT_LT(after.energy(m), before.energy(m) * (1 - 1e-3));
			}
			for (std::size_t p = 0; p < start.size(); ++p) { // those of the frictional law are as they were, and no stress is apart from its strain
				if (start.material[p] == 2) {
					EXPECT_EQ(after.cloud.elasticStrain[p].c, start.elasticStrain[p].c);
				}
				EXPECT_NEAR(
				        after.cloud.stress[p].full().trace() / 3 * after.cloud.volumeRatio(p), after.mean(int(p)), 1e-9 * after.bulk(int(p)));
			}
		}
	}

	/// Domains lie in one cell each, where the formula of the forces is exact.
	TYPED_TEST(WithinCells, ForcesStayAndPointsOfACellAreOne)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene;
		auto&         cloud = scene.cloud;
		const double  h     = scene.model.grid.cellSize;
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			cloud.material[p]     = 1;
			const Vec<Dim> cell   = ((cloud.position[p] - scene.model.grid.origin) / h).array().floor();
			const auto     inCell = Vec<Dim>::NullaryExpr([&]() { return scene.random.in(0.3, 0.7); });
			cloud.position[p]     = scene.model.grid.origin + h * (cell + Vec<Dim>(inCell));
			cloud.halfSize[p]     = Vec<Dim>::Constant(0.1 * h);
			scene.setMeanStrain(int(p), scene.random.in(-1e-9, 1e-9)); // so small that their products do not count
		}
		Scene<Dim> after     = scene;
		after.cloud          = scene.relaxed(1);
		after.cloud.position = cloud.position;
		const auto force     = scene.forces();
		EXPECT_LT((after.forces() - force).norm(), 1e-7 * force.norm());
		const auto cellOf = [&](std::size_t p) { return ((cloud.position[p] - scene.model.grid.origin) / h).array().floor().eval(); };
		int        pairs  = 0;
		for (std::size_t p = 0; p < cloud.size(); ++p)
			for (std::size_t q = 0; q < p; ++q)
				if ((cellOf(p) == cellOf(q)).all()) {
					EXPECT_NEAR(after.mean(int(p)), after.mean(int(q)), 1e-8 * after.bulk(0) * 1e-9);
					++pairs;
				}
		EXPECT_GT(pairs, 5);
	}

	/// Second filter changes nothing more, and a body at rest keeps all.
	TYPED_TEST(WithinCells, TwiceIsOnceAndAtRestNothing)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene;
		const auto    still = scene.relaxed(0);
		for (std::size_t p = 0; p < still.size(); ++p)
			EXPECT_EQ(still.elasticStrain[p].c, scene.cloud.elasticStrain[p].c);
		Scene<Dim> once     = scene;
		once.cloud          = scene.relaxed(1);
		once.cloud.position = scene.cloud.position;
		const auto twice    = once.relaxed(1);
		double     change = 0, all = 0;
		for (std::size_t p = 0; p < twice.size(); ++p) {
			change += (twice.elasticStrain[p].c - once.cloud.elasticStrain[p].c).squaredNorm();
			all += (once.cloud.elasticStrain[p].c - scene.cloud.elasticStrain[p].c).squaredNorm();
		}
		EXPECT_LT(change, 1e-6 * all);
	}

	/// Also that of water in soil whose law is left alone.
	TYPED_TEST(WithinCells, WaterThatCannotLeave)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene;
		scene.model.materials[2].waterModulus = 1e5;
		auto&  pressure                       = scene.cloud.excessPressure;
		double before = 0, after = 0, squares = 0, left = 0;
		for (std::size_t p = 0; p < scene.cloud.size(); ++p) {
			pressure.push_back(scene.cloud.material[p] == 2 ? scene.random.in(0, 1e3) : 0);
			before += scene.cloud.volume0[p] * pressure[p], squares += scene.cloud.volume0[p] * pressure[p] * pressure[p];
		}
		const auto relaxed = scene.relaxed(1);
		for (std::size_t p = 0; p < relaxed.size(); ++p) {
			after += relaxed.volume0[p] * relaxed.excessPressure[p], left += relaxed.volume0[p] * std::pow(relaxed.excessPressure[p], 2);
			if (scene.cloud.material[p] != 2) {
				EXPECT_EQ(relaxed.excessPressure[p], 0);
			}
		}
		EXPECT_NEAR(after, before, 1e-10 * before);
		EXPECT_LT(left, 0.999 * squares);
	}

} // namespace
} // namespace gimpm::testWithinCells
