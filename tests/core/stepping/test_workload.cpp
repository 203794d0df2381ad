// SPDX-License-Identifier: GPL-2.0-or-later
// Sizes of a load step before it is made.
#include "core/stepping/workload.hpp"
#include "scenes.hpp"

namespace gimpm {
namespace {

	template <class Dimension> using WorkloadOf = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(WorkloadOf, BothDimensions, DimensionName);

	TYPED_TEST(WorkloadOf, ABlockIsThatOfItsStiffnessAndItsStep)
	{
		constexpr int Dim = TypeParam::value;
		Model<Dim>    model;
		model.materials = { { Hencky(1e6, 0.3), 1e3 } };
		model.boundary  = Boundary<Dim>({ wallBelow<Dim>(model.grid, 1, 0), wallBelow<Dim>(model.grid, 0, 0), wallBelow<Dim>(model.grid, Dim - 1, 0) });
		auto       cloud  = block<Dim>(model.grid, Index<Dim>::Constant(3), 2);
		const auto before = cloud.position;
		const auto w      = workload(cloud, model);
		const auto K      = tangentStiffness(cloud, model);
		EXPECT_TRUE(cloud.position == before);
		EXPECT_EQ(w.points, int(cloud.size()));
		EXPECT_EQ(w.dofs, K.size());
		EXPECT_EQ(w.matrixEntries, double(K.stored().row.size()));
		EXPECT_EQ(w.populatedCells, Dim == 2 ? 9 : 27);
		EXPECT_GE(w.factorEntries, w.matrixEntries) << "fill only adds";
		EXPECT_LE(w.factorEntries, 0.5 * w.dofs * (w.dofs + 1.));
		EXPECT_GT(w.factorFlops, w.factorEntries);
		model.newton.linearSolver = LinearMethod::iterative;
		EXPECT_EQ(workload(cloud, model).factorEntries, 0);
		EXPECT_GT(workload(cloud, model).times.linear.solve, 0);
		LinearSolver solver;
		const auto   report = loadStep(cloud, model, Load<Dim>(), solver);
		EXPECT_EQ(report.dofs, w.dofs);
		EXPECT_EQ(report.ghostFaces, w.ghostFaces);
	}

	TEST(Workload, OfNothing) { EXPECT_EQ(workload(PointCloud<2>(), Model<2>()).dofs, 0); }

} // namespace
} // namespace gimpm
