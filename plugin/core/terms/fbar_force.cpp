// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/fbar_force.hpp"
#include "core/terms/point_pass.hpp"

namespace gimpm {
namespace {

/// The parts of a domain in the lower (0) and the upper cell (1) along one axis.
struct AxisParts {
	double share[2];  ///< of the domain
	double centre[2]; ///< of the part, in its cell: 0 to 1

	AxisParts(const AxisBasis& basis, bool isInTwo)
	{
		if (isInTwo) { // the slopes are in proportion to the lengths of the parts, the values to their squares
			const double perLength = basis.slope[2] - basis.slope[0];
			share[1]               = basis.slope[2] / perLength;
			centre[0]              = 1 + basis.value[0] / basis.slope[0] * perLength;
			centre[1]              = basis.value[2] / basis.slope[2] * perLength;
		} else
			share[1] = 0, centre[0] = basis.value[1], centre[1] = 0.5;
		share[0] = 1 - share[1];
	}
};

/// Calls f(cell of the window, its number, parts, share of the domain) for the cells that a point's domain lies in.
template <int Dim, class F> void forParts(const Patch<Dim>& patch, const PointBasis<Dim>& axes, F&& f)
{
	std::array<AxisParts, Dim> parts = [&] {
		if constexpr (Dim == 2) return std::array { AxisParts(axes[0], patch.span & 1), AxisParts(axes[1], patch.span & 2) };
		else
			return std::array { AxisParts(axes[0], patch.span & 1), AxisParts(axes[1], patch.span & 2), AxisParts(axes[2], patch.span & 4) };
	}();
	for (int c = 0; c < windowCells<Dim>; ++c) {
		if (patch.reached[c] < 0) continue;
		double share = 1;
		for (int a = 0; a < Dim; ++a)
			share *= parts[a].share[c >> a & 1];
		f(c, patch.reached[c], parts, share);
	}
}

/// Matter that has one dilation: that in a leaf. Points of windows with leaves of several sizes are beside it, in each of their cells: what is averaged along the axes must not
/// be in places that differ from side to side.
template <int Dim> class Matter {
public:
	explicit Matter(const CloudBasis<Dim>& basis) : basis_(basis), leaves_(int(basis.populatedLeaves().size())) { }

	int parts() const { return leaves_ + (basis_.leafOf.empty() ? 0 : int(basis_.cells.size())); }

	/// Number of the part to which the points of a patch belong in a cell.
	int of(const Patch<Dim>& patch, int cell) const { return hasSeveralSizes(patch) ? leaves_ + cell : basis_.leaf(cell); }

	/// From places in a cell to those in what the part is in, both 0 to 1 along each axis: corner + size * place.
	struct Frame {
		Vec<Dim> corner = Vec<Dim>::Zero();
		double   size   = 1;
	};
	Frame frame(int part, int cell) const
	{
		if (basis_.leafOf.empty() || part >= leaves_) return {};
		const Key leaf = basis_.leaves[part], key = basis_.cells[cell];
		const int level = Grid<Dim>::level(leaf);
		return { (Grid<Dim>::index(key) - Grid<Dim>::index(leaf)).template cast<double>() / (1 << level),
			 std::ldexp(1, Grid<Dim>::level(key) - level) };
	}

private:
	bool hasSeveralSizes(const Patch<Dim>& patch) const
	{
		if (basis_.leafOf.empty()) return false;
		int level = -1;
		for (const int cell : patch.reached) {
			if (cell < 0) continue;
			const int own = Grid<Dim>::level(basis_.leaves[basis_.leafOf[cell]]);
			if (level >= 0 && own != level) return true;
			level = own;
		}
		return false;
	}

	const CloudBasis<Dim>& basis_;
	int                    leaves_;
};

/// Centres of the parts, in what they are in: 0 to 1 along each axis.
template <int Dim> std::vector<Vec<Dim>> centresOf(const Matter<Dim>& matter, const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	std::vector<Vec<Dim>> centre(matter.parts(), Vec<Dim>::Zero());
	std::vector<double>   volume(centre.size(), 0);
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int    p   = basis.order[i];
			const double own = cloud.volume0[p] * cloud.volumeRatio(p);
			forParts(patch, basis.axes[i], [&](int c, int cell, const auto& parts, double share) {
				const int  part  = matter.of(patch, cell);
				const auto frame = matter.frame(part, cell);
				volume[part] += own * share;
				for (int a = 0; a < Dim; ++a)
					centre[part][a] += own * share * (frame.corner[a] + frame.size * parts[a].centre[c >> a & 1]);
			});
		}
	for (std::size_t part = 0; part < centre.size(); ++part)
		centre[part] = volume[part] > 0 ? Vec<Dim>(centre[part] / volume[part]) : Vec<Dim>::Constant(0.5);
	return centre;
}

/// Along each axis, of the centres of the cells on a side the average by the shares of the domain.
template <int Dim>
PointBasis<Dim> atCentres(const Patch<Dim>& patch, const PointBasis<Dim>& axes, const Matter<Dim>& matter, const std::vector<Vec<Dim>>& centre)
{
	double share[Dim][2] = {}, moment[Dim][2] = {};
	forParts(patch, axes, [&](int c, int cell, const auto&, double ofDomain) {
		const int  part  = matter.of(patch, cell);
		const auto frame = matter.frame(part, cell); // beyond the sides of the cell its functions go on as those of the leaf
		for (int a = 0; a < Dim; ++a) {
			share[a][c >> a & 1] += ofDomain;
			moment[a][c >> a & 1] += ofDomain * (centre[part][a] - frame.corner[a]) / frame.size;
		}
	});
	PointBasis<Dim> result = axes;
	for (int a = 0; a < Dim; ++a) {
		const AxisParts parts(axes[a], patch.span >> a & 1);
		const auto      at    = [&](int side) { return share[a][side] > 0 ? moment[a][side] / share[a][side] : 0.5; };
		auto&           value = result[a].value;
		value[0]              = parts.share[0] * (1 - at(0));
		value[2]              = parts.share[1] * at(1);
		value[1]              = 1 - value[0] - value[2];
	}
	return result;
}

/// The parts of a ring's section in the lower and the upper cell along x.
struct RingParts {
	double size, face; ///< of a cell, and radius of the face in or above the section [m]
	double radius[2];  ///< of the middles of the parts [m]

