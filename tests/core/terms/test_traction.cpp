// SPDX-License-Identifier: GPL-2.0-or-later
// Loads on surfaces that move with the body: tangent, resultants, and closed forms.
#include "core/stepping/step_system.hpp"
#include "core/terms/traction.hpp"
#include "derivatives.hpp"
#include "scenes.hpp"
#include <Eigen/Geometry>

namespace gimpm::testTraction {
namespace {

	template <int Dim> Surface<Dim> surfaceOf(std::vector<Vec<Dim>> vertices, std::vector<typename Surface<Dim>::Piece> pieces)
	{
		return { vertices, vertices, std::move(pieces) };
	}

	/// The upper side of a box, at height y, in pieces with the body below.
	template <int Dim> Surface<Dim> lid(double size, double y)
	{
		if constexpr (Dim == 2) return surfaceOf<2>({ { size, y }, { 0, y } }, { { 0, 1 } });
		else
			return surfaceOf<3>({ { 0, y, 0 }, { 0, y, size }, { size, y, size }, { size, y, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } });
	}

	/// All sides of a box: a closed surface.
	template <int Dim> Surface<Dim> skin(const Vec<Dim>& low, const Vec<Dim>& high)
	{
		std::vector<Vec<Dim>> corners;
		for (int c = 0; c < 1 << Dim; ++c) {
			corners.push_back(low);
			for (int a = 0; a < Dim; ++a)
				if (c >> a & 1) corners.back()[a] = high[a];
		}
		if constexpr (Dim == 2) return surfaceOf<2>(corners, { { 0, 1 }, { 1, 3 }, { 3, 2 }, { 2, 0 } });
		else
			return surfaceOf<3>(
			        corners,
			        { { 0, 2, 1 },
			          { 1, 2, 3 },
			          { 4, 5, 6 },
			          { 5, 7, 6 },
			          { 0, 1, 4 },
			          { 1, 5, 4 },
			          { 2, 6, 3 },
			          { 3, 6, 7 },
			          { 0, 4, 2 },
			          { 2, 4, 6 },
			          { 1, 3, 5 },
			          { 3, 7, 5 } });
	}

	/// Three cells a side of a body that is loaded on a surface.
	template <int Dim> struct Block {
		static constexpr double size = 1.5;
		Model<Dim>              model;
		PointCloud<Dim>         cloud;
		SurfaceLoad<Dim>        load;
		StepReport              report;
		LinearSolver            solver;

		explicit Block(const Surface<Dim>& surface)
		{
			model.grid.cellSize    = 0.5;
			model.materials        = { { Hencky(1e6, 0), 0 } };
			model.newton.tolerance = 1e-9;
			model.terms            = { [this](const StepContext<Dim>& step) { return std::make_unique<Traction<Dim>>(load, step); } };
			cloud                  = block<Dim>(model.grid, Index<Dim>::Constant(3), 2);
			load.surface           = surface;
			load.surface.refine(pieceLimit * model.grid.cellSize);
		}
		void rollers(bool onAllSides)
		{
			std::vector<ConstrainedBox<Dim>> walls;
			for (int a = 0; a < Dim; ++a) {
				walls.push_back(wallBelow<Dim>(model.grid, a, 0));
				if (onAllSides && a != 1) walls.push_back(wallAbove<Dim>(model.grid, a, size));
			}
			model.boundary = Boundary<Dim>(walls);
		}
		StepReport      step() { return loadStep(cloud, model, {}, solver); }
		StepSystem<Dim> system() { return { cloud, model, Load<Dim>(), report }; }
	};

	template <int Dim> double tangentError(Block<Dim>& block) { return tangentErrorOfLastTerm(block.system(), block.model.grid, 1e-3); }

	template <class T> using TractionOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(TractionOf, BothDimensions, DimensionName);

	TYPED_TEST(TractionOf, TangentIsTheDerivative)
	{
		constexpr int Dim = TypeParam::value;
		const auto    low = Vec<Dim>::Constant(0.1), high = Vec<Dim>::Constant(1.3);
		for (const auto& surface : { lid<Dim>(1.3, 1.4), skin<Dim>(low, high) }) {
			Block<Dim> block(surface);
			block.load.pressure = 300;
			block.load.traction.setConstant(50);
			EXPECT_LT(tangentError(block), 1e-9);
			EXPECT_EQ(block.system().isSymmetric(), surface.isClosed());
		}
	}

	TEST(Traction, OfRingsHasItsTangentAndTheAreaOfADisc)
	{
		Block<2> block(lid<2>(1.3, 1.4));
		block.model.grid.axisymmetric = true;
		block.load.pressure           = 300;
		block.load.traction           = { 0, 50 };
		EXPECT_LT(tangentError(block), 1e-9);
		const auto            system = block.system();
		const Eigen::VectorXd zero   = Eigen::VectorXd::Zero(system.nodalSize());
		Eigen::VectorXd       force  = zero;
		system.terms.back()->add(zero, { force });
		double down = 0;
		for (int i = 1; i < force.size(); i += 2)
			down += force[i];
		EXPECT_NEAR(down / (250 * M_PI * 1.3 * 1.3), 1, 1e-12);
	}

