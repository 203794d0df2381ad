// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact_surface.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

template <int Dim> struct Box {
	Vec<Dim> low, high;

	bool has(const Vec<Dim>& x) const { return (x.array() >= low.array()).all() && (x.array() <= high.array()).all(); }
};

template <int Dim> using SurfacePoints = std::vector<SurfacePoint<Dim>>;

/// An even number of parts of a length, so that its centre is between two of them.
int evenParts(double length, double spacing) { return 2 * std::max(1, int(std::ceil(length / (2 * spacing) - 1e-9))); }

/// Corners of the part of a surface that reaches from its centre as far as `half` to both sides, along one or two
/// lines.
std::array<Vec<2>, 2> cornersAround(const Vec<2>& x, const Vec<2>& half) { return { x - half, x + half }; }
std::array<Vec3, 4>   cornersAround(const Vec3& x, const Vec3& half, const Vec3& other)
{
	return { x - half - other, x + half - other, x + half + other, x - half + other };
}

SurfacePoints<2> onBall(double radius, const Mat<2>& axes, double spacing, const Box<2>& box)
{
	const int        parts = 4 * std::max(2, int(std::ceil(M_PI / 2 * radius / spacing - 1e-9)));
	SurfacePoints<2> points;
	for (int i = 0; i < parts; ++i) {
		const double angle = 2 * M_PI * (i + 0.5) / parts, half = std::tan(M_PI / parts);
		const Vec<2> normal = axes * Vec<2>(std::cos(angle), std::sin(angle)), contactPoint = radius * normal;
		if (box.has(contactPoint))
			points.push_back({ i, contactPoint, normal, 2 * M_PI * radius / parts, Vec<2>::Zero(),
			                   cornersAround(contactPoint, half * Vec<2>(-contactPoint[1], contactPoint[0])) });
	}
	return points;
}

/// Each face of a cube around the ball is divided in equal angles; the area goes with the element of that map, and in
/// sum is that of the ball.
SurfacePoints<3> onBall(double radius, const Mat3& axes, double spacing, const Box<3>& box)
{
	const int           parts = evenParts(M_PI / 2 * radius, spacing);
	std::vector<double> tangents; // at the ends of the parts and, between these, in their centres
	for (int k = -parts; k <= parts; ++k)
		tangents.push_back(std::tan(M_PI / 4 * k / parts));
	const auto areaAt = [&](int i, int j) {
		const double u = tangents[2 * i + 1], v = tangents[2 * j + 1], size2 = 1 + u * u + v * v;
		return (1 + u * u) * (1 + v * v) / (size2 * std::sqrt(size2));
	};
	double sum = 0;
	for (int i = 0; i < parts * parts; ++i)
		sum += 6 * areaAt(i % parts, i / parts);
	SurfacePoints<3> points;
	for (int number = 0; number < 6 * parts * parts; ++number) {
		const int  face = number / (parts * parts), i = number % parts, j = number / parts % parts;
		const auto at = [&](int k, int l) { // in halves of parts
			Vec3 x;
			x[face / 2] = face % 2 ? 1 : -1, x[(face / 2 + 1) % 3] = tangents[k], x[(face / 2 + 2) % 3] = tangents[l];
			return Vec3(axes * x.normalized());
		};
		const Vec3 normal = at(2 * i + 1, 2 * j + 1), contactPoint = radius * normal;
		if (!box.has(contactPoint)) continue;
		const double              area = 4 * M_PI * radius * radius * areaAt(i, j) / sum;
		const std::array<Vec3, 4> corners { radius * at(2 * i, 2 * j), radius * at(2 * i + 2, 2 * j), radius * at(2 * i + 2, 2 * j + 2),
			                            radius * at(2 * i, 2 * j + 2) };
		points.push_back({ number, contactPoint, normal, area, Vec3::Zero(), corners });
	}
	return points;
}

