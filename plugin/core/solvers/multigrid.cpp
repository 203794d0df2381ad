// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/multigrid.hpp"
#include "core/solvers/petsc_library.hpp"
#include <array>

namespace gimpm {
namespace {

using Reason = std::array<char, 512>;

} // namespace

void Multigrid::openFrom(const std::string& file) { PetscLibrary::get() = { file }; }

std::string Multigrid::absence() { return PetscLibrary::get().open(); }

Multigrid::Multigrid(NodeRows rows, Unknowns unknowns, OwnedNodes ownedNodes, std::shared_ptr<const SymmetricOperator> K)
        : rows_(std::move(rows))
        , unknowns_(std::move(unknowns))
        , ownedNodes_(std::move(ownedNodes))
        , K_(std::move(K))
        , in_(rows_.rows())
        , out_(rows_.rows())
        , nodal_(Eigen::VectorXd::Zero(rows_.dim * (ownedNodes_.last() - ownedNodes_.first())))
        , image_(nodal_)
{
	for (int& dof : rows_.dof)
		dof -= rows_.dim * ownedNodes_.first();
}

std::unique_ptr<Multigrid> Multigrid::of(const NodeProblem& problem, std::shared_ptr<const SymmetricOperator> K, std::string& reason)
{
	reason = absence();
	if (!reason.empty()) return nullptr;
	auto rows         = problem.rows();
	bool hasPositions = false;
	reason            = obstacleTo(rows, problem.ownedNodes(), hasPositions);
	if (!reason.empty()) return nullptr;
	std::unique_ptr<Multigrid> made(new Multigrid(std::move(*rows), problem.unknowns(), problem.ownedNodes(), std::move(K)));
	if (!made->setUp(hasPositions, reason)) return nullptr;
	return made;
}

Multigrid::~Multigrid()
{
	if (hierarchy_) PetscLibrary::get().multigrid->destroy(hierarchy_);
}

bool Multigrid::setUp(bool hasPositions, std::string& reason)
{
	Reason                said {};
	const MultigridMatrix K { rows_.dim,
		                  rows_.rows(),
		                  rows_.all,
		                  !ownedNodes_.isWhole(),
		                  rows_.start.data(),
		                  rows_.column.data(),
		                  numbersOf(rows_.value, true),
		                  numbersOf(rows_.position, hasPositions),
		                  this,
		                  &multiply };
	hierarchy_ = PetscLibrary::get().multigrid->create(&K, said.data(), int(said.size()));
	reason     = said.data();
	return hierarchy_ != nullptr;
}

bool Multigrid::fits(const NodeProblem& problem) const { return problem.unknowns() == unknowns_ && problem.ownedNodes().start == ownedNodes_.start; }

/// The product over nodes is done by blocks and in threads, and so takes a third to a fifth of that by rows.
void Multigrid::multiply(void* self, const double* x, double* y)
{
	auto&           m    = *static_cast<Multigrid*>(self);
	const NodeRows& rows = m.rows_;
	for (int r = 0; r < rows.rows(); ++r)
		m.nodal_[rows.dof[r]] = x[r];
	m.K_->multiply(m.nodal_, m.image_);
	for (int r = 0; r < rows.rows(); ++r)
		y[r] = m.image_[rows.dof[r]];
	for (const auto& held : rows.held) // for which K has ones
		y[held.row] = held.diagonal * x[held.row];
}

std::string Multigrid::apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) const
{
	Reason said {};
	for (int i = 0; i < rows_.rows(); ++i)
		in_[i] = r[rows_.dof[i]];
	if (!PetscLibrary::get().multigrid->apply(hierarchy_, in_.data(), out_.data(), said.data(), int(said.size()))) return said.data();
	for (const auto& held : rows_.held)
		out_[held.row] = 0;
	z.setZero(r.size());
	for (int i = 0; i < rows_.rows(); ++i)
		z[rows_.dof[i]] = out_[i];
	return "";
}

} // namespace gimpm
