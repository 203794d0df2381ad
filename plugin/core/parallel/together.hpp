// SPDX-License-Identifier: GPL-2.0-or-later
// Knowledge that several processes have together when each has said its part. All of them call these, in the same
// order, and come to the same, to the last bit.
#pragma once
#include "core/parallel/processes.hpp"
#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <type_traits>
#include <vector>

namespace gimpm {

/// `count` numbers of each process, one process after the other.
inline std::vector<double> ofEach(const Processes& all, const double* own, int count)
{
	std::vector<int> start(all.size() + 1);
	for (int r = 0; r <= all.size(); ++r)
		start[r] = r * count;
	std::vector<double> numbers(start.back());
	std::copy(own, own + count, numbers.begin() + start[all.rank()]);
	all.gather(numbers.data(), start.data());
	return numbers;
}
inline std::vector<double> ofEach(const Processes& all, double own) { return ofEach(all, &own, 1); }

/// Each of the numbers becomes the sum of those that the processes have, in their order.
inline void addUp(const Processes& all, double* numbers, int count)
{
	const auto ofAll = ofEach(all, numbers, count);
	std::copy(ofAll.begin(), ofAll.begin() + count, numbers);
	for (std::size_t i = count; i < ofAll.size(); ++i)
		numbers[i % count] += ofAll[i];
}

/// Norm of a vector of which each process has a part with this norm.
inline double normOfAll(const Processes& all, double own)
{
	if (all.size() == 1) return own;
	const auto norms = ofEach(all, own);
	return Eigen::Map<const Eigen::VectorXd>(norms.data(), Eigen::Index(norms.size())).stableNorm();
}

/// Joins what the processes have, one after the other.
template <class T> std::vector<T> joined(const Processes& all, std::vector<T> own)
{
	if (all.size() == 1) return own;
	static_assert(sizeof(T) % sizeof(double) == 0 && std::is_trivially_copyable_v<T>);
	constexpr int    words = sizeof(T) / sizeof(double);
	std::vector<int> start { 0 };
	for (const double count : ofEach(all, double(own.size())))
		start.push_back(start.back() + words * int(count));
	std::vector<double> numbers(start.back());
	if (!own.empty()) std::memcpy(numbers.data() + start[all.rank()], own.data(), own.size() * sizeof(T));
	all.gather(numbers.data(), start.data());
	std::vector<T> result(numbers.size() / words);
	if (!result.empty()) std::memcpy(static_cast<void*>(result.data()), numbers.data(), result.size() * sizeof(T));
	return result;
}

/// Unites what the processes have, sorted; each gives its own values, sorted and once.
template <class T> std::vector<T> united(const Processes& all, std::vector<T> own)
{
	if (all.size() == 1) return own;
	own = joined(all, std::move(own));
	std::sort(own.begin(), own.end());
	own.erase(std::unique(own.begin(), own.end()), own.end());
	return own;
}

/// The numbers that each process has for this one, for those that this one has for each.
inline std::vector<std::vector<double>> exchanged(const Processes& all, const std::vector<std::vector<double>>& own)
{
	const int           size = all.size(), rank = all.rank();
	std::vector<double> counts(size);
	for (int r = 0; r < size; ++r)
		counts[r] = double(own[r].size());
	counts = joined(all, counts);
	std::vector<std::vector<double>> received(size);
	std::vector<Message>             messages;
	for (int r = 0; r < size; ++r) {
		received[r].resize(std::size_t(counts[r * size + rank]));
		if (r == rank) received[r] = own[r];
		else if (!own[r].empty() || !received[r].empty())
			messages.push_back({ r, own[r].data(), int(own[r].size()), received[r].data(), int(received[r].size()) });
	}
	all.exchange(messages.data(), int(messages.size()));
	return received;
}

/// The first one of them for which this is so; as many as there are: it is for none.
inline int firstOf(const Processes& all, bool isSo)
{
	std::int64_t first = isSo ? all.rank() : all.size();
	all.smallest(&first, 1);
	return int(first);
}

/// Text of the first process that has one, in all of them; empty: there is none.
inline std::string firstSaid(const Processes& all, const std::string& text)
{
	const int first = firstOf(all, !text.empty());
	return first < all.size() ? all.told(text, first) : "";
}

/// True if a number that takes time to compute is the same in all processes; a single process does not compute it.
template <class F> bool haveSame(const Processes& all, F&& number) { return all.size() == 1 || all.haveSame(number()); }

} // namespace gimpm
