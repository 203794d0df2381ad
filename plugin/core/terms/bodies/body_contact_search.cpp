// SPDX-License-Identifier: GPL-2.0-or-later
// Positions on the surfaces of bodies, and the pieces before them, as a step begins.
#include "core/base/sentence.hpp"
#include "core/terms/bodies/body_contact.hpp"
#include "core/terms/bodies/pieces_by_cell.hpp"
#include "core/terms/cell_moduli.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

/// Penetration admitted as a step begins, where the closest-point projection is made anew.
constexpr double deepestAtStart = 1.2 * deepestInBodies;

/// From this part of contact points on that slip as a step begins derivatives are exact, and so not symmetric, from its
/// first iteration on.
constexpr double manySlip = 0.25;

/// Integration points on a piece: weights of its vertices, and the part of the size that each stands for.
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

} // namespace

template <int Dim>
BodyContact<Dim>::BodyContact(BodyContacts<Dim>& system, const StepContext<Dim>& step, const State& begins)
        : system_(system)
        , cellSize_(step.grid.cellSize)
        , tolerance_(contactTolerance(cellSize_))
        , reach_(reachOfBodies * cellSize_)
        , isRing_(step.grid.axisymmetric)
        , unknowns_(Dim * Eigen::Index(step.basis.nodes.size()))
{
	system.acting = this;
	isExact_ = isRough() && std::any_of(system.meetings.begin(), system.meetings.end(), [](const auto& m) { return m.slipping > manySlip * m.touching; });
	for (const auto& body : system.bodies) {
		facets_.emplace_back(body.surface, step.basis, step.grid, body.layer, body.layerOfPiece);
		start_.push_back(facets_.back().start);
	}
	for (int m = 0; m < int(system.meetings.size()); ++m)
		addContactPoints(m, step);
	makeLaws(step);
	for (ContactPoint& contactPoint : contactPoints_)
		findFirst(contactPoint);
	leaveOutDeepFolds();
	for (auto first = contactPoints_.begin(), last = first; first != contactPoints_.end(); first = last) {
		last = std::find_if(first, contactPoints_.end(), [&](const ContactPoint& contactPoint) {
			return contactPoint.meeting != first->meeting || wholeOf(contactPoint) != wholeOf(*first);
		});
		keepApart(&*first, &*first + (last - first));
	}
	if (step.water) takeWater(*step.water, !begins.map().isAlone());
	for (ContactPoint& contactPoint : contactPoints_)
		begin(contactPoint);
}

/// Water presses on both bodies where they touch or where it fills what is between them, and, unless its pressures stay
/// as they are, passes from one to the other there. The force of contact is that of the grains where water fills it.
template <int Dim> void BodyContact<Dim>::takeWater(const Eigen::VectorXd& pressures, bool flows)
{
	for (ContactPoint& point : contactPoints_) {
		const auto& meeting = meetingOf(point);
		if (!point.first) continue;
		const bool isFilled = isInFilledJoint(point);
		if (!(isFilled || point.normalForce > 0 || point.closed <= tolerance_)) continue;
		const double pressure = (point.at.value(pressures) + point.first->foot.value(pressures)) / 2, leakage = meeting.leakage;
		if (isFilled) addWedge(point, pressure);
		else
			point.law.water = point.area * pressure;
		if (flows && leakage > 0) passages_.push_back({ { point.at, point.first->foot }, system_.duration * point.area * leakage });
	}
}

/// True where water is between the contact point and the piece before it, which look at each other.
template <int Dim> bool BodyContact<Dim>::isInFilledJoint(const ContactPoint& point) const
{
	constexpr double oblique = -0.5; // cosine of the angle between their normals
	const auto&      meeting = meetingOf(point);
	return meeting.isFilled && point.normal.dot(Facing<Dim>(pair(point.start, meeting.master, point.first->piece, start_)).normal) < oblique;
}

/// Water presses along the normal of the contact point.
template <int Dim> void BodyContact<Dim>::addWedge(const ContactPoint& point, double pressure)
{
	Wedge wedge { &point, {} };
	wedge.force.force[0] = -pressure * point.area * point.normal;
	for (int v = 0; v < Dim; ++v)
		wedge.force.force[v + 1] = -point.first->weight[v] * wedge.force.force[0];
	wedges_.push_back(wedge);
}

