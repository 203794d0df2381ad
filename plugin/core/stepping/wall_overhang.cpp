// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/wall_overhang.hpp"
#include "core/grid/attachment.hpp"
#include "core/grid/point_nodes.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// Flags of all cells of the window of a patch.
template <int Dim> int allCells(const Patch<Dim>& patch)
{
	int cells = 0;
	for (int c = 0; c < 1 << Dim; ++c)
		cells |= int((c & ~patch.span) == 0) << c;
	return cells;
}

/// The patches that walls cut off, with their points; their nodes behind walls follow the others, each patch with its
/// own.
template <int Dim> struct CutPatches {
	struct Node {
		Key nearest; ///< node in front of the wall
		int axis;    ///< along which the node is behind it
	};
	CloudBasis<Dim>   basis;
	StepPoints<Dim>   points;
	std::vector<Node> nodes;

	explicit CutPatches(const StepSystem<Dim>& system) : points(system.points.withoutPoints()), front(int(system.basis.nodes.size()))
	{
		basis.colours.resize(system.basis.colours.size());
		for (std::size_t c = 0; c < system.basis.colours.size(); ++c)
			for (const auto& [first, last] : system.basis.colours[c]) {
				const int begin = int(basis.patches.size());
				for (int i = first; i < last; ++i)
					if (const auto& patch = system.basis.patches[i]; patch.cells != allCells(patch) && system.counts(patch))
						add(system, patch);
				if (int(basis.patches.size()) > begin) basis.colours[c].push_back({ begin, int(basis.patches.size()) });
			}
	}
	int size() const { return Dim * (front + int(nodes.size())); }

private:
	static Index<Dim> along(const Patch<Dim>& patch, int local)
	{
		Index<Dim> n;
		for (int a = 0; a < Dim; local /= patch.nodesAlong(a), ++a)
			n[a] = local % patch.nodesAlong(a);
		return n;
	}
	void add(const StepSystem<Dim>& system, Patch<Dim> patch)
	{
		const Patch<Dim> before = patch;
		int              count  = 1;
		for (int a = 0; a < Dim; ++a)
			count *= patch.nodesAlong(a);
		for (int n = 0; n < count; ++n) {
			if (patch.node[n] >= 0) continue;
			patch.node[n] = front + int(nodes.size());
			nodes.push_back(behind(system, before, n, count));
		}
		patch.first = int(basis.order.size());
		basis.patches.push_back(patch);
		for (int p = before.first; p < before.first + before.count; ++p) {
			basis.order.push_back(system.basis.order[p]);
			basis.axes.push_back(system.basis.axes[p]);
			if (system.basis.isAxisymmetric()) basis.hoop.push_back(system.basis.hoop[p]);
			points.append(system.points, p);
		}
	}
	/// The nearest node in front of walls lies on the wall: the cells on its side are reached, their neighbours are
	/// not.
	static Node behind(const StepSystem<Dim>& system, const Patch<Dim>& patch, int hidden, int count)
	{
		const Index<Dim> position = along(patch, hidden);
		int              nearest = -1, distance = 2 * Dim + 1;
		for (int n = 0; n < count; ++n)
			if (const int d = (along(patch, n) - position).cwiseAbs().sum(); patch.node[n] >= 0 && d < distance) nearest = n, distance = d;
		int axis = 0;
		while (along(patch, nearest)[axis] == position[axis])
			++axis;
		return { system.basis.nodes[patch.node[nearest]], axis };
	}

	int front; // number of nodes that are not behind walls
};

/// Box that takes the force on a node behind a wall: its number, those of the open ones following; -1: none.
template <int Dim> int ownerOf(const typename CutPatches<Dim>::Node& node, int axis, const Boundary<Dim>& boundary)
{
	const auto* box = boundary.constrainingBox(node.nearest, axis);
	if (!box) box = boundary.constrainingBox(node.nearest, node.axis);
	if (box) return int(box - boundary.boxes().data());
	const auto* open = boundary.opening(Grid<Dim>::index(node.nearest));
	return open ? int(boundary.boxes().size() + (open - boundary.open().data())) : -1;
}

