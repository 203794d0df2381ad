// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/study.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/condition.hpp"
#include "core/stepping/load_step.hpp"
#include "core/stepping/strength_reduction.hpp"
#include "core/stepping/workload.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"
#include "engine/engines/Threads.hpp"
#include "engine/engines/build_model.hpp"
#include "engine/materials/laws.hpp"
#include "engine/messages/first_step.hpp"
#include "yade_api/value_lock.hpp"

namespace yade {

namespace {
	template <class T> py::object numpyArray(const vector<T>& values, const char* type)
	{
		const char* bytes = reinterpret_cast<const char*>(values.data());
		py::object  copy { py::handle<>(PyByteArray_FromStringAndSize(bytes, values.size() * sizeof(T))) };
		return py::import("numpy").attr("frombuffer")(copy, type);
	}

	void requireUndivided(const MpmImplicitEngine& engine)
	{
		if (isDivided(engine))
			throw std::invalid_argument(
			        engine.getClassName()
			        + ": studies of the stiffness or the strength need all points in one process, and with distributed = True each has its own.");
	}

	// f(cloud, model, load) with the points, settings and loads of now
	template <class F> auto onCurrentState(MpmImplicitEngine& engine, F f)
	{
		requireUndivided(engine);
		const Threads threads(engine.ompThreads);
		const auto    inSpace = [&](auto dim) {
                        constexpr int     Dim = decltype(dim)::value;
                        CurrentState<Dim> now;
                        {
                                const ValueLock lock;
                                now = currentState<Dim>(engine);
                        }
                        const PythonUnlock python;
                        return f(now.cloud, now.model, now.load);
		};
		return engine.grid && engine.grid->dim == 3 ? inSpace(std::integral_constant<int, 3>()) : inSpace(std::integral_constant<int, 2>());
	}

	void requireUnobstructed(const MpmImplicitEngine& engine, const string& obstacle)
	{
		if (!obstacle.empty())
			throw std::invalid_argument(engine.getClassName() + ": a load step from the current state would fail: " + obstacle + ".");
	}

	gimpm::LinearProblem reducedStiffness(MpmImplicitEngine& engine)
	{
		gimpm::StepReport report;
		auto              K = onCurrentState(
		                     engine, [&](const auto& cloud, const auto& model, const auto&) { return gimpm::tangentStiffness(cloud, model, &report); });
		requireUnobstructed(engine, report.cause);
		return K;
	}

	py::tuple stiffness(MpmImplicitEngine& engine)
	{
		const auto      K = reducedStiffness(engine);
		vector<int64_t> rows, columns;
		vector<Real>    values;
		K.forEntries([&](int row, int column, Real value) {
			rows.push_back(row);
			columns.push_back(column);
			values.push_back(value);
		});
		return py::make_tuple(numpyArray(rows, "int64"), numpyArray(columns, "int64"), numpyArray(values, "float64"), K.size());
	}

	Real conditionNumber(MpmImplicitEngine& engine)
	{
		constexpr int largest = 4000;
		const auto    K       = reducedStiffness(engine);
		if (K.size() > 0 && K.size() <= largest) return gimpm::conditionNumber(K);
		throw std::invalid_argument(
		        engine.getClassName() + ".conditionNumber() needs all eigenvalues: the scene has " + std::to_string(K.size())
		        + " unknowns, admitted are 1 to " + std::to_string(largest) + ".");
	}

	Real conditionEstimate(MpmImplicitEngine& engine)
	{
		const auto K = reducedStiffness(engine);
		if (K.size() == 0) throw std::invalid_argument(engine.getClassName() + ".conditionEstimate(): the scene has no unknowns.");
		return gimpm::conditionEstimate(K);
	}

	// Refuses points without a strength that could be divided, and says why.
	void requireStrength(const vector<MaterialPoint>& points)
	{
		bool hasStrength = false;
		for (const MaterialPoint& p : points) {
			const bool   carriesAll = isElastic(*p.material);
			const string body       = "Body #" + std::to_string(p.id) + " is of " + p.material->getClassName();
			if (const char* time = p.material->timeAttribute())
				throw std::invalid_argument(
				        body + " with " + time + ": its strength depends on the seconds a load takes, which a strengthReduction has none of.");
			if (!carriesAll && !canBeWeakened(*p.material))
				throw std::invalid_argument(
				        body + ", the strength of which follows from what its points remember: there is no single one that could be divided.");
			hasStrength = hasStrength || !carriesAll;
		}
		if (!hasStrength) throw std::invalid_argument("all materials are elastic (MpmElasticMat): they carry any load.");
	}