template <int Dim> void BodyContact<Dim>::addContactPoints(int number, const StepContext<Dim>& step)
{
	const auto& meeting = system_.meetings[number];
	if (isFold(meeting) ? system_.bodies[meeting.slave].layerOfPiece.empty() : areFar(meeting, reach_)) return;
	const auto&   slave = facets_[meeting.slave];
	Attacher<Dim> ofSlave(step.basis, step.grid, system_.bodies[meeting.slave].layer),
	        ofMaster(step.basis, step.grid, system_.bodies[meeting.master].layer);
	const PiecesByCell<Dim> byCell(facets_[meeting.master], step.grid, reach_);
	const Quadrature<Dim>   rule;
	for (int i = 0; i < int(slave.pieces.size()); ++i) {
		if (!slave.isThere(slave.pieces[i]) || (isFold(meeting) && layerOf(meeting.slave, i) <= system_.bodies[meeting.slave].layer)) continue;
		ofSlave.goTo(layerOf(meeting.slave, i));
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
			ContactPoint contactPoint { number, i, x, normal.normalized(), area, {}, 0, Vec<Dim>::Zero(), 0, *at };
			findNear(contactPoint, near, ofMaster);
			if (contactPoint.near.empty()) continue;
			if (!meeting.shear.empty())
				contactPoint.tangentialForce = area * meeting.shear[slave.whole[i]],
				contactPoint.normalForce     = area * meeting.pressure[slave.whole[i]];
			contactPoints_.push_back(std::move(contactPoint));
		}
	}
}

/// The layer of the nodes of a facet.
template <int Dim> int BodyContact<Dim>::layerOf(int body, int piece) const
{
	const auto& layers = system_.bodies[body].layerOfPiece;
	return layers.empty() ? system_.bodies[body].layer : std::max(system_.bodies[body].layer, layers[facets_[body].whole[piece]]);
}

/// True unless both are of the same side of a fold, or the piece is far from folds.
template <int Dim> bool BodyContact<Dim>::mayTouch(const ContactPoint& contactPoint, int piece) const
{
	const auto& meeting = meetingOf(contactPoint);
	if (!isFold(meeting)) return true;
	const int layer = system_.bodies[meeting.master].layerOfPiece[facets_[meeting.master].whole[piece]];
	return layer >= 0 && layer < layerOf(meeting.slave, contactPoint.piece);
}

template <int Dim> void BodyContact<Dim>::findNear(ContactPoint& contactPoint, const std::vector<int>& pieces, Attacher<Dim>& ofMaster) const
{
	const int body = meetingOf(contactPoint).master;
	for (const int piece : pieces) {
		if (!mayTouch(contactPoint, piece)) continue;
		const auto x = pair(contactPoint.start, body, piece, start_);
		if (squaredDistance(x) > reach_ * reach_) continue;
		ofMaster.goTo(layerOf(body, piece));
		Near     near { piece, closestWeights(x), {} };
		Vec<Dim> foot = Vec<Dim>::Zero();
		for (int v = 0; v < Dim; ++v)
			foot += near.weight[v] * x[v + 1];
		const auto at = ofMaster(foot);
		if (!at) continue;
		near.foot = *at;
		contactPoint.near.push_back(near);
	}
}

/// Makes the law of each, with the smaller ratio of modulus and cell size of both, by the master's cell at the nearest
/// piece.
template <int Dim> void BodyContact<Dim>::makeLaws(const StepContext<Dim>& step)
{
	std::vector<char>               isAskedFor(step.basis.populatedLeaves().size(), 0);
	std::vector<std::array<int, 2>> leaves;
	for (const ContactPoint& contactPoint : contactPoints_) {
		const auto& meeting = meetingOf(contactPoint);
		const Near* nearest = &contactPoint.near[0];
		double      least   = std::numeric_limits<double>::infinity();
		for (const Near& near : contactPoint.near)
			if (const double away = squaredDistance(pair(contactPoint.start, meeting.master, near.piece, start_)); away < least)
				least = away, nearest = &near;
		const auto leafOf = [&](const Attachment<Dim>& at) { return find(step.basis.populatedLeaves(), at.leaf(step.grid)); };
		leaves.push_back({ leafOf(contactPoint.at), leafOf(nearest->foot) });
		for (const int leaf : leaves.back())
			isAskedFor[leaf] = 1;
	}
	if (contactPoints_.empty()) return; // in all processes, which know the same contact points
	auto moduli = cellModuli(isAskedFor, step.basis, step.stiffnessOf, step.grid);
	step.division.complete(step.basis.populatedLeaves(), moduli);
	for (std::size_t i = 0; i < contactPoints_.size(); ++i) {
		ContactPoint& point   = contactPoints_[i];
		const auto&   meeting = meetingOf(point);
		const auto    ratio   = [&](int leaf) { return moduli[leaf] / step.grid.size(Grid<Dim>::level(step.basis.populatedLeaves()[leaf])); };
		const double  penalty = meeting.stiffness * std::min(ratio(leaves[i][0]), ratio(leaves[i][1])) * point.area;
		point.law             = { penalty, penalty / slipSoftnessOfBodies, meeting.frictionCoefficient, meeting.adhesion * point.area };
	}
}

