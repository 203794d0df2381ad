// SPDX-License-Identifier: GPL-2.0-or-later
// The way of the material points through a pass. What depends on the number of nodes is computed point by point, with
// the nodes of its patch side by side; the response of the material, which does not, with several points side by side.
#pragma once
#include "core/materials/kinematics.hpp"
#include "core/terms/points/internal_force.hpp"

namespace gimpm {

// Axes: directions of gradients. Where there is one more than displacement components, the body is one of revolution
// about an axis, x is the radius, and the last direction goes around: along it only the radial displacement has a
// gradient, u_x / x.

/// Directions along which a displacement component has a gradient.
template <int Dim, int Axes> constexpr int directionsOf(int component) { return component == 0 ? Axes : Dim; }

template <int Dim, int Span> constexpr int nodesOfSpan()
{
	int n = 1;
	for (int a = 0; a < Dim; ++a)
		n *= 2 + (Span >> a & 1);
	return n;
}

/// The nodes of a patch, x fastest: rows of 2 or 3 nodes.
template <int Dim, int Span> struct PatchNodes {
	static constexpr int N = nodesOfSpan<Dim, Span>(), inRow = 2 + (Span & 1), rows = N / inRow;

	/// Position of a node along an axis: 0, 1 or 2.
	static constexpr int along(int node, int axis)
	{
		for (int a = 0; a < axis; ++a)
			node /= 2 + (Span >> a & 1);
		return node % (2 + (Span >> axis & 1));
	}
	/// The same of all nodes of a row, for the other axes.
	static constexpr int rowAlong(int row, int axis) { return along(row * inRow, axis); }

	/// Product of the values of all axes but x, with the slope instead of the value for one of them (or for none).
	GIMPM_INLINE static double rowFactor(const PointBasis<Dim>& axes, int row, int derived)
	{
		double product = 1;
		for (int a = 1; a < Dim; ++a)
			product *= (a == derived ? axes[a].gradient : axes[a].value)[rowAlong(row, a)];
		return product;
	}
};

/// Components of a nodal vector at the nodes of a patch, row by row; zero beyond walls and beyond the end of a row.
template <int Dim, int Span> struct PatchVectors {
	using Nodes = PatchNodes<Dim, Span>;
	Lanes row[Dim][Nodes::rows];

	PatchVectors()
	{
		for (auto& component : row)
			for (auto& lanes : component)
				lanes = Lanes(0);
	}
	PatchVectors(const Patch<Dim>& patch, const Eigen::VectorXd& x) : PatchVectors()
	{
		for (int n = 0; n < Nodes::N; ++n)
			for (int i = 0; i < Dim; ++i)
				if (patch.node[n] >= 0) row[i][n / Nodes::inRow].v[n % Nodes::inRow] = x[Dim * patch.node[n] + i];
	}
	void scatterAdd(const Patch<Dim>& patch, Eigen::VectorXd& x) const
	{
		for (int n = 0; n < Nodes::N; ++n)
			for (int i = 0; i < Dim; ++i)
				if (patch.node[n] >= 0) x[Dim * patch.node[n] + i] += row[i][n / Nodes::inRow][n % Nodes::inRow];
	}
	/// Magnitudes, whatever the signs.
	void scatterAddAbsolute(const Patch<Dim>& patch, Eigen::VectorXd& x) const
	{
		for (int n = 0; n < Nodes::N; ++n)
			for (int i = 0; i < Dim; ++i)
				if (patch.node[n] >= 0) x[Dim * patch.node[n] + i] += std::abs(row[i][n / Nodes::inRow][n % Nodes::inRow]);
	}
};

/// Points that go through a pass together, Lanes::count times.
constexpr int batchesAtOnce = 4;

/// Moduli times volume of these points, by pairs of displacement components: value(i, k)[batch][j][l] = V a_ijkl. The
/// pairs i <= k come first; the others are touched only where a law is not symmetric.
template <int Dim, int Axes = Dim> struct PairModuli {
	static constexpr int upper = Dim * (Dim + 1) / 2;
	Lanes                value[Dim * Dim][batchesAtOnce][Axes][Axes];

	/// Calls f(i, k, number of the pair).
	template <bool Symmetric, class F> GIMPM_INLINE static void forPairs(F&& f)
	{
		for (int i = 0, pair = 0; i < Dim; ++i)
			for (int k = i; k < Dim; ++k)
				f(i, k, pair++);
		if constexpr (!Symmetric)
			for (int i = 1, pair = upper; i < Dim; ++i)
				for (int k = 0; k < i; ++k)
					f(i, k, pair++);
	}
};

/// Some points that follow each other in the order of the basis, on their way through a pass.
template <int Dim, int Axes = Dim> struct Chunk {
	static constexpr int  dim = Dim, axes = Axes, batches = batchesAtOnce, capacity = batches * Lanes::count;
	static constexpr int  width      = (windowNodes<Dim> + Lanes::count - 1) / Lanes::count;
	static constexpr bool hasCentres = false; ///< see FBarChunk

	int first = 0, count = 0;
	/// Gradients of the basis functions of a point, node by node.
	Lanes                 basis[capacity][Axes][width];
	Lanes                 gradient[batches][Dim][Axes]; ///< gradients of the displacements, a point in each lane
	Lanes                 flux[batches][Dim][Axes];     ///< the force on node a is flux . grad_a
	PairModuli<Dim, Axes> moduli;

	Chunk() // values beyond the last node or point are computed with, and not used
	{
		for (auto& point : basis)
			for (auto& axis : point)
				for (auto& lanes : axis)
					lanes = Lanes(0);
		for (auto& batch : gradient)
			for (auto& row : batch)
				for (auto& lanes : row)
					lanes = Lanes(0);
	}
	int           last() const { return first + count; }
	double*       basisAt(int point, int axis) { return reinterpret_cast<double*>(basis[point - first][axis]); }
	const double* basisAt(int point, int axis) const { return reinterpret_cast<const double*>(basis[point - first][axis]); }
	double        fluxAt(int point, int i, int j) const { return flux[(point - first) / Lanes::count][i][j][(point - first) % Lanes::count]; }
	double&       gradientAt(int point, int i, int j) { return gradient[(point - first) / Lanes::count][i][j].v[(point - first) % Lanes::count]; }
};

/// The gradients of a point's basis functions, stored at basisAt(axis), and keep(i, j, d u_i / d x_j) of the
/// displacements u. `hoop`: the functions of x that give the hoop strain, if there is one.
template <int Axes, int Dim, int Span, class At, class Keep>
GIMPM_INLINE void formGradients(const PointBasis<Dim>& axes, const AxisValues* hoop, const PatchVectors<Dim, Span>& u, At&& basisAt, Keep&& keep)
{
	using Nodes       = PatchNodes<Dim, Span>;
	const Lanes value = loadLanes(axes[0].value), derivative = loadLanes(axes[0].gradient);
	Lanes       gradient[Dim][Axes];
	for (auto& row : gradient)
		for (auto& lanes : row)
			lanes = Lanes(0);
	for (int r = 0; r < Nodes::rows; ++r) {
		for (int j = 0; j < Dim; ++j) {
			const Lanes g = (j == 0 ? derivative : value) * Lanes(Nodes::rowFactor(axes, r, j));
			// The next row begins where the nodes of this one end.
			storeLanes(basisAt(j) + r * Nodes::inRow, g);
			for (int i = 0; i < Dim; ++i)
				gradient[i][j] += u.row[i][r] * g;
		}
		if constexpr (Axes > Dim) {
			const Lanes g = loadLanes(hoop->data()) * Lanes(Nodes::rowFactor(axes, r, 0));
			storeLanes(basisAt(Dim) + r * Nodes::inRow, g);
			gradient[0][Dim] += u.row[0][r] * g;
		}
	}
	for (int i = 0; i < Dim; ++i)
		for (int j = 0; j < directionsOf<Dim, Axes>(i); ++j)
			keep(i, j, sum(gradient[i][j]));
}

/// Basis functions of the points [begin, end) of one patch, and the gradients of the displacements u there.
template <int Dim, int Axes, int Span>
GIMPM_INLINE void prepare(const CloudBasis<Dim>& basis, const StepPoints<Dim>&, const PatchVectors<Dim, Span>& u, int begin, int end, Chunk<Dim, Axes>& chunk)
{
	for (int p = begin; p < end; ++p)
		formGradients<Axes>(
		        basis.axes[p], basis.hoop.data() + (Axes > Dim ? p : 0), u, [&](int j) GIMPM_INLINE_LAMBDA { return chunk.basisAt(p, j); },
		        [&](int i, int j, double value) GIMPM_INLINE_LAMBDA { chunk.gradientAt(p, i, j) = value; });
}

/// Points side by side. Lanes beyond the last point of a chunk repeat it.
struct Batch {
	int point[Lanes::count];
	int count; ///< number of points that are no repetition

