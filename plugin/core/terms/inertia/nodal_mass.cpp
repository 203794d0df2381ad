// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/nodal_mass.hpp"
#include "core/grid/masters.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/solvers/node_blocks.hpp"
#include <algorithm>
#include <numeric>

namespace gimpm {
namespace {

/// Lumped part of the mass of loose cells. Displacements that their points do not see have stiffness all the same,
/// where a displacement vanishes and its gradient does not: with less mass they would not be stable.
constexpr double lumpedShare = 1;

/// Sum of the mass at each node, of all processes; that of tied nodes is their masters'.
template <int Dim> std::vector<double> lumped(const CloudBasis<Dim>& basis, const std::vector<double>& masses, const OwnedNodes& ownedNodes)
{
	Eigen::VectorXd sum = Eigen::VectorXd::Zero(Eigen::Index(basis.nodes.size()));
	forPointNodes(basis, [&](int p, const Patch<Dim>& patch, const double* value, int count) {
		for (int n = 0; n < count; ++n)
			if (patch.node[n] >= 0) sum[patch.node[n]] += masses[basis.order[p]] * value[n];
	});
	ownedNodes.complete(sum);
	basis.affineConstraints.template condense<1>(sum);
	return { sum.begin(), sum.end() };
}

/// f(degree of freedom, position) for a side of several, whose components stand node by node.
template <int Dim, class F> void forDofs(int side, std::size_t sides, int nodes, F&& f)
{
	for (int dof = 0; dof < Dim * nodes; ++dof)
		f(dof, (Eigen::Index(dof / Dim) * Eigen::Index(sides) + side) * Dim + dof % Dim);
}

} // namespace

template <int Dim>
NodalMass<Dim>::NodalMass(
        const CloudBasis<Dim>& basis, const std::vector<double>& masses, const std::vector<GhostFace<Dim>>& faces, double h,
        const std::vector<LooseCell<Dim>>& loose, const OwnedNodes& ownedNodes)
{
	if (faces.empty()) {
		lumped_ = lumped(basis, masses, ownedNodes);
		return;
	}
	MassMatrix<Dim> mass(basis, masses, faces, h, loose, lumpedShare);
	mass.complete(ownedNodes, basis.nodes);
	*this = NodalMass(mass, basis.affineConstraints);
}

template <int Dim> NodalMass<Dim>::NodalMass(const MassMatrix<Dim>& mass, const AffineConstraints& affineConstraints) : lumped_(mass.nodes(), 0)
{
	const MastersOf masters(mass.nodes(), &affineConstraints);
	auto& [value, first, neighbour, upper] = rows_;
	first.assign(mass.nodes() + 1, 0);
	const auto forBoth = [&](auto&& f) {
		mass.forEntries([&](int a, int b, int, double m) {
			masters.eachPair(a, b, [&](int p, int q, double part) { f(p, q, part * m); });
			if (b != a) masters.eachPair(b, a, [&](int p, int q, double part) { f(p, q, part * m); });
		});
		for (const int node : affineConstraints.node)
			f(node, node, 0);
	};
	forBoth([&counts = first](int a, int, double) { ++counts[a + 1]; });
	std::partial_sum(first.begin(), first.end(), first.begin());
	std::vector<int> next(first.begin(), first.end() - 1);
	for (int& position : next)
		++position;
	value.assign(first.back(), 0);
	neighbour.resize(first.back());
	forBoth([&, &value = value, &neighbour = neighbour, &first = first](int a, int b, double m) {
		const int position  = a == b ? first[a] : next[a]++;
		neighbour[position] = b;
		value[position] += m;
		lumped_[a] += m;
	});
	rows_.sort();
}

template <int Dim> Eigen::VectorXd NodalMass<Dim>::operator*(const Eigen::VectorXd& x) const
{
	if (isLumped()) return Eigen::VectorXd::NullaryExpr(x.size(), [&](Eigen::Index i) { return lumped_[i / Dim] * x[i]; });
	Eigen::VectorXd y(x.size());
	forBlocks(rows_.nodes(), [&](int begin, int end) {
		for (int a = begin; a < end; ++a) {
			Vec<Dim> sum = Vec<Dim>::Zero();
			for (int e = rows_.first[a]; e < rows_.first[a + 1]; ++e)
				sum += rows_.value[e] * x.segment<Dim>(Dim * rows_.neighbour[e]);
			y.segment<Dim>(Dim * a) = sum;
		}
	});
	return y;
}

/// Guesses by a lumped mass.
template <int Dim> bool NodalMass<Dim>::guess(const Side& side, const Eigen::VectorXd* C) const
{
	for (Eigen::Index i = 0; i < side.x.size(); ++i)
		if (side.dofs.number[i] >= 0) side.x[i] = side.right[i] / (lumped_[i / Dim] + (C ? (*C)[i] : 0));
	return side.x.allFinite();
}

/// Rest of the right side at the free degrees of freedom.
template <int Dim> Eigen::VectorXd NodalMass<Dim>::rest(const Side& side, const Eigen::VectorXd* C) const
{
	Eigen::VectorXd left = side.right;
	if (!side.x.isZero(0)) left -= *this * side.x;
	for (Eigen::Index i = 0; i < left.size(); ++i)
		if (side.dofs.number[i] < 0) left[i] = 0;
		else if (C)
			left[i] -= (*C)[i] * side.x[i];
	return left;
}

/// Starts from the better one of two guesses: nothing, or that of a lumped mass, which is right where all moves alike,
/// and wrong for forces that grip light nodes.
template <int Dim> typename NodalMass<Dim>::Start NodalMass<Dim>::start(const Side& side, const Eigen::VectorXd* C) const
{
	Eigen::VectorXd guessed = side.x;
	for (Eigen::Index i = 0; i < guessed.size(); ++i)
		if (side.dofs.number[i] >= 0) side.x[i] = 0;
	Eigen::VectorXd left = rest(side, C);
	const double    size = sizeOf(left);
	if (!guess({ side.right, side.dofs, guessed }, C)) return { left, size };
	Eigen::VectorXd leftByGuess = rest({ side.right, side.dofs, guessed }, C);
	if (!(sizeOf(leftByGuess) < size)) return { left, size };
	side.x = guessed;
	return { leftByGuess, size };
}

/// Each momentum weighed by its node's mass, m^-1/2: a small one of a light node counts too.
template <int Dim> double NodalMass<Dim>::sizeOf(const Eigen::VectorXd& momenta) const
{
	const auto weighed = [&](Eigen::Index i) { return momenta[i] == 0 ? 0 : momenta[i] / std::sqrt(rows_.diagonal(int(i) / Dim)); };
	return Eigen::VectorXd::NullaryExpr(momenta.size(), weighed).stableNorm();
}

/// Along axes on which nothing is held momentum is right to round-off, whatever the tolerance: a rigid motion takes
/// what is left of it.
template <int Dim> void NodalMass<Dim>::keepMomentum(const Side& side, const Eigen::VectorXd* C) const
{
	Eigen::Map<const Eigen::Array<int, Dim, Eigen::Dynamic>> numbers(side.dofs.number.data(), Dim, rows_.nodes());
	Eigen::Array<bool, Dim, Eigen::Dynamic>                  areFree = numbers >= 0;
	for (std::size_t t = 0; side.dofs.affineConstraints && t < side.dofs.affineConstraints->node.size(); ++t)
		areFree.col(side.dofs.affineConstraints->node[t]) = true;
	const Eigen::Array<bool, Dim, 1> isFree = areFree.rowwise().all();
	if (!isFree.any()) return;
	const Eigen::VectorXd        left = rest(side, C);
	Eigen::Array<double, Dim, 1> mass = Eigen::Array<double, Dim, 1>::Constant(std::accumulate(lumped_.begin(), lumped_.end(), 0.));
	if (C) mass += C->reshaped(Dim, rows_.nodes()).rowwise().sum().array();
	const Eigen::Array<double, Dim, 1> change = isFree.select(left.reshaped(Dim, rows_.nodes()).rowwise().sum().array() / mass, 0.);
	side.x.reshaped(Dim, rows_.nodes()).colwise() += change.matrix();
}

template <int Dim> bool NodalMass<Dim>::solve(const std::vector<Side>& sides, Effort effort, const Eigen::VectorXd* C)
{
	if (isLumped()) return std::all_of(sides.begin(), sides.end(), [&](const Side& side) { return guess(side, C); });
	const int           nodes = rows_.nodes();
	Eigen::VectorXd     scale = Eigen::VectorXd::Zero(Dim * nodes * Eigen::Index(sides.size())), left = scale, found;
	std::vector<double> sizes;
	for (const Side& side : sides) {
		const Start begun = start(side, C);
		forDofs<Dim>(int(sizes.size()), sides.size(), nodes, [&](int dof, Eigen::Index i) {
			if (side.dofs.number[dof] < 0) return;
			scale[i] = 1 / std::sqrt(rows_.diagonal(dof / Dim) + (C ? (*C)[dof] : 0));
			if (begun.size > 0) left[i] = begun.rest[dof] / begun.size;
		});
		sizes.push_back(begun.size);
	}
	const GaussSeidel A(rows_, scale, Dim * int(sides.size()));
	left              = A.right(left);
	const double size = left.norm();
	if (size <= effort.tolerance) return true;
	ConjugateGradients iteration(A, left, effort.tolerance / size);
	iteration.iterate(effort.atMost);
	iterations_ += iteration.made();
	if (!iteration.take(found).empty()) return false;
	found = A.solution(found);
	for (std::size_t s = 0; s < sides.size(); ++s) {
		forDofs<Dim>(int(s), sides.size(), nodes, [&](int dof, Eigen::Index i) { sides[s].x[dof] += sizes[s] * found[i]; });
		keepMomentum(sides[s], C);
	}
	return true;
}

template class NodalMass<2>;
template class NodalMass<3>;

} // namespace gimpm
