// SPDX-License-Identifier: GPL-2.0-or-later
// Ghost stabilisation (Coombs 2023, section 3): boundary elements, ghost faces and the stiffness on them.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/terms/cell_moduli.hpp"
#include "core/terms/term.hpp"

namespace gimpm {

/// Power of the cell size h in the ghost stiffness. Eq. (2) has h^3, which fades against K on fine grids; h keeps the
/// ratio. The two agree for h = 1 m.
enum class GhostScaling { meshIndependent, paper };

/// Boundary cells: populated cells, in a refined grid populated leaves, that share a face, or a part of it, with an
/// unpopulated one. A wall is no free surface: what lies behind it does not count.
template <int Dim> std::vector<Key> boundaryCells(const std::vector<Key>& populated, const Boundary<Dim>&, const Grid<Dim>& = {});

/// Face between two populated cells of which at least one is a boundary cell. Where a cell is larger than its
/// neighbour, the part of it that is as large as that is meant, and the nodes in it are tied: the jump is that of the
/// same functions.
template <int Dim> struct GhostFace {
	static constexpr int tangentialNodes = 1 << (Dim - 1);
	int                  axis;                        ///< normal direction
	Key                  lower;                       ///< the cell below, or its part; the one above is its neighbour along the axis
	int                  node[3][tangentialNodes] {}; ///< numbers of the nodes below, on and above the face
	double               stiffness = 0;               ///< gamma_k h^3/3 of eq. (2), or gamma_k h/3
	double girth = 1, widening = 0; ///< around an axis of symmetry: circumference with two lower nodes, and how much it grows with each higher one [m]

	/// The nodes below, on and above the face (i = 0, 1, 2): bits of s are set for the upper ends along the other
	/// axes, in order. At the far side of a periodic grid another node may stand for it.
	Key key(int i, int s) const
	{
		Key node = lower + i * Grid<Dim>::keyStep(axis, level());
		for (int a = 0, bit = 0; a < Dim; ++a)
			if (a != axis) node += (s >> bit & 1) * Grid<Dim>::keyStep(a, level()), ++bit;
		return node;
	}
	int level() const { return Grid<Dim>::level(lower); } ///< level of the nodes
};

/// Faces of a body, sorted. There are none across walls.
template <int Dim>
std::vector<GhostFace<Dim>> ghostFaces(const std::vector<Key>& populated, const std::vector<Key>& boundary, const Boundary<Dim>&, const Grid<Dim>& = {});

/// Numbers of the populated leaves below and above a face.
template <int Dim> std::array<int, 2> cellsAt(const GhostFace<Dim>&, const CloudBasis<Dim>&, const Grid<Dim>&);

/// Sets node numbers and stiffness = factor * modulus * (h or h^3) / 3, with h of the larger of the two cells: it is
/// what a nearly empty large cell needs. A cell's modulus is the mean of Young's moduli of its points, weighted by the
/// volumes of their domains' overlaps with it; a face has that of the softer of its two cells. With the stiffer one or
/// a mean, soft layers could not be strained beside stiff ones: the jump of the gradient of the displacements is what
/// equilibrium asks for there.
template <int Dim>
void weighGhostFaces(std::vector<GhostFace<Dim>>&, const CloudBasis<Dim>&, const PointStiffness&, const Grid<Dim>&, double factor, GhostScaling);

/// K += K_g, and the pattern of K_g; h is that of the smallest cells.
template <int Dim> void addGhostStiffness(const std::vector<GhostFace<Dim>>&, double h, NodeMatrix<Dim>& K);
template <int Dim> void markGhostPattern(const std::vector<GhostFace<Dim>>&, NodeMatrix<Dim>& K);

/// Calls f(node a, node b, code of the offset from a to b, entry of K_g) for pairs of nodes, b not before a; the entry
/// is the same for each displacement component.
template <int Dim> void forGhostPairs(const std::vector<GhostFace<Dim>>&, double h, const std::function<void(int, int, int, double)>& f);

/// f += K_g d (eq. 6).
template <int Dim> void addGhostForce(const std::vector<GhostFace<Dim>>&, double h, const Eigen::VectorXd& d, Eigen::VectorXd& f);

/// K_g (d - from) with the faces of a step; an empty `from` is zero.
template <int Dim> class GhostForce : public Term<Dim> {
public:
	GhostForce(const std::vector<GhostFace<Dim>>& faces, double h, const Eigen::VectorXd& from) : faces_(faces), h_(h), from_(from) { }

	void                        mark(NodeMatrix<Dim>& K) const override { markGhostPattern(faces_, K); }
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum) override;

private:
	const std::vector<GhostFace<Dim>>& faces_;
	double                             h_;
	const Eigen::VectorXd&             from_;
};

} // namespace gimpm
