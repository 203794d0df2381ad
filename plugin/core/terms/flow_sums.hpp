// SPDX-License-Identifier: GPL-2.0-or-later
// What water in the pores adds to forces and matrix, collected from the points of a few cells before it goes to nodes.
#pragma once
#include "core/terms/coupled_term.hpp"
#include "core/terms/flow_point.hpp"
#include <cstring>

namespace gimpm {

/// Where the nodes of a patch are in the window of its lowest cell, x fastest, and offsets between those of the window.
template <int Dim> struct Window {
	static constexpr int nodes = windowNodes<Dim>;

	std::array<std::array<int, nodes>, 1 << Dim> place {}; ///< by the span of the patch
	int                                          code[nodes][nodes];

	static const Window& get()
	{
		static const Window window;
		return window;
	}

private:
	Window()
	{
		for (int span = 0; span < 1 << Dim; ++span)
			for (int n = 0; n < nodes; ++n)
				for (int a = 0, rest = n, stride = 1; a < Dim; rest /= 2 + (span >> a & 1), ++a, stride *= 3)
					place[span][n] += stride * (rest % (2 + (span >> a & 1)));
		for (int m = 0; m < nodes; ++m)
			for (int n = 0; n < nodes; ++n) {
				Index<Dim> offset;
				for (int a = 0, i = m, j = n; a < Dim; i /= 3, j /= 3, ++a)
					offset[a] = j % 3 - i % 3;
				code[m][n] = NodeMatrix<Dim>::code(offset);
			}
	}
};

/// Patches of one lowest cell, which follow each other, and the nodes of its window that they have.
template <int Dim> struct PatchesOfCell {
	static constexpr int nodes = windowNodes<Dim>;

	const Patch<Dim>*      first;
	const Patch<Dim>*      end;
	std::array<int, nodes> node; ///< numbers; -1: none

	PatchesOfCell(const Patch<Dim>* patch, const Patch<Dim>* last) : first(patch), end(patch)
	{
		node.fill(-1);
		for (; end < last && end->cell == first->cell; ++end)
			for (int n = 0, count = nodesOf(*end); n < count; ++n)
				if (end->node[n] >= 0) node[Window<Dim>::get().place[end->span][n]] = end->node[n];
	}
	static int nodesOf(const Patch<Dim>& patch)
	{
		int count = 1;
		for (int a = 0; a < Dim; ++a)
			count *= patch.nodesAlong(a);
		return count;
	}
	/// Calls f(number in the window, number in the window) for the nodes that there are.
	template <class F> void forPairs(F&& f) const
	{
		for (int m = 0; m < nodes; ++m)
			for (int n = 0; n < nodes && node[m] >= 0; ++n)
				if (node[n] >= 0) f(m, n);
	}
};

/// Calls f(cell) for the lowest cells of the patches [first, last).
template <int Dim, class F> void forCellsOfPatches(const CloudBasis<Dim>& basis, int first, int last, F&& f)
{
	const auto* end = basis.patches.data() + last;
	for (const auto* patch = basis.patches.data() + first; patch < end;) {
		const PatchesOfCell<Dim> cell(patch, end);
		patch = cell.end;
		f(cell);
	}
}

/// What the points of a lowest cell add to forces and matrix, node by node of its window.
template <int Dim> class FlowSums {
	static constexpr int N = windowNodes<Dim>;
	using Row              = double[N];

public:
	FlowSums(const FieldSum<Dim>& sum, double duration, double modulus)
	        : sum_(sum), isSymmetric_(!sum.couplings || sum.couplings->isSymmetric()), duration_(duration), modulus_(modulus)
	{
	}

	void begin(const std::array<int, N>& node)
	{
		node_ = node;
		clear(force_), clear(sizes_);
		if (!sum_.couplings) return;
		clear(uu_), clear(up_), clear(pp_);
		if (!isSymmetric_) clear(pu_), clear(rest_);
	}

	void add(const PorePoint& point, const FlowPoint<Dim>& s, const Patch<Dim>& patch, const PointFunctions<Dim>& f, const PresentFunctions<Dim>& now)
	{
		take(patch, f, now);
		addForces(point, s);
		if (sum_.couplings) addSymmetric(point, s);
		if (sum_.couplings && !isSymmetric_) addRest(point, s);
	}

	void scatterAdd() const
	{
		for (int n = 0; n < N; ++n) {
			if (node_[n] < 0) continue;
			for (int i = 0; i < Dim; ++i)
				sum_.force[0][Dim * node_[n] + i] += force_[i][n], sum_.sizes[0][Dim * node_[n] + i] += sizes_[i][n];
			sum_.force[field][node_[n]] += force_[Dim][n], sum_.sizes[field][node_[n]] += sizes_[Dim][n];
		}
		if (!sum_.couplings) return;
		scatterStiffness();
		scatterCouplings();
	}

private:
	static constexpr int               field = 1; // of the pressure
	template <class Array> static void clear(Array& array) { std::memset(array, 0, sizeof array); }

	/// The functions of a point, zero at nodes that it does not have.
	void take(const Patch<Dim>& patch, const PointFunctions<Dim>& f, const PresentFunctions<Dim>& now)
	{
		const auto& place = Window<Dim>::get().place[patch.span];
		clear(value_), clear(hoop_), clear(along_), clear(gradient_), clear(dilation_);
		count_ = 0;
		for (int n = 0; n < f.count; ++n) {
			if (patch.node[n] < 0) continue;
			const int a    = place[n];
			own_[count_++] = a;
			value_[a] = f.value[n], hoop_[a] = now.hoop[n], along_[a] = now.along[n];
			for (int i = 0; i < Dim; ++i)
				gradient_[i][a] = now.gradient[n][i], dilation_[i][a] = now.dilation[n][i];
		}
	}

	void addForces(const PorePoint& point, const FlowPoint<Dim>& s)
	{
		const double V = point.volume * s.J, flow = duration_ * V * s.density * s.kappa.value, stored = point.volume / point.ratio * s.content;
		for (int m = 0; m < count_; ++m) {
			const int a = own_[m];
			for (int i = 0; i < Dim; ++i) {
				const double push = -V * s.pressure * dilation_[i][a];
				force_[i][a] += push, sizes_[i][a] += std::abs(push);
			}
			const double passes = flow * along_[a], ofStored = stored * value_[a];
			force_[Dim][a] += passes + ofStored, sizes_[Dim][a] += std::abs(passes) + std::abs(ofStored);
		}
	}
	static void addTimes(Row& to, double factor, const Row& row)
	{
		for (int b = 0; b < N; ++b)
			to[b] += factor * row[b];
	}

	/// With w = grad p and g the present gradients: see the page on theory. Row by row, so that columns are side by
	/// side.
	void addSymmetric(const PorePoint& point, const FlowPoint<Dim>& s)
	{
		const double V = point.volume * s.J, flow = duration_ * V * s.density * s.kappa.value, pushes = V * s.pressure;
		const double stored = point.volume / point.ratio * (point.content + s.content) / modulus_;
		for (int m = 0; m < count_; ++m) {
			const int a = own_[m];
			for (int i = 0; i < Dim; ++i) {
				addTimes(up_[i][a], -V * dilation_[i][a], value_);
				addTimes(pp_[a], flow * gradient_[i][a], gradient_[i]);
				for (int k = 0; k < Dim; ++k) {
					Row&         to   = uu_[Dim * i + k][a];
					const double turn = pushes * gradient_[k][a], push = pushes * dilation_[i][a];
					for (int b = 0; b < N; ++b)
						to[b] += turn * gradient_[i][b] - push * dilation_[k][b];
				}
			}
			if (hoop_[a] != 0) addTimes(uu_[0][a], pushes * hoop_[a], hoop_);
			if (stored != 0) addTimes(pp_[a], stored * value_[a], value_);
		}
	}
	/// What has no transpose, and the other half of what has one.
	void addRest(const PorePoint& point, const FlowPoint<Dim>& s)
	{
		const double V = point.volume * s.J, E = s.density, flow = duration_ * V * E * s.kappa.value, led = flow * (1 + s.kappa.slope);
		for (int m = 0; m < count_; ++m) {
			const int a        = own_[m];
			Row       products = {};
			for (int i = 0; i < Dim; ++i)
				addTimes(products, gradient_[i][a], gradient_[i]);
			for (int i = 0; i < Dim; ++i) {
				addTimes(pu_[i][a], V * E * value_[a] + led * along_[a], dilation_[i]);
				addTimes(pu_[i][a], -flow * s.slope[i], products);
				addTimes(pu_[i][a], -flow * gradient_[i][a], along_);
			}
			addTimes(rest_[a], flow / modulus_ * along_[a], value_);
		}
	}

	Mat<Dim> stiffness(int m, int n) const
	{
		Mat<Dim> block;
		for (int i = 0; i < Dim; ++i)
			for (int k = 0; k < Dim; ++k)
				block(i, k) = uu_[Dim * i + k][m][n];
		return block;
	}
	void scatterStiffness() const
	{
		const auto& code = Window<Dim>::get().code;
		for (int m = 0; m < N; ++m) {
			if (node_[m] < 0) continue;
			for (int n = m; n < N; ++n) {
				if (node_[n] < 0) continue;
				if (!isSymmetric_) {
					sum_.K->add(node_[m], node_[n], code[m][n], stiffness(m, n));
					if (m < n) sum_.K->add(node_[n], node_[m], code[n][m], stiffness(m, n).transpose());
				} else if (sum_.K->keeps(node_[m])) {
					double* out = sum_.K->at(node_[m], code[m][n]);
					for (int i = 0; i < Dim * Dim; ++i)
						out[i] += uu_[i][m][n];
				}
			}
		}
	}
	void scatterCouplings() const
	{
		using Column      = Eigen::Matrix<double, Dim, 1>;
		using Number      = Eigen::Matrix<double, 1, 1>;
		const auto column = [](const auto& rows, int m, int n) {
			Column x;
			for (int i = 0; i < Dim; ++i)
				x[i] = rows[i][m][n];
			return x;
		};
		auto& K = *sum_.couplings;
		for (int m = 0; m < N; ++m) {
			if (node_[m] < 0) continue;
			K.addRow({ 0, node_[m] }, field, node_.data(), N, [&](int n) { return column(up_, m, n); });
			K.addRow({ field, node_[m] }, field, node_.data(), N, [&](int n) { return Number(pp_[m][n]); });
			if (isSymmetric_) continue;
			K.addRow({ field, node_[m] }, 0, node_.data(), N, [&](int n) { return Eigen::Matrix<double, 1, Dim>(column(pu_, m, n).transpose()); });
			K.addRow({ field, node_[m] }, field, node_.data(), N, [&](int n) { return Number(rest_[m][n]); });
		}
	}

	const FieldSum<Dim>& sum_;
	const bool           isSymmetric_;
	const double         duration_, modulus_;
	std::array<int, N>   node_;
	Row                  force_[Dim + 1], sizes_[Dim + 1];                      // the last one: of the pressure
	Row                  uu_[Dim * Dim][N], up_[Dim][N], pp_[N];                // by rows
	Row                  pu_[Dim][N], rest_[N];                                 // where the matrix is not symmetric; rest: of pp
	Row                  value_, hoop_, along_, gradient_[Dim], dilation_[Dim]; // of the point at hand
	int                  own_[N], count_ = 0;                                   // its nodes
};

} // namespace gimpm
