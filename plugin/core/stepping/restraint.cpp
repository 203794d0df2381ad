// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/restraint.hpp"
#include "core/base/small_matrices.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace gimpm {
namespace {

/// Parts of the body: nodes joined by patches. In a periodic grid the positions of a part's nodes follow the patches
/// beyond the sides.
template <int Dim> class Parts {
public:
	/// A part meets its own image: it goes around the grid.
	struct Turn {
		int        root;
		Index<Dim> length; ///< [cells]
	};

	/// `byCells`: a process that does not have all patches joins the corners of the cells, which gives the same
	/// parts.
	Parts(const CloudBasis<Dim>& basis, const Grid<Dim>& grid, bool byCells)
	        : basis_(basis), parent_(basis.nodes.size()), offset_(parent_.size(), Index<Dim>::Zero())
	{
		std::iota(parent_.begin(), parent_.end(), 0);
		if (byCells)
			for (const Key cell : basis.cells)
				for (int c = 1; c < windowCells<Dim>; ++c) {
					const Key corner = cell + Grid<Dim>::keyOffset(c);
					const int node   = position(basis.nodes, grid.first(corner));
					join(position(basis.nodes, cell), node, Grid<Dim>::index(corner) - index(node));
				}
		else
			for (const auto& patch : basis.patches)
				join(patch, grid);
		for (std::size_t t = 0; t < basis.affineConstraints.node.size(); ++t)
			for (int m = basis.affineConstraints.start[t]; m < basis.affineConstraints.start[t + 1]; ++m)
				join(basis.affineConstraints.node[t], basis.affineConstraints.master[m], Index<Dim>::Zero());
		for (std::size_t n = 0; n < parent_.size(); ++n)
			std::tie(parent_[n], offset_[n]) = find(int(n));
		for (Turn& turn : turns_)
			turn.root = root(turn.root);
	}
	/// The same for all nodes of a part.
	int                      root(std::size_t node) const { return parent_[node]; }
	const std::vector<Turn>& turns() const { return turns_; }

	/// In cells.
	Vec<Dim> location(std::size_t node) const { return (index(int(node)) + offset_[node]).template cast<double>(); }

private:
	Index<Dim> index(int node) const { return Grid<Dim>::index(basis_.nodes[node]); }

	/// The root of a node, and how much further the node is from it than their numbers tell.
	std::pair<int, Index<Dim>> find(int n)
	{
		Index<Dim> sum = Index<Dim>::Zero();
		for (; parent_[n] != n; n = parent_[n]) {
			offset_[n] += offset_[parent_[n]];
			parent_[n] = parent_[parent_[n]];
			sum += offset_[n];
		}
		return { n, sum };
	}
	void join(const Patch<Dim>& patch, const Grid<Dim>& grid)
	{
		const Index<Dim> cell  = Grid<Dim>::index(patch.cell);
		int              first = -1;
		// Offset of the first node of the patch from the node that its number stands for.
		Index<Dim> image;
		for (int n = 0; n < windowNodes<Dim>; ++n) {
			if (patch.node[n] < 0) continue;
			Index<Dim> location = cell;
			for (int a = 0, rest = n; a < Dim; rest /= patch.nodesAlong(a), ++a)
				location[a] += rest % patch.nodesAlong(a) * (1 << Grid<Dim>::level(patch.cell));
			const Index<Dim> shift = grid.isPeriodic() ? Index<Dim>(location - index(patch.node[n])) : Index<Dim>(Index<Dim>::Zero());
			if (first < 0) first = patch.node[n], image = shift;
			else
				join(first, patch.node[n], shift - image);
		}
	}
	/// `apart`: how much further than their numbers tell the second node is from the first.
	void join(int a, int b, const Index<Dim>& apart)
	{
		const auto [rootA, fromA] = find(a);
		const auto [rootB, fromB] = find(b);
		const Index<Dim> further  = fromA + apart - fromB; // root B from root A
		if (rootA == rootB) {
			if (!further.isZero()) turns_.push_back({ rootA, further });
		} else if (rootA < rootB)
			parent_[rootB] = rootA, offset_[rootB] = further;
		else
			parent_[rootA] = rootB, offset_[rootA] = -further;
	}

	const CloudBasis<Dim>& basis_;
	std::vector<int>       parent_;
	// Images: how much further than their numbers tell a node is from its parent, in cells.
	std::vector<Index<Dim>> offset_;
	std::vector<Turn>       turns_;
};

template <int Dim> struct Part {
	static constexpr int modes = Dim == 2 ? 3 : 6;
	using Gram                 = Eigen::Matrix<double, modes, modes>;

	Vec<Dim> sum   = Vec<Dim>::Zero(); // sum of node positions, in cells
	int      nodes = 0, points = 0;
	double   reach = 1;            // largest distance of a node from the centre, in cells
	Gram     gram  = Gram::Zero(); // products of the rigid modes' values at the constrained degrees of freedom

	Vec<Dim> centre() const { return sum / nodes; }

	/// Adds a resistance to displacement in this direction at this position.
	void constrain(const Vec<Dim>& position, const Vec<Dim>& direction)
	{
		Eigen::Matrix<double, modes, 1> m = Eigen::Matrix<double, modes, 1>::Zero();
		for (int a = 0; a < Dim; ++a)
			if (direction[a] != 0) m += direction[a] * rigidModes(position, a);
		gram += m * m.transpose();
	}

	/// A ring about an axis along y cannot but move along it.
	void encircle()
	{
		for (int mode = 0; mode < modes; ++mode)
			if (mode != 1) gram(mode, mode) += 1;
	}

	/// Constrains a part that moves like its own image so far away.
	void repeat(const Index<Dim>& length)
	{
		for (int a = 0; a < Dim; ++a) {
			const Eigen::Matrix<double, modes, 1> m = rigidModes(centre() + length.template cast<double>(), a) - rigidModes(centre(), a);
			gram += m * m.transpose();
		}
	}

private:
	/// Value of the rigid modes in a direction at a position: translations, then rotations of unit displacement at
	/// `reach`.
	Eigen::Matrix<double, modes, 1> rigidModes(const Vec<Dim>& position, int axis) const
	{
		Eigen::Matrix<double, modes, 1> m = Eigen::Matrix<double, modes, 1>::Zero();
		const Vec<Dim>                  r = (position - centre()) / reach;
		m[axis]                           = 1;
		if constexpr (Dim == 2) m[2] = axis == 0 ? -r[1] : r[0];
		else
			for (int k = 0; k < 3; ++k)
				m[3 + k] = Vec3::Unit(k).cross(r)[axis];
		return m;
	}
};

template <int Dim> std::string placeOf(const Part<Dim>& part, const Grid<Dim>& grid)
{
	const Vec<Dim>     position = grid.origin + grid.cellSize * part.centre();
	std::ostringstream text;
	text << "(" << position[0] << ", " << position[1];
	if (Dim == 3) text << ", " << position[Dim - 1];
	text << ")";
	return text.str();
}

template <int Dim> std::string describe(const Part<Dim>& part, const Grid<Dim>& grid)
{
	const SymmetricEigen eigen = symmetricEigen(part.gram);
	if (eigen.values[0] > 1e-10) return "";
	// A translation is named, if there is one among the free motions (all modes with a zero eigenvalue).
	const auto         free = eigen.vectors.leftCols((eigen.values.array() <= 1e-10).count()).eval();
	std::ostringstream text;
	int                axis = -1;
	for (int a = Dim - 1; a >= 0; --a)
		if (free.row(a).norm() > 1 - 1e-6) axis = a;
	if (axis >= 0)
		text << "translation along "
		     << "xyz"[axis];
	else
		text << "rotation";
	text << " of the material around " << placeOf(part, grid);
	return text.str();
}

/// Sorts those that can move freely.
template <int Dim> Restraint judged(const std::map<int, Part<Dim>>& found, const Parts<Dim>& parts, const Grid<Dim>& grid, int nodes)
{
	Restraint  result { int(found.size()), "" };
	const int  few  = 1 << Dim;
	const bool rest = std::any_of(found.begin(), found.end(), [&](const auto& part) { return part.second.points >= few; });
	for (const auto& [root, part] : found) {
		const std::string motion = describe(part, grid);
		if (motion.empty()) continue;
		if (!rest || part.points == 0 || part.points >= few) {
			if (result.freeMotion.empty()) result.freeMotion = motion;
			continue;
		}
		if (result.loose.position.empty()) result.loose.position = placeOf(part, grid);
		result.loose.points += part.points;
		for (int n = 0; n < nodes; ++n)
			if (parts.root(n) == root) result.loose.nodes.push_back(n);
	}
	return result;
}

/// Counts the points of each part. Where points are divided among processes each counts its own ones; all of them know
/// the same parts.
template <int Dim> void countPoints(const CloudBasis<Dim>& basis, const Parts<Dim>& parts, const Division& division, std::map<int, Part<Dim>>& found)
{
	const int own = division.ownOf(basis.order.size());
	for (const auto& patch : basis.patches) {
		const int  node  = *std::find_if(patch.node.begin(), patch.node.end(), [](int n) { return n >= 0; });
		const auto first = basis.order.begin() + patch.first;
		found[parts.root(node)].points += int(std::count_if(first, first + patch.count, [own](int p) { return p < own; }));
	}
	if (division.isWhole() || found.size() == 1) return; // a single group: nothing is apart from it
	std::vector<double> counts;
	for (auto& [root, part] : found)
		counts.push_back(std::exchange(part.points, 0));
	counts        = division.joined(std::move(counts));
	std::size_t i = 0;
	while (i < counts.size())
		for (auto& [root, part] : found)
			part.points += int(counts[i++]);
}

/// `holds(term, hold)` tells what a term holds.
template <int Dim, class F>
Restraint restraintBy(
        const CloudBasis<Dim>& basis, const Grid<Dim>& grid, const Boundary<Dim>& boundary, const Terms<Dim>& terms, const Division& division, F&& constrains)
{
	const Parts<Dim>         parts(basis, grid, !division.isWhole());
	std::map<int, Part<Dim>> found;
	for (std::size_t n = 0; n < basis.nodes.size(); ++n) {
		Part<Dim>& part = found[parts.root(n)];
		part.sum += parts.location(n);
		++part.nodes;
	}
	for (std::size_t n = 0; n < basis.nodes.size(); ++n) {
		Part<Dim>& part = found[parts.root(n)];
		part.reach      = std::max(part.reach, (parts.location(n) - part.centre()).norm());
	}
	countPoints(basis, parts, division, found);
	const auto constrain = [&](std::size_t n, const Vec<Dim>& direction, const Vec<Dim>& position) {
		found[parts.root(n)].constrain(parts.location(n) + position, direction);
	};
	for (std::size_t n = 0; n < basis.nodes.size(); ++n)
		for (int a = 0; a < Dim; ++a)
			if (!basis.affineConstraints.contains(int(n)) && boundary.constrainingBox(basis.nodes[n], a))
				constrain(n, Vec<Dim>::Unit(a), Vec<Dim>::Zero());
	for (const auto& term : terms)
		constrains(*term, [&](int n, const Vec<Dim>& direction, const Vec<Dim>& position) { constrain(n, direction.normalized(), position); });
	for (auto& [root, part] : found)
		if (grid.axisymmetric) part.encircle();
	for (const auto& turn : parts.turns())
		found[turn.root].repeat(turn.length);
	return judged(found, parts, grid, int(basis.nodes.size()));
}

/// Groups of cells that are joined by faces or by a point in them. Of the stiffness of soil and of its stabilisation
/// nothing goes from one to another; they share nodes where they meet at a corner or an edge.
template <int Dim> class Hinges {
public:
	Hinges(const CloudBasis<Dim>& basis, const Grid<Dim>& grid) : basis_(basis), grid_(grid), parent_(basis.cells.size()), ofLarge_(basis.nodes.size(), 0)
	{
		std::iota(parent_.begin(), parent_.end(), 0);
		for (const auto& patch : basis.patches)
			for (const int cell : patch.reached)
				if (cell >= 0) join(firstOf(patch), cell);
		for (std::size_t c = 0; c < parent_.size(); ++c)
			for (int a = 0; a < Dim; ++a) {
				const Key  beside = basis.cells[c] + Grid<Dim>::keyOffset(1 << a);
				const auto found  = std::lower_bound(basis.cells.begin(), basis.cells.end(), beside);
				if (found != basis.cells.end() && *found == beside) join(int(c), int(found - basis.cells.begin()));
			}
		for (const auto& patch : basis.patches)
			points_[root(firstOf(patch))] += patch.count;
		for (const auto& patch : basis.patches) {
			const int group = root(firstOf(patch));
			for (const int n : patch.node)
				if (n < 0) continue;
				else if (isSmall(group))
					small_[group].insert(n);
				else
					ofLarge_[n] = 1;
		}
	}

	LoosePoints loose(const Boundary<Dim>& boundary, const Terms<Dim>& terms) const
	{
		LoosePoints result;
		if (small_.empty() || std::find(ofLarge_.begin(), ofLarge_.end(), 1) == ofLarge_.end()) return result;
		for (const auto& [group, nodes] : small_) {
			const Part<Dim> part = constrainedPart(nodes, boundary, terms);
			if (describe(part, grid_).empty()) continue;
			if (result.points == 0) result.position = placeOf(part, grid_);
			result.points += points_.at(group);
			std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(result.nodes), [&](int n) { return !ofLarge_[n]; });
		}
		return result;
	}

private:
	static int firstOf(const Patch<Dim>& patch)
	{
		return *std::find_if(patch.reached.begin(), patch.reached.end(), [](int cell) { return cell >= 0; });
	}
	bool isSmall(int group) const { return points_.at(group) < 1 << Dim; }
	int  root(int cell)
	{
		for (; parent_[cell] != cell; cell = parent_[cell])
			parent_[cell] = parent_[parent_[cell]];
		return cell;
	}
	void     join(int a, int b) { parent_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }
	Vec<Dim> position(int node) const { return Grid<Dim>::index(basis_.nodes[node]).template cast<double>(); }

