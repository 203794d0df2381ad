// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/body_contact.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/cell_moduli.hpp"
#include "core/terms/pieces_by_cell.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace gimpm {
namespace {

/// The penalty on the gap over that on the slip. What sticks then slides as if a layer of some tenths of a cell lay
/// between the bodies.
constexpr double slipSoftnessOfBodies = 4;

/// What a place may get behind the surface of another body, over the size of a cell.
constexpr double deepestInBodies = 0.25;

/// As a step begins, where the foot is found anew, it may be this much deeper.
constexpr double deepestAtStart = 1.2 * deepestInBodies;

/// Pieces are seen by places with a normal at more than some 80 degrees from theirs.
constexpr double facing = 0.2;

/// How far a place may get beyond a side of the piece that it began the step with, over the size of a cell.
constexpr double beyondPiece = 0.125;

/// How far pieces are looked for, over the size of a cell.
constexpr double reachOfBodies = 0.5;

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

template <int Dim> double squaredDistance(const Vec<Dim>& x, const Vec<Dim>& a, const Vec<Dim>& b)
{
	const Vec<Dim> side = b - a;
	const double   s    = std::clamp(side.dot(x - a) / side.squaredNorm(), 0., 1.);
	return (x - a - s * side).squaredNorm();
}

/// From the piece, which has an end.
double squaredDistance(const PairPlaces<2>& x) { return squaredDistance<2>(x[0], x[1], x[2]); }
double squaredDistance(const PairPlaces<3>& x)
{
	const Facing<3> at(x);
	if (*std::min_element(at.weight.begin(), at.weight.end()) >= 0) return at.gap * at.gap;
	return std::min({ squaredDistance<3>(x[0], x[1], x[2]), squaredDistance<3>(x[0], x[2], x[3]), squaredDistance<3>(x[0], x[3], x[1]) });
}

/// The number of the leaf that a place is attached to.
template <int Dim> int leafAt(const Attachment<Dim>& at, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer)
{
	return find(basis.populatedLeaves(), Grid<Dim>::key(grid.first(at.cell * (1 << at.level)), at.level, layer));
}

} // namespace

template <int Dim>
BodyContact<Dim>::BodyContact(BodyContacts<Dim>& system, const Beginning<Dim>& step)
        : system_(system)
        , cellSize_(step.grid.cellSize)
        , tolerance_(1e-9 * cellSize_)
        , reach_(reachOfBodies * cellSize_)
        , isRing_(step.grid.axisymmetric)
        , unknowns_(Dim * Eigen::Index(step.basis.nodes.size()))
{
	system.acting = this;
	for (const auto& body : system.bodies) {
		facets_.emplace_back(body.surface, step.basis, step.grid, body.layer);
		start_.push_back(facets_.back().start);
	}
	for (int m = 0; m < int(system.meetings.size()); ++m)
		addPlaces(m, step);
	takeModuli(step);
	for (Place& place : places_)
		begin(place);
}

template <int Dim> void BodyContact<Dim>::addPlaces(int number, const Beginning<Dim>& step)
{
	const auto&             meeting = system_.meetings[number];
	const auto&             slave   = facets_[meeting.slave];
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
			const auto at = attachNear(x, step.basis, step.grid, system_.bodies[meeting.slave].layer);
			if (!at) continue;
			const double area = rule.part * normal.norm() * (isRing_ ? 2 * M_PI * x[0] : 1);
			Place        place { number, i, x, normal.normalized(), area, 0, 0, Vec<Dim>::Zero(), 0, *at };
			findNear(place, near, step);
			if (place.near.empty()) continue;
			if (!meeting.shear.empty())
				place.shear = area * meeting.shear[slave.whole[i]], place.pressure = area * meeting.pressure[slave.whole[i]];
			places_.push_back(std::move(place));
		}
	}
}

template <int Dim> void BodyContact<Dim>::findNear(Place& place, const std::vector<int>& pieces, const Beginning<Dim>& step) const
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
		const auto at = attachNear(foot, step.basis, step.grid, system_.bodies[body].layer);
		if (!at) continue;
		near.foot = *at;
		place.near.push_back(near);
	}
}

/// The smaller one of both, by the master's cell at the nearest piece.
template <int Dim> void BodyContact<Dim>::takeModuli(const Beginning<Dim>& step)
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
	if (places_.empty()) return;
	const auto moduli = cellModuli(isAskedFor, step.basis, step.stiffnessOf, step.grid);
	for (std::size_t i = 0; i < places_.size(); ++i)
		places_[i].young = std::min(moduli[leaves[i][0]], moduli[leaves[i][1]]);
}

