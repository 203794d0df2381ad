// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/cholesky.hpp"
#include "core/solvers/blas_threads.hpp"
#include <algorithm>
#include <cmath>
#include <omp.h>

namespace gimpm {
namespace {

/// Parts of the unknowns: a larger separator costs more, dense as it is, than two threads gain, and so do halves that
/// are less alike. A cut that parts them evenly is longer, and gains nothing.
constexpr double mostOfSeparator = 0.03, leastOfHalf = 0.3;

bool isWorthHalving(const Order& order)
{
	const double size = double(order.numbers.size()), separator = size - order.first - order.second;
	return std::min(order.first, order.second) >= leastOfHalf * size && separator <= mostOfSeparator * size;
}

} // namespace

bool Cholesky::isAnalysed() const { return isHalved() ? halves_[0].factor.isAnalysed() && halves_[1].factor.isAnalysed() : whole_.isAnalysed(); }

double Cholesky::sum(double (SupernodalFactor::*of)() const) const
{
	return isHalved() ? (halves_[0].factor.*of)() + (halves_[1].factor.*of)() : (whole_.*of)();
}

/// Both at the same time, if there are threads for it; neither CHOLMOD nor the BLAS opens any of its own.
template <class F> bool Cholesky::forHalves(F&& f)
{
	const OneBlasThread guard;
	const int           levels = omp_get_max_active_levels(), threads = std::min(2, omp_get_max_threads());
	omp_set_max_active_levels(threads > 1 ? 1 : 0);
#pragma omp parallel for num_threads(threads) schedule(static, 1)
	for (int h = 0; h < 2; ++h)
		halves_[h].hasDone = f(halves_[h], h);
	omp_set_max_active_levels(levels);
	return halves_[0].hasDone && halves_[1].hasDone;
}

void Cholesky::analyse(const Csc& K, Order order, bool isDefinite)
{
	if (!isDefinite || !isWorthHalving(order)) order.first = order.second = 0;
	order_ = std::move(order);
	whole_.forget();
	for (Half& half : halves_)
		half.factor.forget();
	if (!isHalved()) return whole_.analyse(K, order_.numbers, 0, isDefinite);
	forHalves([&](Half& half, int h) {
		analyseHalf(half, K, h == 0 ? 0 : order_.first, h == 0 ? order_.first : order_.second);
		return true;
	});
}

void Cholesky::analyseHalf(Half& half, const Csc& K, int first, int count)
{
	const auto begin = order_.numbers.begin(), separatorBegin = order_.numbers.end() - separator();
	half.rows.assign(begin + first, begin + first + count);
	half.rows.insert(half.rows.end(), separatorBegin, order_.numbers.end());
	std::vector<int> sorted = half.rows, number(K.size(), -1);
	std::sort(sorted.begin(), sorted.end());
	for (std::size_t i = 0; i < sorted.size(); ++i)
		number[sorted[i]] = int(i);
	half.K.start.assign(1, 0);
	half.K.row.clear();
	half.source.clear();
	for (const int c : sorted) {
		for (int e = K.start[c]; e < K.start[c + 1] && K.row[e] <= c; ++e)
			if (number[K.row[e]] >= 0) {
				half.K.row.push_back(number[K.row[e]]);
				half.source.push_back(e);
			}
		half.K.start.push_back(int(half.K.row.size()));
	}
	half.K.value.resize(half.source.size());
	std::vector<int> order;
	for (const int row : half.rows)
		order.push_back(number[row]);
	half.factor.analyse(half.K, std::move(order), separator());
	for (std::size_t i = 0; half.factor.isAnalysed() && i < sorted.size(); ++i)
		half.rows[i] = sorted[half.factor.ordering()[i]];
}

bool Cholesky::factorise(const Csc& K)
{
	if (!isHalved()) return whole_.factorise(K);
	return isAnalysed() && forHalves([&](Half& half, int) {
		       for (std::size_t e = 0; e < half.source.size(); ++e)
			       half.K.value[e] = K.value[half.source[e]];
		       if (!half.factor.factorise(half.K)) return false;
		       half.last.resize(separator(), separator());
		       half.factor.lastBlock(half.last);
		       half.product.setZero(separator(), separator());
		       half.product.selfadjointView<Eigen::Lower>().rankUpdate(half.last);
		       return true;
	       })
	        && factoriseSeparator(K);
}

bool Cholesky::factoriseSeparator(const Csc& K)
{
	const auto       rows = separatorRows();
	std::vector<int> position(K.size(), -1);
	for (int i = 0; i < rows.size(); ++i)
		position[rows[i]] = i;
	Eigen::MatrixXd left = halves_[0].product + halves_[1].product;
	for (int i = 0; i < rows.size(); ++i)
		for (int e = K.start[rows[i]]; e < K.start[rows[i] + 1] && K.row[e] <= rows[i]; ++e)
			if (const int j = position[K.row[e]]; j >= 0) left(std::max(i, j), std::min(i, j)) -= K.value[e];
	ofSeparator_.compute(left);
	return ofSeparator_.info() == Eigen::Success;
}

double Cholesky::rcond()
{
	if (!isHalved()) return whole_.rcond();
	const auto pivots = ofSeparator_.matrixLLT().diagonal().array();
	return std::min({ halves_[0].factor.rcond(), halves_[1].factor.rcond(), separator() > 0 ? std::pow(pivots.minCoeff(), 2) : 1 });
}

bool Cholesky::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	if (!isHalved()) return whole_.solve(b, x);
	const bool isForward = forHalves([&](Half& half, int) {
		Eigen::VectorXd right = Eigen::VectorXd::Zero(half.rows.size());
		for (int i = 0; i < right.size() - separator(); ++i)
			right[i] = b[half.rows[i]];
		return half.factor.solveLower(right, half.x);
	});
	if (!isForward) return false;
	const auto      rows = separatorRows();
	Eigen::VectorXd middle(rows.size());
	for (int i = 0; i < rows.size(); ++i)
		middle[i] = b[rows[i]];
	for (const Half& half : halves_)
		middle += half.last * half.x.tail(separator());
	middle = ofSeparator_.solve(middle);
	x.resize(b.size());
	for (int i = 0; i < rows.size(); ++i)
		x[rows[i]] = middle[i];
	return forHalves([&](Half& half, int) {
		       half.x.tail(separator())    = half.last.transpose() * middle;
		       const Eigen::VectorXd right = half.x;
		       if (!half.factor.solveUpper(right, half.x)) return false;
		       for (int i = 0; i < right.size() - separator(); ++i)
			       x[half.rows[i]] = half.x[i];
		       return true;
	       })
	        && x.allFinite();
}

} // namespace gimpm
