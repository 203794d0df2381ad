// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/split_point.hpp"

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

	// Takes a part of what there is once only, and leaves the rest: halves have it as their sum to the last bit.
	void takePart(MpmState& from, MpmState& to, Real part)
	{
		MpmState::amounts([&](auto member) {
			to.*member = part * from.*member;
			from.*member -= to.*member;
		});
	}

	void exchangeAmounts(MpmState& one, MpmState& other)
	{
		MpmState::amounts([&](auto member) { std::swap(one.*member, other.*member); });
	}

	// The initial domains of halves are those of the initial one; but the initial radius of a ring is that with
	// which it is stretched around the axis as the whole is.
	void moveHalf(MpmState& state, MpmPoint& shape, int axis, Real sign, const Vector3r& offset, bool isRing)
	{
		const Real scale = isRing ? 1 + sign * offset[0] / state.pos[0] : 1, radius = state.refPos[0] * scale;
		state.pos += sign * offset;
		shape.halfSize0[axis] /= 2;
		shape.halfSize0[2] *= scale;
		state.refPos[axis] += sign * shape.halfSize0[axis];
		if (isRing) state.refPos[0] = radius;
	}
}

Vector3r toUpperHalf(const MaterialPoint& point, int axis) { return point.state->defGrad.col(axis) * (point.shape->halfSize0[axis] / 2); }

shared_ptr<Body> halve(const Body& body, const MaterialPoint& point, int axis, bool isRing)
{
	const PointWriter writer;
	MpmState&         lower  = writer.state(point);
	const Vector3r    offset = toUpperHalf(point, axis);
	lower.splits += 1;
	const auto upper = copyOf(body, point);
	auto&      state = static_cast<MpmState&>(*upper->state);
	state.parent     = body.id;
	const Real part  = isRing ? (1 + offset[0] / point.state->pos[0]) / 2 : 0.5;
	takePart(lower, state, std::max(part, 1 - part)); // the larger one
	if (part < 0.5) exchangeAmounts(lower, state);
	moveHalf(lower, writer.shape(point), axis, -1, offset, isRing);
	moveHalf(state, static_cast<MpmPoint&>(*upper->shape), axis, 1, offset, isRing);
	return upper;
}

} // namespace yade
