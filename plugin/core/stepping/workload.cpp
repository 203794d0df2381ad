// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/workload.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/outcome.hpp"

namespace gimpm {
namespace {

/// The solve of a step and what it stores.
void addSolve(const LinearProblem& K, LinearMethod method, Workload& w)
{
	constexpr double      longFactorisation = 2e10, flopsPerSecond = 5e9, precise = 1e-3;
	LinearSolver          solver;
	const Eigen::VectorXd b = Eigen::VectorXd::Ones(K.size());
	Eigen::VectorXd       x;
	if (solver.isIterative(method, K)) {
		solver.solveIteratively(K, b, x, precise, method);
		w.iterations = solver.iterativeEffort().iterations;
	} else {
		const auto factor = solver.analyse(K);
		w.factorEntries = factor.entries, w.factorFlops = factor.flops;
		if (w.factorFlops < longFactorisation) solver.solve(K, b, x);
	}
	w.times.linear.analyse   = solver.times().analyse;
	w.times.linear.factorise = w.factorFlops < longFactorisation ? solver.times().factorise : w.factorFlops / flopsPerSecond;
	w.times.linear.solve     = solver.times().solve;
}

} // namespace

template <int Dim> Workload workload(const PointCloud<Dim>& cloud, const Model<Dim>& model)
{
	StepReport            report;
	const StepSystem<Dim> system(cloud, model, Load<Dim>(), report);
	NodeMatrix<Dim>       blocks;
	Couplings             beside;
	Workload              w;
	{
		const Stopwatch watch(report.times.assembly);
		if (!tangent(system, blocks, beside, report)) {
			w.obstacle = report.cause;
			return w;
		}
	}
	const LinearProblem K = [&] {
		const Stopwatch watch(report.times.assembly);
		return LinearProblem(blocks, system.dofs, system.isCoupled() ? &beside : nullptr);
	}();
	w.points         = int(cloud.size());
	w.nodes          = report.nodes;
	w.dofs           = report.dofs;
	w.populatedCells = report.populatedCells;
	w.ghostFaces     = report.ghostFaces;
	w.blockEntries   = double(report.nodes) * NodeMatrix<Dim>::codes * NodeMatrix<Dim>::block;
	w.matrixEntries  = double(K.stored().row.size());
	w.times          = report.times;
	if (w.dofs > 0) addSolve(K, model.newton.linearSolver, w);
	return w;
}

template Workload workload(const PointCloud<2>&, const Model<2>&);
template Workload workload(const PointCloud<3>&, const Model<3>&);

} // namespace gimpm