	TYPED_TEST(TractionOf, NodesGetResultantAndMoment)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    block(lid<Dim>(1.3, 1.43));
		block.load.pressure          = 200;
		block.load.traction          = 70 * Vec<Dim>::Unit(0);
		const auto            system = block.system();
		const Eigen::VectorXd zero   = Eigen::VectorXd::Zero(system.nodalSize());
		Eigen::VectorXd       force  = zero;
		system.terms.back()->add(zero, { force });
		const double   area     = Dim == 2 ? 1.3 : 1.3 * 1.3;
		const Vec<Dim> expected = area * (70 * Vec<Dim>::Unit(0) - 200 * Vec<Dim>::Unit(1));
		Vec<Dim>       centre = Vec<Dim>::Constant(0.65), sum = Vec<Dim>::Zero();
		centre[1]         = 1.43;
		double     moment = 0; // about the centre, in the plane x-y
		const auto places = nodePositions(system.basis, block.model.grid);
		for (std::size_t n = 0; n < places.size(); ++n) {
			const Vec<Dim> f = -force.template segment<Dim>(Dim * n), arm = places[n] - centre;
			sum += f;
			moment += arm[0] * f[1] - arm[1] * f[0];
		}
		EXPECT_LT((sum - expected).norm(), 1e-12 * expected.norm());
		EXPECT_NEAR(moment, 0, 1e-12 * expected.norm());
		EXPECT_NEAR(system.fromOutside(zero) / force.norm(), 1, 1e-14);
	}

