// SPDX-License-Identifier: GPL-2.0-or-later
// Divergence correction: added motion of points so that all volumes in a cell change alike.
#include "core/stepping/acceptance.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/points/divergence_correction.hpp"
#include "core/terms/points/point_update.hpp"
#include "scenes.hpp"

namespace gimpm::testEvenDilation {
namespace {

	enum class Shape { plane, ring, ringAtAxis, space };

	/// Points in one cell whose nodes move at random; those nearly without extent tell the field at a place.
	template <int Dim> struct Scene {
		static constexpr double h = 0.7, small = 1e-5 * h, step = 1e-3;
		Random                  random { 11 };
		Model<Dim>              model;
		PointCloud<Dim>         cloud;
		Shape                   shape;

		explicit Scene(Shape s) : shape(s)
		{
			model.grid               = { h, Vec<Dim>::Zero() };
			model.grid.axisymmetric  = isRing();
			model.materials          = { { Hencky(3e3, 0.3), 10 } };
			model.fBar               = true;
			model.pressureRelaxation = true;
		}
		bool     isRing() const { return shape == Shape::ring || shape == Shape::ringAtAxis; }
		Vec<Dim> place(const Vec<Dim>& inCell) const
		{
			Vec<Dim> cell = Vec<Dim>::Constant(2);
			if (shape == Shape::ringAtAxis) cell[0] = 0;
			return h * (cell + inCell);
		}
		void add(const Vec<Dim>& inCell, double half = small)
		{
			addPoint<Dim>(cloud, place(inCell), Vec<Dim>::Constant(half));
			if (isRing()) cloud.hoopStretch.push_back(1);
		}
		/// Displacements of points without the addition, that, and nodal displacements.
		void move(double scatter = 0.1)
		{
			StepReport            report;
			const StepSystem<Dim> system(cloud, model, {}, report);
			d = random.vector(system.nodalSize(), scatter);
			for (std::size_t n = 0; isRing() && n < system.basis.nodes.size(); ++n)
				if (Grid<Dim>::index(system.basis.nodes[n])[0] == 0) d[Dim * n] = 0;
			by.assign(cloud.size(), Vec<Dim>::Zero());
			forUpdatedPoints<Dim>(
			        system.basis, system.points, model.materials, d, [&](int p, const PointUpdate<Dim>& u) { by[p] = u.displacement; });
			even = divergenceCorrections(cloud, system.basis, system.points, model.grid, d);
		}
		/// Divergence of the whole field in point p, from differences over a step on both sides.
		double dilation(int p) const
		{
			double sum = isRing() ? (by[p] + even[p].shift)[0] / cloud.position[p][0] : 0;
			for (int a = 0; a < Dim; ++a) {
				const int high = p + 1 + 2 * a;
				sum += (by[high] + even[high].shift - by[high + 1] - even[high + 1].shift)[a] / (2 * step * h);
			}
			return sum;
		}
		/// A point and those beside it; its number.
		int addStar(const Vec<Dim>& inCell)
		{
			const int p = int(cloud.size());
			add(inCell);
			for (int a = 0; a < Dim; ++a)
				for (const double side : { step, -step })
					add(inCell + side * Vec<Dim>::Unit(a));
			return p;
		}
		Vec<Dim> somewhere()
		{
			return Vec<Dim>::NullaryExpr([&]() { return random.in(0.1, 0.9); });
		}

		Eigen::VectorXd                        d;
		std::vector<Vec<Dim>>                  by;
		std::vector<DivergenceCorrection<Dim>> even;
	};

	template <int Dim> void hasOneDilation(Shape shape)
	{
		Scene<Dim>       scene(shape);
		std::vector<int> points;
		for (int i = 0; i < 8; ++i)
			points.push_back(scene.addStar(scene.somewhere()));
		scene.move();
		double before = 0;
		for (const int p : points) {
			EXPECT_NEAR(scene.dilation(p), scene.dilation(points[0]), 1e-6);
			before = std::max(before, std::abs(scene.even[p].growth.sum() + scene.even[p].hoop));
			for (int a = 0; a < Dim; ++a) {
				const auto shift = [&](int q) { return scene.even[q].shift[a]; };
				EXPECT_NEAR(scene.even[p].growth[a], (shift(p + 1 + 2 * a) - shift(p + 2 + 2 * a)) / (2 * scene.step * scene.h), 1e-6);
			}
			EXPECT_NEAR(scene.even[p].hoop, scene.isRing() ? scene.even[p].shift[0] / scene.cloud.position[p][0] : 0, 1e-9);
		}
		EXPECT_GT(before, 1e-2);
	}

