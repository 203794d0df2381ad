// SPDX-License-Identifier: GPL-2.0-or-later
// The modulus of a ghost face is that of the softer of its two cells: the mean of its points, weighted by their overlap
// with the cell.
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"

namespace gimpm {
namespace {

	/// Modulus that the faces of a free body were given, by axis and lower cell.
	template <int Dim> double modulus(const PointCloud<Dim>& cloud, const std::vector<double>& young, int axis, const Index<Dim>& lower)
	{
		const auto basis       = cloudBasis<Dim>(cloud, Grid<Dim>(), Basis::gimp, Boundary<Dim>());
		auto       faces       = ghostFaces<Dim>(basis.cells, boundaryCells<Dim>(basis.cells, Boundary<Dim>()), Boundary<Dim>());
		const auto stiffnessOf = [&](int p) { return VolumeAndModulus { cloud.volume0[p], young[p] }; };
		weighGhostFaces<Dim>(faces, basis, stiffnessOf, Grid<Dim>(), 1, GhostScaling::paper);
		for (const auto& face : faces)
			if (face.axis == axis && face.lower == Grid<Dim>::key(lower)) return 3 * face.stiffness;
		ADD_FAILURE() << "there is no such face";
		return 0;
	}

	TEST(GhostModulus, OfTheSofterCellByVolume)
	{
		PointCloud<2> cloud;
		addPoint<2>(cloud, { 0.5, 0.5 }, { 0.1, 0.1 });  // 0.04 of 100 Pa
		addPoint<2>(cloud, { 1.5, 0.5 }, { 0.2, 0.2 });  // 0.16 of 1000 Pa
		addPoint<2>(cloud, { 0.3, 0.5 }, { 0.05, 0.4 }); // 0.08 of 400 Pa
		EXPECT_NEAR(modulus<2>(cloud, { 100, 1000, 400 }, 0, { 0, 0 }), 300, 1e-11);
		EXPECT_NEAR(modulus<2>(cloud, { 100, 200, 400 }, 0, { 0, 0 }), 200, 1e-11);
	}

	TEST(GhostModulus, APointCountsWithItsOverlapOnly)
	{
		// three cells; the point in the middle reaches across the face x = 1 with a quarter of its domain
		PointCloud<2> cloud;
		addPoint<2>(cloud, { 0.5, 0.5 }, { 0.25, 0.5 }); // 0.5, cell 0
		addPoint<2>(cloud, { 1.2, 0.5 }, { 0.4, 0.5 });  // 0.8: 0.2 in cell 0, 0.6 in cell 1
		addPoint<2>(cloud, { 2.4, 0.5 }, { 0.5, 0.25 }); // 0.5: 0.05 in cell 1, 0.45 in cell 2
		const std::vector<double> young { 10, 100, 1000 };
		EXPECT_NEAR(modulus<2>(cloud, young, 0, { 0, 0 }), (5 + 20) / (0.5 + 0.2), 1e-10);
		EXPECT_NEAR(modulus<2>(cloud, young, 0, { 1, 0 }), (60 + 50) / (0.6 + 0.05), 1e-10);
	}

	TEST(GhostModulus, OverlapsMultiplyOverTheAxes)
	{
		// one point around the corner (1, 1), a quarter of it below along x, three eighths along y; another one
		// in cell (1, 1)
		PointCloud<2> cloud;
		addPoint<2>(cloud, { 1.2, 1.1 }, { 0.4, 0.4 });
		addPoint<2>(cloud, { 1.5, 1.5 }, { 0.3, 0.3 });
		const double        V = 0.64, W = 0.36;
		const double        share = 0.75 * 0.625, mixed = (1000 * V * share + 10 * W) / (V * share + W);
		std::vector<double> young { 1000, 10 };
		// The second point does not touch this face's cells.
		EXPECT_NEAR(modulus<2>(cloud, young, 0, { 0, 0 }), 1000, 1e-10);
		EXPECT_NEAR(modulus<2>(cloud, young, 0, { 0, 1 }), mixed, 1e-10);
		EXPECT_NEAR(modulus<2>(cloud, young, 1, { 1, 0 }), mixed, 1e-10);
	}

	TEST(GhostModulus, LayersIn3D)
	{
		PointCloud<3> cloud;
		addPoint<3>(cloud, { 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0.5 });
		addPoint<3>(cloud, { 0.5, 0.5, 1.25 }, { 0.5, 0.5, 0.25 });
		addPoint<3>(cloud, { 0.5, 0.5, 1.75 }, { 0.5, 0.5, 0.25 });
		EXPECT_NEAR(modulus<3>(cloud, { 10, 20, 40 }, 2, { 0, 0, 0 }), 10, 1e-13);
		EXPECT_NEAR(modulus<3>(cloud, { 40, 20, 10 }, 2, { 0, 0, 0 }), 15, 1e-13);
	}

	TEST(GhostModulus, AStepWeighsWithCurrentVolumesAndTheMaterialsOwnModuli)
	{
		PointCloud<2> cloud;
		addPoint<2>(cloud, { 0.25, 0.5 }, { 0.25, 0.5 });
		addPoint<2>(cloud, { 0.75, 0.5 }, { 0.25, 0.5 }, 1);
		addPoint<2>(cloud, { 1.5, 0.5 }, { 0.5, 0.5 }, 1);
		cloud.defGrad[1] << 0.5, 0.3, 0, 0.4; // a fifth of its initial volume
		Model<2> model;
		model.materials = { { Hencky(600, 0.3), 1 }, { VonMises(1200, 0.2, 1), 1 } };
		model.ghost     = { 0.1, GhostScaling::paper };
		StepReport    report;
		StepSystem<2> system(cloud, model, {}, report);
		ASSERT_EQ(system.faces.size(), 1u);
		EXPECT_NEAR(system.faces[0].stiffness, 0.1 * (600 + 0.2 * 1200) / 1.2 / 3, 1e-12);
		EXPECT_EQ(report.ghostFaces, 1);
		EXPECT_EQ(report.boundaryCells, 2);
	}

	TEST(GhostModulus, FactorZeroLooksForNoFaces)
	{
		Model<2> model;
		model.materials = { { Hencky(600, 0.3), 1 } };
		model.ghost     = { 0 };
		StepReport report;
		EXPECT_TRUE(StepSystem<2>(block<2>(model.grid, { 2, 2 }, 2), model, {}, report).faces.empty());
		EXPECT_EQ(report.boundaryCells, 0);
	}

} // namespace
} // namespace gimpm
