// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Are the tables of virtual functions in YADE's libraries those that this folder declares?
//
// A function more or less in one of YADE's classes changes neither the size of an object nor its attributes; each call
// of a function behind it ends in another one.
#include "yade_api/types.hpp"

namespace yade {

// The classes that the plugin derives from or calls whose tables differ, each with what differs.
vector<string> findOtherVirtualFunctions();

} // namespace yade
