// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/body_contact.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/cell_moduli.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace gimpm {
namespace {

/// The penalty on the gap over that on the slip, as of rigid bodies (core/terms/contact.hpp).
constexpr double slipSoftnessOfBodies = 20;

/// What a place may get behind the surface of another body, over the size of a cell.
constexpr double deepestInBodies = 0.1;

/// Pieces are seen by places with a normal at more than some 80 degrees from theirs.
constexpr double facing = 0.2;

/// How far pieces are looked for, over the size of a cell.
constexpr double reachOfBodies = 0.5;

/// Of the vertices of a piece, for each of the places on it, which stand for equal parts: Gauss in the plane, exact for
/// cubic functions; in space for squares.
template <int Dim> const std::array<std::array<double, Dim>, Dim>& weightsOfPlaces()
{
	static const auto all = [] {
		const double                             near = Dim == 2 ? (1 + 1 / std::sqrt(3.)) / 2 : 2. / 3, far = (1 - near) / (Dim - 1);
		std::array<std::array<double, Dim>, Dim> weights;
		for (int q = 0; q < Dim; ++q)
			for (int v = 0; v < Dim; ++v)
				weights[q][v] = q == v ? near : far;
		return weights;
	}();
	return all;
}

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

/// As attach(), and farther away the nearest place in the populated cells around: what soil leaves behind of its
/// surface goes with it.
template <int Dim> std::optional<Attachment<Dim>> attachNear(const Vec<Dim>& place, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer)
{
	if (auto attached = attach(place, basis, grid, layer)) return attached;
	std::optional<Vec<Dim>> nearest;
	double                  least = std::numeric_limits<double>::infinity();
	const Vec<Dim>          xi    = (place - grid.origin) / grid.cellSize;
	if (!(xi.array().abs() < Grid<Dim>::indexLimit).all()) return std::nullopt;
	const Index<Dim> own = xi.array().floor().template cast<int>();
	for (int i = 0; i < (Dim == 2 ? 9 : 27); ++i) {
		Index<Dim> cell = own;
		for (int a = 0, rest = i; a < Dim; ++a, rest /= 3)
			cell[a] += rest % 3 - 1;
		const Vec<Dim> low = cell.template cast<double>(), inside = xi.cwiseMax(low).cwiseMin(low + Vec<Dim>::Ones());
		const double   away = (xi - inside).squaredNorm();
		const Key      key  = Grid<Dim>::key(grid.first(cell), 0, layer);
		if (away < least && find(basis.populatedLeaves(), grid.refinement ? grid.refinement->leafOf(key) : key) >= 0)
			least = away, nearest = grid.origin + grid.cellSize * inside;
	}
	return nearest ? attach(*nearest, basis, grid, layer) : std::nullopt;
}

/// Pieces by the cells within reach of them.
template <int Dim> class PiecesByCell {
public:
	PiecesByCell(const Surface<Dim>& surface, const Grid<Dim>& grid, double reach) : grid_(grid)
	{
		for (std::size_t i = 0; i < surface.pieces.size(); ++i) {
			Vec<Dim> low = surface.vertices[surface.pieces[i][0]], high = low;
			for (const int v : surface.pieces[i])
				low = low.cwiseMin(surface.vertices[v]), high = high.cwiseMax(surface.vertices[v]);
			const Index<Dim> first = cell(low - Vec<Dim>::Constant(reach)), last = cell(high + Vec<Dim>::Constant(reach));
			Index<Dim>       c = first;
			for (int a = 0; a < Dim;) {
				pieces_[Grid<Dim>::key(c)].push_back(int(i));
				for (a = 0; a < Dim && ++c[a] > last[a]; ++a)
					c[a] = first[a];
			}
		}
	}
	const std::vector<int>& near(const Vec<Dim>& x) const
	{
		static const std::vector<int> none;
		const auto                    found = pieces_.find(Grid<Dim>::key(cell(x)));
		return found == pieces_.end() ? none : found->second;
	}

private:
	Index<Dim> cell(const Vec<Dim>& x) const { return ((x - grid_.origin) / grid_.cellSize).array().floor().template cast<int>(); }

	const Grid<Dim>&                          grid_;
	std::unordered_map<Key, std::vector<int>> pieces_;
};

} // namespace