	TEST(DivergenceCorrection, IsTheSameAllOverTheCellInThePlane) { hasOneDilation<2>(Shape::plane); }
	TEST(DivergenceCorrection, IsTheSameAllOverTheCellOfARing) { hasOneDilation<2>(Shape::ring); }
	TEST(DivergenceCorrection, IsTheSameAllOverTheCellAtTheAxis) { hasOneDilation<2>(Shape::ringAtAxis); }
	TEST(DivergenceCorrection, IsTheSameAllOverTheCellInSpace) { hasOneDilation<3>(Shape::space); }

	/// So nothing is added to what goes from cell to cell.
	template <int Dim> void stopsAtFaces(Shape shape)
	{
		Scene<Dim> scene(shape);
		for (int a = 0; a < Dim; ++a)
			for (const double side : { 1e-4, 1 - 1e-4 }) {
				Vec<Dim> x = scene.somewhere();
				x[a]       = side;
				scene.add(x);
			}
		scene.add(Vec<Dim>::Constant(0.5));
		scene.move();
		for (int p = 0; p < 2 * Dim; ++p)
			EXPECT_LT(std::abs(scene.even[p].shift[p / 2]), 1e-3 * scene.even.back().shift.norm());
	}

	TEST(DivergenceCorrection, AddsNothingAcrossFacesInThePlane) { stopsAtFaces<2>(Shape::plane); }
	TEST(DivergenceCorrection, AddsNothingAcrossFacesOfARing) { stopsAtFaces<2>(Shape::ring); }
	TEST(DivergenceCorrection, AddsNothingAcrossFacesAtTheAxis) { stopsAtFaces<2>(Shape::ringAtAxis); }
	TEST(DivergenceCorrection, AddsNothingAcrossFacesInSpace) { stopsAtFaces<3>(Shape::space); }

	template <class Dimension> using EvenDilationOf = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(EvenDilationOf, BothDimensions, DimensionName);

	/// Gauss points of its domain.
	TYPED_TEST(EvenDilationOf, IsTheMeanOverTheDomainOfAPoint)
	{
		constexpr int  Dim = TypeParam::value;
		Scene<Dim>     scene(Dim == 2 ? Shape::plane : Shape::space);
		const Vec<Dim> middle = Vec<Dim>::Constant(0.4);
		scene.add(middle, 0.3 * scene.h);
		for (int corner = 0; corner < 1 << Dim; ++corner)
			scene.add(middle + 0.3 / std::sqrt(3) * Vec<Dim>::NullaryExpr([&](Eigen::Index a) { return corner >> a & 1 ? 1 : -1; }));
		scene.move();
		Vec<Dim> shift = Vec<Dim>::Zero(), growth = shift;
		for (int corner = 1; corner <= 1 << Dim; ++corner)
			shift += scene.even[corner].shift / (1 << Dim), growth += scene.even[corner].growth / (1 << Dim);
		EXPECT_LT((scene.even[0].shift - shift).norm(), 1e-7);
		EXPECT_LT((scene.even[0].growth - growth).norm(), 1e-7);
	}

	/// Volumes as the law sees them, also after large displacements.
	TYPED_TEST(EvenDilationOf, PointsOfACellChangeTheirVolumesAlike)
	{
		constexpr int Dim = TypeParam::value;
		Scene<Dim>    scene(Dim == 2 ? Shape::plane : Shape::space);
		for (int i = 0; i < 6; ++i)
			scene.add(scene.somewhere());
		scene.move();
		StepReport            report;
		const StepSystem<Dim> system(scene.cloud, scene.model, {}, report);
		auto                  cloud = scene.cloud;
		report.accepted             = true;
		ASSERT_TRUE(accept(system, cloud, scene.d, report));
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			EXPECT_NEAR(cloud.volumeRatio(p), cloud.volumeRatio(0), 1e-12);
			EXPECT_NEAR(std::log(cloud.volumeRatio(p)), cloud.elasticStrain[p].full().trace(), 1e-9);
			EXPECT_LT((cloud.position[p] - scene.cloud.position[p] - scene.by[p] - scene.even[p].shift).norm(), 1e-14);
		}
		EXPECT_GT(std::abs(cloud.volumeRatio(0) - 1), 1e-3);
	}

} // namespace
} // namespace gimpm::testEvenDilation
