// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/shared_blocks.hpp"
#include "core/parallel/together.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// Calls f(own node, neighbour or node that is coupled) for each pair, of which both may be own.
template <int Dim, class F> void forOwnPairs(const NodeMatrix<Dim>& K, const OwnedNodes& ownedNodes, const Couplings* couplings, F&& f)
{
	const int  first = ownedNodes.first(), last = ownedNodes.last();
	const auto isOwn = [&](int node) { return node >= first && node < last; };
	for (int a = 0; a < K.nodes(); ++a)
		for (int c = 0; c < K.codes && K.keeps(a); ++c) {
			const int b = K.used(a, c) ? K.neighbour(a, c) : a;
			if (isOwn(a)) f(a, b);
			if (isOwn(b)) f(b, a);
		}
	if (!couplings) return;
	couplings->forBlocks([&](const FieldNode& row, const FieldNode& column, const double*) {
		if (isOwn(row.node)) f(row.node, column.node);
		if (isOwn(column.node)) f(column.node, row.node);
	});
}

} // namespace

template <int Dim>
SharedBlocks<Dim>::SharedBlocks(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const OwnedNodes& ownedNodes, const Couplings* couplings)
        : ownedNodes_(ownedNodes)
        , here_(hereOf(K, ownedNodes, couplings))
        , blocks_(K, dofs, here_, { ownedNodes.first(), ownedNodes.last() })
        , x_(Eigen::VectorXd::Zero(Dim * (here_.second - here_.first)))
        , y_(x_)
{
	findBorders(K, couplings);
	if (!couplings) return;
	entries_ = freeEntries(*couplings, dofs);
	entries_.erase(
	        std::remove_if(entries_.begin(), entries_.end(), [&](const MatrixEntry& entry) { return !ownedNodes.owns(entry.row / Dim); }), entries_.end());
	for (auto& entry : entries_)
		entry.row -= Dim * here_.first, entry.column -= Dim * here_.first;
}

template <int Dim>
typename SharedBlocks<Dim>::Range SharedBlocks<Dim>::hereOf(const NodeMatrix<Dim>& K, const OwnedNodes& ownedNodes, const Couplings* couplings)
{
	Range here(ownedNodes.first(), ownedNodes.last());
	forOwnPairs(K, ownedNodes, couplings, [&](int, int b) { here = { std::min(here.first, b), std::max(here.second, b + 1) }; });
	return here;
}

template <int Dim> void SharedBlocks<Dim>::findBorders(const NodeMatrix<Dim>& K, const Couplings* couplings)
{
	const auto ownerOf
	        = [&](int node) { return int(std::upper_bound(ownedNodes_.start.begin(), ownedNodes_.start.end(), node) - ownedNodes_.start.begin()) - 1; };
	const int first = ownedNodes_.first(), last = ownedNodes_.last();
	forOwnPairs(K, ownedNodes_, couplings, [&](int a, int b) {
		if (b >= first && b < last) return;
		Border& border = borders_[ownerOf(b)];
		border.own.push_back(a), border.others.push_back(b);
	});
	for (auto& [process, border] : borders_) {
		for (auto* nodes : { &border.own, &border.others }) {
			std::sort(nodes->begin(), nodes->end());
			nodes->erase(std::unique(nodes->begin(), nodes->end()), nodes->end());
		}
		border.sent.resize(Dim * border.own.size());
		border.received.resize(Dim * border.others.size());
	}
}

/// Fetches values at the nodes that are here: those of this process, and from others those of their nodes.
template <int Dim> void SharedBlocks<Dim>::fetch(const Eigen::VectorXd& x) const
{
	x_.segment(Dim * (ownedNodes_.first() - here_.first), x.size()) = x;
	std::vector<Message> messages;
	for (auto& [process, border] : borders_) {
		for (std::size_t n = 0; n < border.own.size(); ++n)
			border.sent.template segment<Dim>(Dim * n) = x.template segment<Dim>(Dim * (border.own[n] - ownedNodes_.first()));
		messages.push_back({ process, border.sent.data(), int(border.sent.size()), border.received.data(), int(border.received.size()) });
	}
	ownedNodes_.processes.exchange(messages.data(), int(messages.size()));
	for (const auto& [process, border] : borders_)
		for (std::size_t n = 0; n < border.others.size(); ++n)
			x_.template segment<Dim>(Dim * (border.others[n] - here_.first)) = border.received.template segment<Dim>(Dim * n);
}

template <int Dim> void SharedBlocks<Dim>::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const
{
	fetch(x);
	blocks_.multiply(x_, y_);
	for (const MatrixEntry& entry : entries_)
		y_[entry.row] += entry.value * x_[entry.column];
	y = y_.segment(Dim * (ownedNodes_.first() - here_.first), x.size());
}

template <int Dim> Eigen::VectorXd SharedBlocks<Dim>::diagonal() const
{
	Eigen::VectorXd diagonal = blocks_.diagonal();
	for (const MatrixEntry& entry : entries_)
		if (entry.row == entry.column) diagonal[entry.row] += entry.value;
	return diagonal.segment(Dim * (ownedNodes_.first() - here_.first), Dim * (ownedNodes_.last() - ownedNodes_.first()));
}

template <int Dim> double SharedBlocks<Dim>::norm(const Eigen::VectorXd& x) const { return normOfAll(ownedNodes_.processes, x.stableNorm()); }

template <int Dim> void SharedBlocks<Dim>::complete(double* sums, int count) const { addUp(ownedNodes_.processes, sums, count); }

template class SharedBlocks<2>;
template class SharedBlocks<3>;

} // namespace gimpm
