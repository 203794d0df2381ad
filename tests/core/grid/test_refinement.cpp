// SPDX-License-Identifier: GPL-2.0-or-later
// Cells of several sizes: which leaves there are, and the functions of their nodes.
#include "core/grid/point_nodes.hpp"
#include "refined.hpp"

namespace gimpm::testRefinement {
namespace {

	template <class Dimension> using RefinementTest = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(RefinementTest, BothDimensions, DimensionName);

	/// The sums over the nodes at each point of a nodal vector and of its slopes.
	template <int Dim> struct Field {
		std::vector<Vec<Dim>> value;
		std::vector<Mat<Dim>> gradient;

		Field(const CloudBasis<Dim>& basis, const Eigen::VectorXd& d, std::size_t points)
		        : value(points, Vec<Dim>::Zero()), gradient(points, Mat<Dim>::Zero())
		{
			forPointNodes(basis, [&](int i, const Patch<Dim>& patch, const double* weight, int count) {
				for (int n = 0; n < count; ++n) {
					const Vec<Dim> u = d.template segment<Dim>(Dim * patch.node[n]);
					value[basis.order[i]] += weight[n] * u;
					for (int a = 0; a < Dim; ++a) {
						double along = 1;
						for (int b = 0, rest = n; b < Dim; rest /= patch.nodesAlong(b), ++b) {
							const auto& axis = basis.axes[i][b];
							along *= b == a ? axis.gradient[rest % patch.nodesAlong(b)] : axis.value[rest % patch.nodesAlong(b)];
						}
						gradient[basis.order[i]].col(a) += along * u;
					}
				}
			});
		}
	};

	TYPED_TEST(RefinementTest, LeavesThatTouchDifferByOneLevelAtMost)
	{
		constexpr int Dim = TypeParam::value;
		Random        random(5);
		int           levels[4] = {};
		for (int scene = 0; scene < 5; ++scene) {
			std::vector<RefinedBox<Dim>> boxes;
			for (int b = 0; b < 3; ++b) {
				const Vec<Dim> low = 2 * (random.matrix<Dim>() + Vec<Dim>::Ones());
				boxes.push_back({ low, low + (random.matrix<Dim>() + Vec<Dim>::Ones()), random.integer(1, 3) });
			}
			const auto grid = refinedGrid<Dim>(boxes, random.matrix<Dim>());
			const int  most = 1 << grid.refinement->largest();
			forIndices<Dim>(Index<Dim>::Zero(), Index<Dim>::Constant(4 * most), [&](const Index<Dim>& i) {
				int least = 3, largest = 0;
				for (int c = 0; c < 1 << Dim; ++c) { // the cells around a node
					Index<Dim> cell = i;
					for (int a = 0; a < Dim; ++a)
						cell[a] -= c >> a & 1;
					const int level = Grid<Dim>::level(grid.refinement->leafOf(Grid<Dim>::key(cell)));
					least = std::min(least, level), largest = std::max(largest, level);
				}
				EXPECT_LE(largest - least, 1);
				EXPECT_EQ(grid.refinement->largestAt(i), largest);
				++levels[least];
			});
		}
		for (const int nodes : levels)
			EXPECT_GT(nodes, 100);
	}

	TYPED_TEST(RefinementTest, CellsThatABoxOverlapsAreHalvedAndOnlyAFewMore)
	{
		constexpr int Dim      = TypeParam::value;
		const auto    grid     = refinedGrid<Dim>({ { Vec<Dim>::Constant(2), Vec<Dim>::Constant(3), 2 } });
		int           count[3] = {};
		forLeaves<Dim>(grid, Index<Dim>::Constant(6), [&](Key leaf) { ++count[Grid<Dim>::level(leaf)]; });
		// Cells of the box, which is a largest cell: its neighbours are halved once.
		const int inside = int(std::pow(4, Dim));
		EXPECT_EQ(count[0], inside);
		EXPECT_EQ(count[1], int((std::pow(3, Dim) - 1) * std::pow(2, Dim)));
		EXPECT_EQ(count[2], int(std::pow(6, Dim) - std::pow(3, Dim)));
	}