std::array<Vec<2>, 2> cornersAcross(const Vec<2>& position, const Vec<2>& half, int across)
{
	return cornersAround(position, half[1 - across] * Vec<2>::Unit(1 - across));
}
std::array<Vec3, 4> cornersAcross(const Vec3& position, const Vec3& half, int across)
{
	const int a = (across + 1) % 3, b = (across + 2) % 3;
	return cornersAround(position, half[a] * Vec3::Unit(a), half[b] * Vec3::Unit(b));
}

/// The contact points on a face of a block, numbered row by row, of which those in a box are met.
template <int Dim> struct FaceOfBlock {
	int        across;
	Vec<Dim>   normal, half, acting, part = Vec<Dim>::Zero(); // half of the block and of what acts, and of the part of a contact point
	Index<Dim> parts = Index<Dim>::Ones(), from = Index<Dim>::Zero(), to = Index<Dim>::Zero();
	double     area = 1;
	bool       isMet;

	FaceOfBlock(int face, const Vec<Dim>& h, double spacing, const Box<Dim>& box)
	        : across(face / 2), normal((face % 2 ? 1 : -1) * Vec<Dim>::Unit(across)), half(h), acting(h.cwiseMax(2 * spacing))
	{
		const double at = half[across] * normal[across];
		isMet           = at >= box.low[across] && at <= box.high[across];
		for (int a = 0; a < Dim; ++a) {
			if (a == across) continue;
			parts[a] = evenParts(2 * acting[a], spacing), part[a] = half[a] / parts[a], area *= 2 * part[a];
			const auto indexOf = [&](double x) { return (x + half[a]) / (2 * part[a]) - 0.5; };
			from[a]            = int(std::ceil(std::clamp(indexOf(box.low[a]), 0., double(parts[a]))));
			to[a]              = int(std::floor(std::clamp(indexOf(box.high[a]), -1., parts[a] - 1.)));
			isMet              = isMet && from[a] <= to[a];
		}
	}

	SurfacePoint<Dim> at(std::int64_t first, const Index<Dim>& i) const
	{
		Vec<Dim>     position = half[across] * normal, aside = Vec<Dim>::Zero();
		std::int64_t number = 0;
		for (int a = Dim - 1; a >= 0; --a) {
			const double share = (2 * i[a] + 1.) / parts[a] - 1;
			if (a != across) position[a] = half[a] * share, aside[a] = (acting[a] - half[a]) * share;
			number = number * parts[a] + i[a];
		}
		return { first + number, position, normal, area, aside, cornersAcross(position, part, across) };
	}

	bool next(Index<Dim>& i) const
	{
		int a = 0;
		while (a < Dim && ++i[a] > to[a])
			i[a] = from[a], ++a;
		return a < Dim;
	}
};

template <int Dim> SurfacePoints<Dim> onBlock(const Vec<Dim>& half, double spacing, const Box<Dim>& box)
{
	SurfacePoints<Dim> points;
	std::int64_t       first = 0; // number on the face
	for (int number = 0; number < 2 * Dim; ++number) {
		const FaceOfBlock<Dim> face(number, half, spacing, box);
		Index<Dim>             i = face.from;
		for (bool goesOn = face.isMet; goesOn; goesOn = face.next(i))
			points.push_back(face.at(first, i));
		first += face.parts.template cast<std::int64_t>().prod();
	}
	return points;
}

/// A sheet that has a thickness has its sides apart from each other.
template <int Dim> void addSides(SurfacePoints<Dim>& points, SurfacePoint<Dim> point, bool isTwoSided, const Box<Dim>& box, double halfThickness = 0)
{
	if (!box.has(point.position)) return;
	const auto move = [&](const Vec<Dim>& way) {
		point.position += way;
		for (auto& corner : point.corners)
			corner += way;
	};
	if (halfThickness > 0) move(halfThickness * point.normal);
	point.number *= 2;
	points.push_back(point);
	++point.number;
	point.normal *= -1;
	if (halfThickness > 0) move(2 * halfThickness * point.normal);
	if (isTwoSided) points.push_back(point);
}

