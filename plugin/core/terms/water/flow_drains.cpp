// SPDX-License-Identifier: GPL-2.0-or-later
// Drains: surfaces where water leaves a body; and cuts in it that water passes.
#include "core/terms/attach_surface.hpp"
#include "core/terms/water/flow.hpp"
#include <algorithm>
#include <numeric>

namespace gimpm {
namespace {

/// A position of a drain, the area that it stands for, a vector along the normal, and the middle of its piece.
template <int Dim> struct DrainPoint {
	Vec<Dim> at;
	double   area;
	Vec<Dim> normal, middle;
};

/// Quadrature of segments: exact for products of two functions of the grid, wherever they cut the cells.
std::vector<DrainPoint<2>> quadratureOf(const Surface<2>& surface, const Grid<2>& grid)
{
	constexpr double           gauss[3][2] = { { -0.7745966692414834, 5. / 18 }, { 0, 8. / 18 }, { 0.7745966692414834, 5. / 18 } };
	std::vector<DrainPoint<2>> positions;
	for (const auto& piece : surface.pieces) {
		const Vec<2>& from  = surface.vertices[piece[0]];
		const Vec<2>  way   = surface.vertices[piece[1]] - from;
		auto          parts = linesCrossed(from, from + way, grid);
		parts.insert(parts.begin(), 0), parts.push_back(1);
		for (std::size_t i = 0; i + 1 < parts.size(); ++i)
			for (const auto& [position, weight] : gauss) {
				const double part = parts[i] + (parts[i + 1] - parts[i]) * (1 + position) / 2;
				const Vec<2> x    = from + part * way;
				positions.push_back(
				        { x, weight * (parts[i + 1] - parts[i]) * way.norm() * aroundAxis(x[0], grid), { way[1], -way[0] }, from + way / 2 });
			}
	}
	return positions;
}

/// Quadrature of triangles, no larger than a quarter of a cell: their corners, each once.
std::vector<DrainPoint<3>> quadratureOf(const Surface<3>& surface, const Grid<3>&)
{
	std::vector<DrainPoint<3>> positions;
	for (const Vec<3>& corner : surface.vertices)
		positions.push_back({ corner, 0, Vec<3>::Zero(), corner });
	for (const auto& piece : surface.pieces)
		for (const int v : piece) {
			const Vec<3> normal = surface.normal(piece, surface.vertices);
			positions[v].area += normal.norm() / 3, positions[v].normal += normal;
		}
	return positions;
}

/// Volume that is filled around each node; of tied ones the mean of their masters'.
template <int Dim> Eigen::VectorXd filledVolumes(const CloudBasis<Dim>& basis, const std::vector<PorePoint>& points, const OwnedNodes& nodes)
{
	Eigen::VectorXd volume = Eigen::VectorXd::Zero(Eigen::Index(basis.nodes.size()));
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const PointFunctions<Dim> f(basis, i, patch);
			for (int n = 0; n < f.count; ++n)
				if (patch.node[n] >= 0) volume[patch.node[n]] += f.value[n] * points[basis.order[i]].volume;
		}
	nodes.complete(volume);
	basis.affineConstraints.template condense<1>(volume);
	basis.affineConstraints.template distribute<1>(volume);
	return volume;
}

/// Weights by which rain feels the pressure: those of nodes around which there is less than an eighth of a cell, beyond
/// a surface that cuts off less than half of one, in proportion to that. Through a sliver of dry soil such a node
/// drives water by a pressure that is not that of the ground, which would be taken for full; so does one that is gone
/// on from dry nodes to a surface a little outside.
template <int Dim> std::array<double, 1 << Dim> weightsByVolume(const Attachment<Dim>& at, const Eigen::VectorXd& volume, double cell)
{
	constexpr double least   = 0.125;
	auto             weights = at.weight;
	double           sum     = 0;
	for (int n = 0; n < at.nodes; ++n)
		sum += weights[n] = std::max(0., weights[n]) * std::min(1., volume[at.node[n]] / (least * cell));
	for (double& weight : weights)
		weight /= sum;
	return weights;
}

} // namespace

template <int Dim> void Flow<Dim>::attachDrains(const StepContext<Dim>& step)
{
	const auto isRain = [](const Drain<Dim>& drain) { return drain.kind == Drain<Dim>::Kind::rain; };
	if (std::any_of(water_.drains.begin(), water_.drains.end(), isRain)) filled_ = filledVolumes(basis_, points_, step.ownedNodes);
	for (int number = 0; number < int(water_.drains.size()) && obstacle_.empty(); ++number)
		obstacle_ = attachDrain(number, step);
}

