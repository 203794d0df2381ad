// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/virtual_functions.hpp"
#include "yade_api/yade_api.hpp"
#include <cstring>
#include <cxxabi.h>
#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <memory>

namespace yade {

namespace {
	struct VirtualFunction {
		size_t      offset; // in the table
		const char* name;
	};

	// A pointer to a virtual function is its offset in the table plus 1, by the Itanium C++ ABI.
	template <class F> size_t offsetOf(F function)
	{
		std::ptrdiff_t first;
		static_assert(sizeof(function) == 2 * sizeof(first));
		std::memcpy(&first, &function, sizeof(first));
		return first - 1;
	}
#define MPM_VIRTUAL(Class, function)                                                                                                                           \
	VirtualFunction { offsetOf(&Class::function), #function }

	using Functions = vector<VirtualFunction>;

	Functions operator+(Functions a, const Functions& b)
	{
		a.insert(a.end(), b.begin(), b.end());
		return a;
	}
	template <class C> Functions factorable()
	{
		return { MPM_VIRTUAL(C, getBaseClassName), MPM_VIRTUAL(C, getBaseClassNumber), MPM_VIRTUAL(C, getClassName) };
	}
	template <class C> Functions serializable()
	{
		return factorable<C>()
		        + Functions { MPM_VIRTUAL(C, pySetAttr),
			              MPM_VIRTUAL(C, pyDict),
			              MPM_VIRTUAL(C, pyDictCustom),
			              MPM_VIRTUAL(C, callPostLoad),
			              MPM_VIRTUAL(C, pyRegisterClass),
			              MPM_VIRTUAL(C, checkPyClassRegistersItself),
			              MPM_VIRTUAL(C, pyHandleCustomCtorArgs) };
	}
	template <class C> Functions engine() { return serializable<C>() + Functions { MPM_VIRTUAL(C, isActivated), MPM_VIRTUAL(C, action) }; }

	template <class C> struct Opened : C {
		using C::incrementMaxCurrentlyUsedClassIndexOfKin;
		using C::modifyClassIndex;
	};
	template <class C> Functions indexed()
	{
		using O = Opened<C>;
		return serializable<C>()
		        + Functions { MPM_VIRTUAL(C, getClassIndex), MPM_VIRTUAL(C, getBaseClassIndex), MPM_VIRTUAL(C, getMaxCurrentlyUsedClassIndexOfKin),
			              MPM_VIRTUAL(O, modifyClassIndex), MPM_VIRTUAL(O, incrementMaxCurrentlyUsedClassIndexOfKin) };
	}
	template <class C> Functions shape()
	{
#ifdef YADE_API_SHAPE_HAS_VOLUME
		return indexed<C>() + Functions { MPM_VIRTUAL(C, getVolume) };
#else
		return indexed<C>();
#endif
	}

	// Bytes of the second table, of the base Indexable: two entries of its head, two destructors, five functions.
	constexpr size_t ofIndexable = 9 * sizeof(void*);

	bool isCalled(const void* address, const char* name)
	{
		Dl_info symbol;
		if (!dladdr(address, &symbol) || !symbol.dli_sname || symbol.dli_saddr != address) return false;
		const std::unique_ptr<char, decltype(&std::free)> text(abi::__cxa_demangle(symbol.dli_sname, nullptr, nullptr, nullptr), &std::free);
		const string                                      found = text ? text.get() : "";
		const size_t                                      start = found.find(string("::") + name), end = start + 2 + std::strlen(name);
		// [ before the tag of a string's ABI.
		return start != string::npos && (found[end] == '(' || found[end] == '[');
	}

	// Differences in the table of a class; none: ''.
	string difference(const string& className, const Functions& functions, size_t ofOtherBases)
	{
		const string table = "_ZTVN4yade" + std::to_string(className.size()) + className + "E";
		void*        start = dlsym(RTLD_DEFAULT, table.c_str());
		Dl_info      library;
		ElfW(Sym)* entry = nullptr;
		if (!start || !dladdr1(start, &library, reinterpret_cast<void**>(&entry), RTLD_DL_SYMENT) || !entry) return "no table";
		constexpr size_t head = 2 * sizeof(void*); // offset of the object, type information
		size_t           size = 0;
		for (const VirtualFunction& f : functions)
			size = std::max(size, head + f.offset + sizeof(void*));
		if (entry->st_size != size + ofOtherBases)
			return std::to_string(entry->st_size / sizeof(void*)) + " entries instead of " + std::to_string((size + ofOtherBases) / sizeof(void*));
		for (const VirtualFunction& f : functions)
			if (!isCalled(*reinterpret_cast<void**>(static_cast<char*>(start) + head + f.offset), f.name))
				return string("another one in place of ") + f.name;
		return {};
	}
}

vector<string> findOtherVirtualFunctions()
{
	vector<string> found;
	const auto     check = [&](const char* className, const Functions& functions, size_t ofOtherBases = 0) {
                const string problem = difference(className, functions, ofOtherBases);
                if (!problem.empty()) found.push_back(string(className) + " (" + problem + ")");
	};
	check("Factorable", factorable<Factorable>());
	check("Serializable", serializable<Serializable>());
	check("Engine", engine<Engine>());
	check("GlobalEngine", engine<GlobalEngine>());
	check("PeriodicEngine", engine<PeriodicEngine>());
	check("State", indexed<State>(), ofIndexable);
	check("Shape", shape<Shape>(), ofIndexable);
	check("Sphere", shape<Sphere>(), ofIndexable);
	check("Material", indexed<Material>() + Functions { MPM_VIRTUAL(Material, newAssocState), MPM_VIRTUAL(Material, stateTypeOk) }, ofIndexable);
	check("Body", serializable<Body>() + Functions { MPM_VIRTUAL(Body, userForcedDisplacementRedrawHook) });
	check("BodyContainer", serializable<BodyContainer>());
	check("Scene", serializable<Scene>());
	return found;
}

} // namespace yade
