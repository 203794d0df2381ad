// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/implicit_bodies.hpp"
#include "core/base/sentence.hpp"
#include "engine/conditions/contact/rigid_bodies.hpp"
#include "yade_api/bodies.hpp"

namespace yade {

namespace {
	// Measures of a shape with density one.
	struct Measures {
		Real volume = 0, section = 0, polar = 0; // in space; of the section, and about its middle
	};

	Measures measuresOf(const Shape& shape, bool isRing)
	{
		if (const auto* sphere = dynamic_cast<const Sphere*>(&shape)) {
			const Real r2 = sphere->radius * sphere->radius, volume = 4. / 3 * M_PI * r2 * sphere->radius;
			return { volume, isRing ? volume : M_PI * r2, M_PI / 2 * r2 * r2 };
		}
		const auto* box = dynamic_cast<const Box*>(&shape);
		if (!box) return {};
		const Real x = box->extents[0], y = box->extents[1], section = isRing ? 2 * M_PI * x * x * y : 4 * x * y;
		return { 8 * x * y * box->extents[2], section, 4 * x * y * (x * x + y * y) / 3 };
	}

	vector<shared_ptr<Body>> membersOf(const Body& clump, const Scene& scene)
	{
		const BodiesLock         lock(scene);
		vector<shared_ptr<Body>> members;
		for (size_t id = 0; id < scene.bodies->size(); ++id)
			if (const auto& body = (*scene.bodies)[unsigned(id)]; body && body->isClumpMember() && body->clumpId == clump.id)
				members.push_back(body);
		return members;
	}

	// Inertia in space. In the plane it is about z, along which the own axes of a clump, those of its inertia in
	// space, need not lie.
	template <int Dim> Matrix3r alongAxes(const Se3r& at, const Vector3r& inertia)
	{
		if (Dim == 2) return inertia.asDiagonal();
		const Matrix3r axes = at.orientation.toRotationMatrix();
		return axes * inertia.asDiagonal() * axes.transpose();
	}

	Quaternionr turned(const Vector3r& turn)
	{
		const Real angle = turn.norm();
		return angle > 0 ? Quaternionr(Eigen::AngleAxis<Real>(angle, turn / angle)) : Quaternionr::Identity();
	}

	template <int Dim> struct Unknowns; // in YADE's order of degrees of freedom
	template <> struct Unknowns<2> {
		static constexpr int dofs[3] = { 0, 1, 5 };
	};
	template <> struct Unknowns<3> {
		static constexpr int dofs[6] = { 0, 1, 2, 3, 4, 5 };
	};

