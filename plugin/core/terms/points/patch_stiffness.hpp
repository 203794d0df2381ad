// SPDX-License-Identifier: GPL-2.0-or-later
// Stiffness of the points of a patch: a product of small dense matrices, with the columns side by side.
#pragma once
#include "core/terms/points/point_kernel.hpp"

namespace gimpm {

/// Sum over points of grad_a,j V a_ijkl grad_b,l for the N nodes of a patch, by pairs of displacement components (i <=
/// k if it is symmetric): block(i, k)(a, b) = K_(a,i)(b,k).
///
/// F-bar adds products with the gradients g0 at the centres (core/terms/points/fbar.hpp), those with g0_a,i and, of the
/// change of g0 with the displacements, with g0_a,k: to each, as to each grad_a,j, belongs a flux of node b.
template <class ChunkOfPoints, int N, bool Symmetric> class PatchStiffness {
	static constexpr int Dim = ChunkOfPoints::dim, Axes = ChunkOfPoints::axes;
	using Pairs                     = PairModuli<Dim>;
	static constexpr int pairs      = Symmetric ? Pairs::upper : Dim * Dim;
	static constexpr int width      = (N + Lanes::count - 1) / Lanes::count; ///< width of a row, in Lanes
	static constexpr int rowsMost   = ChunkOfPoints::hasCentres ? 2 * Axes - Dim + 2 : Axes;
	static constexpr int rowsAtOnce = width > 3 ? 2 : width > 2 ? 3 : 4; ///< rows whose sums fit into registers

public:
	/// Adds the products of the points [begin, end).
	GIMPM_INLINE void multiply(const ChunkOfPoints& chunk, int begin, int end)
	{
		Pairs::template forPairs<Symmetric>([&](int i, int k, int pair) GIMPM_INLINE_LAMBDA {
			formFlux(chunk, pair, i, k, begin, end);
			if constexpr (ChunkOfPoints::hasCentres) addCentreFlux(chunk, i, k, begin, end);
			if (i == k) sumRows<fluxes(true), Symmetric, 0>(chunk, sum_[pair], i, k, begin, end);
			else
				sumRows<fluxes(false), false, 0>(chunk, sum_[pair], i, k, begin, end);
		});
	}
	template <class Codes> GIMPM_INLINE void scatterAdd(const int* node, const Codes& codes, NodeMatrix<Dim>& K) const
	{
		for (int a = 0; a < N; ++a) {
			if (!K.keeps(node[a])) continue;
			for (int b = a; b < N; ++b) {
				if (node[b] < 0) continue;
				double* out = K.at(node[a], codes.code[a][b]);
				if constexpr (Symmetric) addSymmetric(a, b, out);
				else
					addBoth(a, b, out, a == b ? nullptr : K.skewAt(node[a], codes.code[a][b]));
			}
		}
	}

private:
	GIMPM_INLINE void addSymmetric(int a, int b, double* out) const
	{
		Pairs::template forPairs<true>([&](int i, int k, int pair) GIMPM_INLINE_LAMBDA {
			out[i * Dim + k] += at(sum_[pair][a], b);
			if (i != k) out[k * Dim + i] += at(sum_[pair][b], a);
		});
	}
	/// K_ab, and what K_ba^T differs from it by.
	GIMPM_INLINE void addBoth(int a, int b, double* out, double* skew) const
	{
		Pairs::template forPairs<false>([&](int i, int k, int pair) GIMPM_INLINE_LAMBDA {
			out[i * Dim + k] += at(sum_[pair][a], b);
			if (!skew) return;
			skew[i * Dim + k] -= at(sum_[pair][a], b);
			skew[k * Dim + i] += at(sum_[pair][b], a);
		});
	}
	static double at(const Lanes* row, int n) { return reinterpret_cast<const double*>(row)[n]; }

	/// flux_j,b = V a_ijkl grad_b,l of each point, for the pair (i, k).
	GIMPM_INLINE void formFlux(const ChunkOfPoints& chunk, int pair, int i, int k, int begin, int end)
	{
		for (int p = begin; p < end; ++p) {
			const int   q = p - chunk.first, lane = q % Lanes::count;
			const auto& a = chunk.moduli.value[pair][q / Lanes::count];
			for (int j = 0; j < directions(i); ++j)
				for (int v = 0; v < width; ++v) {
					Lanes sum = Lanes(at(&a[j][0], lane)) * chunk.basis[q][0][v];
					for (int l = 1; l < directions(k); ++l)
						sum += Lanes(at(&a[j][l], lane)) * chunk.basis[q][l][v];
					flux_[p - begin][j][v] = sum;
				}
		}
	}
	/// The same for the gradients at the centres.
	GIMPM_INLINE void addCentreFlux(const ChunkOfPoints& chunk, int i, int k, int begin, int end)
	{
		for (int p = begin; p < end; ++p) {
			const int   q = p - chunk.first, batch = q / Lanes::count, lane = q % Lanes::count;
			const auto  of   = [lane](const Lanes& x) GIMPM_INLINE_LAMBDA { return Lanes(at(&x, lane)); };
			const Lanes mean = of(chunk.meanStress[batch]), bulk = of(chunk.bulk[batch]);
			const auto& g0   = chunk.centre[q];
			auto&       flux = flux_[p - begin];
			for (int v = 0; v < width; ++v) {
				const Lanes growth
				        = isRing && k == 0 ? g0[k][v] + g0[Axes - 1][v] : g0[k][v]; // growth of the volume, by the displacements of the nodes
				Lanes dilation = bulk * growth;
				for (int j = 0; j < directions(i); ++j)
					flux[j][v] += of(chunk.stressOfDilation[batch][i][j]) * growth;
				for (int j = 0; j < directions(k); ++j)
					dilation += of(chunk.meanOfStrain[batch][k][j]) * chunk.basis[q][j][v];
				for (int j = directions(i); j < rowsOf(i, k); ++j) {
					const int axis = centreOf(j, i, k);
					if (i != k && axis == k) flux[j][v] = -(mean * g0[i][v]);
					else
						flux[j][v] = i == k ? dilation - mean * g0[axis][v] : dilation;
				}
			}
		}
	}
	static constexpr bool isRing = Axes > Dim;
	static constexpr int  directions(int component) { return directionsOf<Dim, Axes>(component); }
	/// Fluxes of a point for a pair of components: one for each gradient of the first one, then those for gradients
	/// at the centres.
	static constexpr int rowsOf(int i, int k) { return ChunkOfPoints::hasCentres ? 2 * directions(i) - Dim + 1 + (i != k) : directions(i); }
	/// The same where it is known to the compiler, which unrolls the sums then; 0: it is not.
	static constexpr int fluxes(bool onDiagonal) { return isRing ? 0 : onDiagonal ? rowsOf(0, 0) : rowsOf(0, 1); }
	/// The direction at the centres of the flux number j: those of the first component, by which volumes change,
	/// then k.
	static constexpr int centreOf(int j, int i, int k)
	{
		const int number = j - directions(i);
		if (number == 0) return i;
		return isRing && i == 0 && number == 1 ? Axes - 1 : k;
	}
	/// Row that the flux number j of a point is multiplied with.
	GIMPM_INLINE static const double* rowAt(const ChunkOfPoints& chunk, int p, int j, int i, int k)
	{
		if constexpr (ChunkOfPoints::hasCentres)
			if (j >= directions(i)) return chunk.centreAt(p, centreOf(j, i, k));
		return chunk.basisAt(p, j);
	}
	/// Rows from First on; of a symmetric block only the columns from the diagonal on are needed.
	template <int Fluxes, bool Half, int First>
	GIMPM_INLINE void sumRows(const ChunkOfPoints& chunk, Lanes (&block)[N][width], int i, int k, int begin, int end) const
	{
		if constexpr (First < N) {
			constexpr int rows = N - First < rowsAtOnce ? N - First : rowsAtOnce, from = Half ? First / Lanes::count : 0;
			Lanes         sum[rows][width - from];
			for (auto& row : sum)
				for (auto& lanes : row)
					lanes = Lanes(0);
			for (int p = begin; p < end; ++p)
				for (int j = 0; j < (Fluxes > 0 ? Fluxes : rowsOf(i, k)); ++j) {
					const double* grad = rowAt(chunk, p, j, i, k) + First;
					const Lanes*  flux = flux_[p - begin][j] + from;
					for (int r = 0; r < rows; ++r)
						for (int v = 0; v < width - from; ++v)
							sum[r][v] += Lanes(grad[r]) * flux[v];
				}
			for (int r = 0; r < rows; ++r)
				for (int v = from; v < width; ++v)
					block[First + r][v] = sum[r][v - from];
			sumRows<Fluxes, Half, First + rows>(chunk, block, i, k, begin, end);
		}
	}

	Lanes sum_[pairs][N][width];
	Lanes flux_[ChunkOfPoints::capacity][rowsMost][width];
};

} // namespace gimpm
