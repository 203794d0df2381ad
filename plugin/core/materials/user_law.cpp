// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/user_law.hpp"

namespace gimpm {

std::string& wordsOfUserLaw()
{
	static thread_local std::string words;
	return words;
}

} // namespace gimpm
