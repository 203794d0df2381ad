// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/restraint.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <map>
#include <numeric>
#include <sstream>

namespace gimpm {
namespace {

/// Parts of the body: nodes joined by patches. Returns a representative node of the part for each node.
template <int Dim> std::vector<int> parts(const CloudBasis<Dim>& basis)
{
	std::vector<int> root(basis.nodes.size());
	std::iota(root.begin(), root.end(), 0);
	const auto find = [&](int n) {
		while (root[n] != n)
			n = root[n] = root[root[n]];
		return n;
	};
	for (const auto& patch : basis.patches) {
		int first = -1;
		for (const int n : patch.node) {
			if (n < 0) continue;
			if (first < 0) first = find(n);
			const int other              = find(n);
			root[std::max(first, other)] = std::min(first, other);
			first                        = std::min(first, other);
		}
	}
	for (std::size_t n = 0; n < root.size(); ++n)
		root[n] = find(int(n));
	return root;
}

template <int Dim> struct Part {
	static constexpr int modes = Dim == 2 ? 3 : 6;
	using Gram                 = Eigen::Matrix<double, modes, modes>;

	Vec<Dim> sum   = Vec<Dim>::Zero(); // of node positions, in cells
	int      nodes = 0;
	double   reach = 1;            // largest distance of a node from the centre, in cells
	Gram     gram  = Gram::Zero(); // of the rigid modes' values at the held degrees of freedom

	Vec<Dim> centre() const { return sum / nodes; }

	/// What resists a displacement in this direction at this place.
	void hold(const Vec<Dim>& place, const Vec<Dim>& direction)
	{
		Eigen::Matrix<double, modes, 1> m = Eigen::Matrix<double, modes, 1>::Zero();
		for (int a = 0; a < Dim; ++a)
			if (direction[a] != 0) m += direction[a] * rigidModes(place, a);
		gram += m * m.transpose();
	}

private:
	/// Value of the rigid modes in a direction at a place: translations, then rotations of unit displacement at `reach`.
	Eigen::Matrix<double, modes, 1> rigidModes(const Vec<Dim>& place, int axis) const
	{
		Eigen::Matrix<double, modes, 1> m = Eigen::Matrix<double, modes, 1>::Zero();
		const Vec<Dim>                  r = (place - centre()) / reach;
		m[axis]                           = 1;
		if constexpr (Dim == 2) m[2] = axis == 0 ? -r[1] : r[0];
		else
			for (int k = 0; k < 3; ++k)
				m[3 + k] = Vec3::Unit(k).cross(r)[axis];
		return m;
	}
};

template <int Dim> std::string describe(const Part<Dim>& part, const Grid<Dim>& grid)
{
	const Eigen::SelfAdjointEigenSolver<typename Part<Dim>::Gram> eigen(part.gram);
	if (eigen.eigenvalues()[0] > 1e-10) return "";
	// Of the free motions (all modes with a zero eigenvalue), name a translation if there is one.
	const auto         free = eigen.eigenvectors().leftCols((eigen.eigenvalues().array() <= 1e-10).count()).eval();
	std::ostringstream text;
	int                axis = -1;
	for (int a = Dim - 1; a >= 0; --a)
		if (free.row(a).norm() > 1 - 1e-6) axis = a;
	if (axis >= 0)
		text << "translation along "
		     << "xyz"[axis];
	else
		text << "rotation";
	const Vec<Dim> place = grid.origin + grid.cellSize * part.centre();
	text << " of the material around (" << place[0] << ", " << place[1];
	if (Dim == 3) text << ", " << place[Dim - 1];
	text << ")";
	return text.str();
}

} // namespace

template <int Dim> Restraint restraint(const CloudBasis<Dim>& basis, const Grid<Dim>& grid, const Boundary<Dim>& boundary, const Terms<Dim>& terms)
{
	const auto               root = parts(basis);
	std::map<int, Part<Dim>> found;
	const auto               place = [&](std::size_t n) { return Vec<Dim>(Grid<Dim>::index(basis.nodes[n]).template cast<double>()); };
	for (std::size_t n = 0; n < root.size(); ++n) {
		Part<Dim>& part = found[root[n]];
		part.sum += place(n);
		++part.nodes;
	}
	for (std::size_t n = 0; n < root.size(); ++n) {
		Part<Dim>& part = found[root[n]];
		part.reach      = std::max(part.reach, (place(n) - part.centre()).norm());
	}
	for (std::size_t n = 0; n < root.size(); ++n)
		for (int a = 0; a < Dim; ++a)
			if (boundary.holder(Grid<Dim>::index(basis.nodes[n]), a)) found[root[n]].hold(place(n), Vec<Dim>::Unit(a));
	for (const auto& term : terms)
		term->restrain([&](int n, const Vec<Dim>& direction) { found[root[n]].hold(place(n), direction.normalized()); });
	Restraint result { int(found.size()), "" };
	for (auto part = found.begin(); part != found.end() && result.freeMotion.empty(); ++part)
		result.freeMotion = describe(part->second, grid);
	return result;
}

template Restraint restraint(const CloudBasis<2>&, const Grid<2>&, const Boundary<2>&, const Terms<2>&);
template Restraint restraint(const CloudBasis<3>&, const Grid<3>&, const Boundary<3>&, const Terms<3>&);

} // namespace gimpm
