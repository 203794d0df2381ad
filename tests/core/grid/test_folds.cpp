// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes that are there twice at folds of a body.
#include "core/grid/folds.hpp"
#include "core/grid/parting.hpp"
#include "core/grid/parts_of_body.hpp"
#include "refined.hpp"
#include "scenes.hpp"

namespace gimpm::testFolds {
namespace {

	/// Two legs with a slot between them, on a base: from x = 0 to 7, the slot from x = 3 on, above y = 2; in space
	/// one cell thick. With layers of bodies of one bit, in layer 1.
	template <int Dim> struct Slotted {
		/// `isHalved`: on cells of twice the size, halved beside and above the slot.
		explicit Slotted(double slot, bool isHalved = false)
		{
			if (isHalved) {
				Vec<Dim> low = Vec<Dim>::Constant(-10), high = -low;
				low[0] = 3 - 1, low[1] = 0, high[0] = 3 + slot + 1, high[1] = 20;
				grid.cellSize = 2, grid.refinement = std::make_shared<Refinement<Dim>>(std::vector<RefinedBox<Dim>> { { low, high, 1 } }, grid),
				grid.cellSize = 1;
			}
			constexpr double half  = 0.25;
			Index<Dim>       count = Index<Dim>::Constant(2);
			count[0] = int(std::lround(14 + slot / half / 2)), count[1] = 16;
			std::vector<DomainBox<Dim>> boxes;
			forIndicesUpTo<Dim>(Index<Dim>::Zero(), count.array() - 1, [&](const Index<Dim>& i) {
				const Vec<Dim> x = half * (2 * i.template cast<double>() + Vec<Dim>::Ones());
				if (x[1] < 2 || x[0] < 3 || x[0] > 3 + slot) boxes.push_back(domainBox<Dim>(x, Vec<Dim>::Constant(half)));
			});
			surface = outline<Dim>(boxes, Vec<Dim>::Zero(), 0.25);
			cloud.resize(boxes.size());
			cloud.layer.assign(boxes.size(), 1);
			for (std::size_t p = 0; p < boxes.size(); ++p)
				cloud.position[p] = (boxes[p].low + boxes[p].high) / 2, cloud.halfSize[p] = Vec<Dim>::Constant(half);
			bodies = { { 1, &surface } };
			partFolds<Dim>(bodies, 1, cloud, grid);
		}
		/// The node of the point with a position near one.
		bool isOwn(double x, double y, int layer) const
		{
			Index<Dim> node = Index<Dim>::Zero();
			node[0] = int(x), node[1] = int(y);
			return grid.parting && grid.parting->nodeFor(Grid<Dim>::key(node, 0, layer)) == Grid<Dim>::key(node, 0, layer);
		}

		Surface<Dim>                  surface;
		PointCloud<Dim>               cloud;
		Grid<Dim>                     grid;
		std::vector<FoldingBody<Dim>> bodies;
	};

	template <class Dimension> using Folds = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Folds, BothDimensions, DimensionName);

