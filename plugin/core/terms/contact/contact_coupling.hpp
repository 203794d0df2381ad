// SPDX-License-Identifier: GPL-2.0-or-later
// Free bodies join all nodes that they touch.
#pragma once
#include "core/terms/contact/contact.hpp"

namespace gimpm {

/// The part of the derivative of Contact that joins nodes which are apart. Its forces are those of Contact.
template <int Dim> class ContactCoupling : public CoupledTerm<Dim> {
public:
	explicit ContactCoupling(const ContactSystem<Dim>& system) : system_(system) { }

	void                        markCouplings(Couplings& K) const override { system_.acting->markFree(K); }
	std::optional<PointFailure> addCoupled(const State& state, const FieldSum<Dim>& sum) const override
	{
		if (sum.couplings) system_.acting->addFree(state.displacements(), *sum.couplings);
		return std::nullopt;
	}
	void addCoupledBefore(const State&, const FieldSum<Dim>&) const override { }

private:
	const ContactSystem<Dim>& system_;
};

} // namespace gimpm
