// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/workload.hpp"
#include "core/step_system.hpp"
#include "core/stopwatch.hpp"

namespace gimpm {

template <int Dim> Workload workload(const PointCloud<Dim>& cloud, const Model<Dim>& model)
{
	constexpr double     longFactorisation = 2e10, flopsPerSecond = 5e9;
	StepReport           report;
	const StepSystem<Dim> system(cloud, model, Load<Dim>(), report);
	NodeMatrix<Dim>      K;
	Eigen::VectorXd      force, x;
	SymmetricCsc         reduced;
	{
		const Stopwatch watch(report.times.assembly);
		system.prepare(K);
		system.evaluate(Eigen::VectorXd::Zero(system.nodalSize()), force, &K);
		reduce(K, system.dofs, reduced);
	}
	Workload w { int(cloud.size()), report.nodes, report.dofs, report.populatedCells, report.ghostFaces };
	w.blockEntries  = double(report.nodes) * NodeMatrix<Dim>::codes * NodeMatrix<Dim>::block;
	w.matrixEntries = double(reduced.row.size());
	LinearSolver solver;
	if (w.dofs > 0) {
		const auto factor = solver.analyse(reduced);
		w.factorEntries = factor.entries, w.factorFlops = factor.flops;
		if (w.factorFlops < longFactorisation) solver.solve(reduced, Eigen::VectorXd::Ones(w.dofs), x);
	}
	w.times        = report.times;
	w.times.linear = solver.times();
	if (w.factorFlops >= longFactorisation) w.times.linear.factorise = w.factorFlops / flopsPerSecond;
	return w;
}

template Workload workload(const PointCloud<2>&, const Model<2>&);
template Workload workload(const PointCloud<3>&, const Model<3>&);

} // namespace gimpm
