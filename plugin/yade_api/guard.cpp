// SPDX-License-Identifier: GPL-2.0-or-later
// mpm/mpm_guard.so: checks what it has been opened by, and only then opens the plugin.
//
// YADE misreads memory if a library is made for another build of it. So this one is linked without YADE's libraries and
// calls virtual functions only, until sizes, attributes and tables of virtual functions have been found to be as
// declared. If anything is wrong it says so in one sentence, and YADE starts as if the plugin were not there.
#include "yade_api/layout_check.hpp"
#include "yade_api/virtual_functions.hpp"
#include <dlfcn.h>
#include <elf.h>
#include <fstream>
#include <iostream>

namespace yade {
namespace {
	// A function of YADE's libraries, by its name in the symbol table.
	template <class Function> Function* find(const char* symbol)
	{
		void* address = dlsym(RTLD_DEFAULT, symbol);
		if (!address) throw std::runtime_error(string("YADE has no function ") + symbol);
		return reinterpret_cast<Function*>(address);
	}

	// Says more than a difference in the binary does; is no reason to refuse by itself.
	string thisYade()
	{
		// Imported by YADE before it opens libraries.
		const string version = py::extract<string>(py::import("yade.config").attr("version"));
		return version == YADE_API_VERSION ? "this build of YADE " + version
		                                   : "this YADE " + version + " (the plugin was built for " YADE_API_VERSION ")";
	}

	void requireProcessor()
	{
#ifdef GIMPM_NEEDS_AVX2
		if (!__builtin_cpu_supports("x86-64-v3"))
			throw std::runtime_error(
			        "this processor has no AVX2, which this build needs; build it on this computer, or with cmake -DMPM_PORTABLE=ON");
#endif
	}

	void requireVirtualFunctions()
	{
		const auto others = findOtherVirtualFunctions();
		if (!others.empty()) throw std::runtime_error(thisYade() + " has other virtual functions in " + joined(others));
	}

	void requireLayout()
	{
		// Member functions, called with the object as first argument.
		auto* factory = find<ClassFactory*()>("_ZN9SingletonIN4yade12ClassFactoryEE8instanceEv");
		auto* create  = find<shared_ptr<Factorable>(ClassFactory*, string)>(
                        "_ZN4yade12ClassFactory12createSharedENSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE");

		LayoutCheck check([&](const string& className) { return create(factory(), className); });
		check.checkSizesAndScalars();
		if (!check.errors().empty()) throw std::runtime_error(thisYade() + " differs in " + joined(check.errors()));
	}

	// The dynamic linker crashes on a file that has been cut off. Its section headers come last.
	void requireComplete(const string& library)
	{
		std::ifstream file(library, std::ios::binary | std::ios::ate);
		if (!file) throw std::runtime_error(library + " is missing or not readable");
		const auto size = file.tellg();
		Elf64_Ehdr header {};
		file.seekg(0).read(reinterpret_cast<char*>(&header), sizeof(header));
		if (!file || size < std::streamoff(header.e_shoff + header.e_shnum * header.e_shentsize))
			throw std::runtime_error(library + " is incomplete; install it again");
	}

	void openPlugin()
	{
		Dl_info self;
		if (!dladdr(reinterpret_cast<void*>(&openPlugin), &self)) throw std::runtime_error("its folder is unknown");
		const string guard  = self.dli_fname;
		const string plugin = guard.substr(0, guard.rfind('/') + 1) + "mpm_engine.so";
		requireComplete(plugin);
		if (!dlopen(plugin.c_str(), RTLD_NOW)) throw std::runtime_error(dlerror());
	}

	// Opens the plugin; returns the cause of a failure, or nothing. No exception may leave: it would end YADE.
	string open()
	{
		try {
			requireProcessor();
			requireVirtualFunctions();
			requireLayout();
			openPlugin();
			return {};
		} catch (const py::error_already_set&) {
			PyErr_Clear();
			return "this YADE differs from version " YADE_API_VERSION ", for which the plugin was built, in its Python interface";
		} catch (const std::exception& error) {
			return error.what();
		}
	}

	[[gnu::constructor]] void openOrExplain()
	{
		const string problem = open();
		if (!problem.empty()) std::cerr << "Material point plugin not loaded: " << problem << "." << std::endl;
	}
}
} // namespace yade
