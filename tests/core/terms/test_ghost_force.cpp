// SPDX-License-Identifier: GPL-2.0-or-later
// The ghost stiffness (Coombs 2023, eqs. 2 to 6) against fields for which its force is known by hand.
#include "scenes.hpp"
#include <Eigen/Eigenvalues>

namespace gimpm::testGhostForce {
namespace {

	/// A body of points with one Young's modulus, all surfaces free, and its ghost faces.
	template <int Dim> struct Body {
		Grid<Dim>                   grid;
		CloudBasis<Dim>             basis;
		std::vector<GhostFace<Dim>> faces;

		Body(const PointCloud<Dim>& cloud, const Grid<Dim>& g, double young, double factor, GhostScaling scaling = GhostScaling::meshIndependent)
		        : grid(g)
		        , basis(cloudBasis<Dim>(cloud, g, Basis::gimp, Boundary<Dim>()))
		        , faces(ghostFaces<Dim>(basis.cells, boundaryCells<Dim>(basis.cells, Boundary<Dim>()), Boundary<Dim>()))
		{
			const auto stiffnessOf = [&](int p) { return VolumeAndModulus { cloud.volume0[p], young }; };
			weighGhostFaces<Dim>(faces, basis, stiffnessOf, g, factor, scaling);
		}
		Eigen::VectorXd force(const Eigen::VectorXd& d) const
		{
			Eigen::VectorXd f = Eigen::VectorXd::Zero(d.size());
			addGhostForce<Dim>(faces, grid.cellSize, d, f);
			return f;
		}
		Eigen::MatrixXd stiffness() const
		{
			NodeMatrix<Dim> K;
			K.reset(basis.nodes);
			markGhostPattern<Dim>(faces, K);
			addGhostStiffness<Dim>(faces, grid.cellSize, K);
			return dense(K);
		}
		/// Force at the node with these coordinates in cells.
		Vec<Dim> at(const Eigen::VectorXd& f, const Index<Dim>& node) const
		{
			const auto n = std::lower_bound(basis.nodes.begin(), basis.nodes.end(), Grid<Dim>::key(node)) - basis.nodes.begin();
			return f.segment<Dim>(Dim * n);
		}
	};

	/// A ragged body of random points.
	template <int Dim> Body<Dim> ragged()
	{
		Random          random(3);
		const Grid<Dim> grid { 0.4, -0.1 * Vec<Dim>::Ones() };
		PointCloud<Dim> cloud;
		for (int i = 0; i < (Dim == 2 ? 40 : 60); ++i)
			addPoint<Dim>(cloud, random.matrix<Dim>(), 0.2 * Vec<Dim>::NullaryExpr([&]() { return random.in(0.1, 1); }));
		return { cloud, grid, 2e5, 0.3 };
	}

	template <class Dimension> using GhostForce = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(GhostForce, BothDimensions, DimensionName);

