// SPDX-License-Identifier: GPL-2.0-or-later
// Contact of the body with rigid bodies: penalty and friction, summed over contact points.
#pragma once
#include "core/terms/contact/contact_kinematics.hpp"
#include "core/terms/contact/contact_points.hpp"
#include "core/terms/coupled_term.hpp"

namespace gimpm {

/// Contact points on the surfaces of the bodies against the soil in front of them, which moves with the linear
/// functions of the grid. The penalty on the gap g is a pressure of stiffness * E g / h, with Young's modulus E of the
/// soil there and h of the smallest cells, over the contact point's part of the surface. The gap is that which there
/// was when soil came into sight, and since then what soil and body have moved towards each other, along the normal of
/// the contact point's own face: which neither edges nor domains that come and go let jump. In time steps the
/// contact points on a ball go around it with the soil, as a ball that turns in its place is the same ball: else those
/// before its lowest one would be pressed deeper with all of its way, and lift it. Only prescribed motion of the bodies
/// is known here. What of a surface lies in another body, or on one that came first, does not count. Where points are
/// divided among processes, all know those that are near.
template <int Dim> class Contact : public Term<Dim> {
public:
	/// The records and loads of the system are written in commit(). What add() adds has the weight of the system.
	Contact(ContactSystem<Dim>&, const StepContext<Dim>&);

	void                        mark(NodeMatrix<Dim>&) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) override;
	void                        addBefore(Eigen::VectorXd& force) override;
	bool                        isSymmetric() const override;
	std::string                 obstacle() const override { return found_.obstacle; }
	double                      fromOutside(const Eigen::VectorXd& d) override { return this->sizeOfForce(d); }
	void                        restrain(const typename Term<Dim>::Constrain&) override;
	void                        restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Constrain&) override;
	Refusal                     refusal(const Eigen::VectorXd& d) override;
	void                        commit(const Eigen::VectorXd& d) override;

	/// Adds the forces that resist at d, or, where that is null, as the step begins, without their weight.
	void addUnweighted(const Eigen::VectorXd* d, Eigen::VectorXd& resistance);

	ContactKinematics<Dim>& kinematics() { return kinematics_; }

private:
	void        constrainSoil(const ContactPoint<Dim>&, bool slips, const typename Term<Dim>::Constrain&) const;
	std::string entered(const Eigen::VectorXd& d) const;

	ContactSystem<Dim>&    system_;
	const StepContext<Dim> step_;
	FoundContact<Dim>      found_;
	ContactKinematics<Dim> kinematics_;
};

/// The part of the derivative of Contact that joins nodes which are apart, as free bodies join all nodes that they
/// touch. Its forces are those of Contact.
template <int Dim> class ContactCoupling : public CoupledTerm<Dim> {
public:
	explicit ContactCoupling(const ContactSystem<Dim>& system) : system_(system) { }

	void                        markCouplings(Couplings& K) const override { system_.acting->kinematics().markFree(K); }
	std::optional<PointFailure> addCoupled(const State& state, const FieldSum<Dim>& sum) const override
	{
		if (sum.couplings) system_.acting->kinematics().addFree(state.displacements(), *sum.couplings);
		return std::nullopt;
	}
	void addCoupledBefore(const State&, const FieldSum<Dim>&) const override { }

private:
	const ContactSystem<Dim>& system_;
};

} // namespace gimpm
