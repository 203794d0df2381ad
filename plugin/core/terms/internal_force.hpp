// SPDX-License-Identifier: GPL-2.0-or-later
// Steps 2 and 3 of the method: points to nodes. Internal force, stiffness and external force of the current iterate.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/materials/law.hpp"
#include "core/solvers/node_matrix.hpp"

namespace gimpm {

/// What an iteration reads of the points, in the order of the basis and contiguous in memory.
template <int Dim> struct StepPoints {
	std::vector<SymTensor<Dim>> leftCauchyGreen; ///< elastic b - 1 at the start of the step
	std::vector<double>         volume0;
	std::vector<double>         plasticStrain;
	std::vector<int>            material;
};

template <int Dim> StepPoints<Dim> stepPoints(const PointCloud<Dim>&, const CloudBasis<Dim>&);

/// Index in the cloud of the first point with det F <= 0 or not finite, or -1.
using InvertedPoint = int;

/// f += internal force of the nodal displacements d (Dim components a node, from the start of the step), and K += its derivative when
/// K is given (already reset and marked). `sizes`, when given, += the sizes of the parts that make up f, those of the patches. The result
/// does not depend on the number of threads.
template <int Dim>
InvertedPoint addInternalForce(
        const CloudBasis<Dim>&,
        const StepPoints<Dim>&,
        const std::vector<Material>&,
        const Eigen::VectorXd& d,
        Eigen::VectorXd&       f,
        NodeMatrix<Dim>*       K,
        Eigen::VectorXd*       sizes = nullptr);

/// Marks the blocks that addInternalForce writes.
template <int Dim> void markPointPattern(const CloudBasis<Dim>&, NodeMatrix<Dim>& K);

/// f += S^T (m g + point force), with the force per point in the order of the cloud [N].
template <int Dim> void addPointForces(const CloudBasis<Dim>&, const std::vector<Vec<Dim>>& force, Eigen::VectorXd& f);

} // namespace gimpm