/// Water passes as through a thin skin: nodes of cut cells are not held at the pressure outside, which would close
/// cells that are nearly empty.
template <int Dim> std::string Flow<Dim>::attachDrain(int number, const StepContext<Dim>& step)
{
	const Drain<Dim>& drain   = water_.drains[number];
	const auto&       surface = drain.surface;
	const auto        corners = attachVertices(surface, step, drain.name);
	if (!corners.obstacle.empty()) return corners.obstacle;
	vertices_.insert(vertices_.end(), corners.positions.begin(), corners.positions.end());
	const auto            positions = quadratureOf(surface, step.grid);
	std::vector<Vec<Dim>> all, beside;
	for (const auto& position : positions)
		all.push_back(position.at), beside.push_back(position.middle);
	const auto within = Dim == 3 ? corners : attachPositions(all, step, drain.name, layerOfPosition, beside);
	if (!within.obstacle.empty()) return within.obstacle;
	for (std::size_t i = 0; i < positions.size(); ++i) {
		const auto& [x, area, normal, middle] = positions[i];
		const auto&  at                       = within.positions[i];
		const double h                        = step.grid.size(at.level);
		const int    cell                     = gimpm::find(step.basis.populatedLeaves(), at.leaf(step.grid));
		const double kappa = cell < 0 ? 0 : conductivityAlong(cell, normal.normalized()), passes = water_.duration * area;
		const double conductance = passes * drain.conductance * kappa / h;
		if (drain.kind == Drain<Dim>::Kind::flux) outlets_.push_back({ number, at, 0, passes * drain.given });
		else if (drain.kind == Drain<Dim>::Kind::rain)
			outlets_.push_back({ number, at, conductance, drain.given < 0 ? drain.driest : 0, false, true, passes * drain.given });
		else if (drain.level)
			outlets_.push_back({ number, at, conductance, drain.level->pressureAt(x), drain.level->isInAir(x) });
		else
			outlets_.push_back({ number, at, conductance, drain.given, drain.kind == Drain<Dim>::Kind::seepage });
		const bool isRain    = outlets_.back().isRain;
		outlets_.back().felt = isRain ? weightsByVolume(at, filled_, std::pow(h, Dim) * aroundAxis(x[0], step.grid)) : at.weight;
	}
	return "";
}

template <int Dim> void Flow<Dim>::attachPassages(const StepContext<Dim>& step)
{
	if (!step.grid.parting) return;
	for (const LeakyCut<Dim>& cut : step.grid.parting->leaks()) {
		Surface<Dim> surface;
		surface.vertices.assign(cut.corners.begin(), cut.corners.end()), surface.vertices0 = surface.vertices;
		surface.pieces.emplace_back();
		std::iota(surface.pieces[0].begin(), surface.pieces[0].end(), 0);
		surface.refine(pieceLimit * step.grid.cellSize);
		for (const auto& [x, area, normal, middle] : quadratureOf(surface, step.grid)) {
			const int  others = step.grid.parting->layerAt(x) & ~cut.layer; // cuts nearby, on the same side of which both are
			const auto left = attach<Dim>(x, step.basis, step.grid, others), right = attach<Dim>(x, step.basis, step.grid, others | cut.layer);
			if (!left || !right || left->node == right->node) continue;
			const int    cell    = gimpm::find(step.basis.populatedLeaves(), left->leaf(step.grid));
			const double leakage = cut.leakage == LeakyCut<Dim>::asSoil
			        ? conductanceOfSoil * conductivityAlong(cell, normal.normalized()) / step.grid.size(left->level)
			        : cut.leakage;
			passages_.push_back({ { *left, *right }, water_.duration * area * leakage });
		}
	}
}

