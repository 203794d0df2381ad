// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/wall.hpp"
#include "core/terms/attached.hpp"
#include <algorithm>

namespace gimpm {
namespace {

template <int Dim> Vec<Dim> centreOf(const Surface<Dim>& surface, const typename Surface<Dim>::Piece& piece)
{
	Vec<Dim> centre = Vec<Dim>::Zero();
	for (const int v : piece)
		centre += surface.vertices[v] / Dim;
	return centre;
}

template <int Dim> Mat<Dim> heldBy(const Wall<Dim>& wall, const Vec<Dim>& normal)
{
	if (std::none_of(wall.fixed.begin(), wall.fixed.end(), [](bool f) { return f; })) return normal * normal.transpose();
	Mat<Dim> held = Mat<Dim>::Zero();
	for (int a = 0; a < Dim; ++a)
		held(a, a) = wall.fixed[a];
	return held;
}

} // namespace

template <int Dim> Wall<Dim>::Wall(Surface<Dim> s, double cellSize) : surface(std::move(s)), cellSize(cellSize)
{
	surface.refine(pieceLimit * cellSize);
	tractions.assign(surface.pieces.size(), Vec<Dim>::Zero());
}

template <int Dim>
WallForce<Dim>::WallForce(Wall<Dim>& wall, const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid, const Division& division)
        : wall_(wall)
{
	const auto&       leaves = basis.populatedLeaves();
	std::vector<char> isConstrained(leaves.size(), 0);
	std::vector<int>  leafOf;
	for (int i = 0; i < int(wall.surface.pieces.size()); ++i) {
		const Vec<Dim> centre = centreOf(wall.surface, wall.surface.pieces[i]),
		               normal = wall.surface.normal(wall.surface.pieces[i], wall.surface.vertices);
		const auto at         = attach(centre, basis, grid, wall.layer);
		if (!at || (grid.axisymmetric && centre[0] <= 0)) continue;
		constrainedPieces_.push_back({ i, *at, aroundAxis(centre[0], grid) * normal.norm(), heldBy<Dim>(wall, normal.normalized()), 0 });
		leafOf.push_back(position(leaves, Grid<Dim>::key(grid.first(at->cell * (1 << at->level)), at->level, std::max(0, wall.layer))));
		isConstrained[leafOf.back()] = 1;
	}
	auto moduli = cellModuli(isConstrained, basis, stiffnessOf, grid);
	division.complete(leaves, moduli);
	for (std::size_t g = 0; g < constrainedPieces_.size(); ++g)
		constrainedPieces_[g].stiffness = wall.penalty * moduli[leafOf[g]] / wall.cellSize;
}

/// On the body.
template <int Dim> Vec<Dim> WallForce<Dim>::tractionOn(const ConstrainedPiece& piece, const Eigen::VectorXd& d) const
{
	return wall_.tractions[piece.piece] - piece.stiffness * (piece.held * (piece.at.displacement(d) - wall_.motion));
}

template <int Dim> void WallForce<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (const ConstrainedPiece& piece : constrainedPieces_)
		markAttached(piece.at, piece.at, K);
}

template <int Dim> std::optional<PointFailure> WallForce<Dim>::add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum)
{
	for (const ConstrainedPiece& piece : constrainedPieces_) {
		addAttachedForce<Dim>(piece.at, piece.area * tractionOn(piece, d), sum);
		if (sum.K) addAttachedStiffness<Dim>(piece.at, piece.at, -piece.area * piece.stiffness * piece.held, *sum.K);
	}
	return std::nullopt;
}

template <int Dim> void WallForce<Dim>::addBefore(Eigen::VectorXd& force)
{
	for (const ConstrainedPiece& piece : constrainedPieces_)
		addAttachedForce<Dim>(piece.at, piece.area * wall_.tractions[piece.piece], { force });
}

template <int Dim> std::string WallForce<Dim>::obstacle() const
{
	if (!constrainedPieces_.empty() || wall_.motion.isZero(0)) return {};
	return "a wall moves, but none of it is where the grid holds material";
}

template <int Dim> void WallForce<Dim>::restrain(const typename Term<Dim>::Constrain& constrain)
{
	for (const ConstrainedPiece& piece : constrainedPieces_)
		for (int a = 0; a < Dim; ++a)
			if (!piece.held.col(a).isZero(0)) constrain(piece.at.node[0], piece.held.col(a), piece.at.inCell());
}

template <int Dim> void WallForce<Dim>::commit(const Eigen::VectorXd& d)
{
	std::vector<Vec<Dim>> tractions(wall_.tractions.size(), Vec<Dim>::Zero());
	wall_.reaction.setZero();
	for (const ConstrainedPiece& piece : constrainedPieces_) {
		tractions[piece.piece] = tractionOn(piece, d);
		wall_.reaction += piece.area * tractions[piece.piece];
	}
	wall_.tractions = std::move(tractions);
	for (Vec<Dim>& x : wall_.surface.vertices)
		x += wall_.motion;
}

template struct Wall<2>;
template struct Wall<3>;
template class WallForce<2>;
template class WallForce<3>;

} // namespace gimpm
