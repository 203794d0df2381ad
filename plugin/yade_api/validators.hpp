// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Values that an attribute admits: the optional last argument in the attribute list of a class, as in
//
//	v("young", &MpmElasticMat::young, 0, "Young's modulus [Pa].", positive);
//
// A validator is a function of the value that says whether it is admitted, with a description() for the error message.
#include "yade_api/types.hpp"
#include <cmath>
#include <sstream>
#include <utility>

namespace yade {

inline bool isFinite(Real value) { return std::isfinite(value); }
inline bool isFinite(const Vector3r& value) { return value.allFinite(); }
inline bool isFinite(const Matrix3r& value) { return value.allFinite(); }

struct AnyValue {
	template <class T> bool operator()(const T&) const { return true; }
	static string           description() { return "any value"; }
};

// The conditions on numbers hold for every component of a vector or matrix.
struct Finite {
	template <class T> bool operator()(const T& value) const { return isFinite(value); }
	static string           description() { return "a finite number"; }
};

struct NotNaN { // infinite is admitted
	bool          operator()(Real value) const { return !std::isnan(value); }
	bool          operator()(const Vector3r& value) const { return !value.hasNaN(); }
	static string description() { return "a number, finite or infinite, but not NaN"; }
};

struct Positive {
	bool          operator()(Real value) const { return isFinite(value) && value > 0; }
	bool          operator()(const Vector3r& value) const { return isFinite(value) && (value.array() > 0).all(); }
	static string description() { return "a finite number > 0"; }
};

struct NonNegative {
	bool          operator()(Real value) const { return isFinite(value) && value >= 0; }
	bool          operator()(const Vector3r& value) const { return isFinite(value) && (value.array() >= 0).all(); }
	static string description() { return "a finite number >= 0"; }
};

struct Part {
	bool          operator()(Real value) const { return value > 0 && value <= 1; }
	static string description() { return "a number > 0 and <= 1"; }
};

struct NotNull { // None in Python
	template <class T> bool operator()(const shared_ptr<T>& value) const { return bool(value); }
	static string           description() { return "an object, not None"; }
};

inline constexpr Finite      finite {};
inline constexpr NotNaN      notNaN {};
inline constexpr Positive    positive {};
inline constexpr NonNegative nonNegative {};
inline constexpr Part        part {};
inline constexpr NotNull     notNull {};

struct AtLeast {
	long   least;
	bool   operator()(Real value) const { return isFinite(value) && value >= Real(least); }
	string description() const { return "a number >= " + std::to_string(least); }
};
constexpr AtLeast atLeast(long least) { return { least }; }

struct Between {
	Real lower, upper;
	bool operator()(Real value) const { return lower < value && value < upper; }

	string description() const
	{
		std::ostringstream text;
		text << "a number between " << lower << " and " << upper << ", both excluded";
		return text.str();
	}
};
constexpr Between strictlyBetween(Real lower, Real upper) { return { lower, upper }; }

template <class T, size_t N> struct OneOf {
	T choices[N];

	template <class Value> bool operator()(const Value& value) const
	{
		for (const T& choice : choices)
			if (value == choice) return true;
		return false;
	}
	string description() const
	{
		std::ostringstream text;
		const bool         quoted = std::is_same_v<T, const char*>;
		for (size_t i = 0; i < N; i++)
			text << (i == 0 ? "" : i + 1 < N ? ", " : " or ") << (quoted ? "'" : "") << choices[i] << (quoted ? "'" : "");
		return text.str();
	}
};
template <class T, class... More> constexpr OneOf<T, 1 + sizeof...(More)> oneOf(T first, More... more) { return { { first, more... } }; }

// Any other condition: admitting("letters out of 'xyz'", [](const string& s) { ... }).
template <class Condition> struct Admitting {
	const char* text;
	Condition   condition;

	template <class T> bool operator()(const T& value) const { return condition(value); }
	string                  description() const { return text; }
};
template <class Condition> Admitting<Condition> admitting(const char* description, Condition condition) { return { description, condition }; }

} // namespace yade
