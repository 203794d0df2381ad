// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/node_problem.hpp"
#include "core/solvers/field_rows.hpp"
#include "core/solvers/shared_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gimpm {
namespace {

/// Displacements of neighbours block by block, and of nodes that are apart entry by entry.
template <int Dim> class CoupledBlocks : public SymmetricOperator {
public:
	CoupledBlocks(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const Couplings& couplings) : blocks_(K, dofs), entries_(freeEntries(couplings, dofs)) { }
	void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override
	{
		blocks_.multiply(x, y);
		for (const MatrixEntry& entry : entries_)
			y[entry.row] += entry.value * x[entry.column];
	}
	Eigen::VectorXd diagonal() const override
	{
		Eigen::VectorXd diagonal = blocks_.diagonal();
		for (const MatrixEntry& entry : entries_)
			if (entry.row == entry.column) diagonal[entry.row] += entry.value;
		return diagonal;
	}

private:
	BlockMatrix<Dim>         blocks_;
	std::vector<MatrixEntry> entries_;
};

template <int Dim> class Problem : public NodeProblem {
public:
	Problem(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const OwnedNodes& ownedNodes, const Couplings* couplings)
	        : K_(K), dofs_(dofs), ownedNodes_(ownedNodes), couplings_(couplings)
	{
	}

	std::variant<SymmetricCsc, GeneralCsc> compressed() const override
	{
		const auto in = [&](auto form) {
			reduce(K_, dofs_, form, couplings_);
			return std::variant<SymmetricCsc, GeneralCsc>(std::move(form));
		};
		return K_.isSymmetric() ? in(SymmetricCsc()) : in(GeneralCsc());
	}
	std::unique_ptr<SymmetricOperator> blocks() const override
	{
		if (!ownedNodes_.isWhole()) return std::make_unique<SharedBlocks<Dim>>(K_, dofs_, ownedNodes_, couplings_);
		if (couplings_) return std::make_unique<CoupledBlocks<Dim>>(K_, dofs_, *couplings_);
		return std::make_unique<BlockMatrix<Dim>>(K_, dofs_);
	}
	bool isInSpace() const override { return Dim == 3; }
	bool isOfOneField() const override { return !couplings_ || couplings_->map().isAlone(); }
	bool hasSigns() const override
	{
		for (int field = 0; couplings_ && field < couplings_->map().fields(); ++field)
			if (couplings_->map()[field].sign < 0) return true;
		return false;
	}

	Eigen::VectorXd expanded(const Eigen::VectorXd& x) const override
	{
		Eigen::VectorXd all = Eigen::VectorXd::Zero(dofs_.number.size());
		forFree([&](int dof, int number) { all[dof] = x[number]; });
		return ownedNodes_.isWhole() ? all : Eigen::VectorXd(ownedNodes_.own(all));
	}
	Eigen::VectorXd ofFreeDofs(Eigen::VectorXd all) const override
	{
		if (!ownedNodes_.isWhole()) all = completed(all);
		Eigen::VectorXd x(dofs_.count);
		forFree([&](int dof, int number) { x[number] = all[dof]; });
		return x;
	}
	std::optional<NodeRows> rows() const override
	{
		return isOfOneField() ? nodeRows(K_, dofs_, ownedNodes_, couplings_) : fieldRows(K_, dofs_, ownedNodes_, *couplings_);
	}
	const OwnedNodes& ownedNodes() const override { return ownedNodes_; }
	Unknowns          unknowns() const override
	{
		Unknowns all { K_.keys(), {} };
		for (const int number : dofs_.number)
			all.isFree.push_back(number >= 0);
		return all;
	}
	bool needsMoreFlopsPerEntry(double flops) const override
	{
		std::vector<NodePosition> positions;
		double                    blocks = 0;
		for (const int a : freeNodes()) {
			positions.push_back(position(a));
			for (int c = 0; c < K_.codes; ++c)
				blocks += (c == 0 ? 1 : 2) * K_.used(a, c);
		}
		if (positions.empty()) return false;
		const double perNode = dofs_.count / double(positions.size()), blocksOfNode = blocks / double(positions.size());
		const double reach   = std::clamp((std::pow(blocksOfNode, 1. / Dim) - 1) / 2, 1., 2.);
		const double entries = 0.5 * (blocks + double(positions.size())) * perNode * perNode;
		return needsMoreFlops(std::move(positions), perNode, reach, flops * entries);
	}
	Order ordering() const override
	{
		const std::vector<int> nodes   = freeNodes();
		const Order            ofNodes = eliminationOrder(graphOf(nodes));
		Order                  order;
		int                    taken = 0;
		for (const int n : ofNodes.numbers) {
			forUnknowns(nodes[n], [&](int i) {
				if (dofs_.number[i] >= 0) order.numbers.push_back(dofs_.number[i]);
			});
			if (++taken == ofNodes.first) order.first = int(order.numbers.size());
			if (taken == ofNodes.first + ofNodes.second) order.second = int(order.numbers.size()) - order.first;
		}
		return order;
	}

private:
	Eigen::VectorXd completed(const Eigen::VectorXd& own) const
	{
		Eigen::VectorXd all(dofs_.number.size());
		ownedNodes_.own(all) = own;
		ownedNodes_.complete(all);
		return all;
	}
	/// Calls f(unknown) for those of a node, of all fields.
	template <class F> void forUnknowns(int node, F&& f) const
	{
		for (int i = Dim * node; i < Dim * (node + 1); ++i)
			f(i);
		if (isOfOneField()) return;
		const DofMap& map = couplings_->map();
		for (int field = 1; field < map.fields(); ++field)
			for (int i = map.at(field, node); i < map.at(field, node) + map[field].width; ++i)
				f(i);
	}
	/// Those of which not all unknowns are held.
	std::vector<int> freeNodes() const
	{
		std::vector<int> nodes;
		for (int a = 0; a < K_.nodes(); ++a) {
			bool isFree = false;
			forUnknowns(a, [&](int i) { isFree |= dofs_.number[i] >= 0; });
			if (isFree) nodes.push_back(a);
		}
		return nodes;
	}
	NodePosition position(int node) const
	{
		const auto index = Grid<Dim>::index(K_.keys()[node]);
		return { index[0], index[1], Dim == 3 ? index[Dim - 1] : 0 };
	}
	NodeGraph graphOf(const std::vector<int>& nodes) const
	{
		NodeGraph        graph;
		std::vector<int> number(K_.nodes(), -1);
		for (std::size_t n = 0; n < nodes.size(); ++n)
			number[nodes[n]] = int(n), graph.positions.push_back(position(nodes[n]));
		const auto forPairs = [&](auto&& f) {
			for (const int a : nodes)
				for (int c = 1; c < K_.codes; ++c) {
					const int b = K_.used(a, c) ? K_.neighbour(a, c) : a;
					if (b != a && number[b] >= 0) f(number[a], number[b]), f(number[b], number[a]);
				}
			if (!couplings_) return;
			couplings_->forBlocks([&](const FieldNode& row, const FieldNode& column, const double*) {
				const int a = number[row.node], b = number[column.node];
				if (row.node != column.node && a >= 0 && b >= 0) f(a, b), f(b, a);
			});
		};
		graph.start.assign(nodes.size() + 1, 0);
		forPairs([&](int a, int) { ++graph.start[a + 1]; });
		std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
		graph.neighbours.resize(graph.start.back());
		std::vector<int> next(graph.start.begin(), graph.start.end() - 1);
		forPairs([&](int a, int b) { graph.neighbours[next[a]++] = b; });
		if (couplings_) keepOnce(graph);
		return graph;
	}
	/// Keeps neighbours of each node that it is coupled to by several fields in the graph once.
	static void keepOnce(NodeGraph& graph)
	{
		std::vector<int> seen(graph.positions.size(), -1);
		int              end = 0;
		for (int a = 0, first = 0; a < int(graph.positions.size()); ++a) {
			const int last = graph.start[a + 1];
			for (int i = std::exchange(first, last); i < last; ++i)
				if (const int b = graph.neighbours[i]; std::exchange(seen[b], a) != a) graph.neighbours[end++] = b;
			graph.start[a + 1] = end;
		}
		graph.neighbours.resize(end);
	}
	template <class F> void forFree(F&& f) const
	{
		for (int i = 0; i < int(dofs_.number.size()); ++i)
			if (dofs_.number[i] >= 0) f(i, dofs_.number[i]);
	}

	const NodeMatrix<Dim>& K_;
	const FreeDofs&        dofs_;
	const OwnedNodes       ownedNodes_;
	const Couplings*       couplings_; ///< null: there are none
};

} // namespace

template <int Dim>
std::unique_ptr<NodeProblem> nodeProblem(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const OwnedNodes& ownedNodes, const Couplings* couplings)
{
	return std::make_unique<Problem<Dim>>(K, dofs, ownedNodes, couplings);
}

template std::unique_ptr<NodeProblem> nodeProblem(const NodeMatrix<2>&, const FreeDofs&, const OwnedNodes&, const Couplings*);
template std::unique_ptr<NodeProblem> nodeProblem(const NodeMatrix<3>&, const FreeDofs&, const OwnedNodes&, const Couplings*);

} // namespace gimpm
