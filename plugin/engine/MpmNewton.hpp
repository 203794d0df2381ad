// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/registration.hpp"

namespace yade {

class MpmNewton : public Exposed<MpmNewton, Serializable> {
public:
	Real tolerance     = 1e-6;
	int  maxIterations = 20;

	YADE_API_NAME(MpmNewton)
	static const char*             doc() { return "Settings of the Newton-Raphson solution of a load step (Coombs 2023, section 2.1)."; }
	template <class V> static void attributes(V&& v)
	{
		v("tolerance",
		  &MpmNewton::tolerance,
		  0,
		  "A step has converged when the residual on the free degrees of freedom is at most this part [-] of external forces and reactions; between 0 "
		  "and 1, both excluded.",
		  strictlyBetween(0, 1));
		v("maxIterations", &MpmNewton::maxIterations, 0, "Linear solves allowed in a step, at least 1.", atLeast(1));
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmNewton)
