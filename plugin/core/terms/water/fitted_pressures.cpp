// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/water/fitted_pressures.hpp"
#include "core/grid/cells_around.hpp"
#include "core/terms/water/flow_point.hpp"
#include <Eigen/Eigenvalues>
#include <optional>

namespace gimpm {
namespace {

/// Weighted sums about a node, of 1 and the distances along the axes over the size of a cell.
template <int Dim> struct Moments {
	using Vector = Eigen::Matrix<double, Dim + 1, 1>;
	using Matrix = Eigen::Matrix<double, Dim + 1, Dim + 1>;

	Matrix of        = Matrix::Zero();
	Vector pressures = Vector::Zero();

	void add(double weight, const Vec<Dim>& away, double pressure)
	{
		Vector x;
		x << 1, away;
		of += weight * x * x.transpose(), pressures += weight * pressure * x;
	}
	/// The same sums about a node that is `offset` cells farther along the axes, or a part of them.
	void addMoved(const Moments& other, const Vec<Dim>& offset, double part = 1)
	{
		Matrix move                              = Matrix::Identity();
		move.template bottomLeftCorner<Dim, 1>() = offset;
		of += part * move * other.of * move.transpose(), pressures += part * move * other.pressures;
	}
	/// `size`: of the cells around the node, in the smallest ones.
	std::optional<double> atNode(double size) const
	{
		constexpr double least = 1e-4; // of the eigenvalues, below which points are as good as on a line
		Vector           unit  = Vector::Constant(1 / size);
		unit[0]                = 1;
		const Eigen::SelfAdjointEigenSolver<Matrix> axes(unit.asDiagonal() * of * unit.asDiagonal());
		const Vector&                               found = axes.eigenvalues();
		if (!(found[0] > least * found[Dim])) return std::nullopt;
		return (axes.eigenvectors() * (axes.eigenvectors().transpose() * unit.cwiseProduct(pressures)).cwiseQuotient(found))[0];
	}
	double mean() const { return of(0, 0) > 0 ? pressures[0] / of(0, 0) : 0; }
};

/// Gives the sums about tied nodes to their masters.
template <int Dim> void condense(const CloudBasis<Dim>& basis, std::vector<Moments<Dim>>& around)
{
	const auto& ties = basis.affineConstraints;
	for (std::size_t t = 0; t < ties.node.size(); ++t)
		for (int m = ties.start[t]; m < ties.start[t + 1]; ++m) {
			const Index<Dim> offset = Grid<Dim>::index(basis.nodes[ties.node[t]]) - Grid<Dim>::index(basis.nodes[ties.master[m]]);
			around[ties.master[m]].addMoved(around[ties.node[t]], offset.template cast<double>(), ties.weight[m]);
		}
}

} // namespace

template <int Dim>
Eigen::VectorXd fittedPressures(const CloudBasis<Dim>& basis, const PointCloud<Dim>& cloud, const Grid<Dim>& grid, const std::vector<double>& pressure)
{
	std::vector<Moments<Dim>> around(basis.nodes.size());
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const PointFunctions<Dim> f(basis, i, patch);
			const int                 p = basis.order[i];
			for (int n = 0; n < f.count; ++n) {
				if (patch.node[n] < 0) continue;
				const Index<Dim> node = Grid<Dim>::index(basis.nodes[patch.node[n]]);
				Vec<Dim>         away;
				for (int a = 0; a < Dim; ++a)
					away[a] = (grid.imageNear(cloud.position[p][a], node[a], a) - grid.nodePosition(node)[a]) / grid.cellSize;
				around[patch.node[n]].add(f.value[n] * cloud.volume0[p] * cloud.volumeRatio(p), away, pressure[p]);
			}
		}
	condense(basis, around);
	Eigen::VectorXd fitted(Eigen::Index(basis.nodes.size()));
	for (std::size_t n = 0; n < basis.nodes.size(); ++n) {
		const int level = Grid<Dim>::level(basis.nodes[n]), layer = Grid<Dim>::layer(basis.nodes[n]);
		auto      value = around[n].atNode(1 << level);
		if (!value) {
			Moments<Dim> more;
			for (int number = 0; number < cellsAround<Dim>; ++number) {
				const Index<Dim> offset = offsetAround<Dim>(number) * (1 << level);
				const Index<Dim> there  = grid.first(Grid<Dim>::index(basis.nodes[n]) + offset);
				const int        other  = gimpm::find(basis.nodes, Grid<Dim>::key(there, level, layer));
				if (other >= 0) more.addMoved(around[other], offset.template cast<double>());
			}
			value = more.atNode(1 << level).value_or(around[n].mean());
		}
		fitted[n] = *value;
	}
	return fitted;
}

template Eigen::VectorXd fittedPressures(const CloudBasis<2>&, const PointCloud<2>&, const Grid<2>&, const std::vector<double>&);
template Eigen::VectorXd fittedPressures(const CloudBasis<3>&, const PointCloud<3>&, const Grid<3>&, const std::vector<double>&);

} // namespace gimpm
