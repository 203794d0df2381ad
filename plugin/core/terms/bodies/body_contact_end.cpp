// SPDX-License-Identifier: GPL-2.0-or-later
// State of bodies that meet as a step ends.
#include "core/base/sentence.hpp"
#include "core/terms/bodies/body_contact.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace gimpm {
namespace {

/// Largest spurious energy gain of contact in a step, over all energy that has come in.
constexpr double mostGiven = 1e-3;

} // namespace

/// Work of contact forces on the contact points as the nodes move them.
template <int Dim> double BodyContact<Dim>::work(const Eigen::VectorXd& d) const
{
	double sum = 0;
	for (const Touching& touching : contactAt(d).touching) {
		const auto start = pair(touching.contactPoint.start, meetingOf(touching.contactPoint).master, touching.near.piece, start_);
		for (int i = 0; i <= Dim; ++i)
			sum += touching.force.force[i].dot(touching.now[i] - start[i]);
	}
	return sum;
}

/// Work beyond what the springs had stored. As their energy is convex in the gap, it is not above zero where a contact
/// point stays before one plane that does not turn.
template <int Dim> double BodyContact<Dim>::energyGain(const Eigen::VectorXd& d) const
{
	double sum = work(d);
	for (const ContactPoint& contactPoint : contactPoints_)
		if (contactPoint.first) sum -= contactPoint.law.stored(contactPoint.normalForce, contactPoint.tangentialForce.norm());
	for (const Touching& now : contactAt(d).touching)
		sum += now.contactPoint.law.stored(now.force.normalForce, now.force.tangentialForce.norm());
	return sum;
}

template <int Dim> Refusal BodyContact<Dim>::refusalOfEnergy(const Eigen::VectorXd& d) const
{
	if (system_.kind != StepKind::dynamic) return {};
	const double found = energyGain(d);
	if (found <= mostGiven * (system_.energy + std::abs(work(d)))) return {}; // nothing has come in as the first step begins
	return { Failure::gainsEnergy,
		 sentence("contact of bodies of points would give ", found, " J that it had not stored, of ", system_.energy, " J that have come in"),
		 "Smaller steps (O.dt) make it less." };
}

/// Distance by which vertices of the two may have moved towards each other.
template <int Dim> double BodyContact<Dim>::approach(const BodyMeeting<Dim>& meeting, const Positions& now) const
{
	Vec<Dim>   mean     = Vec<Dim>::Zero();
	int        count    = 0;
	double     sum      = 0;
	const auto vertices = verticesOf(meeting);
	const int  bodies[] = { meeting.slave, meeting.master };
	for (int side = 0; side < 2; ++side)
		for (const int v : vertices[side])
			mean += now[bodies[side]][v] - start_[bodies[side]][v], ++count;
	mean /= std::max(1, count);
	for (int side = 0; side < 2; ++side) {
		double most = 0;
		for (const int v : vertices[side])
			most = std::max(most, (now[bodies[side]][v] - start_[bodies[side]][v] - mean).norm());
		sum += most;
	}
	return sum;
}

/// Numbers of the vertices of the slave and of the master: all, or for each those of pieces that face others.
template <int Dim> std::vector<std::vector<int>> BodyContact<Dim>::verticesOf(const BodyMeeting<Dim>& meeting) const
{
	std::vector<std::vector<int>> vertices(2);
	if (!isFold(meeting)) {
		for (const int side : { 0, 1 })
			vertices[side].resize(start_[side == 0 ? meeting.slave : meeting.master].size());
		for (auto& numbers : vertices)
			std::iota(numbers.begin(), numbers.end(), 0);
		return vertices;
	}
	const auto& body = system_.bodies[meeting.slave];
	for (std::size_t i = 0; i < facets_[meeting.slave].pieces.size() && !body.layerOfPiece.empty(); ++i) {
		const int layer = body.layerOfPiece[facets_[meeting.slave].whole[i]];
		for (const int v : facets_[meeting.slave].pieces[i])
			if (layer >= 0)
				for (auto& numbers : vertices)
					numbers.push_back(v);
	}
	return vertices;
}

/// True if the boxes around the surfaces of two bodies are farther apart than a reach as the step begins.
template <int Dim> bool BodyContact<Dim>::areFar(const BodyMeeting<Dim>& meeting, double reach) const
{
	const auto &slave = start_[meeting.slave], &master = start_[meeting.master];
	if (slave.empty() || master.empty()) return true;
	const auto low = [](const std::vector<Vec<Dim>>& x) {
		return std::accumulate(x.begin(), x.end(), x[0], [](const Vec<Dim>& a, const Vec<Dim>& b) { return Vec<Dim>(a.cwiseMin(b)); });
	};
	const auto high = [](const std::vector<Vec<Dim>>& x) {
		return std::accumulate(x.begin(), x.end(), x[0], [](const Vec<Dim>& a, const Vec<Dim>& b) { return Vec<Dim>(a.cwiseMax(b)); });
	};
	return std::max((low(slave) - high(master)).maxCoeff(), (low(master) - high(slave)).maxCoeff()) > reach;
}

