// SPDX-License-Identifier: GPL-2.0-or-later
// Soil on the two sides of thin bodies, on cells of one and of several sizes.
#include "core/grid/point_nodes.hpp"
#include "core/structures/rigid_lines.hpp"
#include "core/structures/rigid_sheets.hpp"
#include "core/terms/ghost.hpp"
#include "refined.hpp"

namespace gimpm::testPartedSizes {
namespace {

	/// Corners of a plate with a tip: in space from z = -1 to 4, through all of the block.
	template <int Dim> std::vector<RigidBody<Dim>> plate(const Vec<2>& head, const Vec<2>& tip)
	{
		std::vector<RigidBody<Dim>> bodies(Dim - 1);
		const auto                  at = [](const Vec<2>& x, double z) {
                        Vec<Dim> position           = Vec<Dim>::Constant(z);
                        position.template head<2>() = x;
                        return position;
		};
		for (auto& body : bodies)
			body.shape.kind = RigidKind::sheet, body.shape.isTwoSided = true;
		if constexpr (Dim == 2) bodies[0].shape.corners = { head, tip };
		else {
			bodies[0].shape.corners = { at(head, -1), at(tip, -1), at(head, 4) };
			bodies[1].shape.corners = { at(tip, 4), at(tip, -1), at(head, 4) };
		}
		return bodies;
	}

	/// A block of points of any size that a plate goes into, beside them.
	template <int Dim> struct Sides {
		Grid<Dim>       grid;
		PointCloud<Dim> cloud;
		Vec<2>          head, along;
		CloudBasis<Dim> basis;
		int             sign = 1; ///< of the side with the layer of its own

		Sides(const Grid<Dim>& cells, const Vec<2>& from, const Vec<2>& to) : grid(cells), head(from), along(to - from)
		{
			const auto   all  = scattered<Dim>(Dim == 2 ? 3000 : 6000);
			const Vec<2> side = Vec<2>(-along[1], along[0]).normalized();
			for (std::size_t p = 0; p < all.size(); ++p) {
				const Vec<Dim> half    = all.halfSize[p].cwiseMin(largestHalf(grid, all.position[p]));
				const double   away    = std::abs(side.dot(all.position[p].template head<2>() - head));
				const bool     isBelow = all.position[p][1] + half[1] < std::min(from[1], to[1]);
				if (isBelow || away > side.cwiseAbs().dot(half.template head<2>())) addPoint<Dim>(cloud, all.position[p], half);
			}
			const auto bodies = plate<Dim>(from, to);
			if constexpr (Dim == 2) part(linesOf(bodies, grid));
			else
				part(sheetsOf(bodies, grid));
			basis = cloudBasis<Dim>(cloud, grid, Basis::gimp, Boundary<Dim>());
		}

		bool isAside(const Vec<Dim>& x) const
		{
			const Vec<2> off = x.template head<2>() - head;
			return sign * (along[0] * off[1] - along[1] * off[0]) < 0;
		}

		/// Nodal values of two fields, of which nodes that are there twice have one each; tied nodes by their
		/// masters.
		template <class F> Eigen::VectorXd fields(F&& f) const
		{
			Eigen::VectorXd d(Dim * basis.nodes.size());
			for (std::size_t n = 0; n < basis.nodes.size(); ++n) {
				const Key      node = basis.nodes[n];
				const Vec<Dim> x    = grid.nodePosition(Grid<Dim>::index(node));
				const bool     is   = Grid<Dim>::layer(node) > 0 || (isAside(x) && !grid.parting->isOwn(Parting<Dim>::in(1, node)));
				d.template segment<Dim>(Dim * n) = f(is, x);
			}
			basis.affineConstraints.template distribute<Dim>(d);
			return d;
		}
		std::vector<Vec<Dim>> valuesAtPoints(const Eigen::VectorXd& d) const
		{
			std::vector<Vec<Dim>> value(cloud.size(), Vec<Dim>::Zero());
			forPointNodes(basis, [&](int i, const Patch<Dim>& patch, const double* weight, int count) {
				for (int n = 0; n < count; ++n)
					value[basis.order[i]] += weight[n] * d.template segment<Dim>(Dim * patch.node[n]);
			});
			return value;
		}
		/// The force by which a field strains the ghost faces.
		double ghostForce(const Eigen::VectorXd& d)
		{
			auto faces = ghostFaces<Dim>(basis.populatedLeaves(), boundaryCells<Dim>(basis.populatedLeaves(), {}, grid), {}, grid);
			EXPECT_FALSE(faces.empty());
			for (auto& face : faces) {
				for (int i = 0; i < 3; ++i)
					for (int s = 0; s < GhostFace<Dim>::tangentialNodes; ++s)
						EXPECT_EQ(basis.nodes.at(face.node[i][s] = position(basis.nodes, face.key(i, s))), face.key(i, s));
				face.stiffness = 1;
			}
			Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
			addGhostForce<Dim>(faces, grid.cellSize, d, force);
			basis.affineConstraints.template condense<Dim>(force);
			return force.cwiseAbs().maxCoeff();
		}

	private:
		template <class Surface> void part(std::vector<Surface> surfaces)
		{
			ASSERT_EQ(surfaces.size(), 1u);
			partSoil({ &surfaces[0] }, cloud, grid);
			ASSERT_EQ(surfaces[0].layer, 1);
			for (std::size_t p = 0; p < cloud.size(); ++p)
				if (cloud.layer[p] == 1) sign = isAside(cloud.position[p]) ? sign : -sign, p = cloud.size() - 1;
		}
	};

