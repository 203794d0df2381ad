// SPDX-License-Identifier: GPL-2.0-or-later
// Matrices over nodes: boxes of springs.
#pragma once
#include "core/solvers/linear_solver.hpp"
#include "matrices.hpp"
#include "scenes.hpp"
#include <gtest/gtest.h>
#include <omp.h>

namespace gimpm {

/// Springs between each node and those at most `reach` away, stiffer along them than across.
template <int Dim> void setSprings(NodeMatrix<Dim>& K, const Grid<Dim>& grid, const std::vector<Key>& nodes, int reach)
{
	K.reset(nodes, true, grid);
	for (int a = 0; a < K.nodes(); ++a) {
		K.markUsed(a, 0);
		forIndices<Dim>(Index<Dim>::Constant(-reach), Index<Dim>::Constant(2 * reach + 1), [&](const Index<Dim>& offset) {
			const int code = K.code(offset);
			if (code <= 0 || K.neighbour(a, code) < 0) return;
			const Vec<Dim> along = offset.template cast<double>().normalized();
			const Mat<Dim> k     = 0.2 * Mat<Dim>::Identity() + along * along.transpose();
			K.markUsed(a, code);
			K.add(a, K.neighbour(a, code), code, -k);
			K.add(a, a, 0, k);
			K.add(K.neighbour(a, code), K.neighbour(a, code), 0, k);
		});
	}
}

template <int Dim> struct Springs {
	Grid<Dim>        grid;
	std::vector<Key> nodes;
	NodeMatrix<Dim>  K;
	FreeDofs         dofs;

	/// Springs of a box of so many nodes without those that `isGap` names; the lowest layer is constrained, and a
	/// node above it along its first axis.
	template <class F> Springs(const Index<Dim>& size, int reach, F&& isGap, const Index<Dim>& period = Index<Dim>::Zero())
	{
		grid.period = period;
		forIndices<Dim>(Index<Dim>::Zero(), size, [&](const Index<Dim>& i) {
			if (!isGap(i)) nodes.push_back(Grid<Dim>::key(i));
		});
		std::sort(nodes.begin(), nodes.end());
		setSprings(K, grid, nodes, reach);
		for (int n = 0; n < K.nodes(); ++n)
			for (int a = 0; a < Dim; ++a) {
				const bool isConstrained = Grid<Dim>::index(nodes[n])[Dim - 1] == 0 || (n == K.nodes() - 3 && a == 0);
				dofs.number.push_back(isConstrained ? -1 : dofs.count++);
			}
	}
	Springs(const Index<Dim>& size, int reach) : Springs(size, reach, [](const Index<Dim>&) { return false; }) { }
};

/// A long body is solved to the tolerance, and to the same bits by one thread and by two; by multigrid to the
/// tolerance: of newer releases of PETSc no two runs have the same bits.
template <int Dim> void expectSameInThreads(double tolerance, LinearMethod method)
{
	Index<Dim> size = Index<Dim>::Constant(Dim == 2 ? 60 : 12);
	size[Dim - 1] *= 3;
	const Springs<Dim>    springs(size, 1);
	const LinearProblem   K(springs.K, springs.dofs);
	const Eigen::VectorXd b       = Random(2).vector(K.size());
	const int             threads = omp_get_max_threads();
	Eigen::VectorXd       x, expected;
	for (const int n : { 1, 2 }) {
		omp_set_num_threads(n);
		LinearSolver solver;
		ASSERT_TRUE(solver.solveIteratively(K, b, x, tolerance, method));
		if (n == 1) expected = x;
		EXPECT_LE((x - expected).norm(), method == LinearMethod::multigrid ? tolerance * expected.norm() : 0) << n;
	}
	omp_set_num_threads(threads);
	EXPECT_LT((K * x - b).norm(), 1.01 * tolerance * b.norm());
}

} // namespace gimpm