template <int Dim> Refusal BodyContact<Dim>::refusal(const Eigen::VectorXd& d)
{
	const ContactState& state  = contactAt(d);
	const char*         advice = "Smaller load steps (O.dt), or a larger stiffness of MpmBodyContact, may help.";
	for (const auto& meeting : system_.meetings)
		if (const double moved = approach(meeting, state.now); moved > reach_ && !(meeting.isOfOne && !isFold(meeting) && areFar(meeting, moved)))
			return { Failure::penetrated,
				 sentence(
				         "bodies '", system_.bodies[meeting.slave].name, "' and '", system_.bodies[meeting.master].name, "' move by ", moved,
				         " m against each other in the step, farther than half a cell, within which they are state for"),
				 advice };
	for (const Touching& touching : state.touching) {
		const double gap = Facing<Dim>(touching.now).gap;
		if (gap > -deepestInBodies * cellSize_) continue;
		const auto& meeting = meetingOf(touching.contactPoint);
		return { Failure::penetrated,
			 sentence(
			         "body '", system_.bodies[meeting.slave].name, "' would get ", -gap, " m into body '", system_.bodies[meeting.master].name,
			         "', at (", touching.now[0].transpose(), ")"),
			 advice };
	}
	return refusalOfEnergy(d);
}

/// Stresses of a piece are the means over its contact points.
template <int Dim> void BodyContact<Dim>::commit(const Eigen::VectorXd& d)
{
	const ContactState&              state = contactAt(d);
	std::vector<std::vector<double>> area;
	for (auto& meeting : system_.meetings) {
		const std::size_t pieces = system_.bodies[meeting.slave].surface.pieces.size();
		meeting.shear.assign(pieces, Vec<Dim>::Zero()), meeting.pressure.assign(pieces, 0);
		meeting.force.setZero(), meeting.moment.setZero(), meeting.touching = meeting.slipping = 0;
		area.emplace_back(pieces, 0.);
	}
	for (const ContactPoint& contactPoint : contactPoints_)
		area[contactPoint.meeting][facets_[meetingOf(contactPoint).slave].whole[contactPoint.piece]] += contactPoint.area;
	system_.work       = work(d);
	system_.energyGain = system_.kind == StepKind::dynamic ? energyGain(d) : 0;
	for (const auto& [contactPoint, near, force, at] : state.touching) {
		auto&     meeting = system_.meetings[contactPoint.meeting];
		const int whole   = facets_[meeting.slave].whole[contactPoint.piece];
		meeting.shear[whole] += force.tangentialForce / area[contactPoint.meeting][whole];
		meeting.pressure[whole] += force.normalForce / area[contactPoint.meeting][whole];
		meeting.force += force.force[0];
		Vec3 arm = Vec3::Zero(), f = Vec3::Zero();
		arm.template head<Dim>() = at[0], f.template head<Dim>() = force.force[0];
		meeting.moment += arm.cross(f);
		meeting.touching += 1, meeting.slipping += force.slips;
	}
	moveSurfaces(state.now);
}

/// Parts of a piece that is divided have its stresses.
template <int Dim> void BodyContact<Dim>::moveSurfaces(const Positions& now)
{
	for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
		auto& surface = system_.bodies[b].surface;
		surface.vertices.assign(now[b].begin(), now[b].begin() + surface.vertices.size());
		const auto wholes = system_.bodies[b].refine(cellSize_);
		for (auto& meeting : system_.meetings) {
			if (meeting.slave != int(b)) continue;
			const auto shear    = meeting.shear;
			const auto pressure = meeting.pressure;
			meeting.shear.clear(), meeting.pressure.clear();
			for (const int whole : wholes)
				meeting.shear.push_back(shear[whole]), meeting.pressure.push_back(pressure[whole]);
		}
	}
}

template Refusal BodyContact<2>::refusal(const Eigen::VectorXd&);
template Refusal BodyContact<3>::refusal(const Eigen::VectorXd&);
template bool    BodyContact<2>::areFar(const BodyMeeting<2>&, double) const;
template bool    BodyContact<3>::areFar(const BodyMeeting<3>&, double) const;
template void    BodyContact<2>::commit(const Eigen::VectorXd&);
template void    BodyContact<3>::commit(const Eigen::VectorXd&);

} // namespace gimpm
