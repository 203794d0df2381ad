// SPDX-License-Identifier: GPL-2.0-or-later
// Points of other processes that a step needs.
#pragma once
#include "core/parallel/division.hpp"
#include <cstring>

namespace gimpm {

/// Numbers for another process, one after the other.
class MessageWriter {
public:
	void                    add(int number) { numbers.push_back(number); }
	template <class T> void add(const T& value)
	{
		static_assert(sizeof(T) % sizeof(double) == 0);
		numbers.resize(numbers.size() + sizeof(T) / sizeof(double));
		std::memcpy(&numbers.back() + 1 - sizeof(T) / sizeof(double), &value, sizeof(T));
	}
	std::vector<double> numbers {};
};

/// The same on the other side.
class MessageReader {
public:
	explicit MessageReader(const std::vector<double>& numbers) : next_(numbers.data()) { }
	void                    take(int& number) { number = int(*next_++); }
	template <class T> void take(T& value)
	{
		std::memcpy(static_cast<void*>(&value), next_, sizeof(T));
		next_ += sizeof(T) / sizeof(double);
	}

private:
	const double* next_;
};

/// Copies of them behind the own ones of the cloud, as long as this lives; none where the process has all points.
/// Whatever columns the cloud has go with them (forColumns).
template <class Cloud> class Halo {
public:
	/// `needed()`: the own points that each process needs.
	template <class F> Halo(Cloud& cloud, Division& division, F&& needed) : cloud_(cloud), division_(division)
	{
		if (division.isWhole()) return;
		const auto isThere = columnsOfAll();
		int        k       = 0;
		forColumns(cloud, [&](auto& column, auto) { // point loads that only others have
			if (isThere[k++] && column.empty()) fillWithZeros(column, division.ownOf(cloud.size()));
		});
		division.lent = needed();
		std::vector<std::vector<double>> own;
		for (const auto& points : division.lent)
			own.push_back(packed(points, isThere));
		for (const auto& received : exchanged(*division.processes, own))
			unpack(received, isThere);
	}
	~Halo()
	{
		if (division_.isWhole()) return;
		const std::size_t own = division_.id.size();
		forColumns(cloud_, [own](auto& column, auto) { column.resize(std::min(column.size(), own)); });
		division_.copied.clear(), division_.lent.clear();
	}
	Halo(const Halo&)            = delete;
	Halo& operator=(const Halo&) = delete;

private:
	/// Flags of the columns that exist: a process without points cannot tell.
	std::vector<char> columnsOfAll() const
	{
		std::vector<std::int64_t> isMissing;
		forColumns(cloud_, [&](const auto& column, auto) { isMissing.push_back(column.empty()); });
		division_.smallest(isMissing.data(), isMissing.size());
		std::vector<char> isThere;
		for (const std::int64_t missing : isMissing)
			isThere.push_back(!missing);
		return isThere;
	}
	template <class T> static void fillWithZeros(std::vector<T>& column, int points)
	{
		column.resize(points);
		std::memset(static_cast<void*>(column.data()), 0, points * sizeof(T));
	}

	/// Number, ids and then column by column.
	std::vector<double> packed(const std::vector<int>& points, const std::vector<char>& isThere) const
	{
		MessageWriter message;
		if (points.empty()) return {};
		message.add(int(points.size()));
		for (const int p : points)
			message.add(division_.id[p]);
		int k = 0;
		forColumns(cloud_, [&](const auto& column, auto) {
			if (isThere[k++])
				for (const int p : points)
					message.add(column[p]);
		});
		return std::move(message.numbers);
	}
	void unpack(const std::vector<double>& numbers, const std::vector<char>& isThere)
	{
		if (numbers.empty()) return;
		MessageReader message(numbers);
		int           count = 0, k = 0;
		message.take(count);
		for (int i = 0; i < count; ++i)
			message.take(division_.copied.emplace_back());
		forColumns(cloud_, [&](auto& column, auto) {
			if (!isThere[k++]) return;
			column.resize(column.size() + count);
			for (auto value = column.end() - count; value != column.end(); ++value)
				message.take(*value);
		});
	}

	Cloud&    cloud_;
	Division& division_;
};

} // namespace gimpm