template <int Dim>
BodyContact<Dim>::BodyContact(BodyContacts<Dim>& system, const Beginning<Dim>& step)
        : system_(system)
        , cellSize_(step.grid.cellSize)
        , tolerance_(1e-9 * cellSize_)
        , reach_(reachOfBodies * cellSize_)
        , isRing_(step.grid.axisymmetric)
        , unknowns_(Dim * Eigen::Index(step.basis.nodes.size()))
        , grid_(step.grid)
{
	system.acting = this;
	attachAll(step);
	for (int m = 0; m < int(system.meetings.size()); ++m)
		addPlaces(m);
	takeModuli(step);
	requireApart();
}

template <int Dim> void BodyContact<Dim>::attachAll(const Beginning<Dim>& step)
{
	for (const auto& body : system_.bodies) {
		start_.push_back(body.surface.vertices);
		at_.emplace_back();
		for (const Vec<Dim>& x : body.surface.vertices)
			at_.back().push_back(attachNear(x, step.basis, step.grid, body.layer));
	}
}

template <int Dim> bool BodyContact<Dim>::isThere(int body, int piece) const
{
	const auto& vertices = surfaceOf(body).pieces[piece];
	return std::all_of(vertices.begin(), vertices.end(), [&](int v) { return at_[body][v].has_value(); });
}

template <int Dim> void BodyContact<Dim>::addPlaces(int number)
{
	const auto&             meeting = system_.meetings[number];
	const auto&             slave   = surfaceOf(meeting.slave);
	const PiecesByCell<Dim> byCell(surfaceOf(meeting.master), grid_, reach_);
	for (int i = 0; i < int(slave.pieces.size()); ++i) {
		if (!isThere(meeting.slave, i)) continue;
		const Vec<Dim> normal = slave.normal(slave.pieces[i], slave.vertices), first = slave.normal(slave.pieces[i], slave.vertices0);
		for (int q = 0; q < Dim; ++q) {
			Place          place { number, i, q, normal.normalized(), first.norm() / Dim, normal.norm() / Dim };
			const Vec<Dim> x = placeAt(place, slave.vertices), x0 = placeAt(place, slave.vertices0);
			if (isRing_ && x[0] <= 0) continue;
			for (const int piece : byCell.near(x))
				if (isThere(meeting.master, piece) && squaredDistance(pair(place, piece, start_)) <= reach_ * reach_)
					place.near.push_back(piece);
			if (place.near.empty()) continue;
			if (isRing_) place.area *= 2 * M_PI * x0[0], place.areaNow *= 2 * M_PI * x[0];
			if (!meeting.shear.empty()) place.shear = meeting.shear[Dim * i + q];
			places_.push_back(std::move(place));
		}
	}
}

/// The smaller one of both, by the cells at the first vertices of the pieces.
template <int Dim> void BodyContact<Dim>::takeModuli(const Beginning<Dim>& step)
{
	if (places_.empty()) return;
	std::vector<char>               isAskedFor(step.basis.populatedLeaves().size(), 0);
	std::vector<std::array<int, 2>> leaves;
	const auto                      leafOf = [&](int body, int piece) {
                const auto& at = *at_[body][surfaceOf(body).pieces[piece][0]];
                return find(step.basis.populatedLeaves(), Grid<Dim>::key(grid_.first(at.cell * (1 << at.level)), at.level, system_.bodies[body].layer));
	};
	for (const Place& place : places_) {
		const auto& meeting = meetingOf(place);
		const auto  nearer  = [&](int a, int b) { return squaredDistance(pair(place, a, start_)) < squaredDistance(pair(place, b, start_)); };
		leaves.push_back(
		        { leafOf(meeting.slave, place.piece), leafOf(meeting.master, *std::min_element(place.near.begin(), place.near.end(), nearer)) });
		for (const int leaf : leaves.back())
			isAskedFor[leaf] = 1;
	}
	const auto moduli = cellModuli(isAskedFor, step.basis, step.stiffnessOf, step.grid);
	for (std::size_t i = 0; i < places_.size(); ++i)
		places_[i].young = std::min(moduli[leaves[i][0]], moduli[leaves[i][1]]);
}