/// The piece that the contact point begins with, and the gap to it.
template <int Dim> void BodyContact<Dim>::findFirst(ContactPoint& contactPoint)
{
	const auto& meeting = meetingOf(contactPoint);
	contactPoint.first  = nearestOf(contactPoint, nullptr, start_);
	if (!contactPoint.first) return;
	contactPoint.closed = Facing<Dim>(pair(contactPoint.start, meeting.master, contactPoint.first->piece, start_)).gap;
	if (!isDeep(contactPoint) || isFold(meeting) || !obstacle_.empty()) return;
	obstacle_ = sentence(
	        "the surface of body '", system_.bodies[meeting.slave].name, "' is ", -contactPoint.closed, " m inside of body '",
	        system_.bodies[meeting.master].name, "', at (", contactPoint.start.transpose(),
	        "): bodies must not overlap, and larger steps than they can bear get them into each other");
}

template <int Dim> bool BodyContact<Dim>::isDeep(const ContactPoint& contactPoint) const
{
	return contactPoint.first && contactPoint.closed <= -deepestAtStart * cellSize_;
}

/// Films of soil that flows may fold: what is deeper than contact admits stays as it is.
template <int Dim> void BodyContact<Dim>::leaveOutDeepFolds()
{
	const auto isLeftOut = [&](const ContactPoint& contactPoint) { return isFold(meetingOf(contactPoint)) && isDeep(contactPoint); };
	contactPoints_.erase(std::remove_if(contactPoints_.begin(), contactPoints_.end(), isLeftOut), contactPoints_.end());
	for (ContactPoint& contactPoint : contactPoints_)
		if (isFold(meetingOf(contactPoint))) findFirst(contactPoint);
}

/// Keeps contact points of one piece apart, which have its mean pressure, if they were not pressed as the last step
/// ended because of their gaps: the others have their forces. Without this they would have to open again in each step.
template <int Dim> void BodyContact<Dim>::keepApart(ContactPoint* begin, ContactPoint* end)
{
	double normalForce = 0, gap = 0, penalty = 0;
	for (ContactPoint* contactPoint = begin; contactPoint != end; ++contactPoint) {
		if (!contactPoint->first) return;
		normalForce += contactPoint->normalForce, gap += contactPoint->law.normalStiffness * contactPoint->closed,
		        penalty += contactPoint->law.normalStiffness;
	}
	const double opens   = (gap + normalForce) / penalty; // gap at which the pressures that the gaps differ by are the whole of the mean one
	const auto   isOpen  = [&](const ContactPoint& contactPoint) { return contactPoint.closed > opens; };
	double       pressed = 0;
	for (const ContactPoint* contactPoint = begin; contactPoint != end; ++contactPoint)
		if (!isOpen(*contactPoint)) pressed += contactPoint->normalForce;
	if (pressed == 0 || pressed == normalForce) return;
	const double more = normalForce / pressed;
	for (ContactPoint* contactPoint = begin; contactPoint != end; ++contactPoint) {
		const double part = isOpen(*contactPoint) ? 0 : more;
		contactPoint->normalForce *= part, contactPoint->tangentialForce *= part;
	}
}

/// Gaps are found anew in each step, as surfaces are cut anew; the pressure is kept, and not the gap. So contact gives
/// back no more energy than it has stored. Bodies that are deep within each other are not as they should be.
template <int Dim> void BodyContact<Dim>::begin(ContactPoint& contactPoint)
{
	if (contactPoint.first)
		contactPoint.closed = contactPoint.normalForce > 0 ? contactPoint.closed + contactPoint.normalForce / contactPoint.law.normalStiffness
		                                                   : std::min(0., contactPoint.closed);
}

template BodyContact<2>::BodyContact(BodyContacts<2>&, const StepContext<2>&, const State&);
template BodyContact<3>::BodyContact(BodyContacts<3>&, const StepContext<3>&, const State&);

} // namespace gimpm