	/// The sides of a slot of half a cell have nodes of their own, from two cells above its tip on; points have
	/// layers by their sides, and pieces those of the points behind them.
	TYPED_TEST(Folds, SidesOfASlotHaveNodesOfTheirOwn)
	{
		constexpr int      Dim = TypeParam::value;
		const Slotted<Dim> scene(0.5);
		ASSERT_TRUE(scene.grid.parting);
		int parted = 0;
		for (std::size_t p = 0; p < scene.cloud.size(); ++p) {
			const Vec<Dim>& x = scene.cloud.position[p];
			if (x[1] < 2) EXPECT_EQ(scene.cloud.layer[p], 1);
			parted += scene.cloud.layer[p] == 3;
			EXPECT_EQ(scene.grid.parting->layerOfBody(scene.cloud.layer[p]), 1);
			EXPECT_EQ(scene.grid.parting->layerAt(x), scene.cloud.layer[p]);
			if (x[1] > 5 && std::abs(x[0] - 3.25) < 1) EXPECT_EQ(scene.cloud.layer[p], x[0] < 3.25 ? 1 : 3);
		}
		EXPECT_GT(parted, 5);
		EXPECT_TRUE(scene.isOwn(3, 7, 3));
		EXPECT_FALSE(scene.isOwn(3, 2, 3));
		EXPECT_FALSE(scene.isOwn(6, 7, 3));
		EXPECT_TRUE(scene.isOwn(3, 7, 1));
		const auto& layers = scene.bodies[0].layerOfPiece;
		ASSERT_EQ(layers.size(), scene.surface.pieces.size());
		for (std::size_t i = 0; i < layers.size(); ++i) {
			const auto&    piece  = scene.surface.pieces[i];
			const Vec<Dim> normal = scene.surface.normal(piece, scene.surface.vertices).normalized(), x = scene.surface.vertices[piece[0]];
			if (x[1] < 5 || x[1] > 7 || std::abs(x[0] - 3.25) > 0.5) continue;
			if (normal[0] > 0.9) EXPECT_EQ(layers[i], 1);
			if (normal[0] < -0.9) EXPECT_EQ(layers[i], 3);
		}
	}

	/// The same on cells of two sizes, of which the smaller ones are around the slot.
	TYPED_TEST(Folds, SidesHaveNodesOfTheirOwnOnHalvedCells)
	{
		constexpr int      Dim = TypeParam::value;
		const Slotted<Dim> equal(0.5), halved(0.5, true);
		ASSERT_TRUE(halved.grid.parting && halved.grid.refinement);
		EXPECT_TRUE(halved.isOwn(3, 7, 3));
		EXPECT_FALSE(halved.isOwn(3, 2, 3));
		for (std::size_t p = 0; p < equal.cloud.size(); ++p)
			if (const Vec<Dim>& x = equal.cloud.position[p]; x[1] > 5 && std::abs(x[0] - 3.25) < 1)
				EXPECT_EQ(halved.cloud.layer[p], equal.cloud.layer[p]);
	}

	/// A slot of two cells keeps its sides apart without nodes of their own, but they are watched; one of four is
	/// not.
	TYPED_TEST(Folds, WideSlotsNeedNoNodes)
	{
		constexpr int Dim = TypeParam::value;
		EXPECT_FALSE(Slotted<Dim>(2).grid.parting);
		EXPECT_FALSE(Slotted<Dim>(2).bodies[0].layerOfPiece.empty());
		EXPECT_TRUE(Slotted<Dim>(4).bodies[0].layerOfPiece.empty());
		for (const int layer : Slotted<Dim>(2).cloud.layer)
			EXPECT_EQ(layer, 1);
	}

	/// Sides that have had pressed contact points stay those with the higher layer.
	TEST(FoldsInThePlane, PressedSidesKeepTheirContactPoints)
	{
		Slotted<2> scene(0.5);
		for (const double normal : { 1., -1. }) {
			scene.bodies[0].pressure.assign(scene.surface.pieces.size(), 0.);
			std::vector<int> pressed;
			for (std::size_t i = 0; i < scene.surface.pieces.size(); ++i) {
				const auto&  piece = scene.surface.pieces[i];
				const Vec<2> x     = scene.surface.vertices[piece[0]];
				if (x[1] > 5 && x[1] < 7 && std::abs(x[0] - 3.25) < 0.5 && normal * scene.surface.normal(piece, scene.surface.vertices)[0] > 0)
					scene.bodies[0].pressure[i] = 1, pressed.push_back(int(i));
			}
			ASSERT_FALSE(pressed.empty());
			partFolds<2>(scene.bodies, 1, scene.cloud, scene.grid);
			for (const int i : pressed)
				EXPECT_EQ(scene.bodies[0].layerOfPiece[i], 3);
		}
	}
}
}
