// SPDX-License-Identifier: GPL-2.0-or-later
// Input of a linear solver.
#pragma once
#include "core/solvers/node_problem.hpp"
#include <utility>

namespace gimpm {

/// The matrix of K x = b on the free degrees of freedom: in compressed columns, in one of two forms, or over nodes, and
/// then compressed when that is asked for.
class LinearProblem {
public:
	LinearProblem(SymmetricCsc K) : size_(K.size()), isSymmetric_(true), compressed_(std::move(K)) { }
	LinearProblem(GeneralCsc K) : size_(K.size()), isSymmetric_(false), compressed_(std::move(K)) { }

	/// The matrix and what is beside it must outlive it. It is solved by all processes that share its rows.
	template <int Dim>
	LinearProblem(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const OwnedNodes& ownedNodes, const Couplings* couplings = nullptr)
	        : size_(dofs.count), isSymmetric_(K.isSymmetric()), overNodes_(nodeProblem(K, dofs, ownedNodes, couplings))
	{
	}
	template <int Dim>
	LinearProblem(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const Couplings* couplings = nullptr)
	        : LinearProblem(K, dofs, OwnedNodes::whole(K.nodes()), couplings)
	{
	}

	int                 size() const { return size_; }
	bool                isSymmetric() const { return isSymmetric_; }
	const SymmetricCsc& symmetric() const { return std::get<SymmetricCsc>(compressed()); }
	const GeneralCsc&   general() const { return std::get<GeneralCsc>(compressed()); }
	/// Null: only compressed, or of several fields.
	const NodeProblem* overNodes() const { return isOfOneField() ? overNodes_.get() : nullptr; }
	/// Null: only compressed.
	const NodeProblem* ofAllFields() const { return overNodes_.get(); }
	bool               isShared() const { return overNodes_ && !overNodes_->ownedNodes().isWhole(); }
	bool               isOfOneField() const { return !overNodes_ || overNodes_->isOfOneField(); }
	bool               hasSigns() const { return overNodes_ && overNodes_->hasSigns(); }

	/// NodeProblem::ordering; empty where nodes are not known.
	Order ordering() const { return overNodes_ ? overNodes_->ordering() : Order(); }

	/// Stored matrix: of a symmetric one a triangle.
	const Csc& stored() const { return isSymmetric() ? static_cast<const Csc&>(symmetric()) : general(); }

	Eigen::VectorXd operator*(const Eigen::VectorXd& x) const { return isSymmetric() ? symmetric() * x : general() * x; }

	/// Calls f(row, column, value) for each entry of the whole matrix.
	template <class F> void forEntries(F&& f) const
	{
		const Csc& K = stored();
		for (int c = 0; c < K.size(); ++c)
			for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
				f(K.row[e], c, K.value[e]);
				if (isSymmetric() && K.row[e] != c) f(c, K.row[e], K.value[e]);
			}
	}

private:
	const std::variant<SymmetricCsc, GeneralCsc>& compressed() const
	{
		if (!compressed_) compressed_ = overNodes_->compressed();
		return *compressed_;
	}

	int                                                           size_;
	bool                                                          isSymmetric_;
	std::unique_ptr<const NodeProblem>                            overNodes_;
	mutable std::optional<std::variant<SymmetricCsc, GeneralCsc>> compressed_;
};

/// Compressed: K may go.
template <int Dim> LinearProblem reduced(const NodeMatrix<Dim>& K, const FreeDofs& dofs, const Couplings* couplings = nullptr)
{
	return std::visit(
	        [](auto&& compressed) { return LinearProblem(std::move(compressed)); },
	        nodeProblem(K, dofs, OwnedNodes::whole(K.nodes()), couplings)->compressed());
}

} // namespace gimpm
