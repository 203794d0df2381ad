// SPDX-License-Identifier: GPL-2.0-or-later
// Supernodal Cholesky factorisation (CHOLMOD).
#pragma once
#include "core/solvers/csc.hpp"
#include <cholmod.h>

namespace gimpm {

/// Of matrices given by their upper triangles; entries below are ignored.
class Cholesky {
public:
	Cholesky();
	~Cholesky();
	Cholesky(const Cholesky&)            = delete;
	Cholesky& operator=(const Cholesky&) = delete;

	/// Finds the pattern of the factor, with rows and columns in the given order; of none, in one that CHOLMOD looks for.
	void   analyse(const Csc& K, std::vector<int> order = {});
	bool   isAnalysed() const { return factor_; } ///< not before analyse(), nor if the factor would be too large for CHOLMOD
	double entries() const { return common_.lnz; }
	double flops() const { return common_.fl; }
	/// Of rows and columns: the number of each in K.
	const int* ordering() const { return static_cast<const int*>(factor_->Perm); }

	/// Of a matrix with the pattern that was analysed; false if it is not positive definite.
	bool factorise(const Csc& K);
	/// A rough inverse of the factor's condition number: the square of its smallest over its largest diagonal entry.
	double rcond() { return cholmod_rcond(factor_, &common_); }
	bool   solve(const Eigen::VectorXd& b, Eigen::VectorXd& x);

private:
	cholmod_common  common_;
	cholmod_factor* factor_ = nullptr;
};

} // namespace gimpm
