// SPDX-License-Identifier: GPL-2.0-or-later
// libpkg_mpm.so: the only file of the plugin that YADE opens by itself.
//
// YADE aborts if it cannot open a library of its folder. So this one needs nothing but the C library, whatever an
// upgrade of the system has replaced since it was built, and opens the guard if the process has no other boost.python
// than the one that that is made for: two of them would crash it. If anything is wrong it says so in one sentence, and
// YADE starts as if the plugin were not there.
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <link.h>

namespace {

constexpr size_t longest = 4096;

const char* fileName(const char* path)
{
	const char* slash = std::strrchr(path, '/');
	return slash ? slash + 1 : path;
}

// Copies the name of a boost.python that the process has loaded and that is not the plugin's, and ends the search.
int noteOtherBoostPython(dl_phdr_info* library, size_t, void* found)
{
	const char* name = fileName(library->dlpi_name);
	if (std::strncmp(name, "libboost_python", 15) != 0 || std::strcmp(name, MPM_BOOST_PYTHON) == 0 || std::strlen(name) >= longest) return 0;
	std::strcpy(static_cast<char*>(found), name);
	return 1;
}

// The guard is in the folder mpm beside this file. False without room for its path.
bool findGuard(char* path)
{
	Dl_info self;
	if (!dladdr(reinterpret_cast<void*>(&findGuard), &self) || std::strlen(self.dli_fname) + 32 > longest) return false;
	std::strcpy(path, self.dli_fname);
	std::strcpy(path + (fileName(path) - path), "mpm/mpm_guard.so");
	return true;
}

[[gnu::constructor]] void openGuard()
{
	char boost[longest] = "", path[longest] = "";
	dl_iterate_phdr(&noteOtherBoostPython, boost);
	if (boost[0])
		std::fprintf(
		        stderr,
		        "Material point plugin not loaded: it was built with %s, and this process has loaded %s; if that is YADE's own, build the "
		        "plugin again, with scripts/setup.\n",
		        MPM_BOOST_PYTHON, boost);
	else if (!findGuard(path))
		std::fprintf(stderr, "Material point plugin not loaded: its folder is unknown.\n");
	else if (!dlopen(path, RTLD_NOW))
		std::fprintf(stderr, "Material point plugin not loaded: %s; build it again for this system, with scripts/setup.\n", dlerror());
}

}