	template <int Dim> gimpm::WeakBody<3> inSpace(const gimpm::WeakBody<Dim>& body)
	{
		gimpm::WeakBody<3> same { body.carries, body.reached, body.iterations, body.parts, body.cause, {}, body.plasticStrain };
		for (const auto& u : body.displacement)
			same.displacement.push_back({ u[0], u[1], Dim == 3 ? u[Dim - 1] : 0 });
		return same;
	}

	// Refuses scenes the strength of which cannot be reduced, whatever the factor.
	void requireReducible(MpmImplicitEngine& engine)
	{
		requireUndivided(engine);
		for (const Listed& listed : engine.conditions())
			if (listed.condition->partsBodies())
				throw std::invalid_argument(
				        engine.getClassName() + ": the strength cannot be reduced with contact between bodies of points (" + listed.name()
				        + ") yet: what presses them together would go with the modulus.");
		requireStrength(materialPoints(*engine.ownScene(), engine.mask));
	}

	py::dict weakened(MpmImplicitEngine& engine, Real factor)
	{
		if (!(factor > 0 && std::isfinite(factor)))
			throw std::invalid_argument("factor = " + std::to_string(factor) + " is not admitted: expected a finite number > 0.");
		requireReducible(engine);
		gimpm::WeakBody<3> found; // result in either dimension
		onCurrentState(engine, [&](const auto& cloud, const auto& model, const auto& load) {
			const gimpm::StepControl control(1, engine.newton->minStep, engine.newton->maxIterations);
			gimpm::LinearSolver      solver;
			found = inSpace(gimpm::reduceStrength(cloud, model, load, factor, control, solver));
			return 0;
		});
		vector<Real> displacement;
		for (const auto& u : found.displacement)
			displacement.insert(displacement.end(), u.begin(), u.end());
		py::dict d;
		d["carries"]       = found.carries;
		d["reached"]       = found.reached;
		d["iterations"]    = found.iterations;
		d["parts"]         = found.parts;
		d["cause"]         = found.cause;
		d["displacement"]  = numpyArray(displacement, "float64");
		d["plasticStrain"] = numpyArray(found.plasticStrain, "float64");
		return d;
	}

