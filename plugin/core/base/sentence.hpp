// SPDX-License-Identifier: GPL-2.0-or-later
// Messages put together from words and numbers.
#pragma once
#include <sstream>
#include <string>

namespace gimpm {

template <class... Parts> std::string sentence(const Parts&... parts)
{
	std::ostringstream text;
	(text << ... << parts);
	return text.str();
}

} // namespace gimpm
