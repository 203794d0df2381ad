// SPDX-License-Identifier: GPL-2.0-or-later
// The same source for all processors that Debian runs on, and for those with AVX2 and FMA (nearly all since 2013).
#pragma once

namespace gimpm {

#ifdef __AVX2__ // the compiler was told to use it and more (-march=native)
#define GIMPM_TARGET_AVX2
#else
#define GIMPM_TARGET_AVX2 [[gnu::target("arch=x86-64-v3")]]
#endif

// A sanitizer's checks in one large function would keep the compiler busy for a quarter of an hour.
#if defined(__SANITIZE_ADDRESS__) || defined(GIMPM_COMPILES_QUICKLY)
#define GIMPM_FLATTEN
#else
#define GIMPM_FLATTEN gnu::flatten,
#endif

/// False where several processes shall come to the same bits, and the processor of one of them has none.
inline bool mayUseAvx2 = true;

#ifdef GIMPM_NEEDS_AVX2 // a build for the processor at hand (MPM_PORTABLE in plugin/CMakeLists.txt)
constexpr bool isPortable = false;
#else
constexpr bool                  isPortable     = true;
#endif

inline bool processorHasAvx2() { return !isPortable || (mayUseAvx2 && __builtin_cpu_supports("x86-64-v3")); }

#ifdef GIMPM_BRIEF
template <class> constexpr bool mayHaveKernels = false;
#else
template <class> constexpr bool mayHaveKernels = true;
#endif

/// f(), with all that it calls compiled into one function, for AVX2 if the processor has it.
template <class F>[[GIMPM_FLATTEN gnu::noinline]] void                   callPortable(F&& f) { f(); }
template <class F>[[GIMPM_FLATTEN gnu::noinline]] GIMPM_TARGET_AVX2 void callAvx2(F&& f)
{
	static_assert(mayHaveKernels<F>, "code for AVX2 needs all optimisation: exclude this file from brief_sources of plugin/CMakeLists.txt");
	f();
}
template <class F> void callForProcessor(F&& f)
{
	if constexpr (isPortable)
		if (!processorHasAvx2()) return callPortable(f);
	callAvx2(f);
}

} // namespace gimpm
