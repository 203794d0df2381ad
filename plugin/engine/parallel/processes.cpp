// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parallel/processes.hpp"
#include "core/solvers/opened_processes.hpp"
#include "core/stepping/owned_parts.hpp"
#include "engine/analysis/analysis.hpp"
#include "yade_api/python_lock.hpp"
#include <cstdlib>

namespace yade {

namespace {
	// Value that OpenMPI's mpirun has told this process.
	int toldByMpirun(const char* variable, int otherwise)
	{
		const char* text = std::getenv(variable);
		return text ? std::atoi(text) : otherwise;
	}

	// MPI is ended by what has begun it: mpi4py does so however the script ends.
	void beginMpi()
	{
		const PythonLock python;
		try {
			py::import("mpi4py.MPI");
		} catch (const py::error_already_set&) {
			PyErr_Clear();
		}
	}

	std::shared_ptr<const gimpm::Processes> begin(int count)
	{
		beginMpi();
		string     absence;
		const auto found = gimpm::openProcesses(absence);
		if (!absence.empty())
			throw std::invalid_argument(
			        "mpirun has started " + std::to_string(count)
			        + " processes, which need the plugin's library for PETSc to work together; it cannot be opened (" + absence
			        + "). scripts/setup --with-petsc, or the package yade-mpm-petsc, installs it.");
		return found;
	}

	string messageOf(const std::exception_ptr& thrown)
	{
		if (!thrown) return "";
		try {
			std::rethrow_exception(thrown);
		} catch (const std::exception& error) {
			return error.what();
		} catch (...) {
			return "the step was given up";
		}
	}

	// True if what has been thrown says that an argument is not admitted.
	bool isRefusal(const std::exception_ptr& thrown)
	{
		try {
			std::rethrow_exception(thrown);
		} catch (const std::invalid_argument&) {
			return true;
		} catch (...) {
			return false;
		}
	}
}

std::shared_ptr<const gimpm::Processes> processes()
{
	static std::shared_ptr<const gimpm::Processes> known = gimpm::Processes::alone();
	const int                                      count = toldByMpirun("OMPI_COMM_WORLD_SIZE", 1);
	if (known->size() < count) known = begin(count);
	return known;
}

bool isFirstProcess() { return toldByMpirun("OMPI_COMM_WORLD_RANK", 0) == 0; }

bool isRequested(bool here, const gimpm::Processes& all)
{
	std::int64_t goesOn = !here;
	all.smallest(&goesOn, 1);
	return !goesOn;
}

int largestOf(int number, const gimpm::Processes& all)
{
	std::int64_t least = -number;
	all.smallest(&least, 1);
	return int(-least);
}

void failTogether(const std::exception_ptr& thrown, const gimpm::Processes& all)
{
	constexpr char refusal = 'r', other = 'o';
	const int      first = gimpm::firstOf(all, bool(thrown));
	if (first == all.size()) return;
	const string said = all.told(thrown ? (isRefusal(thrown) ? refusal : other) + messageOf(thrown) : "", first);
	if (first == all.rank()) std::rethrow_exception(thrown);
	if (said[0] == refusal) throw std::invalid_argument(said.substr(1));
	throw std::runtime_error(said.substr(1));
}

template <class F> void Agreement::requireAgreement(const Analysis& engine, F&& haveSamePoints)
{
	const auto all  = processes();
	isAsked         = true;
	const int first = gimpm::firstOf(*all, false);
	if (first < all->size())
		throw std::runtime_error("Process " + std::to_string(first) + " of " + std::to_string(all->size()) + " has failed: " + all->told("", first));
	// After an error in one of them it may not be.
	const bool isSameIteration = all->haveSame(std::uint64_t(engine.sceneOfRun().iter));
	if (!isSameIteration || !haveSamePoints(*all))
		throw std::runtime_error(
		        engine.className() + ": the processes "
		        + (isSameIteration ? "have different material points" : "are not in the same iteration; this one is") + " in iteration "
		        + std::to_string(engine.sceneOfRun().iter)
		        + ". The script must do the same in all of them, in the same order: random numbers need a seed, and files the same content.");
}

void Agreement::meet(const Analysis& engine)
{
	requireAgreement(engine, [](const gimpm::Processes&) { return true; });
	isAsked = false;
}

template <int Dim> void Agreement::reach(const Analysis& engine, const gimpm::PointCloud<Dim>& cloud, const gimpm::Division& division)
{
	requireAgreement(engine, [&](const gimpm::Processes& all) { return !division.isWhole() || gimpm::haveSamePoints(all, cloud); });
}

template void Agreement::reach(const Analysis&, const gimpm::PointCloud<2>&, const gimpm::Division&);
template void Agreement::reach(const Analysis&, const gimpm::PointCloud<3>&, const gimpm::Division&);

void Agreement::breakOff(const std::exception_ptr& thrown)
{
	if (isAsked) return;
	isAsked = true;
	try {
		const auto all = processes();
		all->told(messageOf(thrown), gimpm::firstOf(*all, true));
	} catch (const std::invalid_argument&) { // there are none to talk to
	}
}

} // namespace yade