	template <class Dimension> using PartedSizes = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(PartedSizes, BothDimensions, DimensionName);

	template <int Dim> std::array<Grid<Dim>, 2> grids()
	{
		Grid<Dim> equal;
		equal.cellSize = 0.5;
		return { equal, cornerGrid<Dim>() };
	}

	/// Through all of a block: each side has its linear field, of which points and ghost faces of the other one
	/// have nothing.
	TYPED_TEST(PartedSizes, SidesHaveFieldsOfTheirOwn)
	{
		constexpr int Dim = TypeParam::value;
		Random        random(4);
		for (const auto& grid : grids<Dim>())
			for (const auto& [from, to] : { std::pair(Vec<2>(0.4, -1), Vec<2>(0.4, 4)), std::pair(Vec<2>(-1, -0.7), Vec<2>(5, 2.9)),
			                                std::pair(Vec<2>(1, 4), Vec<2>(1, -1)) }) {
				Sides<Dim>     sides(grid, from, to);
				const Mat<Dim> A[2]     = { random.matrix<Dim, Dim>(), random.matrix<Dim, Dim>() };
				const auto     field    = [&](bool is, const Vec<Dim>& x) { return Vec<Dim>(A[is] * x + Vec<Dim>::Constant(is)); };
				const auto     d        = sides.fields(field);
				const auto     value    = sides.valuesAtPoints(d);
				int            count[2] = {};
				for (std::size_t p = 0; p < sides.cloud.size(); ++p) {
					const Vec<Dim>& x = sides.cloud.position[p];
					EXPECT_LT((value[p] - field(sides.isAside(x), x)).norm(), 1e-12) << x.transpose();
					EXPECT_TRUE(sides.isAside(x) || sides.cloud.layerOf(int(p)) == 0);
					++count[sides.cloud.layerOf(int(p))];
				}
				EXPECT_GT(std::min(count[0], count[1]), 60);
				EXPECT_LT(sides.ghostForce(d), 1e-11);
			}
	}

