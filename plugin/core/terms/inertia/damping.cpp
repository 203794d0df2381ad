// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/damping.hpp"

namespace gimpm {

template <int Dim> std::vector<std::unique_ptr<Damping<Dim>>> dampingOf(const std::vector<DampingOfStep<Dim>>& makers, const StepContext<Dim>& step)
{
	std::vector<std::unique_ptr<Damping<Dim>>> made;
	const std::function<Eigen::VectorXd()>     imbalance = [&] {
                const Eigen::VectorXd others = step.imbalance();
                Eigen::VectorXd       borne  = Eigen::VectorXd::Zero(others.size());
                for (const auto& each : made)
                        each->addBorne(borne);
                step.ownedNodes.complete(borne);
                return Eigen::VectorXd(others - borne);
	};
	const StepContext<Dim> known { step.cloud, step.basis,      step.grid, step.stiffnessOf, step.faces,
		                       step.dofs,  step.prescribed, imbalance, step.ownedNodes,  step.division };
	for (const auto& make : makers)
		made.push_back(make(known));
	return made;
}

template std::vector<std::unique_ptr<Damping<2>>> dampingOf(const std::vector<DampingOfStep<2>>&, const StepContext<2>&);
template std::vector<std::unique_ptr<Damping<3>>> dampingOf(const std::vector<DampingOfStep<3>>&, const StepContext<3>&);

} // namespace gimpm
