// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact.hpp"
#include "core/terms/attached.hpp"
#include "core/terms/contact/contact_fine.hpp"
#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace gimpm {
namespace {

template <int Dim> std::string textAt(const RigidBody<Dim>& body, const char* what, const Vec<Dim>& x)
{
	std::ostringstream text;
	text << body.name << what << ", at (" << x.transpose() << ")";
	return text.str();
}

/// Soil that gets deeper into a body than this in a step has not been stopped by it, over the size of a cell.
constexpr double deepest = 0.1;

/// Soil that moves through the grid by less than this part of its slip is at rest: the body slides along it.
constexpr double leastMotion = 0.05;

/// In the springs of a contact point on gap and slip [J].
template <int Dim> double stored(const ContactLaw<Dim>& law, double normalForce, double tangentialForce)
{
	return law.normalStiffness > 0 ? (normalForce * normalForce / law.normalStiffness + tangentialForce * tangentialForce / law.tangentialStiffness) / 2
	                               : 0;
}

/// A body keeps the contact points with which it has touched.
template <int Dim> bool isFineOn(const ContactSystem<Dim>& system, int body, double cellSize)
{
	if (!mayHaveFinePoints(system.bodies[body].shape, cellSize)) return false;
	const auto record = std::find_if(system.records.begin(), system.records.end(), [&](const auto& r) { return r.body == body; });
	if (record == system.records.end()) return system.kind == StepKind::dynamic;
	return record->number % (std::int64_t(1) << contactPointBits) >= firstFineNumber;
}

/// A point whose centre is in a body.
template <int Dim> struct Inside {
	Vec<Dim> centre, half, outward; ///< domain; normal of the body's surface closest to its centre
	double   gap;                   ///< gap of the centre, < 0 [m]

	/// True if it is in front of a contact point, or rather behind it, as in SoilNear.
	bool isAt(const Vec<Dim>& position, const Vec<Dim>& normal, double cellSize) const
	{
		const Vec<Dim> away = centre - position, beside = away - away.dot(normal) * normal;
		return outward.dot(normal) > 0.7 && (beside.cwiseAbs().array() <= half.array() + cellSize / 4).all();
	}
};

template <int Dim> bool isInPeriod(const Vec<Dim>& position, const Grid<Dim>& grid)
{
	for (int a = 0; a < Dim; ++a) {
		const double from = position[a] - grid.origin[a];
		if (grid.period[a] > 0 && !(from >= 0 && from < grid.cellSize * grid.period[a])) return false;
	}
	return true;
}

} // namespace

template <int Dim>
Contact<Dim>::Contact(ContactSystem<Dim>& system, const StepContext<Dim>& step)
        : system_(system)
        , tolerance_(1e-9 * step.grid.cellSize)
        , isRing_(step.grid.axisymmetric)
        , cloud_(step.cloud)
        , basis_(step.basis)
        , grid_(step.grid)
        , dofs_(step.dofs)
        , division_(step.division)
{
	system.acting = this;
	takeSides();
	find(step);
	for (int body = 0; body < int(system.bodies.size()); ++body) {
		checkOverlap(body);
		addContactPoints(body);
	}
	for (int body = 0; body < int(system.bodies.size()); ++body)
		widen(body);
	if (system_.kind == StepKind::dynamic) findLost();
	spreadPressure();
	for (const ContactPoint& contactPoint : contactPoints_)
		isSymmetric_ = isSymmetric_ && (contactPoint.law.frictionCoefficient == 0 || contactPoint.law.cap == 0);
}

