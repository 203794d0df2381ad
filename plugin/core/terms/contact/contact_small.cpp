// SPDX-License-Identifier: GPL-2.0-or-later
// Features of bodies that are small beside the cells press on the soil by wider functions.
#include "core/terms/contact/contact_small.hpp"
#include "core/terms/contact/contact_hiding.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace gimpm {
namespace {

/// Widths of faces and diameters of balls from which on the functions of the cells will do [cells].
constexpr double wideFace = 4, wideBall = 2;

/// Weight of a feature that goes so far into the soil from its edge [cells]: less and less from two cells to three.
double shareOf(double reach) { return std::clamp(3 - reach, 0., 1.); }

/// True if the cell of a contact point, or one so many cells from it along some axes, has soil in it.
template <int Dim> bool hasSoil(const Attachment<Dim>& attachment, const Index<Dim>& away, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer)
{
	const Vec<Dim> middle = (attachment.cell + away).template cast<double>() + Vec<Dim>::Constant(0.5);
	return attach(Vec<Dim>(grid.origin + grid.size(attachment.level) * middle), basis, grid, layer).has_value();
}

/// Planes of symmetry: rows of nodes that are constrained across them alone.
template <int Dim> class Mirrors {
public:
	Mirrors(const CloudBasis<Dim>& basis, const Grid<Dim>& grid, const FreeDofs& dofs, int layer) : basis_(basis), grid_(grid), dofs_(dofs), layer_(layer)
	{
	}

	/// True if the face of a cell on this side along an axis lies in one.
	bool has(const Index<Dim>& cell, int level, int axis, int side) const
	{
		for (int corner = 0; corner < 1 << Dim; ++corner) {
			if ((corner >> axis & 1) != (side > 0)) continue;
			Index<Dim> at = cell;
			for (int a = 0; a < Dim; ++a)
				at[a] += corner >> a & 1;
			const int node = find(basis_.nodes, Grid<Dim>::key(grid_.first(at * (1 << level)), level, layer_));
			if (node < 0) return false;
			for (int a = 0; a < Dim; ++a)
				if ((dofs_.number[Dim * node + a] < 0) != (a == axis)) return false;
		}
		return true;
	}

	/// Sides of the cell of a contact point, along each axis, with one: 1, -1, or 0 for none.
	Index<Dim> beside(const Attachment<Dim>& attachment) const
	{
		Index<Dim> sides = Index<Dim>::Zero();
		for (int a = 0; a < Dim; ++a)
			for (const int side : { -1, 1 })
				if (has(attachment.cell, attachment.level, a, side)) sides[a] = side;
		return sides;
	}

private:
	const CloudBasis<Dim>& basis_;
	const Grid<Dim>&       grid_;
	const FreeDofs&        dofs_;
	const int              layer_;
};

/// True if soil goes on beside a contact point along an axis of the grid, for two cells or to a plane of symmetry: in
/// its row of cells or in the one beyond that, as seen along the normal.
template <int Dim>
bool goesOn(
        const Attachment<Dim>& attachment, const Vec<Dim>& normal, int axis, int side, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer,
        const Mirrors<Dim>& mirrors)
{
	Index<Dim> beside = Index<Dim>::Zero(), deeper = beside;
	int        across;
	normal.cwiseAbs().maxCoeff(&across);
	beside[axis] = side, deeper[across] = normal[across] < 0 ? -1 : 1;
	const auto isSoil = [&](const Index<Dim>& from) {
		for (int step = 0; step < 2; ++step) {
			if (mirrors.has(attachment.cell + from + step * beside, attachment.level, axis, side)) return true;
			if (!hasSoil<Dim>(attachment, from + (step + 1) * beside, basis, grid, layer)) return false;
		}
		return true;
	};
	return isSoil(Index<Dim>::Zero()) || (across != axis && isSoil(deeper));
}

/// The face of a block across its own axis is small along another one if it is not much wider than a cell there. What
/// is narrower than that acts over a cell anyway.
bool isSmall(double width, double cellSize) { return width > cellSize * (1 + 1e-9) && width < wideFace * cellSize * (1 + 1e-9); }

} // namespace

