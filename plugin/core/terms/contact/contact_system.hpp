// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid bodies beside the soil, the contact points on them, and what is kept of these from step to step.
#pragma once
#include "core/terms/contact/contact_free.hpp"
#include "core/terms/contact/contact_law.hpp"
#include "core/terms/contact/force_distribution.hpp"
#include "core/terms/contact_energy.hpp"
#include <algorithm>
#include <tuple>

namespace gimpm {

/// Number of a contact point on its body, and above contactPointBits the layer of the soil: a number that doubles have.
constexpr int contactPointBits = 51, layersOfContactPoints = 4;

/// A contact point on the surface of a body that had soil in front of it at the end of a step that was accepted.
template <int Dim> struct ContactRecord {
	int          body;
	std::int64_t number;
	double       gap     = 0; ///< to the soil, < 0 by the penalty [m]
	bool         touches = false, slips = false;
	double       normalForce     = 0; ///< [N]
	double       areaFraction    = 0; ///< area fraction of soil in front of it (core/terms/contact/contact_sight.hpp)
	double       travel          = 0; ///< distance that soil moved along the body in that step [m]
	double       creep           = 0; ///< the part of it in which soil moves through the grid [m]
	Vec<Dim>     tangentialForce = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero(); ///< on the soil [N]; of the body
	Vec<Dim>     position = Vec<Dim>::Zero();                                   ///< position of the soil at the end of the step [m]

	Vec<Dim> force() const { return normalForce * normal + tangentialForce; } ///< on the soil [N]
};

/// A contact point on a body with soil in front of it, in a step.
template <int Dim> struct ContactPoint {
	int                    body;
	std::int64_t           number;
	Vec<Dim>               soil;                               ///< edge of the soil, at the start of the step
	Vec<Dim>               carried;                            ///< displacement of it with the body by the end
	Vec<Dim>               normal;                             ///< at the end
	double                 away;                               ///< distance of the soil from the body, at the start [m]
	double                 gap;                                ///< distance that counts as that
	double                 areaFraction;                       ///< area fraction of soil in front of it
	double                 area, young;                        ///< area of the surface with soil in front of it [m2]; modulus of the soil [Pa]
	Vec<Dim>               tangentialForce = Vec<Dim>::Zero(); ///< at the start, turned with the body
	ContactLaw<Dim>        law;
	Attachment<Dim>        attached;
	ForceDistribution<Dim> distribution; ///< nodes by which it sees the soil move, and on which it presses

	int layer() const { return int(number >> contactPointBits); }
};

/// Forces of the soil on the owner of bodies.
struct ContactLoad {
	using Stiffness = Eigen::Matrix<double, 6, 6>;
	Vec3      force = Vec3::Zero(), torque = Vec3::Zero(); ///< about the owner's position [N], [N m]
	Stiffness stiffness = Stiffness::Zero();               ///< in 3D, an upper bound: of the penalties alone, for a translation and a rotation of the owner
	double    area = 0, young = 0; ///< area of the contact points that touch [m2], and that by Young's modulus of the soil there [N]

	ContactLoad& operator+=(const ContactLoad& other)
	{
		force += other.force, torque += other.torque, stiffness += other.stiffness;
		area += other.area, young += other.young;
		return *this;
	}
};

template <int Dim> class Contact;

/// The rigid bodies beside the soil, and what is between them.
template <int Dim> struct ContactSystem : ContactEnergy {
	std::vector<RigidBody<Dim>>     bodies;
	std::vector<Vec<Dim>>           owners;     ///< positions at the end of the step [m]
	std::vector<ContactRecord<Dim>> records {}; ///< last step that was accepted, sorted by body and number
	std::vector<ContactLoad>        loads {};   ///< on the owners, then
	Contact<Dim>*                   acting {};  ///< the term of the step that is being made
	/// Those of the owners that move within the step as soil and loads make them; of the bodies that they own the
	/// end of the step is a result.
	std::vector<FreeBody<Dim>> free {};

	void sortRecords()
	{
		std::stable_sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return keyOf(a) < keyOf(b); });
	}
	/// Record of a contact point; null: there is none.
	const ContactRecord<Dim>* recordOf(const ContactPoint<Dim>& point) const
	{
		const auto found = std::lower_bound(records.begin(), records.end(), point, [](const auto& r, const auto& p) { return keyOf(r) < keyOf(p); });
		return found != records.end() && keyOf(*found) == keyOf(point) ? &*found : nullptr;
	}

private:
	template <class Numbered> static auto keyOf(const Numbered& of) { return std::pair(of.body, of.number); }
};

} // namespace gimpm