/// Between nodes soil is straight, so that the centre of a point may get behind a facet by a little, as at the tip of a
/// cone. Where soil touches on one side alone, as at a closed mesh, that is no passage, and the facet is like a face of
/// a Box. Soil in sight of the other side counts only where nothing touches: at edges it is that of a neighbour.
template <int Dim> void Contact<Dim>::takeSides()
{
	for (auto& body : system_.bodies)
		body.soilSide = 0, body.slack = deepest * grid_.cellSize;
	for (auto first = system_.records.begin(), last = first; first != system_.records.end(); first = last) {
		last                 = std::find_if(first, system_.records.end(), [&](const auto& r) { return r.body != first->body; });
		const bool isTouched = std::any_of(first, last, [](const auto& r) { return r.touches; });
		const auto isOn
		        = [&](int odd) { return std::any_of(first, last, [&](const auto& r) { return r.number % 2 == odd && (r.touches || !isTouched); }); };
		if (isOn(0) != isOn(1)) system_.bodies[first->body].soilSide = isOn(0) ? 1 : -1;
	}
}

template <int Dim> void Contact<Dim>::find(const StepContext<Dim>& step)
{
	for (const auto& [body, point, side] : nearPoints(system_.bodies, cloud_, basis_, grid_)) {
		if (point >= division_.ownOf(cloud_.size())) continue; // the process that has it tells of it
		Near near { body, side, cloud_.layerOf(point), {}, {}, step.stiffnessOf(point).modulus };
		std::copy_n(cloud_.position[point].data(), Dim, near.position.data());
		std::copy_n(cloud_.halfSize[point].data(), Dim, near.halfSize.data());
		near_.push_back(near);
	}
	near_ = division_.joined(std::move(near_));
	std::stable_sort(near_.begin(), near_.end(), [](const Near& a, const Near& b) { return a.body < b.body; });
}

template <int Dim> auto Contact<Dim>::nearTo(int body) const
{
	const auto first = std::lower_bound(near_.begin(), near_.end(), body, [](const Near& near, int b) { return near.body < b; });
	return std::pair(first, std::find_if(first, near_.end(), [&](const Near& near) { return near.body != body; }));
}

/// Checks the overlap of a body with the soil near it, and says what cannot be computed.
template <int Dim> void Contact<Dim>::checkOverlap(int number)
{
	const auto& body         = system_.bodies[number];
	const auto [first, last] = nearTo(number);
	const bool isThin        = body.nodes > 0 && body.thickness() < grid_.cellSize / 2;
	const bool isPlain       = body.shape.kind == RigidKind::ball && (body.frictionCoefficient == 0 || body.adhesion == 0);
	if (first != last && body.turn > 1 && !isPlain) {
		std::ostringstream text;
		text << body.name << " turns by " << body.turn
		     << " rad from one load step to the next; soil near it can follow 1 rad: decrease angVel, O.dt or iterPeriod";
		obstacle_ = text.str();
	}
	for (auto near = first; body.isNew && near != last; ++near) // No point is inside of a two-sided surface.
		if (body.proximity(body.begin, near->centre(), near->side).gap < 0 && !isThin)
			obstacle_ = textAt(body, " has the middle of a material point inside of it", near->centre())
			        + ": let it begin beside the soil, or leave its place out of the region that is filled, as pack.inAlignedBox(...) - pack.inSphere(...)";
}

/// Each body of points for itself.
template <int Dim> void Contact<Dim>::addContactPoints(int number)
{
	const auto [first, last] = nearTo(number);
	std::vector<int> layers;
	for (auto near = first; near != last; ++near)
		if (std::find(layers.begin(), layers.end(), near->layer) == layers.end()) layers.push_back(near->layer);
	for (const int layer : layers)
		if (layer < layersOfContactPoints) addContactPoints(number, layer);
		else
			obstacle_ = system_.bodies[number].name
			        + " is near a body of points that is one of more than four of which each meets each other; it can touch four of them";
}

