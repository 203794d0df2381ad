// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/wall.hpp"
#include <algorithm>

namespace gimpm {
namespace {

constexpr double circle = 6.283185307179586;

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

/// Calls f(a, b, code of the offset from a to b, product of the weights) for the pairs of nodes of a cell with b not below a.
template <int Dim, class F> void forNodePairs(const Attachment<Dim>& at, F&& f)
{
	for (int m = 0; m < at.nodes; ++m)
		for (int n = 0; n < at.nodes; ++n) {
			const Index<Dim> offset = at.index(n) - at.index(m);
			if (const int code = NodeMatrix<Dim>::code(offset); code >= 0) f(at.node[m], at.node[n], code, at.weight[m] * at.weight[n]);
		}
}

} // namespace

template <int Dim> Wall<Dim>::Wall(Surface<Dim> s, double cellSize) : surface(std::move(s))
{
	surface.refine(pieceLimit * cellSize);
	tractions.assign(surface.pieces.size(), Vec<Dim>::Zero());
}

template <int Dim>
WallForce<Dim>::WallForce(Wall<Dim>& wall, const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid) : wall_(wall)
{
	std::vector<char> isHeld(basis.cells.size(), 0);
	std::vector<int>  cells;
	for (int i = 0; i < int(wall.surface.pieces.size()); ++i) {
		const Vec<Dim> centre = centreOf(wall.surface, wall.surface.pieces[i]),
		               normal = wall.surface.normal(wall.surface.pieces[i], wall.surface.vertices);
		const auto at         = attach(centre, basis, grid);
		if (!at || (grid.axisymmetric && centre[0] <= 0)) continue;
		const double ring = grid.axisymmetric ? circle * centre[0] : 1;
		grips_.push_back(
		        { i, *at, (centre - grid.nodePosition(at->cell)) / grid.cellSize, ring * normal.norm(), heldBy<Dim>(wall, normal.normalized()), 0 });
		cells.push_back(position(basis.cells, Grid<Dim>::key(grid.first(at->cell))));
		isHeld[cells.back()] = 1;
	}
	const auto moduli = cellModuli(isHeld, basis, stiffnessOf, grid);
	for (std::size_t g = 0; g < grips_.size(); ++g)
		grips_[g].stiffness = wall.penalty * moduli[cells[g]] / grid.cellSize;
}

/// On the body.
template <int Dim> Vec<Dim> WallForce<Dim>::tractionOn(const Grip& grip, const Eigen::VectorXd& d) const
{
	return wall_.tractions[grip.piece] - grip.stiffness * (grip.held * (grip.at.displacement(d) - wall_.motion));
}

template <int Dim> void WallForce<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (const Grip& grip : grips_)
		forNodePairs(grip.at, [&](int a, int, int code, double) { K.markUsed(a, code); });
}

template <int Dim> void WallForce<Dim>::addStiffness(NodeMatrix<Dim>& K) const
{
	for (const Grip& grip : grips_) {
		const Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor> block = grip.area * grip.stiffness * grip.held;
		forNodePairs(grip.at, [&](int a, int, int code, double weight) {
			Eigen::Map<Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>>(K.at(a, code)) += weight * block;
		});
	}
}

template <int Dim> std::optional<PointFailure> WallForce<Dim>::add(const Eigen::VectorXd& d, const TermSum<Dim>& sum) const
{
	for (const Grip& grip : grips_) {
		const Vec<Dim> f = grip.area * tractionOn(grip, d);
		for (int n = 0; n < grip.at.nodes; ++n) {
			const int first = Dim * grip.at.node[n];
			sum.force.template segment<Dim>(first) -= grip.at.weight[n] * f;
			if (sum.sizes) sum.sizes->template segment<Dim>(first) += std::abs(grip.at.weight[n]) * f.cwiseAbs();
		}
	}
	if (sum.K) addStiffness(*sum.K);
	return std::nullopt;
}

template <int Dim> std::string WallForce<Dim>::obstacle() const
{
	if (!grips_.empty() || wall_.motion.isZero(0)) return {};
	return "a wall moves, but none of it is where the grid holds material";
}

template <int Dim> double WallForce<Dim>::fromOutside(const Eigen::VectorXd& d) const
{
	Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
	add(d, { force });
	return force.norm();
}

template <int Dim> void WallForce<Dim>::restrain(const typename Term<Dim>::Hold& hold) const
{
	for (const Grip& grip : grips_)
		for (int a = 0; a < Dim; ++a)
			if (!grip.held.col(a).isZero(0)) hold(grip.at.node[0], grip.held.col(a), grip.inCell);
}

template <int Dim> void WallForce<Dim>::commit(const Eigen::VectorXd& d)
{
	std::vector<Vec<Dim>> tractions(wall_.tractions.size(), Vec<Dim>::Zero());
	wall_.reaction.setZero();
	for (const Grip& grip : grips_) {
		tractions[grip.piece] = tractionOn(grip, d);
		wall_.reaction += grip.area * tractions[grip.piece];
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