	/// Around the tip soil is one body, and a linear field of both sides is seen by no ghost face.
	TYPED_TEST(PartedSizes, ATipLeavesSoilWhole)
	{
		constexpr int Dim = TypeParam::value;
		Random        random(5);
		for (const auto& grid : grids<Dim>())
			for (const Vec<2>& tip : { Vec<2>(0.4, 0.4), Vec<2>(0.5, 1.6), Vec<2>(0.45, 1.) }) {
				Sides<Dim>     sides(grid, { tip[0], 4 }, tip);
				const Mat<Dim> A     = random.matrix<Dim, Dim>();
				const auto     d     = sides.fields([&](bool, const Vec<Dim>& x) { return Vec<Dim>(A * x); });
				const auto     value = sides.valuesAtPoints(d);
				for (std::size_t p = 0; p < sides.cloud.size(); ++p)
					EXPECT_LT((value[p] - A * sides.cloud.position[p]).norm(), 1e-12);
				EXPECT_LT(sides.ghostForce(d), 1e-11);
				int own = 0;
				for (const Key node : sides.basis.nodes) {
					if (!sides.grid.parting->isOwn(node)) continue;
					++own;
					EXPECT_GT(sides.grid.nodePosition(Grid<Dim>::index(node))[1], tip[1] - 1e-9);
				}
				EXPECT_GT(own, 3);
			}
	}

	RigidBody<3> facet(const Vec3& a, const Vec3& b, const Vec3& c)
	{
		RigidBody<3> body;
		body.shape.kind       = RigidKind::sheet;
		body.shape.corners    = { a, b, c };
		body.shape.isTwoSided = true;
		return body;
	}

	/// Facets in any order and direction make one surface as long as no more than two share an edge.
	TEST(RigidSheets, JoinFacetsThatShareEdges)
	{
		Grid<3> grid;
		grid.cellSize = 0.5;
		std::vector<RigidBody<3>> tube;
		const auto                at = [](int i, double z) { return Vec3(std::cos(i * M_PI / 4), std::sin(i * M_PI / 4), z); };
		for (int i = 0; i < 8; ++i) {
			tube.push_back(facet(at(i, 0), at(i + 1, 0), at(i, 1)));
			tube.push_back(facet(at(i, 1), at(i + 1, 0), at(i + 1, 1)));
		}
		const auto sheets = sheetsOf(tube, grid);
		ASSERT_EQ(sheets.size(), 1u);
		EXPECT_EQ(sheets[0].positions.size(), 16u);
		int border = 0;
		for (const auto& flags : sheets[0].isBorder)
			border += flags[0] + flags[1] + flags[2];
		EXPECT_EQ(border, 16);
		for (int i = 0; i < 16; ++i) { // before facets and before their edges, beside the tube and beyond its ends
			const Vec3 outwards(std::cos(i * M_PI / 8), std::sin(i * M_PI / 8), 0);
			for (const double z : { -0.2, 0.5, 1.3 })
				EXPECT_LT(sideOf(sheets[0], 0.7 * outwards + z * Vec3::UnitZ()) * sideOf(sheets[0], 1.3 * outwards + z * Vec3::UnitZ()), 0);
		}

		std::vector<RigidBody<3>> vane;
		for (int i = 0; i < 8; i += 2) {
			vane.push_back(facet({ 0, 0, 0 }, at(i, 0), at(i, 1)));
			vane.push_back(facet({ 0, 0, 0 }, at(i, 1), { 0, 0, 1 }));
		}
		EXPECT_EQ(sheetsOf(vane, grid).size(), 2u) << "two blades that go straight on are one";
		vane.resize(6);
		EXPECT_EQ(sheetsOf(vane, grid).size(), 2u);

		RigidBody<3> box;
		box.shape.kind     = RigidKind::block;
		box.shape.halfSize = { 1, 0.1, 2 };
		const auto alone   = sheetsOf({ box }, grid);
		ASSERT_EQ(alone.size(), 1u);
		EXPECT_EQ(alone[0].facets.size(), 2u);
		box.shape.halfSize = { 1, 0.25, 2 };
		EXPECT_TRUE(sheetsOf({ box }, grid).empty());
	}

} // namespace
} // namespace gimpm::testPartedSizes
