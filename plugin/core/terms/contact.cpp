// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact.hpp"
#include "core/terms/attached.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace gimpm {
namespace {

template <int Dim> auto keyOf(const ContactRecord<Dim>& r) { return std::tuple(r.point, r.corner, r.body); }

template <int Dim> const ContactRecord<Dim>* recordOf(const std::vector<ContactRecord<Dim>>& records, const std::tuple<int, int, int>& key)
{
	const auto i = std::lower_bound(records.begin(), records.end(), key, [](const auto& r, const auto& k) { return keyOf(r) < k; });
	return i != records.end() && keyOf(*i) == key ? &*i : nullptr;
}

template <int Dim> std::string textAt(const RigidBody<Dim>& body, const char* what, const Vec<Dim>& x)
{
	std::ostringstream text;
	text << body.name << what << ", at (" << x.transpose() << ")";
	return text.str();
}

/// Why something comes out on the other side of a body.
std::string whyThrough(double motionOfBody, double motionOfSoil)
{
	if (motionOfBody >= motionOfSoil) return " would let soil through, as it moves too far in a step for its thickness";
	std::ostringstream text;
	text << " would let soil through, which moves " << motionOfSoil << " m in the step, too far for the body's thickness";
	return text.str();
}

/// Of a corner's springs on gap and slip [J].
double stored(double pressure, double gap, double friction) { return pressure > 0 ? -gap / 2 * (pressure + slipSoftness * friction * friction / pressure) : 0; }

template <int Dim> Vec<Dim> turned(const Vec<Dim>& force, const Vec<Dim>& axis, double angle)
{
	if constexpr (Dim == 3) return Vec3(std::cos(angle) * force + std::sin(angle) * axis.cross(force));
	return force;
}

} // namespace

template <int Dim>
Contact<Dim>::Contact(ContactSystem<Dim>& system, const Beginning<Dim>& step)
        : system_(system)
        , tolerance_(1e-9 * step.grid.cellSize)
        , isRing_(step.grid.axisymmetric)
        , cloud_(step.cloud)
        , basis_(step.basis)
        , grid_(step.grid)
        , division_(step.division)
{
	system.acting = this;
	system.warnings.clear();
	for (const auto& body : system.bodies)
		spins_.push_back(body.spin());
	find(step);
	for (int i = 0; i < int(near_.size()); ++i) {
		const auto&    body   = system.bodies[near_[i].body];
		const Vec<Dim> centre = near_[i].domain.centre();
		// Of a two-sided surface it never is.
		if (body.isNew && body.proximity(body.begin, centre, near_[i].side).gap < 0)
			obstacle_ = textAt(body, " has the middle of a material point inside of it", centre);
		addCorners(i);
		look(near_[i]);
	}
	std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) {
		return std::tie(a.point, a.corner, a.body) < std::tie(b.point, b.corner, b.body);
	});
	for (const Corner& corner : corners_)
		isSymmetric_ = isSymmetric_ && (corner.law.friction == 0 || corner.law.cap == 0);
}

/// What the corners of a domain cannot tell of a body.
template <int Dim> void Contact<Dim>::look(const Near& near)
{
	const auto&        body = system_.bodies[near.body];
	std::ostringstream text;
	if (body.turn > 1 && (body.shape.kind != RigidKind::ball || (body.friction > 0 && body.adhesion > 0))) {
		text << body.name << " turns by " << body.turn
		     << " rad from one load step to the next; soil near it can follow 1 rad: decrease angVel, O.dt or iterPeriod";
		obstacle_ = text.str();
	}
	const Vec<Dim> centre = near.domain.centre();
	const double   width = body.widthAcross(body.end.inBody(centre) - body.begin.inBody(centre)), size = 2 * near.domain.half().maxCoeff();
	const double   seen = (Dim == 3 && body.shape.kind == RigidKind::ball ? std::sqrt(2.) : 1) * size;
	if (width >= (1 - 1e-9) * seen || !system_.warnings.empty()) return;
	text << body.name << " is " << width << " m wide, and the domains of the material points near it " << size
	     << " m: it can pass between their corners, where nothing feels it. Cells of " << grid_.cellSize * width / seen
	     << " m with as many points each would see it.";
	system_.warnings.push_back(text.str());
}

