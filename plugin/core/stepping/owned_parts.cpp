// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/owned_parts.hpp"
#include "core/base/even_parts.hpp"
#include <algorithm>
#include <limits>

namespace gimpm {
namespace {

/// Work of each node, in multiples of the mean assembly.
template <int Dim> std::vector<double> workOf(const CloudBasis<Dim>& basis)
{
	std::vector<double> work(basis.nodes.size(), solveOverAssembly);
	double              touches = 0;
	for (const auto& patch : basis.patches)
		for (const int node : patch.node)
			touches += node >= 0 ? patch.count : 0;
	for (const auto& patch : basis.patches)
		for (const int node : patch.node)
			if (node >= 0) work[node] += patch.count * double(work.size()) / touches;
	return work;
}

template <class Nodes> bool touches(const OwnedNodes& ownedNodes, const Nodes& nodes)
{
	return std::any_of(
	        std::begin(nodes), std::end(nodes), [first = ownedNodes.first(), last = ownedNodes.last()](int node) { return node >= first && node < last; });
}

/// Keeps of each tile, which one thread does, the patches from the first to the last one that touch a node of this
/// process.
template <int Dim> void keepTouching(const OwnedNodes& ownedNodes, const std::vector<Patch<Dim>>& patches, std::vector<std::pair<int, int>>& tiles)
{
	std::vector<std::pair<int, int>> kept;
	for (auto [first, last] : tiles) {
		while (first < last && !touches(ownedNodes, patches[first].node))
			++first;
		while (first < last && !touches(ownedNodes, patches[last - 1].node))
			--last;
		if (first < last) kept.push_back({ first, last });
	}
	tiles.swap(kept);
}

/// No others, of which some points may be missing. What follows a gap in a tile is done after all the rest of its
/// colour: a tile stays with one thread.
template <int Dim> Colours<Dim> onlyTouching(const OwnedNodes& ownedNodes, const CloudBasis<Dim>& basis)
{
	const std::size_t count = basis.colours.size();
	Colours<Dim>      kept(count);
	for (std::size_t c = 0; c < count; ++c)
		for (const auto& [first, last] : basis.colours[c]) {
			std::size_t colour = c;
			for (int i = first, begin = first; i <= last; ++i) {
				if (i < last && touches(ownedNodes, basis.patches[i].node)) continue;
				if (colour >= kept.size()) kept.resize(kept.size() + count);
				if (begin < i) kept[colour].push_back({ begin, i }), colour += count;
				begin = i + 1;
			}
		}
	return kept;
}

} // namespace

/// First nodes of the processes: the one that has the points around a node has its row; those that know all points
/// divide the work.
template <int Dim> std::vector<int> OwnedParts<Dim>::startsAmong(const Processes& processes, const CloudBasis<Dim>& basis, const Division& division)
{
	if (processes.size() == 1) return { 0, int(basis.nodes.size()) };
	return division.isWhole() ? evenParts(workOf(basis), processes.size()) : division.startsAmong(basis.nodes);
}

template <int Dim>
OwnedParts<Dim>::OwnedParts(const Processes& processes, const CloudBasis<Dim>& basis, const std::vector<GhostFace<Dim>>& faces, const Division& division)
        : basis_(basis)
        , allFaces_(faces)
        , division_(division)
        , nodes_ { processes, startsAmong(processes, basis, division) }
        , known_(division.shareOf(basis.nodes))
{
	if (nodes_.isWhole()) return;
	colours_ = division.isWhole() ? basis.colours : onlyTouching(nodes_, basis);
	for (auto& tiles : colours_)
		keepTouching(nodes_, basis.patches, tiles);
	std::copy_if(faces.begin(), faces.end(), std::back_inserter(faces_), [&](const auto& face) {
		return std::any_of(std::begin(face.node), std::end(face.node), [&](const auto& nodes) { return touches(nodes_, nodes); });
	});
}

template <int Dim> std::optional<PointFailure> OwnedParts<Dim>::firstOf(const std::optional<PointFailure>& failure) const
{
	constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
	std::int64_t           code = failure ? 2 * division_.idOf(failure->point) + (failure->reason == PointFailure::Reason::noResponse) : none;
	nodes_.processes.smallest(&code, 1);
	if (code == none) return std::nullopt;
	return PointFailure { int(code / 2), code % 2 ? PointFailure::Reason::noResponse : PointFailure::Reason::inverted };
}

template <int Dim> bool haveSamePoints(const Processes& processes, const PointCloud<Dim>& cloud)
{
	return haveSame(processes, [&] { return checksumOf(cloud); });
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template class OwnedParts<Dim>;                                                                                                                        \
	template bool haveSamePoints(const Processes&, const PointCloud<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
