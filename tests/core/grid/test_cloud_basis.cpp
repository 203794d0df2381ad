// SPDX-License-Identifier: GPL-2.0-or-later
// Populated cells, active nodes, patches and colours of a cloud of points, without walls.
#include "core/grid/mixed_cells.hpp"
#include "scenes.hpp"
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace gimpm {
namespace {

	template <class Dimension> class CloudBasisTest : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Grid<Dim>     grid { 0.3, 0.7 * Vec<Dim>::Ones() };
		Boundary<Dim> none;

		/// Random points, some of them on faces, some with a domain that ends on one.
		PointCloud<Dim> cloud(int points = 300)
		{
			Random          random(7);
			PointCloud<Dim> c;
			for (int i = 0; i < points; ++i) {
				Vec<Dim> x, l;
				for (int a = 0; a < Dim; ++a) {
					l[a]              = 0.3 * random.in(0.01, 0.5);
					const double at[] = { random.in(-4, 4), double(random.integer(-4, 4)), random.integer(-4, 4) + l[a] / 0.3 };
					x[a]              = 0.7 + 0.3 * at[random.integer(0, 2)];
				}
				addPoint<Dim>(c, x, l);
			}
			return c;
		}

		/// Cells that the point's domain overlaps, found by comparing intervals.
		std::set<Key> overlapped(const PointCloud<Dim>& c, int p) const
		{
			const double  h = grid.cellSize;
			std::set<Key> cells;
			forIndices<Dim>(Index<Dim>::Constant(-7), Index<Dim>::Constant(14), [&](const Index<Dim>& i) {
				const Vec<Dim> lower = grid.nodePosition(i), x = c.position[p], l = (1 - 1e-6) * c.halfSize[p];
				if (((x + l).array() > lower.array()).all() && ((x - l).array() < lower.array() + h).all()) cells.insert(Grid<Dim>::key(i));
			});
			return cells;
		}
	};
	TYPED_TEST_SUITE(CloudBasisTest, BothDimensions, DimensionName);

	/// Calls f(key of the node, its number in the patch) for the nodes of the window of a patch.
	template <int Dim, class F> void forWindow(const Patch<Dim>& patch, F&& f)
	{
		Index<Dim> size;
		for (int a = 0; a < Dim; ++a)
			size[a] = patch.nodesAlong(a);
		int local = 0;
		forIndices<Dim>(Grid<Dim>::index(patch.cell), size, [&](const Index<Dim>& i) { f(Grid<Dim>::key(i), patch.node[local++]); });
	}

	TYPED_TEST(CloudBasisTest, MixedCellsAreThoseThatDomainsOfTwoMaterialsOverlap)
	{
		constexpr int Dim = TypeParam::value;
		auto          c   = this->cloud(60);
		Random        random(11);
		for (int& material : c.material)
			material = random.integer(0, 2);
		std::map<Key, std::set<int>> materials;
		for (int p = 0; p < int(c.size()); ++p)
			for (const Key cell : this->overlapped(c, p))
				materials[cell].insert(c.material[p]);
		const auto basis = cloudBasis<Dim>(c, this->grid, Basis::gimp, this->none);
		const auto mixed = mixedCells(basis, c.material);
		int        count = 0;
		for (std::size_t i = 0; i < basis.cells.size(); ++i) {
			EXPECT_EQ(bool(mixed[i]), materials.at(basis.cells[i]).size() > 1);
			count += mixed[i];
		}
		EXPECT_GT(count, 0);
		EXPECT_LT(count, int(mixed.size()));
		std::fill(c.material.begin(), c.material.end(), 1);
		for (const char m : mixedCells(basis, c.material))
			EXPECT_FALSE(m);
	}

	TYPED_TEST(CloudBasisTest, PopulatedCellsAreThoseThatADomainOverlaps)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    cloud = this->cloud();
		std::set<Key> expected;
		for (std::size_t p = 0; p < cloud.size(); ++p)
			expected.merge(this->overlapped(cloud, p));
		const auto basis = cloudBasis<Dim>(cloud, this->grid, Basis::gimp, this->none);
		EXPECT_EQ(basis.cells, std::vector<Key>(expected.begin(), expected.end()));
		EXPECT_EQ(basis.largestWallOverlap, 0);
	}

	TYPED_TEST(CloudBasisTest, ActiveNodesAreTheCornersOfPopulatedCells)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    basis = cloudBasis<Dim>(this->cloud(), this->grid, Basis::gimp, this->none);
		std::set<Key> corners;
		for (const Key cell : basis.cells)
			forIndices<Dim>(Grid<Dim>::index(cell), Index<Dim>::Constant(2), [&](const Index<Dim>& i) { corners.insert(Grid<Dim>::key(i)); });
		EXPECT_EQ(basis.nodes, std::vector<Key>(corners.begin(), corners.end())); // sorted, each once
	}

	TYPED_TEST(CloudBasisTest, LinearBasisPopulatesOnlyTheCellsOfTheCentres)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    cloud = this->cloud();
		std::set<Key> expected;
		for (const auto& x : cloud.position) {
			Index<Dim> cell;
			for (int a = 0; a < Dim; ++a)
				cell[a] = int(std::ceil((x[a] - 0.7) / 0.3 - 1e-6)) - 1; // a face belongs to the lower cell
			expected.insert(Grid<Dim>::key(cell));
		}
		const auto basis = cloudBasis<Dim>(cloud, this->grid, Basis::linear, this->none);
		EXPECT_EQ(basis.cells, std::vector<Key>(expected.begin(), expected.end()));
	}

	TYPED_TEST(CloudBasisTest, PatchesHoldEveryPointOnce)
	{
		constexpr int    Dim    = TypeParam::value;
		const auto       basis  = cloudBasis<Dim>(this->cloud(), this->grid, Basis::gimp, this->none);
		std::vector<int> points = basis.order, all(300);
		std::sort(points.begin(), points.end());
		std::iota(all.begin(), all.end(), 0);
		EXPECT_EQ(points, all);
		int next = 0;
		for (const auto& patch : basis.patches) {
			EXPECT_EQ(patch.first, next);
			EXPECT_GT(patch.count, 0);
			next += patch.count;
		}
		EXPECT_EQ(next, 300);
	}

	TYPED_TEST(CloudBasisTest, PatchesNameTheNodesOfTheirWindow)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    basis = cloudBasis<Dim>(this->cloud(), this->grid, Basis::gimp, this->none);
		for (const auto& patch : basis.patches)
			forWindow<Dim>(patch, [&](Key key, int number) {
				ASSERT_GE(number, 0);
				EXPECT_EQ(basis.nodes[number], key);
			});
	}

	TYPED_TEST(CloudBasisTest, WeightedNodePositionsAreThePointsPosition)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    cloud = this->cloud();
		const auto    basis = cloudBasis<Dim>(cloud, this->grid, Basis::gimp, this->none);
		for (const auto& patch : basis.patches)
			for (int i = patch.first; i < patch.first + patch.count; ++i) {
				Vec<Dim> x   = Vec<Dim>::Zero();
				double   sum = 0;
				forWindow<Dim>(patch, [&](Key key, int) {
					const Index<Dim> node   = Grid<Dim>::index(key);
					double           weight = 1;
					for (int a = 0; a < Dim; ++a)
						weight *= basis.axes[i][a].value[node[a] - Grid<Dim>::index(patch.cell)[a]];
					x += weight * this->grid.nodePosition(node);
					sum += weight;
				});
				EXPECT_NEAR(sum, 1, 1e-14);
				EXPECT_LT((x - cloud.position[basis.order[i]]).norm(), 1e-14);
			}
	}

	TYPED_TEST(CloudBasisTest, NumberingDoesNotDependOnTheOrderOfPoints)
	{
		constexpr int   Dim   = TypeParam::value;
		const auto      cloud = this->cloud();
		PointCloud<Dim> reversed;
		for (int p = 299; p >= 0; --p)
			addPoint<Dim>(reversed, cloud.position[p], cloud.halfSize[p]);
		const auto a = cloudBasis<Dim>(cloud, this->grid, Basis::gimp, this->none), b = cloudBasis<Dim>(reversed, this->grid, Basis::gimp, this->none);
		EXPECT_EQ(a.nodes, b.nodes);
		EXPECT_EQ(a.cells, b.cells);
		EXPECT_EQ(a.colours, b.colours);
		ASSERT_EQ(a.patches.size(), b.patches.size());
		for (std::size_t i = 0; i < a.patches.size(); ++i) {
			EXPECT_EQ(a.patches[i].cell, b.patches[i].cell);
			EXPECT_EQ(a.patches[i].node, b.patches[i].node);
			std::set<int> ofA, ofB;
			for (int k = a.patches[i].first; k < a.patches[i].first + a.patches[i].count; ++k)
				ofA.insert(a.order[k]), ofB.insert(299 - b.order[k]);
			EXPECT_EQ(ofA, ofB);
		}
	}

	TYPED_TEST(CloudBasisTest, RangesOfOneColourShareNoNode)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    basis = cloudBasis<Dim>(this->cloud(3000), this->grid, Basis::gimp, this->none);
		std::set<int> patches;
		for (const auto& colour : basis.colours) {
			std::set<int> nodes;
			for (const auto& [first, last] : colour) {
				std::set<int> ofRange;
				for (int p = first; p < last; ++p) {
					EXPECT_TRUE(patches.insert(p).second) << "patch " << p << " has two colours";
					for (const int n : basis.patches[p].node)
						if (n >= 0) ofRange.insert(n);
				}
				for (const int n : ofRange)
					EXPECT_TRUE(nodes.insert(n).second) << "node " << n << " is shared";
			}
		}
		EXPECT_EQ(patches.size(), basis.patches.size());
	}

	TYPED_TEST(CloudBasisTest, FarFromTheOriginNothingChanges)
	{
		constexpr int Dim = TypeParam::value;
		constexpr int far = Dim == 2 ? 900000 : 250000;
		Grid<Dim>     grid;
		for (const int shift : { 0, -far, far }) {
			const auto cells = block<Dim>(grid, Index<Dim>::Constant(3), 3, Index<Dim>::Constant(shift));
			const auto basis = cloudBasis<Dim>(cells, grid, Basis::gimp, this->none);
			EXPECT_EQ(int(basis.cells.size()), Dim == 2 ? 9 : 27) << shift;
			EXPECT_EQ(int(basis.nodes.size()), Dim == 2 ? 16 : 64) << shift;
			EXPECT_EQ(Grid<Dim>::index(basis.cells.front()), Index<Dim>::Constant(shift));
			EXPECT_EQ(Grid<Dim>::index(basis.nodes.back()), Index<Dim>::Constant(shift + 3));
		}
	}

	TYPED_TEST(CloudBasisTest, KeysAreSortedAndReversibleUpToTheIndexLimit)
	{
		constexpr int Dim      = TypeParam::value;
		constexpr int limit    = Grid<Dim>::indexLimit;
		Key           previous = 0;
		for (const int i : { -limit, -limit + 1, -2, -1, 0, 1, limit - 1, limit }) {
			// Neighbours of the last node must not reach the next axis.
			Index<Dim> index = Index<Dim>::Constant(limit);
			index[Dim - 1]   = i;
			const Key key    = Grid<Dim>::key(index);
			EXPECT_EQ(Grid<Dim>::index(key), index);
			EXPECT_GT(key, previous);
			previous = key;
			for (int a = 0; a < Dim - 1; ++a)
				EXPECT_EQ(Grid<Dim>::index(key + 2 * Grid<Dim>::keyStep(a) - Grid<Dim>::keyStep(a)), index + Index<Dim>::Unit(a));
		}
	}

	TYPED_TEST(CloudBasisTest, NoPointsNoNodes)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    basis = cloudBasis<Dim>(PointCloud<Dim>(), this->grid, Basis::gimp, this->none);
		EXPECT_TRUE(basis.nodes.empty());
		EXPECT_TRUE(basis.cells.empty());
		EXPECT_TRUE(basis.patches.empty());
	}

} // namespace
} // namespace gimpm
