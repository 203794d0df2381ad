// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/boundary/boxes.hpp"

namespace yade {

namespace {
	// In place of a wall, among the boxes of the boundaries.
	template <int Dim> gimpm::ConstrainedBox<Dim> holdsNothing()
	{
		gimpm::ConstrainedBox<Dim> box;
		box.lower.setOnes();
		box.upper.setZero();
		return box;
	}

	template <int Dim> gimpm::ConstrainedBox<Dim> heldBox(const MpmBoundary& boundary, const MpmGrid& grid, const gimpm::Grid<Dim>& lattice)
	{
		if (boundary.surface) return holdsNothing<Dim>();
		auto box         = boxOfNodes<Dim>("MpmBoundary", boundary.min, boundary.max, grid, lattice);
		box.displacement = boundary.displacement.head<Dim>();
		for (int axis = 0; axis < Dim; ++axis)
			box.fixed[axis] = boundary.fixes(axis);
		if (lattice.axisymmetric && box.fixed[0] && box.displacement[0] != 0 && box.meets(gimpm::ConstrainedBox<Dim>::ofAxis(lattice)))
			throw std::invalid_argument(
			        "MpmBoundary.displacement[0] = " + std::to_string(box.displacement[0])
			        + ": the box moves nodes on the axis x = 0 of MpmGrid.axisymmetric, which stay there; let it begin beside the axis.");
		if (Dim == 2 && boundary.fixes(2))
			throw std::invalid_argument(
			        "MpmBoundary.fix = '" + boundary.fix + "': there is no direction z on a grid with dim=2 (plane strain in x-y).");
		return box;
	}

	// Compares two boxes along one axis.
	template <int Dim>
	bool moveAlike(const vector<gimpm::ConstrainedBox<Dim>>& boxes, const vector<shared_ptr<MpmBoundary>>& boundaries, size_t i, size_t j, int axis)
	{
		const Real one = boxes[i].displacement[axis];
		return one == boxes[j].displacement[axis] && (one == 0 || boundaries[i]->curve == boundaries[j]->curve);
	}
}

template <int Dim> void refuseConflicts(const vector<gimpm::ConstrainedBox<Dim>>& boxes, const vector<shared_ptr<MpmBoundary>>& boundaries)
{
	for (size_t i = 0; i < boxes.size(); ++i)
		for (size_t j = 0; j < i; ++j)
			for (int axis = 0; axis < Dim; ++axis) {
				if (!boxes[i].meets(boxes[j]) || !boxes[i].fixed[axis] || !boxes[j].fixed[axis] || moveAlike(boxes, boundaries, i, j, axis))
					continue;
				std::ostringstream text;
				text << "boundaries[" << j << "] and boundaries[" << i << "] prescribe different displacements along "
				     << "xyz"[axis] << " (" << boxes[j].displacement[axis] << " and " << boxes[i].displacement[axis]
				     << " m, each by its curve) to the nodes that lie in both boxes.";
				throw std::invalid_argument(text.str());
			}
}

template <int Dim>
vector<gimpm::ConstrainedBox<Dim>> heldBoxes(const vector<shared_ptr<MpmBoundary>>& boundaries, const MpmGrid& grid, const gimpm::Grid<Dim>& lattice)
{
	vector<gimpm::ConstrainedBox<Dim>> boxes;
	for (const auto& boundary : boundaries)
		boxes.push_back(heldBox<Dim>(*boundary, grid, lattice));
	return boxes;
}

template void                             refuseConflicts(const vector<gimpm::ConstrainedBox<2>>&, const vector<shared_ptr<MpmBoundary>>&);
template void                             refuseConflicts(const vector<gimpm::ConstrainedBox<3>>&, const vector<shared_ptr<MpmBoundary>>&);
template vector<gimpm::ConstrainedBox<2>> heldBoxes(const vector<shared_ptr<MpmBoundary>>&, const MpmGrid&, const gimpm::Grid<2>&);
template vector<gimpm::ConstrainedBox<3>> heldBoxes(const vector<shared_ptr<MpmBoundary>>&, const MpmGrid&, const gimpm::Grid<3>&);

} // namespace yade
