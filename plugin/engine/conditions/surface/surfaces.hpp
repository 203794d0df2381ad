// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Surfaces between a scene and the core.
#include "core/grid/surface.hpp"
#include "engine/conditions/surface/MpmSurface.hpp"

namespace yade {

template <int Dim> std::vector<gimpm::Vec<Dim>> inDimension(const vector<Vector3r>&);
template <int Dim> vector<Vector3r>             inSpace(const std::vector<gimpm::Vec<Dim>>&, Real z);

// std::invalid_argument begins with the name of what has the surface.
template <int Dim> void requireDimension(const MpmSurface&, const string& name);

template <int Dim> gimpm::Surface<Dim> coreSurface(const MpmSurface&);
template <int Dim> void                scatter(const gimpm::Surface<Dim>&, MpmSurface&);

} // namespace yade
