// SPDX-License-Identifier: GPL-2.0-or-later
// Places on the surfaces of bodies, and the pieces before them, as a step begins.
#include "core/base/sentence.hpp"
#include "core/terms/bodies/body_contact.hpp"
#include "core/terms/cell_moduli.hpp"
#include "core/terms/contact/pieces_by_cell.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace gimpm {
namespace {

/// As a step begins, where the foot is found anew, it may be this much deeper.
constexpr double deepestAtStart = 1.2 * deepestInBodies;

/// From this part of places on that slip as a step begins derivatives are exact, and so not symmetric, from its first
/// iteration on.
constexpr double manySlip = 0.25;

/// Of places on a piece: weights of its vertices, and the part of the size that each stands for.
template <int Dim> struct Quadrature {
	static constexpr int                     count = Dim;
	std::array<std::array<double, Dim>, Dim> weight;
	static constexpr double                  part = 1. / Dim;
	/// Gauss in the plane, exact for cubic functions; in space for squares.
	Quadrature()
	{
		const double near = Dim == 2 ? (1 + 1 / std::sqrt(3.)) / 2 : 2. / 3, far = (1 - near) / (Dim - 1);
		for (int q = 0; q < Dim; ++q)
			for (int i = 0; i < Dim; ++i)
				weight[q][i] = q == i ? near : far;
	}
};

/// The number of the leaf that a place is attached to.
template <int Dim> int leafAt(const Attachment<Dim>& at, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer)
{
	return find(basis.populatedLeaves(), Grid<Dim>::key(grid.first(at.cell * (1 << at.level)), at.level, layer));
}

} // namespace

template <int Dim>
BodyContact<Dim>::BodyContact(BodyContacts<Dim>& system, const StepContext<Dim>& step)
        : system_(system)
        , cellSize_(step.grid.cellSize)
        , tolerance_(1e-9 * cellSize_)
        , reach_(reachOfBodies * cellSize_)
        , isRing_(step.grid.axisymmetric)
        , unknowns_(Dim * Eigen::Index(step.basis.nodes.size()))
{
	system.acting = this;
	isExact_ = isRough() && std::any_of(system.meetings.begin(), system.meetings.end(), [](const auto& m) { return m.slipping > manySlip * m.touching; });
	for (const auto& body : system.bodies) {
		facets_.emplace_back(body.surface, step.basis, step.grid, body.layer);
		start_.push_back(facets_.back().start);
	}
	for (int m = 0; m < int(system.meetings.size()); ++m)
		addPlaces(m, step);
	takeModuli(step);
	for (Place& place : places_)
		findFirst(place);
	for (auto first = places_.begin(), last = first; first != places_.end(); first = last) {
		last = std::find_if(
		        first, places_.end(), [&](const Place& place) { return place.meeting != first->meeting || wholeOf(place) != wholeOf(*first); });
		keepApart(&*first, &*first + (last - first));
	}
	for (Place& place : places_)
		begin(place);
}

template <int Dim> void BodyContact<Dim>::addPlaces(int number, const StepContext<Dim>& step)
{
	const auto&   meeting = system_.meetings[number];
	const auto&   slave   = facets_[meeting.slave];
	Attacher<Dim> ofSlave(step.basis, step.grid, system_.bodies[meeting.slave].layer),
	        ofMaster(step.basis, step.grid, system_.bodies[meeting.master].layer);
	const PiecesByCell<Dim> byCell(facets_[meeting.master], step.grid, reach_);
	const Quadrature<Dim>   rule;
	for (int i = 0; i < int(slave.pieces.size()); ++i) {
		if (!slave.isThere(slave.pieces[i])) continue;
		const Vec<Dim> normal = system_.bodies[meeting.slave].surface.normal(slave.pieces[i], slave.start);
		for (const auto& weight : rule.weight) {
			Vec<Dim> x = Vec<Dim>::Zero();
			for (int v = 0; v < Dim; ++v)
				x += weight[v] * slave.start[slave.pieces[i][v]];
			const auto& near = byCell.near(x);
			if (near.empty() || (isRing_ && x[0] <= 0)) continue;
			const auto at = ofSlave(x);
			if (!at) continue;
			const double area = rule.part * normal.norm() * (isRing_ ? 2 * M_PI * x[0] : 1);
			Place        place { number, i, x, normal.normalized(), area, 0, 0, Vec<Dim>::Zero(), 0, *at };
			findNear(place, near, ofMaster);
			if (place.near.empty()) continue;
			if (!meeting.shear.empty())
				place.tangentialForce = area * meeting.shear[slave.whole[i]], place.normalForce = area * meeting.pressure[slave.whole[i]];
			places_.push_back(std::move(place));
		}
	}
}

