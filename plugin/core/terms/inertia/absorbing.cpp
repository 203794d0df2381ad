// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/absorbing.hpp"
#include "core/grid/surface.hpp"
#include "core/terms/overlap.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace gimpm {
namespace {

/// Node n of a face of a cell, as if the grid were not periodic.
template <int Dim> Index<Dim> nodeOfFace(Index<Dim> cell, int axis, bool isUpper, int n)
{
	cell[axis] += isUpper;
	for (int a = 0, bit = 0; a < Dim; ++a)
		if (a != axis) cell[a] += n >> bit++ & 1;
	return cell;
}

template <int Dim> bool holdsFace(const ConstrainedBox<Dim>& box, const Index<Dim>& cell, int axis, bool isUpper)
{
	for (int n = 0; n < 1 << (Dim - 1); ++n)
		if (!box.contains(nodeOfFace<Dim>(cell, axis, isUpper, n))) return false;
	return true;
}

/// Material in a cell: its volume, and impedances rho c times that.
struct FilledCell {
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
	if (dashpots_.empty()) obstacle_ = boundary_.name + ": no face of a cell with material has all of its nodes in the box of that absorbing boundary";
	for (auto& [node, dashpot] : dashpots_)
		for (int a = 0; a < Dim; ++a)
			if (step.dofs.number[Dim * node + a] < 0) dashpot.drag[a] = dashpot.borne[a] = 0;
}

/// Those with material on one side. Cells that lie in the box as a whole are beyond.
template <int Dim> std::vector<typename Absorption<Dim>::Face> Absorption<Dim>::faces(const StepContext<Dim>& step)
{
	std::vector<Face> found;
	std::vector<int>  both; // cells with material beyond a face of the boundary
	for (int c = 0; c < int(step.basis.cells.size()); ++c) {
		const Index<Dim> cell = Grid<Dim>::index(step.basis.cells[c]);
		for (int side = 0; side < 2 * Dim; ++side) {
			const int  axis    = side / 2;
			const bool isUpper = side % 2;
			if (!holdsFace(boundary_.box, cell, axis, isUpper)) continue;
			const Index<Dim> beyond = step.grid.first(Index<Dim>(cell + (isUpper ? 1 : -1) * Index<Dim>::Unit(axis)));
			if (const int other = find(step.basis.cells, Grid<Dim>::key(beyond)); other >= 0)
				both.push_back(holdsFace(boundary_.box, cell, axis, !isUpper) ? c : other);
			if (holdsFace(boundary_.box, cell, axis, !isUpper)) continue;
			Face face { c, axis, {} };
			for (int n = 0; n < 1 << (Dim - 1); ++n)
				face.node[n] = position(step.basis.nodes, Grid<Dim>::key(step.grid.first(nodeOfFace<Dim>(cell, axis, isUpper, n))));
			found.push_back(face);
		}
	}
	if (!both.empty()) obstacle_ = textOfBothSides(both, step);
	return found;
}

/// Refuses material on both sides: names where most of it is, and how much there is, of the points that this process
/// has.
template <int Dim> std::string Absorption<Dim>::textOfBothSides(const std::vector<int>& beyond, const StepContext<Dim>& step) const
{
	std::vector<char>   isAskedFor(step.basis.cells.size(), 0);
	std::vector<double> filled(step.basis.cells.size(), 0);
	for (const int cell : beyond)
		isAskedFor[cell] = 1;
	const double h      = step.grid.cellSize;
	const auto centreOf = [&](int cell) { return Vec<Dim>(step.grid.nodePosition(Grid<Dim>::index(step.basis.cells[cell])) + Vec<Dim>::Constant(h / 2)); };
	forOverlaps(isAskedFor, step.basis, step.grid, [&](int cell, int p, auto within) {
		filled[cell] += within(step.stiffnessOf(p).volume) / (std::pow(h, Dim) * aroundAxis(centreOf(cell)[0], step.grid));
	});
	const int          most = int(std::max_element(filled.begin(), filled.end()) - filled.begin());
	std::ostringstream text;
	text << boundary_.name << " has material on both sides: behind it are " << std::accumulate(filled.begin(), filled.end(), 0.)
	     << " cells full, most of it in the cell around (" << centreOf(most).transpose() << "), of which it fills " << filled[most]
	     << "; it has to be at the edge of the body, and what moves there has to stay in front of it";
	return text.str();
}

/// A face is covered to the part to which its cell is filled.
template <int Dim>
void Absorption<Dim>::addDrag(
        const std::vector<Face>& faces, const std::vector<Material>& materials, const std::vector<double>& masses, const StepContext<Dim>& step)
{
	std::vector<char> isAskedFor(step.basis.cells.size(), 0);
	for (const Face& face : faces)
		isAskedFor[face.cell] = 1;
	std::vector<FilledCell> cells(step.basis.cells.size());
	forOverlaps(isAskedFor, step.basis, step.grid, [&](int cell, int p, auto within) {
		const double     volume = step.stiffnessOf(p).volume, density = masses[p] / volume, overlap = within(volume);
		const WaveModuli moduli = waveModuli(materials, step.cloud, p);
		cells[cell].volume += overlap;
		cells[cell].pressure += overlap * std::sqrt(density * moduli.pressure);
		cells[cell].shear += overlap * std::sqrt(density * moduli.shear);
	});
	const double h = step.grid.cellSize;
	for (const Face& face : faces) {
		const FilledCell& cell   = cells[face.cell];
		const double      inside = step.grid.origin[0] + h * (Grid<Dim>::index(step.basis.cells[face.cell])[0] + 0.5);
		const double      filled = std::min(cell.volume / (std::pow(h, Dim) * aroundAxis(inside, step.grid)), 1.);
		for (const int node : face.node) {
			// the integral of the node's shape function over the face, in axisymmetry over a part of a ring
			const double at        = step.grid.origin[0] + h * Grid<Dim>::index(step.basis.nodes[node])[0];
			const double radius    = face.axis == 0 ? at : (at + 2 * inside) / 3;
			const double area      = filled * std::pow(h, Dim - 1) * aroundAxis(radius, step.grid) / (1 << (Dim - 1));
			Vec<Dim>     impedance = Vec<Dim>::Constant(cell.shear / cell.volume);
			impedance[face.axis]   = cell.pressure / cell.volume;
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
	for (auto& [node, dashpot] : dashpots_)
		dashpot.drag = drag.template segment<Dim>(Dim * node);
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
