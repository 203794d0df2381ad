// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"

namespace yade {

class MpmBody : public Exposed<MpmBody, Serializable> {
public:
	string              name, partOf;
	vector<Vector3r>    vertices, initialVertices;
	vector<vector<int>> pieces;

	YADE_API_NAME(MpmBody)
	static const char* doc()
	{
		return "A body of points with a name, which may be in contact with others (MpmBodyContact): its surface, which moves with it. mpm.fill(..., body='slab') makes it, "
		       "and puts it into MpmGrid.bodies; its points have its number there as *MpmState.body*.\n\n"
		       "Not to be made itself: begin with mpm.fill(..., body=...). Page: plugin/docs/classes/MpmBody.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("name", &MpmBody::name, 0, "Name in MpmBodyContact.between, not empty.",
		  admitting("a name that is not empty", [](const string& s) { return !s.empty(); }));
		v("vertices", &MpmBody::vertices, 0,
		  "Current positions of the vertices of its surface [m], finite; z is not used in the plane. Read as a tuple.",
		  admitting("points, all finite", areFinite));
		v("pieces", &MpmBody::pieces, 0,
		  "Segments or triangles of the surface, each as the two or three numbers of its vertices (MpmSurface). Read as a tuple.",
		  admitting("pieces of two numbers >= 0 each (segments), or of three each (triangles)", arePieces));
		v("partOf", &MpmBody::partOf, readonly,
		  "Name of the body that it has come off, where that has a contact with itself; empty, the default: none.");
		v("initialVertices", &MpmBody::initialVertices, readonly,
		  "Positions of the vertices at the first step [m], empty before it. Pieces are divided until their sides are at most a quarter of a cell, "
		  "in 3D three quarters.");
	}

	// The pieces must be those of the vertices, too.
	void requireAdmissible() const override;

private:
	static bool areFinite(const vector<Vector3r>&);
	static bool arePieces(const vector<vector<int>>&);
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmBody)
