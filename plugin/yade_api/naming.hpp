// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Messages for a script that has misspelt a name, or treats a copy as if it were the attribute itself.
#include "yade_api/types.hpp"

namespace yade {

// "; did you mean 'gravity'?" with those of the known names that are most like another one, at most three, the nearest
// first; empty if none is.
string didYouMean(const string& name, const vector<string>& known);

// Names without underscore in front that objects of a Python class have: attributes, methods, and those of its bases.
vector<string> namesIn(PyTypeObject*);

// A tuple that says of itself, where somebody appends to it or assigns an item, that it is the copy of an attribute.
// Otherwise it is like any other.
py::object copyOfAttribute(const py::tuple& items, const string& attribute, bool isReadonly);

} // namespace yade
