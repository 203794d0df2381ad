// SPDX-License-Identifier: GPL-2.0-or-later
// A grid whose opposite sides are the same nodes.
#include "core/stepping/restraint.hpp"
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"
#include <algorithm>
#include <map>

namespace gimpm::testPeriodic {
namespace {

	template <class Dimension> using Periodic = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Periodic, BothDimensions, DimensionName);

	template <int Dim> Grid<Dim> gridOf(int cells, double h = 1)
	{
		Grid<Dim> grid { h };
		grid.period.setConstant(cells);
		grid.period[1] = 0;
		return grid;
	}

	/// All below a level held in all directions.
	template <int Dim> ConstrainedBox<Dim> base(const Grid<Dim>& grid)
	{
		Vec<Dim> max = Vec<Dim>::Constant(infinity);
		max[1]       = 0;
		return held<Dim>(grid, Vec<Dim>::Constant(-infinity), max, Dim == 2 ? "xy" : "xyz");
	}

	/// Into the period, as an engine does after a step.
	template <int Dim> void reenter(PointCloud<Dim>& cloud, const Grid<Dim>& grid)
	{
		for (auto& x : cloud.position)
			for (int a = 0; a < Dim; ++a)
				if (const double length = grid.period[a] * grid.cellSize; length > 0)
					x[a] -= length * std::floor((x[a] - grid.origin[a]) / length);
	}

	// Points that lie around the sides, taken as they are on a grid that goes on for ever, and then nodes with
	// their images put together.
	template <int Dim> void expectSameStiffness(int period, const Material& material)
	{
		Model<Dim> endless;
		endless.materials    = { material };
		endless.ghost.factor = 0;
		auto   cloud         = block<Dim>(endless.grid, Index<Dim>::Constant(period), 2);
		Random random(7);
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			cloud.position[p] += Vec<Dim>::Constant(0.3);
			cloud.elasticStrain[p] = SymTensor<Dim>::from(Mat3((Vec3(-2e-3, -3e-3, -1e-3) + random.matrix<3>(1e-3)).asDiagonal()));
		}
		StepReport            report;
		const StepSystem<Dim> whole(cloud, endless, {}, report);
		NodeMatrix<Dim>       K;
		Eigen::VectorXd       force, forceOfPeriod;
		whole.prepare(K);
		whole.evaluate(Eigen::VectorXd::Zero(whole.nodalSize()), force, &K);

