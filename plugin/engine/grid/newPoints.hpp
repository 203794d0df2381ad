// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Material points that are not yet in a scene.
#include "engine/grid/MpmGrid.hpp"
#include "engine/materials/parameters.hpp"
#include "engine/points/buffers.hpp"
#include <memory>

namespace yade {

// Columns of NumPy, whose memory it reads as long as it lives.
class NewPoints {
public:
	// Positions (N x 3 double), half of the side of each point's box (N double), which is its initial volume, the
	// material of each by its number (N int64) in a list, and columns (N double) of those parameters that differ
	// from point to point, by their names; the place of their body of points in MpmGrid.bodies, or -1.
	// std::invalid_argument if a material is not admissible.
	NewPoints(
	        const MpmGrid&, const py::object& positions, const py::object& half, const py::list& materials, const py::object& index,
	        const py::dict& parameters, int body);

	int      bodyOfPoints() const { return ofBody; } // or -1
	size_t   size() const { return index.size(); }
	Vector3r position(size_t point) const { return Eigen::Map<const Vector3r>(positions.data() + 3 * point); }
	Vector3r halfSize(size_t point) const;

	// std::invalid_argument if a parameter is not admissible.
	shared_ptr<Body> body(size_t point);

	// The same where columns are the same.
	std::uint64_t checksum() const;

private:
	void giveParameters(const Body&, const MpmMaterial&, size_t point);

	const bool                                               isSolid, areRings;
	const int                                                ofBody;
	const Column<Real>                                       positions, half;
	const Column<int64_t>                                    index;
	vector<shared_ptr<MpmMaterial>>                          materials;
	vector<std::pair<string, std::unique_ptr<Column<Real>>>> parameters;
	OwnMaterial                                              ownMaterial;
};

// For mpm.fill: a body for each.
py::list newBodies(
        const MpmGrid&, const py::object& positions, const py::object& half, const py::list& materials, const py::object& index, const py::dict& parameters,
        int body);

} // namespace yade