template <int Dim> void Contact<Dim>::find(const Beginning<Dim>& step)
{
	for (const auto& [body, point, side] : nearPoints(system_.bodies, cloud_, basis_, grid_)) {
		if (point >= division_.ownOf(cloud_.size())) continue; // the process that has it tells of it
		const auto [volume, young] = step.stiffnessOf(point);
		own_.push_back(point);
		near_.push_back({ body, int(division_.idOf(point)), side, { cloud_, point }, volume, young });
	}
	near_ = division_.joined(std::move(near_));
}

template <int Dim> std::vector<PointDomain<Dim>> Contact<Dim>::domainsNow() const
{
	std::vector<PointDomain<Dim>> domains;
	for (const int p : own_)
		domains.emplace_back(cloud_, p);
	return division_.joined(std::move(domains));
}

template <int Dim> void Contact<Dim>::addCorners(int number)
{
	const Near&  near  = near_[number];
	const auto&  body  = system_.bodies[near.body];
	const double reach = searchReach(body, grid_);
	for (int c = 0; c < 1 << Dim; ++c) {
		const Vec<Dim>       place = near.domain.corner(c);
		const Proximity<Dim> at    = body.proximity(body.begin, place, near.side);
		if (std::max(at.gap, at.beside) > reach) continue;
		const auto attached = attach(place, basis_, grid_);
		if (!attached) continue; // behind a wall
		const auto*    record   = recordOf(system_.records, { near.point, c, near.body });
		const double   offset   = record ? record->offset : body.isNew && at.beside < 0 ? std::min(0., at.gap) : 0;
		const Vec<Dim> friction = record ? record->friction : Vec<Dim>(Vec<Dim>::Zero());
		const bool     turns    = record && record->touches && !record->slips && !spins_[near.body].isZero(0);
		corners_.push_back(
		        { near.point, c, near.body, near.side, number, place, offset, friction, turns, lawOf(body, near, place, at.normal), *attached });
	}
}

/// The area of a corner is its share of the domain's outline as seen along the normal, in axisymmetry of the ring
/// through the corner.
template <int Dim> ContactLaw<Dim> Contact<Dim>::lawOf(const RigidBody<Dim>& body, const Near& near, const Vec<Dim>& place, const Vec<Dim>& normal) const
{
	double area = 0;
	for (int a = 0; a < Dim; ++a)
		area += std::abs(normal[a]) * near.volume / (2 * near.domain.halfSize[a]) / (1 << (Dim - 1));
	if (isRing_) area *= std::max(0., place[0] / near.domain.position[0]);
	const double penalty = body.stiffness * near.young * area / grid_.cellSize;
	return { penalty, penalty / slipSoftness, body.friction, body.adhesion * area };
}

template <int Dim> Approach<Dim> Contact<Dim>::approach(const Corner& corner, const Vec<Dim>& x) const
{
	const auto&   body = system_.bodies[corner.body];
	Approach<Dim> a { body.proximity(body.end, x, corner.side), body.before(x) - corner.place, body.beforeSlope(), corner.friction };
	a.at.gap -= corner.offset;
	if (corner.turns) a.friction = turned<Dim>(a.friction, a.at.normal, spins_[corner.body].dot(a.at.normal));
	return a;
}

template <int Dim> struct Contact<Dim>::Acting {
	const Corner* corner;
	Approach<Dim> approach;
};

/// Where surfaces that face alike lie over each other, the corner is held by one of them: of sheets by the first,
/// otherwise by that which it is deepest in. What it has stuck with goes with it from one to the other.
template <int Dim> void Contact<Dim>::choose(std::vector<Acting>& acting, const Corner& corner, const Approach<Dim>& approach) const
{
	const auto isSheet = [&](const Corner& c) { return system_.bodies[c.body].shape.kind == RigidKind::sheet; };
	const auto other   = std::find_if(acting.begin(), acting.end(), [&](const Acting& a) { return a.approach.at.normal.dot(approach.at.normal) > 0.99; });
	if (other == acting.end()) {
		acting.push_back({ &corner, approach });
		return;
	}
	const Vec<Dim> friction  = other->approach.friction + approach.friction; // one of them is zero
	const bool     areSheets = isSheet(corner) && isSheet(*other->corner);
	if (!areSheets && approach.at.gap < other->approach.at.gap - tolerance_) *other = { &corner, approach };
	other->approach.friction = friction;
}