template <int Dim> double reachFromEdge(const RigidBody<Dim>& block, const Pose<Dim>& pose, const std::vector<FacePoint<Dim>>& positions)
{
	constexpr double   none = std::numeric_limits<double>::infinity();
	Index<Dim>         side = Index<Dim>::Zero();
	std::array<int, 3> faces {};
	for (const auto& [position, direction] : positions) {
		const Vec<Dim> normal = pose.rotation.transpose() * direction;
		int            across;
		const double   size = normal.cwiseAbs().maxCoeff(&across);
		const int      now  = normal[across] < 0 ? -1 : 1;
		if (size < 0.999 || side[across] == -now) return none;
		side[across] = now, ++faces[across];
	}
	if (std::count(faces.begin(), faces.end(), 0) > 1) return none;
	double most = 0;
	for (const auto& [position, direction] : positions) {
		const Vec<Dim> normal = pose.rotation.transpose() * direction, own = pose.inBody(position);
		for (int a = 0; a < Dim; ++a)
			if (side[a] != 0 && std::abs(normal[a]) < 0.5) most = std::max(most, block.shape.halfSize[a] - side[a] * own[a]);
	}
	return most;
}

template <int Dim> double reachFromBorder(const RigidBody<Dim>& sheet, const Pose<Dim>& pose, const std::vector<FacePoint<Dim>>& positions)
{
	double most = 0;
	for (const auto& at : positions)
		most = std::max(most, -sheet.proximity(pose, at.position, 1).beside);
	return most;
}

