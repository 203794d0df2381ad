// SPDX-License-Identifier: GPL-2.0-or-later
// The processes that mpirun has started, as the library with PETSc and MPI finds them.
#pragma once
#include "core/parallel/processes.hpp"
#include <memory>

namespace gimpm {

/// The library is opened, and all processes agree on the instructions that each of them has. Null, with the reason,
/// where they cannot be found. All of them call this.
std::shared_ptr<const Processes> openProcesses(std::string& reason);

} // namespace gimpm
