// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/edges.hpp"
#include "core/terms/contact/contact_surface.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace gimpm {
namespace {

constexpr double leastTurn = 20 * M_PI / 180; // of a surface at its edge; rounded surfaces are made of sheets, too

/// Collects positions along edges.
template <int Dim> class Edges {
public:
	Edges(double spacing, bool isAxisymmetric) : spacing_(spacing), isAxisymmetric_(isAxisymmetric) { }

	void add(const RigidBody<Dim>& body)
	{
		switch (body.shape.kind) {
			case RigidKind::block: return addBlock(body);
			case RigidKind::sheet: return addSheet(body);
			case RigidKind::ball:
			case RigidKind::capsule: return addRound(body);
			case RigidKind::plane: return;
		}
	}

	std::vector<Vec<Dim>> all()
	{
		for (const auto& [ends, sides] : sheets_)
			if (isSharp(sides)) addLine(sides.front().from, sides.front().to);
		return std::move(found_);
	}

private:
	/// A sheet beside an edge.
	struct Side {
		Vec<Dim> from, to, inwards; ///< ends of the edge, in the plane one; unit vector from the edge into the sheet
	};

	void addLine(const Vec<Dim>& from, const Vec<Dim>& to)
	{
		const int parts = std::max(1, int(std::ceil((to - from).norm() / spacing_)));
		for (int i = 0; i <= (from == to ? 0 : parts); ++i)
			found_.push_back(from + double(i) / parts * (to - from));
	}

	/// Corners in the plane, edges in space.
	void addBlock(const RigidBody<Dim>& body)
	{
		const auto corner = [&](int bits) {
			Vec<Dim> own = body.shape.halfSize;
			for (int a = 0; a < Dim; ++a)
				if (bits >> a & 1) own[a] *= -1;
			return body.begin.inSpace(own);
		};
		for (int bits = 0; bits < 1 << Dim; ++bits)
			for (int a = 0; a < Dim; ++a)
				if (Dim == 2 ? a == 0 : !(bits >> a & 1)) addLine(corner(bits), corner(Dim == 2 ? bits : bits | 1 << a));
	}

	void addSheet(const RigidBody<Dim>& body)
	{
		std::array<Vec<Dim>, Dim> corners;
		for (int c = 0; c < Dim; ++c)
			corners[c] = body.begin.inSpace(body.shape.corners[c]);
		for (int c = 0; c < Dim; ++c) {
			const Vec<Dim> from = corners[c], to = Dim == 2 ? from : corners[(c + 1) % Dim], other = corners[(c + Dim - 1) % Dim];
			Vec<Dim>       inwards = other - from;
			if (Dim == 3) inwards -= (to - from) * (to - from).dot(inwards) / (to - from).squaredNorm();
			sheets_[nameOf(from, to)].push_back({ from, to, inwards.normalized() });
			if (isAxisymmetric_ && std::abs(from[0]) < spacing_ * same) {
				inwards[0] *= -1;
				sheets_[nameOf(from, to)].push_back({ from, to, inwards.normalized() });
			}
		}
	}

	void addRound(const RigidBody<Dim>& body)
	{
		const auto [low, high] = body.bounds(Pose<Dim>());
		for (const auto& point : surfacePoints<Dim>(body.shape, spacing_, low, high))
			found_.push_back(body.begin.inSpace(point.position));
	}

	/// Neighbours have the same name for their edge.
	std::vector<long> nameOf(const Vec<Dim>& from, const Vec<Dim>& to) const
	{
		const auto numbers = [&](const Vec<Dim>& x) {
			return std::vector<long> { std::lround(x[0] / (spacing_ * same)), std::lround(x[1] / (spacing_ * same)),
				                   std::lround(x[Dim - 1] / (spacing_ * same)) };
		};
		std::vector<long> name = numbers(from), other = numbers(to);
		if (other < name) name.swap(other);
		name.insert(name.end(), other.begin(), other.end());
		return name;
	}

	static bool isSharp(const std::vector<Side>& sides)
	{
		return sides.size() != 2 || std::acos(std::clamp(-sides[0].inwards.dot(sides[1].inwards), -1., 1.)) > leastTurn;
	}

	static constexpr double same = 1e-6; // spacings between corners that are one

	double                                         spacing_;
	bool                                           isAxisymmetric_;
	std::map<std::vector<long>, std::vector<Side>> sheets_;
	std::vector<Vec<Dim>>                          found_;
};

} // namespace

template <int Dim> std::vector<Vec<Dim>> edgesOf(const std::vector<RigidBody<Dim>>& bodies, double spacing, bool isAxisymmetric)
{
	Edges<Dim> edges(spacing, isAxisymmetric);
	for (const auto& body : bodies)
		edges.add(body);
	return edges.all();
}

template std::vector<Vec<2>> edgesOf(const std::vector<RigidBody<2>>&, double, bool);
template std::vector<Vec<3>> edgesOf(const std::vector<RigidBody<3>>&, double, bool);

} // namespace gimpm
