// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes for the tests of the core: points, regular blocks of them, held boxes of nodes, random numbers.
#pragma once
#include "core/materials/law.hpp"
#include "core/solvers/condition.hpp"
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/load_step.hpp"
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace gimpm {

constexpr double infinity  = std::numeric_limits<double>::infinity();
constexpr double precision = std::numeric_limits<double>::epsilon();

/// Tests written once for both dimensions: TYPED_TEST_SUITE(Suite, BothDimensions, DimensionName); Dim is
/// TypeParam::value.
using BothDimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
struct DimensionName {
	template <class T> static std::string GetName(int) { return std::to_string(T::value) + "D"; }
};
/// The fixture of suites that need none of their own: template <class Dimension> using Suite =
/// InBothDimensions<Dimension>;
template <class Dimension> class InBothDimensions : public ::testing::Test {
public:
	static constexpr int dim = Dimension::value;
};

/// The same random numbers in every run.
class Random {
public:
	explicit Random(unsigned seed = 1) : engine_(seed) { }

	double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
	int    integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
	template <int Rows, int Cols = 1> Eigen::Matrix<double, Rows, Cols> matrix(double size = 1)
	{
		return Eigen::Matrix<double, Rows, Cols>::NullaryExpr([&]() { return in(-size, size); });
	}
	Eigen::VectorXd vector(int length, double size = 1)
	{
		return Eigen::VectorXd::NullaryExpr(length, [&]() { return in(-size, size); });
	}
	template <int Dim> Mat<Dim> rotation();

private:
	std::mt19937_64 engine_;
};

/// Order of convergence in the last three residuals above round-off; 0 if there are fewer.
inline double convergenceOrder(const std::vector<double>& residuals, double roundOff)
{
	std::size_t n = residuals.size();
	while (n > 0 && residuals[n - 1] < roundOff)
		--n;
	if (n < 3) return 0;
	return std::log(residuals[n - 1] / residuals[n - 2]) / std::log(residuals[n - 2] / residuals[n - 3]);
}

inline Mat<2> planeRotation(double angle) { return (Mat<2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished(); }

/// Rotation by an angle about an axis (Rodrigues).
inline Mat3 rotation(const Vec3& axis, double angle)
{
	const Vec3 n = axis.normalized();
	const Mat3 N = (Mat3() << 0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0).finished();
	return Mat3::Identity() + std::sin(angle) * N + (1 - std::cos(angle)) * N * N;
}

template <> inline Mat<2> Random::rotation<2>() { return planeRotation(in(-3, 3)); }
template <> inline Mat3   Random::rotation<3>() { return gimpm::rotation(matrix<3>(), in(-3, 3)); }

template <int Dim> Index<Dim> cellsOf(int x, int y, int z)
{
	Index<Dim> i;
	i[0] = x, i[1] = y;
	if (Dim == 3) i[Dim - 1] = z;
	return i;
}

/// An undeformed point with a box domain.
template <int Dim> void addPoint(PointCloud<Dim>& cloud, const Vec<Dim>& position, const Vec<Dim>& halfSize, int material = 0)
{
	const std::size_t i = cloud.size();
	cloud.resize(i + 1);
	cloud.position[i] = position;
	cloud.halfSize[i] = cloud.halfSize0[i] = halfSize;
	cloud.volume0[i]                       = (2 * halfSize).prod();
	cloud.defGrad[i].setIdentity();
	cloud.material[i] = material;
}

/// Plastic strains of all points, 0 where no point has one.
template <int Dim> std::vector<double> plasticStrains(const PointCloud<Dim>& cloud)
{
	const std::size_t column = internalVariables.find("plasticStrain");
	const bool        exists = column < cloud.internals.size() && !cloud.internals[column].empty();
	return exists ? cloud.internals[column] : std::vector<double>(cloud.size());
}

/// Calls f(index) for all lowest <= index < lowest + size, x fastest.
template <int Dim, class F> void forIndices(const Index<Dim>& lowest, const Index<Dim>& size, F&& f)
{
	for (int i = 0, count = size.prod(); i < count; ++i) {
		Index<Dim> index = lowest;
		for (int a = 0, rest = i; a < Dim; rest /= size[a], ++a)
			index[a] += rest % size[a];
		f(index);
	}
}

/// perAxis^Dim equally spaced points in each of size cells from the lowest one.
template <int Dim> PointCloud<Dim> block(const Grid<Dim>& grid, const Index<Dim>& size, int perAxis, const Index<Dim>& lowest = Index<Dim>::Zero())
{
	PointCloud<Dim> cloud;
	const double    spacing = grid.cellSize / perAxis;
	forIndices<Dim>(perAxis * lowest, perAxis * size, [&](const Index<Dim>& i) {
		const Vec<Dim> x = grid.origin + spacing * (i.template cast<double>() + Vec<Dim>::Constant(0.5));
		addPoint<Dim>(cloud, x, Vec<Dim>::Constant(spacing / 2));
	});
	return cloud;
}

/// A box of nodes held in the directions named by letters out of "xyz".
template <int Dim>
ConstrainedBox<Dim> held(
        const Grid<Dim>& grid, const Vec<Dim>& min, const Vec<Dim>& max, const std::string& fix, const Vec<Dim>& displacement = Vec<Dim>::Zero())
{
	ConstrainedBox<Dim> box = ConstrainedBox<Dim>::from(grid, min, max);
	for (const char letter : fix)
		box.fixed[letter - 'x'] = true;
	box.displacement = displacement;
	return box;
}

/// All nodes on one side of a plane held along its normal: a wall at x[axis] = place with everything below (or above)
/// it behind it.
template <int Dim> ConstrainedBox<Dim> wallBelow(const Grid<Dim>& grid, int axis, double place)
{
	Vec<Dim> max = Vec<Dim>::Constant(infinity);
	max[axis]    = place;
	return held<Dim>(grid, Vec<Dim>::Constant(-infinity), max, std::string(1, "xyz"[axis]));
}
template <int Dim> ConstrainedBox<Dim> wallAbove(const Grid<Dim>& grid, int axis, double place)
{
	Vec<Dim> min = Vec<Dim>::Constant(-infinity);
	min[axis]    = place;
	return held<Dim>(grid, min, Vec<Dim>::Constant(infinity), std::string(1, "xyz"[axis]));
}

/// Nodes held in all directions, each with its own displacement(position), given as one box a node.
template <int Dim, class Displacement>
void prescribe(std::vector<ConstrainedBox<Dim>>& boxes, const Grid<Dim>& grid, const Index<Dim>& node, Displacement&& displacement)
{
	ConstrainedBox<Dim> box { node, node };
	box.displacement = displacement(grid.nodePosition(node));
	box.fixed.fill(true);
	boxes.push_back(box);
}

/// Prescribes displacement(position) at the nodes on the surface of a box of size cells from node 0 (of which inner
/// nodes stay free).
template <int Dim, class Displacement>
std::vector<ConstrainedBox<Dim>> prescribedSurface(const Grid<Dim>& grid, const Index<Dim>& size, Displacement&& displacement)
{
	std::vector<ConstrainedBox<Dim>> boxes;
	forIndices<Dim>(Index<Dim>::Zero(), size + Index<Dim>::Ones(), [&](const Index<Dim>& node) {
		if ((node.array() == 0).any() || (node.array() == size.array()).any()) prescribe<Dim>(boxes, grid, node, displacement);
	});
	return boxes;
}

inline Eigen::MatrixXd dense(const LinearProblem& K)
{
	Eigen::MatrixXd full = Eigen::MatrixXd::Zero(K.size(), K.size());
	K.forEntries([&](int row, int column, double value) { full(row, column) = value; });
	return full;
}

/// Dense form of a matrix over nodes.
template <int Dim> Eigen::MatrixXd dense(const NodeMatrix<Dim>& K)
{
	Eigen::MatrixXd full(Dim * K.nodes(), Dim * K.nodes());
	for (int i = 0; i < full.cols(); ++i) {
		Eigen::VectorXd column = Eigen::VectorXd::Zero(full.rows());
		K.multiplyAdd(Eigen::VectorXd::Unit(full.cols(), i), column);
		full.col(i) = column;
	}
	return full;
}

/// Positions of the active nodes.
template <int Dim> std::vector<Vec<Dim>> nodePositions(const CloudBasis<Dim>& basis, const Grid<Dim>& grid)
{
	std::vector<Vec<Dim>> x;
	for (const Key node : basis.nodes)
		x.push_back(grid.nodePosition(Grid<Dim>::index(node)));
	return x;
}

/// Nodal vector of a field f(position).
template <int Dim, class Field> Eigen::VectorXd nodal(const CloudBasis<Dim>& basis, const Grid<Dim>& grid, Field&& f)
{
	Eigen::VectorXd d(Dim * basis.nodes.size());
	const auto      x = nodePositions(basis, grid);
	for (std::size_t n = 0; n < x.size(); ++n)
		d.template segment<Dim>(Dim * n) = f(x[n]);
	return d;
}

/// Compaction of a column under its own weight (Coombs 2023, section 4.1): nu = 0, one cell wide on rollers, 2 points
/// per axis and cell. Lengths and stresses may be given other units.
template <int Dim> struct Column {
	double          height, young, weight; // l0 [m], E [Pa], b [N/m3]
	Model<Dim>      model;
	PointCloud<Dim> cloud;
	LinearSolver    solver;

	explicit Column(int cells, GhostSettings ghost = {}, double length = 1, double pressure = 1)
	        : height(50 * length), young(1e4 * pressure), weight(800 * pressure / length)
	{
		const double h         = height / cells;
		model.grid.cellSize    = h;
		model.materials        = { { Hencky(young, 0), weight / 10 } };
		model.ghost            = ghost;
		model.newton.tolerance = 1e-9;
		std::vector<ConstrainedBox<Dim>> walls { wallBelow<Dim>(model.grid, 1, 0) };
		for (int axis = 0; axis < Dim; ++axis)
			if (axis != 1) walls.push_back(wallBelow<Dim>(model.grid, axis, 0)), walls.push_back(wallAbove<Dim>(model.grid, axis, h));
		model.boundary = Boundary<Dim>(walls);
		cloud          = block<Dim>(model.grid, cellsOf<Dim>(1, cells, 1), 2);
	}
	/// Step number `step` of `steps`.
	StepReport step(int step, int steps)
	{
		Load<Dim> load;
		load.gravity       = -10 * Vec<Dim>::Unit(1);
		load.factor.value  = double(step) / steps;
		load.factor.growth = 1. / steps;
		return loadStep(cloud, model, load, solver);
	}
	/// Error of eq. (7), from the points' original heights.
	double error(const std::vector<Vec<Dim>>& original) const
	{
		double sum = 0, volume = 0;
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			sum += std::abs(cloud.stress[p].c[1] + weight * (height - original[p][1])) * cloud.volume0[p];
			volume += cloud.volume0[p];
		}
		return sum / (weight * height * volume);
	}
};

} // namespace gimpm
