// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"

namespace yade {

class MpmSurface : public Exposed<MpmSurface, Serializable> {
public:
	vector<Vector3r>    vertices;
	vector<vector<int>> pieces;
	vector<Vector3r>    initialVertices;

	YADE_API_NAME(MpmSurface)
	static const char* doc()
	{
		return "A surface: segments in the plane, triangles in space. Where one is wanted, a sequence of points stands for the line that joins them, a "
		       "sequence of triangles (three points each) or a gts.Surface for its triangles; mpm.surface finds that of a region.\n\n"
		       "It has an outer side: on the right of a segment from its first to its second vertex, and where a triangle's vertices are seen to run "
		       "counterclockwise. So the body is on the left of a line from point to point.\n\n"
		       "Begin with mpm.surface(region, min=..., max=...). Page: plugin/docs/classes/MpmSurface.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("vertices", &MpmSurface::vertices, 0, "Current positions [m], finite; z is not used in the plane. Read as a tuple.",
		  admitting("two or more points, all finite", areFinite));
		v("pieces", &MpmSurface::pieces, 0, "Segments or triangles, each as the two or three numbers of its vertices. Read as a tuple.",
		  admitting("one or more pieces of two numbers >= 0 each (segments), or of three each (triangles)", arePieces));
		v("initialVertices", &MpmSurface::initialVertices, readonly,
		  "Positions of the vertices at the first step [m], empty before it. The engine adds vertices until the sides of all pieces are at most a quarter of a cell.");
	}

	// 2 for segments, 3 for triangles
	int dim() const { return pieces.empty() ? 0 : int(pieces.front().size()); }

	// Length or area of a piece times its outward normal; x are the positions of all vertices.
	static Vector3r normal(const vector<int>& piece, const vector<Vector3r>& x);

	// Also whether the pieces fit the vertices, are of one kind, and have a size.
	void requireAdmissible() const override;

	// std::invalid_argument names two neighbours of which one has its outer side where the other has its inner one.
	void requireOneSide(const string& name) const;

	static shared_ptr<MpmSurface> line(const vector<Vector3r>& points);
	// Equal corners become one vertex.
	static shared_ptr<MpmSurface> triangles(const vector<vector<Vector3r>>& corners);

private:
	static bool areFinite(const vector<Vector3r>&);
	static bool arePieces(const vector<vector<int>>&);
};

// Points, triangles and surfaces of GTS too
template <> struct Conversion<shared_ptr<MpmSurface>> {
	static string expected() { return "an MpmSurface, a sequence of points, a sequence of triangles (three points each) or a gts.Surface"; }
	static std::optional<shared_ptr<MpmSurface>> fromPython(const py::object&);
	static py::object                            toPython(const shared_ptr<MpmSurface>& value) { return py::object(value); }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmSurface)
