// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parallel/processes.hpp"
#include "core/solvers/opened_processes.hpp"
#include "core/stepping/share.hpp"
#include "engine/analysis/analysis.hpp"
#include "yade_api/python_lock.hpp"
#include <cstdlib>

namespace yade {

namespace {
	// What OpenMPI's mpirun has told this process.
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

	// As many as there are if none does.
	int firstToFail(const gimpm::Processes& all, bool fails)
	{
		std::int64_t first = fails ? all.rank() : all.size();
		all.smallest(&first, 1);
		return int(first);
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
}

std::shared_ptr<const gimpm::Processes> processes()
{
	static std::shared_ptr<const gimpm::Processes> known;
	const int                                      count = toldByMpirun("OMPI_COMM_WORLD_SIZE", 1);
	if (!known && count > 1) known = begin(count);
	return known;
}

bool isFirstProcess() { return toldByMpirun("OMPI_COMM_WORLD_RANK", 0) == 0; }

bool isRequested(bool here, const gimpm::Processes* all)
{
	if (!all) return here;
	std::int64_t goesOn = !here;
	all->smallest(&goesOn, 1);
	return !goesOn;
}

string firstSaid(const string& text, const gimpm::Processes& all)
{
	const int first = firstToFail(all, !text.empty());
	return first < all.size() ? all.told(text, first) : "";
}

int largestOf(int number, const gimpm::Processes& all)
{
	std::int64_t least = -number;
	all.smallest(&least, 1);
	return int(-least);
}

void failTogether(const std::exception_ptr& thrown, const gimpm::Processes& all)
{
	if (const string reason = firstSaid(messageOf(thrown), all); !reason.empty()) throw std::runtime_error(reason);
}

void Agreement::meet(const Analysis& engine)
{
	reach(engine, gimpm::PointCloud<2>(), true);
	isAsked = false;
}

template <int Dim> void Agreement::reach(const Analysis& engine, const gimpm::PointCloud<Dim>& cloud, bool areDivided)
{
	const auto all = processes();
	isAsked        = true;
	if (!all) return;
	const int first = firstToFail(*all, false);
	if (first < all->size())
		throw std::runtime_error("Process " + std::to_string(first) + " of " + std::to_string(all->size()) + " has failed: " + all->told("", first));
	const bool isSameIteration = all->haveSame(std::uint64_t(engine.sceneOfRun().iter)); // after an error in one of them it may not be
	if (!isSameIteration || !(areDivided || gimpm::haveSamePoints(*all, cloud)))
		throw std::runtime_error(
		        engine.className() + ": the processes "
		        + (isSameIteration ? "hold different material points" : "are not in the same iteration; this one is") + " in iteration "
		        + std::to_string(engine.sceneOfRun().iter)
		        + ". The script must do the same in all of them, in the same order: random numbers need a seed, and files the same content.");
}

template void Agreement::reach(const Analysis&, const gimpm::PointCloud<2>&, bool);
template void Agreement::reach(const Analysis&, const gimpm::PointCloud<3>&, bool);

void Agreement::breakOff(const std::exception_ptr& thrown)
{
	if (isAsked) return;
	isAsked = true;
	std::shared_ptr<const gimpm::Processes> all;
	try {
		all = processes();
	} catch (const std::invalid_argument&) { // there are none to talk to
	}
	if (all) all->told(messageOf(thrown), firstToFail(*all, true));
}

} // namespace yade