/// Gaps are found anew in each step, as surfaces are cut anew; the pressure is kept, and not the gap. So contact gives
/// back no more energy than it has stored. Bodies that are deep within each other are not as they should be.
template <int Dim> void BodyContact<Dim>::begin(Place& place)
{
	const auto& meeting = meetingOf(place);
	const Near* near    = nearestOf(place, nullptr, start_);
	if (!near) return;
	place.first      = near;
	const double gap = Facing<Dim>(pair(place.start, meeting.master, near->piece, start_)).gap;
	place.closed     = place.pressure > 0 ? gap + place.pressure / penaltyOf(place) : std::min(0., gap);
	if (gap > -deepestAtStart * cellSize_ || !obstacle_.empty()) return;
	obstacle_ = sentence(
	        "the surface of body '", system_.bodies[meeting.slave].name, "' is ", -gap, " m inside of body '", system_.bodies[meeting.master].name,
	        "', at (", place.start.transpose(), "): bodies must not overlap, and larger steps than they can bear get them into each other");
}

template <int Dim> auto BodyContact<Dim>::placesAt(const Eigen::VectorXd& d) const -> Places
{
	Places places;
	for (const auto& facets : facets_)
		places.push_back(facets.placesAt(d));
	return places;
}

template <int Dim> PairPlaces<Dim> BodyContact<Dim>::pair(const Vec<Dim>& place, int body, int piece, const Places& places) const
{
	PairPlaces<Dim> x;
	x[0] = place;
	for (int v = 0; v < Dim; ++v)
		x[v + 1] = places[body][facets_[body].pieces[piece][v]];
	return x;
}

/// The place goes on with what the foot moves less than the vertices.
template <int Dim> PairPlaces<Dim> BodyContact<Dim>::pairNow(const Place& place, const Near& near, const Eigen::VectorXd& d, const Places& now) const
{
	const int       master = meetingOf(place).master;
	PairPlaces<Dim> x = pair(place.start, master, near.piece, now), start = pair(place.start, master, near.piece, start_);
	x[0] += place.at.displacement(d) - near.foot.displacement(d);
	for (int v = 0; v < Dim; ++v)
		x[0] += near.weight[v] * (x[v + 1] - start[v + 1]);
	return x;
}

/// The piece that is nearest to where the place is, null if that does not face it. At an edge the one behind which the
/// place is least. Without displacements as the step begins.
template <int Dim> auto BodyContact<Dim>::nearestOf(const Place& place, const Eigen::VectorXd* d, const Places& places) const -> const Near*
{
	const int    master = meetingOf(place).master;
	const double same   = 1e-12 * cellSize_ * cellSize_;
	double       least = std::numeric_limits<double>::infinity(), gap = 0;
	const Near*  nearest = nullptr;
	Vec<Dim>     normal  = Vec<Dim>::Zero();
	for (const Near& near : place.near) {
		const auto   x    = d ? pairNow(place, near, *d, places) : pair(place.start, master, near.piece, places);
		const double away = squaredDistance(x);
		if (away > least + same) continue;
		const Facing<Dim> at(x);
		if (away > least - same && at.gap < gap) continue;
		least = std::min(least, away), gap = at.gap, nearest = &near, normal = at.normal;
	}
	if (!nearest || normal.dot(place.normal) >= facing) return nullptr;
	return d && place.first && goesOn(place, *d, places) ? place.first : nearest;
}

/// With the piece that was nearest as the step began, and with the plane of it a little beyond its sides: pressures
/// would jump to and fro between pieces beside each other, whose normals differ, and what has entered by one side of a
/// corner and is pushed out by the other one would win energy.
template <int Dim> bool BodyContact<Dim>::goesOn(const Place& place, const Eigen::VectorXd& d, const Places& now) const
{
	const Facing<Dim> at(pairNow(place, *place.first, d, now));
	for (int i = 0; i < Dim; ++i)
		if (at.weight[i] < -beyondPiece * cellSize_ * at.slope[i].norm()) return false;
	return true;
}

template <int Dim> template <class F> void BodyContact<Dim>::forTouching(const Eigen::VectorXd& d, bool withSlope, F&& f) const
{
	if (places_.empty()) return;
	const Places now = placesAt(d);
	for (const Place& place : places_) {
		const auto& meeting = meetingOf(place);
		const Near* near    = nearestOf(place, &d, now);
		if (!near) continue;
		const double          penalty = penaltyOf(place);
		const ContactLaw<Dim> law { penalty, penalty / slipSoftnessOfBodies, meeting.friction, meeting.adhesion * place.area };
		const auto            start = pair(place.start, meeting.master, near->piece, start_), end = pairNow(place, *near, d, now);
		if (const auto force = pairForce<Dim>(law, start, place.shear, end, place.closed, tolerance_, withSlope))
			f(Touching { place, *near, *force, end });
	}
}

