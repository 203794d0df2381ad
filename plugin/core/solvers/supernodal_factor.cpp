// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/supernodal_factor.hpp"
#include "core/solvers/signed_factor.hpp"
#include <algorithm>

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

SupernodalFactor::SupernodalFactor()
{
	cholmod_start(&common_);
	common_.print                      = 0; // a failed factorisation is a status, not a message
	common_.quick_return_if_not_posdef = 1;
	common_.final_ll                   = 1;
}

SupernodalFactor::~SupernodalFactor()
{
	cholmod_free_factor(&factor_, &common_);
	cholmod_finish(&common_);
}

void SupernodalFactor::analyse(const Csc& K, std::vector<int> order, int last, bool isDefinite)
{
	cholmod_sparse A = upper(K);
	forget();
	// Its default is AMD, and METIS if that is not good; its first method is the given order.
	common_.nmethods   = order.empty() ? 0 : 1;
	common_.supernodal = last == 0 && isDefinite ? CHOLMOD_AUTO : CHOLMOD_SUPERNODAL;
	for (const bool postorder : { true, false }) { // which the last ones survive if all before them are connected
		common_.postorder = postorder;
		factor_           = cholmod_analyze_p(&A, order.empty() ? nullptr : order.data(), nullptr, 0, &common_);
		if (!factor_ || std::equal(order.end() - last, order.end(), ordering() + A.nrow - last)) return;
		forget();
	}
}

bool SupernodalFactor::factorise(const Csc& K)
{
	cholmod_sparse A = upper(K);
	return factor_ && cholmod_factorize(&A, factor_, &common_) && common_.status == CHOLMOD_OK;
}

bool SupernodalFactor::factoriseSigned(const Csc& K, double smallest)
{
	if (!factor_ || !factor_->is_super) return false;
	if (places_.empty()) {
		if (!cholmod_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor_, &common_)) return false;
		places_ = placesIn(*factor_, K);
	}
	return gimpm::factoriseSigned(*factor_, places_, K.value, smallest, signs_);
}

bool SupernodalFactor::solveSigned(const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	Eigen::VectorXd y;
	if (!solve(CHOLMOD_P, b, x) || !solve(CHOLMOD_L, x, y)) return false;
	return solve(CHOLMOD_Lt, y.cwiseProduct(signs_), x) && solve(CHOLMOD_Pt, Eigen::VectorXd(x), x);
}

bool SupernodalFactor::solve(int system, const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	cholmod_dense B {};
	B.nrow = B.nzmax = B.d = b.size();
	B.ncol                 = 1;
	B.x                    = const_cast<double*>(b.data());
	B.xtype                = CHOLMOD_REAL;
	B.dtype                = CHOLMOD_DOUBLE;
	cholmod_dense* X       = cholmod_solve(system, factor_, &B, &common_);
	if (!X) return false;
	x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(X->x), b.size());
	cholmod_free_dense(&X, &common_);
	return x.allFinite();
}

void SupernodalFactor::lastBlock(Eigen::MatrixXd& block) const
{
	const auto&   L        = *factor_;
	const auto    integers = [](const void* p) { return static_cast<const int*>(p); };
	const int *   columns = integers(L.super), *places = integers(L.pi), *values = integers(L.px), *rows = integers(L.s);
	const int     first = int(L.n) - int(block.rows());
	const double* x     = static_cast<const double*>(L.x);
	block.setZero();
	for (int s = int(L.nsuper) - 1; s >= 0 && columns[s + 1] > first; --s) {
		const int height = places[s + 1] - places[s];
		for (int c = std::max(columns[s], first); c < columns[s + 1]; ++c)
			for (int i = c - columns[s]; i < height; ++i) // its first rows are its columns
				block(rows[places[s] + i] - first, c - first) = x[values[s] + i + (c - columns[s]) * std::ptrdiff_t(height)];
	}
}

} // namespace gimpm
