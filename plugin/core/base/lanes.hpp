// SPDX-License-Identifier: GPL-2.0-or-later
// Several numbers side by side, as the number type of formulas that are written once for one point and for a row of
// them.
//
// A formula that branches uses select(), so that it has the same text for double and for Lanes.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#pragma GCC diagnostic ignored "-Wpsabi" // vectors in interfaces: there are none once the functions are inlined
#ifdef GIMPM_COMPILES_QUICKLY            // for processors that hardly anybody has any more: small functions stay functions
#define GIMPM_INLINE inline
#define GIMPM_INLINE_LAMBDA
#else
#define GIMPM_INLINE __attribute__((always_inline)) inline
#define GIMPM_INLINE_LAMBDA __attribute__((always_inline))
#endif

namespace gimpm {

class Lanes {
public:
	static constexpr int count = 4;
	typedef double       Vector __attribute__((vector_size(count * sizeof(double)), may_alias));
	typedef std::int64_t Mask __attribute__((vector_size(count * sizeof(double))));

	Vector v;

	Lanes() = default;
	// Not left to the compiler: a class with a copy constructor is passed in memory, in the same way for every
	// instruction set.
	GIMPM_INLINE        Lanes(const Lanes& o) : v(o.v) { }
	GIMPM_INLINE Lanes& operator=(const Lanes& o) { return v = o.v, *this; }
	GIMPM_INLINE        Lanes(double x) : v { x, x, x, x } { }
	GIMPM_INLINE        Lanes(Vector x) : v(x) { }

	GIMPM_INLINE double operator[](int lane) const { return v[lane]; }

	friend GIMPM_INLINE Lanes operator+(const Lanes& a, const Lanes& b) { return a.v + b.v; }
	friend GIMPM_INLINE Lanes operator-(const Lanes& a, const Lanes& b) { return a.v - b.v; }
	friend GIMPM_INLINE Lanes operator*(const Lanes& a, const Lanes& b) { return a.v * b.v; }
	friend GIMPM_INLINE Lanes operator/(const Lanes& a, const Lanes& b) { return a.v / b.v; }
	friend GIMPM_INLINE Lanes operator-(const Lanes& a) { return -a.v; }
	GIMPM_INLINE Lanes&       operator+=(const Lanes& b) { return v += b.v, *this; }
	GIMPM_INLINE Lanes&       operator-=(const Lanes& b) { return v -= b.v, *this; }
	GIMPM_INLINE Lanes&       operator*=(const Lanes& b) { return v *= b.v, *this; }

	friend GIMPM_INLINE Mask operator>(const Lanes& a, const Lanes& b) { return a.v > b.v; }
	friend GIMPM_INLINE Mask operator>=(const Lanes& a, const Lanes& b) { return a.v >= b.v; }
	friend GIMPM_INLINE Mask operator<=(const Lanes& a, const Lanes& b) { return a.v <= b.v; }
};

/// From a number for each lane: f(0), f(1) ...
template <class F> GIMPM_INLINE Lanes lanes(F&& f) { return Lanes::Vector { f(0), f(1), f(2), f(3) }; }

/// Numbers next to each other in memory, wherever they begin.
GIMPM_INLINE Lanes loadLanes(const double* from)
{
	Lanes x;
	__builtin_memcpy(&x.v, from, sizeof x.v);
	return x;
}
GIMPM_INLINE void   storeLanes(double* to, const Lanes& x) { __builtin_memcpy(to, &x.v, sizeof x.v); }
GIMPM_INLINE double sum(const Lanes& x) { return (x[0] + x[1]) + (x[2] + x[3]); }

GIMPM_INLINE double select(bool condition, double yes, double no) { return condition ? yes : no; }
GIMPM_INLINE Lanes  select(const Lanes::Mask& condition, const Lanes& yes, const Lanes& no) { return condition ? yes.v : no.v; }
GIMPM_INLINE bool   everywhere(bool condition) { return condition; }
GIMPM_INLINE bool   everywhere(const Lanes::Mask& m) { return (m[0] & m[1] & m[2] & m[3]) != 0; }

using std::abs;
using std::copysign;
using std::sqrt;
GIMPM_INLINE Lanes sqrt(const Lanes& x)
{
	return lanes([&](int i) { return __builtin_sqrt(x[i]); });
}
GIMPM_INLINE Lanes abs(const Lanes& x)
{
	const Lanes::Mask magnitude = ~(Lanes::Mask)Lanes(-0.).v;
	return (Lanes::Vector)((Lanes::Mask)x.v & magnitude);
}
GIMPM_INLINE Lanes copysign(const Lanes& x, const Lanes& sign)
{
	const Lanes::Mask bit = (Lanes::Mask)Lanes(-0.).v;
	return (Lanes::Vector)(((Lanes::Mask)x.v & ~bit) | ((Lanes::Mask)sign.v & bit));
}

/// f(x) of the standard library, number by number.
template <class F> GIMPM_INLINE double each(double x, F&& f) { return f(x); }
template <class F> GIMPM_INLINE Lanes  each(const Lanes& x, F&& f)
{
	return lanes([&](int i) { return f(x[i]); });
}

} // namespace gimpm

namespace Eigen {
template <> struct NumTraits<gimpm::Lanes> : GenericNumTraits<double> {
	typedef gimpm::Lanes Real;
	typedef gimpm::Lanes NonInteger;
	typedef gimpm::Lanes Nested;
	typedef gimpm::Lanes Literal;
	enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = 1 };
};
} // namespace Eigen
