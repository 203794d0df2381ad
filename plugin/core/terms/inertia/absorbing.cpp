// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/absorbing.hpp"
#include "core/grid/neighbours.hpp"
#include "core/grid/surface.hpp"
#include "core/terms/overlap.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace gimpm {
namespace {

/// Node n of a face of a leaf, as if the grid were not periodic.
template <int Dim> Index<Dim> nodeOfFace(Key leaf, int axis, bool isUpper, int n)
{
	const int  level = Grid<Dim>::level(leaf);
	Index<Dim> node  = Grid<Dim>::index(leaf);
	node[axis] += isUpper << level;
	for (int a = 0, bit = 0; a < Dim; ++a)
		if (a != axis) node[a] += (n >> bit++ & 1) << level;
	return node;
}

template <int Dim> bool holdsFace(const ConstrainedBox<Dim>& box, Key leaf, int axis, bool isUpper)
{
	for (int n = 0; n < 1 << (Dim - 1); ++n)
		if (!box.contains(nodeOfFace<Dim>(leaf, axis, isUpper, n))) return false;
	return true;
}

/// True if a side of a box lies between the nodes of a large leaf that it reaches.
template <int Dim> bool cutsLeaf(const ConstrainedBox<Dim>& box, Key leaf)
{
	const Index<Dim> low = Grid<Dim>::index(leaf), high = low + Index<Dim>::Constant(1 << Grid<Dim>::level(leaf));
	if ((low.array() > box.upper.array()).any() || (high.array() < box.lower.array()).any()) return false;
	const auto isInside = [&](const Index<Dim>& side) { return (side.array() > low.array() && side.array() < high.array()).any(); };
	return isInside(box.lower) || isInside(box.upper);
}

template <int Dim> Vec<Dim> centreOf(Key leaf, const Grid<Dim>& grid)
{
	return grid.nodePosition(Grid<Dim>::index(leaf)) + Vec<Dim>::Constant(grid.size(Grid<Dim>::level(leaf)) / 2);
}

/// Volume of a leaf, around an axis of symmetry that of a ring.
template <int Dim> double leafVolume(Key leaf, const Grid<Dim>& grid)
{
	return std::pow(grid.size(Grid<Dim>::level(leaf)), Dim) * aroundAxis(centreOf(leaf, grid)[0], grid);
}

/// Material in a leaf: its volume, and impedances rho c times that.
struct FilledLeaf {
	double volume = 0, pressure = 0, shear = 0;
};

} // namespace

/// A state of isotropic pressure yields under no law that can carry one.
template <int Dim> WaveModuli waveModuli(const std::vector<Material>& materials, const PointCloud<Dim>& cloud, int p)
{
	constexpr double little   = -1e-6; // off the apex of laws that carry no tension
	const Material&  material = materials[cloud.material[p]];
	const auto       strain   = [&] { return std::min(cloud.elasticStrain[p].full().trace(), little); };
	WaveModuli       moduli = material.law->waveModuli({ material.ofPoints(cloud.parameters), cloud.internals, std::size_t(p) }, VolumetricStrain(strain));
	moduli.pressure += material.waterModulus;
	return moduli;
}

template <int Dim>
Absorption<Dim>::Absorption(
        AbsorbingBoundary<Dim>& boundary, const std::vector<Material>& materials, const std::vector<double>& masses, const StepContext<Dim>& step)
        : boundary_(boundary)
{
	addDrag(faces(step), materials, masses, step);
	completeDrag(step);
	takeOver(step);
	if (dashpots_.empty() && obstacle_.empty())
		obstacle_ = boundary_.name + ": no face of a cell with material has all of its nodes in the box of that absorbing boundary";
	for (auto& [node, dashpot] : dashpots_)
		for (int a = 0; a < Dim; ++a)
			if (step.dofs.number[Dim * node + a] < 0) dashpot.drag[a] = dashpot.borne[a] = 0;
}

