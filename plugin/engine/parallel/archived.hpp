// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/serialization.hpp"
#include <sstream>

namespace yade {

// A checksum of everything that goes into it, as it is saved.
template <class... Parts> std::uint64_t checksumOf(const Parts&... parts)
{
	std::ostringstream stream(std::ios::binary);
	{
		boost::archive::binary_oarchive archive(stream);
		(archive << ... << parts);
	}
	return std::hash<string>()(stream.str());
}

} // namespace yade