/// A pressure that is the same everywhere moves nothing where all sides are held: it is unknown unless there is a way
/// out.
template <int Dim> std::string Flow<Dim>::enclosure(const StepContext<Dim>& step) const
{
	const bool hasWayOut = std::any_of(outlets_.begin(), outlets_.end(), [](const Outlet& o) { return o.conductance > 0; });
	const bool isFull
	        = step.division.sum(std::count_if(points_.begin(), points_.end(), [](const PorePoint& point) { return point.pores->retention; })) == 0;
	if (hasWayOut || std::isfinite(water_.modulus) || !isFull) return "";
	Eigen::VectorXd push = Eigen::VectorXd::Zero(Dim * Eigen::Index(basis_.nodes.size())), size = push;
	for (const auto& patch : basis_.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const PointFunctions<Dim> f(basis_, i, patch);
			for (int n = 0; n < f.count; ++n)
				for (int a = 0; a < Dim && patch.node[n] >= 0; ++a) {
					const double b = points_[basis_.order[i]].volume * (f.gradient[n][a] + (a == 0 ? f.hoop[n] : 0));
					push[Dim * patch.node[n] + a] += b, size[Dim * patch.node[n] + a] += std::abs(b);
				}
		}
	for (auto* of : { &push, &size }) {
		basis_.affineConstraints.template condense<Dim>(*of);
		step.ownedNodes.complete(*of);
	}
	for (Eigen::Index i = 0; i < push.size(); ++i)
		if (step.dofs.number[i] >= 0 && std::abs(push[i]) > 1e-9 * size[i]) return "";
	return "water that keeps its volume fills soil all sides of which are held, and there is no drain through which it could leave";
}

/// Derivative of the outflow. It is zero of a seepage face where the pressure would draw water in, and of a surface
/// that takes in all of the rain, or loses all that can evaporate.
template <int Dim> double Flow<Dim>::conductanceNow(const Outlet& outlet, double pressure) const
{
	if (outlet.isRain) {
		const double passes     = outlet.conductance * (pressure - outlet.given);
		const bool   evaporates = outlet.rain < 0, isLimited = evaporates ? 0 < passes && passes < -outlet.rain : passes > -outlet.rain;
		const bool   alsoSeepage = evaporates && pressure > 0;
		return outlet.conductance * (int(isLimited) + int(alsoSeepage));
	}
	return outlet.isOneWay && pressure <= outlet.given ? 0 : outlet.conductance;
}

/// Volume that leaves in the step [m3]. Rain enters as long as the surface has suction; then no more than keeps the
/// pressure there, so that what is left runs off. Water evaporates as long as the surface is not at its least pressure.
template <int Dim> double Flow<Dim>::outflow(const Outlet& o, double pressure) const
{
	if (water_.drains[o.drain].kind == Drain<Dim>::Kind::flux) return o.given;
	const double passes = o.conductance * (pressure - o.given);
	if (o.isRain && o.rain >= 0) return std::max(-o.rain, passes);
	if (o.isRain) return std::clamp(passes, 0., -o.rain) + o.conductance * std::max(pressure, 0.);
	return conductanceNow(o, pressure) * (pressure - o.given);
}

template <int Dim> void Flow<Dim>::addDrains(const Eigen::VectorXd& P, const FieldSum<Dim>& sum) const
{
	for (const Outlet& o : outlets_) {
		const bool   isFlux   = water_.drains[o.drain].kind == Drain<Dim>::Kind::flux;
		const double pressure = o.pressure(P), conductance = conductanceNow(o, pressure);
		const double out  = o.isRain || isFlux ? outflow(o, pressure) : conductance * (pressure - o.given),
		             size = isFlux ? std::abs(o.given) : conductance * (std::abs(pressure) + std::abs(o.given));
		for (int m = 0; m < o.at.nodes; ++m) {
			sum.force[field][o.at.node[m]] += o.at.weight[m] * out;
			sum.absoluteContributions[field][o.at.node[m]] += std::abs(o.at.weight[m]) * size;
			for (int n = 0; n < o.at.nodes && sum.couplings; ++n)
				sum.couplings->add({ field, o.at.node[m] }, { field, o.at.node[n] }, conductance * o.at.weight[m] * o.felt[n]);
		}
	}
}

template <int Dim> void Flow<Dim>::moveDrains(const Eigen::VectorXd& d, const Eigen::VectorXd& P)
{
	auto at = vertices_.begin();
	for (auto& drain : water_.drains) {
		drain.out = 0;
		for (auto& vertex : drain.surface.vertices)
			vertex += (at++)->displacement(d);
	}
	for (const Outlet& o : outlets_) {
		Drain<Dim>& drain = water_.drains[o.drain];
		drain.out += outflow(o, o.pressure(P));
	}
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template void        Flow<Dim>::attachDrains(const StepContext<Dim>&);                                                                                 \
	template std::string Flow<Dim>::enclosure(const StepContext<Dim>&) const;                                                                              \
	template double      Flow<Dim>::outflow(const Outlet&, double) const;                                                                                  \
	template void        Flow<Dim>::attachPassages(const StepContext<Dim>&);                                                                               \
	template void        Flow<Dim>::addDrains(const Eigen::VectorXd&, const FieldSum<Dim>&) const;                                                         \
	template void        Flow<Dim>::moveDrains(const Eigen::VectorXd&, const Eigen::VectorXd&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
