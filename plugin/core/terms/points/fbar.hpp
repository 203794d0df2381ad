// SPDX-License-Identifier: GPL-2.0-or-later
// F-bar against volumetric locking: the law of a point sees the increment dF-bar = (J_0 / J)^(1/n) dF, whose volumetric
// part J_0 = det dF_0 is that in the centre of the matter in the cells that the point's domain lies in. n axes are
// scaled: the two of plane strain, or three, of which one may go around.
//
// The forces are the derivative of what a hyperelastic law stores, sum V_0 psi(F-bar): f_a = V_0 (dev t g_a + tr_n t /
// n g0_a), with t the Kirchhoff stress and g, g0 the gradients of the basis functions at the point and at the centres.
// So a symmetric law has a symmetric stiffness, which the form of E. de Souza Neto et al. (1996, Int. J. Solids Struct.
// 33: 3277-3296) has not, and no node is coupled to others than without F-bar.
#pragma once
#include "core/terms/points/point_kernel.hpp"

namespace gimpm {

/// exp(x) - 1: its series, exact to round-off for small x, is several times faster than std::expm1.
template <class T> GIMPM_INLINE T expm1(const T& x)
{
	if (!everywhere(abs(x) <= T(0.05))) return each(x, [](double y) { return std::expm1(y); });
	T sum(1);
	for (int k = 9; k > 1; --k)
		sum = T(1) + x * T(1. / k) * sum;
	return x * sum;
}

/// det(1 + gradient) - 1, without the cancellation.
template <int Dim, class T> GIMPM_INLINE T volumeGrowth(const MatrixOf<Dim, T>& gradient)
{
	const T linear = gradient.trace();
	if constexpr (Dim == 2) return linear + gradient.determinant();
	else {
		T minors(0);
		for (int i = 0; i < 3; ++i) {
			const int j = (i + 1) % 3;
			minors += gradient(i, i) * gradient(j, j) - gradient(i, j) * gradient(j, i);
		}
		return linear + minors + gradient.determinant();
	}
}

/// Chunk with what F-bar needs besides.
template <int Dim, int Axes = Dim> struct FBarChunk : Chunk<Dim, Axes> {
	using Chunk<Dim, Axes>::capacity;
	using Chunk<Dim, Axes>::batches;
	using Chunk<Dim, Axes>::width;
	static constexpr bool hasCentres = true;

	/// Gradients of the basis functions at the centres, node by node; turn() makes g0 of them.
	Lanes centre[capacity][Axes][width];
	Lanes centreGradient[batches][Dim][Axes];   ///< gradients of the displacements
	Lanes meanStress[batches];                  ///< times volume: its force on node a is along g0_a
	Lanes bulk[batches];                        ///< its derivative, times volume
	Lanes meanOfStrain[batches][Dim][Axes];     ///< and by the displacements of node b: d_b . mean . grad_b
	Lanes stressOfDilation[batches][Dim][Axes]; ///< derivative of the other flux by the dilation

	FBarChunk()
	{
		for (auto& point : centre)
			for (auto& axis : point)
				for (auto& lanes : axis)
					lanes = Lanes(0);
		for (auto& batch : centreGradient)
			for (auto& row : batch)
				for (auto& lanes : row)
					lanes = Lanes(0);
	}
	double*       centreAt(int point, int axis) { return reinterpret_cast<double*>(centre[point - this->first][axis]); }
	const double* centreAt(int point, int axis) const { return reinterpret_cast<const double*>(centre[point - this->first][axis]); }

	double meanStressAt(int point) const { return meanStress[(point - this->first) / Lanes::count][(point - this->first) % Lanes::count]; }

	/// From gradients in the configuration at the start of the step to current ones, for the points of a batch.
	GIMPM_INLINE void turn(int b, const MatrixOf<Dim, Lanes>& inverse, const Lanes& around)
	{
		for (int lane = 0; lane < Lanes::count; ++lane)
			for (int v = 0; v < width; ++v) {
				auto& point = centre[b * Lanes::count + lane];
				Lanes turned[Dim];
				for (int i = 0; i < Dim; ++i) {
					turned[i] = point[0][v] * Lanes(inverse(0, i)[lane]);
					for (int j = 1; j < Dim; ++j)
						turned[i] += point[j][v] * Lanes(inverse(j, i)[lane]);
				}
				for (int i = 0; i < Dim; ++i)
					point[i][v] = turned[i];
				if constexpr (Axes > Dim) point[Dim][v] *= Lanes(around[lane]);
			}
	}
};

template <int Dim, int Axes, int Span>
GIMPM_INLINE void prepare(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const PatchVectors<Dim, Span>& u, int begin, int end, FBarChunk<Dim, Axes>& chunk)
{
	prepare(basis, points, u, begin, end, static_cast<Chunk<Dim, Axes>&>(chunk));
	for (int p = begin; p < end; ++p)
		formGradients<Axes>(
		        points.centres[p], points.hoopCentres.data() + (Axes > Dim ? p : 0), u, [&](int j) GIMPM_INLINE_LAMBDA { return chunk.centreAt(p, j); },
		        [&](int i, int j, double value) GIMPM_INLINE_LAMBDA {
			        const int q                                                      = p - chunk.first;
			        chunk.centreGradient[q / Lanes::count][i][j].v[q % Lanes::count] = value;
		        });
}

/// The increment of a batch, and the one that its laws see.
template <int Dim, int Axes> struct FBarIncrement {
	using M                   = MatrixOf<Dim, Lanes>;
	static constexpr int axes = Axes; ///< number of axes that are scaled

	Increment<Dim, Axes> own, centre;
	M                    F, F0;
	Lanes                J, J0;
	Increment<Dim, Axes> seen; ///< dF-bar - 1

	GIMPM_INLINE FBarIncrement(const FBarChunk<Dim, Axes>& chunk, int b) : own(chunk.gradient[b]), centre(chunk.centreGradient[b])
	{
		F = own.gradient + M::Identity(), F0 = centre.gradient + M::Identity();
		const Lanes growth = growthOf(own), growth0 = growthOf(centre);
		J = Lanes(1) + growth, J0 = Lanes(1) + growth0;
		const Lanes scale = expm1(Lanes(log1p(Lanes((growth0 - growth) / J)) * Lanes(1. / axes))); // minus 1
		seen.gradient     = own.gradient + M(F * scale);
		if constexpr (Axes > Dim) seen.hoop = own.hoop + (Lanes(1) + own.hoop) * scale;
	}

private:
	GIMPM_INLINE static Lanes growthOf(const Increment<Dim, Axes>& increment)
	{
		const Lanes growth = volumeGrowth<Dim>(increment.gradient);
		if constexpr (Axes > Dim) return growth + increment.hoop + growth * increment.hoop;
		return growth;
	}
};

/// The response to dF-bar, apart: what changes shapes, and what changes volumes, in the axes that are scaled.
template <int Dim, int Axes> struct VolumetricSplit {
	static constexpr int   n = FBarIncrement<Dim, Axes>::axes;
	ResponseOf<Lanes>      deviator;         ///< t - mean, and its tangent to a strain without dilation
	Lanes                  mean { 0. };      ///< mean of the stresses
	Lanes                  bulk { 0. };      ///< its derivative by the dilation, which is the sum of the strains
	PrincipalValues<Lanes> meanOfStrain;     ///< its derivative by a strain without dilation
	PrincipalValues<Lanes> stressOfDilation; ///< the derivative of the deviator by the dilation

	GIMPM_INLINE explicit VolumetricSplit(const ResponseOf<Lanes>& r) : deviator(r)
	{
		const Lanes share(1. / n);
		for (int i = 0; i < n; ++i) {
			meanOfStrain[i] = stressOfDilation[i] = Lanes(0);
			for (int j = 0; j < n; ++j) {
				meanOfStrain[i] += share * r.tangent(j, i);
				stressOfDilation[i] += share * r.tangent(i, j);
			}
			mean += share * r.stress[i];
			bulk += share * meanOfStrain[i];
		}
		for (int i = 0; i < n; ++i) {
			deviator.stress[i] = r.stress[i] - mean;
			for (int j = 0; j < n; ++j)
				deviator.tangent(i, j) = r.tangent(i, j) - meanOfStrain[j] - stressOfDilation[i] + bulk;
		}
		for (int i = 0; i < n; ++i) {
			meanOfStrain[i] += -bulk;
			stressOfDilation[i] += -bulk;
		}
	}
};

} // namespace gimpm
