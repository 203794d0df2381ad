// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Surfaces as cells of a picture.
#include "engine/analysis/output_columns.hpp"
#include "engine/conditions/surface/MpmSurface.hpp"

namespace yade {

// Segments in the plane, triangles in space, with the number of whoever has the surface and tractionOn(i), that on
// piece i [Pa].
template <class F> void drawSurface(Picture& picture, const MpmSurface& surface, const char* owner, size_t number, F&& tractionOn)
{
	const int first = int(picture.corners.size());
	picture.corners.insert(picture.corners.end(), surface.vertices.begin(), surface.vertices.end());
	for (size_t i = 0; i < surface.pieces.size(); ++i) {
		vector<int> piece = surface.pieces[i];
		for (int& corner : piece)
			corner += first;
		picture.add(piece);
		picture.set("traction", tractionOn(i));
		picture.set(owner, int(number));
	}
}

} // namespace yade
