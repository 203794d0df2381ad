// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/MpmBody.hpp"
#include "yade_api/registration.hpp"
#include <algorithm>

namespace yade {

bool MpmBody::areFinite(const vector<Vector3r>& points)
{
	return std::all_of(points.begin(), points.end(), [](const Vector3r& x) { return x.allFinite(); });
}

bool MpmBody::arePieces(const vector<vector<int>>& pieces)
{
	return std::all_of(pieces.begin(), pieces.end(), [&](const vector<int>& piece) {
		return (piece.size() == 2 || piece.size() == 3) && piece.size() == pieces[0].size() && *std::min_element(piece.begin(), piece.end()) >= 0;
	});
}

void MpmBody::requireAdmissible() const
{
	Exposed<MpmBody, Serializable>::requireAdmissible();
	for (const auto& piece : pieces)
		if (*std::max_element(piece.begin(), piece.end()) >= int(vertices.size()))
			throw std::invalid_argument(
			        "MpmBody.pieces: body '" + name + "' has a piece with vertices " + textOf(piece) + ", and there are "
			        + std::to_string(vertices.size()) + " only.");
	if (!initialVertices.empty() && initialVertices.size() != vertices.size())
		throw std::invalid_argument(
		        "MpmBody.vertices: body '" + name + "' has " + std::to_string(vertices.size()) + " after steps with "
		        + std::to_string(initialVertices.size()) + "; a surface that has moved cannot be given others.");
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmBody)
static const yade::PluginClasses<yade::MpmBody> registeredMpmBody(__FILE__);
