// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid bodies beside the soil: where they are, and how far a contact point is from them.
#pragma once
#include "core/base/types.hpp"
#include <array>
#include <limits>
#include <string>

namespace gimpm {

/// Position and rotation of a body.
template <int Dim> struct Pose {
	Vec<Dim> position = Vec<Dim>::Zero();
	Mat<Dim> rotation = Mat<Dim>::Identity();
	/// Displacements of the corners of a body that deforms, besides its rigid motion, in its axes [m].
	std::array<Vec<Dim>, Dim> shift = noShift();

	static std::array<Vec<Dim>, Dim> noShift()
	{
		std::array<Vec<Dim>, Dim> none;
		none.fill(Vec<Dim>::Zero());
		return none;
	}

	Vec<Dim> inSpace(const Vec<Dim>& own) const { return position + rotation * own; }
	Vec<Dim> inBody(const Vec<Dim>& x) const { return rotation.transpose() * (x - position); }
};

enum class RigidKind { ball, block, plane, sheet, capsule };

/// In the plane a ball is a cylinder, a block and a plane have no end out of the plane, and a sheet is a segment. A
/// capsule is all that is within its radius of a segment, in space.
template <int Dim> struct RigidShape {
	RigidKind                 kind     = RigidKind::ball;
	double                    radius   = 0; ///< radius of a ball, a capsule, or the rounded edges of a block; half the thickness of a sheet [m]
	Vec<Dim>                  halfSize = Vec<Dim>::Zero(); ///< half lengths of a block [m]
	Vec<Dim>                  normal   = Vec<Dim>::Zero(); ///< normal of a plane through the body's position, unit, out of the body
	std::array<Vec<Dim>, Dim> corners;                     ///< corners of a sheet, or the ends of a capsule, in the body's axes [m]; not set for others
	bool                      isTwoSided = false;          ///< a plane, or a sheet, that soil may touch from either side
	int                       parts      = 0;              ///< into which the longest edge of a body that deforms is divided; 0: by its length
	Mat<Dim>                  axes       = Mat<Dim>::Identity(); ///< axes of the contact points on a ball, which may have turned on it
};

/// Unit normal of a sheet; in the plane that on the right of the way from the first corner to the second.
Vec<2> normalOf(const std::array<Vec<2>, 2>& corners);
Vec3   normalOf(const std::array<Vec3, 3>& corners);

/// Signed distance of a position from a body.
template <int Dim> struct Proximity {
	double   gap              = 0;                                        ///< distance to the surface, < 0 inside [m]
	Vec<Dim> normal           = Vec<Dim>::Zero();                         ///< unit, out of the body
	Mat<Dim> normalDerivative = Mat<Dim>::Zero();                         ///< derivative by the position [1/m]
	double   beside           = -std::numeric_limits<double>::infinity(); ///< distance of the foot of the normal beyond the edge of a sheet, < 0 on it [m]
};

template <int Dim> struct RigidBody {
	RigidShape<Dim> shape;
	std::string     name;                                                          ///< for messages
	int             owner               = 0;                                       ///< owner that moves it, and takes its forces: a clump or itself
	bool            isNew               = false;                                   ///< overlaps at the start are taken as fitting
	double          frictionCoefficient = 0;                                       ///< [-]
	double          adhesion            = std::numeric_limits<double>::infinity(); ///< cap of the shear stress [Pa]
	double          stiffness           = 0;                                       ///< stiffness of the contact, over Young's modulus per cell [-]
	Pose<Dim>       begin {}, end {};                                              ///< both ends of the step
	double          turn      = 0;     ///< rotation by which it turns from one load step to the next, also where its poses do not tell [rad]
	int             soilSide  = 0;     ///< side on which alone a two-sided surface has had soil in sight
	double          slack     = 0;     ///< distance behind the surface up to which soil is still on that side [m]
	bool            isBetween = false; ///< in this step it is thin in the plane and has soil on both of its sides
	bool            parts     = false; ///< and these have nodes of their own
	int             free      = -1;    ///< among the free bodies of the system (core/terms/contact/contact_free.hpp), if its owner moves freely
	int             nodes     = 0;     ///< at the corners, of a body that deforms with these (core/terms/contact/contact_nodes.hpp); 0: it is rigid
	/// Owners of those nodes, and the turn that they give the body about its axis in the step, for a capsule [rad].
	std::array<int, 3>    nodeOwners { 0, 0, 0 };
	std::array<double, 3> twists { 0, 0, 0 };

	/// `side` of a two-sided surface from which it is looked at: 1 where its normal points to, or -1.
	Proximity<Dim> proximity(const Pose<Dim>&, const Vec<Dim>& x, int side) const;

	/// Side of a two-sided surface that a position is on.
	int sideOf(const Pose<Dim>&, const Vec<Dim>& x) const;

	/// Its smallest size; planes and rigid sheets have none [m].
	double thickness() const;

	/// Distance of a sheet's surface from its centre on either side [m].
	double halfThickness() const { return shape.kind == RigidKind::sheet && nodes > 0 ? shape.radius : 0; }

	/// True if what presses along a normal, in its own axes, is as narrow as that.
	bool isNarrow(const Vec<Dim>& normal) const;

	/// True if something that went straight from one position to another, as seen from the body, came out on
	/// another side of it, or is about to. The sides of planes and sheets are known.
	bool isCrossed(const Vec<Dim>& beginsAt, const Vec<Dim>& endsAt) const;

	/// Lower and upper corner of the box around it; infinite for planes.
	std::pair<Vec<Dim>, Vec<Dim>> bounds(const Pose<Dim>&) const;

	/// An upper bound of how far a contact point on it moves in the step [m].
	double motion() const;

	/// Displacement that it would give to what is at x at the begin [m].
	Vec<Dim> carried(const Vec<Dim>& x) const;
};

} // namespace gimpm