template <int Dim> void Contact<Dim>::addContactPoints(int number, int layer)
{
	const auto& body         = system_.bodies[number];
	const auto [first, last] = nearTo(number);
	std::vector<SoilDomain<Dim>> domains;
	std::vector<Inside<Dim>>     inside;
	for (auto near = first; near != last; ++near) {
		if (near->layer != layer) continue;
		const Proximity<Dim> closest = body.proximity(body.begin, near->centre(), near->side);
		domains.push_back({ near->centre(), near->half(), near->young, closest.normal });
		if (closest.gap < 0) inside.push_back({ near->centre(), near->half(), closest.normal, closest.gap });
	}
	// In statics centres that have got into the body are moved out slowly, also where soil does not slide, as
	// recall() does where it does: they get in on their way through the grid, be it with the body.
	const auto moveOut = [&](ContactPoint& contactPoint) {
		const auto* record = recordOf(contactPoint);
		if (inside.empty() || system_.kind == StepKind::dynamic || body.free >= 0 || body.nodes > 0 || !record || !record->touches || record->gap >= 0)
			return;
		const Vec<Dim> normal = body.begin.rotation * body.end.rotation.transpose() * contactPoint.normal;
		double         lowest = contactPoint.gap;
		for (const auto& point : inside)
			if (point.isAt(contactPoint.soil, normal, grid_.cellSize)) lowest = std::min(lowest, point.gap);
		const auto share = [&](double way) { return std::min(0.1, way / grid_.cellSize); };
		contactPoint.gap += std::max(0., share(contactPoint.carried.norm()) - share(record->travel)) * (lowest - contactPoint.gap);
	};
	const SoilNear<Dim> soil(std::move(domains), grid_.cellSize);
	const auto [low, high]        = soil.bounds();
	const Vec<Dim>         margin = Vec<Dim>::Constant(grid_.cellSize + searchReach(body, grid_));
	const std::vector<int> around = bodiesAround(number);
	const bool             isFine = isFineOn(system_, number, grid_.cellSize);
	for (const auto& point : (isFine ? finePointsAt<Dim> : surfacePointsAt<Dim>)(body.shape, body.begin, grid_.cellSize, low - margin, high + margin)) {
		const std::size_t count = contactPoints_.size();
		addContactPoint(number, layer, point, soil, around);
		if (contactPoints_.size() > count) moveOut(contactPoints_.back());
	}
}

template <int Dim> const ContactRecord<Dim>* Contact<Dim>::recordOf(const ContactPoint& contactPoint) const
{
	const auto isBefore = [](const ContactRecord<Dim>& r, const ContactPoint& p) { return std::tie(r.body, r.number) < std::tie(p.body, p.number); };
	const auto found    = std::lower_bound(system_.records.begin(), system_.records.end(), contactPoint, isBefore);
	return found != system_.records.end() && found->body == contactPoint.body && found->number == contactPoint.number ? &*found : nullptr;
}

