// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/attached.hpp"
#include "core/terms/contact/near_points.hpp"

namespace gimpm {
namespace {

/// Soil that moves through the grid by less than this part of its slip is at rest: the body slides along it.
constexpr double leastMotion = 0.05;

/// Distance [cells] of a centre from a sheet below which it lies on it.
constexpr double littleGap         = 1e-3;
constexpr char   whereSoilBegins[] = "; the middle of that point lay on the body as the step began";

/// Work on the soil as seen from the bodies, beyond what the springs had stored. As their energy is convex in the gap,
/// it is never above zero. They follow the moduli of the soil from step to step: what they have stored is that of the
/// stiffness that they have now, as no length of the step changes that.
template <int Dim>
double gainOfEnergy(
        const ContactSystem<Dim>& system, const std::vector<ContactPoint<Dim>>& points, ContactKinematics<Dim>& kinematics, const Eigen::VectorXd& d)
{
	double sum = 0;
	for (const auto& point : points)
		if (const auto* r = system.recordOf(point); r && r->touches)
			sum -= point.law.stored(point.law.normalForce(point.gap), r->tangentialForce.norm());
	kinematics.forTouching(d, [&](const auto& point, const Approach<Dim>& near, const Touch<Dim>& touched) {
		sum += touched.force().dot(near.slip) + point.law.stored(touched.normalForce, touched.tangentialForce.norm());
	});
	return sum;
}

/// Turns the contact points by the mean slip of those that are pressed.
template <int Dim> void turnContactPoints(ContactSystem<Dim>& system, ContactKinematics<Dim>& kinematics, const Eigen::VectorXd& d)
{
	std::vector<Mat<Dim>> turns(system.bodies.size(), Mat<Dim>::Zero());
	std::vector<double>   pressed(system.bodies.size(), 0);
	kinematics.forTouching(d, [&](const auto& point, const Approach<Dim>& near, const Touch<Dim>& touched) {
		const Vec<Dim>& n = touched.normal;
		turns[point.body] += touched.normalForce * (near.slip * n.transpose() - n * near.slip.transpose());
		pressed[point.body] += touched.normalForce;
	});
	for (std::size_t i = 0; i < turns.size(); ++i) {
		auto& body = system.bodies[i];
		if (body.shape.kind != RigidKind::ball || !(pressed[i] > 0)) continue;
		const Mat<Dim>& rotation = body.end.rotation;
		const Mat<Dim>  half     = rotation.transpose() * turns[i] * rotation / (2 * body.shape.radius * pressed[i]);
		// Cayley's formula has a rotation of a skew matrix.
		body.shape.axes = (Mat<Dim>::Identity() - half).inverse() * (Mat<Dim>::Identity() + half) * body.shape.axes;
	}
}

} // namespace

template <int Dim>
Contact<Dim>::Contact(ContactSystem<Dim>& system, const StepContext<Dim>& step)
        : system_(system), step_(step), found_(findContactPoints(system, step)), kinematics_(system, found_.points, step.grid)
{
	system.acting = this;
}

template <int Dim> bool Contact<Dim>::isSymmetric() const
{
	return std::all_of(found_.points.begin(), found_.points.end(), [](const auto& point) { return point.law.isSmooth(); });
}

template <int Dim> void Contact<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (const auto& point : found_.points)
		markAttached<Dim>(point.distribution, point.distribution, K);
}

template <int Dim> std::optional<PointFailure> Contact<Dim>::add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum)
{
	kinematics_.forTouching(d, [&](const auto& point, const auto&, const Touch<Dim>& touched) {
		addAttachedForce<Dim>(point.distribution, system_.weight * touched.force(), sum);
		if (sum.K) addAttachedStiffness<Dim>(point.distribution, point.distribution, system_.weight * touched.tangent, *sum.K);
	});
	return std::nullopt;
}

template <int Dim> void Contact<Dim>::addBefore(Eigen::VectorXd& force)
{
	for (const auto& point : found_.points)
		if (const auto* r = system_.recordOf(point); r && r->touches) addAttachedForce<Dim>(point.distribution, r->force(), { force });
	for (const auto& [attached, record] : found_.lost)
		addAttachedForce<Dim>(attached, system_.records[record].force(), { force });
}

template <int Dim> void Contact<Dim>::addUnweighted(const Eigen::VectorXd* d, Eigen::VectorXd& resistance)
{
	if (!d) return addBefore(resistance);
	Eigen::VectorXd weighted = Eigen::VectorXd::Zero(d->size());
	add(*d, { weighted });
	resistance += weighted / system_.weight;
}

/// Constrains where soil touches as the step begins, and where it would touch bodies that have moved if it stayed. The
/// iterations find whether it then slips or comes off.
template <int Dim> void Contact<Dim>::restrain(const typename Term<Dim>::Constrain& constrain)
{
	for (const auto& point : found_.points)
		if (kinematics_.isTouching(point.gap)) constrainSoil(point, false, constrain);
	const Eigen::VectorXd none = Eigen::VectorXd::Zero(Dim * Eigen::Index(step_.basis.nodes.size()));
	kinematics_.forTouching(none, [&](const auto& point, const auto&, const auto&) { constrainSoil(point, false, constrain); });
}

template <int Dim> void Contact<Dim>::restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Constrain& constrain)
{
	kinematics_.forTouching(d, [&](const auto& point, const auto&, const Touch<Dim>& touched) { constrainSoil(point, touched.slips, constrain); });
}

