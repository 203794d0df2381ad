// SPDX-License-Identifier: GPL-2.0-or-later
// Assembly of one of several processes, without the others: its rows of forces and stiffness, and of the matrix that
// is solved.
#include "core/solvers/node_rows.hpp"
#include "core/stepping/step_system.hpp"
#include "springs.hpp"

namespace gimpm::testShare {
namespace {

	/// One of so many, which hears nothing of the others.
	struct OneOf : OneProcess {
		int number, all;
		OneOf(int number, int all) : number(number), all(all) { }
		int rank() const override { return number; }
		int size() const override { return all; }
	};

	template <class Dimension> struct ShareOf : InBothDimensions<Dimension> {
		static constexpr int Dim = Dimension::value;

		/// A block that hangs on its lowest layer, with points off the middle of the cells, of a law with a
		/// symmetric tangent or another.
		static Model<Dim> model(bool isSymmetric)
		{
			Model<Dim> m;
			m.boundary  = Boundary<Dim>({ wallBelow<Dim>(m.grid, Dim - 1, 0) });
			m.materials = { { Hencky(1e6, 0.3), 2000 } };
			if (!isSymmetric) m.materials = { { MohrCoulomb(1e6, 0.3, 10, 0.5, 0), 2000 } };
			return m;
		}
		static PointCloud<Dim> cloud(const Grid<Dim>& grid)
		{
			auto c = block(grid, cellsOf<Dim>(5, 5, 6), 2);
			for (auto& x : c.position)
				x.array() += 0.3;
			return c;
		}
	};
	TYPED_TEST_SUITE(ShareOf, BothDimensions, DimensionName);

