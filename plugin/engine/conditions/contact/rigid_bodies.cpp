// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/rigid_bodies.hpp"

namespace yade {

namespace {
	using gimpm::RigidKind;

	[[noreturn]] void refuseBody(const Body& body, const string& what)
	{
		throw std::invalid_argument("Body #" + std::to_string(body.id) + ", a " + body.shape->getClassName() + ", " + what);
	}

	string numbers(const Vector3r& v)
	{
		std::ostringstream text;
		text << "(" << v.transpose() << ")";
		return text.str();
	}

	void requirePositive(const Body& body, bool is, const char* attribute, const string& value)
	{
		if (!is) refuseBody(body, string("cannot touch the soil: its ") + attribute + " = " + value + ", expected finite numbers > 0.");
	}

	constexpr Real roundOff = 1e-9; // relative size of round-off where a body touches the plane z = 0

	// Facets and Walls keep the axes of the scene as their own until they turn.
	bool hasOwnAxes(const Body& body) { return dynamic_cast<const Box*>(body.shape.get()); }

	// Orientation without its turn in the plane: the half of that turns the pair (w, z), and
	// (x, y) the same way.
	Quaternionr withoutTurnInPlane(const Quaternionr& q)
	{
		const bool isUpright = q.w() * q.w() + q.z() * q.z() >= 0.5;
		const Real half      = isUpright ? std::atan2(q.z(), q.w()) : std::atan2(q.y(), q.x());
		return Quaternionr(Eigen::AngleAxis<Real>(-2 * half, Vector3r::UnitZ())) * q;
	}

	template <int Dim> bool makeShape(const Body& body, const Sphere& sphere, const Se3r& at, gimpm::RigidShape<Dim>& shape)
	{
		requirePositive(body, std::isfinite(sphere.radius) && sphere.radius > 0, "radius", std::to_string(sphere.radius));
		const Real away = Dim == 2 ? std::abs(at.position[2]) : 0; // from the plane
		shape.kind      = RigidKind::ball;
		shape.radius    = away == 0 ? sphere.radius : std::sqrt(std::max(0., sphere.radius * sphere.radius - away * away));
		return shape.radius > 0;
	}

	template <int Dim> bool makeShape(const Body& body, const Box& box, const Se3r& at, const gimpm::Grid<Dim>& grid, gimpm::RigidShape<Dim>& shape)
	{
		requirePositive(body, box.extents.allFinite() && box.extents.head<Dim>().minCoeff() > 0, "extents", numbers(box.extents));
		shape.kind     = RigidKind::block;
		shape.halfSize = box.extents.head<Dim>();
		shape.radius   = std::min(0.1 * grid.cellSize, 0.5 * shape.halfSize.minCoeff());
		return Dim == 3 || std::abs(at.position[2]) <= box.extents[2] * (1 + roundOff);
	}

	template <int Dim> bool makeShape(const Body& body, const Wall& wall, gimpm::RigidShape<Dim>& shape)
	{
		if (wall.axis < 0 || wall.axis > 2 || wall.sense < -1 || wall.sense > 1)
			refuseBody(
			        body,
			        "has axis = " + std::to_string(wall.axis) + " and sense = " + std::to_string(wall.sense)
			                + ": expected 0, 1 or 2 and -1, 0 or 1.");
		if (wall.axis >= Dim) return false;
		shape.kind       = RigidKind::plane;
		shape.isTwoSided = wall.sense == 0;
		shape.normal     = (wall.sense < 0 ? -1 : 1) * gimpm::Vec<Dim>::Unit(wall.axis);
		return true;
	}

