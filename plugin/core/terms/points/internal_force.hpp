// SPDX-License-Identifier: GPL-2.0-or-later
// Steps 2 and 3 of the method: points to nodes. Internal force, stiffness and external force of the current iterate.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/materials/material.hpp"
#include "core/terms/term.hpp"

namespace gimpm {

/// Data of the points that an iteration reads, in the order of the basis and contiguous in memory.
template <int Dim> struct StepPoints {
	std::vector<SymTensor<Dim>>  leftCauchyGreen; ///< elastic b - 1 at the start of the step
	std::vector<double>          volume0;
	std::vector<int>             material;
	InternalColumns              internals;
	ParameterColumns             parameters;
	bool                         isSymmetric   = true;  ///< the tangents of their laws
	bool                         hasTensorLaws = false; ///< some of them
	double                       duration      = 0;     ///< duration of the step, for laws that depend on it
	std::vector<PointBasis<Dim>> centres; ///< only with F-bar (core/terms/points/fbar.hpp): basis functions with the gradients at the centres of the cells
	std::vector<AxisValues>      hoopCentres; ///< and those of the hoop strain, around an axis of symmetry
	/// Mean Kirchhoff stress of water that cannot leave, at no elastic strain [Pa], zero where it can; empty: it
	/// can everywhere.
	std::vector<double> water;

	bool hasFBar() const { return !centres.empty(); }
	bool hasWater() const { return !water.empty(); }

	/// No points, in the same step and of the same laws: for those that append() adds.
	StepPoints withoutPoints() const
	{
		StepPoints none;
		none.isSymmetric = isSymmetric, none.hasTensorLaws = hasTensorLaws, none.duration = duration;
		return none;
	}

	/// Another point, as point i of these.
	void append(const StepPoints& from, int i)
	{
		leftCauchyGreen.push_back(from.leftCauchyGreen[i]);
		volume0.push_back(from.volume0[i]);
		material.push_back(from.material[i]);
		if (from.hasFBar()) centres.push_back(from.centres[i]);
		if (!from.hoopCentres.empty()) hoopCentres.push_back(from.hoopCentres[i]);
		if (from.hasWater()) water.push_back(from.water[i]);
		internals.resize(from.internals.size());
		for (std::size_t c = 0; c < internals.size(); ++c)
			if (!from.internals[c].empty()) internals[c].push_back(from.internals[c][i]);
		parameters.resize(from.parameters.size());
		for (std::size_t c = 0; c < parameters.size(); ++c)
			if (!from.parameters[c].empty()) parameters[c].push_back(from.parameters[c][i]);
	}
};

/// Ranges of patches by colour, as in CloudBasis: no two of a colour may share a node.
template <int Dim> using Colours = decltype(CloudBasis<Dim>::colours);

template <int Dim> StepPoints<Dim> stepPoints(const PointCloud<Dim>&, const std::vector<Material>&, const CloudBasis<Dim>&, bool fBar = false);

/// force += internal force of the nodal displacements d (from the start of the step), K += its derivative, and absolute
/// contributions += the magnitudes of the patches' forces, as far as they are asked for; of the patches in `colours`.
/// Fails for points with det F <= 0 or without an answer of their law. The result does not depend on the number of
/// threads. `part`: of the step's time has gone by; 0 with d = 0 is the force of the stresses with which the step
/// begins.
template <int Dim>
std::optional<PointFailure> addInternalForce(
        const CloudBasis<Dim>&, const Colours<Dim>& colours, const StepPoints<Dim>&, const std::vector<Material>&, const Eigen::VectorXd& d,
        const AssembledTerms<Dim>&, double part = 1);
template <int Dim>
std::optional<PointFailure> addInternalForce(
        const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Eigen::VectorXd& d,
        const AssembledTerms<Dim>& sum)
{
	return addInternalForce(basis, basis.colours, points, materials, d, sum);
}

/// Marks the blocks that addInternalForce writes.
template <int Dim> void markPointPattern(const CloudBasis<Dim>&, NodeMatrix<Dim>& K);

/// The points' resistance, of which what stays the same in a step is kept elsewhere.
template <int Dim> class InternalForce : public Term<Dim> {
public:
	/// All are kept by reference. `colours`: what is added of it.
	InternalForce(const CloudBasis<Dim>& basis, const Colours<Dim>& colours, const StepPoints<Dim>& points, const std::vector<Material>& materials)
	        : basis_(basis), colours_(colours), points_(points), materials_(materials)
	{
	}
	void                        mark(NodeMatrix<Dim>& K) const override { markPointPattern(basis_, K); }
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum) override { return add(d, sum, 1); }
	void                        addBefore(Eigen::VectorXd& force) override { add(Eigen::VectorXd::Zero(force.size()), { force }, 0); }
	bool                        isSymmetric() const override { return points_.isSymmetric; }

protected:
	/// After so much of the step's time.
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum, double part) const
	{
		return addInternalForce(basis_, colours_, points_, materials_, d, sum, part);
	}

private:
	const CloudBasis<Dim>&       basis_;
	const Colours<Dim>&          colours_;
	const StepPoints<Dim>&       points_;
	const std::vector<Material>& materials_;
};

/// f += S^T (m g + point force), with the force per point in the order of the cloud [N].
template <int Dim> void addPointForces(const CloudBasis<Dim>&, const std::vector<Vec<Dim>>& force, Eigen::VectorXd& f);

} // namespace gimpm