/// Adds forces at the nodes behind walls to the reactions, by the patches that each process counts.
template <int Dim> void addForces(const CutPatches<Dim>& cut, const StepSystem<Dim>& system, const Eigen::VectorXd& force, StepReport& report)
{
	const auto&     boundary = system.model.boundary;
	const Division& division = *system.model.division;
	// The box of an axis of symmetry may be missing among the reactions.
	const std::size_t boxes = boundary.boxes().size(), told = report.reactions.size();
	report.openReactions.resize(boundary.open().size(), Vec3::Zero());
	std::vector<Vec3> sums(boxes + boundary.open().size(), Vec3::Zero());
	if (division.processes->rank() == 0) { // first process brings along what there is already
		std::copy(report.reactions.begin(), report.reactions.end(), sums.begin());
		std::copy(report.openReactions.begin(), report.openReactions.end(), sums.begin() + boxes);
	}
	const auto first = force.size() - Dim * Eigen::Index(cut.nodes.size());
	for (std::size_t n = 0; n < cut.nodes.size(); ++n)
		for (int i = 0; i < Dim; ++i)
			if (const int owner = ownerOf(cut.nodes[n], i, boundary); owner >= 0) sums[owner][i] += force[first + Dim * int(n) + i];
	if (!sums.empty()) addUp(*division.processes, sums.front().data(), 3 * int(sums.size()));
	for (std::size_t b = 0; b < told; ++b)
		report.reactions[b] = sums[b];
	for (std::size_t b = 0; b < report.openReactions.size(); ++b)
		report.openReactions[b] = sums[boxes + b];
}

} // namespace

template <int Dim> void keepBeforeWalls(PointCloud<Dim>& cloud, const PointCloud<Dim>& before, const StepSystem<Dim>& system, const Eigen::VectorXd& d)
{
	const Grid<Dim>& grid = system.model.grid;
	for (const auto& patch : system.basis.patches) {
		if (patch.cells == allCells(patch)) continue;
		const int      level = Grid<Dim>::level(patch.cell);
		const Vec<Dim> faces = grid.nodePosition(Grid<Dim>::index(patch.cell) + Index<Dim>::Constant(1 << level));
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int      p    = system.basis.order[i];
			const Vec<Dim> from = before.position[p] - faces, to = cloud.position[p] - faces;
			int            centre = 0; // cell of the window that the centre is in
			for (int a = 0; a < Dim; ++a)
				centre |= int((patch.span >> a & 1) && from[a] >= 0) << a;
			for (int a = 0; a < Dim; ++a) {
				const bool isWall = (patch.span >> a & 1) && grid.period[a] == 0 && !(patch.cells >> (centre ^ 1 << a) & 1);
				if (!isWall || (to[a] >= 0) == (from[a] >= 0)) continue;
				const auto attached = attach(before.position[p], system.basis, grid, before.layerOf(p));
				if (!attached) continue;
				const double there = from[a] + attached->displacement(d)[a];
				if ((there >= 0) == (from[a] >= 0)) cloud.position[p][a] = faces[a] + there;
			}
		}
	}
}

template <int Dim> void addReactionsBeyondWalls(const StepSystem<Dim>& system, const Eigen::VectorXd& d, StepReport& report)
{
	const CutPatches<Dim> cut(system);
	Eigen::VectorXd       displacement = Eigen::VectorXd::Zero(cut.size()), internal = displacement, external = displacement;
	if (!cut.nodes.empty()) {
		const double part           = system.model.atMiddle ? 0.5 : 1; // same part in InternalForceAtMiddle
		displacement.head(d.size()) = part * d;
		addInternalForce<Dim>(cut.basis, cut.basis.colours, cut.points, system.model.materials, displacement, { internal }, part);
		addPointForces(cut.basis, pointForces(system.cloud, system.model, system.load), external);
	}
	addForces(cut, system, Eigen::VectorXd(internal - external), report);
}

template <int Dim> void addInertiaBeyondWalls(const StepSystem<Dim>& system, const Motion<Dim>& motion, StepReport& report)
{
	const CutPatches<Dim> cut(system);
	Eigen::VectorXd       growth = Eigen::VectorXd::Zero(cut.size()), force = growth;
	growth.head(motion.growth.size()) = motion.growth / motion.duration;
	std::vector<Vec<Dim>> ofPoints(motion.mass.size(), Vec<Dim>::Zero());
	forPointNodes(cut.basis, [&](int i, const Patch<Dim>& patch, const double* value, int count) {
		const int p = cut.basis.order[i];
		ofPoints[p] = motion.mass[p] * atPoint(patch, value, count, growth);
	});
	if (!cut.nodes.empty()) addPointForces(cut.basis, ofPoints, force);
	addForces(cut, system, force, report);
}

template void keepBeforeWalls(PointCloud<2>&, const PointCloud<2>&, const StepSystem<2>&, const Eigen::VectorXd&);
template void keepBeforeWalls(PointCloud<3>&, const PointCloud<3>&, const StepSystem<3>&, const Eigen::VectorXd&);
template void addInertiaBeyondWalls(const StepSystem<2>&, const Motion<2>&, StepReport&);
template void addInertiaBeyondWalls(const StepSystem<3>&, const Motion<3>&, StepReport&);
template void addReactionsBeyondWalls(const StepSystem<2>&, const Eigen::VectorXd&, StepReport&);
template void addReactionsBeyondWalls(const StepSystem<3>&, const Eigen::VectorXd&, StepReport&);

} // namespace gimpm
