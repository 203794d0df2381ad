// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of a body of points, and their surfaces.
#include "core/grid/parts_of_body.hpp"
#include "refined.hpp"
#include "scenes.hpp"
#include <numeric>

namespace gimpm::testPartsOfBody {
namespace {

	template <int Dim> std::vector<DomainBox<Dim>> boxes(const Index<Dim>& count, double size, const Vec<Dim>& from)
	{
		std::vector<DomainBox<Dim>> all;
		Index<Dim>                  i = Index<Dim>::Zero();
		for (int a = 0; a < Dim;) {
			const Vec<Dim> centre = from + size * (i.template cast<double>() + Vec<Dim>::Constant(0.5));
			all.push_back(domainBox<Dim>(centre, Vec<Dim>::Constant(size / 2)));
			for (a = 0; a < Dim && ++i[a] == count[a]; ++a)
				i[a] = 0;
		}
		return all;
	}

	template <class T> std::vector<T> joined(std::vector<T> one, const std::vector<T>& other)
	{
		one.insert(one.end(), other.begin(), other.end());
		return one;
	}

	template <class Dimension> using PartsOfBody = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(PartsOfBody, BothDimensions, DimensionName);

	/// Two lumps are one part by nodes up to an empty cell between them, and by touch only without a gap; near each
	/// other and a thousand cells apart.
	TYPED_TEST(PartsOfBody, NodesAndTouchConnectBoxes)
	{
		constexpr int    Dim   = TypeParam::value;
		const Index<Dim> count = Index<Dim>::Constant(4);
		for (const auto& [gap, byNodes, byTouch] :
		     { std::tuple(0., 1, 1), std::tuple(0.3, 1, 2), std::tuple(1., 2, 2), std::tuple(2., 2, 2), std::tuple(1000., 2, 2) }) {
			Vec<Dim> from  = Vec<Dim>::Zero();
			from[0]        = 2 + gap;
			const auto all = joined(boxes<Dim>(count, 0.5, Vec<Dim>::Zero()), boxes<Dim>(count, 0.5, from));
			for (const auto& [parts, expected] :
			     { std::pair(partsBySharedNodes<Dim>(all, Grid<Dim>()), byNodes), std::pair(partsByTouch<Dim>(all, 0.01, 1), byTouch) }) {
				EXPECT_EQ(parts.front(), 0);
				EXPECT_EQ(*std::max_element(parts.begin(), parts.end()) + 1, expected) << gap;
			}
			std::vector<int> owners(all.size(), 7);
			std::fill(owners.begin(), owners.begin() + all.size() / 2, 3);
			EXPECT_EQ(sharingNodes<Dim>(all, owners, Vec<Dim>::Zero(), 1).size(), gap < 1 ? 1u : 0u) << gap;
		}
	}

	/// Where cells are halved a gap of a small cell parts, elsewhere one of a large cell.
	TYPED_TEST(PartsOfBody, GapsPartByTheCellsAroundThem)
	{
		constexpr int    Dim   = TypeParam::value;
		const Index<Dim> count = Index<Dim>::Constant(4);
		for (const auto& [start, gap, expected] : { std::tuple(0., 0.5, 2), std::tuple(0., 0.3, 1), std::tuple(20., 0.5, 1), std::tuple(20., 1., 2) }) {
			Vec<Dim> from = Vec<Dim>::Zero(), to = from;
			from[0] = start, to[0] = start + 2 + gap;
			const auto grid  = refinedGrid<Dim>({ { Vec<Dim>::Constant(-10), Vec<Dim>::Constant(10), 1 } });
			const auto parts = partsBySharedNodes<Dim>(joined(boxes<Dim>(count, 0.5, from), boxes<Dim>(count, 0.5, to)), grid);
			EXPECT_EQ(*std::max_element(parts.begin(), parts.end()) + 1, expected) << start << " " << gap;
		}
	}

	/// The outline of a block is closed, has its area but for rounded edges, and exact faces; normals lead
	/// outwards.
	TYPED_TEST(PartsOfBody, OutlineGoesAroundABlock)
	{
		constexpr int  Dim     = TypeParam::value;
		const Vec<Dim> from    = Vec<Dim>::Constant(0.137);
		const auto     all     = boxes<Dim>(Index<Dim>::Constant(8), 0.25, from);
		const auto     surface = outline<Dim>(all, Vec<Dim>::Zero(), 0.125);
		ASSERT_TRUE(surface.isClosed());
		double   volume = 0, area = 0;
		Vec<Dim> low = surface.vertices[0], high = low, sum = Vec<Dim>::Zero();
		for (const auto& piece : surface.pieces) {
			const Vec<Dim> normal = surface.normal(piece, surface.vertices);
			EXPECT_GT(normal.norm(), 0);
			sum += normal, area += normal.norm();
			for (const int v : piece)
				volume += normal.dot(surface.vertices[v]) / (Dim * Dim);
		}
		for (const auto& x : surface.vertices)
			low = low.cwiseMin(x), high = high.cwiseMax(x);
		EXPECT_LT(sum.norm(), 1e-12);
		EXPECT_NEAR(volume, std::pow(2, Dim), 0.03 * std::pow(2, Dim));
		EXPECT_NEAR(area, Dim == 2 ? 8 : 24, Dim == 2 ? 0.3 : 2);
		EXPECT_LT((low - from).cwiseAbs().maxCoeff(), 1e-9);
		EXPECT_LT((high - from - Vec<Dim>::Constant(2)).cwiseAbs().maxCoeff(), 1e-9);
	}

	/// The nearest box, in reach of cells and out of it.
	TYPED_TEST(PartsOfBody, NearestBoxes)
	{
		constexpr int  Dim = TypeParam::value;
		const auto     all = boxes<Dim>(Index<Dim>::Constant(3), 0.5, Vec<Dim>::Zero());
		const Vec<Dim> far = Vec<Dim>::Constant(40), low = Vec<Dim>::Constant(-0.1);
		const auto     found = nearestBoxes<Dim>(all, { low, far }, 1);
		EXPECT_EQ(found[0], 0);
		EXPECT_EQ(found[1], int(all.size()) - 1);
	}

} // namespace
} // namespace gimpm::testPartsOfBody
