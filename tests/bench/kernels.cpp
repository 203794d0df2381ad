// SPDX-License-Identifier: GPL-2.0-or-later
// Times of the parts of a load step, per point or per unknown, on a slope half way through its failure.
#include "bench/scenes.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/points/point_update.hpp"
#include "law/kinematic_hardening.hpp"
#include <benchmark/benchmark.h>
#include <malloc.h>

extern "C" void dgemm_(
        const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*, const double*, const int*, const double*,
        double*, const int*);

namespace gimpm {
namespace {

	/// A slope of which many points have begun to yield and to cross cells, and a load step from there.
	template <int Dim> struct MidRun {
		BenchScene<Dim> scene;
		Load<Dim>       load;
		StepReport      report;
		StepSystem<Dim> system;
		Eigen::VectorXd d, force;
		NodeMatrix<Dim> K;

		explicit MidRun(BenchScene<Dim> s)
		        : scene(halfLoaded(std::move(s)))
		        , load { scene.gravity, 0.6, 0.01 }
		        , system(scene.cloud, scene.model, load, report)
		        , d(Eigen::VectorXd::Zero(system.nodalSize()))
		{
			system.prepare(K);
		}
		static BenchScene<Dim> halfLoaded(BenchScene<Dim> s)
		{
			s.steps = 20;
			while (s.done < 12)
				if (const auto report = s.step(); !report.converged()) throw std::runtime_error(report.cause);
			return s;
		}
		double points() const { return double(scene.cloud.size()); }
		double unknowns() const { return system.dofs.count; }
	};

	template <int Dim> MidRun<Dim>& midRun();
	template <> MidRun<2>&          midRun()
	{
		static MidRun<2> run(slope<2>(0.5, 4));
		return run;
	}
	template <> MidRun<3>& midRun()
	{
		static MidRun<3> run(slope<3>(1, 2, 4));
		return run;
	}

