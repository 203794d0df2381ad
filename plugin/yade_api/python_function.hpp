// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/conversion.hpp"

namespace yade {

// A function of the position that Python evaluates, which may be let go of in any thread, or none. It is not saved.
struct PythonFunction {
	shared_ptr<py::object> object;

	explicit                      operator bool() const { return bool(object); }
	template <class Archive> void serialize(Archive&, unsigned) { }
};
template <> struct Conversion<PythonFunction> {
	static string                        expected() { return "a function of the position, or None"; }
	static std::optional<PythonFunction> fromPython(const py::object&);
	static py::object                    toPython(const PythonFunction& f) { return f ? *f.object : py::object(); }
};
inline string textOf(const PythonFunction& f) { return f ? "a function" : "None"; }

// Number that a function must return: in words, and a test.
struct ExpectedValue {
	const char* text;
	bool (*isAdmitted)(Real);
};

// Values of a function at positions, in whatever thread this is. It may do anything that a script can, so that the lock
// of values must not be held. std::invalid_argument, which begins with the name given, for what it returns or raises.
vector<Real> evaluate(const PythonFunction&, vector<Vector3r> positions, const string& name, const ExpectedValue&);

} // namespace yade