	/// In a refined grid a domain reaches no farther than half a cell.
	RingParts(const AxisBasis& ring, const AxisValues& hoop, double halfSize, bool isInTwo, bool isRefined)
	{
		const double r = 1 / (hoop[0] + hoop[1] + hoop[2]);
		size           = 1 / (isInTwo ? ring.slope[2] - ring.slope[0] : ring.slope[1]);
		const double l = isRefined ? std::min(halfSize, size / 2) : halfSize;
		face           = r + size * r * (hoop[0] - hoop[2]);
		radius[0]      = isInTwo ? (face + r - l) / 2 : r;
		radius[1]      = (face + r + l) / 2;
	}
};

/// Radius of the middle of the section of each part: of domains with the volumes V at r the sum of V over that of V / r.
template <int Dim> std::vector<double> sectionRadii(const Matter<Dim>& matter, const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	std::vector<double> volume(matter.parts(), 0), area(volume);
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int       p   = basis.order[i];
			const double    own = cloud.volume0[p] * cloud.volumeRatio(p);
			const RingParts ring(basis.axes[i][0], basis.hoop[i], cloud.halfSize[p][0], patch.span & 1, !basis.leafOf.empty());
			forParts(patch, basis.axes[i], [&](int c, int cell, const auto&, double share) {
				const int part = matter.of(patch, cell);
				volume[part] += own * share;
				area[part] += own * share / ring.radius[c & 1];
			});
		}
	for (std::size_t part = 0; part < volume.size(); ++part)
		volume[part] /= area[part];
	return volume;
}

} // namespace

template <int Dim> std::vector<AxisValues> hoopAtCentres(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	const Matter<Dim>       matter(basis);
	const auto              radius = sectionRadii(matter, cloud, basis);
	std::vector<AxisValues> result(basis.axes.size());
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const RingParts ring(basis.axes[i][0], basis.hoop[i], cloud.halfSize[basis.order[i]][0], patch.span & 1, !basis.leafOf.empty());
			result[i].fill(0);
			forParts(patch, basis.axes[i], [&](int c, int cell, const auto&, double share) {
				const int    side  = c & 1;
				const double r     = radius[matter.of(patch, cell)];
				const double upper = (r - ring.face) / ring.size + 1 - side; // hat function of the upper node of the cell
				result[i][side] += share * (1 - upper) / r;
				result[i][side + 1] += share * upper / r;
			});
		}
	return result;
}

template <int Dim> std::vector<PointBasis<Dim>> basisAtCentres(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	const Matter<Dim>            matter(basis);
	const auto                   centre = centresOf(matter, cloud, basis);
	std::vector<PointBasis<Dim>> result(basis.axes.size());
#pragma omp parallel for schedule(static)
	for (int k = 0; k < int(basis.patches.size()); ++k) {
		const auto& patch = basis.patches[k];
		for (int i = patch.first; i < patch.first + patch.count; ++i)
			result[i] = atCentres(patch, basis.axes[i], matter, centre);
	}
	return result;
}

template <int Dim> std::optional<PointFailure> addFBarForce(const Pass<Dim>& pass) { return addPoints<FBarChunk<Dim>>(pass); }

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::vector<PointBasis<Dim>> basisAtCentres(const PointCloud<Dim>&, const CloudBasis<Dim>&);                                                  \
	template std::vector<AxisValues>      hoopAtCentres(const PointCloud<Dim>&, const CloudBasis<Dim>&);                                                   \
	template std::optional<PointFailure>  addFBarForce(const Pass<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
