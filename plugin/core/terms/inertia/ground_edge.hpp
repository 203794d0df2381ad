// SPDX-License-Identifier: GPL-2.0-or-later
// Edges that move with the body, and beyond which the ground goes on and moves by itself.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/grid/surface.hpp"
#include "core/terms/inertia/damping.hpp"

namespace gimpm {

/// Motion of the ground beyond an edge, at its vertices.
template <int Dim> struct GroundMotion {
	std::vector<Vec<Dim>> velocity;     ///< [m/s]
	std::vector<Vec<Dim>> displacement; ///< since the edge began [m]
	std::vector<Vec<Dim>> force;        ///< on the body, over that with which it began [N]
};

/// Edge beyond which the body goes on as if it were linear elastic, in a free field that moves by itself: dashpots
/// (Lysmer and Kuhlemeyer 1969) resist velocities, and springs (Deeks and Randolph 1994) displacements, that differ
/// from those of the free field, whose stress acts on the body. All of it is on the vertices of a surface, which move
/// with the body: soil does not cross the edge.
template <int Dim> struct GroundEdge {
	/// At the start of the step; outward normals point away from the body.
	Surface<Dim>          surface;
	std::vector<Mat<Dim>> drag;             ///< drag of the vertices [N s/m]
	std::vector<Mat<Dim>> stiffness;        ///< stiffness of the vertices [N/m]; empty: no springs
	GroundMotion<Dim>     before;           ///< at the start of the step
	GroundMotion<Dim>     now;              ///< motion for which forces of the step are evaluated
	bool                  acts     = true;  ///< false: its vertices move, and tell their velocities
	bool                  atMiddle = false; ///< forces are looked at in the middle of the step
	bool                  hasBegun = false;
	std::vector<Vec<Dim>> borne {};                       ///< force that has held the body there, and goes on acting, on the vertices [N]
	std::vector<Vec<Dim>> velocity {};                    ///< velocity of the vertices, for which the forces of the last accepted step were evaluated [m/s]
	Vec<Dim>              force       = Vec<Dim>::Zero(); ///< on the body in that step, without that of springs [N]
	Vec<Dim>              springForce = Vec<Dim>::Zero();
	double                work = 0, springWork = 0; ///< on the body in that step [J]
	std::string           name {};                  ///< for messages
};

/// Forces that depend on velocities, and those that act whatever the body does.
template <int Dim> class EdgeDrag : public Damping<Dim> {
public:
	EdgeDrag(GroundEdge<Dim>&, const StepContext<Dim>&);

	void        mark(NodeMatrix<Dim>&) const override;
	void        add(const Eigen::VectorXd& v, double velocityDerivative, const AssembledTerms<Dim>&) const override;
	void        addBefore(const Eigen::VectorXd& v, Eigen::VectorXd& force) const override;
	void        addBorne(Eigen::VectorXd& force) const override;
	std::string obstacle() const override { return obstacle_; }
	double      fromOutside(const Eigen::VectorXd& v) const override;
	void        commit(const Eigen::VectorXd& d, const Eigen::VectorXd& before, const Eigen::VectorXd& now) override;

private:
	std::string takeOver(const StepContext<Dim>&);
	Vec<Dim>    forceAt(std::size_t vertex, const Vec<Dim>& velocity, const GroundMotion<Dim>&) const; // on the body

	GroundEdge<Dim>&             edge_;
	std::vector<Attachment<Dim>> attached_; // positions of the vertices
	std::string                  obstacle_;
};

/// Forces that depend on displacements.
template <int Dim> class EdgeSprings : public Term<Dim> {
public:
	EdgeSprings(GroundEdge<Dim>&, const StepContext<Dim>&);

	void                        mark(NodeMatrix<Dim>&) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) override;
	void                        addBefore(Eigen::VectorXd& force) override;
	std::string                 obstacle() const override { return obstacle_; }
	double                      fromOutside(const Eigen::VectorXd& d) override { return this->sizeOfForce(d); }
	void                        restrain(const typename Term<Dim>::Constrain&) override;
	void                        commit(const Eigen::VectorXd& d) override;

private:
	Vec<Dim> forceAt(std::size_t vertex, const Vec<Dim>& moved, const GroundMotion<Dim>&) const; // on the body
	double   share() const { return edge_.atMiddle ? 0.5 : 1; }                                  // part of the displacements of the step

	GroundEdge<Dim>&             edge_;
	std::vector<Attachment<Dim>> attached_; // positions of the vertices
	std::string                  obstacle_;
};

} // namespace gimpm