	TYPED_TEST(GhostForce, TranslationsAndLinearFieldsGiveNone)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    body = ragged<Dim>();
		ASSERT_GT(body.faces.size(), 10u);
		Random         random;
		const Mat<Dim> gradient    = random.matrix<Dim, Dim>();
		const Vec<Dim> translation = random.matrix<Dim>();
		const auto     d           = nodal<Dim>(body.basis, body.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(translation + gradient * x); });
		// against the force of a field of the same size that is not linear
		const double size = body.force(random.vector(d.size())).norm();
		EXPECT_LT(body.force(d).norm(), 1e-14 * size);
		EXPECT_LT((body.stiffness() * d).norm(), 1e-14 * size);
	}

	TYPED_TEST(GhostForce, IsTheStiffnessTimesTheDisplacements)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    body = ragged<Dim>();
		const auto    K    = body.stiffness();
		Random        random;
		for (int i = 0; i < 5; ++i) {
			const Eigen::VectorXd d = random.vector(K.cols()), f = body.force(d);
			EXPECT_LT((K * d - f).norm(), 1e-14 * f.norm());
		}
	}

	/// Kinks of what it begins from cost nothing.
	TYPED_TEST(GhostForce, CountsFromWhatItIsGiven)
	{
		constexpr int          Dim  = TypeParam::value;
		const auto             body = ragged<Dim>();
		Random                 random(4);
		const Eigen::VectorXd  from = random.vector(Dim * int(body.basis.nodes.size())), d = random.vector(int(from.size()));
		gimpm::GhostForce<Dim> ghost(body.faces, body.grid.cellSize, from);
		for (const auto& [at, expected] : { std::pair(from, Eigen::VectorXd(0 * from)), std::pair(d, body.force(d - from)) }) {
			Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
			ghost.add(at, { force });
			EXPECT_LE((force - expected).norm(), 1e-12 * body.force(d).norm());
		}
	}

	TYPED_TEST(GhostForce, StiffnessIsSymmetricAndSemidefinite)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    body = ragged<Dim>();
		const auto    K    = body.stiffness();
		EXPECT_EQ((K - K.transpose()).norm(), 0);
		const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues();
		EXPECT_GT(eigenvalues.maxCoeff(), 0);
		EXPECT_GT(eigenvalues.minCoeff(), -1e-13 * eigenvalues.maxCoeff());
	}

	TYPED_TEST(GhostForce, ScalingsDifferByTheSquareOfTheCellSize)
	{
		constexpr int Dim = TypeParam::value;
		for (const double h : { 1., 0.01, 50. }) {
			const Grid<Dim> grid { h, Vec<Dim>::Zero() };
			const auto      cloud = block<Dim>(grid, Index<Dim>::Constant(2), 2);
			const Body<Dim> paper(cloud, grid, 1, 1, GhostScaling::paper), consistent(cloud, grid, 1, 1, GhostScaling::meshIndependent);
			ASSERT_FALSE(paper.faces.empty());
			for (std::size_t i = 0; i < paper.faces.size(); ++i)
				EXPECT_DOUBLE_EQ(paper.faces[i].stiffness, h * h * consistent.faces[i].stiffness);
		}
	}

	// Two cells with one face at x = h, and displacements that are zero below it and grow by k (x - h) above it, so
	// that the normal derivative jumps by k. The derivatives of the nodal functions below, on and above the face
	// jump by (1, -2, 1) / h.
	//   f = (gamma h / 3) (1, -2, 1) / h * integral over the face of k N_s
	constexpr double young = 3e4, factor = 0.05, h = 0.5, k = 0.02;
	constexpr double gamma3 = factor * young * h / 3; // 250: gamma h / 3

	TEST(GhostForceByHand, KinkIn2D)
	{
		const Grid<2> grid { h, { 0, 0 } };
		const Body<2> body(block<2>(grid, { 2, 1 }, 2), grid, young, factor),
		        paper(block<2>(grid, { 2, 1 }, 2), grid, young, factor, GhostScaling::paper);
		ASSERT_EQ(body.faces.size(), 1u);
		const auto d = nodal<2>(body.basis, grid, [](const Vec<2>& x) { return Vec<2>(k * std::max(x[0] - h, 0.), 0); });
		const auto f = body.force(d), p = paper.force(d);
		for (int y = 0; y < 2; ++y) {
			// the integral of N_s is h/2: 250 * 0.02 / 2 = 2.5
			EXPECT_NEAR(body.at(f, { 0, y })[0], 2.5, 1e-13);
			EXPECT_NEAR(body.at(f, { 1, y })[0], -5, 1e-13);
			EXPECT_NEAR(body.at(f, { 2, y })[0], 2.5, 1e-13);
			for (int x = 0; x < 3; ++x) {
				EXPECT_EQ(body.at(f, { x, y })[1], 0);
				// eq. (2) has h^3.
				EXPECT_NEAR(body.at(p, { x, y })[0], h * h * body.at(f, { x, y })[0], 1e-14);
			}
		}
	}

	TEST(GhostForceByHand, KinkThatGrowsAlongTheFaceIn2D)
	{
		const Grid<2> grid { h, { 0, 0 } };
		const Body<2> body(block<2>(grid, { 1, 2 }, 2), grid, young, factor); // face at y = h
		const auto    f = body.force(nodal<2>(body.basis, grid, [](const Vec<2>& x) { return Vec<2>(k * x[0] / h * std::max(x[1] - h, 0.), 0); }));
		// jump k x / h: its integrals with N_s are h/6 at x = 0 and h/3 at x = h
		const double share[] = { 1. / 6, 1. / 3 }, jump[] = { 1, -2, 1 };
		for (int x = 0; x < 2; ++x)
			for (int y = 0; y < 3; ++y)
				EXPECT_NEAR(body.at(f, { x, y })[0], gamma3 * k * share[x] * jump[y], 1e-13);
	}

	TEST(GhostForceByHand, KinkIn3D)
	{
		const Grid<3> grid { h, { 0, 0, 0 } };
		for (int axis = 0; axis < 3; ++axis) {
			Index<3> cells = Index<3>::Ones();
			cells[axis]    = 2;
			const Body<3> body(block<3>(grid, cells, 2), grid, young, factor);
			ASSERT_EQ(body.faces.size(), 1u);
			for (int component = 0; component < 3; ++component) {
				const auto f = body.force(
				        nodal<3>(body.basis, grid, [&](const Vec3& x) { return Vec3(k * std::max(x[axis] - h, 0.) * Vec3::Unit(component)); }));
				// the integral of N_s is h^2/4
				forIndices<3>({ 0, 0, 0 }, cells + Index<3>::Ones(), [&](const Index<3>& node) {
					const double expected = gamma3 * k * h / 4 * (node[axis] == 1 ? -2 : 1);
					EXPECT_LT((body.at(f, node) - expected * Vec3::Unit(component)).norm(), 1e-13);
				});
			}
		}
	}

	TEST(GhostForceByHand, KinkThatGrowsAlongTheFaceIn3D)
	{
		const Grid<3> grid { h, { 0, 0, 0 } };
		const Body<3> body(block<3>(grid, { 1, 2, 1 }, 2), grid, young, factor); // face at y = h
		const auto    f
		        = body.force(nodal<3>(body.basis, grid, [](const Vec3& x) { return Vec3(0, 0, k * x[0] * x[2] / (h * h) * std::max(x[1] - h, 0.)); }));
		// jump k x z / h^2: its integral with N_s is the product of h/6 (at 0) or h/3 (at h) of the two
		// directions
		const double share[] = { 1. / 6, 1. / 3 }, jump[] = { 1, -2, 1 };
		forIndices<3>({ 0, 0, 0 }, { 2, 3, 2 }, [&](const Index<3>& n) {
			EXPECT_NEAR(body.at(f, n)[2], gamma3 * k * h * share[n[0]] * share[n[2]] * jump[n[1]], 1e-13);
		});
	}

} // namespace
} // namespace gimpm::testGhostForce