template <int Dim>
void Contact<Dim>::addContactPoint(int number, int layer, const SurfacePoint<Dim>& point, const SoilNear<Dim>& soil, const std::vector<int>& around)
{
	const auto&    body   = system_.bodies[number];
	const Vec<Dim> onBody = body.begin.inSpace(point.position), normal = body.begin.rotation * point.normal;
	if ((isRing_ && onBody[0] <= 0) || !isInPeriod(onBody, grid_)) return;
	const auto screens = screensBefore(onBody, around);
	const auto hides   = [&](const Vec<Dim>& centre) { return isBehind(screens, onBody, centre); };
	const auto sight   = soil.from(onBody, normal, searchReach(body, grid_), screens.empty() ? typename SoilNear<Dim>::Hides() : hides);
	if (!sight || isHidden(number, onBody, normal, around)) return;
	ContactPoint made;
	made.body = number, made.number = point.number | std::int64_t(layer) << contactPointBits;
	made.away = made.gap = std::max(0., sight->gap);
	made.soil            = onBody + made.away * normal;
	made.normal          = (body.free < 0 ? body.end : body.begin).rotation * point.normal;
	made.areaFraction    = sight->areaFraction;
	const auto* record   = recordOf(made);
	// Domains turn and stretch; but soil that presses goes no faster than it slides, a quarter of a cell from being
	// there in full to not being there.
	if (record && record->touches) made.areaFraction = std::max(made.areaFraction, record->areaFraction - 4 * record->travel / grid_.cellSize);
	if (made.areaFraction <= 0) return;
	// Pressed soil begins inside of the body: at its face even pressure would not balance even stress.
	if (record && record->touches && record->gap < 0) made.soil = onBody + record->gap * normal;
	const Vec<Dim> beside   = made.soil + body.begin.rotation * point.aside;
	auto           attached = attach(beside, basis_, grid_, layer);
	if (attached) made.soil = beside;
	else
		attached = attach(made.soil, basis_, grid_, layer); // at an end of the soil
	if (!attached) return;                                      // behind a wall
	made.attached        = *attached;
	made.distribution    = ForceDistribution<Dim>(*attached);
	made.away            = body.proximity(body.begin, made.soil, 1).gap; // found as at the end: no gap by round-off
	made.carried         = body.carried(made.soil);
	made.area            = made.areaFraction * point.area * (isRing_ ? 2 * M_PI * onBody[0] : 1);
	made.young           = sight->young;
	const double penalty = body.stiffness * made.young * made.area / grid_.cellSize;
	made.law             = { penalty, penalty / slipSoftness, body.frictionCoefficient, body.adhesion * made.area };
	if (record) recall(made, *record, sight->gap);
	contactPoints_.push_back(made);
}

/// Recalls a record: what pressed stays pressed, wherever domains are seen now. Soil that slides through the grid
/// follows its domains slowly, so that it does not creep in; in time steps that would be work of nobody. Soil at rest,
/// along which the body slides, does not creep in, and its domains are a staircase that says nothing of its pressure.
template <int Dim> void Contact<Dim>::recall(ContactPoint& contactPoint, const ContactRecord<Dim>& record, double seen) const
{
	const auto& body = system_.bodies[contactPoint.body];
	contactPoint.tangentialForce
	        = body.free < 0 ? Vec<Dim>(body.end.rotation * body.begin.rotation.transpose() * record.tangentialForce) : record.tangentialForce;
	if (!record.touches || record.gap >= 0) return;
	// A stiffer spring has the force that the softer one had: it has been given no energy.
	contactPoint.gap    = std::max(record.gap, -record.normalForce / contactPoint.law.normalStiffness);
	const double creeps = system_.kind == StepKind::dynamic ? 0 : std::min(0.1, record.creep / grid_.cellSize);
	contactPoint.gap += creeps * std::min(0., seen - contactPoint.gap);
}

/// Gap and slip by the contact point's own face, which has no end; so a round one keeps soil that slides around it.
template <int Dim> Approach<Dim> Contact<Dim>::approach(const ContactPoint& contactPoint, const Eigen::VectorXd& d) const
{
	const auto&    body = system_.bodies[contactPoint.body];
	const Vec<Dim> u    = contactPoint.distribution.displacement(d);
	const Moved    now  = moved(contactPoint);
	Approach<Dim>  a { {}, u - now.carried, Mat<Dim>::Identity(), now.tangentialForce };
	if (body.shape.kind == RigidKind::ball && system_.kind != StepKind::dynamic) {
		a.at = body.proximity(body.end, contactPoint.soil + u, 1);
		a.at.gap += contactPoint.gap - contactPoint.away;
	} else {
		a.at.gap    = contactPoint.gap + now.normal.dot(a.slip);
		a.at.normal = now.normal;
	}
	return a;
}

template <int Dim> template <class F> void Contact<Dim>::forTouching(const Eigen::VectorXd& d, F&& f)
{
	solveRigidBodyMotion(d);
	for (const ContactPoint& contactPoint : contactPoints_) {
		const Approach<Dim> near = approach(contactPoint, d);
		if (const auto touched = touch(contactPoint.law, near, tolerance_)) f(contactPoint, near, *touched);
	}
}

