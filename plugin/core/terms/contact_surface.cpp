// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact_surface.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

template <int Dim> using SurfacePoints = std::vector<SurfacePoint<Dim>>;

/// An even number of parts of a length, so that its middle is between two of them.
int evenParts(double length, double spacing) { return 2 * std::max(1, int(std::ceil(length / (2 * spacing) - 1e-9))); }

SurfacePoints<2> onBall(double radius, double spacing, Vec<2>)
{
	const int        parts = 4 * std::max(2, int(std::ceil(M_PI / 2 * radius / spacing - 1e-9)));
	SurfacePoints<2> points;
	for (int i = 0; i < parts; ++i) {
		const double angle = 2 * M_PI * (i + 0.5) / parts;
		const Vec<2> normal(std::cos(angle), std::sin(angle));
		points.push_back({ i, radius * normal, normal, 2 * M_PI * radius / parts });
	}
	return points;
}

/// Each face of a cube around the ball is divided in equal angles; the area goes with the element of that map, and in
/// sum is that of the ball.
SurfacePoints<3> onBall(double radius, double spacing, Vec3)
{
	const int        parts = evenParts(M_PI / 2 * radius, spacing);
	SurfacePoints<3> points;
	double           sum = 0;
	for (int face = 0; face < 6; ++face)
		for (int i = 0; i < parts * parts; ++i) {
			const auto   tangent = [&](int k) { return std::tan(M_PI / 4 * (2 * k + 1 - parts) / parts); };
			const double u = tangent(i % parts), v = tangent(i / parts), size2 = 1 + u * u + v * v;
			Vec3         normal;
			normal[face / 2] = face % 2 ? 1 : -1, normal[(face / 2 + 1) % 3] = u, normal[(face / 2 + 2) % 3] = v;
			const double area = (1 + u * u) * (1 + v * v) / (size2 * std::sqrt(size2));
			sum += area;
			normal /= std::sqrt(size2);
			points.push_back({ std::int64_t(points.size()), radius * normal, normal, area });
		}
	for (auto& point : points)
		point.area *= 4 * M_PI * radius * radius / sum;
	return points;
}

template <int Dim> SurfacePoints<Dim> onBlock(const Vec<Dim>& half, double spacing)
{
	const Vec<Dim>     acting = half.cwiseMax(2 * spacing);
	SurfacePoints<Dim> points;
	for (int face = 0; face < 2 * Dim; ++face) {
		const int  across = face / 2;
		Index<Dim> parts  = Index<Dim>::Ones();
		double     area   = 1;
		for (int a = 0; a < Dim; ++a)
			if (a != across) parts[a] = evenParts(2 * acting[a], spacing), area *= 2 * half[a] / parts[a];
		const Vec<Dim> normal = (face % 2 ? 1 : -1) * Vec<Dim>::Unit(across);
		for (int i = 0; i < parts.prod(); ++i) {
			Vec<Dim> place = half[across] * normal, aside = Vec<Dim>::Zero();
			for (int a = 0, rest = i; a < Dim; ++a) {
				if (a == across) continue;
				const double at = (2 * (rest % parts[a]) + 1.) / parts[a] - 1;
				place[a] = half[a] * at, aside[a] = (acting[a] - half[a]) * at;
				rest /= parts[a];
			}
			points.push_back({ std::int64_t(points.size()), place, normal, area, aside });
		}
	}
	return points;
}

template <int Dim> void addSides(SurfacePoints<Dim>& points, std::int64_t number, const Vec<Dim>& place, const Vec<Dim>& normal, double area, bool isTwoSided)
{
	points.push_back({ 2 * number, place, normal, area });
	if (isTwoSided) points.push_back({ 2 * number + 1, place, Vec<Dim>(-normal), area });
}

SurfacePoints<2> onSheet(const std::array<Vec<2>, 2>& corner, double spacing, bool isTwoSided)
{
	const Vec<2>     along = corner[1] - corner[0], normal = normalOf(corner);
	const int        parts = evenParts(along.norm(), spacing);
	SurfacePoints<2> points;
	for (int i = 0; i < parts; ++i)
		addSides<2>(points, i, corner[0] + (i + 0.5) / parts * along, normal, along.norm() / parts, isTwoSided);
	return points;
}

/// The middles of the triangles into which lines parallel to the edges cut it.
SurfacePoints<3> onSheet(const std::array<Vec3, 3>& corner, double spacing, bool isTwoSided)
{
	const Vec3       u = corner[1] - corner[0], v = corner[2] - corner[0], normal = normalOf(corner);
	const double     longest = std::max({ u.norm(), v.norm(), (v - u).norm() });
	const int        parts   = std::max(2, int(std::ceil(longest / (std::sqrt(2.) * spacing) - 1e-9)));
	SurfacePoints<3> points;
	std::int64_t     number = 0;
	for (int i = 0; i < parts; ++i)
		for (int j = 0; i + j < parts; ++j)
			for (int turned = 0; turned < (i + j + 1 < parts ? 2 : 1); ++turned) {
				const double at = turned ? 2. / 3 : 1. / 3;
				addSides<3>(
				        points, number++, corner[0] + (i + at) / parts * u + (j + at) / parts * v, normal,
				        u.cross(v).norm() / 2 / (parts * parts), isTwoSided);
			}
	return points;
}

/// On a lattice through the origin of the plane's axes; planes are across one of the axes of space.
template <int Dim> SurfacePoints<Dim> onPlane(const RigidShape<Dim>& shape, double spacing, const Vec<Dim>& low, const Vec<Dim>& high)
{
	constexpr std::int64_t most = 1 << 24;
	int                    across;
	shape.normal.cwiseAbs().maxCoeff(&across);
	SurfacePoints<Dim> points;
	std::int64_t       from[2] = { 0, 0 }, to[2] = { 0, 0 };
	int                axes[2] = { 0, 0 }, n = 0;
	for (int a = 0; a < Dim; ++a) {
		if (a == across) continue;
		axes[n] = a, from[n] = std::int64_t(std::floor(low[a] / spacing)), to[n] = std::int64_t(std::floor(high[a] / spacing));
		++n;
	}
	for (std::int64_t i = from[0]; i <= to[0]; ++i)
		for (std::int64_t j = from[1]; j <= to[1]; ++j) {
			Vec<Dim> place = Vec<Dim>::Zero();
			place[axes[0]] = (double(i) + 0.5) * spacing;
			if (Dim == 3) place[axes[1]] = (double(j) + 0.5) * spacing;
			addSides<Dim>(points, (i + most) * 2 * most + j + most, place, shape.normal, std::pow(spacing, Dim - 1), shape.isTwoSided);
		}
	return points;
}

} // namespace

template <int Dim> std::vector<SurfacePoint<Dim>> surfacePoints(const RigidShape<Dim>& shape, double spacing, const Vec<Dim>& low, const Vec<Dim>& high)
{
	if (shape.kind == RigidKind::ball) return onBall(shape.radius, spacing, Vec<Dim>());
	if (shape.kind == RigidKind::block) return onBlock<Dim>(shape.halfSize, spacing);
	if (shape.kind == RigidKind::sheet) return onSheet(shape.corners, spacing, shape.isTwoSided);
	return onPlane<Dim>(shape, spacing, low, high);
}

template std::vector<SurfacePoint<2>> surfacePoints(const RigidShape<2>&, double, const Vec<2>&, const Vec<2>&);
template std::vector<SurfacePoint<3>> surfacePoints(const RigidShape<3>&, double, const Vec<3>&, const Vec<3>&);

} // namespace gimpm
