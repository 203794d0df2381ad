// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/plane_slip.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace gimpm {
namespace {

constexpr double nothing      = -std::numeric_limits<double>::infinity();
constexpr int    stripsOfCell = 4;
constexpr double leastFace    = 0.9; // cells
constexpr double leastFilling = 0.9; // part of the block, by the volumes of its points
constexpr double mostStrips   = 1e6;

/// Tops and bottoms of the body over upright strips of a quarter of a cell, across which a face may be.
template <int Dim> class Outline {
public:
	Outline(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, int axis, const Vec<Dim>& down, const std::vector<std::optional<Strength>>& strength)
	        : cloud_(cloud), axis_(axis), along_(Dim == 3 ? 3 - axis - axisOf(down) : -1), width_(grid.cellSize / stripsOfCell), down_(down)
	{
		Vec<Dim> upper = cloud.position[0];
		lower_         = upper;
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			lower_ = lower_.cwiseMin(cloud.position[p] - cloud.halfSize[p]);
			upper  = upper.cwiseMax(cloud.position[p] + cloud.halfSize[p]);
		}
		const auto counted = [&](int a) { return a < 0 ? 1. : std::max(1., std::round((upper[a] - lower_[a]) / width_)); };
		if (counted(axis) * counted(along_) > mostStrips) return;
		count_ = int(counted(axis)), rows_ = int(counted(along_));
		top.assign(count_, std::numeric_limits<double>::infinity());
		front.assign(count_, nothing), bottom.assign(count_, nothing), foreign.assign(count_, nothing);
		std::vector<double> tops(std::size_t(count_) * rows_, nothing), bottoms(tops.size(), -nothing);
		for (std::size_t p = 0; p < cloud.size(); ++p)
			forStrips(p, [&](int strip, int row) {
				const double middle = height(p), half = cloud.halfSize[p].cwiseProduct(down).cwiseAbs().sum();
				auto &       high = tops[std::size_t(strip) * rows_ + row], &low = bottoms[std::size_t(strip) * rows_ + row];
				high = std::max(high, middle + half), low = std::min(low, middle - half);
				if (!strength[cloud.material[p]]) foreign[strip] = std::max(foreign[strip], middle + half);
			});
		for (int strip = 0; strip < count_; ++strip)
			for (int row = 0; row < rows_; ++row) {
				const double high = tops[std::size_t(strip) * rows_ + row];
				top[strip] = std::min(top[strip], high), front[strip] = std::max(front[strip], high);
				bottom[strip] = std::max(bottom[strip], high == nothing ? nothing : bottoms[std::size_t(strip) * rows_ + row]);
			}
	}

	static int axisOf(const Vec<Dim>& down)
	{
		int axis = 0;
		down.cwiseAbs().maxCoeff(&axis);
		return axis;
	}
	int    count() const { return count_; }
	bool   has(int strip) const { return 0 <= strip && strip < count_; }
	double width() const { return width_; }
	double across() const { return Dim == 3 ? rows_ * width_ : 1; } ///< width of the body along the face [m]
	double begin(int strip) const { return lower_[axis_] + strip * width_; }
	double height(std::size_t p) const { return -down_.dot(cloud_.position[p]); }

	/// Top of the soil in a strip, also where a stretched body has a gap of one strip; beyond the body nothing.
	double topAt(int strip) const
	{
		if (!has(strip) || top[strip] != nothing || !has(strip - 1) || !has(strip + 1)) return has(strip) ? top[strip] : nothing;
		return std::min(top[strip - 1], top[strip + 1]);
	}

	/// Calls f(strip, row) for those whose centres lie in the domain of a point.
	template <class F> void forStrips(std::size_t p, F&& f) const
	{
		const auto range = [&](int a, int count) -> std::array<int, 2> {
			if (a < 0) return { 0, 0 };
			const double middle = (cloud_.position[p][a] - lower_[a]) / width_ - 0.5, half = cloud_.halfSize[p][a] / width_;
			return { std::max(0, int(std::ceil(middle - half - 1e-6))), std::min(count - 1, int(std::floor(middle + half + 1e-6))) };
		};
		const auto strips = range(axis_, count_), rows = range(along_, rows_);
		for (int strip = strips[0]; strip <= strips[1]; ++strip)
			for (int row = rows[0]; row <= rows[1]; ++row)
				f(strip, row);
	}

