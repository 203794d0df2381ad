// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/rigid_body.hpp"
#include "core/grid/surface.hpp"
#include "core/terms/contact/contact_nodes.hpp"
#include <Eigen/Geometry>
#include <algorithm>

namespace gimpm {
namespace {

template <int Dim> Proximity<Dim> fromBall(double radius, const Vec<Dim>& fromCentre)
{
	const double   distance = fromCentre.norm();
	const Vec<Dim> normal   = distance > 0 ? Vec<Dim>(fromCentre / distance) : Vec<Dim>(Vec<Dim>::Unit(Dim - 1));
	Proximity<Dim> near { distance - radius, normal };
	if (distance > 0) near.normalDerivative = (Mat<Dim>::Identity() - normal * normal.transpose()) / distance;
	return near;
}

/// In its own axes. Its edges are those of a smaller block with everything within the radius of it, so that the normal
/// turns without a jump.
template <int Dim> Proximity<Dim> fromBlock(const RigidShape<Dim>& shape, const Vec<Dim>& own)
{
	const Vec<Dim> beyond = own.cwiseAbs() - (shape.halfSize - Vec<Dim>::Constant(shape.radius)), out = beyond.cwiseMax(0);
	const Vec<Dim> sign     = own.unaryExpr([](double x) { return x < 0 ? -1. : 1.; });
	const double   distance = out.norm();
	if (distance == 0) {
		int face;
		return { beyond.maxCoeff(&face) - shape.radius, Vec<Dim>(sign[face] * Vec<Dim>::Unit(face)) };
	}
	const Vec<Dim> normal = out.cwiseProduct(sign) / distance;
	Mat<Dim>       moves  = (out.array() > 0).template cast<double>().matrix().asDiagonal();
	return { distance - shape.radius, normal, Mat<Dim>((moves - normal * normal.transpose()) / distance) };
}

/// Distance of a position in the plane of a sheet beside its edge.
double besideOf(const std::array<Vec<2>, 2>& corner, const Vec<2>&, const Vec<2>& own)
{
	const Vec<2> along = (corner[1] - corner[0]).normalized();
	return std::max((corner[0] - own).dot(along), (own - corner[1]).dot(along));
}
double besideOf(const std::array<Vec3, 3>& corner, const Vec3& normal, const Vec3& own)
{
	double beside = -std::numeric_limits<double>::infinity();
	for (int i = 0; i < 3; ++i)
		beside = std::max(beside, (own - corner[i]).dot((corner[(i + 1) % 3] - corner[i]).cross(normal).normalized()));
	return beside;
}

template <int Dim> Proximity<Dim> fromSheet(const std::array<Vec<Dim>, Dim>& corners, double radius, const Vec<Dim>& own, int side)
{
	const Vec<Dim> normal = normalOf(corners);
	return { side * normal.dot(own - corners[0]) - radius, Vec<Dim>(side * normal), Mat<Dim>::Zero(), besideOf(corners, normal, own) };
}

template <int Dim> Proximity<Dim> fromCapsule(const std::array<Vec<Dim>, Dim>& corners, double radius, const Vec<Dim>& own)
{
	const Vec<Dim> along = corners[1] - corners[0];
	const double   part  = std::clamp((own - corners[0]).dot(along) / along.squaredNorm(), 0., 1.);
	Proximity<Dim> near  = fromBall<Dim>(radius, own - corners[0] - part * along);
	// Along its axis the normal does not turn.
	const Vec<Dim> axis = along.normalized();
	if (part > 0 && part < 1) near.normalDerivative -= near.normalDerivative * axis * axis.transpose();
	return near;
}

template <int Dim> std::array<Vec<Dim>, Dim> cornersAt(const RigidShape<Dim>& shape, const Pose<Dim>& pose)
{
	std::array<Vec<Dim>, Dim> corners;
	for (int i = 0; i < Dim; ++i)
		corners[i] = shape.corners[i] + pose.shift[i];
	return corners;
}

/// Least gap between a capsule and a position on its way from begin to end.
template <int Dim> double leastDistance(const std::array<Vec<Dim>, Dim>& corners, const Vec<Dim>& from, const Vec<Dim>& way)
{
	constexpr int parts = 16; // parts of a way that is no longer than a cell
	double        least = std::numeric_limits<double>::infinity();
	for (int i = 0; i <= parts; ++i)
		least = std::min(least, fromCapsule<Dim>(corners, 0, from + double(i) / parts * way).gap);
	return least;
}

} // namespace

Vec<2> normalOf(const std::array<Vec<2>, 2>& corner) { return pieceNormal(corner[0], corner[1]).normalized(); }
Vec3   normalOf(const std::array<Vec3, 3>& corner) { return pieceNormal(corner[0], corner[1], corner[2]).normalized(); }

template <int Dim> Proximity<Dim> RigidBody<Dim>::proximity(const Pose<Dim>& pose, const Vec<Dim>& x, int side) const
{
	if (shape.kind == RigidKind::ball) return fromBall<Dim>(shape.radius, x - pose.position);
	if (shape.kind == RigidKind::plane) return { side * shape.normal.dot(x - pose.position), Vec<Dim>(side * shape.normal) };
	const Vec<Dim> own = pose.inBody(x);
	Proximity<Dim> near;
	if (shape.kind == RigidKind::block) near = fromBlock<Dim>(shape, own);
	else if (shape.kind == RigidKind::capsule)
		near = fromCapsule<Dim>(cornersAt(shape, pose), shape.radius, own);
	else
		near = fromSheet<Dim>(cornersAt(shape, pose), halfThickness(), own, side);
	near.normal           = pose.rotation * near.normal;
	near.normalDerivative = pose.rotation * near.normalDerivative * pose.rotation.transpose();
	return near;
}

template <int Dim> int RigidBody<Dim>::sideOf(const Pose<Dim>& pose, const Vec<Dim>& x) const
{
	if (!shape.isTwoSided) return 1;
	const double gap = proximity(pose, x, 1).gap + halfThickness();
	if (soilSide != 0 && std::abs(gap) <= slack) return soilSide;
	return gap < 0 ? -1 : 1;
}

template <int Dim> bool RigidBody<Dim>::isCrossed(const Vec<Dim>& beginsAt, const Vec<Dim>& endsAt) const
{
	if (shape.kind == RigidKind::plane || shape.kind == RigidKind::sheet) return false;
	const Vec<Dim>  from = begin.inBody(beginsAt), way = end.inBody(endsAt) - from;
	const Pose<Dim> own;
	if (proximity(own, from, 1).normal.dot(proximity(own, from + way, 1).normal) >= 0) return false;
	if (shape.kind == RigidKind::capsule) return leastDistance<Dim>(shape.corners, from, way) < shape.radius;
	if (shape.kind == RigidKind::ball) return (from + std::clamp(-from.dot(way) / way.squaredNorm(), 0., 1.) * way).norm() < shape.radius;
	double first = 0, last = 1; // the part of the way that is within the block
	for (int a = 0; a < Dim; ++a) {
		if (way[a] == 0 && std::abs(from[a]) >= shape.halfSize[a]) return false;
		if (way[a] == 0) continue;
		const double centre = -from[a] / way[a], half = std::abs(shape.halfSize[a] / way[a]);
		first = std::max(first, centre - half), last = std::min(last, centre + half);
	}
	return first < last;
}

template <int Dim> std::pair<Vec<Dim>, Vec<Dim>> RigidBody<Dim>::bounds(const Pose<Dim>& pose) const
{
	if (shape.kind == RigidKind::sheet || shape.kind == RigidKind::capsule) {
		const auto     corners = cornersAt(shape, pose);
		const int      count   = shape.kind == RigidKind::sheet ? Dim : 2;
		const Vec<Dim> margin  = Vec<Dim>::Constant(nodes > 0 ? shape.radius : 0);
		Vec<Dim>       low = pose.inSpace(corners[0]), high = low;
		for (int i = 1; i < count; ++i)
			low = low.cwiseMin(pose.inSpace(corners[i])), high = high.cwiseMax(pose.inSpace(corners[i]));
		return { low - margin, high + margin };
	}
	Vec<Dim> reach = Vec<Dim>::Constant(shape.kind == RigidKind::plane ? std::numeric_limits<double>::infinity() : shape.radius);
	if (shape.kind == RigidKind::block) reach = pose.rotation.cwiseAbs() * shape.halfSize;
	return { pose.position - reach, pose.position + reach };
}

template <int Dim> double RigidBody<Dim>::thickness() const
{
	if (shape.kind == RigidKind::plane || shape.kind == RigidKind::sheet) return 2 * halfThickness();
	return 2 * (shape.kind == RigidKind::block ? shape.halfSize.minCoeff() : shape.radius);
}

template <int Dim> bool RigidBody<Dim>::isNarrow(const Vec<Dim>& normal) const
{
	if (shape.kind != RigidKind::block) return shape.kind == RigidKind::ball || shape.kind == RigidKind::capsule;
	int thinnest;
	shape.halfSize.minCoeff(&thinnest);
	return std::abs(normal[thinnest]) < 0.7;
}

template <int Dim> double RigidBody<Dim>::motion() const
{
	const double shift = (end.position - begin.position).norm();
	if (shape.kind == RigidKind::plane) return shift;
	const int corners = shape.kind == RigidKind::sheet ? Dim : shape.kind == RigidKind::capsule ? 2 : 0;
	double    reach = shape.kind == RigidKind::block ? shape.halfSize.norm() : shape.radius, stretch = 0;
	for (int i = 0; i < corners; ++i)
		reach = std::max(reach, shape.corners[i].norm()), stretch = std::max(stretch, end.shift[i].norm());
	return shift + (end.rotation - begin.rotation).norm() * reach + stretch;
}

template <int Dim> Vec<Dim> RigidBody<Dim>::carried(const Vec<Dim>& x) const
{
	if (nodes == 0) return end.inSpace(begin.inBody(x)) - x;
	const Vec<Dim> own    = begin.inBody(x);
	const auto     weight = nodeWeights(*this, own);
	Vec<Dim>       foot = Vec<Dim>::Zero(), moved = Vec<Dim>::Zero();
	double         twist = 0;
	for (int i = 0; i < nodes; ++i) {
		foot += weight[i] * shape.corners[i], moved += weight[i] * (shape.corners[i] + end.shift[i]);
		twist += weight[i] * twists[i];
	}
	Vec<Dim> offset = own - foot;
	if constexpr (Dim == 3)
		if (twist != 0) offset = Eigen::AngleAxisd(twist, (shape.corners[1] - shape.corners[0]).normalized()) * offset;
	return end.inSpace(moved + offset) - x;
}

template struct RigidBody<2>;
template struct RigidBody<3>;

} // namespace gimpm
