// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Description of a law that MFront has written into a library, with the generic interface.
#include "core/materials/mfront.hpp"
#include "yade_api/types.hpp"

namespace yade {

struct MfrontDescription {
	gimpm::Mfront                        call = nullptr;
	vector<string>                       parameters, variableNames;
	vector<gimpm::MfrontGiven::Variable> variables;
	vector<Real>                         external; // values of its external variables
	string                               reason;   // why it is not admitted

	int numbers() const; // number of numbers of the variables
};

// Interface of a law in a library that is open. Empty where the law is not MFront's, "Generic" for its generic
// interface.
string            mfrontInterface(void* library, const string& law);
MfrontDescription describeMfront(void* library, const string& law);

} // namespace yade