template <int Dim> void BodyContact<Dim>::findNear(Place& place, const std::vector<int>& pieces, Attacher<Dim>& ofMaster) const
{
	const int   body   = meetingOf(place).master;
	const auto& facets = facets_[body];
	for (const int piece : pieces) {
		const auto x = pair(place.start, body, piece, start_);
		if (squaredDistance(x) > reach_ * reach_) continue;
		Near near { piece, Facing<Dim>(x).weight, {} };
		for (double& weight : near.weight)
			weight = std::max(0., weight);
		const double sum  = std::accumulate(near.weight.begin(), near.weight.end(), 0.);
		Vec<Dim>     foot = Vec<Dim>::Zero();
		for (int v = 0; v < Dim; ++v)
			near.weight[v] /= sum, foot += near.weight[v] * facets.start[facets.pieces[piece][v]];
		const auto at = ofMaster(foot);
		if (!at) continue;
		near.foot = *at;
		place.near.push_back(near);
	}
}

/// The smaller one of both, by the master's cell at the nearest piece.
template <int Dim> void BodyContact<Dim>::takeModuli(const StepContext<Dim>& step)
{
	std::vector<char>               isAskedFor(step.basis.populatedLeaves().size(), 0);
	std::vector<std::array<int, 2>> leaves;
	for (const Place& place : places_) {
		const auto& meeting = meetingOf(place);
		const Near* nearest = &place.near[0];
		double      least   = std::numeric_limits<double>::infinity();
		for (const Near& near : place.near)
			if (const double away = squaredDistance(pair(place.start, meeting.master, near.piece, start_)); away < least)
				least = away, nearest = &near;
		leaves.push_back({ leafAt(place.at, step.basis, step.grid, system_.bodies[meeting.slave].layer),
		                   leafAt(nearest->foot, step.basis, step.grid, system_.bodies[meeting.master].layer) });
		for (const int leaf : leaves.back())
			isAskedFor[leaf] = 1;
	}
	if (places_.empty()) return; // in all processes, which know the same places
	auto moduli = cellModuli(isAskedFor, step.basis, step.stiffnessOf, step.grid);
	step.division.complete(step.basis.populatedLeaves(), moduli);
	for (std::size_t i = 0; i < places_.size(); ++i)
		places_[i].young = std::min(moduli[leaves[i][0]], moduli[leaves[i][1]]);
}

/// The piece that the place begins with, and the gap to it.
template <int Dim> void BodyContact<Dim>::findFirst(Place& place)
{
	const auto& meeting = meetingOf(place);
	place.first         = nearestOf(place, nullptr, start_);
	if (!place.first) return;
	place.closed = Facing<Dim>(pair(place.start, meeting.master, place.first->piece, start_)).gap;
	if (place.closed > -deepestAtStart * cellSize_ || !obstacle_.empty()) return;
	obstacle_ = sentence(
	        "the surface of body '", system_.bodies[meeting.slave].name, "' is ", -place.closed, " m inside of body '", system_.bodies[meeting.master].name,
	        "', at (", place.start.transpose(), "): bodies must not overlap, and larger steps than they can bear get them into each other");
}

/// Of the places on one piece of a surface, which have its mean pressure, those that would not be pressed with it by
/// the gaps between them were not as the last step ended: the others have their forces. Else they would have to open
/// again in each step.
template <int Dim> void BodyContact<Dim>::keepApart(Place* begin, Place* end)
{
	double normalForce = 0, gap = 0, penalty = 0;
	for (Place* place = begin; place != end; ++place) {
		if (!place->first) return;
		normalForce += place->normalForce, gap += penaltyOf(*place) * place->closed, penalty += penaltyOf(*place);
	}
	const double opens   = (gap + normalForce) / penalty; // where the pressures that the gaps differ by are the whole of the mean one
	const auto   isOpen  = [&](const Place& place) { return place.closed > opens; };
	double       pressed = 0;
	for (const Place* place = begin; place != end; ++place)
		if (!isOpen(*place)) pressed += place->normalForce;
	if (pressed == 0 || pressed == normalForce) return;
	const double more = normalForce / pressed;
	for (Place* place = begin; place != end; ++place) {
		const double part = isOpen(*place) ? 0 : more;
		place->normalForce *= part, place->tangentialForce *= part;
	}
}

/// Gaps are found anew in each step, as surfaces are cut anew; the pressure is kept, and not the gap. So contact gives
/// back no more energy than it has stored. Bodies that are deep within each other are not as they should be.
template <int Dim> void BodyContact<Dim>::begin(Place& place)
{
	if (place.first) place.closed = place.normalForce > 0 ? place.closed + place.normalForce / penaltyOf(place) : std::min(0., place.closed);
}

template BodyContact<2>::BodyContact(BodyContacts<2>&, const StepContext<2>&);
template BodyContact<3>::BodyContact(BodyContacts<3>&, const StepContext<3>&);

} // namespace gimpm
