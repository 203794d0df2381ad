// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/deforming_bodies.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/contact/contact_surface.hpp"
#include "yade_api/bodies.hpp"
#include "yade_api/grids.hpp"
#include <algorithm>
#include <set>

namespace yade {

namespace {
	[[noreturn]] void refuseDeforming(const Body& body, const string& what)
	{
		throw std::invalid_argument(gimpm::sentence("Body #", body.id, ", a ", body.shape->getClassName(), ", ", what));
	}

	const ChainedState* chainedState(const Body& body)
	{
		return dynamic_cast<const ChainedCylinder*>(body.shape.get()) ? dynamic_cast<const ChainedState*>(body.state.get()) : nullptr;
	}

	// Next body in its chain. The chains that YADE remembers besides are not right in a scene that was
	// loaded.
	shared_ptr<Body> nextInChain(const Body& body, const ChainedState& state, const Scene& scene)
	{
		const BodiesLock lock(scene);
		const size_t     count = scene.bodies->size();
		for (size_t i = 1; i < count; ++i) { // mostly it is the next one of all bodies, too
			const auto& other = (*scene.bodies)[unsigned((size_t(body.id) + i) % count)];
			const auto* found = other ? chainedState(*other) : nullptr;
			if (found && found->chainNumber == state.chainNumber && found->rank == state.rank + 1) return other;
		}
		return {};
	}

	// Rotation by the least angle which takes one direction to another. Eigen's own has a singular value
	// decomposition, which the compiler would spend seconds on.
	Matrix3r leastTurn(const Vector3r& from, const Vector3r& to)
	{
		const Vector3r a = from.normalized(), b = to.normalized(), middle = a + b;
		if (b.isZero()) return Matrix3r::Identity(); // nodes that have come into one place
		if (middle.norm() < 1e-12) {                 // back, about any axis across
			const Vector3r across = a.unitOrthogonal();
			return 2 * across * across.transpose() - Matrix3r::Identity();
		}
		return Matrix3r::Identity() + 2 * b * a.transpose() - 2 * middle * middle.transpose() / middle.squaredNorm();
	}

	// In axes of its own: of a capsule the first is along it, of a sheet the third is its normal.
	Matrix3r axesOf(const vector<Vector3r>& at, const vector<NodePose>& nodes)
	{
		const Vector3r first = (at[1] - at[0]).normalized();
		Matrix3r       axes;
		if (at.size() == 3) {
			const Vector3r normal = (at[1] - at[0]).cross(at[2] - at[0]).normalized();
			axes << first, normal.cross(first), normal;
			return axes;
		}
		// They turn as little as can be from those of the line as it was made, so that contact points keep
		// their side.
		Vector3r was          = nodes[1].body->state->refPos - nodes[0].body->state->refPos;
		was                   = was.norm() > 0 ? Vector3r(was.normalized()) : first;
		const Vector3r across = was.unitOrthogonal();
		axes << was, across, was.cross(across);
		return leastTurn(was, first) * axes;
	}

	Vector3r middleOf(const vector<Vector3r>& at)
	{
		Vector3r sum = Vector3r::Zero();
		for (const Vector3r& x : at)
			sum += x;
		return sum / Real(at.size());
	}

	Real longestOf(const vector<Vector3r>& at)
	{
		Real longest = 0;
		for (size_t i = 0; i < at.size(); ++i)
			longest = std::max(longest, (at[(i + 1) % at.size()] - at[i]).norm());
		return longest;
	}

	// The same number as long as it is not stretched or pressed to another size: contact points have to keep their
	// names.
	int partsOf(gimpm::RigidKind kind, const vector<Vector3r>& was, const vector<Vector3r>& is, Real spacing)
	{
		const Real before = longestOf(was), now = longestOf(is);
		if (!(before > 0) || !std::isfinite(before)) return gimpm::partsOfEdge(kind, now, spacing);
		const int halvings = std::max(0, int(std::lround(std::log2(now / before))));
		return gimpm::partsOfEdge(kind, before, spacing) << std::min(halvings, 10);
	}

	// Angle by which a node turns in the step about an axis.
	Real turnAbout(const Vector3r& axis, const NodePose& node)
	{
		const Eigen::AngleAxis<Real> turn(node.end.orientation * node.begin.orientation.conjugate());
		return turn.angle() * turn.axis().dot(axis);
	}

	void requireCorners(const Body& body, const vector<Vector3r>& at, Real radius)
	{
		if (!(radius > 0) || !std::isfinite(radius))
			refuseDeforming(body, gimpm::sentence("cannot touch the soil: its radius = ", radius, ", expected a finite number > 0."));
		for (const Vector3r& x : at)
			if (!x.allFinite()) refuseDeforming(body, gimpm::sentence("has a node at (", x.transpose(), "): expected finite numbers."));
		const bool isOne = at.size() == 3 ? (at[1] - at[0]).cross(at[2] - at[0]).norm() > 1e-9 * longestOf(at) * longestOf(at) : at[0] != at[1];
		if (!isOne)
			refuseDeforming(
			        body,
			        string("cannot touch the soil: its nodes ")
			                + (at.size() == 3 ? "do not span a triangle." : "are in one place, so that it has no length."));
	}

