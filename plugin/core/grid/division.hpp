// SPDX-License-Identifier: GPL-2.0-or-later
// Points that are divided among processes, of which each knows all nodes and cells, but only the points at its own.
#pragma once
#include "core/base/together.hpp"
#include "core/grid/cloud_basis.hpp"
#include <memory>

namespace gimpm {

/// Each process has a range of the nodes in the order of their keys, and the cells that are named after them. It holds the points whose domain begins in one of its cells, and while
/// a step is made copies of all others that reach its nodes and cells: what is summed over points is whole there.
struct Division {
	std::shared_ptr<const Processes> processes;
	std::vector<Key>                 first;     ///< of each process but the first one: where its range begins; they do not fall
	std::vector<std::int64_t>        id {};     ///< of the own points, in the order of the cloud, rising: the same in whatever process they are
	std::vector<std::int64_t>        copied {}; ///< of the copies that follow them in the cloud
	std::vector<std::vector<int>>    lent {};   ///< the own points of which each process has copies, while there are any

	int          own() const { return int(id.size()); }
	std::int64_t idOf(int point) const { return point < own() ? id[point] : copied[point - own()]; }

	/// Who has the node or the cell.
	int  holderOf(Key key) const { return int(std::upper_bound(first.begin(), first.end(), key) - first.begin()); }
	bool owns(Key key) const { return holderOf(key) == processes->rank(); }

	/// First of each process among sorted keys, and their number.
	std::vector<int> startsAmong(const std::vector<Key>& sorted) const;

	/// The keys of all, from those that each process has in its own range.
	std::vector<Key> united(const std::vector<Key>& sorted) const;

	/// Behind what there is of the own points that of the copies, in their order. Numbers only.
	template <class T> void extend(std::vector<T>& ofPoints) const;

	double sum(double own) const;
	double largest(double own) const;
};

template <class T> void Division::extend(std::vector<T>& ofPoints) const
{
	static_assert(sizeof(T) % sizeof(double) == 0);
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

/// The lowest cell that a domain reaches, in a periodic grid the one that stands for it.
template <int Dim> Key lowestCell(const Vec<Dim>& position, const Vec<Dim>& halfSize, const Grid<Dim>&, Basis);

/// Points whose domains begin in a cell.
struct CellLoad {
	Key    lowest;
	double points;
};

/// Where the ranges of the processes begin (Division::first) so that their work is about the same: that of a point, and of the nodes that go with it.
std::vector<Key> cutByWork(std::vector<CellLoad> loads, int processes);

/// By how much the process that has most to do is above the mean of all, as a part of it.
double imbalance(const Processes&, const std::vector<CellLoad>& own);

/// The processes that need a point with this lowest cell: those that have a node which it may reach, and, where others need to know all points of their cells (`isWide`), one that
/// is a cell further. Rising.
template <int Dim> std::vector<int> neededBy(const Division&, Key lowest, const Grid<Dim>&, bool isWide);

/// As of one process, with the patches of the points of this one.
template <int Dim> CloudBasis<Dim> cloudBasis(const PointCloud<Dim>&, const Grid<Dim>&, Basis, const Boundary<Dim>&, const Division&);

} // namespace gimpm
