// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Rigid bodies of the scene, as the core understands them.
#include "core/grid/grid.hpp"
#include "core/terms/contact/rigid_body.hpp"
#include "yade_api/scene.hpp"
#include <optional>

namespace yade {

inline Se3r operator*(const Se3r& a, const Se3r& b) { return { a.position + a.orientation * b.position, a.orientation * b.orientation }; }
inline Se3r inverse(const Se3r& a) { return { a.orientation.conjugate() * -a.position, a.orientation.conjugate() }; }

inline Se3r poseOf(const State& state) { return { state.pos, state.ori.normalized() }; }

// Pose of a body that has moved with its velocities for some time.
Se3r ahead(const State&, const Se3r& from, Real time);

// Part of the way from one pose to another.
inline Se3r between(const Se3r& a, const Se3r& b, Real part)
{
	return { (1 - part) * a.position + part * b.position, a.orientation.slerp(part, b.orientation) };
}

// Its shape, where the body is at this pose, and pose and name of it; none of a body that has no section at z = 0 in
// the plane. std::invalid_argument names what the body is that cannot touch.
template <int Dim> std::optional<gimpm::RigidBody<Dim>> rigidBody(const Body&, const Se3r& at, const gimpm::Grid<Dim>&);

// Pose of the same body at another time. Its axes are turned by its rotation since the first one.
template <int Dim> gimpm::Pose<Dim> poseOf(const Body&, const Se3r& first, const Se3r& now);

// The pose from which a body's turn counts. A Sphere's is one that does not change from run to run, so that the places
// on it turn with it; that of a Facet or a Wall, whose shape is told where it is, is that at which its run begins.
template <int Dim> Se3r unturned(const Body&, const Se3r& at, const gimpm::Grid<Dim>&);

} // namespace yade