SurfacePoints<2> onSheet(const std::array<Vec<2>, 2>& corner, double spacing, bool isTwoSided, const Box<2>& box)
{
	const Vec<2>     along = corner[1] - corner[0], normal = normalOf(corner);
	const int        parts = evenParts(along.norm(), spacing);
	SurfacePoints<2> points;
	for (int i = 0; i < parts; ++i) {
		const Vec<2> position = corner[0] + (i + 0.5) / parts * along;
		addSides<2>(
		        points, { i, position, normal, along.norm() / parts, Vec<2>::Zero(), cornersAround(position, along / (2 * parts)) }, isTwoSided, box);
	}
	return points;
}

int partsOfSheet(double longest, double spacing) { return std::max(2, int(std::ceil(longest / (std::sqrt(2.) * spacing) - 1e-9))); }

SurfacePoints<2> onSheet(const RigidShape<2>& shape, double, double spacing, const Box<2>& box)
{
	return onSheet(shape.corners, spacing, shape.isTwoSided, box);
}

/// The centres of the triangles into which lines parallel to the edges cut it.
SurfacePoints<3> onSheet(const RigidShape<3>& shape, double halfThickness, double spacing, const Box<3>& box)
{
	const auto&      corner = shape.corners;
	const Vec3       u = corner[1] - corner[0], v = corner[2] - corner[0], normal = normalOf(corner);
	const double     longest = std::max({ u.norm(), v.norm(), (v - u).norm() });
	const int        parts   = shape.parts > 0 ? shape.parts : partsOfSheet(longest, spacing);
	SurfacePoints<3> points;
	std::int64_t     number = 0;
	const auto       at     = [&](double i, double j) { return Vec3(corner[0] + i / parts * u + j / parts * v); };
	for (int i = 0; i < parts; ++i)
		for (int j = 0; i + j < parts; ++j)
			for (int turned = 0; turned < (i + j + 1 < parts ? 2 : 1); ++turned) {
				const double middle = turned ? 2. / 3 : 1. / 3, area = u.cross(v).norm() / 2 / (parts * parts);
				const Vec3   last = at(i, j + 1);
				addSides<3>(
				        points,
				        { number++,
				          at(i + middle, j + middle),
				          normal,
				          area,
				          Vec3::Zero(),
				          { turned ? at(i + 1, j + 1) : at(i, j), at(i + 1, j), last, last } },
				        shape.isTwoSided, box, halfThickness);
			}
	return points;
}

SurfacePoints<2> onCapsule(const RigidShape<2>&, double, const Box<2>&) { return {}; }

/// Strips along its axis, at least eight, so that of whatever direction soil comes some face it; and what of balls at
/// its ends is beyond these.
SurfacePoints<3> onCapsule(const RigidShape<3>& shape, double spacing, const Box<3>& box)
{
	const Vec3       along = shape.corners[1] - shape.corners[0], axis = along.normalized(), first = axis.unitOrthogonal(), second = axis.cross(first);
	const int        parts  = shape.parts > 0 ? shape.parts : evenParts(along.norm(), spacing);
	const int        strips = std::max(8, 4 * int(std::ceil(M_PI / 2 * shape.radius / spacing - 1e-9)));
	const double     angle = 2 * M_PI / strips, area = angle * shape.radius * along.norm() / parts, half = std::tan(angle / 2);
	SurfacePoints<3> points;
	std::int64_t     number = 0;
	for (int i = 0; i < parts; ++i)
		for (int j = 0; j < strips; ++j, ++number) {
			const Vec3 normal   = std::cos((j + 0.5) * angle) * first + std::sin((j + 0.5) * angle) * second;
			const Vec3 position = shape.corners[0] + (i + 0.5) / parts * along + shape.radius * normal;
			if (!box.has(position)) continue;
			points.push_back({ number, position, normal, area, Vec3::Zero(),
			                   cornersAround(position, along / (2 * parts), half * shape.radius * axis.cross(normal)) });
		}
	for (int end = 0; end < 2; ++end)
		for (SurfacePoint<3> point :
		     onBall(shape.radius, shape.axes, spacing, Box<3> { box.low - shape.corners[end], box.high - shape.corners[end] })) {
			if (point.normal.dot(end == 0 ? Vec3(-axis) : axis) <= 0) continue;
			point.number = number + 2 * point.number + end;
			point.position += shape.corners[end];
			for (Vec3& corner : point.corners)
				corner += shape.corners[end];
			points.push_back(point);
		}
	return points;
}

