// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/cholesky.hpp"

namespace gimpm {
namespace {

cholmod_sparse upper(const Csc& K)
{
	cholmod_sparse A {};
	A.nrow = A.ncol = K.size();
	A.nzmax         = K.row.size();
	A.p             = const_cast<int*>(K.start.data());
	A.i             = const_cast<int*>(K.row.data());
	A.x             = const_cast<double*>(K.value.data());
	A.stype         = 1;
	A.itype         = CHOLMOD_INT;
	A.xtype         = CHOLMOD_REAL;
	A.dtype         = CHOLMOD_DOUBLE;
	A.sorted = A.packed = 1;
	return A;
}

} // namespace

Cholesky::Cholesky()
{
	cholmod_start(&common_);
	common_.print                      = 0; // a failed factorisation is a status, not a message
	common_.quick_return_if_not_posdef = 1;
	common_.final_ll                   = 1;
}

Cholesky::~Cholesky()
{
	cholmod_free_factor(&factor_, &common_);
	cholmod_finish(&common_);
}

void Cholesky::analyse(const Csc& K, std::vector<int> order)
{
	cholmod_sparse A = upper(K);
	cholmod_free_factor(&factor_, &common_);
	common_.nmethods = order.empty() ? 0 : 1; // its default is AMD, and METIS if that is not good; its first method is the given order
	factor_          = cholmod_analyze_p(&A, order.empty() ? nullptr : order.data(), nullptr, 0, &common_);
}

bool Cholesky::factorise(const Csc& K)
{
	cholmod_sparse A = upper(K);
	return factor_ && cholmod_factorize(&A, factor_, &common_) && common_.status == CHOLMOD_OK;
}

bool Cholesky::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	cholmod_dense B {};
	B.nrow = B.nzmax = B.d = b.size();
	B.ncol                 = 1;
	B.x                    = const_cast<double*>(b.data());
	B.xtype                = CHOLMOD_REAL;
	B.dtype                = CHOLMOD_DOUBLE;
	cholmod_dense* X       = cholmod_solve(CHOLMOD_A, factor_, &B, &common_);
	if (!X) return false;
	x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(X->x), b.size());
	cholmod_free_dense(&X, &common_);
	return x.allFinite();
}

} // namespace gimpm
