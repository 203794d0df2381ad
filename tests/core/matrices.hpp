// SPDX-License-Identifier: GPL-2.0-or-later
// Sparse matrices for tests of linear solvers.
#pragma once
#include "scenes.hpp"

namespace gimpm {

/// The entries (row, column) that are stored, and the diagonal.
template <class Matrix, class F> Matrix sparse(const Eigen::MatrixXd& full, F&& isStored)
{
	Matrix K;
	K.start = { 0 };
	for (int c = 0; c < full.cols(); ++c) {
		for (int r = 0; r < full.rows(); ++r)
			if (r == c || isStored(r, c)) K.row.push_back(r), K.value.push_back(full(r, c));
		K.start.push_back(int(K.row.size()));
	}
	return K;
}

/// The rows and columns that are named, in their order.
inline Eigen::MatrixXd principalPart(const Eigen::MatrixXd& m, const std::vector<int>& places)
{
	Eigen::MatrixXd part(places.size(), places.size());
	for (std::size_t j = 0; j < places.size(); ++j)
		for (std::size_t i = 0; i < places.size(); ++i)
			part(i, j) = m(places[i], places[j]);
	return part;
}

/// Matrix with a diagonal that is larger than all of its row.
inline Eigen::MatrixXd withDominantDiagonal(Eigen::MatrixXd m)
{
	m.diagonal() = m.cwiseAbs().rowwise().sum().array() + 0.1;
	return m;
}

inline void expectSolves(LinearSolver& solver, const LinearProblem& K, LinearSolver::Status expected, double tolerance = 1e-12)
{
	const Eigen::VectorXd x = Random(99).vector(K.size());
	Eigen::VectorXd       found;
	ASSERT_EQ(solver.solve(K, K * x, found), expected);
	EXPECT_LT((found - x).norm(), tolerance * x.norm());
}

} // namespace gimpm
