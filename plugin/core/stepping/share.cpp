// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/share.hpp"
#include <algorithm>
#include <cstring>
#include <limits>

namespace gimpm {
namespace {

/// A solve goes with the nodes, an assembly with their points: on the slope in 3D the solves take twice as long.
constexpr double solveOverAssembly = 2;

/// What each node takes, in multiples of the mean assembly.
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

/// First node of each process, and their number.
template <int Dim> std::vector<int> cutByWork(const CloudBasis<Dim>& basis, int processes)
{
	const auto work  = workOf(basis);
	double     whole = 0, before = 0;
	for (const double w : work)
		whole += w;
	std::vector<int> start { 0 };
	for (int n = 0; n < int(work.size()); ++n) {
		while (int(start.size()) < processes && before >= whole * double(start.size()) / processes)
			start.push_back(n);
		before += work[n];
	}
	start.resize(processes + 1, int(work.size()));
	return start;
}

template <class Nodes> bool touches(const NodeShare& share, const Nodes& nodes)
{
	return std::any_of(std::begin(nodes), std::end(nodes), [first = share.first(), last = share.last()](int node) { return node >= first && node < last; });
}

/// Of each tile, which one thread does, the patches from the first to the last one that touch a node of this process.
template <int Dim> void keepTouching(const NodeShare& share, const std::vector<Patch<Dim>>& patches, std::vector<std::pair<int, int>>& tiles)
{
	std::vector<std::pair<int, int>> kept;
	for (auto [first, last] : tiles) {
		while (first < last && !touches(share, patches[first].node))
			++first;
		while (first < last && !touches(share, patches[last - 1].node))
			--last;
		if (first < last) kept.push_back({ first, last });
	}
	tiles.swap(kept);
}

/// Of bytes, eight at a time, in turn by several sums: one alone would wait for itself at each word, three times as long as reading takes.
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

/// No others, of which some points may be missing. What follows a gap in a tile is done after all the rest of its colour: a tile stays with one thread.
template <int Dim> Colours<Dim> onlyTouching(const NodeShare& share, const CloudBasis<Dim>& basis)
{
	const std::size_t count = basis.colours.size();
	Colours<Dim>      kept(count);
	for (std::size_t c = 0; c < count; ++c)
		for (const auto& [first, last] : basis.colours[c]) {
			std::size_t colour = c;
			for (int i = first, begin = first; i <= last; ++i) {
				if (i < last && touches(share, basis.patches[i].node)) continue;
				if (colour >= kept.size()) kept.resize(kept.size() + count);
				if (begin < i) kept[colour].push_back({ begin, i }), colour += count;
				begin = i + 1;
			}
		}
	return kept;
}

} // namespace

template <int Dim>
Share<Dim>::Share(const Processes& processes, const CloudBasis<Dim>& basis, const std::vector<GhostFace<Dim>>& faces, const Division* division)
        : division_(division), nodes_ { processes, division ? division->startsAmong(basis.nodes) : cutByWork(basis, processes.size()) }, colours_(basis.colours)
{
	if (division) colours_ = onlyTouching(nodes_, basis);
	for (auto& tiles : colours_)
		keepTouching(nodes_, basis.patches, tiles);
	std::copy_if(faces.begin(), faces.end(), std::back_inserter(faces_), [&](const auto& face) {
		return std::any_of(std::begin(face.node), std::end(face.node), [&](const auto& nodes) { return touches(nodes_, nodes); });
	});
}

template <int Dim> std::optional<PointFailure> Share<Dim>::firstOf(const std::optional<PointFailure>& failure) const
{
	constexpr std::int64_t none   = std::numeric_limits<std::int64_t>::max();
	const auto             number = [&] { return division_ ? division_->idOf(failure->point) : failure->point; };
	std::int64_t           code   = failure ? 2 * number() + (failure->reason == PointFailure::Reason::noResponse) : none;
	nodes_.processes.smallest(&code, 1);
	if (code == none) return std::nullopt;
	return PointFailure { int(code / 2), code % 2 ? PointFailure::Reason::noResponse : PointFailure::Reason::inverted };
}

template <int Dim> bool haveSamePoints(const Processes& processes, const PointCloud<Dim>& cloud)
{
	Checksum sum;
	sum.mix(cloud.position), sum.mix(cloud.halfSize), sum.mix(cloud.volume0), sum.mix(cloud.defGrad), sum.mix(cloud.hoopStretch);
	sum.mix(cloud.elasticStrain), sum.mix(cloud.stress), sum.mix(cloud.force), sum.mix(cloud.material);
	for (const auto* columns : { &cloud.internals, &cloud.parameters })
		for (const auto& column : *columns)
			sum.mix(column);
	return processes.haveSame(sum.take() ^ cloud.size());
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template class Share<Dim>;                                                                                                                             \
	template bool haveSamePoints(const Processes&, const PointCloud<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
