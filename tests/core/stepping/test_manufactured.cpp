// SPDX-License-Identifier: GPL-2.0-or-later
// Manufactured solutions in finite strain: for a chosen motion x = X + u(X) of a Hencky body the forces that hold it
// are -Div P(X) per initial volume, given to the points as point loads; the error must fall with the cell size as
// theory says.
#include "scenes.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <complex>
#include <cstdio>

namespace gimpm::testManufactured {
namespace {

	constexpr double pi = 3.14159265358979323846, young = 1e6, poisson = 0.3;

	/// Motion of the unit square or cube in a smooth box: no normal displacement and no shear on its faces.
	struct Enclosed {
		static constexpr bool                                       freeTop = false;
		template <class T, int Dim> static Eigen::Matrix<T, Dim, 1> displacement(const Eigen::Matrix<T, Dim, 1>& X)
		{
			const double             amplitude[] = { 0.05, -0.03, 0.04 };
			Eigen::Matrix<T, Dim, 1> u;
			for (int i = 0; i < Dim; ++i) {
				u[i] = amplitude[i] * sin(pi * X[i]);
				for (int j = 0; j < Dim; ++j)
					if (j != i) u[i] *= cos(pi * X[j]);
			}
			return u;
		}
	};

	/// The same with a top (y = 1) that is free: there all derivatives vanish, and with them the stress.
	struct FreeTop {
		static constexpr bool                                       freeTop = true;
		template <class T, int Dim> static Eigen::Matrix<T, Dim, 1> displacement(const Eigen::Matrix<T, Dim, 1>& X)
		{
			const double             amplitude[] = { 0.05, -0.04, 0.03 };
			Eigen::Matrix<T, Dim, 1> u;
			for (int i = 0; i < Dim; ++i) {
				const T vertical = i == 1 ? sin(pi * X[1]) : cos(pi / 2 * X[1]);
				u[i]             = amplitude[i] * vertical * vertical;
				for (int j = 0; j < Dim; ++j)
					if (j != 1) u[i] *= j == i ? sin(pi * X[j]) : cos(pi * X[j]);
			}
			return u;
		}
	};

	/// Deformation gradient by the complex step.
	template <class Motion, int Dim> Mat3 deformationGradient(const Vec<Dim>& X)
	{
		Mat3         F    = Mat3::Identity();
		const double step = 1e-30;
		for (int j = 0; j < Dim; ++j) {
			Eigen::Matrix<std::complex<double>, Dim, 1> Z = X.template cast<std::complex<double>>();
			Z[j] += std::complex<double>(0, step);
			const auto u = Motion::template displacement<std::complex<double>, Dim>(Z);
			for (int i = 0; i < Dim; ++i)
				F(i, j) += u[i].imag() / step;
		}
		return F;
	}

	/// Kirchhoff stress of Hencky's law.
	Mat3 kirchhoff(const Mat3& F)
	{
		const Eigen::SelfAdjointEigenSolver<Mat3> eigen(F * F.transpose());
		const Vec3                                e = 0.5 * eigen.eigenvalues().array().log();
		const double                              G = young / (2 * (1 + poisson)), lambda = 2 * G * poisson / (1 - 2 * poisson);
		const Vec3                                t = 2 * G * e + Vec3::Constant(lambda * e.sum());
		return eigen.eigenvectors() * t.asDiagonal() * eigen.eigenvectors().transpose();
	}

	/// -Div P with P = tau F^-T, by sixth-order differences.
	template <class Motion, int Dim> Vec<Dim> bodyForce(const Vec<Dim>& X)
	{
		const double step = 2e-3;
		Vec<Dim>     b    = Vec<Dim>::Zero();
		for (int j = 0; j < Dim; ++j) {
			const auto column = [&](int n) {
				const Mat3 F = deformationGradient<Motion, Dim>(X + n * step * Vec<Dim>::Unit(j));
				return Vec3((kirchhoff(F) * F.inverse().transpose()).col(j));
			};
			b -= ((45 * (column(1) - column(-1)) - 9 * (column(2) - column(-2)) + (column(3) - column(-3))) / (60 * step)).template head<Dim>();
		}
		return b;
	}

	struct Errors {
		double displacement = 0, stress = 0; // root mean squares over the volume, relative to 0.05 and E
	};