	std::vector<double> top, front, bottom; ///< heights by strip, over all rows: the lowest and the highest top, the highest bottom
	std::vector<double> foreign;            ///< the highest top of materials without strength

private:
	const PointCloud<Dim>& cloud_;
	int                    axis_, along_, count_ = 0, rows_ = 1;
	double                 width_;
	Vec<Dim>               down_, lower_;
};

/// A block above a plane, from the strip at the face inwards.
struct Block {
	int    first, inwards, strips = 0; ///< inwards: 1 or -1
	double foot, slope;                ///< height of the foot [m]; tangent of the plane's angle
	double volume = 0, run = 0;        ///< [m3]; of the plane within the body, horizontally [m]
	bool   isFree = false;             ///< the plane comes out at the surface
};

template <int Dim> class SlipSearch {
public:
	SlipSearch(
	        const PointCloud<Dim>& cloud, const Grid<Dim>& grid, const Boundary<Dim>& boundary, const Outline<Dim>& outline, int axis, const Vec<Dim>& down,
	        const std::vector<double>& weight, const Strength& strength)
	        : cloud_(cloud), grid_(grid), boundary_(boundary), outline_(outline), axis_(axis), down_(down), strength_(strength)
	{
		unitWeight_ = std::numeric_limits<double>::infinity();
		for (std::size_t p = 0; p < cloud.size(); ++p)
			unitWeight_ = std::min(unitWeight_, weight[p] / (cloud.volume0[p] * cloud.volumeRatio(p)));
	}

	/// Beside the strip in front of a face, which is that of the soil with the inward direction.
	void searchFrom(int first, int inwards, std::optional<PlaneSlip<Dim>>& worst) const
	{
		const double top = outline_.topAt(first), foot = footBefore(first, inwards);
		if (top == nothing || !(top - foot >= leastFace * grid_.cellSize)) return;
		constexpr double step  = M_PI / 90;
		const double     phi   = strength_.frictionAngle;
		double           angle = M_PI / 4 + phi / 2;
		if (strength_.cohesion == 0) return tryPlane(first, inwards, foot, angle, worst);
		for (angle = phi + step; angle < M_PI / 2 - step; angle += step)
			tryPlane(first, inwards, foot, angle, worst);
	}

private:
	/// The ground in front of it, within a cell; where there is none, the lower end of the face.
	double footBefore(int first, int inwards) const
	{
		double foot = nothing;
		for (int i = 1; i <= stripsOfCell; ++i)
			if (outline_.has(first - i * inwards)) foot = std::max(foot, outline_.front[first - i * inwards]);
		return foot == nothing ? outline_.bottom[first] : foot;
	}

	void tryPlane(int first, int inwards, double foot, double angle, std::optional<PlaneSlip<Dim>>& worst) const
	{
		const Block block = above({ first, inwards, 0, foot, std::tan(angle) });
		if (!block.isFree || block.strips == 0) return;
		const double length = block.run / std::cos(angle) * outline_.across();
		const double work   = block.volume * unitWeight_ * std::sin(angle - strength_.frictionAngle);
		const double bound = strength_.cohesion * std::cos(strength_.frictionAngle) * length, excess = work / bound;
		if (!(excess > 1) || (worst && excess <= worst->excess) || isConstrained(block) || !isFilled(block)) return;
		PlaneSlip<Dim> slip { -foot * down_, axis_, outline_.topAt(first) - foot, angle, excess };
		slip.foot[axis_] = outline_.begin(inwards > 0 ? first : first + 1);
		worst            = slip;
	}

	/// The tops of strips are level.
	Block above(Block block) const
	{
		const double width = outline_.width();
		for (int strip = block.first; !block.isFree; strip += block.inwards) {
			const double plane = block.foot + block.slope * block.strips * width, over = outline_.topAt(strip) - plane;
			if (outline_.has(strip) && outline_.foreign[strip] > plane + 1e-6 * width) return block;
			if (over > 0) {
				const double reached = std::min(width, over / block.slope);
				block.volume += reached * (over - block.slope * reached / 2) * outline_.across();
				block.run += reached;
				++block.strips;
				block.isFree = reached < width;
			} else
				block.isFree = true;
		}
		return block;
	}

	/// True if any node that the block can reach, above the plane, is constrained along or across the face.
	bool isConstrained(const Block& block) const
	{
		const int    up = Outline<Dim>::axisOf(down_);
		const double h = grid_.cellSize, begin = outline_.begin(block.inwards > 0 ? block.first : block.first + 1);
		double       top = nothing;
		for (int i = 0; i < block.strips; ++i)
			top = std::max(top, outline_.topAt(block.first + i * block.inwards));
		for (const auto& box : boundary_.boxes()) {
			if (!box.fixed[axis_] && !box.fixed[up]) continue;
			// Nodes up to a cell before the face, and above the surface.
			const int columns = int(std::ceil(block.strips * outline_.width() / h)) + 2, side = int(std::lround((begin - grid_.origin[axis_]) / h));
			for (int i = -1; i < columns; ++i) {
				const int    node  = side + i * block.inwards;
				const double x     = std::max(0., (grid_.origin[axis_] + h * node - begin) * block.inwards);
				const double plane = block.foot + block.slope * x;
				if (plane > top + h || !box.covers(node, axis_)) continue;
				const double low = down_[up] < 0 ? plane : -top - h, high = down_[up] < 0 ? top + h : -plane;
				const int    from = int(std::floor((low - grid_.origin[up]) / h + 0.01)) + 1,
				          to      = int(std::ceil((high - grid_.origin[up]) / h - 0.01)) - 1;
				if (std::max(from, box.lower[up]) <= std::min(to, box.upper[up])) return true;
			}
		}
		return false;
	}

	/// True if the volumes of points above the height of the foot fill the block.
	bool isFilled(const Block& block) const
	{
		const auto isIn = [&](int strip) { return 0 <= (strip - block.first) * block.inwards && (strip - block.first) * block.inwards < block.strips; };
		double     filled = 0, all = 0;
		for (int i = 0; i < block.strips; ++i)
			all += (outline_.topAt(block.first + i * block.inwards) - block.foot) * outline_.width() * outline_.across();
		for (std::size_t p = 0; p < cloud_.size(); ++p) {
			int inside = 0, strips = 0;
			outline_.forStrips(p, [&](int strip, int) { inside += isIn(strip), ++strips; });
			if (inside == 0) continue;
			const double half = cloud_.halfSize[p].cwiseProduct(down_).cwiseAbs().sum();
			const double part = std::min(1., std::max(0., (outline_.height(p) + half - block.foot) / (2 * half)));
			filled += cloud_.volume0[p] * cloud_.volumeRatio(p) * part * inside / strips;
		}
		return filled >= leastFilling * all;
	}

	const PointCloud<Dim>& cloud_;
	const Grid<Dim>&       grid_;
	const Boundary<Dim>&   boundary_;
	const Outline<Dim>&    outline_;
	int                    axis_;
	Vec<Dim>               down_;
	Strength               strength_;
	double                 unitWeight_; ///< the least [N/m3]
};

} // namespace