	/// Part with its constraints, nodes of large groups among them.
	Part<Dim> constrainedPart(const std::set<int>& nodes, const Boundary<Dim>& boundary, const Terms<Dim>& terms) const
	{
		Part<Dim> part;
		for (const int n : nodes)
			part.sum += position(n), ++part.nodes;
		for (const int n : nodes)
			part.reach = std::max(part.reach, (position(n) - part.centre()).norm());
		for (const int n : nodes)
			for (int a = 0; a < Dim; ++a)
				if (ofLarge_[n] || boundary.constrainingBox(basis_.nodes[n], a)) part.constrain(position(n), Vec<Dim>::Unit(a));
		for (const auto& term : terms)
			term->restrain([&](int n, const Vec<Dim>& direction, const Vec<Dim>& inCell) {
				if (nodes.count(n)) part.constrain(position(n) + inCell, direction.normalized());
			});
		if (grid_.axisymmetric) part.encircle();
		return part;
	}

	const CloudBasis<Dim>&       basis_;
	const Grid<Dim>&             grid_;
	std::vector<int>             parent_;  // parents of cells
	std::map<int, int>           points_;  // points of groups
	std::map<int, std::set<int>> small_;   // nodes of groups of few points
	std::vector<char>            ofLarge_; // flag by node
};

} // namespace

