// SPDX-License-Identifier: GPL-2.0-or-later
// Walls that are not on the lines of the grid.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/grid/surface.hpp"
#include "core/terms/cell_moduli.hpp"
#include "core/terms/term.hpp"
#include <string>

namespace gimpm {

/// A wall at the start of a step, and what it has been acting with.
template <int Dim> struct Wall {
	/// Makes the pieces so small that the force on each may act at its centre; `cellSize` of the smallest cells.
	Wall(Surface<Dim> surface, double cellSize);

	Surface<Dim> surface;
	double       cellSize; ///< of the smallest cells: the wall is as stiff where cells are larger [m]
	/// Directions in which material is held; none: along the normal of each piece.
	std::array<bool, Dim> fixed {};
	/// Layer of the body that it constrains.
	int layer = layerOfPosition;
	/// The wall gives way by pressure / (penalty * Young's modulus) smallest cells [-].
	double                penalty = 100;
	Vec<Dim>              motion  = Vec<Dim>::Zero();  ///< in the step, rigid [m]
	std::vector<Vec<Dim>> tractions;                   ///< pieces on the body [Pa]; zero where there is none
	Vec<Dim>              reaction = Vec<Dim>::Zero(); ///< their resultant at the end of the last step that was accepted [N]
};

/// Each piece holds the material that is at its centre x with the traction t - penalty E / h P (N(x) d - motion),
/// where P is the projection on what is held, E the modulus of the soil in the cell, h the size of the smallest ones
/// and t the traction at the start of the step: the step begins in equilibrium, and what the wall has given way by is
/// in proportion to what it bears. Centres where the grid holds no material do nothing, and forget.
template <int Dim> class WallForce : public Term<Dim> {
public:
	/// The wall is moved in commit().
	WallForce(Wall<Dim>&, const CloudBasis<Dim>&, const PointStiffness&, const Grid<Dim>&, const Division& = {});

	void                        mark(NodeMatrix<Dim>&) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) override;
	void                        addBefore(Eigen::VectorXd& force) override;
	std::string                 obstacle() const override;
	double                      fromOutside(const Eigen::VectorXd& d) override { return this->sizeOfForce(d); }
	void                        restrain(const typename Term<Dim>::Constrain&) override;
	void                        commit(const Eigen::VectorXd& d) override;

private:
	/// Piece with material at its centre.
	struct ConstrainedPiece {
		int             piece;
		Attachment<Dim> at;
		double          area;      ///< around an axis of symmetry that of the ring [m2]
		Mat<Dim>        held;      ///< projection P
		double          stiffness; ///< [Pa/m]
	};

	Vec<Dim> tractionOn(const ConstrainedPiece&, const Eigen::VectorXd& d) const;

	Wall<Dim>&                    wall_;
	std::vector<ConstrainedPiece> constrainedPieces_;
};

} // namespace gimpm
