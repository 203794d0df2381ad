// SPDX-License-Identifier: GPL-2.0-or-later
// One solve of a step in 3D by several methods: iterations, and seconds to set up and to solve. scripts/bench says of
// what.
//
// usage: solvers cantilever|tilted <cells across> <length / height> <cut> <ghost factor> <Poisson's ratio> <tolerance>
// <method>...
//        solvers slope <cell size> <depth, cells> <load factor> <ghost factor> <Poisson's ratio> <tolerance> <method>...
#include "bench/scenes.hpp"
#include "core/stepping/step_system.hpp"
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace gimpm {
namespace {

	/// Held at x = 0, under its own weight, inclined by an angle. Its upper and rear sides reach into the next
	/// cells by the part `cut` of them; where it is inclined, cells are cut in all ways.
	BenchScene<3> cantilever(int cells, int slenderness, double cut, double angle)
	{
		BenchScene<3> s;
		s.model.boundary = Boundary<3>({ s.wall(0, 0, false, { 0, 1, 2 }) });
		for (int z = 0; z < 2 * cells; ++z)
			for (int y = 0; y < 2 * cells; ++y)
				for (int x = 0; x < 2 * cells * slenderness; ++x) {
					const double along = (x + .5) / 2, up = (y + .5) / 2;
					s.addPoint(
					        Vec<3>(along * std::cos(angle) - up * std::sin(angle), along * std::sin(angle) + up * std::cos(angle) + cut,
					               (z + .5) / 2 + cut),
					        .25, 0);
				}
		return s;
	}

	void print(const StepSystem<3>& system, const NodeMatrix<3>& K, const Eigen::VectorXd& b, const char* name, LinearMethod method, double tolerance)
	{
		const LinearProblem problem(K, system.dofs);
		LinearSolver        solver;
		Eigen::VectorXd     x, product = Eigen::VectorXd::Zero(system.nodalSize());
		const bool          isDirect = method == LinearMethod::direct;
		const bool          isSolved
		        = isDirect ? solver.solve(problem, b, x) != LinearSolver::Status::singular : solver.solveIteratively(problem, b, x, tolerance, method);
		const auto& effort = solver.iterativeEffort();
		const auto& times  = solver.times();
		K.multiplyAdd(problem.overNodes()->expanded(x), product);
		const double error = (b - problem.overNodes()->ofFreeDofs(product)).norm() / b.norm();
		std::printf(
		        "{\"method\": \"%s\", \"unknowns\": %d, \"iterations\": %d, \"hierarchies\": %d, \"setUp\": %.3f, \"solve\": %.3f, \"error\": %.2e, \"failure\": \"%s\", \"solved\": %s}\n",
		        name, problem.size(), effort.iterations, effort.hierarchies, times.analyse + times.factorise, times.solve, error, effort.reason.c_str(),
		        isSolved ? "true" : "false");
		std::fflush(stdout);
	}

	int run(int count, char** words)
	{
		const bool   isSlope = !std::strcmp(words[1], "slope");
		const double first = std::atof(words[2]), third = std::atof(words[4]), load = isSlope ? third : 0;
		auto         scene = isSlope ? slope<3>(first, 2, std::atoi(words[3]))
		                             : cantilever(int(first), std::atoi(words[3]), third, std::strcmp(words[1], "tilted") ? 0 : 0.7);
		const double nu = std::atof(words[6]), tolerance = std::atof(words[7]);
		if (isSlope) scene.model.materials = { { VonMises(1e6, nu, 15e3), 2400 }, { VonMises(1e6, nu, 7.5e3), 2400 } };
		else
			scene.model.materials = { { Hencky(1e9, nu), 2400 } };
		scene.model.ghost.factor = std::atof(words[5]);
		for (double done = 0; done < load - 1e-9; done += 0.1) {
			const auto report = loadStep(scene.cloud, scene.model, { scene.gravity, done + 0.1, 0.1 }, scene.solver);
			if (!report.converged()) return std::fprintf(stderr, "%s\n", report.cause.c_str()), 1;
		}
		StepReport          report;
		const StepSystem<3> system(scene.cloud, scene.model, { scene.gravity, load + 0.1, 0.1 }, report);
		NodeMatrix<3>       K;
		Eigen::VectorXd     force;
		system.prepare(K);
		system.evaluate(Eigen::VectorXd::Zero(system.nodalSize()), force, &K);
		Eigen::VectorXd b(system.dofs.count);
		for (std::size_t i = 0; i < system.dofs.number.size(); ++i)
			if (system.dofs.number[i] >= 0) b[system.dofs.number[i]] = system.external[i] - force[i];
		for (int i = 8; i < count; ++i)
			for (const auto& [name, method] : { std::pair { "auto", LinearMethod::automatic },
			                                    { "direct", LinearMethod::direct },
			                                    { "iterative", LinearMethod::iterative },
			                                    { "amg", LinearMethod::multigrid } })
				if (!std::strcmp(words[i], name)) print(system, K, b, name, method, tolerance);
		return 0;
	}

} // namespace
} // namespace gimpm

int main(int count, char** words)
{
	if (count < 9) return std::fprintf(stderr, "see the first lines of solvers.cpp\n"), 1;
	return gimpm::run(count, words);
}
