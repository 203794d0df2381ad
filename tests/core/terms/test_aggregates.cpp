// SPDX-License-Identifier: GPL-2.0-or-later
// Ghost faces that tie ill-filled cells to well-filled ones.
#include "core/terms/aggregates.hpp"
#include "scenes.hpp"
#include <set>

namespace gimpm::testAggregates {
namespace {

	using Name = std::pair<int, Index<2>>; // normal axis, lower cell
	struct Less {
		bool operator()(const Name& a, const Name& b) const
		{
			return std::tie(a.first, a.second[0], a.second[1]) < std::tie(b.first, b.second[0], b.second[1]);
		}
	};
	using Names = std::set<Name, Less>;

	/// A point that fills these parts of a cell from its lower corner on; cells are 1 m wide.
	void fill(PointCloud<2>& cloud, int i, int j, double width, double height)
	{
		addPoint<2>(cloud, { i + width / 2, j + height / 2 }, { width / 2, height / 2 });
	}

	struct Body {
		Grid<2>                   grid;
		CloudBasis<2>             basis;
		std::vector<GhostFace<2>> faces;
		std::vector<char>         ties;

		explicit Body(const PointCloud<2>& cloud, double threshold = 0.25, bool axisymmetric = false)
		{
			grid.axisymmetric      = axisymmetric;
			basis                  = cloudBasis<2>(cloud, grid, Basis::gimp, Boundary<2>());
			faces                  = ghostFaces<2>(basis.cells, boundaryCells<2>(basis.cells, Boundary<2>()), Boundary<2>());
			const auto stiffnessOf = [&](int p) { return VolumeAndModulus { cloud.volume0[p], 1 }; };
			weighGhostFaces<2>(faces, basis, stiffnessOf, grid, 1, GhostScaling::paper);
			ties = tiesOfIllFilled<2>(faces, basis, stiffnessOf, grid, threshold);
		}
		Names tied() const
		{
			Names found;
			for (std::size_t i = 0; i < faces.size(); ++i)
				if (ties[i]) found.insert({ faces[i].axis, Grid<2>::index(faces[i].lower) });
			return found;
		}
	};

	/// 3 x 2 full cells with a film of this height on top.
	PointCloud<2> filmOnBlock(double height)
	{
		PointCloud<2> cloud;
		for (int i = 0; i < 3; ++i) {
			for (int j = 0; j < 2; ++j)
				fill(cloud, i, j, 1, 1);
			fill(cloud, i, 2, 1, height);
		}
		return cloud;
	}

	TEST(Aggregates, AFilmIsTiedToTheCellsBelow)
	{
		EXPECT_EQ(Body(filmOnBlock(0.1)).tied(), (Names { { 1, { 0, 1 } }, { 1, { 1, 1 } }, { 1, { 2, 1 } } }));
		EXPECT_EQ(Body(filmOnBlock(0.3)).tied(), Names());
		EXPECT_EQ(Body(filmOnBlock(0.3), 0.5).tied().size(), 3u);
	}

	/// A cell beside two that are filled alike is tied to both, so that mirrored bodies are; else to the fuller
	/// one.
	TEST(Aggregates, TheFullestNeighbourHolds)
	{
		PointCloud<2> cloud;
		fill(cloud, 0, 0, 1, 1), fill(cloud, 1, 1, 1, 1), fill(cloud, 0, 1, 1, 0.1);
		EXPECT_EQ(Body(cloud).tied(), (Names { { 1, { 0, 0 } }, { 0, { 0, 1 } } }));
		PointCloud<2> uneven;
		fill(uneven, 0, 0, 1, 1), fill(uneven, 1, 1, 1, 0.9), fill(uneven, 0, 1, 1, 0.1);
		EXPECT_EQ(Body(uneven).tied(), (Names { { 1, { 0, 0 } } }));
	}

	TEST(Aggregates, RoundByRoundAndWhatIsNotReachedKeepsItsFaces)
	{
		PointCloud<2> cloud;
		fill(cloud, 0, 0, 1, 1);
		for (int i = 1; i < 4; ++i)
			fill(cloud, i, 0, 1, 0.1);
		fill(cloud, 10, 0, 1, 0.1), fill(cloud, 11, 0, 1, 0.1);
		EXPECT_EQ(Body(cloud).tied(), (Names { { 0, { 0, 0 } }, { 0, { 1, 0 } }, { 0, { 2, 0 } }, { 0, { 10, 0 } } }));
	}

	/// The volume of a point is that of its ring.
	TEST(Aggregates, AroundAnAxisCellsAreRings)
	{
		PointCloud<2> cloud = filmOnBlock(0.3);
		for (std::size_t p = 0; p < cloud.size(); ++p)
			cloud.volume0[p] *= 2 * M_PI * cloud.position[p][0];
		EXPECT_EQ(Body(cloud, 0.29, true).tied(), Names());
		EXPECT_EQ(Body(cloud, 0.31, true).tied().size(), 3u);
	}

	TEST(Aggregates, OtherFacesAreLessened)
	{
		Body       body(filmOnBlock(0.1));
		const auto before = body.faces;
		lessenElsewhere<2>(body.faces, body.ties, 0.01);
		for (std::size_t i = 0; i < before.size(); ++i)
			EXPECT_EQ(body.faces[i].stiffness, before[i].stiffness * (body.ties[i] ? 1 : 0.01));
	}

	/// However little of the cells is filled, and in space: a film is tied by as many faces as it has cells.
	TEST(Aggregates, InSpace)
	{
		PointCloud<3> cloud;
		for (int i = 0; i < 2; ++i)
			for (int k = 0; k < 2; ++k) {
				addPoint<3>(cloud, { i + 0.5, 0.5, k + 0.5 }, { 0.5, 0.5, 0.5 });
				addPoint<3>(cloud, { i + 0.5, 1 + 5e-9, k + 0.5 }, { 0.5, 5e-9, 0.5 });
			}
		const Grid<3> grid;
		const auto    basis       = cloudBasis<3>(cloud, grid, Basis::gimp, Boundary<3>());
		const auto    faces       = ghostFaces<3>(basis.cells, boundaryCells<3>(basis.cells, Boundary<3>()), Boundary<3>());
		const auto    stiffnessOf = [&](int p) { return VolumeAndModulus { cloud.volume0[p], 1 }; };
		const auto    ties        = tiesOfIllFilled<3>(faces, basis, stiffnessOf, grid, 0.25);
		for (std::size_t i = 0; i < faces.size(); ++i)
			EXPECT_EQ(ties[i], faces[i].axis == 1);
		EXPECT_EQ(std::count(ties.begin(), ties.end(), 1), 4);
	}

} // namespace
} // namespace gimpm::testAggregates