	TYPED_TEST(ShareOf, OwnRowsOfForcesAndStiffnessAreComplete)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool isSymmetric : { true, false }) {
			auto                  model = TestFixture::model(isSymmetric);
			const auto            cloud = TestFixture::cloud(model.grid);
			StepReport            report;
			const StepSystem<Dim> whole(cloud, model, {}, report);
			Random                numbers(1);
			Eigen::VectorXd       d = Eigen::VectorXd::NullaryExpr(whole.nodalSize(), [&] { return numbers.in(-0.02, 0.02); }), force,
			                absoluteContributions;
			NodeMatrix<Dim> K;
			whole.prepare(K);
			ASSERT_FALSE(whole.evaluate(d, force, &K, &absoluteContributions));
			const Eigen::MatrixXd all = dense(K);
			for (const int processes : { 2, 3 })
				for (int rank = 0, next = 0; rank < processes; ++rank) {
					model.processes = std::make_shared<OneOf>(rank, processes);
					const StepSystem<Dim> part(cloud, model, {}, report);
					Eigen::VectorXd       ownForce, ownContributions;
					NodeMatrix<Dim>       ownK;
					part.prepare(ownK);
					ASSERT_FALSE(part.evaluate(d, ownForce, &ownK, &ownContributions));
					const int first = Dim * part.ownedNodes().first(), rows = Dim * part.ownedNodes().last() - first;
					EXPECT_EQ(first, next);
					EXPECT_GT(rows, 0);
					EXPECT_EQ(ownK.keeps(0), rank == 0) << "no memory for blocks far below";
					EXPECT_EQ(ownK.keeps(whole.nodalSize() / Dim - 1), rank == processes - 1) << "nor above";
					next               = first + rows;
					const auto differs = [&](const auto& a, const auto& b) { return (a - b).norm() / b.norm(); };
					EXPECT_LT(differs(ownForce.segment(first, rows), force.segment(first, rows)), 1e-13);
					EXPECT_LT(differs(ownContributions.segment(first, rows), absoluteContributions.segment(first, rows)), 1e-13);
					const Eigen::MatrixXd own = dense(ownK);
					EXPECT_LT(differs(own.middleRows(first, rows), all.middleRows(first, rows)), 1e-13);
					EXPECT_LT(differs(own.middleCols(first, rows), all.middleCols(first, rows)), 1e-13);
					EXPECT_GT(differs(ownForce, force), 1e-3) << "the rest is left to others";
					EXPECT_TRUE(rank < processes - 1 || next == whole.nodalSize());
				}
		}
	}

	TYPED_TEST(ShareOf, ATileStaysWithOneThread)
	{
		constexpr int         Dim   = TypeParam::value;
		const auto            model = TestFixture::model(true);
		const auto            cloud = TestFixture::cloud(model.grid);
		StepReport            report;
		const StepSystem<Dim> whole(cloud, model, {}, report);
		const OneOf           process(1, 3);
		const OwnedParts<Dim> share(process, whole.basis, whole.faces, *model.division);
		int                   kept = 0;
		ASSERT_EQ(share.colours().size(), whole.basis.colours.size());
		for (std::size_t c = 0; c < share.colours().size(); ++c)
			for (const auto& [first, last] : whole.basis.colours[c]) {
				const auto  isInside = [first = first, last = last](const auto& part) { return part.first >= first && part.second <= last; };
				const auto& parts    = share.colours()[c];
				const auto  found    = std::count_if(parts.begin(), parts.end(), isInside);
				EXPECT_LE(found, 1);
				kept += int(found);
			}
		for (const auto& parts : share.colours())
			kept -= int(parts.size());
		EXPECT_EQ(kept, 0) << "each part is of one tile";
		EXPECT_LT(share.faces().size(), whole.faces.size());
	}

	/// Rows of the matrix in dense form, among all; with the values of K or of its symmetric part.
	Eigen::MatrixXd dense(const NodeRows& rows, const std::vector<double>& value)
	{
		Eigen::MatrixXd found = Eigen::MatrixXd::Zero(rows.rows(), rows.all);
		for (int r = 0; r < rows.rows(); ++r)
			for (int e = rows.start[r]; e < rows.start[r + 1]; ++e)
				found(r, rows.column[e]) = value[e];
		return found;
	}

	TYPED_TEST(ShareOf, RowsOfTheMatrixFollowEachOther)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    hole = [](const Index<Dim>& i) { return (i.array() == 2).all(); };
		for (const int period : { 0, 3, 6 }) {
			Springs<Dim> springs(Index<Dim>::Constant(period ? period : 5), 2, hole, Index<Dim>::Unit(0) * period);
			const auto   whole = *nodeRows(springs.K, springs.dofs, OwnedNodes::whole(springs.K.nodes()));
			const auto   all   = dense(whole, whole.value);
			const int    nodes = springs.K.nodes();
			for (int rank = 0, next = 0; rank < 4; ++rank) {
				const OneOf process(rank, 4);
				// The first one and the last one have none.
				const OwnedNodes ownedNodes { process, { 0, 0, nodes / 3, nodes, nodes } };
				const auto       own = *nodeRows(springs.K, springs.dofs, ownedNodes);
				EXPECT_EQ(own.first, next);
				EXPECT_EQ(own.all, whole.rows());
				EXPECT_TRUE(own.symmetricPart.empty());
				EXPECT_EQ(dense(own, own.value), all.middleRows(next, own.rows()));
				EXPECT_TRUE(std::equal(own.dof.begin(), own.dof.end(), whole.dof.begin() + next));
				EXPECT_TRUE(std::equal(own.position.begin(), own.position.end(), whole.position.begin() + (period ? 0 : next)));
				next += own.rows();
				EXPECT_TRUE(rank < 3 || next == whole.rows());
			}
		}
	}

	TYPED_TEST(ShareOf, RowsOfAMatrixThatIsNotSymmetricHaveASymmetricPart)
	{
		constexpr int   Dim   = TypeParam::value;
		const auto      model = TestFixture::model(false);
		const auto      cloud = TestFixture::cloud(model.grid);
		StepReport      report;
		StepSystem<Dim> system(cloud, model, {}, report);
		Random          numbers(1);
		NodeMatrix<Dim> K;
		Eigen::VectorXd force;
		system.prepare(K);
		system.evaluate(Eigen::VectorXd::NullaryExpr(system.nodalSize(), [&] { return numbers.in(-0.02, 0.02); }), force, &K);
		const auto            rows = *nodeRows(K, system.dofs, OwnedNodes::whole(K.nodes()));
		const Eigen::MatrixXd all = gimpm::dense(K), found = dense(rows, rows.value), part = dense(rows, rows.symmetricPart);
		EXPECT_GT((all - all.transpose()).norm(), 1e-3 * all.norm()) << "the points flow";
		EXPECT_LT((part - 0.5 * (found + found.transpose())).norm(), 1e-14 * found.norm());
		const auto isFree = [&](int row) { return system.dofs.number[rows.dof[row]] >= 0; };
		for (int r = 0; r < rows.rows(); ++r)
			for (int c = 0; c < rows.rows(); ++c)
				ASSERT_TRUE(!isFree(r) || !isFree(c) || found(r, c) == all(rows.dof[r], rows.dof[c])) << r << ' ' << c;
	}

}
}
