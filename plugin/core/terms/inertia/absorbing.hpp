// SPDX-License-Identifier: GPL-2.0-or-later
// Edges of the body where waves leave it, and come from beyond.
#pragma once
#include "core/materials/material.hpp"
#include "core/terms/inertia/damping.hpp"
#include <map>

namespace gimpm {

/// Boundary beyond which the body goes on as if it were linear elastic: dashpots (Lysmer and Kuhlemeyer 1969) on the
/// faces of cells whose nodes are all in a box, rho c_p along the normal and rho c_s across it, by the material beside
/// the face. A wave that comes from beyond with the velocity v adds 2 rho c v (Joyner and Chen 1975). They do not hold
/// what is at rest: forces by which nodes of the box are out of balance when the boundary first acts, that is what has
/// held them until then, go on acting.
template <int Dim> struct AbsorbingBoundary {
	/// Its directions mean nothing; an open one of the boundary (core/grid/boundary.hpp).
	ConstrainedBox<Dim> box;
	/// Velocity of the wave from beyond at the start of the step [m/s].
	Vec<Dim>                incomingBefore = Vec<Dim>::Zero();
	Vec<Dim>                incoming       = Vec<Dim>::Zero(); ///< the same where forces of the step are looked at
	bool                    hasBegun       = false;
	std::map<Key, Vec<Dim>> borne {};                 ///< force that goes on acting, by node [N]
	Vec<Dim>                force = Vec<Dim>::Zero(); ///< on the body in the last step that was accepted [N]
	double                  work  = 0;                ///< on the body in that step [J]
	std::string             name {};                  ///< for messages
};

template <int Dim> class Absorption : public Damping<Dim> {
public:
	/// Masses by point of the cloud [kg].
	Absorption(AbsorbingBoundary<Dim>&, const std::vector<Material>&, const std::vector<double>& masses, const StepContext<Dim>&);

	void        mark(NodeMatrix<Dim>&) const override;
	void        add(const Eigen::VectorXd& v, double velocityDerivative, const AssembledTerms<Dim>&) const override;
	void        addBefore(const Eigen::VectorXd& v, Eigen::VectorXd& force) const override;
	bool        addDiagonal(Eigen::VectorXd& drag) const override;
	void        addBorne(Eigen::VectorXd& force) const override;
	std::string obstacle() const override { return obstacle_; }
	double      fromOutside(const Eigen::VectorXd& v) const override;
	void        commit(const Eigen::VectorXd& d, const Eigen::VectorXd& before, const Eigen::VectorXd& now) override;

private:
	/// A node; zero along directions in which it is held.
	struct Dashpot {
		Vec<Dim> drag  = Vec<Dim>::Zero(); ///< force over velocity [N s/m]
		Vec<Dim> borne = Vec<Dim>::Zero(); ///< [N]
	};
	struct Face {
		int leaf, axis;
		int node[1 << (Dim - 1)];
	};
	std::vector<Face> faces(const StepContext<Dim>&);
	std::string       textOfCut(Key leaf, const StepContext<Dim>&) const;
	std::string       textOfBothSides(const std::vector<int>& beyond, const StepContext<Dim>&) const;
	void              addDrag(const std::vector<Face>&, const std::vector<Material>&, const std::vector<double>& masses, const StepContext<Dim>&);
	void              completeDrag(const StepContext<Dim>&);
	void              tieDashpots(const StepContext<Dim>&);
	void              takeOver(const StepContext<Dim>&);

	AbsorbingBoundary<Dim>& boundary_;
	std::map<int, Dashpot>  dashpots_;
	std::string             obstacle_; ///< why it cannot act
};

/// Moduli of waves [Pa]: K + 4 G / 3 and G of a point's law within its yield surface, at its present volume.
template <int Dim> WaveModuli waveModuli(const std::vector<Material>&, const PointCloud<Dim>&, int point);

} // namespace gimpm
