// SPDX-License-Identifier: GPL-2.0-or-later
// Motion of bodies and soil at the contact points, and the loads that follow.
#pragma once
#include "core/solvers/couplings.hpp"
#include "core/terms/contact/contact_system.hpp"

namespace gimpm {

/// Gaps and slips of the contact points at displacements of the soil. At each iterate free bodies are in balance with
/// the soil as it is there.
template <int Dim> class ContactKinematics {
public:
	/// The system and the contact points must outlive it.
	ContactKinematics(ContactSystem<Dim>&, const std::vector<ContactPoint<Dim>>&, const Grid<Dim>&);

	bool isTouching(double gap) const { return gap <= tolerance_; }

	/// Gap and slip by the contact point's own face, which has no end; so a round one keeps soil that slides around
	/// it.
	Approach<Dim> approach(const ContactPoint<Dim>&, const Eigen::VectorXd& d) const;

	/// Calls f(contact point, approach, touch) for the contact points that touch.
	template <class F> void forTouching(const Eigen::VectorXd& d, F&& f)
	{
		solveRigidBodyMotion(d);
		for (const ContactPoint<Dim>& point : points_) {
			const Approach<Dim> near = approach(point, d);
			if (const auto touched = touch(point.law, near, tolerance_)) f(point, near, *touched);
		}
	}

	/// Adds the force on a contact point to the loads of the system. `position` of the soil at the end.
	void addLoads(const ContactPoint<Dim>&, const Vec<Dim>& position, const Touch<Dim>&);

	void solveRigidBodyMotion(const Eigen::VectorXd& d);

	/// Adds what free bodies contribute to the Jacobian besides the forces: their motion follows that of the soil
	/// at all contact points that they touch.
	void markFree(Couplings&) const;
	void addFree(const Eigen::VectorXd& d, Couplings&);

	/// Names a free body that is not in balance, a clause; empty if all are.
	std::string unbalanced() const;

private:
	Vec<Dim>                              pointOfForce(const ContactPoint<Dim>&, const Vec<Dim>& soil, const Vec<Dim>& normal) const;
	std::vector<const ContactPoint<Dim>*> pointsOfFree(int free) const;
	FreeContactPoint<Dim>                 seen(const ContactPoint<Dim>&, const Vec<Dim>& owner, const Eigen::VectorXd& d) const;

	ContactSystem<Dim>&                   system_;
	const std::vector<ContactPoint<Dim>>& points_;
	Eigen::VectorXd                       solvedAt_;  ///< displacements at which free bodies are in balance, if there are some
	double                                tolerance_; ///< tolerance of a gap that counts as touching [m]
	double                                cellSize_;
	bool                                  isRing_;
};

} // namespace gimpm
