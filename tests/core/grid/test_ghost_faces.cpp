// SPDX-License-Identifier: GPL-2.0-or-later
// Boundary elements and faces that carry the ghost stiffness (Coombs 2023, figure 3).
#include "scenes.hpp"
#include <algorithm>
#include <set>

namespace gimpm {
namespace {

	template <int Dim> std::vector<Key> sortedKeys(const std::vector<Index<Dim>>& cells)
	{
		std::vector<Key> keys;
		for (const auto& c : cells)
			keys.push_back(Grid<Dim>::key(c));
		std::sort(keys.begin(), keys.end());
		return keys;
	}

	/// (axis, lower cell) of the faces.
	template <int Dim> std::set<std::pair<int, Key>> named(const std::vector<GhostFace<Dim>>& faces)
	{
		std::set<std::pair<int, Key>> names;
		for (const auto& f : faces)
			names.insert({ f.axis, f.lower });
		EXPECT_EQ(names.size(), faces.size()) << "a face was found twice";
		return names;
	}

	template <int Dim> std::set<std::pair<int, Key>> names(const std::vector<std::pair<int, Index<Dim>>>& faces)
	{
		std::set<std::pair<int, Key>> result;
		for (const auto& [axis, lower] : faces)
			result.insert({ axis, Grid<Dim>::key(lower) });
		return result;
	}

	template <int Dim> std::vector<Key> cube(int cells)
	{
		std::vector<Index<Dim>> all;
		forIndices<Dim>(Index<Dim>::Zero(), Index<Dim>::Constant(cells), [&](const Index<Dim>& i) { all.push_back(i); });
		return sortedKeys<Dim>(all);
	}

	// y        populated cells of a body on a floor (y = 0) against a wall (x = 0)
	// 3  # #
	// 2  # # #
	// 1  # # #
	// 0  # # #
	//    0 1 2  x
	const std::vector<Key> body
	        = sortedKeys<2>({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 0, 1 }, { 1, 1 }, { 2, 1 }, { 0, 2 }, { 1, 2 }, { 2, 2 }, { 0, 3 }, { 1, 3 } });
	const Grid<2>     plane;
	const Grid<3>     space;
	const Boundary<2> corner({ wallBelow<2>(plane, 0, 0), wallBelow<2>(plane, 1, 0) });

	TEST(GhostFaces, BoundaryCellsOfADrawnBody)
	{
		EXPECT_EQ(boundaryCells<2>(body, corner), sortedKeys<2>({ { 2, 0 }, { 2, 1 }, { 2, 2 }, { 0, 3 }, { 1, 3 } }));
	}

	TEST(GhostFaces, FacesOfADrawnBody)
	{
		const auto faces = ghostFaces<2>(body, boundaryCells<2>(body, corner), corner);
		EXPECT_EQ(
		        named<2>(faces),
		        names<2>({ { 0, { 1, 0 } },
		                   { 0, { 1, 1 } },
		                   { 0, { 1, 2 } },
		                   { 0, { 0, 3 } }, // between two boundary cells
		                   { 1, { 2, 0 } },
		                   { 1, { 2, 1 } },
		                   { 1, { 0, 2 } },
		                   { 1, { 1, 2 } } }));
	}

	TEST(GhostFaces, AWallIsNoFreeSurface)
	{
		// without the wall at x = 0 the cells on it are boundary cells
		const Boundary<2> floor({ wallBelow<2>(plane, 1, 0) });
		EXPECT_EQ(boundaryCells<2>(body, floor), sortedKeys<2>({ { 2, 0 }, { 2, 1 }, { 2, 2 }, { 0, 3 }, { 1, 3 }, { 0, 0 }, { 0, 1 }, { 0, 2 } }));
		// rollers in the other direction do not make it one
		const Boundary<2> sliding({ wallBelow<2>(plane, 1, 0), held<2>(plane, { 0, 0 }, { 0, 4 }, "y") });
		EXPECT_EQ(boundaryCells<2>(body, sliding), boundaryCells<2>(body, floor));
	}

	TEST(GhostFaces, NoFaceAcrossAWallBetweenTwoBodies)
	{
		const auto        cells = sortedKeys<2>({ { -1, 0 }, { 0, 0 }, { -1, 1 }, { 0, 1 } });
		const Boundary<2> pile({ held<2>(plane, { 0, 0 }, { 0, 1 }, "x") }); // ends between the two rows
		const auto        boundary = boundaryCells<2>(cells, pile);
		EXPECT_EQ(boundary, cells);
		EXPECT_EQ(named<2>(ghostFaces<2>(cells, boundary, pile)), names<2>({ { 0, { -1, 1 } }, { 1, { -1, 0 } }, { 1, { 0, 0 } } }));
	}

	TEST(GhostFaces, AFullyEnclosedBodyHasNone)
	{
		const auto                           cells = cube<3>(3);
		const std::vector<ConstrainedBox<3>> lower = { wallBelow<3>(space, 0, 0), wallBelow<3>(space, 1, 0), wallBelow<3>(space, 2, 0) };
		Boundary<3> box({ lower[0], lower[1], lower[2], wallAbove<3>(space, 0, 3), wallAbove<3>(space, 1, 3), wallAbove<3>(space, 2, 3) });
		EXPECT_TRUE(boundaryCells<3>(cells, box).empty());
		EXPECT_TRUE(ghostFaces<3>(cells, {}, box).empty());
	}

	TEST(GhostFaces, AFreeCubeHasAllFacesButThoseInside)
	{
		const auto cells    = cube<3>(4); // 8 cells inside
		const auto boundary = boundaryCells<3>(cells, Boundary<3>());
		EXPECT_EQ(boundary.size(), 64u - 8u);
		EXPECT_EQ(ghostFaces<3>(cells, boundary, Boundary<3>()).size(), 3 * 3 * 16u - 3 * 4u);
	}

	TEST(GhostFaces, ABasinFilledToTheTop)
	{
		const auto                           cells = cube<3>(3);
		const std::vector<ConstrainedBox<3>> lower = { wallBelow<3>(space, 0, 0), wallBelow<3>(space, 1, 0), wallBelow<3>(space, 2, 0) };
		Boundary<3>                          basin({ lower[0], lower[1], lower[2], wallAbove<3>(space, 0, 3), wallAbove<3>(space, 1, 3) });
		const auto                           boundary = boundaryCells<3>(cells, basin);
		EXPECT_EQ(boundary.size(), 9u);
		for (const Key k : boundary)
			EXPECT_EQ(Grid<3>::index(k)[2], 2);
		const auto faces = ghostFaces<3>(cells, boundary, basin);
		EXPECT_EQ(faces.size(), 9u + 6u + 6u); // below the top layer, and within it
		for (const auto& f : faces)
			EXPECT_EQ(Grid<3>::index(f.lower)[2], f.axis == 2 ? 1 : 2);
	}

	TEST(GhostFaces, ASingleCellHasNone)
	{
		const auto cell = sortedKeys<2>({ { 5, -7 } });
		EXPECT_EQ(boundaryCells<2>(cell, Boundary<2>()), cell);
		EXPECT_TRUE(ghostFaces<2>(cell, cell, Boundary<2>()).empty());
	}

} // namespace
} // namespace gimpm