namespace {

/// Weights along the axes of the grid of a contact point on a block: one along those to which a small side of its face
/// is close.
template <int Dim> Vec<Dim> sharesOnBlock(const RigidBody<Dim>& block, const Vec<Dim>& normal, double cellSize)
{
	Vec<Dim> shares = Vec<Dim>::Zero();
	for (int t = 0; t < Dim; ++t) {
		const Vec<Dim> side = block.begin.rotation.col(t);
		if (std::abs(normal.dot(side)) > 0.5 || !isSmall(2 * block.shape.halfSize[t], cellSize)) continue;
		for (int a = 0; a < Dim; ++a)
			if (std::abs(side[a]) > 0.4) shares[a] = 1;
	}
	return shares;
}

/// Half of a body beyond a plane of symmetry has the images of its faces: soil is on either side of it.
template <int Dim> bool isHalved(const std::vector<FacePoint<Dim>>& positions, const std::vector<Index<Dim>>& mirrors)
{
	for (const FacePoint<Dim>& contactPoint : positions) {
		int across;
		contactPoint.normal.cwiseAbs().maxCoeff(&across);
		if (std::any_of(mirrors.begin(), mirrors.end(), [&](const Index<Dim>& sides) { return sides[across] != 0; })) return true;
	}
	return false;
}

/// Weights of the wider functions of each contact point, along the axes of the grid: where the whole body is small, by
/// an edge or a border that goes little into the soil, or by a narrow face. A block narrower than a cell acts over one
/// anyway.
template <int Dim> std::vector<Vec<Dim>> sharesOf(const RigidBody<Dim>& body, const std::vector<FacePoint<Dim>>& positions, double cellSize, bool isHalved)
{
	const auto kind  = body.shape.kind;
	double     share = kind == RigidKind::ball && body.thickness() < wideBall * cellSize * (1 - 1e-9);
	if (kind == RigidKind::sheet) share = shareOf(reachFromBorder(body, body.begin, positions) / cellSize);
	const bool isBlock = kind == RigidKind::block;
	if (isBlock && body.thickness() > cellSize * (1 + 1e-9) && !isHalved) share = shareOf(reachFromEdge(body, body.begin, positions) / cellSize);
	std::vector<Vec<Dim>> shares;
	for (const auto& [position, normal] : positions) {
		shares.push_back(isBlock ? sharesOnBlock(body, normal, cellSize) : Vec<Dim>::Zero());
		for (int a = 0; a < Dim; ++a)
			if (std::abs(normal[a]) < 0.9) shares.back()[a] = std::max(shares.back()[a], share);
	}
	return shares;
}

template <int Dim>
void widenOn(int number, const std::vector<RigidBody<Dim>>& bodies, const StepContext<Dim>& step, const std::vector<int>& count, ContactPoint<Dim>* first)
{
	const auto&                 body = bodies[number];
	const double                h    = step.grid.cellSize;
	const Mat<Dim>              back = body.free < 0 ? Mat<Dim>(body.begin.rotation * body.end.rotation.transpose()) : Mat<Dim>::Identity();
	ContactPoint<Dim>* const    last = first + count[number];
	std::vector<FacePoint<Dim>> at;
	for (const auto* point = first; point != last; ++point)
		at.push_back({ point->soil, back * point->normal });
	std::vector<Vec<Dim>> shares = sharesOf(body, at, h, false);
	if (std::all_of(shares.begin(), shares.end(), [](const Vec<Dim>& share) { return share.isZero(0); })) return;
	const auto around   = bodiesAround(bodies, number, contactTolerance(h));
	const auto isJoined = [&](int b) { return count[b] > 0 && bodies[b].shape.kind != RigidKind::plane; };
	if (std::any_of(around.begin(), around.end(), isJoined)) return;
	const auto              planesOf = [&](const ContactPoint<Dim>& point) { return Mirrors<Dim>(step.basis, step.grid, step.dofs, point.layer()); };
	std::vector<Index<Dim>> mirrors;
	for (const auto* point = first; point != last; ++point)
		mirrors.push_back(planesOf(*point).beside(point->attached));
	if (isHalved<Dim>(at, mirrors)) shares = sharesOf(body, at, h, true);
	std::array<bool, Dim> isEnd {};
	for (std::size_t i = 0; i < at.size(); ++i)
		for (int a = 0; a < Dim; ++a) {
			const int side = shares[i][a] > 0 ? sideInCell(first[i].attached, a) : 0;
			if (side == 0 || mirrors[i][a] == side || side * at[i].normal[a] <= -0.3) continue;
			if (!goesOn(first[i].attached, at[i].normal, a, side, step.basis, step.grid, first[i].layer(), planesOf(first[i]))) isEnd[a] = true;
		}
	for (std::size_t i = 0; i < at.size(); ++i) {
		for (int a = 0; a < Dim; ++a)
			if (isEnd[a]) shares[i][a] = 0;
		if (!shares[i].isZero(0))
			first[i].distribution = ForceDistribution<Dim>(first[i].attached, shares[i], step.basis, step.grid, first[i].layer(), mirrors[i]);
	}
}

} // namespace

template <int Dim> void widenDistributions(const std::vector<RigidBody<Dim>>& bodies, const StepContext<Dim>& step, std::vector<ContactPoint<Dim>>& points)
{
	if (step.grid.axisymmetric || step.grid.isPeriodic() || step.grid.parting) return;
	std::vector<int> count(bodies.size(), 0);
	for (const ContactPoint<Dim>& point : points)
		++count[point.body];
	auto* first = points.data();
	for (int number = 0; number < int(bodies.size()); first += count[number++])
		if (bodies[number].nodes == 0) widenOn(number, bodies, step, count, first);
}

template double reachFromEdge(const RigidBody<2>&, const Pose<2>&, const std::vector<FacePoint<2>>&);
template double reachFromEdge(const RigidBody<3>&, const Pose<3>&, const std::vector<FacePoint<3>>&);
template double reachFromBorder(const RigidBody<2>&, const Pose<2>&, const std::vector<FacePoint<2>>&);
template double reachFromBorder(const RigidBody<3>&, const Pose<3>&, const std::vector<FacePoint<3>>&);
template void   widenDistributions(const std::vector<RigidBody<2>>&, const StepContext<2>&, std::vector<ContactPoint<2>>&);
template void   widenDistributions(const std::vector<RigidBody<3>>&, const StepContext<3>&, std::vector<ContactPoint<3>>&);

} // namespace gimpm
