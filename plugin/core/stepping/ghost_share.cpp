// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/ghost_share.hpp"
#include <cmath>
#include <limits>

namespace gimpm {

template <int Dim> double ghostShare(const StepSystem<Dim>& system, const Eigen::VectorXd& d, const Eigen::VectorXd& force)
{
	if (system.hasInertia() || !system.map.isAlone()) return std::numeric_limits<double>::quiet_NaN();
	if (system.model.ghost.factor == 0) return 0;
	const Eigen::VectorXd ofGhost = system.ghostForce(d);
	if (ofGhost.template lpNorm<Eigen::Infinity>() <= leastGhostForce * system.external.template lpNorm<Eigen::Infinity>()) return 0;
	const Eigen::VectorXd ofPoints = force - system.otherForces(d) - ofGhost;
	double                byGhost = 0, byPoints = 0;
	for (Eigen::Index i = 0; i < d.size(); ++i) {
		if (ofGhost[i] == 0) continue; // no face is there
		byGhost += d[i] * ofGhost[i];
		byPoints += std::abs(d[i] * ofPoints[i]);
	}
	return byGhost == 0 ? 0 : std::abs(byGhost) / (std::abs(byGhost) + byPoints);
}

template double ghostShare(const StepSystem<2>&, const Eigen::VectorXd&, const Eigen::VectorXd&);
template double ghostShare(const StepSystem<3>&, const Eigen::VectorXd&, const Eigen::VectorXd&);

} // namespace gimpm