template <int Dim>
std::optional<PlaneSlip<Dim>> worstPlaneSlip(
        const PointCloud<Dim>& cloud, const Grid<Dim>& grid, const Boundary<Dim>& boundary, const std::vector<std::optional<Strength>>& strength,
        const std::vector<double>& weight, const Vec<Dim>& down)
{
	std::optional<PlaneSlip<Dim>> worst;
	Strength                      all;
	for (const auto& one : strength)
		if (one) all = { std::max(all.cohesion, one->cohesion), std::max(all.frictionAngle, one->frictionAngle) };
	for (int axis = 0; axis < Dim; ++axis) {
		if (cloud.size() == 0 || axis == Outline<Dim>::axisOf(down)) continue;
		const Outline<Dim>    outline(cloud, grid, axis, down, strength);
		const SlipSearch<Dim> search(cloud, grid, boundary, outline, axis, down, weight, all);
		for (int strip = 0; strip < outline.count(); ++strip)
			for (const int inwards : { 1, -1 })
				search.searchFrom(strip, inwards, worst);
	}
	return worst;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::optional<PlaneSlip<Dim>> worstPlaneSlip(                                                                                                 \
	        const PointCloud<Dim>&, const Grid<Dim>&, const Boundary<Dim>&, const std::vector<std::optional<Strength>>&, const std::vector<double>&,       \
	        const Vec<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
