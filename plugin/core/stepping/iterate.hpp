// SPDX-License-Identifier: GPL-2.0-or-later
// Answer of the system to displacements of the nodes.
#pragma once
#include "core/base/stopwatch.hpp"
#include "core/stepping/balance.hpp"
#include "core/stepping/local_balance.hpp"

namespace gimpm {

/// Forces, balance and, on demand, stiffness at the last displacements that were looked at.
template <int Dim> class Iterate {
public:
	Iterate(const StepSystem<Dim>& system, StepReport& report) : whole(system), system_(system), report_(report), local_(system, K) { prepare(); }

	/// For what is evaluated from now on.
	void prepare()
	{
		const Stopwatch watch(report_.times.assembly);
		system_.prepare(K, &couplingBlocks);
		hasStiffness = false;
	}

	/// A failure of a point or a residual that is not a number leaves balance.size infinite.
	void evaluate(const Eigen::VectorXd& d, bool withStiffness)
	{
		const Stopwatch watch(report_.times.assembly);
		hasStiffness = withStiffness;
		// An evaluation without stiffness is that of an iteration about to end, which needs the
		// absoluteContributions.
		hasContributions_ = !withStiffness || !system_.map.isAlone();
		failure           = system_.evaluate(
		                  d, force, withStiffness ? &K : nullptr, hasContributions_ ? &absoluteContributions_ : nullptr,
                        withStiffness ? &couplingBlocks : nullptr);
		balance = whole.of(d, force, absoluteContributions_);
		if (failure || !std::isfinite(balance.size)) balance.size = std::numeric_limits<double>::infinity();
	}

	/// Largest residual around a node over the forces there, at d, where the last evaluation was; exact if above
	/// `enough`.
	double localResidual(const Eigen::VectorXd& d, double enough)
	{
		const Stopwatch watch(report_.times.assembly);
		Eigen::VectorXd again;
		if (!hasContributions_) system_.evaluate(d, again, nullptr, &absoluteContributions_);
		hasContributions_ = true;
		return local_.ratio(balance.residual, absoluteContributions_, d, enough, caused_);
	}

	/// Marks that prescribed growth has entered with the last evaluation; `caused`: forces that it alone causes, of
	/// several fields.
	void enter(const Eigen::VectorXd& caused)
	{
		caused_ = caused.cwiseAbs();
		whole.enter(balance, caused_);
	}

	WholeBalance<Dim>           whole;
	NodeMatrix<Dim>             K;              ///< stiffness of the last evaluation that asked for it
	Couplings                   couplingBlocks; ///< K, of the same evaluation
	Eigen::VectorXd             force;
	Balance                     balance;
	std::optional<PointFailure> failure;
	bool                        hasStiffness = false; ///< K is that of the last evaluation

private:
	const StepSystem<Dim>& system_;
	StepReport&            report_;
	LocalBalance<Dim>      local_;
	Eigen::VectorXd        absoluteContributions_; // absolute contributions to the forces
	Eigen::VectorXd        caused_;
	bool                   hasContributions_ = false;
};

} // namespace gimpm