/// Those with material on one side. Leaves that lie in the box as a whole are beyond.
template <int Dim> std::vector<typename Absorption<Dim>::Face> Absorption<Dim>::faces(const StepContext<Dim>& step)
{
	const auto&       leaves = step.basis.populatedLeaves();
	std::vector<Face> found;
	std::vector<int>  both; // leaves with material beyond a face of the boundary
	for (int c = 0; c < int(leaves.size()); ++c) {
		if (Grid<Dim>::level(leaves[c]) > 0 && cutsLeaf(boundary_.box, leaves[c])) obstacle_ = textOfCut(leaves[c], step);
		for (int side = 0; side < 2 * Dim; ++side) {
			const int  axis    = side / 2;
			const bool isUpper = side % 2;
			if (!holdsFace(boundary_.box, leaves[c], axis, isUpper)) continue;
			const bool isBeyond = holdsFace(boundary_.box, leaves[c], axis, !isUpper);
			forNeighbours(leaves[c], axis, isUpper, step.grid, [&](Key beyond, int) {
				if (const int other = find(leaves, beyond); other >= 0) both.push_back(isBeyond ? c : other);
			});
			if (isBeyond) continue;
			Face face { c, axis, {} };
			for (int n = 0; n < 1 << (Dim - 1); ++n) {
				const Index<Dim> node = step.grid.first(nodeOfFace<Dim>(leaves[c], axis, isUpper, n));
				face.node[n] = position(step.basis.nodes, Grid<Dim>::key(node, Grid<Dim>::level(leaves[c]), Grid<Dim>::layer(leaves[c])));
			}
			found.push_back(face);
		}
	}
	if (!both.empty()) obstacle_ = textOfBothSides(both, step);
	return found;
}

template <int Dim> std::string Absorption<Dim>::textOfCut(Key leaf, const StepContext<Dim>& step) const
{
	std::ostringstream text;
	text << boundary_.name << " lies between the nodes of a larger cell, around (" << centreOf(leaf, step.grid).transpose()
	     << "): let it reach them, or halve the cells there";
	return text.str();
}

/// Refuses material on both sides: names where most of it is, and how much there is, of the points that this process
/// has.
template <int Dim> std::string Absorption<Dim>::textOfBothSides(const std::vector<int>& beyond, const StepContext<Dim>& step) const
{
	const auto&         leaves = step.basis.populatedLeaves();
	std::vector<char>   isAskedFor(leaves.size(), 0);
	std::vector<double> filled(leaves.size(), 0);
	for (const int leaf : beyond)
		isAskedFor[leaf] = 1;
	forOverlaps(isAskedFor, step.basis, step.grid, [&](int cell, int p, auto within) {
		const int leaf = step.basis.leaf(cell);
		filled[leaf] += within(step.stiffnessOf(p).volume) / leafVolume(leaves[leaf], step.grid);
	});
	const int          most = int(std::max_element(filled.begin(), filled.end()) - filled.begin());
	std::ostringstream text;
	text << boundary_.name << " has material on both sides: behind it are " << std::accumulate(filled.begin(), filled.end(), 0.)
	     << " cells full, most of it in the cell around (" << centreOf(leaves[most], step.grid).transpose() << "), of which it fills " << filled[most]
	     << "; it has to be at the edge of the body, and what moves there has to stay in front of it";
	return text.str();
}

/// A face is covered to the part to which its leaf is filled.
template <int Dim>
void Absorption<Dim>::addDrag(
        const std::vector<Face>& faces, const std::vector<Material>& materials, const std::vector<double>& masses, const StepContext<Dim>& step)
{
	const auto&       leaves = step.basis.populatedLeaves();
	std::vector<char> isAskedFor(leaves.size(), 0);
	for (const Face& face : faces)
		isAskedFor[face.leaf] = 1;
	std::vector<FilledLeaf> fillings(leaves.size());
	forOverlaps(isAskedFor, step.basis, step.grid, [&](int cell, int p, auto within) {
		const double     volume = step.stiffnessOf(p).volume, density = masses[p] / volume, overlap = within(volume);
		const WaveModuli moduli  = waveModuli(materials, step.cloud, p);
		FilledLeaf&      filling = fillings[step.basis.leaf(cell)];
		filling.volume += overlap;
		filling.pressure += overlap * std::sqrt(density * moduli.pressure);
		filling.shear += overlap * std::sqrt(density * moduli.shear);
	});
	for (const Face& face : faces) {
		const FilledLeaf& filling = fillings[face.leaf];
		const double      h = step.grid.size(Grid<Dim>::level(leaves[face.leaf])), inside = centreOf(leaves[face.leaf], step.grid)[0];
		const double      filled = std::min(filling.volume / leafVolume(leaves[face.leaf], step.grid), 1.);
		for (const int node : face.node) {
			// the integral of the node's shape function over the face, in axisymmetry over a part of a ring
			const double at        = step.grid.nodePosition(Grid<Dim>::index(step.basis.nodes[node]))[0];
			const double radius    = face.axis == 0 ? at : (at + 2 * inside) / 3;
			const double area      = filled * std::pow(h, Dim - 1) * aroundAxis(radius, step.grid) / (1 << (Dim - 1));
			Vec<Dim>     impedance = Vec<Dim>::Constant(filling.shear / filling.volume);
			impedance[face.axis]   = filling.pressure / filling.volume;
			dashpots_[node].drag += area * impedance;
		}
	}
}