	void perItem(benchmark::State& state, const char* name, double items)
	{
		state.counters[name] = benchmark::Counter(items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
	}

	template <int Dim> void basis(benchmark::State& state)
	{
		auto& run = midRun<Dim>();
		for (auto _ : state)
			benchmark::DoNotOptimize(cloudBasis(run.scene.cloud, run.scene.model.grid, run.scene.model.basis, run.scene.model.boundary));
		perItem(state, "s_per_point", run.points());
	}

	template <int Dim, bool WithStiffness> void evaluate(benchmark::State& state)
	{
		auto& run = midRun<Dim>();
		for (auto _ : state)
			benchmark::DoNotOptimize(run.system.evaluate(run.d, run.force, WithStiffness ? &run.K : nullptr));
		perItem(state, "s_per_point", run.points());
	}

	/// The same with F-bar.
	template <int Dim, bool WithStiffness> void evaluateFBar(benchmark::State& state)
	{
		auto& run   = midRun<Dim>();
		auto  model = run.scene.model;
		model.fBar  = true;
		const StepSystem<Dim> system(run.scene.cloud, model, run.load, run.report);
		for (auto _ : state)
			benchmark::DoNotOptimize(system.evaluate(run.d, run.force, WithStiffness ? &run.K : nullptr));
		perItem(state, "s_per_point", run.points());
	}

	/// Points of one law with random strains, of which most yield.
	struct Flowing {
		static constexpr int             Dim = 2;
		Model<Dim>                       model;
		PointCloud<Dim>                  cloud;
		StepReport                       report;
		std::unique_ptr<StepSystem<Dim>> system;

		explicit Flowing(const Law& law)
		{
			model.materials  = { { law, 2000 } };
			const auto scene = slope<Dim>(0.5, 4);
			model.grid = scene.model.grid, cloud = scene.cloud;
			std::fill(cloud.material.begin(), cloud.material.end(), 0);
			unsigned state = 1;
			for (auto& strain : cloud.elasticStrain)
				for (int k = 0; k < strain.size; ++k)
					strain.c[k] = 6e-3 * ((state = 1664525 * state + 1013904223) / 4294967296. - 0.6);
			system = std::make_unique<StepSystem<Dim>>(cloud, model, Load<Dim>(), report);
		}
	};

	/// A stiffness pass with each law; to be compared with von Mises' law.
	void stiffnessOf(benchmark::State& state, const Law& law)
	{
		const Flowing            points(law);
		NodeMatrix<Flowing::Dim> K;
		Eigen::VectorXd          force;
		points.system->prepare(K);
		const Eigen::VectorXd d = Eigen::VectorXd::Zero(points.system->nodalSize());
		for (auto _ : state)
			benchmark::DoNotOptimize(points.system->evaluate(d, force, &K));
		perItem(state, "s_per_point", double(points.cloud.size()));
	}
	const Law vonMises = VonMises(20e6, 0.3, 15e3), tresca = MohrCoulomb::tresca(20e6, 0.3, 5e3), friction = MohrCoulomb(20e6, 0.3, 5e3, 0.5, 0),
	          camClay = CamClay(5e6, 1.2, 0.1, 0.03, 1e5, 1e5), tensors = KinematicHardening(20e6, 0.3, 15e3, 0);

	template <int Dim> void update(benchmark::State& state)
	{
		auto&  run = midRun<Dim>();
		double sum = 0;
		for (auto _ : state)
			forUpdatedPoints(run.system.basis, run.system.points, run.scene.model.materials, run.d, [&](int p, const PointUpdate<Dim>& u) {
				if (p == 0) sum += u.displacement[0];
			});
		benchmark::DoNotOptimize(sum);
		perItem(state, "s_per_point", run.points());
	}

	/// Bytes that are allocated.
	double heap()
	{
		const auto all = mallinfo2();
		return double(all.uordblks + all.hblkhd);
	}

	/// Repeated solves whose matrices have the same pattern.
	void solveAgain(benchmark::State& state, const LinearProblem& K)
	{
		const Eigen::VectorXd b      = Eigen::VectorXd::Ones(K.size());
		Eigen::VectorXd       x      = b;
		const double          before = heap();
		LinearSolver          solver;
		solver.solve(K, b, x);
		// Memory of the solver: factor, scaled matrix.
		state.counters["bytes_per_unknown"] = (heap() - before) / K.size();
		const double flops                  = solver.analyse(K).flops;
		solver.resetTimes();
		for (auto _ : state)
			solver.solve(K, b, x);
		state.counters["factorise"] = solver.times().factorise / state.iterations();
		state.counters["solve"]     = solver.times().solve / state.iterations();
		state.counters["flops"]     = flops * state.iterations() / solver.times().factorise; // per second
		perItem(state, "s_per_unknown", K.size());
	}

	template <int Dim> void linearSolve(benchmark::State& state)
	{
		auto& run = midRun<Dim>();
		run.system.evaluate(run.d, run.force, &run.K);
		solveAgain(state, reduced(run.K, run.system.dofs));
	}

	/// The same where the matrix is not symmetric: a tenth is missing above the diagonal.
	template <int Dim> void unsymmetricSolve(benchmark::State& state)
	{
		auto& run = midRun<Dim>();
		run.system.evaluate(run.d, run.force, &run.K);
		SymmetricCsc symmetric;
		reduce(run.K, run.system.dofs, symmetric);
		GeneralCsc K = bothTriangles(symmetric);
		for (int c = 0; c < K.size(); ++c)
			for (int e = K.start[c]; K.row[e] < c; ++e)
				K.value[e] *= 0.9;
		solveAgain(state, K);
	}

	template <int Dim> void reduction(benchmark::State& state)
	{
		auto&        run = midRun<Dim>();
		SymmetricCsc K;
		for (auto _ : state)
			reduce(run.K, run.system.dofs, K);
		perItem(state, "s_per_unknown", run.unknowns());
	}

	template <int Dim> void wholeStep(benchmark::State& state)
	{
		auto& run    = midRun<Dim>();
		int   solves = 0;
		for (auto _ : state) {
			auto cloud = run.scene.cloud;
			solves     = loadStep(cloud, run.scene.model, { run.scene.gravity, 0.65, 0.05 }, run.scene.solver).iterations;
		}
		state.counters["solves"] = solves;
		perItem(state, "s_per_point", run.points());
	}

	/// Best speed of the BLAS below the factorisation.
	void dgemm(benchmark::State& state)
	{
		const int             n   = 1000;
		const double          one = 1;
		const Eigen::MatrixXd A   = Eigen::MatrixXd::Random(n, n);
		Eigen::MatrixXd       C   = A;
		for (auto _ : state)
			dgemm_("N", "N", &n, &n, &n, &one, A.data(), &n, A.data(), &n, &one, C.data(), &n);
		benchmark::DoNotOptimize(C.sum());
		// Per second.
		state.counters["flops"] = benchmark::Counter(2. * n * n * n, benchmark::Counter::kIsIterationInvariantRate);
	}

	BENCHMARK(dgemm)->UseRealTime();
	BENCHMARK(basis<2>)->UseRealTime();
	BENCHMARK(evaluate<2, false>)->Name("residual<2>")->UseRealTime();
	BENCHMARK(evaluate<2, true>)->Name("stiffness<2>")->UseRealTime();
	BENCHMARK(evaluateFBar<2, false>)->Name("residualFBar<2>")->UseRealTime();
	BENCHMARK(evaluateFBar<2, true>)->Name("stiffnessFBar<2>")->UseRealTime();
	BENCHMARK_CAPTURE(stiffnessOf, vonMises, vonMises)->UseRealTime();
	BENCHMARK_CAPTURE(stiffnessOf, tresca, tresca)->UseRealTime();
	BENCHMARK_CAPTURE(stiffnessOf, friction, friction)->UseRealTime();
	BENCHMARK_CAPTURE(stiffnessOf, camClay, camClay)->UseRealTime();
	BENCHMARK_CAPTURE(stiffnessOf, tensors, tensors)->UseRealTime();
	BENCHMARK(update<2>)->UseRealTime();
	BENCHMARK(reduction<2>)->UseRealTime();
	BENCHMARK(linearSolve<2>)->UseRealTime();
	BENCHMARK(unsymmetricSolve<2>)->UseRealTime();
	BENCHMARK(wholeStep<2>)->UseRealTime()->Unit(benchmark::kMillisecond);
	BENCHMARK(basis<3>)->UseRealTime();
	BENCHMARK(evaluate<3, false>)->Name("residual<3>")->UseRealTime();
	BENCHMARK(evaluate<3, true>)->Name("stiffness<3>")->UseRealTime();
	BENCHMARK(evaluateFBar<3, false>)->Name("residualFBar<3>")->UseRealTime();
	BENCHMARK(evaluateFBar<3, true>)->Name("stiffnessFBar<3>")->UseRealTime();
	BENCHMARK(update<3>)->UseRealTime();
	BENCHMARK(reduction<3>)->UseRealTime();
	BENCHMARK(linearSolve<3>)->UseRealTime();
	BENCHMARK(unsymmetricSolve<3>)->UseRealTime();
	BENCHMARK(wholeStep<3>)->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace
} // namespace gimpm

BENCHMARK_MAIN();