/// Bodies that begin within each other would be thrown apart.
template <int Dim> void BodyContact<Dim>::requireApart()
{
	for (const Place& place : places_) {
		const auto& meeting = meetingOf(place);
		const int   piece   = nearestOf(place, start_);
		if (piece < 0 || !obstacle_.empty()) continue;
		const Facing<Dim> at(pair(place, piece, start_));
		if (at.gap < -deepestInBodies * cellSize_)
			obstacle_ = sentence(
			        "the surface of body '", system_.bodies[meeting.slave].name, "' is ", -at.gap, " m inside of body '",
			        system_.bodies[meeting.master].name, "', at (", placeAt(place, start_[meeting.slave]).transpose(),
			        "): bodies must not overlap, and larger steps than they can bear get them into each other");
	}
}

template <int Dim> auto BodyContact<Dim>::placesAt(const Eigen::VectorXd& d) const -> Places
{
	Places places = start_;
	for (std::size_t b = 0; b < places.size(); ++b)
		for (std::size_t v = 0; v < places[b].size(); ++v)
			if (at_[b][v]) places[b][v] += at_[b][v]->displacement(d);
	return places;
}

template <int Dim> Vec<Dim> BodyContact<Dim>::placeAt(const Place& place, const std::vector<Vec<Dim>>& vertices) const
{
	const auto& piece = surfaceOf(meetingOf(place).slave).pieces[place.piece];
	Vec<Dim>    x     = Vec<Dim>::Zero();
	for (int v = 0; v < Dim; ++v)
		x += weightsOfPlaces<Dim>()[place.number][v] * vertices[piece[v]];
	return x;
}

template <int Dim> PairPlaces<Dim> BodyContact<Dim>::pair(const Place& place, int piece, const Places& places) const
{
	const int       master = meetingOf(place).master;
	PairPlaces<Dim> x;
	x[0] = placeAt(place, places[meetingOf(place).slave]);
	for (int v = 0; v < Dim; ++v)
		x[v + 1] = places[master][surfaceOf(master).pieces[piece][v]];
	return x;
}

/// The piece that is nearest to where the place is, -1 if that does not face it. At an edge the one behind which the
/// place is least.
template <int Dim> int BodyContact<Dim>::nearestOf(const Place& place, const Places& places) const
{
	const double same  = 1e-12 * cellSize_ * cellSize_;
	double       least = std::numeric_limits<double>::infinity(), gap = 0;
	int          nearest = -1;
	Vec<Dim>     normal  = Vec<Dim>::Zero();
	for (const int piece : place.near) {
		const auto   x    = pair(place, piece, places);
		const double away = squaredDistance(x);
		if (away > least + same) continue;
		const Facing<Dim> at(x);
		if (away > least - same && at.gap < gap) continue;
		least = std::min(least, away), gap = at.gap, nearest = piece, normal = at.normal;
	}
	return nearest >= 0 && normal.dot(place.normal) < facing ? nearest : -1;
}

template <int Dim> template <class F> void BodyContact<Dim>::forTouching(const Eigen::VectorXd& d, bool withSlope, F&& f) const
{
	if (places_.empty()) return;
	const Places now = placesAt(d);
	for (const Place& place : places_) {
		const auto& meeting = meetingOf(place);
		const int   piece   = nearestOf(place, now);
		if (piece < 0) continue;
		const double          penalty = meeting.stiffness * place.young * place.area / cellSize_;
		const ContactLaw<Dim> law { penalty, penalty / slipSoftnessOfBodies, meeting.friction, meeting.adhesion * place.areaNow };
		const auto            end = pair(place, piece, now);
		if (const auto force = pairForce<Dim>(law, pair(place, piece, start_), place.shear, end, tolerance_, withSlope))
			f(Touching { place, piece, *force, end });
	}
}

