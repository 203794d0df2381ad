// SPDX-License-Identifier: GPL-2.0-or-later
// Volumetric locking of a nearly incompressible cantilever in plane strain, and its cure by F-bar.
#include "scenes.hpp"

namespace gimpm::testLocking {
namespace {

	/// 8 m long, 1 m high, under a weight that bends it by some 1e-2 of its height; it lies across the grid lines
	/// along x.
	struct Cantilever {
		static constexpr double length = 8, height = 1, young = 1e6, weight = 0.5; // [m], [Pa], [N/m3]
		double                  poisson, h;
		Model<2>                model;
		PointCloud<2>           cloud;

		Cantilever(double poisson, int cells, bool fBar) : poisson(poisson), h(height / cells)
		{
			model.grid.cellSize = h;
			model.materials     = { { Hencky(young, poisson), weight } };
			model.fBar          = fBar;
			model.boundary      = Boundary<2>({ held<2>(model.grid, { -infinity, -infinity }, { 0, infinity }, "xy") });
			cloud               = block<2>(model.grid, { 8 * cells, cells }, 2);
			for (auto& x : cloud.position)
				x[1] += 0.37 * h;
		}
		/// Deflection of the tip over Timoshenko's.
		double tip()
		{
			LinearSolver solver;
			const auto   start  = cloud.position;
			const auto   report = loadStep(cloud, model, { { 0, -1 }, { 1, 1 } }, solver);
			EXPECT_TRUE(report.converged()) << report.cause;
			double sum   = 0;
			int    count = 0;
			for (std::size_t p = 0; p < start.size(); ++p)
				if (start[p][0] > length - 0.6 * h) sum += start[p][1] - cloud.position[p][1], ++count;
			const double planeModulus = young / (1 - poisson * poisson), G = young / (2 * (1 + poisson)), w = weight * height;
			const double bending = w * std::pow(length, 4) / (8 * planeModulus * std::pow(height, 3) / 12),
			             shear   = w * length * length / (2 * (5. / 6) * G * height);
			return sum / count / (bending + shear);
		}
		/// The largest jump of the mean stress between neighbours along the axis, a height away from the clamp,
		/// over the largest bending stress.
		double checkerboard() const
		{
			double jump = 0;
			for (std::size_t p = 0; p < cloud.size(); ++p)
				for (std::size_t q = 0; q < p; ++q) {
					const Vec<2> apart = (cloud.position[p] - cloud.position[q]).cwiseAbs();
					if (cloud.position[p][0] > height && apart[0] < 0.6 * h && apart[1] < 0.2 * h)
						jump = std::max(jump, std::abs(cloud.stress[p].full().trace() - cloud.stress[q].full().trace()) / 3);
				}
			return jump / (3 * weight * length * length / height);
		}
	};

	TEST(Locking, FBarUnlocksANearlyIncompressibleCantilever)
	{
		for (const double poisson : { 0.499, 0.49999 }) {
			const double four = Cantilever(poisson, 4, true).tip(), eight = Cantilever(poisson, 8, true).tip();
			EXPECT_NEAR(four, 1, 0.08) << poisson;
			EXPECT_NEAR(eight, 1, 0.05) << poisson;
		}
	}

	TEST(Locking, WithoutFBarItIsLocked)
	{
		EXPECT_LT(Cantilever(0.499, 4, false).tip(), 0.5);
		EXPECT_LT(Cantilever(0.49999, 4, false).tip(), 0.1);
		EXPECT_LT(Cantilever(0.49999, 8, false).tip(), 0.1);
	}

	TEST(Locking, ACompressibleCantileverBendsAsWithout)
	{
		const double plain = Cantilever(0.3, 8, false).tip(), withFBar = Cantilever(0.3, 8, true).tip();
		EXPECT_NEAR(withFBar, plain, 0.02);
	}

	TEST(Locking, PressuresOfNeighboursAreNoCheckerboard)
	{
		Cantilever plain(0.499, 8, false), withFBar(0.499, 8, true);
		plain.tip();
		withFBar.tip();
		EXPECT_LT(withFBar.checkerboard(), 0.05); // 0.019
		EXPECT_GT(plain.checkerboard(), 0.5);
	}

} // namespace
} // namespace gimpm::testLocking
