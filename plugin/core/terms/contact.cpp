// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact.hpp"
#include "core/terms/attached.hpp"
#include <Eigen/Geometry>
#include <algorithm>
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
	find(step);
	for (int i = 0; i < int(near_.size()); ++i) {
		const auto&    body   = system.bodies[near_[i].body];
		const Vec<Dim> centre = near_[i].domain.centre();
		if (body.isNew && body.proximity(body.begin, centre, near_[i].side).gap < 0) // of a two-sided surface it never is
			obstacle_ = textAt(body, " has the middle of a material point inside of it", centre);
		addCorners(i);
	}
	std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) {
		return std::tie(a.point, a.corner, a.body) < std::tie(b.point, b.corner, b.body);
	});
	for (const Corner& corner : corners_)
		isSymmetric_ = isSymmetric_ && (corner.law.friction == 0 || corner.law.cap == 0);
}

template <int Dim> void Contact<Dim>::find(const Beginning<Dim>& step)
{
	for (const auto& [body, point, side] : nearPoints(system_.bodies, cloud_, basis_, grid_)) {
		if (division_ && point >= division_->own()) continue; // the process that has it tells of it
		const auto [volume, young] = step.stiffnessOf(point);
		own_.push_back(point);
		near_.push_back({ body, division_ ? int(division_->idOf(point)) : point, side, { cloud_, point }, volume, young });
	}
	if (division_) near_ = joined(*division_->processes, near_);
}

template <int Dim> std::vector<PointDomain<Dim>> Contact<Dim>::domainsNow() const
{
	std::vector<PointDomain<Dim>> domains;
	for (const int p : own_)
		domains.emplace_back(cloud_, p);
	return division_ ? joined(*division_->processes, domains) : domains;
}

template <int Dim> void Contact<Dim>::addCorners(int number)
{
	const Near&  near  = near_[number];
	const auto&  body  = system_.bodies[near.body];
	const double reach = searchReach(body, grid_.size(grid_.refinement ? grid_.refinement->largest() : 0));
	for (int c = 0; c < 1 << Dim; ++c) {
		const Vec<Dim>       place = near.domain.corner(c);
		const Proximity<Dim> at    = body.proximity(body.begin, place, near.side);
		if (std::max(at.gap, at.beside) > reach) continue;
		const auto attached = attach(place, basis_, grid_);
		if (!attached) continue; // behind a wall
		const auto*    record   = recordOf(system_.records, { near.point, c, near.body });
		const double   offset   = record ? record->offset : body.isNew && at.beside < 0 ? std::min(0., at.gap) : 0;
		const Vec<Dim> friction = record ? record->friction : Vec<Dim>(Vec<Dim>::Zero());
		corners_.push_back({ near.point, c, near.body, near.side, number, place, offset, friction, lawOf(body, near, place, at.normal), *attached });
	}
}

/// The area of a corner is its share of the domain's outline as seen along the normal, in axisymmetry of the ring through the corner.
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
	return a;
}

/// Of sheets that a corner is behind those count which it is straight behind, of several in one plane the first. Behind an edge between sheets, and so beside
/// all of them, it is the one that it is least beside.
template <int Dim> template <class F> void Contact<Dim>::forTouching(const Eigen::VectorXd& d, F&& f) const
{
	const double margin = 0.1 * grid_.cellSize;
	for (auto first = corners_.begin(), last = first; first != corners_.end(); first = last) {
		const Vec<Dim>        x = first->place + first->attached.displacement(d);
		std::vector<Vec<Dim>> normals; // of sheets that count
		const Corner*         beside = nullptr;
		double                least  = margin;
		const auto            tell   = [&](const Corner& corner, const Approach<Dim>& approach) {
                        if (const auto touched = touch(corner.law, approach, tolerance_)) f(corner, x, approach.at.gap, *touched);
		};
		for (; last != corners_.end() && last->point == first->point && last->corner == first->corner; ++last) {
			const Approach<Dim>   near = approach(*last, x);
			const Proximity<Dim>& at   = near.at;
			if (system_.bodies[last->body].shape.kind != RigidKind::sheet) {
				tell(*last, near);
				continue;
			}
			if (at.gap > tolerance_ || at.beside > margin) continue;
			if (at.beside > 0 && at.beside < least) beside = &*last, least = at.beside;
			if (at.beside > 0 || std::any_of(normals.begin(), normals.end(), [&](const Vec<Dim>& n) { return n.dot(at.normal) > 0.99; })) continue;
			normals.push_back(at.normal);
			tell(*last, near);
		}
		if (beside && normals.empty()) tell(*beside, approach(*beside, x));
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

/// Where soil touches as the step begins, and where it would touch bodies that have moved if it stayed. Whether it then slips or comes off is for the iterations to find.
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
			if (at.gap - corner.offset <= tolerance_) holds(corner, at.normal); // otherwise it has been put elsewhere
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

/// A whole domain inside, or a corner that has come through; or the middle of a point on the other side of a surface that soil may touch from both: there it
/// would not be known again.
template <int Dim> std::string Contact<Dim>::refusal(const Eigen::VectorXd& d) const
{
	std::string found;
	forTouching(d, [&](const Corner& corner, const Vec<Dim>& x, double gap, const Touch<Dim>& touched) {
		if (gap < -2 * touched.normal.cwiseAbs().dot(near_[corner.near].domain.half()))
			found = textAt(system_.bodies[corner.body], " would get a whole material point inside of it", x);
	});
	for (const Corner& corner : corners_) {
		const auto&    body = system_.bodies[corner.body];
		const Vec<Dim> x    = corner.place + corner.attached.displacement(d);
		if (body.isCrossed(corner.place, x)) found = textAt(body, " would let soil through, as it moves too far in a step for its thickness", x);
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
	return found;
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
		records.push_back({ corner.point, corner.corner, corner.body, anew - gap });
	}
	system_.loads.assign(system_.owners.size(), {});
	system_.work = 0;
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