/// Of sheets that a corner is behind those count which it is straight behind. Behind an edge between sheets, and so
/// beside all of them, it is the one that it is least beside.
template <int Dim> template <class F> void Contact<Dim>::forTouching(const Eigen::VectorXd& d, F&& f) const
{
	const double        margin = 0.1 * grid_.cellSize;
	std::vector<Acting> acting;
	for (auto first = corners_.begin(), last = first; first != corners_.end(); first = last) {
		const Vec<Dim> x         = first->place + first->attached.displacement(d);
		const Corner*  beside    = nullptr;
		double         least     = margin;
		bool           isOnSheet = false;
		acting.clear();
		for (; last != corners_.end() && last->point == first->point && last->corner == first->corner; ++last) {
			const Approach<Dim>   near    = approach(*last, x);
			const Proximity<Dim>& at      = near.at;
			const bool            isSheet = system_.bodies[last->body].shape.kind == RigidKind::sheet;
			if (at.gap > tolerance_ || (isSheet && at.beside > margin)) continue;
			if (isSheet && at.beside > 0) {
				if (at.beside < least) beside = &*last, least = at.beside;
				continue;
			}
			isOnSheet = isOnSheet || isSheet;
			choose(acting, *last, near);
		}
		if (beside && !isOnSheet) choose(acting, *beside, approach(*beside, x));
		for (const Acting& a : acting)
			if (const auto touched = touch(a.corner->law, a.approach, tolerance_)) f(*a.corner, x, a.approach.at.gap, *touched);
	}
}

template <int Dim> void Contact<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (const Corner& corner : corners_)
		markAttached(corner.attached, corner.attached, K);
}

template <int Dim> std::optional<PointFailure> Contact<Dim>::add(const Eigen::VectorXd& d, const TermSum<Dim>& sum) const
{
	forTouching(d, [&](const Corner& corner, const Vec<Dim>&, double, const Touch<Dim>& touched) {
		addAttachedForce<Dim>(corner.attached, system_.weight * touched.force(), sum);
		if (sum.K) addAttachedStiffness<Dim>(corner.attached, corner.attached, system_.weight * touched.slope, *sum.K);
	});
	return std::nullopt;
}

template <int Dim> void Contact<Dim>::addBefore(Eigen::VectorXd& force) const
{
	for (const Corner& corner : corners_)
		if (const auto* r = recordOf(system_.records, { corner.point, corner.corner, corner.body }); r && r->touches)
			addAttachedForce<Dim>(corner.attached, r->pressure * r->normal + r->friction, { force });
}

/// Where soil touches as the step begins, and where it would touch bodies that have moved if it stayed. Whether it then
/// slips or comes off is for the iterations to find.
template <int Dim> void Contact<Dim>::restrain(const typename Term<Dim>::Hold& hold) const
{
	const auto holds = [&](const Corner& corner, const Vec<Dim>& normal) {
		const bool     sticks = corner.law.friction > 0 && corner.law.cap > 0;
		const Vec<Dim> inCell = corner.attached.inCell();
		hold(corner.attached.node[0], normal, inCell);
		for (int a = 0; sticks && a < Dim; ++a)
			hold(corner.attached.node[0], Vec<Dim>::Unit(a), inCell);
	};
	for (const Corner& corner : corners_)
		if (const auto* r = recordOf(system_.records, { corner.point, corner.corner, corner.body }); r && r->touches) {
			const auto&          body = system_.bodies[corner.body];
			const Proximity<Dim> at   = body.proximity(body.begin, corner.place, corner.side);
			// Otherwise it has been put elsewhere.
			if (at.gap - corner.offset <= tolerance_) holds(corner, at.normal);
		}
	forTouching(
	        Eigen::VectorXd::Zero(Dim * Eigen::Index(basis_.nodes.size())),
	        [&](const Corner& corner, const Vec<Dim>&, double, const Touch<Dim>& touched) { holds(corner, touched.normal); });
}

template <int Dim> void Contact<Dim>::restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Hold& hold) const
{
	forTouching(d, [&](const Corner& corner, const Vec<Dim>&, double, const Touch<Dim>& touched) {
		const bool     sticks = corner.law.friction > 0 && corner.law.cap > 0 && !touched.slips;
		const Vec<Dim> inCell = corner.attached.inCell();
		hold(corner.attached.node[0], touched.normal, inCell);
		for (int a = 0; sticks && a < Dim; ++a)
			hold(corner.attached.node[0], Vec<Dim>::Unit(a), inCell);
	});
}