	void requirePlain(const Body& body)
	{
		const auto* grid  = dynamic_cast<const GridConnection*>(body.shape.get());
		const auto* facet = dynamic_cast<const PFacet*>(body.shape.get());
		if ((grid && (grid->periodic || grid->cellDist != Vector3i::Zero())) || (facet && facet->cellDist != Vector3i::Zero()))
			refuseDeforming(body, "joins nodes of different periods (cellDist), which cannot touch the soil.");
	}

	vector<shared_ptr<Body>> namedNodes(const Body& body, const Scene& scene)
	{
		if (const auto* grid = dynamic_cast<const GridConnection*>(body.shape.get())) return { grid->node1, grid->node2 };
		if (const auto* facet = dynamic_cast<const PFacet*>(body.shape.get())) return { facet->node1, facet->node2, facet->node3 };
		const auto* state = chainedState(body);
		const auto  next  = state ? nextInChain(body, *state, scene) : nullptr;
		if (next) return { bodyAt(scene, body.id), next };
		return {};
	}
}

vector<shared_ptr<Body>> nodesOf(const Body& body, const Scene& scene)
{
	const auto nodes = namedNodes(body, scene);
	for (const auto& node : nodes)
		if (!node || bodyAt(scene, node->id) != node)
			refuseDeforming(body, "has a node that is none of O.bodies: make it by yade.gridpfacet, and erase it before its nodes.");
	return nodes;
}

bool isNodeOfNet(const Body& body) { return dynamic_cast<const GridNode*>(body.shape.get()) || dynamic_cast<const ChainedCylinder*>(body.shape.get()); }

bool isPartOfNet(const Body& body, const Scene& scene)
{
	if (dynamic_cast<const GridNode*>(body.shape.get())) return true;
	const auto* state = chainedState(body);
	return state && state->rank > 0 && !nextInChain(body, *state, scene);
}

void dropSidesOfMembranes(vector<shared_ptr<Body>>& bodies)
{
	std::set<const Body*> sides;
	for (const auto& body : bodies)
		if (const auto* facet = dynamic_cast<const PFacet*>(body->shape.get()))
			for (const auto& side : { facet->conn1, facet->conn2, facet->conn3 })
				sides.insert(side.get());
	if (sides.empty()) return;
	bodies.erase(std::remove_if(bodies.begin(), bodies.end(), [&](const auto& body) { return sides.count(body.get()) > 0; }), bodies.end());
}

template <int Dim> gimpm::RigidBody<Dim> deformingBody(const Body& body, const gimpm::Grid<Dim>& grid, const vector<NodePose>& nodes)
{
	if (Dim == 2)
		refuseDeforming(body, "touches the soil in 3D only (MpmGrid.dim=3): in the plane give MpmBeam or MpmReinforcement, or a Facet of its section.");
	if (grid.isPeriodic()) refuseDeforming(body, "cannot touch the soil on a periodic grid (MpmGrid.period), where only Walls can.");
	requirePlain(body);
	const auto*      sphere = dynamic_cast<const Sphere*>(body.shape.get());
	const Real       radius = sphere ? sphere->radius : dynamic_cast<const PFacet&>(*body.shape).radius;
	vector<Vector3r> was, is;
	for (const NodePose& node : nodes)
		was.push_back(node.body->state->refPos), is.push_back(node.begin.position);
	requireCorners(body, is, radius);
	gimpm::RigidBody<Dim> deforming;
	deforming.name             = "body #" + std::to_string(body.id) + " (" + body.shape->getClassName() + ")";
	deforming.nodes            = int(nodes.size());
	deforming.shape.kind       = nodes.size() == 3 ? gimpm::RigidKind::sheet : gimpm::RigidKind::capsule;
	deforming.shape.isTwoSided = nodes.size() == 3;
	deforming.shape.radius     = radius;
	deforming.shape.parts      = partsOf(deforming.shape.kind, was, is, grid.cellSize / 4);
	deform(deforming, nodes);
	return deforming;
}

template <> void deform(gimpm::RigidBody<2>&, const vector<NodePose>&) { }

template <> void deform(gimpm::RigidBody<3>& body, const vector<NodePose>& nodes)
{
	vector<Vector3r> before, after;
	for (const NodePose& node : nodes)
		before.push_back(node.begin.position), after.push_back(node.end.position);
	const Vector3r axis = (before[1] - before[0]).normalized();
	body.begin          = { middleOf(before), axesOf(before, nodes) };
	// Rotation of a line without a turn about itself, which is that of its nodes.
	const Matrix3r turn = nodes.size() == 3 ? Matrix3r(axesOf(after, nodes) * body.begin.rotation.transpose()) : leastTurn(axis, after[1] - after[0]);
	body.end            = { middleOf(after), turn * body.begin.rotation };
	Real twist          = 0;
	for (size_t i = 0; i < nodes.size(); ++i) {
		body.shape.corners[i] = body.begin.inBody(before[i]);
		body.end.shift[i]     = body.end.inBody(after[i]) - body.shape.corners[i];
		body.twists[i]        = nodes.size() == 2 ? turnAbout(axis, nodes[i]) : 0;
		twist                 = std::max(twist, std::abs(body.twists[i]));
	}
	body.turn = Eigen::AngleAxis<Real>(turn).angle() + twist;
}

template gimpm::RigidBody<2> deformingBody(const Body&, const gimpm::Grid<2>&, const vector<NodePose>&);
template gimpm::RigidBody<3> deformingBody(const Body&, const gimpm::Grid<3>&, const vector<NodePose>&);

} // namespace yade
