// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/surface/surfaces.hpp"
#include <algorithm>

namespace yade {

template <int Dim> std::vector<gimpm::Vec<Dim>> inDimension(const vector<Vector3r>& points)
{
	std::vector<gimpm::Vec<Dim>> result;
	for (const Vector3r& x : points)
		result.push_back(x.head<Dim>());
	return result;
}

template <int Dim> vector<Vector3r> inSpace(const std::vector<gimpm::Vec<Dim>>& points, Real z)
{
	vector<Vector3r> result;
	for (const auto& x : points) {
		result.emplace_back(0, 0, z);
		result.back().template head<Dim>() = x;
	}
	return result;
}

template <int Dim> void requireDimension(const MpmSurface& surface, const string& name)
{
	if (surface.dim() != Dim)
		throw std::invalid_argument(
		        name + ".surface is made of " + (Dim == 2 ? "triangles" : "segments") + ", but the grid has dim=" + std::to_string(Dim) + ": expected "
		        + (Dim == 2 ? "a line of points." : "triangles."));
}

template <int Dim> gimpm::Surface<Dim> coreSurface(const MpmSurface& surface)
{
	gimpm::Surface<Dim> result { inDimension<Dim>(surface.vertices), {}, {} };
	result.vertices0 = surface.initialVertices.empty() ? result.vertices : inDimension<Dim>(surface.initialVertices);
	for (const vector<int>& piece : surface.pieces) {
		result.pieces.emplace_back();
		std::copy(piece.begin(), piece.end(), result.pieces.back().begin());
	}
	return result;
}

template <int Dim> void scatter(const gimpm::Surface<Dim>& surface, MpmSurface& to)
{
	const Real z       = to.vertices.front()[2];
	to.vertices        = inSpace<Dim>(surface.vertices, z);
	to.initialVertices = inSpace<Dim>(surface.vertices0, z);
	to.pieces.clear();
	for (const auto& piece : surface.pieces)
		to.pieces.emplace_back(piece.begin(), piece.end());
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template std::vector<gimpm::Vec<Dim>> inDimension<Dim>(const vector<Vector3r>&);                                                                       \
	template vector<Vector3r>             inSpace<Dim>(const std::vector<gimpm::Vec<Dim>>&, Real);                                                         \
	template void                         requireDimension<Dim>(const MpmSurface&, const string&);                                                         \
	template gimpm::Surface<Dim>          coreSurface<Dim>(const MpmSurface&);                                                                             \
	template void                         scatter<Dim>(const gimpm::Surface<Dim>&, MpmSurface&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