/// On a lattice through the origin of the plane's axes; planes are across one of the axes of space.
template <int Dim> SurfacePoints<Dim> onPlane(const RigidShape<Dim>& shape, double spacing, const Box<Dim>& box)
{
	constexpr std::int64_t most = 1 << 24;
	int                    across;
	shape.normal.cwiseAbs().maxCoeff(&across);
	SurfacePoints<Dim> points;
	std::int64_t       from[2] = { 0, 0 }, to[2] = { 0, 0 };
	int                axes[2] = { 0, 0 }, n = 0;
	for (int a = 0; a < Dim; ++a) {
		if (a == across) continue;
		axes[n] = a, from[n] = std::int64_t(std::floor(box.low[a] / spacing)), to[n] = std::int64_t(std::floor(box.high[a] / spacing));
		++n;
	}
	for (std::int64_t i = from[0]; i <= to[0]; ++i)
		for (std::int64_t j = from[1]; j <= to[1]; ++j) {
			Vec<Dim> position = Vec<Dim>::Zero();
			position[axes[0]] = (double(i) + 0.5) * spacing;
			if (Dim == 3) position[axes[1]] = (double(j) + 0.5) * spacing;
			const std::int64_t number = (i + most) * 2 * most + j + most;
			addSides<Dim>(
			        points,
			        { number, position, shape.normal, std::pow(spacing, Dim - 1), Vec<Dim>::Zero(),
			          cornersAcross(position, Vec<Dim>::Constant(spacing / 2), across) },
			        shape.isTwoSided, box);
		}
	return points;
}

} // namespace

int partsOfEdge(RigidKind kind, double length, double spacing) { return kind == RigidKind::sheet ? partsOfSheet(length, spacing) : evenParts(length, spacing); }

template <int Dim> std::vector<SurfacePoint<Dim>> surfacePoints(const RigidShape<Dim>& shape, double spacing, const Vec<Dim>& low, const Vec<Dim>& high)
{
	const Box<Dim> box { low, high };
	if (shape.kind == RigidKind::ball) return onBall(shape.radius, shape.axes, spacing, box);
	if (shape.kind == RigidKind::block) return onBlock<Dim>(shape.halfSize, spacing, box);
	if (shape.kind == RigidKind::sheet) return onSheet(shape, shape.parts > 0 ? shape.radius : 0, spacing, box);
	if (shape.kind == RigidKind::capsule) return onCapsule(shape, spacing, box);
	return onPlane<Dim>(shape, spacing, box);
}

template <int Dim>
std::vector<SurfacePoint<Dim>> surfacePointsAt(
        const RigidShape<Dim>& shape, const Pose<Dim>& pose, double cellSize, const Vec<Dim>& low, const Vec<Dim>& high, bool isFine)
{
	const Vec<Dim> middle = pose.inBody((low + high) / 2), half = pose.rotation.transpose().cwiseAbs() * (high - low) / 2;
	auto           points = surfacePoints<Dim>(shape, cellSize / (isFine ? 8 : 4), middle - half, middle + half);
	for (auto& point : points)
		point.number += isFine ? firstFineNumber : 0;
	return points;
}

template std::vector<SurfacePoint<2>> surfacePoints(const RigidShape<2>&, double, const Vec<2>&, const Vec<2>&);
template std::vector<SurfacePoint<3>> surfacePoints(const RigidShape<3>&, double, const Vec<3>&, const Vec<3>&);
template std::vector<SurfacePoint<2>> surfacePointsAt(const RigidShape<2>&, const Pose<2>&, double, const Vec<2>&, const Vec<2>&, bool);
template std::vector<SurfacePoint<3>> surfacePointsAt(const RigidShape<3>&, const Pose<3>&, double, const Vec<3>&, const Vec<3>&, bool);

} // namespace gimpm
