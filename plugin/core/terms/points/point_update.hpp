// SPDX-License-Identifier: GPL-2.0-or-later
// Step 5 of the method: nodes to points.
#pragma once
#include "core/base/instruction_set.hpp"
#include "core/terms/points/internal_force.hpp"

namespace gimpm {

/// State of one point for displacements d.
template <int Dim> struct PointUpdate {
	Vec<Dim>       displacement;
	Mat<Dim>       gradient;                       ///< gradient of the increment, with respect to the configuration at the start of the step
	SymTensor<Dim> elasticStrain, kirchhoffStress; ///< the effective one
	const Law&     law;
	const double*  internals; ///< in the order of the law
	double         hoop  = 0; ///< hoop strain of the increment, around the axis of a body of revolution
	double         water = 0; ///< mean Kirchhoff stress of water that cannot leave its pores [Pa]
};

/// Calls call(f, index in the cloud, PointUpdate) for every point, from several threads.
template <int Dim>
void forUpdatedPoints(
        const CloudBasis<Dim>&, const StepPoints<Dim>&, const std::vector<Material>&, const Eigen::VectorXd& d, const void* f,
        void (*call)(const void* f, int point, const PointUpdate<Dim>&));

/// Calls f(index in the cloud, PointUpdate) for every point, from several threads; f must not touch other points. It is
/// compiled as the update is, for two kinds of processors.
template <int Dim, class F>
void forUpdatedPoints(const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d, const F& f)
{
	const auto call = [](const void* g, int p, const PointUpdate<Dim>& u) { callForProcessor([&] { (*static_cast<const F*>(g))(p, u); }); };
	forUpdatedPoints<Dim>(basis, points, materials, d, static_cast<const void*>(&f), call);
}

} // namespace gimpm