	vector<Vector3r> cornersOf(const Body& body, const Facet& facet, const Quaternionr& ori)
	{
		vector<Vector3r> corners;
		for (const Vector3r& vertex : facet.vertices)
			corners.push_back(ori * vertex);
		const bool isOne = corners.size() == 3 && (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() > 0;
		if (!isOne || !(corners[0] + corners[1] + corners[2]).allFinite())
			refuseBody(body, "cannot touch the soil: its vertices do not span a triangle.");
		return corners;
	}

	bool makeSheet(const Body& body, const Facet& facet, const Se3r& at, gimpm::RigidShape<3>& shape)
	{
		const auto corners = cornersOf(body, facet, at.orientation);
		std::copy(corners.begin(), corners.end(), shape.corners.begin());
		return true;
	}
	// Segment in which it cuts the plane z = 0: through it, or an edge that lies in it.
	bool makeSheet(const Body& body, const Facet& facet, const Se3r& at, gimpm::RigidShape<2>& shape)
	{
		const auto corners = cornersOf(body, facet, at.orientation);
		const Real size    = std::max((corners[1] - corners[0]).norm(), (corners[2] - corners[0]).norm());
		Vector3r   z;
		for (int i = 0; i < 3; ++i) {
			z[i] = corners[i][2] + at.position[2];
			if (std::abs(z[i]) <= roundOff * size) z[i] = 0;
		}
		vector<gimpm::Vec<2>> ends;
		for (int i = 0; i < 3; ++i) {
			const int j = (i + 1) % 3;
			if (z[i] == 0) ends.push_back(corners[i].head<2>());
			if (z[i] * z[j] < 0) ends.push_back((corners[i] + z[i] / (z[i] - z[j]) * (corners[j] - corners[i])).head<2>());
		}
		if (ends.size() != 2 || ends[0] == ends[1]) return false;
		shape.corners = { ends[0], ends[1] };
		return true;
	}

	template <int Dim> void requireOnAxis(const Body& body, const gimpm::RigidBody<Dim>& rigid)
	{
		const bool isRound = rigid.shape.kind == RigidKind::sheet
		        || (rigid.shape.kind == RigidKind::plane ? rigid.shape.normal[0] == 0 : std::abs(rigid.begin.position[0]) <= 1e-9 * rigid.shape.radius);
		if (!isRound || !rigid.begin.rotation.isIdentity(1e-9))
			refuseBody(
			        body,
			        "is no body of revolution about the axis x = 0: on an axisymmetric grid Spheres and upright Boxes (cylinders) in the middle, Walls across the axis and Facets (cones) touch the soil.");
	}

	template <int Dim> gimpm::Mat<Dim> rotationInDimension(const Body& body, const Matrix3r& rotation)
	{
		if (Dim == 2 && std::abs(rotation(2, 2) - 1) > 1e-9)
			refuseBody(body, "turns out of the plane of a grid with dim=2, where it acts by its section.");
		return rotation.topLeftCorner<Dim, Dim>();
	}
}

Se3r ahead(const State& state, const Se3r& from, Real time)
{
	const Real        angle = state.angVel.norm() * time;
	const Quaternionr turn(Eigen::AngleAxis<Real>(angle, angle > 0 ? Vector3r(state.angVel.normalized()) : Vector3r(Vector3r::UnitX())));
	return { from.position + time * state.vel, (turn * from.orientation).normalized() };
}

template <int Dim> Se3r unturned(const Body& body, const Se3r& at, const gimpm::Grid<Dim>& grid)
{
	if (!dynamic_cast<const Sphere*>(body.shape.get()) || grid.axisymmetric) return at;
	return { at.position, Dim == 3 ? Quaternionr(Quaternionr::Identity()) : withoutTurnInPlane(at.orientation) };
}

template <int Dim> gimpm::Pose<Dim> poseOf(const Body& body, const Se3r& first, const Se3r& now)
{
	const Quaternionr turn = hasOwnAxes(body) ? now.orientation : now.orientation * first.orientation.conjugate();
	return { now.position.head<Dim>(), rotationInDimension<Dim>(body, turn.normalized().toRotationMatrix()) };
}

template <int Dim> std::optional<gimpm::RigidBody<Dim>> rigidBody(const Body& body, const Se3r& at, const gimpm::Grid<Dim>& grid)
{
	if (!at.position.allFinite() || !at.orientation.coeffs().allFinite()) refuseBody(body, "is at " + numbers(at.position) + ": expected finite numbers.");
	gimpm::RigidBody<Dim> rigid;
	const Shape*          shape = body.shape.get();
	bool                  acts  = false;
	rigid.name                  = "body #" + std::to_string(body.id) + " (" + shape->getClassName() + ")";
	const auto* sphere          = dynamic_cast<const Sphere*>(shape);
	if (sphere && shape->getClassName() == Sphere::staticName()) acts = makeShape(body, *sphere, at, rigid.shape);
	else if (const auto* box = dynamic_cast<const Box*>(shape))
		acts = makeShape(body, *box, at, grid, rigid.shape);
	else if (const auto* wall = dynamic_cast<const Wall*>(shape))
		acts = makeShape(body, *wall, rigid.shape);
	else if (const auto* facet = dynamic_cast<const Facet*>(shape)) {
		rigid.shape.kind       = RigidKind::sheet;
		rigid.shape.isTwoSided = true;
		acts                   = makeSheet(body, *facet, at, rigid.shape);
	} else
		refuseBody(body, "cannot touch the soil: Sphere, Box, Facet and Wall can, and clumps of them. Give MpmContact a mask that leaves it out.");
	if (!acts) return std::nullopt;
	rigid.begin = rigid.end = poseOf<Dim>(body, unturned(body, at, grid), at);
	if (grid.axisymmetric) requireOnAxis(body, rigid);
	if (grid.isPeriodic() && rigid.shape.kind != RigidKind::plane)
		refuseBody(body, "cannot touch the soil on a periodic grid (MpmGrid.period), where only Walls can.");
	return rigid;
}

template std::optional<gimpm::RigidBody<2>> rigidBody(const Body&, const Se3r&, const gimpm::Grid<2>&);
template std::optional<gimpm::RigidBody<3>> rigidBody(const Body&, const Se3r&, const gimpm::Grid<3>&);
template Se3r                               unturned(const Body&, const Se3r&, const gimpm::Grid<2>&);
template Se3r                               unturned(const Body&, const Se3r&, const gimpm::Grid<3>&);
template gimpm::Pose<2>                     poseOf(const Body&, const Se3r&, const Se3r&);
template gimpm::Pose<3>                     poseOf(const Body&, const Se3r&, const Se3r&);

} // namespace yade