template <int Dim> auto BodyContact<Dim>::nodesOf(const Place& place, const Near& near) const -> std::vector<PairNode>
{
	std::vector<PairNode> nodes;
	const auto            add = [&](const Attachment<Dim>& at, int i, double part) {
                for (int n = 0; n < at.nodes; ++n) {
                        if (at.weight[n] == 0) continue;
                        auto known = std::find_if(nodes.begin(), nodes.end(), [&](const PairNode& other) { return other.node == at.node[n]; });
                        if (known == nodes.end()) known = nodes.insert(nodes.end(), PairNode { at.node[n], {} });
                        known->weight[i] += part * at.weight[n];
                }
	};
	const auto& master = facets_[meetingOf(place).master];
	add(place.at, 0, 1);
	add(near.foot, 0, -1);
	for (int v = 0; v < Dim; ++v) {
		const auto& at = *master.at[master.pieces[near.piece][v]];
		add(at, 0, near.weight[v]);
		add(at, v + 1, 1);
	}
	return nodes;
}

template <int Dim> bool BodyContact<Dim>::isSymmetric() const
{
	return std::all_of(system_.meetings.begin(), system_.meetings.end(), [](const auto& m) { return m.friction == 0 || m.adhesion == 0; });
}

/// All nodes around a place and the pieces near it, as any of these may be the nearest one.
template <int Dim> void BodyContact<Dim>::markCouplings(Couplings& K) const
{
	for (const Place& place : places_) {
		std::vector<int> nodes;
		for (const Near& near : place.near)
			for (const PairNode& one : nodesOf(place, near))
				nodes.push_back(one.node);
		std::sort(nodes.begin(), nodes.end());
		nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
		for (const int a : nodes)
			for (const int b : nodes)
				if (a <= b) K.mark({ 0, a }, { 0, b });
	}
}

template <int Dim> void BodyContact<Dim>::add(const Eigen::VectorXd& d, double factor, Eigen::VectorXd& force, Eigen::VectorXd* sizes, Couplings* K) const
{
	forTouching(d, K != nullptr, [&](const Touching& touching) {
		const auto nodes = nodesOf(touching.place, touching.near);
		for (const PairNode& one : nodes) {
			Vec<Dim>                                         f   = Vec<Dim>::Zero();
			Eigen::Matrix<double, Dim, PairForce<Dim>::size> row = Eigen::Matrix<double, Dim, PairForce<Dim>::size>::Zero();
			for (int i = 0; i <= Dim; ++i) {
				f += factor * one.weight[i] * touching.force.force[i];
				if (K) row -= factor * one.weight[i] * touching.force.slope.template middleRows<Dim>(Dim * i);
			}
			force.template segment<Dim>(Dim * one.node) -= f;
			if (sizes) sizes->template segment<Dim>(Dim * one.node) += f.cwiseAbs();
			for (const PairNode& other : nodes) {
				if (!K) break;
				Mat<Dim> k = Mat<Dim>::Zero();
				for (int j = 0; j <= Dim; ++j)
					k += other.weight[j] * row.template middleCols<Dim>(Dim * j);
				K->add({ 0, one.node }, { 0, other.node }, k);
			}
		}
	});
}

template <int Dim> std::optional<PointFailure> BodyContact<Dim>::addCoupled(const State& state, const FieldSum<Dim>& sum) const
{
	add(state.displacements(), system_.weight, sum.force[0], &sum.sizes[0], sum.couplings);
	return std::nullopt;
}

template <int Dim> void BodyContact<Dim>::addCoupledBefore(const State&, const FieldSum<Dim>& sum) const { addUnweighted(nullptr, sum.force[0]); }

template <int Dim> void BodyContact<Dim>::addUnweighted(const Eigen::VectorXd* d, Eigen::VectorXd& resistance) const
{
	add(d ? *d : Eigen::VectorXd::Zero(unknowns_), 1, resistance, nullptr, nullptr);
}

template <int Dim> void BodyContact<Dim>::holdAt(const Touching& touching, bool sticks, const typename Term<Dim>::Hold& hold) const
{
	const Vec<Dim>& normal = Facing<Dim>(touching.now).normal;
	const auto&     master = facets_[meetingOf(touching.place).master];
	const auto      holds  = [&](const Attachment<Dim>& at) {
                hold(at.node[0], normal, at.inCell());
                for (int a = 0; sticks && a < Dim; ++a)
                        hold(at.node[0], Vec<Dim>::Unit(a), at.inCell());
	};
	holds(touching.place.at);
	for (const int v : master.pieces[touching.near.piece])
		holds(*master.at[v]);
}

