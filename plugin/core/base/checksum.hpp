// SPDX-License-Identifier: GPL-2.0-or-later
// Checksum that tells whether numbers are still the same, or the same elsewhere.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace gimpm {

/// Checksum of bytes, eight at a time, in turn by several sums: one alone would wait for itself at each word.
class Checksum {
public:
	template <class T> void mix(const std::vector<T>& numbers)
	{
		static_assert(sizeof(T) % 4 == 0);
		const auto* bytes = reinterpret_cast<const char*>(numbers.data());
		std::size_t left  = numbers.size() * sizeof(T);
		for (; left >= sizeof sums_; left -= sizeof sums_, bytes += sizeof sums_)
			for (int i = 0; i < width; ++i)
				mixWord(i, bytes + 8 * i, 8);
		for (int i = 0; left > 0; ++i) {
			const std::size_t size = std::min<std::size_t>(8, left);
			mixWord(i, bytes, size);
			left -= size, bytes += size;
		}
	}
	std::uint64_t take()
	{
		for (int i = 1; i < width; ++i)
			mixWord(0, reinterpret_cast<const char*>(&sums_[i]), 8);
		return sums_[0];
	}

private:
	static constexpr int width = 4;

	void mixWord(int i, const char* bytes, std::size_t size)
	{
		std::uint64_t word = 0;
		std::memcpy(&word, bytes, size);
		sums_[i] = (sums_[i] ^ word) * 0x9E3779B97F4A7C15u;
		sums_[i] ^= sums_[i] >> 29;
	}

	std::uint64_t sums_[width] = { 1, 2, 3, 4 };
};

} // namespace gimpm
