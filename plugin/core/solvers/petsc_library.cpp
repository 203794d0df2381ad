// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/petsc_library.hpp"
#include <dlfcn.h>

namespace gimpm {
namespace {

/// Beside the file that holds the core.
std::string usualFile()
{
	Dl_info self;
	if (!dladdr(reinterpret_cast<void*>(&usualFile), &self)) return "mpm_petsc.so";
	const std::string core(self.dli_fname);
	return core.substr(0, core.rfind('/') + 1) + "mpm_petsc.so";
}

/// Null if it is not there, or of another version.
template <class Module> const Module* find(void* library, const char* symbol, int version)
{
	const auto get = reinterpret_cast<const Module* (*)()>(dlsym(library, symbol));
	return get && get()->version == version ? get() : nullptr;
}

} // namespace

PetscLibrary& PetscLibrary::get()
{
	static PetscLibrary one { usualFile() };
	return one;
}

std::string PetscLibrary::open()
{
	if (multigrid && distributed) return "";
	void* const opened = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
	if (!opened) return dlerror();
	multigrid   = find<MultigridModule>(opened, multigridSymbol, multigridVersion);
	distributed = find<DistributedModule>(opened, distributedSymbol, distributedVersion);
	return multigrid && distributed ? "" : file + " is of another version of the plugin";
}

} // namespace gimpm
