// SPDX-License-Identifier: GPL-2.0-or-later
// Damping in proportion to mass and stiffness.
#pragma once
#include "core/materials/material.hpp"
#include "core/terms/inertia/damping.hpp"

namespace gimpm {

/// (alpha M + beta K) v, M without ghost mass, K the tangent of the points as the step begins: what yields resists as
/// if it unloaded, so that K has no negative eigenvalues where soil fails; initial stress is in it.
struct Rayleigh {
	double alpha = 0; ///< [1/s]
	double beta  = 0; ///< [s]
	double work  = 0; ///< taken in the last step that was accepted [J]
};

template <int Dim> class RayleighDamping : public Damping<Dim> {
public:
	/// Masses by point of the cloud [kg].
	RayleighDamping(Rayleigh&, const std::vector<Material>&, bool fBar, const std::vector<double>& masses, const StepContext<Dim>&);

	void        mark(NodeMatrix<Dim>&) const override;
	void        add(const Eigen::VectorXd& v, double velocityDerivative, const AssembledTerms<Dim>&) const override;
	void        addBefore(const Eigen::VectorXd& v, Eigen::VectorXd& force) const override { C_.multiplyAdd(v, force); }
	bool        isSymmetric() const override { return C_.isSymmetric(); }
	std::string obstacle() const override { return obstacle_; }
	void        commit(const Eigen::VectorXd& d, const Eigen::VectorXd& before, const Eigen::VectorXd& now) override;

private:
	Rayleigh&         settings_;
	const OwnedNodes& ownedNodes_;
	NodeMatrix<Dim>   C_;
	std::string       obstacle_;
};

} // namespace gimpm