template <int Dim> void Contact<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (const ContactPoint& contactPoint : contactPoints_)
		markAttached<Dim>(contactPoint.distribution, contactPoint.distribution, K);
}

template <int Dim> std::optional<PointFailure> Contact<Dim>::add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum)
{
	forTouching(d, [&](const ContactPoint& contactPoint, const Approach<Dim>&, const Touch<Dim>& touched) {
		addAttachedForce<Dim>(contactPoint.distribution, system_.weight * touched.force(), sum);
		if (sum.K) addAttachedStiffness<Dim>(contactPoint.distribution, contactPoint.distribution, system_.weight * touched.tangent, *sum.K);
	});
	return std::nullopt;
}

template <int Dim> void Contact<Dim>::addBefore(Eigen::VectorXd& force)
{
	const auto add = [&](const ForceDistribution<Dim>& at, const ContactRecord<Dim>& r) {
		addAttachedForce<Dim>(at, r.normalForce * r.normal + r.tangentialForce, { force });
	};
	for (const ContactPoint& contactPoint : contactPoints_)
		if (const auto* r = recordOf(contactPoint); r && r->touches) add(contactPoint.distribution, *r);
	for (const auto& [attached, record] : lost_)
		add(ForceDistribution<Dim>(attached), system_.records[record]);
}

/// Contact points that touched and have no soil in front of them any more, as where it leaps off: in a time step
/// their forces have to be known to begin with, or the soil keeps half of them for another step, and what a body has
/// got is not what the soil has lost.
template <int Dim> void Contact<Dim>::findLost()
{
	std::vector<bool> isMet(system_.records.size(), false);
	for (const ContactPoint& contactPoint : contactPoints_)
		if (const auto* r = recordOf(contactPoint)) isMet[r - system_.records.data()] = true;
	for (std::size_t i = 0; i < isMet.size(); ++i) {
		const auto&                    r = system_.records[i];
		std::optional<Attachment<Dim>> attached;
		for (int quarter = 0; quarter <= 4 && !attached && !isMet[i] && r.touches; ++quarter) // deeper in the soil, where its face has no nodes
			attached = attach(Vec<Dim>(r.position + 0.25 * quarter * grid_.cellSize * r.normal), basis_, grid_, int(r.number >> contactPointBits));
		if (attached) lost_.emplace_back(*attached, i);
	}
}

/// Constrains where soil touches as the step begins, and where it would touch bodies that have moved if it stayed. The
/// iterations find whether it then slips or comes off.
template <int Dim> void Contact<Dim>::restrain(const typename Term<Dim>::Constrain& constrain)
{
	const auto constrains = [&](const ContactPoint& contactPoint) {
		if (system_.bodies[contactPoint.body].free >= 0) return; // it yields
		const bool     sticks = contactPoint.law.frictionCoefficient > 0 && contactPoint.law.cap > 0;
		const Vec<Dim> inCell = contactPoint.attached.inCell();
		constrain(contactPoint.attached.node[0], contactPoint.normal, inCell);
		for (int a = 0; sticks && a < Dim; ++a)
			constrain(contactPoint.attached.node[0], Vec<Dim>::Unit(a), inCell);
	};
	for (const ContactPoint& contactPoint : contactPoints_)
		if (contactPoint.gap <= tolerance_) constrains(contactPoint);
	const Eigen::VectorXd none = Eigen::VectorXd::Zero(Dim * Eigen::Index(basis_.nodes.size()));
	forTouching(none, [&](const ContactPoint& contactPoint, const Approach<Dim>&, const Touch<Dim>&) { constrains(contactPoint); });
}

template <int Dim> void Contact<Dim>::restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Constrain& constrain)
{
	forTouching(d, [&](const ContactPoint& contactPoint, const Approach<Dim>&, const Touch<Dim>& touched) {
		if (system_.bodies[contactPoint.body].free >= 0) return;
		const bool     sticks = contactPoint.law.frictionCoefficient > 0 && contactPoint.law.cap > 0 && !touched.slips;
		const Vec<Dim> inCell = contactPoint.attached.inCell();
		constrain(contactPoint.attached.node[0], contactPoint.normal, inCell);
		for (int a = 0; sticks && a < Dim; ++a)
			constrain(contactPoint.attached.node[0], Vec<Dim>::Unit(a), inCell);
	});
}

