// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/surface.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace gimpm {
namespace {

using Triangle = Surface<3>::Piece;

/// Corners of a rectangle, in the sense of its triangles.
using Rectangle = std::array<int, 4>;

/// The triangle turned so that its right angle comes first; none if it has no right angle.
std::optional<Triangle> fromRightAngle(const Triangle& piece, const std::vector<Vec<3>>& x)
{
	constexpr double right = 1e-6; // cosine
	for (int i = 0; i < 3; ++i) {
		const Triangle turned { piece[i], piece[(i + 1) % 3], piece[(i + 2) % 3] };
		const Vec<3>   a = x[turned[1]] - x[turned[0]], b = x[turned[2]] - x[turned[0]];
		if (std::abs(a.dot(b)) < right * a.norm() * b.norm()) return turned;
	}
	return std::nullopt;
}

/// The rectangles that two triangles make up, and the triangles that are none of theirs.
std::pair<std::vector<Rectangle>, std::vector<Triangle>> paired(const Surface<3>& surface)
{
	constexpr double                                         same = 1e-6; // distance over the diagonal
	std::pair<std::vector<Rectangle>, std::vector<Triangle>> result;
	std::map<std::pair<int, int>, Triangle>                  halves; // by the ends of the diagonal
	for (const Triangle& piece : surface.pieces) {
		const auto half = fromRightAngle(piece, surface.vertices);
		if (!half) {
			result.second.push_back(piece);
			continue;
		}
		const auto& x     = surface.vertices;
		const auto  other = halves.find({ (*half)[2], (*half)[1] });
		if (other != halves.end()
		    && (x[other->second[0]] + x[(*half)[0]] - x[(*half)[1]] - x[(*half)[2]]).norm() < same * (x[(*half)[1]] - x[(*half)[2]]).norm()) {
			result.first.push_back({ (*half)[0], (*half)[1], other->second[0], (*half)[2] });
			halves.erase(other);
		} else if (!halves.emplace(std::pair((*half)[1], (*half)[2]), *half).second)
			result.second.push_back(*half); // of a surface that is no manifold
	}
	for (const auto& [diagonal, half] : halves)
		result.second.push_back(half);
	return result;
}

/// Vertices of a surface, with those that are added; one at each position of a side.
class Vertices {
public:
	explicit Vertices(Surface<3>& surface) : surface_(surface) { }

	int add(const Vec<3>& x)
	{
		surface_.vertices.push_back(x), surface_.vertices0.push_back(x);
		return int(surface_.vertices.size()) - 1;
	}

	/// Ends and dividing vertices of a side, from its first end to its second.
	std::vector<int> along(int from, int to, int parts)
	{
		auto& side = sides_[std::minmax(from, to)];
		if (side.empty()) {
			const auto [first, last] = std::minmax(from, to);
			side.push_back(first);
			for (int i = 1; i < parts; ++i)
				side.push_back(add(between(first, last, double(i) / parts)));
			side.push_back(last);
		}
		return from < to ? side : std::vector<int>(side.rbegin(), side.rend());
	}

	/// Position between two vertices, the same to the last bit from either one.
	Vec<3> between(int from, int to, double part) const { return (1 - part) * surface_.vertices[from] + part * surface_.vertices[to]; }

private:
	Surface<3>&                                     surface_;
	std::map<std::pair<int, int>, std::vector<int>> sides_;
};

void divide(const Rectangle& corners, double size, Vertices& vertices, Surface<3>& surface)
{
	const auto parts = [&](int from, int to) {
		constexpr double slack = 1e-9;
		return std::max(1, int(std::ceil((surface.vertices[from] - surface.vertices[to]).norm() / size - slack)));
	};
	const int        columns = parts(corners[0], corners[1]), rows = parts(corners[1], corners[2]);
	const auto       below = vertices.along(corners[0], corners[1], columns), above = vertices.along(corners[3], corners[2], columns);
	const auto       left = vertices.along(corners[0], corners[3], rows), right = vertices.along(corners[1], corners[2], rows);
	std::vector<int> last = below;
	for (int row = 1; row <= rows; ++row) {
		std::vector<int> next { left[row] };
		for (int column = 1; column < columns; ++column)
			next.push_back(row == rows ? above[column] : vertices.add(vertices.between(left[row], right[row], double(column) / columns)));
		next.push_back(right[row]);
		for (int column = 0; column < columns; ++column) {
			const Rectangle part { last[column], last[column + 1], next[column + 1], next[column] };
			Vec<3>          centre = Vec<3>::Zero();
			for (const int v : part)
				centre += surface.vertices[v] / 4;
			const int middle = vertices.add(centre);
			for (int i = 0; i < 4; ++i)
				surface.pieces.push_back({ part[i], part[(i + 1) % 4], middle });
		}
		last = std::move(next);
	}
}

} // namespace

void divideRectangles(Surface<3>& surface, double size)
{
	const auto [rectangles, others] = paired(surface);
	surface.pieces                  = others;
	Vertices vertices(surface);
	for (const Rectangle& corners : rectangles)
		divide(corners, size, vertices, surface);
}

} // namespace gimpm