/// A whole domain inside, or a corner that has come through; or the middle of a point on the other side of a surface
/// that soil may touch from both: there it would not be known again.
template <int Dim> Refusal Contact<Dim>::refusal(const Eigen::VectorXd& d) const
{
	std::string found;
	forTouching(d, [&](const Corner& corner, const Vec<Dim>& x, double gap, const Touch<Dim>& touched) {
		if (gap < -2 * touched.normal.cwiseAbs().dot(near_[corner.near].domain.half()))
			found = textAt(system_.bodies[corner.body], " would get a whole material point inside of it", x);
	});
	for (const Corner& corner : corners_) {
		const auto&    body = system_.bodies[corner.body];
		const Vec<Dim> u = corner.attached.displacement(d), x = corner.place + u;
		if (body.isCrossed(corner.place, x)) found = textAt(body, whyThrough(body.motion(), u.norm()).c_str(), x);
	}
	for (const Near& near : near_) {
		const auto& body = system_.bodies[near.body];
		if (!body.shape.isTwoSided) continue;
		const Vec<Dim> first  = near.domain.centre();
		const auto     centre = attach(first, basis_, grid_);
		if (!centre) continue;
		const Vec<Dim>       x  = first + centre->displacement(d);
		const Proximity<Dim> at = body.proximity(body.end, x, near.side);
		if (at.gap < 0 && at.beside < 0) found = textAt(body, " would get the middle of a material point on its other side", x);
	}
	if (!found.empty()) return { Failure::penetrated, found, "Smaller load steps (O.dt), or a larger stiffness of MpmContact, may help." };
	found = missed(d);
	if (!found.empty()) return { Failure::penetrated, found, "Smaller steps (O.dt) may help." };
	return { Failure::refused, refusalOfGift(d), "Smaller steps (O.dt) may help." };
}

/// Soil that was too far from a body to be looked at as the step began, and ends in it or behind it.
template <int Dim> std::string Contact<Dim>::missed(const Eigen::VectorXd& d) const
{
	double most = d.size() > 0 ? Eigen::Map<const Eigen::Matrix<double, Dim, -1>>(d.data(), Dim, d.size() / Dim).colwise().norm().maxCoeff() : 0;
	most        = division_.largest(most);
	if (!(most > reachOfSoil(grid_))) return {};
	std::string found;
	for (const NearPoint& near : nearPoints(system_.bodies, cloud_, basis_, grid_, most))
		if (found.empty() && near.point < division_.ownOf(cloud_.size())) found = missed(near, d);
	return division_.firstSaid(found);
}

template <int Dim> std::string Contact<Dim>::missed(const NearPoint& near, const Eigen::VectorXd& d) const
{
	const auto&            body  = system_.bodies[near.body];
	const double           reach = searchReach(body, grid_);
	const PointDomain<Dim> domain(cloud_, near.point);
	for (int c = 0; c < 1 << Dim; ++c) {
		const Vec<Dim>       place    = domain.corner(c);
		const Proximity<Dim> before   = body.proximity(body.begin, place, near.side);
		const auto           attached = attach(place, basis_, grid_);
		if (std::max(before.gap, before.beside) <= reach || !attached) continue; // seen, or behind a wall
		const Vec<Dim>       u = attached->displacement(d), x = place + u;
		const Proximity<Dim> after  = body.proximity(body.end, x, near.side);
		const double         part   = before.gap / (before.gap - after.gap); // of the way, to the surface
		const double         beside = before.beside + part * (after.beside - before.beside);
		const bool           isIn   = before.gap > 0 && after.gap < -tolerance_ && !(beside > 0);
		if (!isIn && !body.isCrossed(place, x)) continue;
		std::ostringstream text;
		text << " would be met by soil that moves " << u.norm() << " m in the step, more than the half cell in which contact looks for it";
		return textAt(body, text.str().c_str(), x);
	}
	return {};
}

/// Work on the soil as seen from the bodies, beyond what the springs had stored. As their energy is convex in the gap,
/// it is never above zero on a flat face. They follow the moduli of the soil from step to step: what they have stored
/// is that of the stiffness that they have now, as no length of the step changes that.
template <int Dim> double Contact<Dim>::given(const Eigen::VectorXd& d) const
{
	const auto isBefore = [](const Corner& c, const auto& key) { return std::tuple(c.point, c.corner, c.body) < key; };
	double     sum      = 0;
	for (const auto& r : system_.records) {
		if (!r.touches) continue;
		const auto corner = std::lower_bound(corners_.begin(), corners_.end(), keyOf(r), isBefore);
		const bool isHere = corner != corners_.end() && std::tuple(corner->point, corner->corner, corner->body) == keyOf(r);
		sum -= stored(isHere ? corner->law.normal * -r.gap : r.pressure, r.gap, r.friction.norm());
	}
	forTouching(d, [&](const Corner& corner, const Vec<Dim>& x, double gap, const Touch<Dim>& touched) {
		const auto&    body  = system_.bodies[corner.body];
		const Vec<Dim> moved = body.beforeSlope().transpose() * (body.before(x) - corner.place);
		sum += touched.force().dot(moved) + stored(touched.pressure, gap, touched.friction.norm());
	});
	return sum;
}

