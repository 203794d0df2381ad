// SPDX-License-Identifier: GPL-2.0-or-later
// Derivatives by central differences of fourth order, for tests of tangents.
#pragma once
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"

namespace gimpm {

/// Derivative of forces(d), which has the size of d.
template <class Forces> Eigen::MatrixXd derivative(const Forces& forces, const Eigen::VectorXd& d, double step)
{
	Eigen::MatrixXd result(d.size(), d.size());
	for (int i = 0; i < d.size(); ++i) {
		const auto at = [&](double s) -> Eigen::VectorXd { return forces(d + s * step * Eigen::VectorXd::Unit(d.size(), i)); };
		result.col(i) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
	}
	return result;
}

/// The tangent stiffness of a load step at d, and the derivative of its forces there.
template <int Dim> std::pair<Eigen::MatrixXd, Eigen::MatrixXd> tangentAndDerivative(const StepSystem<Dim>& system, const Eigen::VectorXd& d, double step)
{
	NodeMatrix<Dim> K;
	Eigen::VectorXd force;
	system.prepare(K);
	EXPECT_FALSE(system.evaluate(d, force, &K));
	const auto forces = [&](const Eigen::VectorXd& at) {
		system.evaluate(at, force, nullptr);
		return force;
	};
	return { dense(K), derivative(forces, d, step) };
}

/// Relative error of the tangent stiffness of a step at d along a direction, from central differences with a step along
/// it.
template <int Dim> double tangentErrorAlong(const StepSystem<Dim>& system, const Eigen::VectorXd& d, const Eigen::VectorXd& direction, double step)
{
	NodeMatrix<Dim> K;
	Eigen::VectorXd force, above, below, tangent = Eigen::VectorXd::Zero(d.size());
	system.prepare(K);
	EXPECT_FALSE(system.evaluate(d, force, &K));
	K.multiplyAdd(direction, tangent);
	EXPECT_FALSE(system.evaluate(d + step * direction, above, nullptr) || system.evaluate(d - step * direction, below, nullptr));
	return ((above - below) / (2 * step) - tangent).norm() / tangent.norm();
}

/// Derivative of the forces of all fields of a step at x, along a step from there: by the tangent, and from central
/// differences of fourth order.
template <int Dim> std::array<Eigen::VectorXd, 2> coupledDerivatives(const StepSystem<Dim>& system, const Eigen::VectorXd& x, const Eigen::VectorXd& step)
{
	NodeMatrix<Dim> K;
	Couplings       beside;
	Eigen::VectorXd force, tangent = Eigen::VectorXd::Zero(x.size());
	system.prepare(K, &beside);
	EXPECT_EQ(beside.isSymmetric(), system.isSymmetric());
	EXPECT_FALSE(system.evaluate(x, force, &K, nullptr, &beside));
	K.multiplyAdd(step, tangent);
	beside.multiplyAdd(step, tangent);
	const auto at = [&](double s) -> Eigen::VectorXd {
		EXPECT_FALSE(system.evaluate(x + s * step, force, nullptr));
		return force;
	};
	return { tangent, (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / 12 };
}

/// The largest difference between entries, relative to the largest one.
inline double relativeError(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected)
{
	return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

/// Error of the stiffness of the last term of a step, at random displacements, from the derivative of its forces. These
/// must not vanish.
template <int Dim> double tangentErrorOfLastTerm(const StepSystem<Dim>& system, const Grid<Dim>& grid, double step)
{
	Term<Dim>&            term   = *system.terms.back();
	const Eigen::VectorXd d      = Random(3).vector(system.nodalSize(), 0.05);
	const auto            forces = [&](const Eigen::VectorXd& at) {
                Eigen::VectorXd f = Eigen::VectorXd::Zero(at.size());
                EXPECT_FALSE(term.add(at, { f }));
                return f;
	};
	NodeMatrix<Dim> K;
	Eigen::VectorXd f = Eigen::VectorXd::Zero(d.size());
	K.reset(system.basis.nodes, term.isSymmetric(), grid);
	term.mark(K);
	term.add(d, { f, &K });
	EXPECT_GT(f.norm(), 0);
	return relativeError(dense(K), derivative(forces, d, step));
}

/// On the body, of the last term as the step begins.
template <int Dim> Vec<Dim> resultantBefore(const StepSystem<Dim>& system)
{
	Eigen::VectorXd resistance = Eigen::VectorXd::Zero(system.nodalSize());
	system.terms.back()->addBefore(resistance);
	Vec<Dim> sum = Vec<Dim>::Zero();
	for (Eigen::Index n = 0; n < resistance.size(); n += Dim)
		sum -= resistance.template segment<Dim>(n);
	return sum;
}

} // namespace gimpm
