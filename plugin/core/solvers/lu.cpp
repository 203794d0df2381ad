// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/lu.hpp"
#include <umfpack.h>

namespace gimpm {

bool Lu::factorise(const Csc& K, double smallestPivot)
{
	forget();
	const int  n = K.size(), *start = K.start.data(), *row = K.row.data();
	double     info[UMFPACK_INFO];
	void*      symbolic  = nullptr;
	const bool isRegular = umfpack_di_symbolic(n, n, start, row, K.value.data(), &symbolic, nullptr, info) == UMFPACK_OK
	        && umfpack_di_numeric(start, row, K.value.data(), symbolic, &factor_, nullptr, info) == UMFPACK_OK && info[UMFPACK_RCOND] > smallestPivot;
	umfpack_di_free_symbolic(&symbolic);
	return isRegular;
}

bool Lu::solve(const Csc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed) const
{
	double info[UMFPACK_INFO];
	x.resize(b.size());
	return umfpack_di_solve(transposed ? UMFPACK_At : UMFPACK_A, K.start.data(), K.row.data(), K.value.data(), x.data(), b.data(), factor_, nullptr, info)
	        == UMFPACK_OK
	        && x.allFinite();
}

void Lu::forget() { umfpack_di_free_numeric(&factor_); }

} // namespace gimpm
