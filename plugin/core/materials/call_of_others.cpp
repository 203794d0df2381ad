// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/call_of_others.hpp"
#include <cstdio>
#include <cstdlib>

namespace gimpm {
namespace {

thread_local const char* calledNow = nullptr;

/// An exit cannot be taken back: libraries have begun to close. Output that is still in buffers is written.
void tellWhoEnds()
{
	if (!calledNow) return;
	std::fprintf(
	        stderr,
	        "MpmUserMat: function = '%s' has ended the program (STOP in Fortran, or exit): all that was not saved is lost. "
	        "Expected is a law that returns; look at its parameters and states, and let it set PNEWDT < 1 where it has no answer.\n",
	        calledNow);
	std::fflush(nullptr);
	std::_Exit(EXIT_FAILURE);
}

} // namespace

CallOfOthers::CallOfOthers(const std::string& function)
{
	static const bool isRegistered = std::atexit(tellWhoEnds) == 0;
	static_cast<void>(isRegistered);
	calledNow = function.c_str();
}
CallOfOthers::~CallOfOthers() { calledNow = nullptr; }

} // namespace gimpm