/// Each as if the other one stood still.
template <int Dim> void BodyContact<Dim>::restrain(const typename Term<Dim>::Hold& hold) const
{
	forTouching(Eigen::VectorXd::Zero(unknowns_), false, [&](const Touching& touching) {
		const auto& meeting = meetingOf(touching.place);
		holdAt(touching, meeting.friction > 0 && meeting.adhesion > 0, hold);
	});
}

template <int Dim> void BodyContact<Dim>::restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Hold& hold) const
{
	forTouching(d, false, [&](const Touching& touching) {
		const auto& meeting = meetingOf(touching.place);
		holdAt(touching, meeting.friction > 0 && meeting.adhesion > 0 && !touching.force.slips, hold);
	});
}

/// How far vertices of the two may have moved towards each other.
template <int Dim> double BodyContact<Dim>::approach(const BodyMeeting<Dim>& meeting, const Places& now) const
{
	Vec<Dim> mean  = Vec<Dim>::Zero();
	int      count = 0;
	double   sum   = 0;
	for (const int b : { meeting.slave, meeting.master })
		for (std::size_t v = 0; v < now[b].size(); ++v)
			mean += now[b][v] - start_[b][v], ++count;
	mean /= std::max(1, count);
	for (const int b : { meeting.slave, meeting.master }) {
		double most = 0;
		for (std::size_t v = 0; v < now[b].size(); ++v)
			most = std::max(most, (now[b][v] - start_[b][v] - mean).norm());
		sum += most;
	}
	return sum;
}

template <int Dim> Refusal BodyContact<Dim>::refusal(const Eigen::VectorXd& d) const
{
	const Places now    = placesAt(d);
	const char*  advice = "Smaller load steps (O.dt), or a larger stiffness of MpmBodyContact, may help.";
	for (const auto& meeting : system_.meetings)
		if (const double moved = approach(meeting, now); moved > reach_)
			return { Failure::penetrated,
				 sentence(
				         "bodies '", system_.bodies[meeting.slave].name, "' and '", system_.bodies[meeting.master].name, "' move by ", moved,
				         " m against each other in the step, farther than half a cell, within which they are looked for"),
				 advice };
	Refusal refusal;
	forTouching(d, false, [&](const Touching& touching) {
		const double gap = Facing<Dim>(touching.now).gap;
		if (gap > -deepestInBodies * cellSize_ || !refusal.cause.empty()) return;
		const auto& meeting = meetingOf(touching.place);
		refusal             = { Failure::penetrated,
			                sentence(
			                        "body '", system_.bodies[meeting.slave].name, "' would get ", -gap, " m into body '", system_.bodies[meeting.master].name,
			                        "', at (", touching.now[0].transpose(), ")"),
			                advice };
	});
	return refusal;
}

/// Stresses of a piece are the means over its places.
template <int Dim> void BodyContact<Dim>::commit(const Eigen::VectorXd& d)
{
	const Places                     now = placesAt(d);
	std::vector<std::vector<double>> area;
	for (auto& meeting : system_.meetings) {
		const std::size_t pieces = system_.bodies[meeting.slave].surface.pieces.size();
		meeting.shear.assign(pieces, Vec<Dim>::Zero()), meeting.pressure.assign(pieces, 0);
		meeting.force.setZero(), meeting.moment.setZero(), meeting.touching = meeting.slipping = 0;
		area.emplace_back(pieces, 0.);
	}
	for (const Place& place : places_)
		area[place.meeting][facets_[meetingOf(place).slave].whole[place.piece]] += place.area;
	system_.work = 0;
	forTouching(d, false, [&](const Touching& touching) {
		const auto& [place, near, force, at] = touching;
		auto&      meeting                   = system_.meetings[place.meeting];
		const int  whole                     = facets_[meeting.slave].whole[place.piece];
		const auto start                     = pair(place.start, meeting.master, near.piece, start_);
		meeting.shear[whole] += force.shear / area[place.meeting][whole];
		meeting.pressure[whole] += force.pressure / area[place.meeting][whole];
		meeting.force += force.force[0];
		Vec3 arm = Vec3::Zero(), f = Vec3::Zero();
		arm.template head<Dim>() = at[0], f.template head<Dim>() = force.force[0];
		meeting.moment += arm.cross(f);
		meeting.touching += 1, meeting.slipping += force.slips;
		for (int i = 0; i <= Dim; ++i)
			system_.work += force.force[i].dot(at[i] - start[i]);
	});
	moveSurfaces(now);
}

/// Parts of a piece that is divided have its stresses.
template <int Dim> void BodyContact<Dim>::moveSurfaces(const Places& now)
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

template class BodyContact<2>;
template class BodyContact<3>;

} // namespace gimpm
