// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/reduce.hpp"
#include "core/solvers/block_sums.hpp"

namespace gimpm {
namespace {

/// Calls f(row, column, value) for the entries of the free rows and columns. Nodes are taken in their order, so the
/// rows of each column rise.
template <int Dim, class F> void forFreeEntries(const NodeMatrix<Dim>& K, const FreeDofs& dofs, F&& f)
{
	for (int a = 0; a < K.nodes(); ++a)
		for (int c = 0; c < NodeMatrix<Dim>::codes; ++c) {
			if (!K.used(a, c)) continue;
			const int     b     = K.neighbour(a, c);
			const double *above = K.at(a, c), *skew = K.isSymmetric() ? nullptr : K.skewAt(a, c);
			for (int i = 0, k = 0; i < Dim; ++i)
				for (int j = 0; j < Dim; ++j, ++k) {
					const int p = dofs.number[Dim * a + i], q = dofs.number[Dim * b + j];
					if (p < 0 || q < 0) continue;
					f(p, q, above[k]);
					if (b != a) f(q, p, skew ? above[k] + skew[k] : above[k]);
				}
		}
}

/// Columns of the entries for which forEntries(f) calls f(row, column, value), twice the same, in their order.
template <class Entries> void fill(Csc& out, int size, Entries&& forEntries)
{
	out.start.assign(size + 1, 0);
	forEntries([&](int, int column, double) { ++out.start[column + 1]; });
	for (int c = 0; c < size; ++c)
		out.start[c + 1] += out.start[c];
	out.row.resize(out.start.back());
	out.value.resize(out.start.back());
	std::vector<int> next(out.start.begin(), out.start.end() - 1);
	forEntries([&](int row, int column, double value) {
		const int e  = next[column]++;
		out.row[e]   = row;
		out.value[e] = value;
	});
}

/// Appends a column for a displacement of a node, from its rows and those of its neighbours, which rise.
template <int Dim> void appendColumn(const NodeMatrix<Dim>& K, const FreeDofs& dofs, int node, int i, Csc& out)
{
	for (int c = 0; c < NodeMatrix<Dim>::codes; ++c) {
		if (!K.used(node, c)) continue;
		const int b = K.neighbour(node, c);
		// Row i of K_ab is the part of this column in block (b, a).
		const double* k = K.at(node, c) + i * Dim;
		for (int j = b == node ? i : 0; j < Dim; ++j)
			if (dofs.number[Dim * b + j] >= 0) {
				out.row.push_back(dofs.number[Dim * b + j]);
				out.value.push_back(k[j]);
			}
	}
}

/// Appends couplings of a symmetric matrix that keeps the blocks of each row from the diagonal on: they are those of
/// the column below it. Fields below the first are left out.
void appendCouplings(const Couplings& K, const FreeDofs& dofs, const FieldNode& fieldNode, int i, Csc& out, int firstField = 0)
{
	const DofMap& map   = K.map();
	const double  ofRow = K.signOf(fieldNode.field) * map[fieldNode.field].scale;
	K.forBlocksOf(fieldNode, [&](const FieldNode& other, const double* values) {
		if (other.field < firstField) return;
		const int    width = map[other.field].width, first = map.at(other.field, other.node);
		const bool   isDiagonal = other.field == fieldNode.field && other.node == fieldNode.node;
		const double weight     = ofRow * map[other.field].scale;
		for (int j = isDiagonal ? i : 0; j < width; ++j)
			if (dofs.number[first + j] >= 0) {
				out.row.push_back(dofs.number[first + j]);
				out.value.push_back(weight * values[i * width + j]);
			}
	});
}

/// Appends a column for a displacement of a node with couplings among them: rows of neighbours and of nodes that are
/// coupled, both of which rise. The block on the diagonal contributes its part below the diagonal.
template <int Dim> void appendMerged(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const Couplings& couplings, int node, int i, Csc& out)
{
	const auto append = [&](int b, const double* k, const double* coupled) {
		for (int j = b == node ? i : 0; j < Dim; ++j) {
			const int row = dofs.number[Dim * b + j], at = b == node ? j * Dim + i : i * Dim + j;
			if (row < 0) continue;
			out.row.push_back(row);
			out.value.push_back(k && coupled ? k[at] + coupled[at] : k ? k[at] : coupled[at]);
		}
	};
	int        code        = 0;
	const auto appendUntil = [&](int end) { // the node whose block comes next, unless that is at `end`
		for (; code < NodeMatrix<Dim>::codes; ++code) {
			if (!K.used(node, code)) continue;
			const int b = K.neighbour(node, code);
			if (b >= end) return b;
			append(b, K.at(node, code), nullptr);
		}
		return -1;
	};
	bool areOthers = false; // the fields behind the displacements
	couplings.forBlocksOf({ 0, node }, [&](const FieldNode& other, const double* values) {
		areOthers = areOthers || other.field > 0;
		if (areOthers) return;
		const bool isShared = appendUntil(other.node) == other.node;
		append(other.node, isShared ? K.at(node, code) : nullptr, values);
		code += isShared;
	});
	appendUntil(K.nodes());
	if (areOthers) appendCouplings(couplings, dofs, { 0, node }, i, out, 1);
}

/// Column by column, where nothing has to be sorted or added up.
template <int Dim> void reduceInOrder(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const Couplings* couplings, SymmetricCsc& out)
{
	out.start.assign(1, 0);
	out.row.clear();
	out.value.clear();
	const int  fields  = couplings ? couplings->map().fields() : 1;
	const bool isMixed = couplings && couplings->areWithinDisplacements();
	double     widths  = 0; // unknowns a node of all fields
	for (int field = 0; field < fields; ++field)
		widths += field == 0 ? Dim : couplings->map()[field].width;
	const auto most = std::size_t(double(K.nodes()) * K.codes * widths * widths); // upper limit: all unknowns of neighbours are coupled
	out.row.reserve(most), out.value.reserve(most);
	for (int field = 0, unknown = 0; field < fields; ++field)
		for (int a = 0; a < K.nodes(); ++a)
			for (int i = 0, width = field == 0 ? Dim : couplings->map()[field].width; i < width; ++i, ++unknown) {
				if (dofs.number[unknown] < 0) continue;
				if (field == 0 && !isMixed) appendColumn(K, dofs, a, i, out);
				if (field == 0 && isMixed) appendMerged(K, dofs, *couplings, a, i, out);
				else if (couplings)
					appendCouplings(*couplings, dofs, { field, a }, i, out);
				out.start.push_back(int(out.row.size()));
			}
}

} // namespace

template <int Dim> void reduce(const NodeMatrix<Dim>& K, const FreeDofs& dofs, SymmetricCsc& out, const Couplings* couplings)
{
	if (K.isPeriodic() || dofs.affineConstraints) return addUp(K, dofs, couplings, true, out);
	reduceInOrder(K, dofs, couplings, out);
}

template <int Dim> void reduce(const NodeMatrix<Dim>& K, const FreeDofs& dofs, GeneralCsc& out, const Couplings* couplings)
{
	if (K.isPeriodic() || dofs.affineConstraints || couplings) return addUp(K, dofs, couplings, false, out);
	fill(out, dofs.count, [&](auto&& f) { forFreeEntries(K, dofs, f); });
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template void reduce(const NodeMatrix<Dim>&, const FreeDofs&, SymmetricCsc&, const Couplings*);                                                        \
	template void reduce(const NodeMatrix<Dim>&, const FreeDofs&, GeneralCsc&, const Couplings*);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
