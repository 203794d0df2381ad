// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/nodal_mass.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/solvers/conjugate_gradients.hpp"

namespace gimpm {
namespace {

/// Of the right side. Momentum is as exact.
constexpr double tolerance = 1e-13;

/// Of loose cells. What their points do not see has stiffness all the same, where a displacement vanishes and its gradient does not: with less mass it would not be stable.
constexpr double lumpedShare = 1;

constexpr int worthwhileInThreads = 4000; ///< nodes: some 50 us

template <int Dim> std::vector<double> lumped(const CloudBasis<Dim>& basis, const std::vector<double>& masses)
{
	std::vector<double> sum(basis.nodes.size(), 0);
	forPointNodes(basis, [&](int p, const Patch<Dim>& patch, const double* value, int count) {
		for (int n = 0; n < count; ++n)
			if (patch.node[n] >= 0) sum[patch.node[n]] += masses[basis.order[p]] * value[n];
	});
	return sum;
}

} // namespace

/// Rows and columns of held degrees of freedom are those of the identity; vectors are zero there.
template <int Dim> class NodalMass<Dim>::Restricted : public SymmetricOperator {
public:
	Restricted(const NodalMass& mass, const FreeDofs& dofs, const Eigen::VectorXd* C) : mass_(mass), dofs_(dofs), C_(C) { }

	void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override
	{
		y.resize(x.size());
		mass_.multiply(x.data(), y.data());
		if (C_) y += C_->cwiseProduct(x);
		for (Eigen::Index i = 0; i < y.size(); ++i)
			if (dofs_.number[i] < 0) y[i] = 0;
	}
	Eigen::VectorXd diagonal() const override
	{
		Eigen::VectorXd d(dofs_.number.size());
		for (Eigen::Index i = 0; i < d.size(); ++i)
			d[i] = dofs_.number[i] < 0 ? 1 : mass_.value_[mass_.first_[i / Dim]] + (C_ ? (*C_)[i] : 0);
		return d;
	}

private:
	const NodalMass&       mass_;
	const FreeDofs&        dofs_;
	const Eigen::VectorXd* C_;
};

template <int Dim>
NodalMass<Dim>::NodalMass(
        const CloudBasis<Dim>& basis, const std::vector<double>& masses, const std::vector<GhostFace<Dim>>& faces, double h,
        const std::vector<LooseCell<Dim>>& loose)
{
	if (faces.empty()) value_ = lumped(basis, masses);
	else
		compress(MassMatrix<Dim>(basis, masses, faces, h, loose, lumpedShare));
}

/// Whole rows, of each node its own number first.
template <int Dim> void NodalMass<Dim>::compress(const MassMatrix<Dim>& mass)
{
	first_.assign(mass.nodes() + 1, 0);
	const auto forBoth = [&](auto&& f) {
		mass.forEntries([&](int a, int b, int, double m) {
			f(a, b, m);
			if (b != a) f(b, a, m);
		});
	};
	forBoth([&](int a, int, double) { ++first_[a + 1]; });
	for (int a = 0; a < mass.nodes(); ++a)
		first_[a + 1] += first_[a];
	std::vector<int> next(first_.begin(), first_.end() - 1);
	for (int& place : next)
		++place;
	value_.assign(first_.back(), 0);
	neighbour_.resize(first_.back());
	forBoth([&](int a, int b, double m) {
		const int place   = a == b ? first_[a] : next[a]++;
		neighbour_[place] = b;
		value_[place] += m;
	});
}

template <int Dim> void NodalMass<Dim>::multiply(const double* x, double* y) const
{
	const int nodes = int(first_.size()) - 1;
#pragma omp parallel for schedule(static) if (nodes > worthwhileInThreads)
	for (int a = 0; a < nodes; ++a) {
		double sum[Dim] = {};
		for (int e = first_[a]; e < first_[a + 1]; ++e)
			for (int i = 0; i < Dim; ++i)
				sum[i] += value_[e] * x[Dim * neighbour_[e] + i];
		for (int i = 0; i < Dim; ++i)
			y[Dim * a + i] = sum[i];
	}
}

template <int Dim> Eigen::VectorXd NodalMass<Dim>::operator*(const Eigen::VectorXd& x) const
{
	Eigen::VectorXd y(x.size());
	if (!isLumped()) multiply(x.data(), y.data());
	else
		for (Eigen::Index i = 0; i < x.size(); ++i)
			y[i] = value_[i / Dim] * x[i];
	return y;
}

template <int Dim> bool NodalMass<Dim>::solve(const Eigen::VectorXd& right, const FreeDofs& dofs, Eigen::VectorXd& x, const Eigen::VectorXd* C)
{
	if (isLumped()) {
		for (Eigen::Index i = 0; i < x.size(); ++i)
			if (dofs.number[i] >= 0) x[i] = right[i] / (value_[i / Dim] + (C ? (*C)[i] : 0));
		return x.allFinite();
	}
	for (Eigen::Index i = 0; i < x.size(); ++i)
		if (dofs.number[i] >= 0) x[i] = 0;
	Eigen::VectorXd rest = right, free;
	if (!x.isZero(0)) rest -= *this * x;
	for (Eigen::Index i = 0; i < x.size(); ++i)
		if (dofs.number[i] < 0) rest[i] = 0;
	const Restricted   M(*this, dofs, C);
	ConjugateGradients iteration(M, rest, tolerance);
	iteration.iterate(mostIterations);
	iterations_ += iteration.made();
	if (!iteration.take(free).empty()) return false;
	x += free;
	return true;
}

template class NodalMass<2>;
template class NodalMass<3>;

} // namespace gimpm
