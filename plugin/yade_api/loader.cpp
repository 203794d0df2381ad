// SPDX-License-Identifier: GPL-2.0-or-later
// libpkg_mpm.so: the only file of the plugin that YADE opens by itself.
//
// YADE aborts if it cannot open a library of its folder, and misreads memory if a library is made for another build of it. So
// this library needs no symbol of YADE, checks what it has been opened by, and only then opens the plugin. If anything is wrong
// it says so in one sentence, and YADE starts as if it were not there.
#include "yade_api/layout_check.hpp"
#include <dlfcn.h>
#include <elf.h>
#include <fstream>
#include <iostream>

namespace yade {
namespace {
	constexpr const char* supportedVersion = "2023.02a";

	// A function of YADE's libraries, by its name in the symbol table.
	template <class Function> Function* find(const char* symbol)
	{
		void* address = dlsym(RTLD_DEFAULT, symbol);
		if (!address) throw std::runtime_error(string("YADE has no function ") + symbol);
		return reinterpret_cast<Function*>(address);
	}

	void requireVersion()
	{
		// imported by YADE before it opens libraries
		const string version = py::extract<string>(py::import("yade.config").attr("version"));
		if (version != supportedVersion) throw std::runtime_error("it is made for YADE " + string(supportedVersion) + ", and this is YADE " + version);
	}

	void requireLayout()
	{
		// Member functions, called with the object as first argument.
		auto* factory = find<ClassFactory*()>("_ZN9SingletonIN4yade12ClassFactoryEE8instanceEv");
		auto* create  = find<shared_ptr<Factorable>(ClassFactory*, string)>(
                        "_ZN4yade12ClassFactory12createSharedENSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE");

		LayoutCheck check([&](const string& className) { return create(factory(), className); });
		check.checkSizesAndScalars();
		if (!check.errors().empty())
			throw std::runtime_error("this build of YADE " + string(supportedVersion) + " differs in " + joined(check.errors()));
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
		const string loader = self.dli_fname;
		const string plugin = loader.substr(0, loader.rfind('/') + 1) + "mpm/mpm_engine.so";
		requireComplete(plugin);
		if (!dlopen(plugin.c_str(), RTLD_NOW)) throw std::runtime_error(dlerror());
	}

	// What went wrong, or nothing. No exception may leave: it would end YADE.
	string open()
	{
		try {
			requireVersion();
			requireLayout();
			openPlugin();
			return {};
		} catch (const py::error_already_set&) {
			PyErr_Clear();
			return "this YADE differs from version " + string(supportedVersion) + " in its Python interface";
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
