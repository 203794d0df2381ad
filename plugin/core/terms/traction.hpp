// SPDX-License-Identifier: GPL-2.0-or-later
// Loads on surfaces that move with the body.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/grid/surface.hpp"
#include "core/terms/term.hpp"
#include <string>

namespace gimpm {

/// Traction on a surface at the end of a step.
template <int Dim> struct SurfaceLoad {
	/// At the start of the step, with sides of at most `pieceLimit`.
	Surface<Dim> surface;
	/// Against the outward normal of the deformed surface: it follows [Pa].
	double pressure = 0;
	/// Force over the area that the surface had at first; keeps its direction [Pa].
	Vec<Dim> traction       = Vec<Dim>::Zero();
	double   pressureBefore = 0; ///< the same as the step begins, where something asks for it
	Vec<Dim> tractionBefore = Vec<Dim>::Zero();
	/// In that step, with the mean of the forces at its two ends [J].
	double work = 0;
	/// Layer of the body that it is on; layerOfPosition: the one that is near.
	int layer = layerOfPosition;
	/// Its outer side is still to be compared with where material is.
	bool        isNew     = false;
	Vec<Dim>    resultant = Vec<Dim>::Zero();   ///< resultant of both, in the last step that was accepted [N]
	std::string name      = "a loaded surface"; ///< name in messages
};

/// Vertices follow the linear functions of the grid, and the forces on them act on the nodes by the same functions:
/// virtual work, resultant and moment are exact. A piece hands equal parts of its force to its vertices, around an axis
/// of symmetry those of a ring: the shares of its area. The force of a pressure is differentiated; its tangent is
/// symmetric for closed surfaces only.
template <int Dim> class Traction : public Term<Dim> {
public:
	/// The load is moved in commit().
	Traction(SurfaceLoad<Dim>&, const StepContext<Dim>&);

	void                        mark(NodeMatrix<Dim>&) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) override;
	void                        addBefore(Eigen::VectorXd& force) override;
	bool                        isSymmetric() const override { return isSymmetric_; }
	double                      fromOutside(const Eigen::VectorXd& d) override { return this->sizeOfForce(d); }
	std::string                 obstacle() const override { return obstacle_; }
	void                        commit(const Eigen::VectorXd& d) override;

private:
	using Positions = std::vector<Vec<Dim>>;
	using Piece     = typename Surface<Dim>::Piece;

	Positions positionsAt(const Eigen::VectorXd& d) const;
	Positions forcesAt(const Positions&, double pressure, const Vec<Dim>& traction) const; // on the vertices
	Positions forcesAt(const Positions& positions) const { return forcesAt(positions, load_.pressure, load_.traction); }
	void      addStiffness(const Positions&, NodeMatrix<Dim>& K) const;

	std::string betweenLevels() const;

	SurfaceLoad<Dim>&            load_;
	bool                         isRing_;   // around an axis of symmetry
	std::vector<Attachment<Dim>> attached_; // positions of the vertices
	bool                         isSymmetric_;
	std::string                  obstacle_;
	int                          layer_ = 0; // layer of the body that it is on
	/// Flags of pieces that reach from beside a line that parts the body to where that is whole: their nodes are in
	/// two layers, which the matrix over nodes does not couple. Their part of the Jacobian is left out, which costs
	/// iterations only.
	std::vector<char> isAcross_;
};

} // namespace gimpm
