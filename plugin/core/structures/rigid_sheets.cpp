// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/rigid_sheets.hpp"
#include "core/grid/refinement.hpp"
#include <algorithm>
#include <cstdint>
#include <map>

namespace gimpm {
namespace {

using Facet = std::array<int, 3>;

/// Facets of bodies over vertices that are there once.
class JoinedFacets {
public:
	explicit JoinedFacets(double same) : same_(same) { }

	void add(const std::array<Vec3, 3>& corners, int body)
	{
		facets.push_back({ vertex(corners[0]), vertex(corners[1]), vertex(corners[2]) });
		bodies.push_back(body);
	}

	std::vector<Vec3>  positions;
	std::vector<Facet> facets;
	std::vector<int>   bodies;

private:
	using Bin = std::array<std::int64_t, 3>;

	/// A vertex that is within `same_` of a position along each axis, or a new one.
	int vertex(const Vec3& position)
	{
		const Bin low = bin(position.array() - same_), high = bin(position.array() + same_);
		for (auto i = low[0]; i <= high[0]; ++i)
			for (auto j = low[1]; j <= high[1]; ++j)
				for (auto k = low[2]; k <= high[2]; ++k)
					if (const auto known = bins_.find({ i, j, k }); known != bins_.end())
						for (const int v : known->second)
							if ((positions[v] - position).cwiseAbs().maxCoeff() <= same_) return v;
		positions.push_back(position);
		bins_[bin(position)].push_back(int(positions.size()) - 1);
		return int(positions.size()) - 1;
	}
	Bin bin(const Vec3& x) const
	{
		constexpr double many = 1e3;
		return { std::int64_t(std::floor(x[0] / (many * same_))), std::int64_t(std::floor(x[1] / (many * same_))),
			 std::int64_t(std::floor(x[2] / (many * same_))) };
	}

	std::map<Bin, std::vector<int>> bins_;
	const double                    same_;
};

/// Size of the largest cell at the corners and the centre of a rectangle [m].
double largestCellAt(const std::array<Vec3, 4>& corners, const Grid<3>& grid)
{
	double largest = cellSizeAt<3>(grid, (corners[0] + corners[2]) / 2);
	for (const Vec3& corner : corners)
		largest = std::max(largest, cellSizeAt(grid, corner));
	return largest;
}

void addFacetsOf(JoinedFacets& to, const RigidBody<3>& body, int number, const Grid<3>& grid)
{
	const auto& shape = body.shape;
	if (shape.kind == RigidKind::sheet && shape.isTwoSided && body.nodes == 0)
		to.add({ body.begin.inSpace(shape.corners[0]), body.begin.inSpace(shape.corners[1]), body.begin.inSpace(shape.corners[2]) }, number);
	if (shape.kind != RigidKind::block) return;
	int thin;
	shape.halfSize.minCoeff(&thin);
	const Vec3 a = shape.halfSize[(thin + 1) % 3] * Vec3::Unit((thin + 1) % 3), b = shape.halfSize[(thin + 2) % 3] * Vec3::Unit((thin + 2) % 3);
	const std::array<Vec3, 4> x { body.begin.inSpace(-a - b), body.begin.inSpace(a - b), body.begin.inSpace(a + b), body.begin.inSpace(b - a) };
	if (body.thickness() >= largestCellAt(x, grid) * (1 - 1e-9)) return;
	to.add({ x[0], x[1], x[2] }, number);
	to.add({ x[0], x[2], x[3] }, number);
}

/// Facets joined to sheets.
class Sheets {
public:
	explicit Sheets(const JoinedFacets& facets) : all_(facets), isTaken_(facets.facets.size(), false)
	{
		for (int f = 0; f < int(all_.facets.size()); ++f)
			for (int i = 0; i < 3; ++i)
				at_[edge(all_.facets[f], i)].push_back(f);
	}

	std::vector<RigidSheet> sheets()
	{
		std::vector<RigidSheet> found;
		for (int f = 0; f < int(all_.facets.size()); ++f)
			if (!isTaken_[f]) found.push_back(sheetFrom(f));
		return found;
	}

private:
	static std::array<int, 2> edge(const Facet& facet, int i) { return { std::min(facet[i], facet[(i + 1) % 3]), std::max(facet[i], facet[(i + 1) % 3]) }; }
	/// True if a facet runs along its edge i from the lower vertex to the higher one.
	static bool isUpwards(const Facet& facet, int i) { return facet[i] < facet[(i + 1) % 3]; }

