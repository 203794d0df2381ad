// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/nonlocal.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/materials/internal_variables.hpp"
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace gimpm {
namespace {

constexpr double overlocal = 2, exactness = 1e-10;

/// The points of some of the materials, with their volumes, and the functions of the grid at them.
template <int Dim> struct Average {
	const CloudBasis<Dim>&      basis;
	const std::vector<char>&    isMeant; ///< flag by material
	const PointCloud<Dim>&      cloud;
	std::vector<int>            number; ///< number of each node around these points; -1: others
	Eigen::SparseMatrix<double> matrix;
	int                         nodes = 0;

	Average(const CloudBasis<Dim>& all, const PointCloud<Dim>& points, const std::vector<char>& meant, double length)
	        : basis(all), isMeant(meant), cloud(points), number(all.nodes.size(), -1)
	{
		forMeant([&](int, const Patch<Dim>& patch, const double*, int count, double) {
			for (int n = 0; n < count; ++n)
				if (patch.node[n] >= 0) number[patch.node[n]] = 0;
		});
		for (int& node : number)
			if (node == 0) node = nodes++;
		assemble(length);
	}

	/// f(point of the basis, its patch, values at the nodes, their number, volume).
	template <class F> void forMeant(F&& f) const
	{
		forPointNodes(basis, 0, int(basis.patches.size()), [&](int p, const Patch<Dim>& patch, const double* value, int count) {
			const int i = basis.order[p];
			if (isMeant[cloud.material[i]]) f(p, patch, value, count, cloud.volume0[i] * cloud.volumeRatio(i));
		});
	}

	/// Mean of values (one for each point of the cloud), at those points.
	void apply(const std::vector<double>& own, std::vector<double>& mean) const
	{
		Eigen::VectorXd right = Eigen::VectorXd::Zero(nodes);
		forMeant([&](int p, const Patch<Dim>& patch, const double* value, int count, double volume) {
			for (int n = 0; n < count; ++n)
				if (patch.node[n] >= 0) right[number[patch.node[n]]] += volume * value[n] * own[basis.order[p]];
		});
		Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
		solver.setTolerance(exactness);
		const Eigen::VectorXd nodal = solver.solve(right);
		forMeant([&](int p, const Patch<Dim>& patch, const double* value, int count, double) {
			double sum = 0, whole = 0; // functions beyond walls have no values
			for (int n = 0; n < count; ++n)
				if (patch.node[n] >= 0) sum += value[n] * nodal[number[patch.node[n]]], whole += value[n];
			mean[basis.order[p]] = sum / whole;
		});
	}

private:
	/// Integrals of N_a N_b + l^2 grad N_a . grad N_b over the points.
	void assemble(double length)
	{
		std::vector<Eigen::Triplet<double>> entries;
		forMeant([&](int p, const Patch<Dim>& patch, const double* value, int count, double volume) {
			std::array<Vec<Dim>, windowNodes<Dim>> gradient;
			for (int n = 0; n < count; ++n)
				gradient[n] = gradientAt(p, patch, n);
			for (int a = 0; a < count; ++a)
				for (int b = 0; b < count; ++b)
					if (patch.node[a] >= 0 && patch.node[b] >= 0)
						entries.emplace_back(
						        number[patch.node[a]], number[patch.node[b]],
						        volume * (value[a] * value[b] + length * length * gradient[a].dot(gradient[b])));
		});
		matrix.resize(nodes, nodes);
		matrix.setFromTriplets(entries.begin(), entries.end());
	}
	Vec<Dim> gradientAt(int p, const Patch<Dim>& patch, int n) const
	{
		std::array<int, Dim> at;
		for (int a = 0, rest = n; a < Dim; rest /= patch.nodesAlong(a), ++a)
			at[a] = rest % patch.nodesAlong(a);
		Vec<Dim> gradient = Vec<Dim>::Ones();
		for (int i = 0; i < Dim; ++i)
			for (int a = 0; a < Dim; ++a)
				gradient[i] *= a == i ? basis.axes[p][a].gradient[at[a]] : basis.axes[p][a].value[at[a]];
		return gradient;
	}
};

} // namespace

template <int Dim> void averageSoftening(PointCloud<Dim>& cloud, const Model<Dim>& model, double length)
{
	const int softening = internalVariables.find("softening"), plastic = internalVariables.find(equivalentPlasticStrain.name);
	if (softening < 0 || std::size_t(softening) >= cloud.internals.size() || cloud.internals[softening].empty()) return;
	const auto                 basis = cloudBasis(cloud, model.grid, model.basis, model.boundary);
	const std::vector<double>& own   = cloud.internals[plastic];
	std::vector<double>        mean(cloud.size(), 0);
	for (std::size_t m = 0; m < model.materials.size(); ++m) {
		const auto& columns = model.materials[m].law->columns;
		if (std::find(columns.begin(), columns.end(), softening) == columns.end()) continue;
		std::vector<char> isMeant(model.materials.size(), 0);
		isMeant[m] = 1;
		if (std::find(cloud.material.begin(), cloud.material.end(), int(m)) == cloud.material.end()) continue;
		Average<Dim>(basis, cloud, isMeant, length).apply(own, mean);
		for (std::size_t p = 0; p < cloud.size(); ++p)
			if (cloud.material[p] == int(m)) cloud.internals[softening][p] = overlocal * mean[p] + (1 - overlocal) * own[p];
	}
}

template void averageSoftening(PointCloud<2>&, const Model<2>&, double);
template void averageSoftening(PointCloud<3>&, const Model<3>&, double);

} // namespace gimpm
