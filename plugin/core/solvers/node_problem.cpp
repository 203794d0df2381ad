// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/node_problem.hpp"
#include "core/solvers/block_matrix.hpp"
#include "core/solvers/dissection.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

template <int Dim> class Problem : public NodeProblem {
public:
	Problem(const NodeMatrix<Dim>& K, const FreeDofs& dofs) : K_(K), dofs_(dofs) { }

	std::variant<SymmetricCsc, GeneralCsc> compressed() const override
	{
		const auto in = [&](auto form) {
			reduce(K_, dofs_, form);
			return std::variant<SymmetricCsc, GeneralCsc>(std::move(form));
		};
		return K_.isSymmetric() ? in(SymmetricCsc()) : in(GeneralCsc());
	}
	std::unique_ptr<SymmetricOperator> blocks() const override { return std::make_unique<BlockMatrix<Dim>>(K_, dofs_); }

	Eigen::VectorXd expanded(const Eigen::VectorXd& x) const override
	{
		Eigen::VectorXd all = Eigen::VectorXd::Zero(dofs_.number.size());
		forFree([&](int dof, int number) { all[dof] = x[number]; });
		return all;
	}
	Eigen::VectorXd ofFreeDofs(const Eigen::VectorXd& all) const override
	{
		Eigen::VectorXd x(dofs_.count);
		forFree([&](int dof, int number) { x[number] = all[dof]; });
		return x;
	}
	std::optional<NodeRows> rows() const override { return nodeRows(K_, dofs_); }
	Unknowns                unknowns() const override
	{
		Unknowns all { K_.keys(), {} };
		for (const int number : dofs_.number)
			all.isFree.push_back(number >= 0);
		return all;
	}
	bool needsMoreFlopsPerEntry(double flops) const override
	{
		std::vector<NodePlace> places;
		double                 blocks = 0;
		for (int a = 0; a < K_.nodes(); ++a) {
			const auto number = dofs_.number.begin() + Dim * a;
			if (std::all_of(number, number + Dim, [](int n) { return n < 0; })) continue;
			const auto index = Grid<Dim>::index(K_.keys()[a]);
			places.push_back({ index[0], index[1], Dim == 3 ? index[Dim - 1] : 0 });
			for (int c = 0; c < K_.codes; ++c)
				blocks += (c == 0 ? 1 : 2) * K_.used(a, c);
		}
		if (places.empty()) return false;
		const double perNode = dofs_.count / double(places.size()), blocksOfNode = blocks / double(places.size());
		const double reach   = std::clamp((std::pow(blocksOfNode, 1. / Dim) - 1) / 2, 1., 2.);
		const double entries = 0.5 * (blocks + double(places.size())) * perNode * perNode;
		return needsMoreFlops(std::move(places), perNode, reach, flops * entries);
	}

private:
	template <class F> void forFree(F&& f) const
	{
		for (int i = 0; i < int(dofs_.number.size()); ++i)
			if (dofs_.number[i] >= 0) f(i, dofs_.number[i]);
	}

	const NodeMatrix<Dim>& K_;
	const FreeDofs&        dofs_;
};

} // namespace

template <int Dim> std::unique_ptr<NodeProblem> nodeProblem(const NodeMatrix<Dim>& K, const FreeDofs& dofs) { return std::make_unique<Problem<Dim>>(K, dofs); }

template std::unique_ptr<NodeProblem> nodeProblem(const NodeMatrix<2>&, const FreeDofs&);
template std::unique_ptr<NodeProblem> nodeProblem(const NodeMatrix<3>&, const FreeDofs&);

} // namespace gimpm
