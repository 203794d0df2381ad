// SPDX-License-Identifier: GPL-2.0-or-later
// Forces and matrix blocks of water in the pores, collected from the points of a few cells before it goes to nodes.
#pragma once
#include "core/terms/coupled_term.hpp"
#include "core/terms/near_nodes.hpp"
#include "core/terms/water/flow_point.hpp"
#include "core/terms/water/unsaturated_point.hpp"
#include <algorithm>
#include <cstring>

namespace gimpm {

/// Offsets between the nodes of the window of a lowest cell, by their code.
template <int Dim> struct Window {
	static constexpr int nodes = windowNodes<Dim>;
	int                  code[nodes][nodes];

	static const Window& get()
	{
		static const Window window;
		return window;
	}

private:
	Window()
	{
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
		for (; end < last && end->cell == first->cell; ++end) {
			const PatchShape<Dim>& shape = patchShapes<Dim>[end->span];
			for (int n = 0; n < shape.count; ++n)
				if (end->node[n] >= 0) node[shape.inWindow[n]] = end->node[n];
		}
	}
	bool isWhole() const { return *std::min_element(node.begin(), node.end()) >= 0; }

	/// Calls f(number in the window, number in the window) for the nodes that there are, each pair once.
	template <class F> void forPairs(F&& f) const
	{
		for (int m = 0; m < nodes; ++m)
			for (int n = m; n < nodes && node[m] >= 0; ++n)
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

/// Blocks of the Jacobian besides those of displacements by displacements.
template <int Dim> struct FlowBlocks {
	NearBlocks<Dim> up, pp; ///< first the field of the row: u displacements, p pressures
	NearBlocks<Dim> pu;     ///< none of a symmetric matrix

	FlowBlocks(const NearNodes<Dim>& near, Couplings& K, int field)
	        : up(near, K, 0, field), pp(near, K, field, field), pu(K.isSymmetric() ? NearBlocks<Dim>() : NearBlocks<Dim>(near, K, field, 0))
	{
	}
};

/// Sums that the points of a lowest cell add to forces and matrix, node by node of its window.
template <int Dim> class FlowSums {
	static constexpr int N = windowNodes<Dim>;
	using Row              = double[(N + 3) / 4 * 4]; // whole registers; what is beyond the nodes is zero

public:
	/// Blocks: null if no derivatives are asked for.
	FlowSums(const FieldSum<Dim>& sum, const FlowBlocks<Dim>* blocks, bool isAxisymmetric, const SoilWater<Dim>& water)
	        : sum_(sum)
	        , blocks_(blocks)
	        , isSymmetric_(!blocks || sum.couplings->isSymmetric())
	        , isAxisymmetric_(isAxisymmetric)
	        , isWhole_(water.whole)
	        , duration_(water.duration)
	        , modulus_(water.modulus)
	        , vertical_(water.vertical)
	        , weight_(isWhole_ ? Vec<Dim>(water.whole->factor * water.whole->weight) : Vec<Dim>(Vec<Dim>::Zero()))
	{
	}

	void begin(const std::array<int, N>& node)
	{
		node_ = node;
		clear(force_), clear(absoluteContributions_);
		if (!blocks_) return;
		clear(turn_), clear(up_), clear(pp_);
		if (isAxisymmetric_) clear(ring_);
		if (!isSymmetric_) clear(pu_);
		if (isWhole_) clear(grown_);
	}

	void add(const PorePoint& point, const FlowPoint<Dim>& s, const Patch<Dim>& patch, const PointFunctions<Dim>& f, const PresentFunctions<Dim>& now)
	{
		take(point, patch, f, now);
		addForces(point, s);
		if (!blocks_) return;
		addSymmetric(point, s);
		if (isAxisymmetric_) addRing(point, s, s.pressure);
		if (!isSymmetric_) addRest(point, s);
	}

	/// The same of pores that need not be full. The matrix is not symmetric.
	void addUnsaturated(
	        const PorePoint& point, const FlowPoint<Dim>& s, const UnsaturatedPoint<Dim>& u, const Patch<Dim>& patch, const PointFunctions<Dim>& f,
	        const PresentFunctions<Dim>& now)
	{
		take(point, patch, f, now);
		std::memset(&wet_, 0, sizeof wet_);
		for (int n = 0; n < f.count; ++n) {
			if (patch.node[n] < 0) continue;
			const int a        = patchShapes<Dim>[patch.span].inWindow[n];
			wet_.saturation[a] = u.saturation[n], wet_.capacity[a] = u.capacity[n], wet_.stored[a] = u.stored[n], wet_.opening[a] = u.opening[n];
			wet_.growth[a] = u.growth[n];
		}
		addForcesUnsaturated(point, s, u);
		if (!blocks_) return;
		addPush(point, s, u);
		if (u.pushGrowth != 0) addPushGrowth(point, s, u);
		if (isAxisymmetric_) addRing(point, s, u.push.value);
		addStorage(point, s, u);
		addDarcy(point, s, u);
	}

	void scatterAdd() const
	{
		for (int n = 0; n < N; ++n) {
			if (node_[n] < 0) continue;
			for (int i = 0; i < Dim; ++i)
				sum_.force[0][Dim * node_[n] + i] += force_[i][n],
				        sum_.absoluteContributions[0][Dim * node_[n] + i] += absoluteContributions_[i][n];
			sum_.force[field][node_[n]] += force_[Dim][n], sum_.absoluteContributions[field][node_[n]] += absoluteContributions_[Dim][n];
		}
		if (!blocks_) return;
		const auto& code = Window<Dim>::get().code;
		for (int m = 0; m < N; ++m)
			for (int n = 0; n < N && node_[m] >= 0; ++n) {
				if (node_[n] < 0) continue;
				if (m <= n && sum_.K->keeps(node_[m])) addStiffness(m, n, sum_.K->at(node_[m], code[m][n]));
				if (isWhole_) addWeight(m, n, code[m][n]);
				addCouplings(m, n, code[m][n]);
			}
	}

private:
	static constexpr int field = 1, turns = Dim * (Dim - 1) / 2; // field of the pressure; pairs of axes
	struct Functions {
		Row value, hoop, along, gradient[Dim], dilation[Dim], vertical;
	};
	struct Wetness {
		Row saturation, capacity, growth, stored, opening;
	};
	template <class Array> static void clear(Array& array) { std::memset(array, 0, sizeof array); }

	/// The functions of a point, zero at nodes that it does not have.
	void take(const PorePoint& point, const Patch<Dim>& patch, const PointFunctions<Dim>& f, const PresentFunctions<Dim>& now)
	{
		const auto& inWindow = patchShapes<Dim>[patch.span].inWindow;
		std::memset(&at_, 0, sizeof at_);
		count_ = 0, rise_ = point.pores->verticalRatio - 1;
		for (int n = 0; n < f.count; ++n) {
			if (patch.node[n] < 0) continue;
			const int a    = inWindow[n];
			own_[count_++] = a;
			at_.value[a] = f.value[n], at_.hoop[a] = now.hoop[n], at_.along[a] = now.along[n];
			for (int i = 0; i < Dim; ++i)
				at_.gradient[i][a] = now.gradient[n][i], at_.dilation[i][a] = now.dilation[n][i];
			if (rise_ != 0) at_.vertical[a] = vertical_.dot(now.gradient[n]);
		}
	}

	void addForces(const PorePoint& point, const FlowPoint<Dim>& s)
	{
		const double V = point.volume * s.J, flow = duration_ * V * s.density * s.kappa.value, stored = point.volume / point.ratio * s.content;
		for (int m = 0; m < count_; ++m) {
			const int a = own_[m];
			for (int i = 0; i < Dim; ++i) {
				const double push = -point.coupling() * V * s.pressure * at_.dilation[i][a];
				force_[i][a] += push, absoluteContributions_[i][a] += std::abs(push);
			}
			const double passes = flow * at_.along[a], ofStored = stored * at_.value[a];
			force_[Dim][a] += passes + ofStored, absoluteContributions_[Dim][a] += std::abs(passes) + std::abs(ofStored);
		}
	}
	static void addTimes(Row& __restrict to, double factor, const Row& __restrict row)
	{
		for (std::size_t b = 0; b < std::size(to); ++b)
			to[b] += factor * row[b];
	}
	/// Three rows at once, in order, so that `to` is read and written once.
	static void addTimes(
	        Row& __restrict to, double first, const Row& __restrict a, double second, const Row& __restrict b, double third, const Row& __restrict c)
	{
		for (std::size_t i = 0; i < std::size(to); ++i)
			to[i] = to[i] + first * a[i] + second * b[i] + third * c[i];
	}

	/// Adds the products of the gradient of a node and those of all, each direction times its conductivity over the
	/// horizontal one.
	void addProducts(Row& to, int a) const
	{
		for (int i = 0; i < Dim; ++i)
			addTimes(to, at_.gradient[i][a], at_.gradient[i]);
		if (rise_ != 0) addTimes(to, rise_ * at_.vertical[a], at_.vertical);
	}

	/// Adds the symmetric part, with w = grad p and g the present gradients: equation (6.5) of
	/// docs/explanation/water.md. Row by row, so that columns are side by side. Displacements by displacements:
	/// pV (g_ak g_bi - g_ai g_bk) for i < k, and its opposite for i > k.
	void addSymmetric(const PorePoint& point, const FlowPoint<Dim>& s)
	{
		const double V = point.volume * s.J, flow = duration_ * V * s.density * s.kappa.value, coupled = point.coupling() * V,
		             pushes = coupled * s.pressure;
		const double stored = point.volume / point.ratio * (point.content + s.content) / modulus_;
		for (int m = 0; m < count_; ++m) {
			const int a = own_[m];
			for (int i = 0, pair = 0; i < Dim; ++i) {
				addTimes(up_[i][a], -coupled * at_.dilation[i][a], at_.value);
				addTimes(pp_[a], flow * at_.gradient[i][a], at_.gradient[i]);
				for (int k = i + 1; k < Dim; ++k, ++pair) {
					addTimes(turn_[pair][a], pushes * at_.gradient[k][a], at_.gradient[i]);
					addTimes(turn_[pair][a], -pushes * at_.gradient[i][a], at_.gradient[k]);
				}
			}
			if (rise_ != 0) addTimes(pp_[a], flow * rise_ * at_.vertical[a], at_.vertical);
			if (stored != 0) addTimes(pp_[a], stored * at_.value[a], at_.value);
		}
	}
	/// Adds the stretch along the circle: of xx, of xy and of yx.
	void addRing(const PorePoint& point, const FlowPoint<Dim>& s, double pressure)
	{
		const double pushes = point.coupling() * point.volume * s.J * pressure;
		for (int m = 0; m < count_; ++m) {
			const int a = own_[m];
			addTimes(ring_[0][a], -pushes * at_.hoop[a], at_.gradient[0]);
			addTimes(ring_[0][a], -pushes * at_.gradient[0][a], at_.hoop);
			addTimes(ring_[1][a], -pushes * at_.hoop[a], at_.gradient[1]);
			addTimes(ring_[2][a], -pushes * at_.gradient[1][a], at_.hoop);
		}
	}
	/// Adds blocks that have no transpose, and the other half of those that have one.
	void addRest(const PorePoint& point, const FlowPoint<Dim>& s)
	{
		const double V = point.volume * s.J, E = s.density, flow = duration_ * V * E * s.kappa.value, led = flow * (1 + s.kappa.logDerivative);
		for (int m = 0; m < count_; ++m) {
			const int a        = own_[m];
			Row       products = {};
			addProducts(products, a);
			for (int i = 0; i < Dim; ++i)
				addTimes(
				        pu_[i][a], point.coupling() * V * E * at_.value[a] + led * at_.along[a], at_.dilation[i], -flow * s.pressureGradient[i],
				        products, -flow * at_.gradient[i][a], at_.along);
			addTimes(pp_[a], flow / modulus_ * at_.along[a], at_.value);
		}
	}

	void addForcesUnsaturated(const PorePoint& point, const FlowPoint<Dim>& s, const UnsaturatedPoint<Dim>& u)
	{
		const double V = point.volume * s.J, V0 = point.volume / point.ratio, flow = duration_ * V * s.density * s.kappa.value * u.permeability;
		const double gained = point.pores->weightPart * V0 * (u.content - point.pores->porosity), pushes = point.coupling() * V * u.push.value;
		for (int m = 0; m < count_; ++m) {
			const int a = own_[m];
			for (int i = 0; i < Dim; ++i) {
				const double push = -pushes * at_.dilation[i][a], weight = -gained * weight_[i] * at_.value[a];
				force_[i][a] += push + weight, absoluteContributions_[i][a] += std::abs(push) + std::abs(weight);
			}
			const double passes = flow * at_.along[a], ofStored = V0 * wet_.stored[a] * at_.value[a];
			force_[Dim][a] += passes + ofStored, absoluteContributions_[Dim][a] += std::abs(passes) + std::abs(ofStored);
		}
	}
	/// Derivatives of the pressure on the grains, and of the weight by pressures.
	void addPush(const PorePoint& point, const FlowPoint<Dim>& s, const UnsaturatedPoint<Dim>& u)
	{
		const double coupled = point.coupling() * point.volume * s.J, weighs = point.pores->weightPart * point.volume / point.ratio,
		             pushes = coupled * u.push.value;
		Row byPressure      = {}; // of the content
		for (int m = 0; m < count_; ++m)
			byPressure[own_[m]] = at_.value[own_[m]] * (wet_.capacity[own_[m]] + u.content / modulus_);
		for (int m = 0; m < count_; ++m) {
			const int a = own_[m];
			for (int i = 0, pair = 0; i < Dim; ++i) {
				addTimes(up_[i][a], -coupled * u.push.slope * at_.dilation[i][a], at_.value);
				addTimes(up_[i][a], -weighs * weight_[i] * at_.value[a], byPressure);
				for (int k = i + 1; k < Dim; ++k, ++pair) {
					addTimes(turn_[pair][a], pushes * at_.gradient[k][a], at_.gradient[i]);
					addTimes(turn_[pair][a], -pushes * at_.gradient[i][a], at_.gradient[k]);
				}
			}
		}
	}
	/// Derivative of the pressure on the grains as the curve changes with the pores.
	void addPushGrowth(const PorePoint& point, const FlowPoint<Dim>& s, const UnsaturatedPoint<Dim>& u) const
	{
		const double grows = point.coupling() * point.volume * s.J * u.pushGrowth;
		const auto&  code  = Window<Dim>::get().code;
		for (int m = 0; m < count_; ++m)
			for (int n = 0; n < count_; ++n) {
				const int a = own_[m], b = own_[n];
				Mat<Dim>  block;
				for (int i = 0; i < Dim; ++i)
					for (int k = 0; k < Dim; ++k)
						block(i, k) = -grows * at_.dilation[i][a] * at_.dilation[k][b];
				sum_.K->add(node_[a], node_[b], code[a][b], block);
			}
	}
	/// Derivatives of the content, whose growth by displacements has weight, too.
	void addStorage(const PorePoint& point, const FlowPoint<Dim>& s, const UnsaturatedPoint<Dim>& u)
	{
		const double grown = point.coupling() * point.volume * s.J * s.density, V0 = point.volume / point.ratio,
		             weighs = grown * point.pores->weightPart * u.content / u.filled + V0 * point.pores->weightPart * u.contentGrowth;
		for (int m = 0; m < count_; ++m) {
			const int a = own_[m];
			for (int i = 0; i < Dim; ++i) {
				addTimes(pu_[i][a], (grown * wet_.saturation[a] + V0 * wet_.growth[a]) * at_.value[a], at_.dilation[i]);
				addTimes(grown_[i][a], weighs * at_.value[a], at_.dilation[i]);
			}
			pp_[a][a] += V0 * at_.value[a] * wet_.capacity[a];
			addTimes(pp_[a], V0 * at_.value[a] * wet_.saturation[a] * u.filled / modulus_, at_.value);
		}
	}
	void addDarcy(const PorePoint& point, const FlowPoint<Dim>& s, const UnsaturatedPoint<Dim>& u)
	{
		const double full = duration_ * point.volume * s.J * s.density * s.kappa.value, flow = full * u.permeability,
		             led = flow * (1 + s.kappa.logDerivative) + full * u.openingGrowth;
		for (int m = 0; m < count_; ++m) {
			const int a        = own_[m];
			Row       products = {};
			addProducts(products, a);
			addTimes(pp_[a], flow, products, full * at_.along[a], wet_.opening, flow / modulus_ * at_.along[a], at_.value);
			for (int i = 0; i < Dim; ++i)
				addTimes(
				        pu_[i][a], led * at_.along[a], at_.dilation[i], -flow * s.pressureGradient[i], products, -flow * at_.gradient[i][a],
				        at_.along);
		}
	}
	/// Weight of the water that a point takes up, on the displacements: it pulls the point down.
	void addWeight(int m, int n, int code) const
	{
		Mat<Dim> block;
		for (int i = 0; i < Dim; ++i)
			for (int k = 0; k < Dim; ++k)
				block(i, k) = -weight_[i] * grown_[k][m][n];
		sum_.K->add(node_[m], node_[n], code, block);
	}

	/// It is symmetric, so that it serves for both of the opposite blocks.
	void addStiffness(int m, int n, double* block) const
	{
		for (int i = 0, pair = 0; i < Dim; ++i)
			for (int k = i + 1; k < Dim; ++k, ++pair)
				block[Dim * i + k] += turn_[pair][m][n], block[Dim * k + i] -= turn_[pair][m][n];
		if (isAxisymmetric_) block[0] += ring_[0][m][n], block[1] += ring_[1][m][n], block[Dim] += ring_[2][m][n];
	}
	void addCouplings(int m, int n, int code) const
	{
		const auto addVector = [&](double* to, const auto& rows) {
			for (int i = 0; i < Dim; ++i)
				to[i] += rows[i][m][n];
		};
		addVector(blocks_->up.at(node_[m], code), up_);
		if (double* to = blocks_->pp.at(node_[m], code)) *to += pp_[m][n];
		if (!isSymmetric_) addVector(blocks_->pu.at(node_[m], code), pu_);
	}

	const FieldSum<Dim>&   sum_;
	const FlowBlocks<Dim>* blocks_;
	const bool             isSymmetric_, isAxisymmetric_, isWhole_;
	const double           duration_, modulus_;
	const Vec<Dim>         vertical_;
	const Vec<Dim>         weight_; // of water on the soil, where it is not that of still water [N/m3]
	std::array<int, N>     node_;
	Row                    force_[Dim + 1], absoluteContributions_[Dim + 1];  // the last one: of the pressure
	Row                    turn_[turns][N], ring_[3][N], up_[Dim][N], pp_[N]; // blocks by rows
	Row                    pu_[Dim][N];                                       // block where the matrix is not symmetric
	Row                    grown_[Dim][N];                                    // content by displacements, where water has its weight
	Wetness                wet_;                                              // wetness of the point at hand, where pores need not be full
	Functions              at_;                                               // functions of the point at hand, zero at other nodes
	int                    own_[N], count_ = 0;                               // its nodes
	double                 rise_ = 0;                                         // its vertical over horizontal conductivity, less one
};

} // namespace gimpm