/// Distance [cells] of a centre from a sheet below which it lies on it.
constexpr double littleGap         = 1e-3;
constexpr char   whereSoilBegins[] = "; the middle of that point lay on the body as the step began";

/// The centre of a point that ends inside of a body, or on another side of it.
template <int Dim> Refusal Contact<Dim>::refusal(const Eigen::VectorXd& d)
{
	solveRigidBodyMotion(d);
	if (const std::string falls = unbalanced(); !falls.empty())
		return {
			Failure::refused, falls,
			"What nothing holds has no equilibrium: let it touch the soil as it begins, hold it by blockedDOFs or friction, or take MpmDynamicEngine, where its inertia does."
		};
	const std::string found = division_.firstSaid(entered(d));
	if (found.empty()) return {};
	return { Failure::penetrated, found,
		 found.find(whereSoilBegins) == std::string::npos
		         ? "Smaller load steps (O.dt), or a larger stiffness of MpmContact, may help."
		         : "Lift the soil, or lower the body, by half the size of a point, so that all middles are on one side." };
}

/// Soil farther from a body than it is looked for may move as far as that and more.
template <int Dim> std::string Contact<Dim>::entered(const Eigen::VectorXd& d)
{
	double most        = d.size() > 0 ? Eigen::Map<const Eigen::Matrix<double, Dim, -1>>(d.data(), Dim, d.size() / Dim).colwise().norm().maxCoeff() : 0;
	most               = division_.largest(most);
	const double depth = deepest * grid_.cellSize;
	for (const NearPoint& near : nearPoints(system_.bodies, cloud_, basis_, grid_, most)) {
		if (near.point >= division_.ownOf(cloud_.size())) continue;
		const auto&    body     = system_.bodies[near.body];
		const Vec<Dim> centre   = cloud_.position[near.point];
		const auto     attached = attach(centre, basis_, grid_, cloud_.layerOf(near.point));
		if (!attached) continue;
		const Vec<Dim>       u = attached->displacement(d), x = centre + u;
		const Proximity<Dim> before = body.proximity(body.begin, centre, near.side), after = body.proximity(body.end, x, near.side);
		const double         deeper = before.gap - after.gap, behind = near.side == body.soilSide ? body.slack : 0;
		// Soil may get to a sheet from where it has not been looked for, and would be on both sides of it then.
		const double side     = after.gap - after.normal.cwiseAbs().dot(cloud_.halfSize[near.point]);
		const bool   isUnseen = side < -depth && deeper > searchReach(body, grid_) && before.gap >= 0;
		const bool   isThrough
		        = body.shape.isTwoSided ? (after.gap + body.halfThickness() < -behind || isUnseen) && after.beside < 0 : body.isCrossed(centre, x);
		const bool isInside = !body.shape.isTwoSided && -depth > after.gap && deeper > (-5 * depth > after.gap ? 0 : depth / 2);
		if (!isThrough && !isInside) continue;
		std::ostringstream text;
		text << (isThrough ? " would let soil through" : " would get soil inside of it") << ", which moves " << u.norm()
		     << " m in the step, and the body up to " << body.motion() << " m";
		if (body.shape.isTwoSided && before.gap + body.halfThickness() < littleGap * grid_.cellSize) text << whereSoilBegins;
		return textAt(body, text.str().c_str(), x);
	}
	return {};
}

