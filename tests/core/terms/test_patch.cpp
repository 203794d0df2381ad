// SPDX-License-Identifier: GPL-2.0-or-later
// Patch test: a uniform stress state is found to round-off wherever the points and the free surface lie in their cells.
#include "scenes.hpp"

namespace gimpm {
namespace {

	/// Ends of domains along one axis from 0 to length: random ones of at most a cell, and what makes points and
	/// domains meet cell edges.
	std::vector<double> cuts(double length, Random& random)
	{
		std::vector<double> at { 0 };
		while (at.back() < length) {
			const double next[] = { at.back() + random.in(0.2, 1), std::floor(at.back()) + 1, 2 * (std::floor(at.back()) + 1) - at.back() };
			const double end    = next[random.integer(0, 2)];
			at.push_back(end - at.back() <= 1 ? std::min(end, length) : std::min(at.back() + 1, length));
		}
		return at;
	}

	/// Box domains that fill a body without gaps.
	template <int Dim> PointCloud<Dim> tiling(const Vec<Dim>& size, unsigned seed)
	{
		Random              random(seed);
		std::vector<double> at[3] = { { 0, 1 }, { 0, 1 }, { 0, 1 } };
		Index<Dim>          count;
		for (int a = 0; a < Dim; ++a)
			at[a] = cuts(size[a], random), count[a] = int(at[a].size()) - 1;
		PointCloud<Dim> cloud;
		forIndices<Dim>(Index<Dim>::Zero(), count, [&](const Index<Dim>& i) {
			Vec<Dim> x, l;
			for (int a = 0; a < Dim; ++a)
				x[a] = (at[a][i[a] + 1] + at[a][i[a]]) / 2, l[a] = (at[a][i[a] + 1] - at[a][i[a]]) / 2;
			addPoint<Dim>(cloud, x, l);
		});
		return cloud;
	}

	template <class Dimension> using PatchTest = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(PatchTest, BothDimensions, DimensionName);

	/// A bar of 4 cells between a roller and a moving grip, on rollers below, with free surfaces across: uniaxial
	/// stress in finite strain.
	///   stretch lambda along x, e_x = log lambda; free surfaces: e_y = e_z = -nu e_x and tau_xx = E e_x in 3D,
	///   e_y = -nu/(1-nu) e_x, tau_xx = E/(1-nu^2) e_x and tau_zz = nu tau_xx in plane strain.
	template <int Dim> void expectUniaxialStress(double lambda, unsigned seed, const Vec<Dim>& size, bool fBar)
	{
		const double young = 1e6, nu = 0.3;
		Model<Dim>   model;
		model.materials        = { { Hencky(young, nu), 1 } };
		model.fBar             = fBar;
		model.ghost            = { seed % 3 == 2 && !fBar ? 0 : 0.1 };
		model.newton.tolerance = 1e-13;
		Vec<Dim> min           = Vec<Dim>::Constant(-infinity);
		min[0]                 = 4;
		std::vector<ConstrainedBox<Dim>> boxes { held<Dim>(model.grid, min, Vec<Dim>::Constant(infinity), "x", 4 * (lambda - 1) * Vec<Dim>::Unit(0)) };
		for (int axis = 0; axis < Dim; ++axis)
			boxes.push_back(wallBelow<Dim>(model.grid, axis, 0));
		model.boundary = Boundary<Dim>(boxes);

		auto         cloud = tiling<Dim>(size, seed);
		const auto   start = cloud.position;
		LinearSolver solver;
		const auto   report = loadStep(cloud, model, {}, solver);
		ASSERT_TRUE(report.converged()) << report.cause;

		const double ex = std::log1p(lambda - 1), across = Dim == 3 ? -nu * ex : -nu / (1 - nu) * ex;
		Vec3         strain(ex, across, Dim == 3 ? across : 0);
		const double tau = Dim == 3 ? young * ex : young / (1 - nu * nu) * ex, J = std::exp(strain.sum());
		const Mat3   stress = Vec3(tau, 0, Dim == 3 ? 0 : nu * tau).asDiagonal().toDenseMatrix() / J;
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			EXPECT_LT((cloud.elasticStrain[p].full() - Mat3(strain.asDiagonal())).norm(), 1e-11 * std::abs(ex))
			        << "point " << p << ", seed " << seed;
			EXPECT_LT((cloud.stress[p].full() - stress).norm(), 1e-11 * stress.norm()) << "point " << p << ", seed " << seed;
			const Vec<Dim> x = strain.head<Dim>().array().exp() * start[p].array();
			EXPECT_LT((cloud.position[p] - x).norm(), 1e-12) << "point " << p << ", seed " << seed;
		}
	}

	TYPED_TEST(PatchTest, UniaxialStress)
	{
		constexpr int Dim = TypeParam::value;
		for (const double lambda : { 1.25, 0.8, 1 + 1e-9 })
			for (unsigned seed = 1; seed <= 6; ++seed) {
				Vec<Dim> size = Vec<Dim>::Constant(1.62);
				size[0] = 4, size[1] = seed == 1 ? 2 : 2.37; // the free surface on a cell edge once
				expectUniaxialStress<Dim>(lambda, seed, size, false);
			}
	}

	// Balance of forces with F-bar: the centres are those of the matter in the cells.
	TYPED_TEST(PatchTest, UniaxialStressWithFBar)
	{
		constexpr int Dim = TypeParam::value;
		for (const double lambda : { 1.25, 0.8, 1 + 1e-9 })
			for (unsigned seed = 1; seed <= 6; ++seed) {
				Vec<Dim> size = Vec<Dim>::Constant(1.62);
				size[0] = 4, size[1] = seed == 1 ? 2 : 2.37;
				expectUniaxialStress<Dim>(lambda, seed, size, true);
			}
	}

} // namespace
} // namespace gimpm
