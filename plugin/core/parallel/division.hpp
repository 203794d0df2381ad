// SPDX-License-Identifier: GPL-2.0-or-later
// Division of points among processes, of which each knows all nodes and cells, but only the points at its own.
#pragma once
#include "core/base/types.hpp"
#include "core/parallel/owned_nodes.hpp"
#include "core/parallel/together.hpp"
#include <algorithm>
#include <memory>

namespace gimpm {

/// Each process has a range of the nodes in the order of their keys, and the cells that are named after them. It holds
/// the points whose domain begins in one of its cells, and while a step is made copies of all others that reach its
/// nodes and cells: what is summed over points is whole there. Where nothing is said the process is alone with its
/// points: it has all nodes and cells, what it sums is the sum, and points are numbered as they are in the cloud. So it
/// is also where several processes hold the same points.
struct Division {
	std::shared_ptr<const Processes> processes = Processes::alone();
	/// Begin of the range of each process but the first one; not decreasing.
	std::vector<Key> first {};
	/// Identity of each owned point, in the order of the cloud, rising: the same in whatever process it is.
	std::vector<std::int64_t>     id {};
	std::vector<std::int64_t>     copied {}; ///< identities of the copies that follow them in the cloud
	std::vector<std::vector<int>> lent {};   ///< the own points of which each process has copies, while there are any

	bool isWhole() const { return processes->size() == 1; } ///< all points are here

	/// Owned points of a cloud with so many points, of which the last ones are copies.
	int          ownOf(std::size_t points) const { return int(points - copied.size()); }
	std::int64_t idOf(int point) const
	{
		const int own = int(id.size()), all = own + int(copied.size());
		return point < own ? id[point] : point < all ? copied[point - own] : point;
	}

	/// Adds a new point behind the others; points that are not divided are numbered by their position in the cloud.
	void append(std::int64_t newId)
	{
		if (!isWhole()) id.push_back(newId);
	}

	/// Process that has the node or the cell.
	int  processOf(Key key) const { return int(std::upper_bound(first.begin(), first.end(), key) - first.begin()); }
	bool owns(Key key) const { return processOf(key) == processes->rank(); }

	/// First of each process among sorted keys, and their number.
	std::vector<int> startsAmong(const std::vector<Key>& sorted) const;

	/// The nodes around which each process knows all points.
	OwnedNodes shareOf(const std::vector<Key>& sortedNodes) const { return { *processes, startsAmong(sortedNodes) }; }

	/// The keys of all, from those that each process has in its own range.
	std::vector<Key> united(std::vector<Key> sorted) const;

	/// Behind what there is of the own points that of the copies, in their order. Numbers only.
	template <class T> void extend(std::vector<T>& ofPoints) const;

	/// Completes values at nodes or cells: the process that has one knows all points around it, and sends its
	/// value.
	void complete(const std::vector<Key>& sorted, std::vector<double>& values) const;
	void complete(const std::vector<Key>& sorted, std::vector<char>& values) const;

	void   smallest(std::int64_t* numbers, std::size_t count) const { processes->smallest(numbers, int(count)); }
	double sum(double own) const;
	double largest(double own) const;

	/// The same of what several numbers are, one after the other.
	template <class T> std::vector<T> joined(std::vector<T> own) const { return gimpm::joined(*processes, std::move(own)); }

	/// The first one that has something to say is heard by all.
	std::string firstSaid(const std::string& text) const { return gimpm::firstSaid(*processes, text); }
};

template <class T> void Division::extend(std::vector<T>& ofPoints) const
{
	static_assert(sizeof(T) % sizeof(double) == 0);
	if (isWhole()) return;
	constexpr std::size_t            words = sizeof(T) / sizeof(double);
	std::vector<std::vector<double>> sent(lent.size());
	for (std::size_t r = 0; r < lent.size(); ++r) {
		sent[r].resize(words * lent[r].size());
		for (std::size_t i = 0; i < lent[r].size(); ++i)
			std::memcpy(sent[r].data() + words * i, &ofPoints[lent[r][i]], sizeof(T));
	}
	for (const auto& received : exchanged(*processes, sent)) {
		const std::size_t before = ofPoints.size();
		ofPoints.resize(before + received.size() / words);
		if (!received.empty()) std::memcpy(static_cast<void*>(ofPoints.data() + before), received.data(), received.size() * sizeof(double));
	}
}

/// Points whose domains begin in a cell.
struct CellLoad {
	Key    lowest;
	double points;
};

/// Begins of the ranges of the processes (Division::first) that give each about the same work: that of its points, and
/// of the nodes that go with them.
std::vector<Key> cutByWork(std::vector<CellLoad> loads, int processes);

/// Excess of the most loaded process over the mean of all, as a part of the mean.
double imbalance(const Processes&, const std::vector<CellLoad>& own);

} // namespace gimpm