	/// All facets that are joined to one by edges, turned as that one is.
	RigidSheet sheetFrom(int first)
	{
		RigidSheet         sheet;
		std::vector<Facet> facets { all_.facets[first] };
		std::vector<int>   numbers { first };
		isTaken_[first] = true;
		for (std::size_t n = 0; n < facets.size(); ++n)
			for (int i = 0; i < 3; ++i) {
				const int other = beyond(numbers[n], edge(facets[n], i));
				if (other < 0 || isTaken_[other]) continue;
				isTaken_[other] = true;
				Facet turned    = all_.facets[other];
				for (int j = 0; j < 3; ++j)
					if (edge(turned, j) == edge(facets[n], i) && isUpwards(turned, j) == isUpwards(facets[n], i)) {
						std::swap(turned[0], turned[1]);
						break;
					}
				facets.push_back(turned);
				numbers.push_back(other);
			}
		number(sheet, facets, numbers);
		return sheet;
	}

	/// The facet beyond an edge of another one: the only one there, or one that goes straight on; -1: there is
	/// none.
	int beyond(int facet, const std::array<int, 2>& edge) const
	{
		constexpr double straight = 0.9998; // cosine of a degree
		const auto&      those    = at_.at(edge);
		if (those.size() == 2) return those[those[0] == facet];
		for (const int other : those)
			if (other != facet && awayFrom(edge, facet).dot(awayFrom(edge, other)) < -straight) return other;
		return -1;
	}

	/// Direction in the plane of a facet from an edge to its third corner, normal to the edge.
	Vec3 awayFrom(const std::array<int, 2>& edge, int facet) const
	{
		const Facet& corners = all_.facets[facet];
		const int    third   = corners[0] + corners[1] + corners[2] - edge[0] - edge[1];
		const Vec3   along = (all_.positions[edge[1]] - all_.positions[edge[0]]).normalized(), off = all_.positions[third] - all_.positions[edge[0]];
		return (off - off.dot(along) * along).normalized();
	}

	/// Gives a sheet its facets, over vertices of its own. A vertex where it touches itself without an edge stays
	/// one.
	void number(RigidSheet& sheet, const std::vector<Facet>& facets, const std::vector<int>& numbers) const
	{
		std::map<int, int> own;
		for (std::size_t f = 0; f < facets.size(); ++f) {
			Facet facet;
			for (int i = 0; i < 3; ++i) {
				const auto [found, isNew] = own.emplace(facets[f][i], int(sheet.positions.size()));
				if (isNew) sheet.positions.push_back(all_.positions[facets[f][i]]);
				facet[i] = found->second;
			}
			sheet.facets.push_back(facet);
			sheet.bodies.push_back(all_.bodies[numbers[f]]);
		}
		sheet.prepare();
	}

	const JoinedFacets&                            all_;
	std::vector<bool>                              isTaken_;
	std::map<std::array<int, 2>, std::vector<int>> at_;
};

/// True if neighbours run round the same way everywhere: else a surface has one side only.
bool hasTwoSides(const PartingSheet& sheet)
{
	std::map<std::array<int, 2>, int> count;
	for (const auto& facet : sheet.facets)
		for (int i = 0; i < 3; ++i)
			if (++count[{ facet[i], facet[(i + 1) % 3] }] > 1) return false;
	return true;
}

} // namespace

std::vector<RigidSheet> sheetsOf(const std::vector<RigidBody<3>>& bodies, const Grid<3>& grid)
{
	JoinedFacets facets(1e-6 * grid.cellSize);
	for (int b = 0; b < int(bodies.size()); ++b)
		addFacetsOf(facets, bodies[b], b, grid);
	auto sheets = Sheets(facets).sheets();
	sheets.erase(std::remove_if(sheets.begin(), sheets.end(), [](const auto& sheet) { return !hasTwoSides(sheet); }), sheets.end());
	return sheets;
}

} // namespace gimpm
