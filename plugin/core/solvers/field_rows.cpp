// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/field_rows.hpp"
#include <algorithm>
#include <limits>

namespace gimpm {
namespace {

/// B K^-1 A over the diagonal of B D^-1 A, where D is that of K. Of smooth fields it is about 4, of waves of two cells
/// nothing, which the iterations see to; between these there are fewest of them.
constexpr double overDiagonal = 2;

template <int Dim> class FieldRows {
public:
	FieldRows(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const OwnedNodes& ownedNodes, const Couplings& couplings)
	        : K_(K), dofs_(dofs), ownedNodes_(ownedNodes), couplings_(couplings), map_(couplings.map()), row_(K.nodes(), -1)
	{
		for (int field = 0; field < map_.fields(); ++field)
			before_.push_back(width_), width_ += map_[field].width;
		for (int a = 0; a < K.nodes(); ++a) {
			if (!isFree(a)) continue;
			row_[a] = int(nodes_.size());
			nodes_.push_back(a);
			if (a < ownedNodes.first()) begin_ = int(nodes_.size());
			if (a < ownedNodes.last()) end_ = int(nodes_.size());
		}
		findColumns();
	}

	std::size_t entries() const
	{
		std::size_t blocks = 0;
		for (const auto& columns : columns_)
			blocks += columns.size();
		return blocks * width_ * width_;
	}

	NodeRows make() const
	{
		NodeRows out { width_, width_ * int(nodes_.size()), width_ * begin_, {}, {}, {}, {}, {}, {}, {}, {}, {} };
		for (int field = 0; field < map_.fields(); ++field)
			out.widths.push_back(map_[field].width);
		for (int n = 0; n < int(nodes_.size()); ++n)
			forUnknowns(nodes_[n], [&](int i) {
				out.columnDof.push_back(i);
				if (isOwn(n)) out.dof.push_back(i);
			});
		startRows(out);
		fill(out);
		addEliminated(out);
		if (!K_.isPeriodic()) fieldNode(out);
		return out;
	}

private:
	template <class F> void forUnknowns(int node, F&& f) const
	{
		for (int field = 0; field < map_.fields(); ++field)
			for (int i = map_.at(field, node); i < map_.at(field, node) + map_[field].width; ++i)
				f(i);
	}
	bool isFree(int node) const
	{
		bool is = false;
		forUnknowns(node, [&](int i) { is |= dofs_.number[i] >= 0; });
		return is;
	}
	bool isConstrained(const FieldNode& fieldNode, int component) const { return dofs_.number[map_.at(fieldNode.field, fieldNode.node) + component] < 0; }
	bool isOwn(int row) const { return row >= begin_ && row < end_; }

	/// Calls f(row, column, value, opposite) for the blocks in own rows; value(i, j) is K_ij, opposite(i, j) K_ji.
	template <class F> void forBlocks(F&& f) const
	{
		forNeighbours(f);
		forCouplings(f);
	}
	template <class F> void forNeighbours(F&& f) const
	{
		for (const int a : nodes_)
			for (int c = 0; c < K_.codes; ++c) {
				if (c > 0 && !K_.used(a, c)) continue;
				const int b = K_.neighbour(a, c);
				if (row_[b] < 0 || !(isOwn(row_[a]) || isOwn(row_[b]))) continue; // it may not be here
				const double *K = K_.at(a, c), *skew = c == 0 || K_.isSymmetric() ? nullptr : K_.skewAt(a, c);
				const auto    stored = [K](int i, int j) { return K[Dim * i + j]; };
				const auto    beyond = [K, skew](int i, int j) { return K[Dim * i + j] + (skew ? skew[Dim * i + j] : 0); };
				const auto    turned = [](const auto& of) { return [of](int i, int j) { return of(j, i); }; };
				if (c == 0) f(FieldNode { 0, a }, FieldNode { 0, a }, stored, turned(stored));
				else {
					if (isOwn(row_[a])) f(FieldNode { 0, a }, FieldNode { 0, b }, stored, beyond);
					if (isOwn(row_[b])) f(FieldNode { 0, b }, FieldNode { 0, a }, turned(beyond), turned(stored));
				}
			}
	}
	template <class F> void forCouplings(F&& f) const
	{
		couplings_.forBlocks([&](const FieldNode& row, const FieldNode& column, const double* values) {
			const int a = row_[row.node], b = row_[column.node];
			if (a < 0 || b < 0) return;
			const int     rows = map_[row.field].width, columns = map_[column.field].width;
			const double  scale    = couplings_.signOf(row.field) * map_[row.field].scale * map_[column.field].scale;
			const double* mirror   = couplings_.opposite(row, column);
			const bool    isItself = row.field == column.field && row.node == column.node;
			const auto    value    = [=](int i, int j) { return scale * values[columns * i + j]; };
			const auto    opposite = [=](int i, int j) { return scale * (mirror ? mirror[rows * j + i] : values[columns * i + j]); };
			if (isOwn(a)) f(row, column, value, opposite);
			if (couplings_.isSymmetric() && !isItself && isOwn(b)) {
				const auto turned = [=](int i, int j) { return value(j, i); };
				f(column, row, turned, turned);
			}
		});
	}

	void findColumns()
	{
		columns_.resize(end_ - begin_);
		for (int n = begin_; n < end_; ++n)
			columns_[n - begin_].push_back(n);
		forBlocks(
		        [&](const FieldNode& row, const FieldNode& column, auto&&, auto&&) { columns_[row_[row.node] - begin_].push_back(row_[column.node]); });
		for (auto& columns : columns_) {
			std::sort(columns.begin(), columns.end());
			columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
		}
	}

	void startRows(NodeRows& out) const
	{
		out.start.push_back(0);
		out.column.reserve(entries());
		for (const auto& columns : columns_)
			for (int i = 0; i < width_; ++i) {
				for (const int node : columns)
					for (int j = 0; j < width_; ++j)
						out.column.push_back(width_ * node + j);
				out.start.push_back(int(out.column.size()));
			}
		out.value.assign(out.column.size(), 0.);
		out.symmetricPart = out.value;
	}

	/// Begin of a block among the values: its row i is this far from the begin of the row.
	int offset(const FieldNode& row, const FieldNode& column) const
	{
		const auto& columns = columns_[row_[row.node] - begin_];
		return width_ * int(std::lower_bound(columns.begin(), columns.end(), row_[column.node]) - columns.begin()) + before_[column.field];
	}
	int rowOf(const FieldNode& fieldNode, int component) const { return width_ * (row_[fieldNode.node] - begin_) + before_[fieldNode.field] + component; }
	static bool isSame(const FieldNode& a, const FieldNode& b) { return a.field == b.field && a.node == b.node; }

	void fill(NodeRows& out) const
	{
		std::vector<double> ofHeld(out.dof.size(), 0.);
		forBlocks([&](const FieldNode& row, const FieldNode& column, auto&& value, auto&& opposite) {
			const int at = offset(row, column);
			for (int i = 0; i < map_[row.field].width; ++i)
				for (int j = 0; j < map_[column.field].width; ++j) {
					const int r = rowOf(row, i), e = out.start[r] + at + j;
					if (isConstrained(row, i) || isConstrained(column, j)) {
						if (isSame(row, column) && i == j) ofHeld[r] += value(i, i);
						continue;
					}
					out.value[e] += value(i, j);
					out.symmetricPart[e] += row.field == column.field ? (value(i, j) + opposite(i, j)) / 2 : value(i, j);
				}
		});
		for (int r = 0; r < int(out.dof.size()); ++r) {
			if (dofs_.number[out.dof[r]] >= 0) continue;
			const double diagonal = ofHeld[r] != 0 ? ofHeld[r] : 1;
			out.held.push_back({ r, diagonal });
			out.value[diagonalOf(out, r)] = out.symmetricPart[diagonalOf(out, r)] = diagonal;
		}
	}
	int diagonalOf(const NodeRows& out, int r) const
	{
		const auto first = out.column.begin() + out.start[r], last = out.column.begin() + out.start[r + 1];
		return int(std::lower_bound(first, last, out.first + r) - out.column.begin());
	}

	void addEliminated(NodeRows& out) const
	{
		const Eigen::VectorXd D = diagonalOfDisplacements(out);
		forCouplings([&](const FieldNode& row, const FieldNode& column, auto&& value, auto&& opposite) {
			if (row.field == 0 || column.field > 0) return;
			for (int i = 0; i < map_[row.field].width; ++i)
				for (int j = 0; j < Dim; ++j) {
					const double stiffness = D[Dim * column.node + j];
					if (isConstrained(row, i) || stiffness == 0) continue;
					out.symmetricPart[diagonalOf(out, rowOf(row, i))] -= overDiagonal * value(i, j) * opposite(i, j) / stiffness;
				}
		});
	}
	/// At all nodes; zero where they are held.
	Eigen::VectorXd diagonalOfDisplacements(const NodeRows& out) const
	{
		Eigen::VectorXd D = Eigen::VectorXd::Zero(map_.end(0));
		for (int r = 0; r < int(out.dof.size()); ++r)
			if (const int i = out.dof[r]; i < map_.end(0) && dofs_.number[i] >= 0) D[i] = out.value[diagonalOf(out, r)];
		ownedNodes_.complete(D);
		return D;
	}

	void fieldNode(NodeRows& out) const
	{
		Vec<Dim> mean = Vec<Dim>::Zero();
		for (const int a : nodes_)
			mean += Grid<Dim>::index(K_.keys()[a]).template cast<double>() / double(nodes_.size());
		for (int n = begin_; n < end_; ++n)
			for (int i = 0; i < Dim; ++i)
				out.position.push_back(Grid<Dim>::index(K_.keys()[nodes_[n]])[i] - mean[i]);
	}

	const NodeMatrix<Dim>&        K_;
	const FreeDofs&               dofs_;
	const OwnedNodes&             ownedNodes_;
	const Couplings&              couplings_;
	const DofMap&                 map_;
	int                           width_ = 0;           ///< unknowns a node, of all fields
	std::vector<int>              before_;              ///< unknowns of a node before each field
	std::vector<int>              row_, nodes_;         ///< number of each node among those with rows, or -1; and these
	int                           begin_ = 0, end_ = 0; ///< range of these nodes whose rows are wanted
	std::vector<std::vector<int>> columns_;             ///< columns of these rows, by numbers of nodes
};

} // namespace

template <int Dim> std::optional<NodeRows> fieldRows(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const OwnedNodes& ownedNodes, const Couplings& couplings)
{
	const FieldRows<Dim> rows(K, dofs, ownedNodes, couplings);
	if (rows.entries() > std::size_t(std::numeric_limits<int>::max())) return std::nullopt;
	return rows.make();
}

template std::optional<NodeRows> fieldRows(const NodeMatrix<2>&, const FreeDofs&, const OwnedNodes&, const Couplings&);
template std::optional<NodeRows> fieldRows(const NodeMatrix<3>&, const FreeDofs&, const OwnedNodes&, const Couplings&);

} // namespace gimpm
