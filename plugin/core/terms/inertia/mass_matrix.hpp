// SPDX-License-Identifier: GPL-2.0-or-later
// The mass of the points on the nodes, consistent with the basis functions, with ghost mass.
#pragma once
#include "core/parallel/owned_nodes.hpp"
#include "core/solvers/reduce.hpp"
#include "core/terms/inertia/loose_cells.hpp"

namespace gimpm {

/// M_ab = sum of m_p S_a S_b over the points, and M_g, which is K_g (core/terms/ghost.hpp) with gamma_M h^3 / 3 for the
/// faces' stiffness (Sticko et al. 2020): it penalises jumps of the gradient of velocities, so that the condition
/// number does not depend on how little of a cell is filled. Its rows add up to zero: mass, momentum and every linear
/// field of velocities are left alone. Where points are too few by themselves, loose cells are given a share of lumped
/// less consistent mass, m (1 / n - 1 / n^2) for their n nodes and -m / n^2 for pairs of them: its rows add up to zero
/// too, so that mass, momentum and uniform velocities are left alone, but not linear ones. One number for a pair of
/// nodes, the same for each component.
template <int Dim> class MassMatrix {
public:
	/// Masses by point of the cloud [kg].
	MassMatrix(
	        const CloudBasis<Dim>&, const std::vector<double>& masses, const std::vector<GhostFace<Dim>>&, double h,
	        const std::vector<LooseCell<Dim>>& loose = {}, double share = usualLooseShare);

	/// Mass of loose cells alone, that of a body without mass.
	MassMatrix(std::size_t nodes, const std::vector<LooseCell<Dim>>& loose, double share);

	/// Adds a share of the lumped less consistent mass of loose cells, at those of their nodes that are not -1.
	void lump(const std::vector<LooseCell<Dim>>&, double share);

	/// Completes the matrix where points are divided: each process has the rows of its own nodes, and then all
	/// rows.
	void complete(const OwnedNodes&, const std::vector<Key>& nodes);

	int nodes() const { return int(neighbour_.size()) / codes; }

	void            mark(NodeMatrix<Dim>& K) const;
	void            addTo(NodeMatrix<Dim>& K, double factor) const; ///< K += factor (M + M_g)
	Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;      ///< for nodal vectors of Dim components a node
	Eigen::VectorXd absoluteTimes(const Eigen::VectorXd& x) const;  ///< the same with the magnitudes of all numbers

	/// f(a, b, code, number) for b not before a.
	template <class F> void forEntries(F&& f) const
	{
		for (int a = 0; a < nodes(); ++a)
			for (int code = 0; code < codes; ++code)
				if (const std::size_t slot = std::size_t(a) * codes + code; neighbour_[slot] >= 0) f(a, neighbour_[slot], code, value_[slot]);
	}

	/// Rows and columns of the degrees of freedom that are free along an axis, with what is tied to them.
	SymmetricCsc reduced(const FreeDofs&, int axis) const;

private:
	static constexpr int codes = NodeMatrix<Dim>::codes;

	void add(int a, int b, int code, double m)
	{
		const std::size_t slot = std::size_t(a) * codes + code;
		neighbour_[slot]       = b;
		value_[slot] += m;
	}

	/// Product with the matrix that has weight(number) for each number.
	template <class F> Eigen::VectorXd product(const Eigen::VectorXd& x, F&& weight) const;

	std::vector<double> value_;
	std::vector<int>    neighbour_; // -1: nothing there
};

} // namespace gimpm
