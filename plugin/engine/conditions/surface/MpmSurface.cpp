// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/surface/MpmSurface.hpp"
#include "core/grid/surface.hpp"
#include "yade_api/registration.hpp"
#include <algorithm>
#include <map>

namespace yade {

namespace {
	// A point of two or three numbers
	std::optional<Vector3r> pointFrom(const py::object& value)
	{
		const auto numbers = Conversion<vector<Real>>::fromPython(value);
		if (!numbers || numbers->size() < 2 || numbers->size() > 3) return std::nullopt;
		return Vector3r((*numbers)[0], (*numbers)[1], numbers->size() == 3 ? (*numbers)[2] : 0);
	}

	std::optional<vector<Vector3r>> pointsFrom(const py::object& value)
	{
		const auto items = itemsOf(value);
		if (!items) return std::nullopt;
		vector<Vector3r> points;
		for (const py::object& item : *items) {
			const auto point = pointFrom(item);
			if (!point) return std::nullopt;
			points.push_back(*point);
		}
		return points;
	}

	std::optional<vector<vector<Vector3r>>> trianglesFrom(const py::object& value)
	{
		const auto items = itemsOf(value);
		if (!items) return std::nullopt;
		vector<vector<Vector3r>> triangles;
		for (const py::object& item : *items) {
			const auto corners = pointsFrom(item);
			if (!corners || corners->size() != 3) return std::nullopt;
			triangles.push_back(*corners);
		}
		return triangles;
	}

	// A surface of the Python module gts: its faces have their vertices in order.
	py::object facesOf(const py::object& surface)
	{
		py::list triangles;
		if (!PyObject_HasAttrString(surface.ptr(), "faces")) return triangles;
		const py::object faces = surface.attr("faces")();
		for (py::ssize_t f = 0; f < py::len(faces); ++f) {
			py::list         corners;
			const py::object vertices = faces[f].attr("vertices")();
			for (py::ssize_t i = 0; i < py::len(vertices); ++i)
				corners.append(vertices[i].attr("coords")());
			triangles.append(corners);
		}
		return triangles;
	}
}

bool MpmSurface::areFinite(const vector<Vector3r>& points)
{
	return points.size() >= 2 && std::all_of(points.begin(), points.end(), [](const Vector3r& x) { return x.allFinite(); });
}

bool MpmSurface::arePieces(const vector<vector<int>>& pieces)
{
	return !pieces.empty() && (pieces[0].size() == 2 || pieces[0].size() == 3) && std::all_of(pieces.begin(), pieces.end(), [&](const vector<int>& piece) {
		return piece.size() == pieces[0].size() && *std::min_element(piece.begin(), piece.end()) >= 0;
	});
}

Vector3r MpmSurface::normal(const vector<int>& piece, const vector<Vector3r>& x)
{
	if (piece.size() == 3) return gimpm::pieceNormal(x[piece[0]], x[piece[1]], x[piece[2]]);
	const gimpm::Vec<2> inPlane = gimpm::pieceNormal(gimpm::Vec<2>(x[piece[0]].head<2>()), gimpm::Vec<2>(x[piece[1]].head<2>()));
	return { inPlane[0], inPlane[1], 0 };
}

void MpmSurface::requireAdmissible() const
{
	Exposed<MpmSurface, Serializable>::requireAdmissible();
	for (size_t i = 0; i < pieces.size(); ++i) {
		std::ostringstream text;
		text << "MpmSurface.pieces[" << i << "] = " << textOf(pieces[i]);
		if (*std::max_element(pieces[i].begin(), pieces[i].end()) >= int(vertices.size()))
			throw std::invalid_argument(text.str() + ": there are vertices 0 to " + std::to_string(vertices.size() - 1) + " only.");
		if (!(normal(pieces[i], vertices).norm() > 0))
			throw std::invalid_argument(
			        text.str() + ", with a vertex at " + textOf(vertices[pieces[i][0]]) + ", has no size: do vertices coincide?");
	}
	if (!initialVertices.empty() && initialVertices.size() != vertices.size())
		throw std::invalid_argument(
		        "MpmSurface.vertices: " + std::to_string(vertices.size()) + " points after steps with " + std::to_string(initialVertices.size())
		        + "; make a new surface instead.");
}

namespace {
	// Sides of a segment or triangle, which it may have in common with one neighbour, and whether it goes along
	// them from the lower number of its vertices to the higher one; of a segment its ends, and whether it begins
	// there.
	vector<std::pair<vector<int>, bool>> sidesOf(const vector<int>& piece)
	{
		if (piece.size() == 2) return { { { piece[0] }, true }, { { piece[1] }, false } };
		vector<std::pair<vector<int>, bool>> sides;
		for (size_t i = 0; i < piece.size(); ++i) {
			const int a = piece[i], b = piece[(i + 1) % piece.size()];
			sides.push_back({ { std::min(a, b), std::max(a, b) }, a < b });
		}
		return sides;
	}
}

void MpmSurface::requireOneSide(const string& name) const
{
	std::map<vector<int>, vector<std::pair<size_t, bool>>> bySide;
	for (size_t i = 0; i < pieces.size(); ++i)
		for (const auto& [side, isUpwards] : sidesOf(pieces[i]))
			bySide[side].emplace_back(i, isUpwards);
	for (const auto& [side, there] : bySide)
		if (there.size() == 2 && there[0].second == there[1].second)
			throw std::invalid_argument(
			        name + ": of the pieces " + std::to_string(there[0].first) + " and " + std::to_string(there[1].first) + ", which meet at "
			        + textOf(vertices[side[0]])
			        + ", one is inside out: its outer side is where the other has its inner one, so that the pressure would push there and pull here. "
			          "Reverse the order of its vertices.");
}

shared_ptr<MpmSurface> MpmSurface::line(const vector<Vector3r>& points)
{
	const auto surface = boost::make_shared<MpmSurface>();
	surface->vertices  = points;
	const bool closes  = points.size() > 3 && points.front() == points.back();
	if (closes) surface->vertices.pop_back();
	for (int i = 0; i + 1 < int(points.size()); ++i)
		surface->pieces.push_back({ i, (i + 1) % int(surface->vertices.size()) });
	return surface;
}

shared_ptr<MpmSurface> MpmSurface::triangles(const vector<vector<Vector3r>>& corners)
{
	const auto surface = boost::make_shared<MpmSurface>();
	const auto before  = [](const Vector3r& a, const Vector3r& b) { return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3); };
	std::map<Vector3r, int, decltype(before)> numbers(before);
	for (const auto& triangle : corners) {
		vector<int> piece;
		for (const Vector3r& x : triangle) {
			const auto [found, isNew] = numbers.try_emplace(x, int(surface->vertices.size()));
			if (isNew) surface->vertices.push_back(x);
			piece.push_back(found->second);
		}
		surface->pieces.push_back(piece);
	}
	return surface;
}

std::optional<shared_ptr<MpmSurface>> Conversion<shared_ptr<MpmSurface>>::fromPython(const py::object& value)
{
	const py::extract<shared_ptr<MpmSurface>> extracted(value);
	if (extracted.check()) return extracted();
	if (const auto points = pointsFrom(value); points && points->size() >= 2) return MpmSurface::line(*points);
	const auto triangles = trianglesFrom(itemsOf(value) ? value : facesOf(value));
	if (triangles && !triangles->empty()) return MpmSurface::triangles(*triangles);
	return std::nullopt;
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmSurface)
static const yade::PluginClasses<yade::MpmSurface> registeredMpmSurface(__FILE__);
