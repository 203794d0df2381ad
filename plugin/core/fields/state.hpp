// SPDX-License-Identifier: GPL-2.0-or-later
// The fields at an iterate of a step.
#pragma once
#include "core/fields/dof_map.hpp"

namespace gimpm {

/// One block a field: what it was as the step began, and how much it has grown since. Displacements, which are those of
/// the step, have no value before it.
class State {
public:
	/// The map and the values before are kept by reference.
	State(const DofMap& map, const std::vector<Eigen::VectorXd>& before, Eigen::VectorXd growth) : map_(map), before_(before)
	{
		if (map.isAlone()) growth_.push_back(std::move(growth));
		else
			for (int f = 0; f < map.fields(); ++f)
				growth_.push_back(map.of(f, growth));
	}

	const DofMap&          map() const { return map_; }
	const Eigen::VectorXd& displacements() const { return growth_[0]; }
	const Eigen::VectorXd& growth(int field) const { return growth_[field]; }
	const Eigen::VectorXd& before(int field) const { return before_[field]; }
	Eigen::VectorXd        value(int field) const ///< not of the displacements
	{
		return before_[field] + growth_[field];
	}

private:
	const DofMap&                       map_;
	const std::vector<Eigen::VectorXd>& before_;
	std::vector<Eigen::VectorXd>        growth_;
};

} // namespace gimpm
