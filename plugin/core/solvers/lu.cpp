// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/lu.hpp"
#include <umfpack.h>

namespace gimpm {
bool Lu::factorise(const Csc& K, const int* ordering, double smallestPivot)
{
	if (ordering && !multifrontal_) multifrontal_ = std::make_unique<Multifrontal>(K, Multifrontal::Form::general, ordering);
	isMultifrontal_ = ordering && multifrontal_->factorise(K, smallestPivot / pivotOfRow);
	if (!isMultifrontal_) multifrontal_.reset(); // two factors need not be held
	umfpack_di_free_numeric(&numeric_);
	return isMultifrontal_ || factorisePivoting(K, ordering, smallestPivot);
}

bool Lu::factorisePivoting(const Csc& K, const int* ordering, double smallestPivot)
{
	double control[UMFPACK_CONTROL], info[UMFPACK_INFO];
	umfpack_di_defaults(control);
	if (!ordering) forget();
	else
		control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
	const int n = K.size(), *start = K.start.data(), *row = K.row.data();
	if (!symbolic_) {
		if (ordering) umfpack_di_qsymbolic(n, n, start, row, nullptr, ordering, &symbolic_, control, info);
		else
			umfpack_di_symbolic(n, n, start, row, K.value.data(), &symbolic_, control, info);
	}
	return symbolic_ && umfpack_di_numeric(start, row, K.value.data(), symbolic_, &numeric_, control, info) == UMFPACK_OK
	        && info[UMFPACK_RCOND] > smallestPivot;
}

bool Lu::solve(const Csc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed) const
{
	if (isMultifrontal_) return multifrontal_->solve(K, b, x, transposed);
	double info[UMFPACK_INFO];
	x.resize(b.size());
	return umfpack_di_solve(transposed ? UMFPACK_At : UMFPACK_A, K.start.data(), K.row.data(), K.value.data(), x.data(), b.data(), numeric_, nullptr, info)
	        == UMFPACK_OK
	        && x.allFinite();
}

void Lu::forgetFactor()
{
	umfpack_di_free_numeric(&numeric_);
	isMultifrontal_ = false; // memory of the factor is used again for the next one
}

void Lu::forget()
{
	forgetFactor();
	multifrontal_.reset();
	umfpack_di_free_symbolic(&symbolic_);
}

} // namespace gimpm
