// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/block_matrix.hpp"
#include "core/base/instruction_set.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// Numbers: some 50 us, ten times what threads take to begin and to end.
constexpr std::size_t worthwhileInThreads = 100000;

}

template <int Dim> BlockMatrix<Dim>::BlockMatrix(const NodeMatrix<Dim>& K, const FreeDofs& dofs) : BlockMatrix(K, dofs, { 0, K.nodes() }, { 0, K.nodes() }) { }

template <int Dim> BlockMatrix<Dim>::BlockMatrix(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const Range& here, const Range& own) : first_ { 0 }
{
	const auto isConstrained = [&](int node, int axis) { return dofs.number[Dim * node + axis] < 0; };
	const auto isOwn         = [&](int node) { return node >= own.first && node < own.second; };
	const auto isThere       = [&](int a, int c) { return c == 0 || (K.used(a, c) && (isOwn(a) || isOwn(K.neighbour(a, c)))); };
	for (int a = here.first; a < here.second; ++a) {
		for (int c = 0; c < K.codes; ++c)
			if (isThere(a, c)) neighbour_.push_back(K.neighbour(a, c) - here.first);
		first_.push_back(int(neighbour_.size()));
	}
	value_.resize(neighbour_.size() * block);
	double* out = value_.data();
	for (int a = here.first; a < here.second; ++a)
		for (int c = 0; c < K.codes; ++c) {
			if (!isThere(a, c)) continue;
			// This block is in no row or column of the own nodes.
			const bool    isAlone = c == 0 && !isOwn(a);
			const double* in      = isAlone ? nullptr : K.at(a, c);
			for (int i = 0; i < Dim; ++i)
				for (int j = 0; j < Dim; ++j)
					*out++ = isAlone || isConstrained(a, i) || isConstrained(K.neighbour(a, c), j) ? double(c == 0 && i == j)
					                                                                               : in[i * Dim + j];
		}
	cutIntoSlabs();
}

template <int Dim> void BlockMatrix<Dim>::cutIntoSlabs()
{
	int reached = 0, before = 0; // last node that the rows so far reach, and that those of the slabs before do
	slab_.push_back(0);
	for (int a = 0; a < nodes(); ++a) {
		if (a > before && a > slab_.back()) {
			slab_.push_back(a);
			before = reached;
		}
		const auto [low, high] = std::minmax_element(neighbour_.begin() + first_[a], neighbour_.begin() + first_[a + 1]);
		// Around a periodic grid: no further slabs.
		reached = *low < a ? nodes() : std::max(reached, *high);
	}
	if (reached >= nodes()) slab_.assign(1, 0);
	slab_.push_back(nodes());
}

template <int Dim> void BlockMatrix<Dim>::multiplySlab(int slab, const double* x, double* y) const
{
	for (int a = slab_[slab]; a < slab_[slab + 1]; ++a) {
		const double* k       = value_.data() + std::size_t(first_[a]) * block;
		double        ya[Dim] = {}, xa[Dim];
		for (int i = 0; i < Dim; ++i) {
			xa[i] = x[Dim * a + i];
			for (int j = 0; j < Dim; ++j)
				ya[i] += k[i * Dim + j] * x[Dim * a + j];
		}
		for (int e = first_[a] + 1; e < first_[a + 1]; ++e) {
			k += block;
			const double* xb = x + Dim * neighbour_[e];
			double*       yb = y + Dim * neighbour_[e];
			for (int i = 0; i < Dim; ++i)
				for (int j = 0; j < Dim; ++j) {
					ya[i] += k[i * Dim + j] * xb[j];
					yb[j] += k[i * Dim + j] * xa[i];
				}
		}
		for (int i = 0; i < Dim; ++i)
			y[Dim * a + i] += ya[i];
	}
}

template <int Dim> void BlockMatrix<Dim>::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
	const int slabs = int(slab_.size()) - 1;
	y.setZero(x.size());
	for (int parity = 0; parity < 2; ++parity) // slabs two apart share no row
#pragma omp parallel for schedule(dynamic) if (value_.size() > worthwhileInThreads)
		for (int s = parity; s < slabs; s += 2)
			callForProcessor([&] { multiplySlab(s, x.data(), y.data()); });
}

template <int Dim> Eigen::VectorXd BlockMatrix<Dim>::diagonal() const
{
	Eigen::VectorXd diagonal(Dim * nodes());
	for (int a = 0; a < nodes(); ++a)
		for (int i = 0; i < Dim; ++i)
			diagonal[Dim * a + i] = value_[std::size_t(first_[a]) * block + i * Dim + i];
	return diagonal;
}

template class BlockMatrix<2>;
template class BlockMatrix<3>;

} // namespace gimpm