	template <class Motion, int Dim> Errors errors(int cells, int steps, GhostSettings ghost = {})
	{
		Model<Dim> model;
		model.grid.cellSize    = 1. / cells;
		model.materials        = { { Hencky(young, poisson), 1 } };
		model.ghost            = ghost;
		model.newton.tolerance = 1e-10;
		std::vector<ConstrainedBox<Dim>> walls;
		for (int axis = 0; axis < Dim; ++axis) {
			walls.push_back(wallBelow<Dim>(model.grid, axis, 0));
			if (!(Motion::freeTop && axis == 1)) walls.push_back(wallAbove<Dim>(model.grid, axis, 1));
		}
		model.boundary   = Boundary<Dim>(walls);
		auto       cloud = block<Dim>(model.grid, Index<Dim>::Constant(cells), 2);
		const auto start = cloud.position;
		for (std::size_t p = 0; p < start.size(); ++p)
			cloud.force.push_back(cloud.volume0[p] * bodyForce<Motion, Dim>(start[p]));
		LinearSolver solver;
		for (int i = 1; i <= steps; ++i) {
			Load<Dim> load;
			load.factor.value = double(i) / steps;
			const auto report = loadStep(cloud, model, load, solver);
			EXPECT_TRUE(report.converged()) << report.cause;
		}
		Errors e;
		for (std::size_t p = 0; p < start.size(); ++p) {
			const Mat3     F = deformationGradient<Motion, Dim>(start[p]);
			const Vec<Dim> u = Motion::template displacement<double, Dim>(start[p]);
			e.displacement += cloud.volume0[p] * (cloud.position[p] - start[p] - u).squaredNorm();
			e.stress += cloud.volume0[p] * (cloud.stress[p].full() - kirchhoff(F) / F.determinant()).squaredNorm();
		}
		return { std::sqrt(e.displacement) / 0.05, std::sqrt(e.stress) / young };
	}

	/// Prints errors of grids of increasing fineness and returns the last observed orders.
	template <class Motion, int Dim> Errors orders(const std::vector<int>& cells, int steps, GhostSettings ghost = {})
	{
		Errors order, previous;
		for (std::size_t i = 0; i < cells.size(); ++i) {
			const Errors e = errors<Motion, Dim>(cells[i], steps, ghost);
			if (i > 0) {
				const double ratio = std::log(double(cells[i]) / cells[i - 1]);
				order              = { std::log(previous.displacement / e.displacement) / ratio, std::log(previous.stress / e.stress) / ratio };
			}
			std::printf(
			        "%dD, %d steps, %2d cells: displacement %.3e (order %.2f), stress %.3e (order %.2f)\n", Dim, steps, cells[i], e.displacement,
			        order.displacement, e.stress, order.stress);
			previous = e;
		}
		return order;
	}

	// In one step from a regular filling the domains tile the body and each lies in one cell: bilinear elements
	// with one stress for each domain. Displacements are of second order; stresses, of the elements' gradients away
	// from their centres, of first.
	void expectOrdersOfElements(const Errors& order)
	{
		EXPECT_NEAR(order.displacement, 2, 0.1);
		EXPECT_NEAR(order.stress, 1, 0.1);
	}

	TEST(ManufacturedSolution, EnclosedBodyInOneStep)
	{
		expectOrdersOfElements(orders<Enclosed, 2>({ 8, 16, 32 }, 1));
		expectOrdersOfElements(orders<Enclosed, 3>({ 6, 12 }, 1));
	}

	TEST(ManufacturedSolution, BodyWithAFreeSurfaceInOneStep)
	{
		expectOrdersOfElements(orders<FreeTop, 2>({ 8, 16, 32 }, 1));
		expectOrdersOfElements(orders<FreeTop, 3>({ 6, 12 }, 1));
	}

	// In several steps the points leave their places in the cells and most domains reach several of them: the basis
	// functions are smoother, so stresses gain, up to one order; displacements keep their second order, which is
	// approached from above.
	void expectOrdersOfMovedPoints(const Errors& order)
	{
		EXPECT_GT(order.displacement, 1.9);
		EXPECT_LT(order.displacement, 3);
		EXPECT_GT(order.stress, 0.95);
		EXPECT_LT(order.stress, 2.1);
	}

	TEST(ManufacturedSolution, EnclosedBodyInSeveralSteps)
	{
		expectOrdersOfMovedPoints(orders<Enclosed, 2>({ 8, 16, 32 }, 4));
		expectOrdersOfMovedPoints(orders<Enclosed, 3>({ 4, 8 }, 2));
	}

	TEST(ManufacturedSolution, BodyWithAFreeSurfaceInSeveralSteps)
	{
		expectOrdersOfMovedPoints(orders<FreeTop, 2>({ 8, 16, 32 }, 4));
		expectOrdersOfMovedPoints(orders<FreeTop, 3>({ 4, 8 }, 2));
	}

	TEST(ManufacturedSolution, StrongGhostStabilisationKeepsTheOrders) { expectOrdersOfMovedPoints(orders<FreeTop, 2>({ 8, 16, 32 }, 4, { 1 })); }

} // namespace
} // namespace gimpm::testManufactured