	/// Small blocks are kept as cells, large ones as such.
	TYPED_TEST(RefinementTest, ManySmallBoxesHalveAsTheirUnionDoes)
	{
		constexpr int                Dim  = TypeParam::value;
		const int                    size = Dim == 2 ? 9 : 5;
		std::vector<RefinedBox<Dim>> cells;
		forIndices<Dim>(Index<Dim>::Zero(), Index<Dim>::Constant(size), [&](const Index<Dim>& i) {
			const Vec<Dim> middle = i.template cast<double>() / 4 + Vec<Dim>::Constant(2.125);
			cells.push_back({ middle, middle, 3 });
		});
		const auto many = refinedGrid<Dim>(cells);
		const auto one  = refinedGrid<Dim>({ { Vec<Dim>::Constant(2.125), Vec<Dim>::Constant(2.125 + (size - 1) / 4.), 3 } });
		forIndices<Dim>(Index<Dim>::Zero(), Index<Dim>::Constant(8 * (size / 4 + 4)), [&](const Index<Dim>& i) {
			ASSERT_EQ(many.refinement->leafOf(Grid<Dim>::key(i)), one.refinement->leafOf(Grid<Dim>::key(i))) << i.transpose();
		});
		Random random(3);
		for (int k = 0; k < 2000; ++k) {
			const Vec<Dim> x    = Vec<Dim>::NullaryExpr([&]() { return random.in(0, 8. * (size / 4 + 4)); });
			const Vec<Dim> half = Vec<Dim>::NullaryExpr([&]() { return k % 2 ? random.in(0, 4) : double(random.integer(0, 4)); });
			const Vec<Dim> low  = k % 3 ? x : Vec<Dim>(x.array().floor());
			ASSERT_EQ(many.refinement->levelIn(low - half, low + half), one.refinement->levelIn(low - half, low + half));
		}
	}

	TYPED_TEST(RefinementTest, ABoxMayBeUnbounded)
	{
		constexpr int Dim = TypeParam::value;
		Vec<Dim>      low = Vec<Dim>::Constant(-infinity), high = Vec<Dim>::Constant(infinity);
		low[1]          = 2;
		const auto grid = refinedGrid<Dim>({ { low, high, 1 } });
		for (const int y : { -1000, 3, 4, 100000 }) {
			Index<Dim> cell = Index<Dim>::Constant(-54321);
			cell[1]         = y;
			EXPECT_EQ(Grid<Dim>::level(grid.refinement->leafOf(Grid<Dim>::key(cell))), y < 4);
		}
	}

	TYPED_TEST(RefinementTest, LinearFieldsAreExactAtPointsOfAllSizesAndPlaces)
	{
		constexpr int Dim = TypeParam::value;
		Random        random(2);
		const auto    grid  = cornerGrid<Dim>();
		const auto    cloud = scattered<Dim>(Dim == 2 ? 400 : 1500);
		for (const Basis kind : { Basis::gimp, Basis::linear }) {
			const auto basis     = cloudBasis<Dim>(cloud, grid, kind, Boundary<Dim>());
			int        levels[3] = {};
			for (const auto& patch : basis.patches)
				levels[Grid<Dim>::level(patch.cell)] += patch.count;
			EXPECT_GT(levels[0], 20);
			EXPECT_GT(levels[1], 20);
			EXPECT_GT(levels[2], 20);
			EXPECT_GT(basis.affineConstraints.node.size(), 20u);
			const Mat<Dim>  A     = random.matrix<Dim, Dim>();
			const Vec<Dim>  b     = random.matrix<Dim>();
			Eigen::VectorXd d     = nodal<Dim>(basis, grid, [&](const Vec<Dim>& x) { return Vec<Dim>(A * x + b); });
			const auto      exact = d;
			for (const int tied : basis.affineConstraints.node)
				d.template segment<Dim>(Dim * tied).setConstant(1e9);
			basis.affineConstraints.template distribute<Dim>(d);
			EXPECT_LT((d - exact).cwiseAbs().maxCoeff(), 1e-13);
			const Field<Dim> field(basis, d, cloud.size());
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				EXPECT_LT((field.value[p] - A * cloud.position[p] - b).norm(), 1e-13);
				EXPECT_LT((field.gradient[p] - A).norm(), 1e-11);
			}
		}
	}