template <int Dim> void Contact<Dim>::constrainSoil(const ContactPoint<Dim>& point, bool slips, const typename Term<Dim>::Constrain& constrain) const
{
	if (system_.bodies[point.body].free < 0) // else it yields
		constrainAttached<Dim>(point.attached, point.normal, !point.law.isSmooth() && !slips, constrain);
}

/// The centre of a point that ends inside of a body, or on another side of it.
template <int Dim> Refusal Contact<Dim>::refusal(const Eigen::VectorXd& d)
{
	kinematics_.solveRigidBodyMotion(d);
	if (const std::string falls = kinematics_.unbalanced(); !falls.empty())
		return {
			Failure::refused, falls,
			"What nothing holds has no equilibrium: let it touch the soil as it begins, hold it by blockedDOFs or friction, or take MpmDynamicEngine, where its inertia does."
		};
	const std::string found = step_.division.firstSaid(entered(d));
	if (found.empty()) return {};
	return { Failure::penetrated, found,
		 found.find(whereSoilBegins) == std::string::npos
		         ? "Smaller load steps (O.dt), or a larger stiffness of MpmContact, may help."
		         : "Lift the soil, or lower the body, by half the size of a point, so that all middles are on one side." };
}

/// Soil farther from a body than it is looked for may move as far as that and more.
template <int Dim> std::string Contact<Dim>::entered(const Eigen::VectorXd& d) const
{
	double most = d.size() > 0 ? Eigen::Map<const Eigen::Matrix<double, Dim, -1>>(d.data(), Dim, d.size() / Dim).colwise().norm().maxCoeff() : 0;
	most        = step_.division.largest(most);
	for (const NearPoint& near : nearPoints(system_.bodies, step_.cloud, step_.basis, step_.grid, most)) {
		if (near.point >= step_.division.ownOf(step_.cloud.size())) continue;
		const auto&    body     = system_.bodies[near.body];
		const Vec<Dim> centre   = step_.cloud.position[near.point];
		const auto     attached = attach(centre, step_.basis, step_.grid, step_.cloud.layerOf(near.point));
		if (!attached) continue;
		const double         depth = deepestInBody * (step_.grid.isAdaptive ? cellSizeAt(step_.grid, centre) : step_.grid.cellSize);
		const Vec<Dim>       u = attached->displacement(d), x = centre + u;
		const Proximity<Dim> before = body.proximity(body.begin, centre, near.side), after = body.proximity(body.end, x, near.side);
		const double         deeper = before.gap - after.gap, behind = near.side == body.soilSide ? body.slack : 0;
		// Soil may get to a sheet from where it has not been looked for, and would be on both sides of it then.
		const double side     = after.gap - after.normal.cwiseAbs().dot(step_.cloud.halfSize[near.point]);
		const bool   isUnseen = side < -depth && deeper > searchReach(body, step_.grid) && before.gap >= 0;
		const bool   isThrough
		        = body.shape.isTwoSided ? (after.gap + body.halfThickness() < -behind || isUnseen) && after.beside < 0 : body.isCrossed(centre, x);
		const bool isInside = !body.shape.isTwoSided && -depth > after.gap && deeper > (-5 * depth > after.gap ? 0 : depth / 2);
		if (!isThrough && !isInside) continue;
		const bool wasOnBody = body.shape.isTwoSided && before.gap + body.halfThickness() < littleGap * step_.grid.cellSize;
		return sentence(
		        body.name, isThrough ? " would let soil through" : " would get soil inside of it", ", which moves ", u.norm(),
		        " m in the step, and the body up to ", body.motion(), " m", wasOnBody ? whereSoilBegins : "", ", at (", x.transpose(), ")");
	}
	return {};
}

template <int Dim> void Contact<Dim>::commit(const Eigen::VectorXd& d)
{
	std::vector<ContactRecord<Dim>> records;
	kinematics_.solveRigidBodyMotion(d);
	for (const auto& point : found_.points) {
		const Approach<Dim> near = kinematics_.approach(point, d);
		const Vec<Dim>      u = point.distribution.displacement(d), along = near.slip - near.slip.dot(near.at.normal) * near.at.normal;
		const double        travel = along.norm(), creep = u.norm() > leastMotion * travel ? std::min(travel, u.norm()) : 0;
		records.push_back({ point.body, point.number, near.at.gap, false, false, 0, point.areaFraction, travel, creep, Vec<Dim>::Zero(), near.at.normal,
		                    point.soil + u });
	}
	system_.loads.assign(system_.owners.size(), {});
	system_.work       = 0;
	system_.energyGain = system_.kind == StepKind::dynamic ? gainOfEnergy(system_, found_.points, kinematics_, d) : 0;
	system_.friction = system_.penalties = 0;
	kinematics_.forTouching(d, [&](const auto& point, const Approach<Dim>& near, const Touch<Dim>& touched) {
		auto& r   = records[&point - found_.points.data()];
		r.touches = true, r.slips = touched.slips, r.normalForce = touched.normalForce, r.tangentialForce = touched.tangentialForce;
		system_.work += touched.force().dot(point.distribution.displacement(d));
		const double dissipated = dissipation(point.law, near, touched);
		system_.friction += dissipated;
		system_.penalties -= touched.force().dot(near.slip) + dissipated;
		kinematics_.addLoads(point, r.position, touched);
	});
	if (system_.kind == StepKind::dynamic && !step_.grid.axisymmetric) turnContactPoints(system_, kinematics_, d);
	system_.records = std::move(records);
	system_.sortRecords();
	for (auto& body : system_.bodies)
		body.isNew = false;
}

template class Contact<2>;
template class Contact<3>;

} // namespace gimpm
