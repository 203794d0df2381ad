// SPDX-License-Identifier: GPL-2.0-or-later
// The library that needs PETSc and MPI, which is opened when something of it is asked for.
#pragma once
#include "core/solvers/distributed_module.hpp"
#include "core/solvers/multigrid_module.hpp"
#include <string>

namespace gimpm {

struct PetscLibrary {
	std::string              file;                  ///< default: mpm_petsc.so beside the file that holds the core
	const MultigridModule*   multigrid   = nullptr; ///< null until it is opened
	const DistributedModule* distributed = nullptr;

	/// Empty, or why it fails.
	std::string open();

	static PetscLibrary& get();
};

} // namespace gimpm