	/// Random displacements of the masters: what places beside each other, in cells of all sizes, have of it.
	TYPED_TEST(RefinementTest, FunctionsAreContinuousAndLinearInLeaves)
	{
		constexpr int   Dim  = TypeParam::value;
		const auto      grid = cornerGrid<Dim>();
		Random          random(7);
		PointCloud<Dim> cloud;
		constexpr int   pairs = 2000;
		for (int i = 0; i < pairs; ++i) { // across any face of smallest cells
			const int axis = random.integer(0, Dim - 1);
			Vec<Dim>  x    = Vec<Dim>::NullaryExpr([&]() { return random.in(0.01, 2.99); });
			x[axis]        = random.integer(1, 11) * grid.cellSize;
			for (const int side : { -1, 1 })
				addPoint<Dim>(cloud, x + side * 1e-7 * Vec<Dim>::Unit(axis), Vec<Dim>::Constant(1e-9));
		}
		const auto      basis = cloudBasis<Dim>(cloud, grid, Basis::linear, Boundary<Dim>());
		Eigen::VectorXd d     = random.vector(Dim * int(basis.nodes.size()));
		basis.affineConstraints.template distribute<Dim>(d);
		const Field<Dim> field(basis, d, cloud.size());
		int              kinks = 0;
		for (int i = 0; i < pairs; ++i) {
			EXPECT_LT((field.value[2 * i] - field.value[2 * i + 1]).norm(), 1e-5);
			const auto leaf = [&](int p) {
				return grid.refinement->leafOf(Grid<Dim>::key((cloud.position[p] / grid.cellSize).array().floor().template cast<int>()));
			};
			const double kink = (field.gradient[2 * i] - field.gradient[2 * i + 1]).norm();
			if (leaf(2 * i) == leaf(2 * i + 1)) EXPECT_LT(kink, 1e-5);
			else
				kinks += kink > 1e-2;
		}
		EXPECT_GT(kinks, pairs / 4);
	}

	/// A large domain reaches into small cells: all nodes that it needs are there, and what it does not see of the
	/// large cells is tied to them.
	TYPED_TEST(RefinementTest, MastersAreTiedToNoneAndWeightsAddUpToOne)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    grid  = cornerGrid<Dim>();
		const auto    basis = cloudBasis<Dim>(scattered<Dim>(30), grid, Basis::gimp, Boundary<Dim>());
		for (std::size_t t = 0; t < basis.affineConstraints.node.size(); ++t) {
			double sum = 0;
			for (int m = basis.affineConstraints.start[t]; m < basis.affineConstraints.start[t + 1]; ++m) {
				EXPECT_FALSE(basis.affineConstraints.contains(basis.affineConstraints.master[m]));
				EXPECT_GE(
				        Grid<Dim>::level(basis.nodes[basis.affineConstraints.master[m]]),
				        Grid<Dim>::level(basis.nodes[basis.affineConstraints.node[t]]));
				sum += basis.affineConstraints.weight[m];
			}
			EXPECT_NEAR(sum, 1, 1e-14);
		}
		EXPECT_TRUE(std::is_sorted(basis.affineConstraints.node.begin(), basis.affineConstraints.node.end()));
		EXPECT_TRUE(std::is_sorted(basis.nodes.begin(), basis.nodes.end()));
	}

	TYPED_TEST(RefinementTest, WhereNoCellIsLargerTheBasisIsThatOfEqualCells)
	{
		constexpr int   Dim   = TypeParam::value;
		const auto      cloud = scattered<Dim>(100);
		auto            grid  = refinedGrid<Dim>({ { Vec<Dim>::Constant(-infinity), Vec<Dim>::Constant(infinity), 1 } });
		PointCloud<Dim> small = cloud;
		for (auto& half : small.halfSize)
			half /= 2;
		const auto refined = cloudBasis<Dim>(small, grid, Basis::gimp, Boundary<Dim>());
		grid.refinement.reset();
		const auto equal = cloudBasis<Dim>(small, grid, Basis::gimp, Boundary<Dim>());
		EXPECT_EQ(refined.nodes, equal.nodes);
		EXPECT_EQ(refined.cells, equal.cells);
		EXPECT_EQ(refined.order, equal.order);
		EXPECT_TRUE(refined.affineConstraints.empty());
	}

} // namespace
} // namespace gimpm::testRefinement
