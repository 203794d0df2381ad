// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/mass_matrix.hpp"
#include "core/grid/masters.hpp"
#include "core/grid/point_nodes.hpp"
#include <algorithm>
#include <cstring>

namespace gimpm {
namespace {

/// Position of node n of a patch along each axis, as the code of a node matrix.
template <int Dim> int codeOf(const Patch<Dim>& patch, int n)
{
	std::array<int, 3> along {};
	for (int a = 0; a < Dim; n /= patch.nodesAlong(a), ++a)
		along[a] = n % patch.nodesAlong(a);
	return NodeMatrix<Dim>::code(along);
}

/// Adds up what is in the same row of a column, in ascending order.
void mergeColumn(std::vector<std::pair<int, double>>& column, SymmetricCsc& out)
{
	std::stable_sort(column.begin(), column.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
	for (std::size_t e = 0; e < column.size(); ++e)
		if (e > 0 && column[e].first == column[e - 1].first) out.value.back() += column[e].second;
		else
			out.row.push_back(column[e].first), out.value.push_back(column[e].second);
	out.start.push_back(int(out.row.size()));
}

} // namespace

template <int Dim>
MassMatrix<Dim>::MassMatrix(
        const CloudBasis<Dim>& basis, const std::vector<double>& masses, const std::vector<GhostFace<Dim>>& faces, double h,
        const std::vector<LooseCell<Dim>>& loose, double share)
        : MassMatrix(basis.nodes.size(), loose, share)
{
	forPointNodes(basis, [&](int p, const Patch<Dim>& patch, const double* value, int count) {
		const double m = masses[basis.order[p]];
		int          code[windowNodes<Dim>];
		for (int n = 0; n < count; ++n)
			code[n] = codeOf(patch, n);
		for (int a = 0; a < count; ++a)
			for (int b = a; b < count && patch.node[a] >= 0; ++b)
				if (patch.node[b] >= 0) add(patch.node[a], patch.node[b], code[b] - code[a], m * value[a] * value[b]);
	});
	forGhostPairs<Dim>(faces, h, [&](int a, int b, int code, double m) { add(a, b, code, m); });
}

template <int Dim>
MassMatrix<Dim>::MassMatrix(std::size_t nodes, const std::vector<LooseCell<Dim>>& loose, double share) : value_(nodes * codes, 0), neighbour_(value_.size(), -1)
{
	lump(loose, share);
}

template <int Dim> void MassMatrix<Dim>::lump(const std::vector<LooseCell<Dim>>& cells, double share)
{
	constexpr int    corners = LooseCell<Dim>::corners;
	const Patch<Dim> patch {};
	for (const auto& cell : cells) {
		const auto   n = corners - std::count(cell.node.begin(), cell.node.end(), -1);
		const double m = share * cell.mass / n;
		for (int a = 0; a < corners; ++a)
			for (int b = a; b < corners && cell.node[a] >= 0; ++b)
				if (cell.node[b] >= 0) add(cell.node[a], cell.node[b], codeOf(patch, b) - codeOf(patch, a), (a == b) * m - m / n);
	}
}

/// Values, and which there are, a bit for each code.
template <int Dim> void MassMatrix<Dim>::complete(const OwnedNodes& ownedNodes, const std::vector<Key>& nodes)
{
	if (ownedNodes.isWhole()) return;
	std::vector<int> start(ownedNodes.start);
	for (int& row : start)
		row *= codes;
	ownedNodes.processes.gather(value_.data(), start.data());
	Eigen::VectorXd bits(nodes.size()); // they are told as they are
	for (int a = ownedNodes.first(); a < ownedNodes.last(); ++a) {
		std::uint64_t ofNode = 0;
		for (int code = 0; code < codes; ++code)
			ofNode |= std::uint64_t(neighbour_[std::size_t(a) * codes + code] >= 0) << code;
		std::memcpy(&bits[a], &ofNode, sizeof ofNode);
	}
	ownedNodes.complete(bits);
	NodeMatrix<Dim> pattern; // without values
	pattern.reset(nodes, true, {}, { 0, 0 });
	for (int a = 0; a < int(nodes.size()); ++a) {
		std::uint64_t ofNode;
		std::memcpy(&ofNode, &bits[a], sizeof ofNode);
		for (int code = 0; code < codes; ++code)
			neighbour_[std::size_t(a) * codes + code] = ofNode >> code & 1 ? pattern.neighbour(a, code) : -1;
	}
}

template <int Dim> void MassMatrix<Dim>::mark(NodeMatrix<Dim>& K) const
{
	forEntries([&](int a, int, int code, double) { K.markUsed(a, code); });
}

template <int Dim> void MassMatrix<Dim>::addTo(NodeMatrix<Dim>& K, double factor) const
{
	forEntries([&](int a, int, int code, double m) {
		for (int i = 0; i < Dim && K.keeps(a); ++i)
			K.at(a, code)[i * (Dim + 1)] += factor * m;
	});
}

template <int Dim> template <class F> Eigen::VectorXd MassMatrix<Dim>::product(const Eigen::VectorXd& x, F&& weight) const
{
	Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
	forEntries([&](int a, int b, int, double m) {
		y.segment<Dim>(Dim * a) += weight(m) * x.segment<Dim>(Dim * b);
		if (b != a) y.segment<Dim>(Dim * b) += weight(m) * x.segment<Dim>(Dim * a);
	});
	return y;
}

template <int Dim> Eigen::VectorXd MassMatrix<Dim>::operator*(const Eigen::VectorXd& x) const
{
	return product(x, [](double m) { return m; });
}

template <int Dim> Eigen::VectorXd MassMatrix<Dim>::absoluteTimes(const Eigen::VectorXd& x) const
{
	return product(x.cwiseAbs(), [](double m) { return std::abs(m); });
}

template <int Dim> SymmetricCsc MassMatrix<Dim>::reduced(const FreeDofs& dofs, int axis) const
{
	std::vector<int> number(nodes(), -1);
	int              count = 0;
	for (int n = 0; n < nodes(); ++n)
		if (dofs.number[Dim * n + axis] >= 0) number[n] = count++;
	std::vector<std::vector<std::pair<int, double>>> columns(count);
	const MastersOf                                  masters(nodes(), dofs.affineConstraints);
	forEntries([&](int a, int b, int, double m) {
		masters.eachPair(a, b, [&](int p, int q, double part) {
			if (number[p] < 0 || number[q] < 0 || (a == b && p < q)) return;
			const double both = a != b && p == q ? 2 : 1; // sum of both sides of the diagonal
			columns[std::min(number[p], number[q])].emplace_back(std::max(number[p], number[q]), both * part * m);
		});
	});
	SymmetricCsc out;
	out.start = { 0 };
	for (auto& column : columns)
		mergeColumn(column, out);
	return out;
}

template class MassMatrix<2>;
template class MassMatrix<3>;

} // namespace gimpm