/// Work on the soil as seen from the bodies, beyond what the springs had stored. As their energy is convex in the gap,
/// it is never above zero. They follow the moduli of the soil from step to step: what they have stored is that of the
/// stiffness that they have now, as no length of the step changes that.
template <int Dim> double Contact<Dim>::energyGain(const Eigen::VectorXd& d)
{
	double sum = 0;
	for (const ContactPoint& contactPoint : contactPoints_)
		if (const auto* r = recordOf(contactPoint); r && r->touches)
			sum -= stored(contactPoint.law, std::max(0., -contactPoint.law.normalStiffness * contactPoint.gap), r->tangentialForce.norm());
	forTouching(d, [&](const ContactPoint& contactPoint, const Approach<Dim>& near, const Touch<Dim>& touched) {
		sum += touched.force().dot(near.slip) + stored(contactPoint.law, touched.normalForce, touched.tangentialForce.norm());
	});
	return sum;
}

/// Turns the contact points by the mean slip of those that are pressed.
template <int Dim> void Contact<Dim>::turnContactPoints(const Eigen::VectorXd& d)
{
	std::vector<Mat<Dim>> turns(system_.bodies.size(), Mat<Dim>::Zero());
	std::vector<double>   pressed(system_.bodies.size(), 0);
	forTouching(d, [&](const ContactPoint& contactPoint, const Approach<Dim>& near, const Touch<Dim>& touched) {
		const Vec<Dim>& n = touched.normal;
		turns[contactPoint.body] += touched.normalForce * (near.slip * n.transpose() - n * near.slip.transpose());
		pressed[contactPoint.body] += touched.normalForce;
	});
	for (std::size_t i = 0; i < turns.size(); ++i) {
		auto& body = system_.bodies[i];
		if (body.shape.kind != RigidKind::ball || !(pressed[i] > 0)) continue;
		const Mat<Dim>& rotation = body.end.rotation;
		const Mat<Dim>  half     = rotation.transpose() * turns[i] * rotation / (2 * body.shape.radius * pressed[i]);
		// Cayley's formula has a rotation of a skew matrix.
		body.shape.axes = (Mat<Dim>::Identity() - half).inverse() * (Mat<Dim>::Identity() + half) * body.shape.axes;
	}
}

template <int Dim> void Contact<Dim>::commit(const Eigen::VectorXd& d)
{
	std::vector<ContactRecord<Dim>> records;
	solveRigidBodyMotion(d);
	for (const ContactPoint& contactPoint : contactPoints_) {
		const Approach<Dim> near = approach(contactPoint, d);
		const Vec<Dim>      u = contactPoint.distribution.displacement(d), along = near.slip - near.slip.dot(near.at.normal) * near.at.normal;
		const double        travel = along.norm(), creep = u.norm() > leastMotion * travel ? travel : 0;
		records.push_back({ contactPoint.body, contactPoint.number, near.at.gap, false, false, 0, contactPoint.areaFraction, travel, creep,
		                    Vec<Dim>::Zero(), near.at.normal, contactPoint.soil + u });
	}
	system_.loads.assign(system_.owners.size(), {});
	system_.work       = 0;
	system_.energyGain = system_.kind == StepKind::dynamic ? energyGain(d) : 0;
	forTouching(d, [&](const ContactPoint& contactPoint, const Approach<Dim>&, const Touch<Dim>& touched) {
		auto& r   = records[&contactPoint - contactPoints_.data()];
		r.touches = true, r.slips = touched.slips, r.normalForce = touched.normalForce, r.tangentialForce = touched.tangentialForce;
		system_.work += touched.force().dot(contactPoint.distribution.displacement(d));
		addLoads(contactPoint, r.position, touched);
	});
	if (system_.kind == StepKind::dynamic && !isRing_) turnContactPoints(d);
	system_.records = std::move(records);
	std::stable_sort(system_.records.begin(), system_.records.end(), [](const auto& a, const auto& b) {
		return std::tie(a.body, a.number) < std::tie(b.body, b.number);
	});
	for (auto& body : system_.bodies)
		body.isNew = false;
}

template class Contact<2>;
template class Contact<3>;

} // namespace gimpm