/// At an edge of a body a corner may belong to one face as the step begins, and to another as it ends, of which the
/// force then works along its whole way.
template <int Dim> std::string Contact<Dim>::refusalOfGift(const Eigen::VectorXd& d) const
{
	constexpr double most = 0.1; // of all energy that there is
	if (!std::isfinite(system_.energy)) return {};
	double        work = 0, largest = 0;
	Vec<Dim>      place = Vec<Dim>::Zero();
	const Corner* first = nullptr;
	forTouching(d, [&](const Corner& corner, const Vec<Dim>& x, double, const Touch<Dim>& touched) {
		const double done = touched.force().dot(corner.attached.displacement(d));
		work += done;
		if (done > largest) largest = done, first = &corner, place = x;
	});
	const double gift = given(d);
	if (!first || gift <= most * (system_.energy + std::abs(work - gift))) return {};
	std::ostringstream text;
	text << " would give the soil " << gift << " J that nobody has put in, as soil passes an edge of it too far in one step";
	return textAt(system_.bodies[first->body], text.str().c_str(), place);
}

template <int Dim> ContactLoad Contact<Dim>::loadOn(const Vec<Dim>& owner, const Corner& corner, const Vec<Dim>& place, const Touch<Dim>& touched) const
{
	ContactLoad load;
	Vec3        arm                 = Vec3::Zero();
	load.force.template head<Dim>() = -touched.force();
	arm.template head<Dim>()        = place - owner;
	load.torque                     = arm.cross(load.force);
	if (isRing_) load.force[0] = 0, load.torque.setZero(); // all around the axis they add up to nothing
	if constexpr (Dim == 3) {
		const Mat3 resists = corner.law.normal * touched.normal * touched.normal.transpose()
		        + (touched.slips || corner.law.friction == 0 || corner.law.cap == 0 ? 0 : corner.law.tangential)
		                * (Mat3::Identity() - touched.normal * touched.normal.transpose());
		Eigen::Matrix<double, 3, 6> moves;
		moves << Mat3::Identity(), (Mat3() << 0, arm[2], -arm[1], -arm[2], 0, arm[0], arm[1], -arm[0], 0).finished();
		load.stiffness = moves.transpose() * resists * moves;
	}
	return load;
}

template <int Dim> void Contact<Dim>::commit(const Eigen::VectorXd& d)
{
	// Domains have followed the stretch of their points: a corner keeps the gap that the soil has there
	const auto                      domains = domainsNow();
	std::vector<ContactRecord<Dim>> records;
	for (const Corner& corner : corners_) {
		const auto&  body = system_.bodies[corner.body];
		const double gap  = approach(corner, corner.place + corner.attached.displacement(d)).at.gap;
		const double anew = body.proximity(body.end, domains[corner.near].corner(corner.corner), corner.side).gap;
		records.push_back({ corner.point, corner.corner, corner.body, anew - gap, false, false, gap });
	}
	system_.loads.assign(system_.owners.size(), {});
	system_.work  = 0;
	system_.given = std::isfinite(system_.energy) ? given(d) : 0;
	forTouching(d, [&](const Corner& corner, const Vec<Dim>& x, double gap, const Touch<Dim>& touched) {
		auto& r   = records[&corner - corners_.data()];
		r.touches = true, r.slips = touched.slips, r.gap = gap, r.place = x;
		r.pressure = touched.pressure, r.friction = touched.friction, r.normal = touched.normal;
		system_.work += touched.force().dot(corner.attached.displacement(d));
		const int    owner = system_.bodies[corner.body].owner;
		const auto   load  = loadOn(system_.owners[owner], corner, x, touched);
		ContactLoad& sum   = system_.loads[owner];
		sum.force += load.force, sum.torque += load.torque, sum.stiffness += load.stiffness;
	});
	const auto isNothing = [](const auto& r) { return !r.touches && r.offset == 0; };
	records.erase(std::remove_if(records.begin(), records.end(), isNothing), records.end());
	system_.records = std::move(records);
	for (auto& body : system_.bodies)
		body.isNew = false;
}

template class Contact<2>;
template class Contact<3>;

} // namespace gimpm
