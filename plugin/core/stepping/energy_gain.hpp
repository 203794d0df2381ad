// SPDX-License-Identifier: GPL-2.0-or-later
// Energy that a time step makes of nothing.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// Spurious energy gain of all points, of all processes where they are divided.
struct EnergyGain {
	double gain   = 0; ///< gain of elastic energy, beyond what stress has taken up on its way [J]
	double inPlay = 0; ///< kinetic and elastic energy as the step begins, and the size of that work [J]

	static constexpr double most = 0.25; ///< part of the energy in play

	bool isAdmissible() const { return !(gain > most * inPlay); }
};

/// Energy gain of a step. In Newmark's rule the body loses kinetic energy by the mean of the stresses at both ends of
/// the step. Where strains are small in it that is what elastic energy grows by. Where they are large it may grow by
/// much more: Newton's method has then found an equilibrium far from the motion. Plastic flow takes its part, which is
/// no gain. For laws whose elastic energy is not Hencky's nothing is known but the work.
template <int Dim> EnergyGain energyGain(const StepSystem<Dim>&, const PointCloud<Dim>& before, const PointCloud<Dim>& after);

/// True if a time step, by these displacements, has not ended in such an equilibrium; the report says so if it has. The
/// midpoint rule takes its stress elsewhere, and has not been seen to. Bodies of points that meet are admitted a
/// thousandth of what is in play: a blow within one step leaves accelerations to the points that the grid of the next
/// one is not in balance with. Beside that, what loads work in the step, which schemes that weigh it over the step know
/// no better as a body begins to move; where nodes are led nothing is asked.
template <int Dim>
bool requireEnergy(const StepSystem<Dim>&, const PointCloud<Dim>& before, const PointCloud<Dim>& after, const Eigen::VectorXd& d, StepReport&);

} // namespace gimpm
