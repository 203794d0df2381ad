// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/gauss_seidel.hpp"
#include "core/solvers/node_blocks.hpp"
#include <tuple>

namespace gimpm {
namespace {

template <int C> void add(double* sum, double factor, const double* x)
{
	for (int i = 0; i < C; ++i)
		sum[i] += factor * x[i];
}

} // namespace

/// They do rise as they come but where a periodic grid begins again.
void NodePairs::sort()
{
	upper.clear();
	for (int a = 0; a < nodes(); ++a) {
		const int begin = first[a] + 1, end = first[a + 1];
		if (!std::is_sorted(neighbour.begin() + begin, neighbour.begin() + end)) {
			std::vector<std::pair<int, double>> row;
			for (int e = begin; e < end; ++e)
				row.emplace_back(neighbour[e], value[e]);
			std::sort(row.begin(), row.end());
			for (int e = begin; e < end; ++e)
				std::tie(neighbour[e], value[e]) = row[e - begin];
		}
		upper.push_back(int(std::upper_bound(neighbour.begin() + begin, neighbour.begin() + end, a) - neighbour.begin()));
	}
}

GaussSeidel::GaussSeidel(const NodePairs& K, Eigen::VectorXd scale, int columns)
        : K_(K), scale_(std::move(scale)), columns_(columns), half_(Eigen::VectorXd::Zero(scale_.size())), scaledHalf_(half_), other_(half_)
{
}

template <class F> void GaussSeidel::forNodes(F&& sweep) const
{
	const auto f = [&](auto columns) { forBlocks(K_.nodes(), [&](int begin, int end) { sweep(columns, begin, end); }); };
	switch (columns_) {
		case 2: return f(std::integral_constant<int, 2>());
		case 3: return f(std::integral_constant<int, 3>());
		case 4: return f(std::integral_constant<int, 4>());
		case 6: return f(std::integral_constant<int, 6>());
		case 9: return f(std::integral_constant<int, 9>());
	}
}

const Eigen::VectorXd& GaussSeidel::solution(const Eigen::VectorXd& x) const
{
	forNodes([&](auto columns, int begin, int end) { sweepBack<columns>(begin, end, x.data()); });
	return scaledHalf_;
}

void GaussSeidel::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
	solution(x);
	sweepOn(x, y);
}

void GaussSeidel::sweepOn(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
	y.resize(x.size());
	forNodes([&](auto columns, int begin, int end) { sweepOn<columns>(begin, end, x.data(), y.data()); });
}

Eigen::VectorXd GaussSeidel::right(const Eigen::VectorXd& b) const
{
	Eigen::VectorXd y;
	half_.setZero();
	scaledHalf_.setZero();
	sweepOn(b.cwiseProduct(scale_), y);
	return y;
}

/// Nodes begin ... end - 1 of scaledHalf = S (1 + U)^-1 x. Stored in one go, so that the next node need not wait for
/// single numbers.
template <int C> void GaussSeidel::sweepBack(int begin, int end, const double* x) const
{
	double *const halves = half_.data(), *const scaledHalves = scaledHalf_.data();
	for (int a = end - 1; a >= begin; --a) {
		double    sum[C] = {};
		const int first  = K_.upper[a];
		int       e      = K_.first[a + 1] - 1;
		while (e >= first && K_.neighbour[e] >= end)
			--e;
		for (; e >= first; --e)
			add<C>(sum, K_.value[e], scaledHalves + C * K_.neighbour[e]);
		const double* scale = scale_.data() + C * a;
		double        half[C], scaled[C];
		for (int i = 0; i < C; ++i)
			half[i] = x[C * a + i] - scale[i] * sum[i];
		for (int i = 0; i < C; ++i)
			scaled[i] = scale[i] * half[i];
		std::copy(half, half + C, halves + C * a);
		std::copy(scaled, scaled + C, scaledHalves + C * a);
	}
}

/// y = half + (1 + L)^-1 (x - half + R half), R what couples blocks.
template <int C> void GaussSeidel::sweepOn(int begin, int end, const double* x, double* y) const
{
	const double *const halves = half_.data(), *const scaledHalves = scaledHalf_.data();
	double* const others = other_.data();
	for (int a = begin; a < end; ++a) {
		double    sum[C] = {};
		const int upper  = K_.upper[a];
		for (int e = K_.first[a + 1] - 1; e >= upper && K_.neighbour[e] >= end; --e)
			add<C>(sum, -K_.value[e], scaledHalves + C * K_.neighbour[e]);
		int e = K_.first[a] + 1;
		for (; e < upper && K_.neighbour[e] < begin; ++e)
			add<C>(sum, -K_.value[e], scaledHalves + C * K_.neighbour[e]);
		for (; e < upper; ++e)
			add<C>(sum, K_.value[e], others + C * K_.neighbour[e]);
		const double *scale = scale_.data() + C * a, *half = halves + C * a;
		double        scaled[C], result[C];
		for (int i = 0; i < C; ++i)
			result[i] = x[C * a + i] - half[i] - scale[i] * sum[i];
		for (int i = 0; i < C; ++i)
			scaled[i] = scale[i] * result[i];
		for (int i = 0; i < C; ++i)
			result[i] += half[i];
		std::copy(scaled, scaled + C, others + C * a);
		std::copy(result, result + C, y + C * a);
	}
}

} // namespace gimpm