	GIMPM_INLINE Batch(int first, int last) : count(std::min(Lanes::count, last - first))
	{
		for (int lane = 0; lane < Lanes::count; ++lane)
			point[lane] = std::min(first + lane, last - 1);
	}
	template <class F> GIMPM_INLINE Lanes load(F&& f) const
	{
		return lanes([&](int lane) GIMPM_INLINE_LAMBDA { return f(point[lane]); });
	}
};

/// Gradient of the incremental displacements of a batch.
template <int Dim, int Axes> struct Increment {
	MatrixOf<Dim, Lanes> gradient;
	Lanes                hoop { 0. }; ///< around the axis of a body of revolution

	Increment() = default;
	GIMPM_INLINE explicit Increment(const Lanes (&from)[Dim][Axes])
	{
		for (int i = 0; i < Dim; ++i)
			for (int j = 0; j < Dim; ++j)
				gradient(i, j) = from[i][j];
		if constexpr (Axes > Dim) hoop = from[0][Dim];
	}
};

template <int Dim, int Axes> GIMPM_INLINE SymTensor<Dim, Lanes> pushForward(const SymTensor<Dim, Lanes>& b1, const Increment<Dim, Axes>& increment)
{
	auto pushed = pushForward(b1, increment.gradient);
	if constexpr (Axes > Dim) pushed.c[3] += (Lanes(1) + pushed.c[3]) * increment.hoop * (Lanes(2) + increment.hoop);
	return pushed;
}

/// Calls f(std::integral_constant<int, span>) with the patch's span as a compile-time constant.
template <int Dim, int Span = (1 << Dim) - 1, class F> GIMPM_INLINE void withSpan(int span, F&& f)
{
	if constexpr (Span >= 0) {
		if (span == Span) f(std::integral_constant<int, Span>());
		else
			withSpan<Dim, Span - 1>(span, f);
	}
}

/// Calls f(span, patch, begin, end) for the points of each patch that are in the chunk; `patch` is the first that may
/// be.
template <int Dim, int Axes, class F> GIMPM_INLINE void forPieces(const CloudBasis<Dim>& basis, const Chunk<Dim, Axes>& chunk, int patch, F&& f)
{
	for (; patch < int(basis.patches.size()) && basis.patches[patch].first < chunk.last(); ++patch) {
		const auto& p     = basis.patches[patch];
		const int   begin = std::max(p.first, chunk.first), end = std::min(p.first + p.count, chunk.last());
		if (begin < end) withSpan<Dim>(p.span, [&](auto span) GIMPM_INLINE_LAMBDA { f(span, p, begin, end); });
	}
}

/// Calls f(chunk, first patch) for all points of the patches [first, last).
template <class ChunkOfPoints, int Dim, class F> GIMPM_INLINE void forChunks(const CloudBasis<Dim>& basis, int first, int last, F&& f)
{
	const int     end = basis.patches[last - 1].first + basis.patches[last - 1].count;
	ChunkOfPoints chunk;
	for (int begin = basis.patches[first].first; begin < end; begin += chunk.count) {
		chunk.first = begin;
		chunk.count = std::min(ChunkOfPoints::capacity, end - begin);
		while (basis.patches[first].first + basis.patches[first].count <= begin)
			++first;
		f(chunk, first);
	}
}

} // namespace gimpm
