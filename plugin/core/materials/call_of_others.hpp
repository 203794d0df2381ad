// SPDX-License-Identifier: GPL-2.0-or-later
// Calls of functions out of other people's libraries, which may end the program.
#pragma once
#include <string>

namespace gimpm {

/// Lives while a law of somebody else's is called in this thread. Where that ends the program, as STOP of Fortran does,
/// the name and the reason are written to the error stream, and the exit status is that of a failure: it would be 0.
class CallOfOthers {
public:
	explicit CallOfOthers(const std::string& function);
	~CallOfOthers();
	CallOfOthers(const CallOfOthers&)            = delete;
	CallOfOthers& operator=(const CallOfOthers&) = delete;
};

} // namespace gimpm