	template <int Dim> typename gimpm::FreeBody<Dim>::Vector unknownsOf(const Vector3r& shift, const Vector3r& turn)
	{
		typename gimpm::FreeBody<Dim>::Vector x;
		for (int i = 0; i < x.size(); ++i)
			x[i] = Unknowns<Dim>::dofs[i] < 3 ? shift[Unknowns<Dim>::dofs[i]] : turn[Unknowns<Dim>::dofs[i] - 3];
		return x;
	}
}

template <> MassOfBody massOf(const Body& owner, const Scene&, const gimpm::Grid<3>&) { return { owner.state->mass, owner.state->inertia }; }

template <> MassOfBody massOf(const Body& owner, const Scene& scene, const gimpm::Grid<2>& grid)
{
	Real       volume = 0, section = 0, polar = 0;
	Vector3r   moment = Vector3r::Zero();
	const auto add    = [&](const Body& part) {
                const Measures m    = measuresOf(*part.shape, grid.axisymmetric);
                const Real     rho  = part.material ? part.material->density : 0;
                const Vector3r away = part.state->pos - owner.state->pos;
                volume += rho * m.volume, section += rho * m.section;
                polar += rho * (m.polar + m.section * away.head<2>().squaredNorm());
                moment += rho * m.section * away;
	};
	if (!owner.isClump()) add(owner);
	for (const auto& member : membersOf(owner, scene))
		add(*member);
	if (!(volume > 0))
		throw std::invalid_argument(gimpm::sentence(
		        "Body #", owner.id,
		        " is free to move, but has no mass in the plane: that is known of Spheres and Boxes with a density, and clumps that have some of them. Give it one, or block it (dynamic=False)."));
	const Real size = std::sqrt(polar / section);
	if (!grid.axisymmetric && moment.head<2>().norm() > 1e-6 * section * size)
		throw std::invalid_argument(gimpm::sentence(
		        "Body #", owner.id, ", a clump, has its centre of mass elsewhere in the plane than in space, by ", moment.head<2>().norm() / section,
		        " m: give its members the same extent along z."));
	const Real scale = owner.state->mass / volume; // one, but where the mass was given or members overlap
	return { scale * section, Vector3r(0, 0, scale * polar) };
}

void requireSolvable(const Body& body, const MassOfBody& of, bool isMoved, bool inTime)
{
	const string name = gimpm::sentence("MpmContact.implicit: body #", body.id);
	if (isMoved)
		throw std::invalid_argument(
		        name
		        + " is moved by a NewtonIntegrator, too: give that a mask that leaves it out, as NewtonIntegrator(mask=2), or let YADE move it, with implicit=False.");
	const auto isFree   = [&](unsigned dofs) { return (body.state->blockedDOFs & dofs) != dofs; };
	const bool hasMass  = of.mass > 0 && std::isfinite(of.mass);
	const bool hasTurns = of.inertia.allFinite() && of.inertia[2] > 0;
	if (isFree(State::DOF_X | State::DOF_Y | State::DOF_Z) && !hasMass && (inTime || !(of.mass == 0)))
		throw std::invalid_argument(gimpm::sentence(name, " is free to move, but its mass is ", of.mass, " kg: expected a finite number > 0."));
	if (inTime && isFree(State::DOF_RX | State::DOF_RY | State::DOF_RZ) && !hasTurns)
		throw std::invalid_argument(gimpm::sentence(
		        name, " is free to turn, but its inertia is (", of.inertia.transpose(),
		        ") kg m2: expected finite numbers > 0. Give its material a density, or block its rotations (blockedDOFs='XYZ')."));
	if (!body.state->vel.allFinite() || !body.state->angVel.allFinite()) throw std::invalid_argument(name + " has velocities that are not finite.");
}

Se3r FreeMotion::ahead(Real time, const Vector3r& gravity) const
{
	Vector3r shift = time * velocity, turn = time * spin;
	if (inTime && mass.mass > 0) shift += time * time * part * (gravity + force / mass.mass);
	for (int i = 0; i < 3; ++i) {
		if (given >> i & 1 || !inTime) shift[i] = given >> i & 1 ? time * velocity[i] : 0;
		if (given >> (3 + i) & 1 || !inTime) turn[i] = given >> (3 + i) & 1 ? time * spin[i] : 0;
	}
	return { at.position + shift, (turned(turn) * at.orientation).normalized() };
}

template <int Dim> gimpm::FreeBody<Dim> freeBody(int owner, const FreeMotion& body, Real duration, const Vector3r& gravity, bool isRing)
{
	using Free                         = gimpm::FreeBody<Dim>;
	const Se3r                   ahead = body.ahead(duration, gravity);
	Free                         free { owner, body.at.position.head<Dim>() };
	const Eigen::AngleAxis<Real> turn(ahead.orientation * body.at.orientation.conjugate());
	free.motion       = unknownsOf<Dim>(ahead.position - body.at.position, turn.angle() * turn.axis());
	free.externalLoad = unknownsOf<Dim>(body.force + body.mass.mass * gravity, body.torque);
	for (int i = 0; i < Free::unknowns; ++i)
		free.isGiven[i] = (body.given >> Unknowns<Dim>::dofs[i] & 1) || (isRing && Unknowns<Dim>::dofs[i] != 1);
	if (!body.inTime || duration == 0) return free; // a study knows no inertia
	// The inertia of the middle of the step, where it would be without the soil.
	const Matrix3r before = alongAxes<Dim>(body.at, body.mass.inertia);
	const Matrix3r within = alongAxes<Dim>({ body.at.position, turned(duration / 2 * body.spin) * body.at.orientation }, body.mass.inertia);
	free.externalLoad += 1 / (body.part * duration) * unknownsOf<Dim>(body.mass.mass * body.velocity, before * body.spin);
	for (int i = 0; i < Free::unknowns; ++i)
		for (int j = 0; j < Free::unknowns; ++j) {
			const int a = Unknowns<Dim>::dofs[i], b = Unknowns<Dim>::dofs[j];
			if (a < 3 && a == b) free.inertia(i, j) = body.mass.mass / (body.part * duration * duration);
			if (a >= 3 && b >= 3) free.inertia(i, j) = within(a - 3, b - 3) / (body.part * duration * duration);
		}
	return free;
}

template <int Dim> void follow(FreeMotion& body, const gimpm::FreeBody<Dim>& free, Real duration)
{
	Vector3r shift = Vector3r::Zero(), turn = Vector3r::Zero();
	for (int i = 0; i < free.motion.size(); ++i)
		(Unknowns<Dim>::dofs[i] < 3 ? shift[Unknowns<Dim>::dofs[i]] : turn[Unknowns<Dim>::dofs[i] - 3]) = free.motion[i];
	const Se3r before = body.at;
	body.at           = { before.position + shift, (turned(turn) * before.orientation).normalized() };
	if (!body.inTime) return;
	const Matrix3r within   = alongAxes<Dim>({ before.position, turned(duration / 2 * body.spin) * before.orientation }, body.mass.inertia);
	const Vector3r momentum = (within * turn / duration - (1 - body.part) * (alongAxes<Dim>(before, body.mass.inertia) * body.spin)) / body.part;
	const Matrix3r now      = alongAxes<Dim>(body.at, body.mass.inertia);
	for (int i = 0; i < 3; ++i)
		if (!(body.given >> i & 1)) body.velocity[i] = (shift[i] / duration - (1 - body.part) * body.velocity[i]) / body.part;
	const Vector3r spin = Dim == 2 ? Vector3r(0, 0, now(2, 2) > 0 ? momentum[2] / now(2, 2) : 0) : Vector3r(now.inverse() * momentum);
	for (int i = 0; i < 3; ++i)
		if (!(body.given >> (3 + i) & 1)) body.spin[i] = spin[i];
}

template gimpm::FreeBody<2> freeBody(int, const FreeMotion&, Real, const Vector3r&, bool);
template gimpm::FreeBody<3> freeBody(int, const FreeMotion&, Real, const Vector3r&, bool);
template void               follow(FreeMotion&, const gimpm::FreeBody<2>&, Real);
template void               follow(FreeMotion&, const gimpm::FreeBody<3>&, Real);

} // namespace yade
