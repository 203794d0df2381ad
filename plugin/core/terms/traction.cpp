// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/traction.hpp"
#include "core/terms/attach_surface.hpp"
#include "core/terms/attached.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <sstream>

namespace gimpm {
namespace {

/// Derivative of a piece's outward normal (times its size) by the position of each of its vertices.
std::array<Mat<2>, 2> normalDerivatives(const Surface<2>::Piece&, const std::vector<Vec<2>>&)
{
	const Mat<2> turn = (Mat<2>() << 0, 1, -1, 0).finished();
	return { -turn, turn };
}

std::array<Mat3, 3> normalDerivatives(const Surface<3>::Piece& piece, const std::vector<Vec3>& x)
{
	std::array<Mat3, 3> derivatives;
	for (int i = 0; i < 3; ++i) {
		// n = (x2 - x1) x (x3 - x1) / 2 gives dn/dx_i w = v x w / 2.
		const Vec3 v   = x[piece[(i + 2) % 3]] - x[piece[(i + 1) % 3]];
		derivatives[i] = 0.5 * (Mat3() << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0).finished();
	}
	return derivatives;
}

constexpr double circle = 2 * M_PI;

/// Weights of the vertices of a piece in the force on it, over traction and length (or area): around the axis of
/// symmetry r = x the integral of the vertex's linear function times the circumference.
template <int Dim> std::array<double, Dim> shares(const std::array<int, Dim>& piece, const std::vector<Vec<Dim>>& x, bool isRing)
{
	std::array<double, Dim> share;
	share.fill(1. / Dim);
	for (int i = 0; isRing && i < Dim; ++i)
		share[i] = circle / 6 * (x[piece[i]][0] + x[piece[0]][0] + x[piece[1]][0]);
	return share;
}

/// The derivative of the share of vertex i of a ring by the radius of its vertex j.
double weightDerivative(int i, int j) { return circle / 6 * (i == j ? 2 : 1); }

/// True if material is mostly on the outer side, half a cell away.
template <int Dim> bool isInsideOut(const Surface<Dim>& surface, const std::vector<Key>& populated, const Grid<Dim>& grid, int layer)
{
	const auto holdsMaterial = [&](const Vec<Dim>& x) {
		const Index<Dim> cell = ((x - grid.origin) / grid.cellSize).array().floor().template cast<int>();
		Key              key  = Grid<Dim>::key(grid.first(cell), 0, grid.parting ? grid.parting->layerAt(x, layer) : layer);
		if (grid.parting) key = grid.parting->cellFor(key);
		return find(populated, grid.refinement ? grid.refinement->leafOf(key) : key) >= 0;
	};
	double outside = 0; // area with material outside only, less that with material inside only
	for (const auto& piece : surface.pieces) {
		Vec<Dim> centre = Vec<Dim>::Zero();
		for (const int v : piece)
			centre += surface.vertices[v] / Dim;
		const Vec<Dim> normal = surface.normal(piece, surface.vertices), step = 0.5 * grid.cellSize * normal.normalized();
		outside += normal.norm() * (int(holdsMaterial(centre + step)) - int(holdsMaterial(centre - step)));
	}
	return outside > 0;
}

} // namespace

template <int Dim>
Traction<Dim>::Traction(SurfaceLoad<Dim>& load, const StepContext<Dim>& step)
        : load_(load), isRing_(step.grid.axisymmetric), isSymmetric_(load.pressure == 0 || load.surface.isClosed())
{
	auto attached = attachVertices(load_.surface, step, load_.name, load_.layer);
	attached_     = std::move(attached.positions);
	obstacle_     = std::move(attached.obstacle);
	layer_        = attached.layer;
	for (const Piece& piece : load_.surface.pieces) {
		const auto layerOf = [&](int v) { return Grid<Dim>::layer(step.basis.nodes[attached_[v].node[0]]); };
		isAcross_.push_back(obstacle_.empty() && step.grid.parting && std::any_of(piece.begin(), piece.end(), [&](int v) {
			                    return layerOf(v) != layerOf(piece[0]);
		                    }));
	}
	if (obstacle_.empty() && load.pressure != 0) obstacle_ = betweenLevels();
	if (!obstacle_.empty()) return;
	if (load.isNew && load.pressure != 0 && isInsideOut(load.surface, step.basis.populatedLeaves(), step.grid, layer_))
		obstacle_ = load.name + " is under pressure and has the body on its outer side: reverse the order of its points";
}

/// The derivative of a pressure couples the vertices of a piece, which a matrix over nodes has no place for where their
/// cells are of different sizes.
template <int Dim> std::string Traction<Dim>::betweenLevels() const
{
	for (const Piece& piece : load_.surface.pieces)
		for (const int v : piece)
			if (attached_[v].level != attached_[piece[0]].level) {
				std::ostringstream text;
				text << "a surface under pressure goes from cells of one size to cells of another, at ("
				     << load_.surface.vertices[v].transpose() << "): a traction of fixed direction may";
				return text.str();
			}
	return {};
}

template <int Dim> std::vector<Vec<Dim>> Traction<Dim>::positionsAt(const Eigen::VectorXd& d) const
{
	Positions positions = load_.surface.vertices;
	for (std::size_t v = 0; v < positions.size(); ++v)
		positions[v] += attached_[v].displacement(d);
	return positions;
}

template <int Dim> std::vector<Vec<Dim>> Traction<Dim>::forcesAt(const Positions& positions, double pressure, const Vec<Dim>& traction) const
{
	Positions   forces(positions.size(), Vec<Dim>::Zero());
	const auto& surface = load_.surface;
	for (const Piece& piece : surface.pieces) {
		const Vec<Dim> dead = surface.normal(piece, surface.vertices0).norm() * traction, follower = -pressure * surface.normal(piece, positions);
		const auto     first = shares<Dim>(piece, surface.vertices0, isRing_), now = shares<Dim>(piece, positions, isRing_);
		for (int i = 0; i < Dim; ++i)
			forces[piece[i]] += first[i] * dead + now[i] * follower;
	}
	return forces;
}

template <int Dim> void Traction<Dim>::mark(NodeMatrix<Dim>& K) const
{
	if (load_.pressure == 0) return;
	for (std::size_t p = 0; p < load_.surface.pieces.size(); ++p)
		for (const int i : load_.surface.pieces[p])
			for (const int j : load_.surface.pieces[p])
				if (!isAcross_[p]) markAttached(attached_[i], attached_[j], K);
}

template <int Dim> void Traction<Dim>::addStiffness(const Positions& positions, NodeMatrix<Dim>& K) const
{
	if (load_.pressure == 0) return;
	for (std::size_t p = 0; p < load_.surface.pieces.size(); ++p) {
		if (isAcross_[p]) continue;
		const Piece&   piece       = load_.surface.pieces[p];
		const auto     derivatives = normalDerivatives(piece, positions);
		const auto     share       = shares<Dim>(piece, positions, isRing_);
		const Vec<Dim> normal      = load_.surface.normal(piece, positions);
		for (int i = 0; i < Dim; ++i)
			for (int j = 0; j < Dim; ++j) {
				Mat<Dim> tangent = share[i] * derivatives[j];
				if (isRing_) tangent.col(0) += weightDerivative(i, j) * normal;
				addAttachedStiffness<Dim>(attached_[piece[i]], attached_[piece[j]], -load_.pressure * tangent, K);
			}
	}
}

template <int Dim> std::optional<PointFailure> Traction<Dim>::add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum)
{
	const Positions positions = positionsAt(d), forces = forcesAt(positions);
	for (std::size_t v = 0; v < forces.size(); ++v)
		addAttachedForce(attached_[v], forces[v], sum);
	if (sum.K) addStiffness(positions, *sum.K);
	return std::nullopt;
}

template <int Dim> void Traction<Dim>::addBefore(Eigen::VectorXd& force)
{
	if (!obstacle_.empty()) return;
	const Positions forces = forcesAt(load_.surface.vertices, load_.pressureBefore, load_.tractionBefore);
	for (std::size_t v = 0; v < forces.size(); ++v)
		addAttachedForce<Dim>(attached_[v], forces[v], { force });
}

template <int Dim> void Traction<Dim>::commit(const Eigen::VectorXd& d)
{
	const Positions before = load_.surface.vertices, first = forcesAt(before, load_.pressureBefore, load_.tractionBefore);
	load_.surface.vertices = positionsAt(d);
	const Positions forces = forcesAt(load_.surface.vertices);
	load_.resultant        = std::accumulate(forces.begin(), forces.end(), Vec<Dim>(Vec<Dim>::Zero()));
	load_.work             = 0;
	for (std::size_t v = 0; v < before.size(); ++v)
		load_.work += (first[v] + forces[v]).dot(load_.surface.vertices[v] - before[v]) / 2;
	load_.pressureBefore = load_.pressure;
	load_.tractionBefore = load_.traction;
}

template class Traction<2>;
template class Traction<3>;

} // namespace gimpm