/// Completes the drag by the owned nodes: with divided points this process has those that fill the cells at its own
/// nodes.
template <int Dim> void Absorption<Dim>::completeDrag(const StepContext<Dim>& step)
{
	Eigen::VectorXd drag = Eigen::VectorXd::Zero(Dim * Eigen::Index(step.basis.nodes.size()));
	for (const auto& [node, dashpot] : dashpots_)
		drag.template segment<Dim>(Dim * node) = dashpot.drag;
	step.ownedNodes.complete(drag);
	tieDashpots(step);
	step.basis.affineConstraints.template condense<Dim>(drag);
	for (auto& [node, dashpot] : dashpots_)
		dashpot.drag = drag.template segment<Dim>(Dim * node);
}

/// Dashpots of tied nodes act on their masters, each with its share, so that they stay diagonal.
template <int Dim> void Absorption<Dim>::tieDashpots(const StepContext<Dim>& step)
{
	const auto& tied = step.basis.affineConstraints;
	for (std::size_t t = 0; t < tied.node.size(); ++t)
		if (dashpots_.erase(tied.node[t]) > 0)
			for (int m = tied.start[t]; m < tied.start[t + 1]; ++m)
				dashpots_[tied.master[m]];
}

template <int Dim> void Absorption<Dim>::takeOver(const StepContext<Dim>& step)
{
	if (!boundary_.hasBegun) {
		boundary_.borne.clear();
		const Eigen::VectorXd imbalance = step.imbalance();
		for (const auto& [node, dashpot] : dashpots_)
			boundary_.borne[step.basis.nodes[node]] = -imbalance.template segment<Dim>(Dim * node);
	}
	for (const auto& [key, force] : boundary_.borne)
		if (const int node = find(step.basis.nodes, key); node >= 0) dashpots_[node].borne = force;
}

template <int Dim> void Absorption<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (const auto& [node, dashpot] : dashpots_)
		K.markUsed(node, 0);
}

template <int Dim> void Absorption<Dim>::add(const Eigen::VectorXd& v, double velocityDerivative, const AssembledTerms<Dim>& sum) const
{
	for (const auto& [node, dashpot] : dashpots_) {
		const Vec<Dim> drag = dashpot.drag.cwiseProduct(v.template segment<Dim>(Dim * node)), push = 2 * dashpot.drag.cwiseProduct(boundary_.incoming);
		sum.force.template segment<Dim>(Dim * node) += drag - push - dashpot.borne;
		if (sum.absoluteContributions)
			sum.absoluteContributions->template segment<Dim>(Dim * node) += drag.cwiseAbs() + push.cwiseAbs() + dashpot.borne.cwiseAbs();
		if (sum.K && sum.K->keeps(node))
			for (int a = 0; a < Dim; ++a)
				sum.K->at(node, 0)[a * (Dim + 1)] += velocityDerivative * dashpot.drag[a];
	}
}

template <int Dim> void Absorption<Dim>::addBefore(const Eigen::VectorXd& v, Eigen::VectorXd& force) const
{
	for (const auto& [node, dashpot] : dashpots_)
		force.template segment<Dim>(Dim * node)
		        += dashpot.drag.cwiseProduct(v.template segment<Dim>(Dim * node) - 2 * boundary_.incomingBefore) - dashpot.borne;
}

template <int Dim> bool Absorption<Dim>::addDiagonal(Eigen::VectorXd& drag) const
{
	for (const auto& [node, dashpot] : dashpots_)
		drag.template segment<Dim>(Dim * node) += dashpot.drag;
	return true;
}

template <int Dim> void Absorption<Dim>::addBorne(Eigen::VectorXd& force) const
{
	for (const auto& [node, dashpot] : dashpots_)
		force.template segment<Dim>(Dim * node) -= dashpot.borne;
}

template <int Dim> double Absorption<Dim>::fromOutside(const Eigen::VectorXd& v) const
{
	Eigen::VectorXd force = Eigen::VectorXd::Zero(v.size());
	add(v, 0, { force });
	return force.norm();
}

template <int Dim> void Absorption<Dim>::commit(const Eigen::VectorXd& d, const Eigen::VectorXd& before, const Eigen::VectorXd& now)
{
	boundary_.hasBegun    = true;
	boundary_.work        = -this->workTaken(d, before, now);
	Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
	add(now, 0, { force });
	boundary_.force.setZero();
	for (const auto& [node, dashpot] : dashpots_)
		boundary_.force -= force.template segment<Dim>(Dim * node);
}

template class Absorption<2>;
template class Absorption<3>;
template WaveModuli waveModuli(const std::vector<Material>&, const PointCloud<2>&, int);
template WaveModuli waveModuli(const std::vector<Material>&, const PointCloud<3>&, int);

} // namespace gimpm