template <int Dim> auto BodyContact<Dim>::nodesOf(const Place& place, int piece) const -> std::vector<PairNode>
{
	std::vector<PairNode> nodes;
	const auto            add = [&](int body, int vertex, int i, double part) {
                const auto& at = *at_[body][vertex];
                for (int n = 0; n < at.nodes; ++n) {
                        if (at.weight[n] == 0) continue;
                        auto known = std::find_if(nodes.begin(), nodes.end(), [&](const PairNode& other) { return other.node == at.node[n]; });
                        if (known == nodes.end()) known = nodes.insert(nodes.end(), PairNode { at.node[n], {} });
                        known->weight[i] += part * at.weight[n];
                }
	};
	const auto& meeting = meetingOf(place);
	for (int v = 0; v < Dim; ++v) {
		add(meeting.slave, surfaceOf(meeting.slave).pieces[place.piece][v], 0, weightsOfPlaces<Dim>()[place.number][v]);
		add(meeting.master, surfaceOf(meeting.master).pieces[piece][v], v + 1, 1);
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
		for (const int piece : place.near)
			for (const PairNode& one : nodesOf(place, piece))
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
		const auto nodes = nodesOf(touching.place, touching.piece);
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
	const Vec<Dim> normal  = Facing<Dim>(touching.now).normal;
	const auto&    meeting = meetingOf(touching.place);
	const auto     holds   = [&](int body, int piece) {
                for (const int v : surfaceOf(body).pieces[piece]) {
                        const auto& at = *at_[body][v];
                        hold(at.node[0], normal, at.inCell());
                        for (int a = 0; sticks && a < Dim; ++a)
                                hold(at.node[0], Vec<Dim>::Unit(a), at.inCell());
                }
	};
	holds(meeting.slave, touching.place.piece);
	holds(meeting.master, touching.piece);
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

template <int Dim> void BodyContact<Dim>::commit(const Eigen::VectorXd& d)
{
	for (auto& meeting : system_.meetings) {
		const std::size_t places = Dim * surfaceOf(meeting.slave).pieces.size();
		meeting.shear.assign(places, Vec<Dim>::Zero()), meeting.pressure.assign(places, 0);
		meeting.force.setZero(), meeting.moment.setZero(), meeting.touching = meeting.slipping = 0;
	}
	system_.work = 0;
	forTouching(d, false, [&](const Touching& touching) {
		const auto& [place, piece, force, at] = touching;
		auto&      meeting                    = system_.meetings[place.meeting];
		const int  number                     = Dim * place.piece + place.number;
		const auto start                      = pair(place, piece, start_);
		meeting.shear[number] = force.shear, meeting.pressure[number] = force.pressure;
		meeting.force += force.force[0];
		Vec3 arm = Vec3::Zero(), f = Vec3::Zero();
		arm.template head<Dim>() = at[0], f.template head<Dim>() = force.force[0];
		meeting.moment += arm.cross(f);
		meeting.touching += 1, meeting.slipping += force.slips;
		for (int i = 0; i <= Dim; ++i)
			system_.work += force.force[i].dot(at[i] - start[i]);
	});
	moveSurfaces(placesAt(d));
}

/// Where a piece is divided its places have their parts of the forces.
template <int Dim> void BodyContact<Dim>::moveSurfaces(const Places& now)
{
	for (std::size_t b = 0; b < system_.bodies.size(); ++b) {
		auto&             body   = system_.bodies[b];
		const std::size_t before = body.surface.pieces.size();
		body.surface.vertices    = now[b];
		const auto wholes        = body.refine(grid_, false);
		if (wholes.size() == before) continue;
		std::vector<int> parts(before, 0);
		for (const int whole : wholes)
			++parts[whole];
		for (auto& meeting : system_.meetings) {
			if (meeting.slave != int(b)) continue;
			const auto shear    = std::move(meeting.shear);
			const auto pressure = std::move(meeting.pressure);
			meeting.shear.clear(), meeting.pressure.clear();
			for (const int whole : wholes)
				for (int q = 0; q < Dim; ++q)
					meeting.shear.push_back(shear[Dim * whole + q] / parts[whole]),
					        meeting.pressure.push_back(pressure[Dim * whole + q] / parts[whole]);
		}
	}
}

template class BodyContact<2>;
template class BodyContact<3>;

} // namespace gimpm