	/// Confined, nu = 0: E ln l / l = -q, so that l = W(q/E)/(q/E) = 0.844580 for q/E = 0.2.
	TYPED_TEST(TractionOf, SurchargeOnAColumn)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool follows : { true, false }) {
			Block<Dim> block(lid<Dim>(1.5, 1.5));
			block.rollers(true);
			for (int i = 1; i <= 4; ++i) {
				(follows ? block.load.pressure : block.load.traction[1]) = (follows ? 1 : -1) * 2e5 * i / 4;
				const auto report                                        = block.step();
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_LE(report.iterations, 5);
			}
			double top = 0;
			for (const auto& vertex : block.load.surface.vertices)
				top = std::max(top, vertex[1]);
			EXPECT_NEAR(top / 1.5, 0.844580, Dim == 2 ? 2e-6 : 5e-4) << "triangles share their force with the nodes less evenly";
			EXPECT_NEAR(block.load.resultant[1], -2e5 * std::pow(1.5, Dim - 1), 1e-3);
		}
	}

	/// StepContext and end of the line do not matter with sides that are the same nodes.
	TYPED_TEST(TractionOf, ForcesAsTheStepBegins)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    block(lid<Dim>(1.5, 1.5));
		block.rollers(true);
		block.load.pressure = 2e4;
		ASSERT_TRUE(block.step().converged());
		const Vec<Dim> before = block.load.resultant;
		EXPECT_GT(block.load.work, 0);
		block.load.pressure = 5e4;
		EXPECT_LT((resultantBefore(block.system()) - before).norm(), 1e-12 * before.norm());
	}

	TYPED_TEST(TractionOf, AcrossPeriodicSides)
	{
		constexpr int Dim = TypeParam::value;
		for (const double shift : { 0., -0.4 }) {
			Surface<Dim> surface = lid<Dim>(1.5, 1.5);
			for (auto* vertices : { &surface.vertices, &surface.vertices0 })
				for (auto& x : *vertices)
					x[0] += shift;
			Block<Dim> block(surface);
			block.model.grid.period[0] = 3;
			std::vector<ConstrainedBox<Dim>> walls { wallBelow<Dim>(block.model.grid, 1, 0) };
			if (Dim == 3) walls.push_back(wallBelow<Dim>(block.model.grid, Dim - 1, 0));
			Vec<Dim> corner = Vec<Dim>::Zero();
			walls.push_back(held<Dim>(block.model.grid, corner, corner, "xy"));
			block.model.boundary = Boundary<Dim>(walls);
			block.load.pressure  = 2e5;
			const auto report    = block.step();
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_NEAR(block.load.resultant[1], -2e5 * std::pow(1.5, Dim - 1), Dim == 2 ? 1e-3 : 3e4);
			// Triangles share their force with the nodes less evenly.
			for (const auto& vertex : block.load.surface.vertices)
				EXPECT_NEAR(vertex[1] / 1.5, 0.844580, Dim == 2 && shift == 0 ? 2e-6 : 3e-3);
		}
	}

	/// All around, free to shrink: Kirchhoff stress K ln J = -p J.
	TYPED_TEST(TractionOf, PressureFromAllSides)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    block(skin<Dim>(Vec<Dim>::Zero(), Vec<Dim>::Constant(1.5)));
		block.rollers(false);
		block.model.materials = { { Hencky(1e6, 0.25), 0 } };
		block.load.pressure   = 5e4;
		const auto report     = block.step();
		ASSERT_TRUE(report.converged()) << report.cause;
		for (const auto& stress : block.cloud.stress)
			for (int a = 0; a < Dim; ++a)
				EXPECT_NEAR(stress.inPlane()(a, a) / -5e4, 1, Dim == 2 ? 1e-6 : 1.5e-2);
	}

	TYPED_TEST(TractionOf, OfAPlaceWithoutMaterialIsRefused)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    high(lid<Dim>(1.5, 1.5 + 0.4 * 0.5));
		high.rollers(true);
		high.load.pressure = 1;
		const auto before  = high.load.surface.vertices;
		const auto report  = high.step();
		EXPECT_EQ(report.failure, Failure::misplaced);
		EXPECT_NE(report.cause.find("a loaded surface has a vertex at ("), std::string::npos) << report.cause;
		EXPECT_EQ(high.load.surface.vertices, before);
		Block<Dim> near(lid<Dim>(1.5, 1.5 + 0.2 * 0.5));
		near.rollers(true);
		near.load.pressure = 1;
		EXPECT_TRUE(near.step().converged());
	}

	TYPED_TEST(TractionOf, OfASurfaceThatIsInsideOutIsRefused)
	{
		constexpr int Dim    = TypeParam::value;
		auto          turned = lid<Dim>(1.5, 1.5);
		for (auto& piece : turned.pieces)
			std::swap(piece[0], piece[1]);
		for (const bool isNew : { true, false }) {
			Block<Dim> block(turned);
			block.rollers(true);
			block.load.isNew    = isNew;
			block.load.pressure = 1;
			const auto report   = block.step();
			EXPECT_EQ(report.converged(), !isNew);
			if (isNew) {
				EXPECT_EQ(report.cause.substr(0, 71), "a loaded surface is under pressure and has the body on its outer side: ");
			}
		}
		Block<Dim> right(lid<Dim>(1.5, 1.5));
		right.rollers(true);
		right.load.isNew    = true;
		right.load.pressure = 1;
		EXPECT_TRUE(right.step().converged());
	}

	TYPED_TEST(TractionOf, WhatIsBetweenTwoPlacesIsFound)
	{
		constexpr int  Dim = TypeParam::value;
		const Vec<Dim> low = Vec<Dim>::Zero(), high = Vec<Dim>::Constant(1), middle = (low + high) / 2;
		Surface<Dim>   surface = skin<Dim>(low, high);
		surface.refine(0.3);
		for (int a = 0; a < Dim; ++a)
			for (const double sign : { -1, 1 }) {
				const Vec<Dim> side = sign * Vec<Dim>::Unit(a), outside = middle + side;
				EXPECT_TRUE(surface.isBetween(middle, outside)); // also at joints of pieces
				EXPECT_TRUE(surface.isBetween(outside, Vec<Dim>(middle + 0.1 * Vec<Dim>::LinSpaced(1, 2))));
				EXPECT_FALSE(surface.isBetween(middle, Vec<Dim>(middle + 0.49 * side)));
				EXPECT_FALSE(surface.isBetween(outside, Vec<Dim>(middle + 0.51 * side)));
				// Along it.
				EXPECT_FALSE(surface.isBetween(outside, Vec<Dim>(outside + 2 * Vec<Dim>::Unit((a + 1) % Dim))));
			}
	}

	TYPED_TEST(TractionOf, RefinementKeepsAreasAndJoins)
	{
		constexpr int  Dim        = TypeParam::value;
		const Vec<Dim> low        = Vec<Dim>::Constant(-0.3);
		Vec<Dim>       high       = Vec<Dim>::Constant(1);
		high[0]                   = 2.1;
		const Surface<Dim> coarse = skin<Dim>(low, high);
		Surface<Dim>       fine   = coarse;
		fine.refine(0.25);
		EXPECT_TRUE(coarse.isClosed() && fine.isClosed());
		Surface<Dim> open = fine;
		open.pieces.pop_back();
		EXPECT_FALSE(open.isClosed());
		double   area = 0, largest = 0;
		Vec<Dim> sum = Vec<Dim>::Zero();
		for (const auto& piece : fine.pieces) {
			area += fine.normal(piece, fine.vertices).norm();
			sum += fine.normal(piece, fine.vertices);
			for (int i = 0; i < Dim; ++i)
				largest = std::max(largest, (fine.vertices[piece[i]] - fine.vertices[piece[(i + 1) % Dim]]).norm());
		}
		double expected = 0;
		for (const auto& piece : coarse.pieces)
			expected += coarse.normal(piece, coarse.vertices).norm();
		EXPECT_NEAR(area / expected, 1, 1e-12);
		EXPECT_LT(sum.norm(), 1e-12);
		EXPECT_LT(largest, 0.25);
		const double equilateral = std::sqrt(3) / 4 * 0.25 * 0.25; // the largest triangle with such sides
		EXPECT_TRUE(Dim == 2 || double(fine.pieces.size()) < 4 * area / equilateral) << "few are slender";
		EXPECT_EQ(fine.vertices, fine.vertices0);
	}

} // namespace
} // namespace gimpm::testTraction