template <int Dim>
Restraint restraint(const CloudBasis<Dim>& basis, const Grid<Dim>& grid, const Boundary<Dim>& boundary, const Terms<Dim>& terms, const Division& division)
{
	return restraintBy(
	        basis, grid, boundary, terms, division, [](Term<Dim>& term, const typename Term<Dim>::Constrain& constrain) { term.restrain(constrain); });
}

template <int Dim>
Restraint restraintAt(
        const Eigen::VectorXd& d, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, const Boundary<Dim>& boundary, const Terms<Dim>& terms,
        const Division& division)
{
	return restraintBy(basis, grid, boundary, terms, division, [&](Term<Dim>& term, const typename Term<Dim>::Constrain& constrain) {
		term.restrainAt(d, constrain);
	});
}

template <int Dim>
LoosePoints hinged(const CloudBasis<Dim>& basis, const Grid<Dim>& grid, const Boundary<Dim>& boundary, const Terms<Dim>& terms, const Division& division)
{
	if (!division.isWhole() || grid.isPeriodic() || !basis.leafOf.empty() || !basis.affineConstraints.empty()) return {};
	return Hinges<Dim>(basis, grid).loose(boundary, terms);
}

template LoosePoints hinged(const CloudBasis<2>&, const Grid<2>&, const Boundary<2>&, const Terms<2>&, const Division&);
template LoosePoints hinged(const CloudBasis<3>&, const Grid<3>&, const Boundary<3>&, const Terms<3>&, const Division&);
template Restraint   restraint(const CloudBasis<2>&, const Grid<2>&, const Boundary<2>&, const Terms<2>&, const Division&);
template Restraint   restraint(const CloudBasis<3>&, const Grid<3>&, const Boundary<3>&, const Terms<3>&, const Division&);
template Restraint   restraintAt(const Eigen::VectorXd&, const CloudBasis<2>&, const Grid<2>&, const Boundary<2>&, const Terms<2>&, const Division&);
template Restraint   restraintAt(const Eigen::VectorXd&, const CloudBasis<3>&, const Grid<3>&, const Boundary<3>&, const Terms<3>&, const Division&);

} // namespace gimpm
