// SPDX-License-Identifier: GPL-2.0-or-later
// What a linear solver is given.
#pragma once
#include "core/solvers/csc.hpp"
#include <utility>
#include <variant>

namespace gimpm {

/// The matrix of K x = b on the free degrees of freedom, in one of its two forms.
class LinearProblem {
public:
	LinearProblem(SymmetricCsc K) : matrix_(std::move(K)) { }
	LinearProblem(GeneralCsc K) : matrix_(std::move(K)) { }
	bool                isSymmetric() const { return std::holds_alternative<SymmetricCsc>(matrix_); }
	const SymmetricCsc& symmetric() const { return std::get<SymmetricCsc>(matrix_); }
	const GeneralCsc&   general() const { return std::get<GeneralCsc>(matrix_); }

	/// What is stored: of a symmetric matrix one triangle.
	const Csc& stored() const { return isSymmetric() ? static_cast<const Csc&>(symmetric()) : general(); }
	int        size() const { return stored().size(); }

	Eigen::VectorXd operator*(const Eigen::VectorXd& x) const { return isSymmetric() ? symmetric() * x : general() * x; }

	/// Calls f(row, column, value) for each entry of the whole matrix.
	template <class F> void forEntries(F&& f) const
	{
		const Csc& K = stored();
		for (int c = 0; c < K.size(); ++c)
			for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
				f(K.row[e], c, K.value[e]);
				if (isSymmetric() && K.row[e] != c) f(c, K.row[e], K.value[e]);
			}
	}

private:
	std::variant<SymmetricCsc, GeneralCsc> matrix_;
};

} // namespace gimpm
