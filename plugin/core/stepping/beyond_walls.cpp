// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/beyond_walls.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// The patches that walls cut off, with their points; their nodes behind walls follow the others, each patch with its own.
template <int Dim> struct CutPatches {
	struct Node {
		Index<Dim> nearest; ///< node in front of the wall
		int        axis;    ///< along which the node is behind it
	};
	CloudBasis<Dim>   basis;
	StepPoints<Dim>   points;
	std::vector<Node> nodes;

	explicit CutPatches(const StepSystem<Dim>& system) : front(int(system.basis.nodes.size()))
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
	static int allCells(const Patch<Dim>& patch)
	{
		int cells = 0;
		for (int c = 0; c < 1 << Dim; ++c)
			cells |= int((c & ~patch.span) == 0) << c;
		return cells;
	}
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
	/// The nearest node in front of walls lies on the wall: the cells on its side are reached, their neighbours are not.
	static Node behind(const StepSystem<Dim>& system, const Patch<Dim>& patch, int hidden, int count)
	{
		const Index<Dim> place   = along(patch, hidden);
		int              nearest = -1, distance = 2 * Dim + 1;
		for (int n = 0; n < count; ++n)
			if (const int d = (along(patch, n) - place).cwiseAbs().sum(); patch.node[n] >= 0 && d < distance) nearest = n, distance = d;
		int axis = 0;
		while (along(patch, nearest)[axis] == place[axis])
			++axis;
		return { Grid<Dim>::index(system.basis.nodes[patch.node[nearest]]), axis };
	}

	int front; // number of nodes that are not behind walls
};

/// By the patches that this process counts.
template <int Dim>
void addReactionsOf(
        const CutPatches<Dim>& cut, const StepSystem<Dim>& system, const PointCloud<Dim>& cloud, const Load<Dim>& load, const Eigen::VectorXd& d,
        std::vector<Vec3>& reactions)
{
	if (cut.nodes.empty()) return;
	Eigen::VectorXd displacement = Eigen::VectorXd::Zero(cut.size()), internal = displacement, external = displacement;
	displacement.head(d.size()) = system.model.atMiddle ? Eigen::VectorXd(d / 2) : d;
	addInternalForce<Dim>(cut.basis, cut.points, system.model.materials, displacement, { internal });
	addPointForces(cut.basis, pointForces(cloud, system.model, load), external);
	const auto& boundary = system.model.boundary;
	for (std::size_t n = 0; n < cut.nodes.size(); ++n)
		for (int i = 0; i < Dim; ++i) {
			const auto* box = boundary.holder(cut.nodes[n].nearest, i);
			if (!box) box = boundary.holder(cut.nodes[n].nearest, cut.nodes[n].axis);
			if (!box) continue; // an open one
			const int at = int(d.size()) + Dim * int(n) + i;
			reactions[box - boundary.boxes().data()][i] += internal[at] - external[at];
		}
}

} // namespace

template <int Dim>
void addReactionsBeyondWalls(
        const StepSystem<Dim>& system, const PointCloud<Dim>& cloud, const Load<Dim>& load, const Eigen::VectorXd& d, std::vector<Vec3>& reactions)
{
	const CutPatches<Dim> cut(system);
	if (!system.model.division) return addReactionsOf(cut, system, cloud, load, d, reactions);
	std::vector<Vec3> own(reactions.size(), Vec3::Zero());
	addReactionsOf(cut, system, cloud, load, d, own);
	if (!own.empty()) addUp(*system.model.processes, own.front().data(), 3 * int(own.size()));
	for (std::size_t b = 0; b < reactions.size(); ++b)
		reactions[b] += own[b];
}

template void addReactionsBeyondWalls(const StepSystem<2>&, const PointCloud<2>&, const Load<2>&, const Eigen::VectorXd&, std::vector<Vec3>&);
template void addReactionsBeyondWalls(const StepSystem<3>&, const PointCloud<3>&, const Load<3>&, const Eigen::VectorXd&, std::vector<Vec3>&);

} // namespace gimpm
