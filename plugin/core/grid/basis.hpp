// SPDX-License-Identifier: GPL-2.0-or-later
// Grid basis functions of one axis as seen by one material point.
#pragma once
#include <array>
#include <cmath>

namespace gimpm {

enum class Basis { linear, gimp };

/// Round-off must not populate a cell: an overlap smaller than this fraction of the half length does not count.
constexpr double overlapTolerance = 1.5e-8; // sqrt(machine epsilon)

/// A point on a cell face (within this fraction of a cell) belongs to the lower cell.
constexpr double faceTolerance = 1e-9;

/// Largest integer <= x, for |x| < 2^31: std::floor() is a call of the library on processors without an instruction for
/// it.
inline int floorToInt(double x)
{
	const int truncated = int(x);
	return truncated - (truncated > x);
}

inline int centreCell(double x, double h) { return -floorToInt(faceTolerance - x / h) - 1; }

/// The cells along one axis that the domain of a point lies in.
struct AxisCells {
	int lowest, count; ///< count: 1 or 2

	/// Cells that the domain [x - l, x + l] overlaps, l <= h/2, measured from the grid's origin in cells of size h.
	static AxisCells reached(double x, double l, double h)
	{
		const int    face   = floorToInt(x / h + 0.5); // the only one that the domain can cross
		const double offset = h * face - x;
		if (std::abs(offset) >= l * (1 - overlapTolerance)) return { offset > 0 ? face - 1 : face, 1 };
		return { face - 1, 2 };
	}
};

/// Values and derivatives of the basis functions of one axis. The point's domain lies in one cell (2 nodes) or in two
/// (3 nodes).
struct AxisBasis {
	double value[4];    ///< the last one is zero: four numbers fill a row of lanes
	double gradient[4]; ///< [1/m]

	/// Linear (hat) functions at coordinate x, measured from the grid's origin in cells of size h, as seen from the
	/// given cell. They are also the exact average over any domain inside that cell.
	void setLinear(double x, double h, int cell)
	{
		const double xi = x / h - cell, w = 1 / h;
		set(1 - xi, xi, 0, -w, w, 0);
	}

	/// Hat functions averaged over the domain [x - l, x + l] in its cells (Bardenhagen and Kober 2004). With the
	/// overlaps a and b of the domain with the lower and the upper cell the pieces are S = a^2/4lh, 1 - S_lower -
	/// S_upper, b^2/4lh: their sum is one, their slopes add up to zero, sum S x_v = x and sum dS/dx x_v = 1, all to
	/// round-off: a + b = 2l however far the point is from the origin.
	void setGimp(double x, double l, double h, const AxisCells& cells)
	{
		if (cells.count == 1) return setLinear(x, h, cells.lowest);
		const double offset = h * (cells.lowest + 1) - x, a = l + offset, b = l - offset, w = 1 / (2 * l * h);
		const double sa = 0.5 * w * a * a, sb = 0.5 * w * b * b;
		set(sa, 1 - sa - sb, sb, -w * a, w * (a - b), w * b);
	}

	/// Hat functions averaged over the ring whose section is that domain, at the distance r of its centre from the
	/// axis: each position counts with its own distance (Nairn and Guilkey 2015). So a uniform stress is in balance
	/// wherever domains lie in the cells. Linear fields have their values at the centre of the ring, r + l^2 / 3r.
	void setRing(double x, double r, double l, double h, const AxisCells& cells)
	{
		if (cells.count == 1) return setLinear(x + l * l / (3 * r), h, cells.lowest);
		const double offset = h * (cells.lowest + 1) - x, a = l + offset, b = l - offset, face = r + offset, w = 1 / (2 * l * h * r);
		const double sa = w * a * a * (face / 2 - a / 3), sb = w * b * b * (face / 2 + b / 3), la = w * a * (face - a / 2), lb = w * b * (face + b / 2);
		set(sa, 1 - sa - sb, sb, -la, la - lb, lb);
	}

	/// Share of the length of a domain in two cells, or of the volume of a ring, that lies in the lower (0) or the
	/// upper one (1): there the outer functions have the slope 1/h, elsewhere none.
	double share(int cell, double h) const { return h * (cell == 0 ? -gradient[0] : gradient[2]); }

private:
	/// Number by number: a whole that is put together elsewhere and then copied takes longer.
	void set(double v0, double v1, double v2, double s0, double s1, double s2)
	{
		value[0] = v0, value[1] = v1, value[2] = v2, value[3] = 0;
		gradient[0] = s0, gradient[1] = s1, gradient[2] = s2, gradient[3] = 0;
	}
};

/// The functions of one axis at a point without slopes, as a row of lanes.
using AxisValues = std::array<double, 4>;

/// The basis functions of a point.
template <int Dim> struct PointBasis {
	AxisBasis axis[Dim];

	PointBasis() { } // no numbers yet: there may be millions of them, and all are set

	AxisBasis&       operator[](int a) { return axis[a]; }
	const AxisBasis& operator[](int a) const { return axis[a]; }
};

} // namespace gimpm