		Model<Dim> model = endless;
		model.grid       = gridOf<Dim>(period);
		reenter<Dim>(cloud, model.grid);
		const StepSystem<Dim> system(cloud, model, {}, report);
		system.evaluate(Eigen::VectorXd::Zero(system.nodalSize()), forceOfPeriod, nullptr);
		ASSERT_EQ(system.basis.nodes.size(), std::pow(period, Dim - 1) * (period + 2));
		Eigen::MatrixXd toPeriod = Eigen::MatrixXd::Zero(system.nodalSize(), whole.nodalSize());
		for (std::size_t n = 0; n < whole.basis.nodes.size(); ++n) {
			const int m = position(system.basis.nodes, model.grid.first(whole.basis.nodes[n]));
			toPeriod.template block<Dim, Dim>(Dim * m, Dim * n).setIdentity();
		}
		const Eigen::MatrixXd expected = toPeriod * dense(K) * toPeriod.transpose(), found = dense(tangentStiffness(system.cloud, system.model));
		EXPECT_LT((found - expected).norm(), 1e-14 * expected.norm()) << period << " cells";
		EXPECT_LT((forceOfPeriod - toPeriod * force).norm(), 1e-13 * force.norm());
	}

	TYPED_TEST(Periodic, StiffnessIsThatOfTheEndlessGridPutTogether)
	{
		for (const int period : { 3, 4, 5, 9, 12 }) {
			if (TypeParam::value == 3 && period > 5) continue;
			expectSameStiffness<TypeParam::value>(period, { VonMises(1e6, 0.3, 3e3), 1 });
			expectSameStiffness<TypeParam::value>(period, { MohrCoulomb(1e6, 0.3, 1e2, 0.5, 0.1), 1 });
		}
	}

	// No two ranges of a colour share a node: the sum would depend on the threads.
	TEST(Periodic, TilesOfAColourShareNoNode)
	{
		for (const int period : { 3, 4, 5, 8, 9, 12, 13, 16, 17, 20, 21 }) {
			Grid<2> grid { 1 };
			grid.period.setConstant(period);
			auto cloud = block<2>(grid, Index<2>::Constant(period), 2);
			for (auto& x : cloud.position)
				x += Vec<2>::Constant(0.3);
			reenter<2>(cloud, grid);
			const auto basis = cloudBasis<2>(cloud, grid, Basis::gimp, Boundary<2>());
			EXPECT_EQ(basis.nodes.size(), period * period);
			std::size_t points = 0;
			for (const auto& colour : basis.colours) {
				std::map<int, int> range;
				for (int r = 0; r < int(colour.size()); ++r)
					for (int p = colour[r].first; p < colour[r].second; ++p) {
						points += basis.patches[p].count;
						for (const int node : basis.patches[p].node)
							if (node >= 0) {
								EXPECT_EQ(range.try_emplace(node, r).first->second, r) << "period " << period;
							}
					}
			}
			EXPECT_EQ(points, cloud.size());
		}
	}

	/// A heap on a layer that goes on for ever, of a material that yields, shifted by whole cells.
	template <int Dim> PointCloud<Dim> heap(int period, int shift)
	{
		Model<Dim> model;
		model.grid             = gridOf<Dim>(period, 0.5);
		model.materials        = { { VonMises(1e6, 0.3, 1.2e4), 2e3 } };
		model.newton.tolerance = 1e-12;
		model.boundary         = Boundary<Dim>({ base<Dim>(model.grid) });
		PointCloud<Dim> cloud;
		const auto      all = block<Dim>(model.grid, cellsOf<Dim>(period, 3, period), 2);
		for (std::size_t p = 0; p < all.size(); ++p) {
			auto x = all.position[p];
			if (x[1] > 0.5 && (x[0] > 1.25 || (Dim == 3 && x[Dim - 1] > 0.75))) continue;
			x[0] += 0.5 * shift;
			if (Dim == 3) x[Dim - 1] += 0.5 * shift;
			addPoint<Dim>(cloud, x, all.halfSize[p]);
		}
		Load<Dim>    load;
		LinearSolver solver;
		load.gravity = -15 * Vec<Dim>::Unit(1) + 4 * Vec<Dim>::Unit(0);
		for (int i = 1; i <= 4; ++i) {
			reenter<Dim>(cloud, model.grid);
			load.factor       = { i / 4., 0.25 };
			const auto report = loadStep(cloud, model, load, solver);
			EXPECT_TRUE(report.converged()) << report.cause;
		}
		return cloud;
	}

	TYPED_TEST(Periodic, ResultsDoNotDependOnThePlaceOfTheSides)
	{
		constexpr int Dim      = TypeParam::value;
		const int     period   = Dim == 2 ? 7 : 5;
		const auto    expected = heap<Dim>(period, 0);
		const auto    flow     = plasticStrains(expected);
		EXPECT_GT(*std::max_element(flow.begin(), flow.end()), 1e-3);
		for (int shift = 1; shift < period; shift += Dim - 1) {
			const auto found = heap<Dim>(period, shift);
			for (std::size_t p = 0; p < expected.size(); ++p) {
				EXPECT_LT((found.stress[p].c - expected.stress[p].c).norm(), 1e-4) << "shift " << shift << ", point " << p;
				EXPECT_LT((found.defGrad[p] - expected.defGrad[p]).norm(), 1e-10) << "shift " << shift << ", point " << p;
			}
		}
	}

	// Stress in a layer on a slope: sigma_yy = rho g_y (H - y), sigma_xy = -rho g_x (H - y), the means over a cell
	// being those in its middle. The place of the points along the slope is of no importance.
	TYPED_TEST(Periodic, InfiniteSlope)
	{
		constexpr int Dim = TypeParam::value;
		for (const double shift : { 0., 0.13, 0.77 }) {
			Model<Dim> model;
			model.grid             = gridOf<Dim>(3, 0.5);
			model.materials        = { { Hencky(1e9, 0.3), 2e3 } };
			model.ghost.factor     = 0; // it lets the stress jump beside the surface
			model.newton.tolerance = 1e-12;
			model.boundary         = Boundary<Dim>({ base<Dim>(model.grid) });
			auto cloud             = block<Dim>(model.grid, cellsOf<Dim>(3, 8, 3), 2);
			for (auto& x : cloud.position)
				x[0] += shift;
			reenter<Dim>(cloud, model.grid);
			Load<Dim> load;
			load.gravity = -10 * std::cos(0.4) * Vec<Dim>::Unit(1) + 10 * std::sin(0.4) * Vec<Dim>::Unit(0);
			load.factor  = { 1e-4, 1e-4 }; // small strains
			LinearSolver solver;
			const auto   y      = cloud.position;
			const auto   report = loadStep(cloud, model, load, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
			std::map<int, std::pair<double, Mat3>> mean;
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				auto& [count, sum] = mean.try_emplace(int(y[p][1] / 0.5), 0, Mat3::Zero()).first->second;
				++count, sum += cloud.stress[p].full();
			}
			ASSERT_EQ(mean.size(), 8u);
			for (const auto& [cell, m] : mean) {
				const double depth = 4 - 0.5 * (cell + 0.5), weight = 1e-4 * 2e3 * 10 * depth;
				const Mat3   s = m.second / m.first;
				EXPECT_NEAR(s(1, 1), -weight * std::cos(0.4), 1e-6 * weight) << "shift " << shift;
				EXPECT_NEAR(s(0, 1), weight * std::sin(0.4), 1e-6 * weight) << "shift " << shift;
				EXPECT_NEAR(s(0, 0), -0.3 / 0.7 * weight * std::cos(0.4), 1e-6 * weight) << "shift " << shift;
			}
		}
	}

	/// Simple shear of a layer under a normal stress, well beyond failure; the ratio of shear to normal stress,
	/// which must be the same at all points.
	double shearRatio(double friction, double dilation)
	{
		constexpr double h = 0.5, normal = 1e5;
		Model<2>         model;
		model.grid             = gridOf<2>(3, h);
		model.materials        = { { MohrCoulomb(1e12, 0.3, 0, friction, dilation), 0 } };
		model.newton.tolerance = 1e-10;
		const Vec<2> top(infinity, 4 * h);
		model.boundary  = Boundary<2>({ base<2>(model.grid), held<2>(model.grid, { -infinity, 4 * h }, top, "x", { 4e-6, 0 }) });
		auto cloud      = block<2>(model.grid, { 3, 4 }, 2);
		cloud.position0 = cloud.position;
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			const double y = cloud.position[p][1] - 3 * h;
			// forces on the two rows of points below the surface that amount to forces on the nodes of the
			// surface
			cloud.force.push_back(y < 0 ? Vec<2>::Zero() : Vec<2>(0, -normal * h / 2 * (y > h / 2 ? 1.5 : -0.5)));
		}
		LinearSolver solver;
		const int    steps = 80, loading = 20;
		for (int i = 1; i <= steps; ++i) {
			// loads have their full size before the shearing begins
			for (auto& f : cloud.force)
				if (i <= loading) f *= i == 1 ? 1. / loading : double(i) / (i - 1);
			Load<2> load;
			load.factor       = { 1, i <= loading ? 0 : 1. / (steps - loading) };
			const auto report = loadStep(cloud, model, load, solver);
			EXPECT_TRUE(report.converged()) << report.cause << ", step " << i;
		}
		double low = infinity, high = 0;
		for (const auto& s : cloud.stress) {
			low  = std::min(low, -s.c[2] / s.c[1]);
			high = std::max(high, -s.c[2] / s.c[1]);
		}
		EXPECT_LT(high - low, 1e-5); // dilation lifts the points a little
		return high;
	}

	// Davis: sin phi cos psi / (1 - sin phi sin psi), which is reached in the end.
	TEST(Periodic, SimpleShearFailsAtDavisRatio)
	{
		const double degree = std::acos(-1) / 180;
		EXPECT_NEAR(shearRatio(30 * degree, 30 * degree), 0.57735, 5e-5);
		EXPECT_NEAR(shearRatio(30 * degree, 15 * degree), 0.55475, 5e-5);
		EXPECT_NEAR(shearRatio(30 * degree, 0), 0.5, 5e-5);
	}

	// Compression of a layer between plates, in domains of many sizes that lie across the sides: a uniform stress.
	TYPED_TEST(Periodic, PatchTestAcrossTheSides)
	{
		constexpr int Dim = TypeParam::value;
		for (unsigned seed = 1; seed <= 4; ++seed) {
			Random     random(seed);
			Model<Dim> model;
			model.grid             = gridOf<Dim>(4);
			model.materials        = { { Hencky(1e6, 0.3), 1 } };
			model.ghost            = { 0.1 };
			model.newton.tolerance = 1e-13;
			Vec<Dim> min           = Vec<Dim>::Constant(-infinity);
			min[1]                 = 4;
			const Vec<Dim> all     = Vec<Dim>::Constant(infinity);
			const auto     plate   = held<Dim>(model.grid, min, all, Dim == 2 ? "xy" : "xyz", -0.8 * Vec<Dim>::Unit(1));
			model.boundary         = Boundary<Dim>({ base<Dim>(model.grid), plate });
			std::vector<double> ends { random.in(0, 0.9) };
			while (ends.back() < ends[0] + 4)
				ends.push_back(std::min(ends.back() + random.in(0.2, 1), ends[0] + 4));
			PointCloud<Dim> cloud;
			const int       n = int(ends.size()) - 1;
			forIndices<Dim>(Index<Dim>::Zero(), cellsOf<Dim>(n, 8, n), [&](const Index<Dim>& i) {
				Vec<Dim> x, l;
				for (int a = 0; a < Dim; a += 2)
					x[a] = (ends[i[a] + 1] + ends[i[a]]) / 2, l[a] = (ends[i[a] + 1] - ends[i[a]]) / 2;
				x[1] = 0.25 + 0.5 * i[1], l[1] = 0.25;
				addPoint<Dim>(cloud, x, l);
			});
			reenter<Dim>(cloud, model.grid);
			cloud.position0 = cloud.position;
			LinearSolver solver;
			const auto   report = loadStep(cloud, model, { Vec<Dim>::Zero(), { 1, 1 } }, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
			const double e = std::log(0.8), lambda = 1e6 * 0.3 / (1.3 * 0.4);
			Mat3         stress = Mat3::Identity() * lambda * e / 0.8;
			stress(1, 1)        = (lambda + 1e6 / 1.3) * e / 0.8;
			for (std::size_t p = 0; p < cloud.size(); ++p)
				EXPECT_LT((cloud.stress[p].full() - stress).norm(), 1e-10 * stress.norm()) << "point " << p << ", seed " << seed;
		}
	}

	// A strip that meets its own image cannot turn, one beside it can.
	TEST(Periodic, WhatGoesAroundTheGridCannotTurn)
	{
		const Grid<2> grid   = gridOf<2>(4);
		const auto    motion = [&](int cells, double from, const std::string& fix) {
                        auto cloud = block<2>(grid, { cells, 2 }, 2);
                        for (auto& x : cloud.position)
                                x[0] += from;
                        reenter<2>(cloud, grid);
                        const double      node = std::fmod(from, 4);
                        const Boundary<2> boundary({ held<2>(grid, { node, 0 }, { node, 0 }, fix) });
                        return restraint<2>(cloudBasis<2>(cloud, grid, Basis::gimp, boundary), grid, boundary).freeMotion;
		};
		EXPECT_EQ(motion(4, 1, "xy"), "");
		EXPECT_EQ(motion(4, 1, "y").substr(0, 19), "translation along x");
		EXPECT_EQ(motion(2, 1, "xy").substr(0, 8), "rotation");
		EXPECT_EQ(motion(2, 3, "xy"), "rotation of the material around (0, 1)");
	}

	// A tube along x turns about its own axis as before, but about no other.
	TEST(Periodic, WhatGoesAroundAlongOneAxisTurnsAboutIt)
	{
		Grid<3> grid { 1 };
		grid.period[0]    = 4;
		const auto cloud  = block<3>(grid, { 4, 2, 2 }, 2);
		const auto motion = [&](const std::string& fix, double z) {
			const Boundary<3> boundary({ held<3>(grid, { 0, 0, 0 }, { 0, 0, 0 }, "xyz"), held<3>(grid, { 2, 0, z }, { 2, 0, z }, fix) });
			return restraint<3>(cloudBasis<3>(cloud, grid, Basis::gimp, boundary), grid, boundary).freeMotion.substr(0, 8);
		};
		EXPECT_EQ(motion("y", 0), "rotation");
		EXPECT_EQ(motion("y", 2), "");
	}

	TEST(Periodic, BoxesActOnNodesAndTheirImages)
	{
		const Grid<2> grid = gridOf<2>(6);
		const auto    left = held<2>(grid, { -infinity, -infinity }, { 0, infinity }, "x"),
		           right   = held<2>(grid, { 6, -infinity }, { infinity, infinity }, "x");
		for (const auto& box : { left, right })
			for (int node = -8; node < 14; ++node)
				EXPECT_EQ(box.constrains({ node, 3 }, 0), node % 6 == 0) << node;
		EXPECT_TRUE(left.meets(right));
		EXPECT_FALSE(held<2>(grid, { 1, 0 }, { 5, 1 }, "x").meets(right));
		EXPECT_TRUE(held<2>(grid, { 6.5, 0 }, { 9, 1 }, "x").empty()) << "beyond the sides";
		const Boundary<2> boundary({ right });
		EXPECT_TRUE(boundary.lowerFaceIsWall({ 0, 1 }, 0));
		EXPECT_TRUE(boundary.lowerFaceIsWall({ 6, 1 }, 0));
		EXPECT_FALSE(boundary.lowerFaceIsWall({ 1, 1 }, 0));
	}

} // namespace
} // namespace gimpm::testPeriodic