	py::dict workload(MpmImplicitEngine& engine)
	{
		// the quickest of three: other programs can only slow them down
		double          perStep = std::numeric_limits<double>::infinity(), perSolve = perStep;
		gimpm::Workload w;
		for (int time = 0; time < 3; ++time) {
			double gathering = 0, rest = 0;
			{
				const gimpm::Stopwatch watch(gathering);
				w = onCurrentState(engine, [&](const auto& cloud, const auto& model, const auto&) {
					const gimpm::Stopwatch watch(rest);
					return gimpm::workload(cloud, model);
				});
			}
			requireUnobstructed(engine, w.obstacle);
			const auto& t = w.times;
			// scattering takes as long as gathering, the update of the points and the last residual as long
			// as an assembly
			perStep  = std::min(perStep, 2 * (gathering - rest) + t.basis + t.ghost + t.linear.analyse + t.assembly);
			perSolve = std::min(perSolve, t.assembly + t.linear.factorise + t.linear.solve);
		}
		py::dict d;
		d["points"]          = w.points;
		d["nodes"]           = w.nodes;
		d["dofs"]            = w.dofs;
		d["activeCells"]     = w.populatedCells;
		d["ghostFaces"]      = w.ghostFaces;
		d["blockEntries"]    = w.blockEntries;
		d["matrixEntries"]   = w.matrixEntries;
		d["factorEntries"]   = w.factorEntries;
		d["factorFlops"]     = w.factorFlops;
		d["iterations"]      = w.iterations;
		d["secondsPerStep"]  = perStep;
		d["secondsPerSolve"] = perSolve;
		return d;
	}
}

// Sentences for mpm.advise, which a first step would begin with.
static py::dict doubts(const MpmImplicitEngine& engine)
{
	requireUndivided(engine);
	const auto inSpace = [&](auto dim) {
		constexpr int   Dim = decltype(dim)::value;
		const ValueLock lock;
		const auto      now = currentState<Dim>(engine);
		return warningsOfFirstStep(engine, materialPoints(*engine.ownScene(), engine.mask), now.cloud, now.model);
	};
	const auto found = engine.grid && engine.grid->dim == 3 ? inSpace(std::integral_constant<int, 3>()) : inSpace(std::integral_constant<int, 2>());
	py::dict   sentences;
	for (const auto& [about, sentence] : found)
		if (!sentence.empty()) sentences[about] = sentence;
	return sentences;
}

static Real loadsEnd(const MpmImplicitEngine& engine)
{
	const ValueLock lock;
	return engine.loadsEnd();
}

void addStudyMethods(py::object pythonClass)
{
	py::objects::add_to_namespace(
	        pythonClass, "_doubts", py::make_function(&doubts), "_doubts() -> dict\n\nWhat the first step would warn of by its subject, for mpm.advise.");
	py::objects::add_to_namespace(
	        pythonClass, "loadsEnd", py::make_function(&loadsEnd),
	        "loadsEnd() -> float\n\nTime [s] when the last of the curves of loads has come to rest: those of the engine, of its loads, its "
	        "boundaries and its water.");
	py::objects::add_to_namespace(
	        pythonClass, "stiffness", py::make_function(&stiffness),
	        "stiffness() -> (rows, columns, values, size)\n\nReduced tangent stiffness [N/m] of the current configuration, that of the first iteration of a load "
	        "step from there with the loads of loadTime: of the points and the ghost stabilisation, of walls, contacts, pressures that follow and water. Of an "
	        "MpmDynamicEngine, too, it is the derivative of these forces alone, without mass and damping. The free degrees of freedom only, both "
	        "triangles, as NumPy arrays (M,) of int64, int64 and float, and the number of unknowns. Usable before any step. Raises ValueError for what a step cannot be made with.");
	py::objects::add_to_namespace(
	        pythonClass, "conditionNumber", py::make_function(&conditionNumber),
	        "conditionNumber() -> float\n\nCondition number [-] of stiffness() in the 2-norm, from all eigenvalues of the dense matrix (Coombs 2023, figure "
	        "2). For small scenes: raises ValueError above 4000 unknowns.");
	py::objects::add_to_namespace(
	        pythonClass, "conditionEstimate", py::make_function(&conditionEstimate),
	        "conditionEstimate() -> float\n\nEstimate [-] of the same, as a rule a few percent below it, for scenes of any size: Lanczos' method with the "
	        "factor of the stiffness matrix, at the cost of a few Newton iterations. Infinite if the matrix is singular to working precision. Raises "
	        "ValueError as a step does, and for a scene without unknowns.");
	py::objects::add_to_namespace(
	        pythonClass, "weakened", py::make_function(&weakened),
	        "weakened(factor) -> dict\n\nWhether the body carries its load, with the strength of its points divided by a factor, from the current state and at "
	        "small displacements: *carries*; *reached*: the factor of the last equilibrium; *displacement* (3N,) [m] and *plasticStrain* (N,) [-] of the points "
	        "from the current state to there, in order of body id; *iterations*, *parts*, and *cause* of an end before the factor. The scene is left alone. "
	        "mpm.strengthReduction looks for the factor of safety with it. Raises ValueError as a step does, and without a strength that could be divided.");
	py::objects::add_to_namespace(
	        pythonClass, "_requireStrength", py::make_function(&requireReducible),
	        "_requireStrength()\n\nRaises ValueError if no factor of safety can be found in this scene at any time.");
	py::objects::add_to_namespace(
	        pythonClass, "workload", py::make_function(&workload),
	        "workload() -> dict\n\nSize of a load step from the current state, found by doing its parts, without load, and leaving the scene alone: points, "
	        "nodes, dofs, activeCells, ghostFaces; blockEntries, matrixEntries, factorEntries: numbers that the stiffness matrix takes by blocks, reduced, and "
	        "factorised; factorFlops: operations of a factorisation (both 0 with an iterative solver, see MpmNewton.linearSolver); iterations that such a solver takes to 1e-3, otherwise 0; secondsPerStep and secondsPerSolve: of what is done once a step, and with each solve. "
	        "A factorisation of more than 2e10 operations is not made: its time is that at 5e9 a second. mpm.advise says it in words. Raises ValueError as "
	        "a step does.");
}

} // namespace yade
