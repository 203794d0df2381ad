// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/halves.hpp"
#include <Eigen/LU>

namespace yade {

namespace {
	// Those that the plugin has given it.
	template <class T> void copyAttributes(const T& from, T& to)
	{
		T::attributes([&](const char*, auto member, auto&&...) { to.*member = from.*member; });
	}

	void copyMotion(const State& from, State& to)
	{
		to.se3            = from.se3;
		to.vel            = from.vel;
		to.mass           = from.mass;
		to.angVel         = from.angVel;
		to.angMom         = from.angMom;
		to.inertia        = from.inertia;
		to.refPos         = from.refPos;
		to.refOri         = from.refOri;
		to.blockedDOFs    = from.blockedDOFs;
		to.isDamped       = from.isDamped;
		to.densityScaling = from.densityScaling;
	}

	// All but its number in a scene.
	shared_ptr<Body> copyOf(const Body& body, const MaterialPoint& point)
	{
		const shared_ptr<MpmPoint> shape(new MpmPoint);
		copyAttributes(*point.shape, *shape);
		shape->radius    = point.shape->radius;
		shape->color     = point.shape->color;
		shape->wire      = point.shape->wire;
		shape->highlight = point.shape->highlight;
		const shared_ptr<MpmState> state(new MpmState);
		copyAttributes(*point.state, *state);
		copyMotion(*point.state, *state);
		const shared_ptr<Body> copy(new Body);
		copy->material  = body.material;
		copy->shape     = shape;
		copy->state     = state;
		copy->groupMask = body.groupMask;
		copy->flags     = body.flags;
		return copy;
	}

	// What there is once only: the rest of a difference from it is exact where the part is a half or more.
	struct Amounts {
		explicit Amounts(const MpmState& s) : volume(s.volume), volume0(s.volume0), mass(s.mass), force(s.force) { }
		void giveTo(MpmState& s) const { s.volume = volume, s.volume0 = volume0, s.mass = mass, s.force = force; }
		void take(Real part)
		{
			for (Real* x : { &volume, &volume0, &mass })
				*x *= part;
			force *= part;
		}
		void subtract(const Amounts& other)
		{
			volume -= other.volume, volume0 -= other.volume0, mass -= other.mass;
			force -= other.force;
		}
		Real     volume, volume0, mass;
		Vector3r force;
	};

	// Places and sizes; displacements go on linearly from the middle of the whole, but the radius of a ring, and all that goes with it, by the stretch around the axis.
	void moveHalf(MpmState& state, MpmPoint& shape, int axis, const Vector3r& offset, bool isRing)
	{
		const Vector3r before = state.defGrad.inverse() * offset;
		const Real     scale  = isRing ? 1 + offset[0] / state.pos[0] : 1;
		state.pos += offset;
		const Real radius = state.refPos[0] * scale;
		state.refPos += before;
		if (isRing) state.refPos[0] = radius;
		shape.halfSize0[axis] /= 2;
		shape.halfSize0[2] *= scale;
	}
}

shared_ptr<Body> halve(const Body& body, const MaterialPoint& point, int axis, const Vector3r& offset, bool isRing)
{
	point.state->splits += 1;
	const auto upper = copyOf(body, point);
	auto&      state = static_cast<MpmState&>(*upper->state);
	state.parent     = body.id;
	Amounts rest(*point.state), part = rest;
	part.take(isRing ? (1 + offset[0] / point.state->pos[0]) / 2 : 0.5);
	rest.subtract(part);
	part.giveTo(state);
	rest.giveTo(*point.state);
	moveHalf(*point.state, *point.shape, axis, -offset, isRing);
	moveHalf(state, static_cast<MpmPoint&>(*upper->shape), axis, offset, isRing);
	return upper;
}

} // namespace yade
