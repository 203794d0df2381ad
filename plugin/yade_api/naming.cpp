// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/naming.hpp"
#include "yade_api/conversion.hpp"
#include <algorithm>
#include <map>

namespace yade {

namespace {
	// Symbols and words of the field, in lower case, and what the project calls them.
	const std::multimap<string, string> ofTheField {
		{ "e", "young" },
		{ "emod", "young" },
		{ "modulus", "young" },
		{ "g", "shearModulus" },
		{ "g", "gravity" },
		{ "nu", "poisson" },
		{ "v", "poisson" },
		{ "rho", "density" },
		{ "gamma", "density" },
		{ "gamma", "unitWeight" },
		{ "phi", "frictionAngle" },
		{ "phi", "friction" },
		{ "psi", "dilationAngle" },
		{ "c", "cohesion" },
		{ "c", "adhesion" },
		{ "su", "undrainedStrength" },
		{ "cu", "undrainedStrength" },
		{ "sy", "yieldStress" },
		{ "sigmay", "yieldStress" },
		{ "m", "criticalStateRatio" },
		{ "lambda", "compressionIndex" },
		{ "lam", "compressionIndex" },
		{ "kappa", "swellingIndex" },
		{ "pc", "preconsolidation" },
		{ "k", "conductivity" },
		{ "permeability", "conductivity" },
		{ "n", "porosity" },
		{ "kw", "waterModulus" },
		{ "kw", "bulkModulus" },
		{ "ea", "axialStiffness" },
		{ "ei", "bendingStiffness" },
		{ "mp", "plasticMoment" },
		{ "mu", "friction" },
		{ "h", "cellSize" },
		{ "dx", "cellSize" },
		{ "size", "cellSize" },
		{ "p", "pressure" },
		{ "q", "pressure" },
		{ "acceleration", "history" },
		{ "phic", "strengthReduction" },
		{ "fos", "strengthReduction" },
		{ "srf", "strengthReduction" },
		{ "factorofsafety", "strengthReduction" },
		{ "safety", "strengthReduction" },
		{ "k0", "geostatic" },
		{ "initialstress", "geostatic" },
		{ "excavate", "stages" },
		{ "dig", "excavate" },
		{ "dig", "stages" },
		{ "place", "stages" },
		{ "build", "place" },
		{ "replace", "stages" },
		{ "release", "stages" },
		{ "flow", "seepage" },
		{ "groundwater", "seepage" },
		{ "points", "arrays" },
		{ "animation", "movie" },
		{ "film", "movie" },
		{ "mesh", "solid" },
		{ "stl", "solid" },
		{ "dem", "terrain" },
		{ "triaxial", "elementTest" },
		{ "oedometer", "elementTest" },
	};
}

string didYouMean(const string& name, const vector<string>& known)
{
	const string   lower = py::extract<string>(py::str(name).lower());
	vector<string> meant;
	for (auto [one, last] = ofTheField.equal_range(lower); one != last; ++one)
		if (std::count(known.begin(), known.end(), one->second) > 0) meant.push_back(one->second);
	py::dict byLowerCase;
	for (const string& one : known)
		byLowerCase[py::str(one).lower()] = one;
	const py::object like = py::import("difflib").attr("get_close_matches")(py::str(name).lower(), py::list(byLowerCase.keys()));
	if (meant.empty())
		for (py::ssize_t i = 0; i < py::len(like); ++i)
			meant.push_back(py::extract<string>(byLowerCase[like[i]]));
	string text;
	for (size_t i = 0; i < meant.size(); ++i)
		text += (i == 0 ? "; did you mean " : i + 1 < meant.size() ? ", " : " or ") + repr(py::str(meant[i]));
	return text.empty() ? text : text + "?";
}

vector<string> namesIn(PyTypeObject* type)
{
	const py::object all { py::handle<>(PyObject_Dir(reinterpret_cast<PyObject*>(type))) };
	vector<string>   names;
	for (py::ssize_t i = 0; i < py::len(all); ++i)
		if (const string name = py::extract<string>(all[i]); name.front() != '_') names.push_back(name);
	return names;
}

namespace {
	constexpr const char* sentenceOfCopy      = "_sentenceOfCopy";
	constexpr const char* sentenceOfEmptiness = "_sentenceOfEmptiness";

	[[noreturn]] void refuseChange(const py::object& self, PyObject* exception)
	{
		raisePython(exception, py::extract<string>(self.attr("__dict__")[sentenceOfCopy]));
	}

	// Explains names of a list's methods, which a tuple does not have.
	py::object missing(const py::object& self, const string& name)
	{
		if (PyObject_HasAttrString(reinterpret_cast<PyObject*>(&PyList_Type), name.c_str())) refuseChange(self, PyExc_AttributeError);
		raisePython(PyExc_AttributeError, "'tuple' object has no attribute '" + name + "'");
	}
	// A result is empty until a step has made it.
	py::object item(const py::object& self, const py::object& index)
	{
		if (py::len(self) == 0 && PyIndex_Check(index.ptr()) && self.attr("__dict__").contains(sentenceOfEmptiness))
			raisePython(PyExc_IndexError, py::extract<string>(self.attr("__dict__")[sentenceOfEmptiness]));
		return py::object(py::handle<>(PyTuple_Type.tp_as_mapping->mp_subscript(self.ptr(), index.ptr())));
	}
	void       setItem(const py::object& self, const py::object&, const py::object&) { refuseChange(self, PyExc_TypeError); }
	void       removeItem(const py::object& self, const py::object&) { refuseChange(self, PyExc_TypeError); }
	py::object sum(const py::object& self, const py::object& other)
	{
		return py::tuple(self).attr("__add__")(PyList_Check(other.ptr()) ? py::object(py::tuple(other)) : other);
	}
	py::object whole(const py::object& self, const py::object&)
	{
		const py::object plain(py::handle<>(py::borrowed(reinterpret_cast<PyObject*>(&PyTuple_Type))));
		py::list         items(self);
		return py::make_tuple(plain, py::make_tuple(items));
	}

	py::object classOfCopies()
	{
		const auto object = [](PyTypeObject& type) { return py::object(py::handle<>(py::borrowed(reinterpret_cast<PyObject*>(&type)))); };
		py::dict   members;
		members["__getattr__"]   = py::make_function(&missing);
		members["__getitem__"]   = py::make_function(&item);
		members["__setitem__"]   = py::make_function(&setItem);
		members["__delitem__"]   = py::make_function(&removeItem);
		members["__add__"]       = py::make_function(&sum);
		members["__reduce_ex__"] = py::make_function(&whole); // copies and files have plain tuples
		return object(PyType_Type)("tuple", py::make_tuple(object(PyTuple_Type)), members);
	}
}

py::object copyOfAttribute(const py::tuple& items, const string& attribute, bool isReadonly)
{
	static const py::object& kind         = *new py::object(classOfCopies()); // Python ends before the library does
	py::object               copy         = kind(items);
	const string             name         = attribute.substr(attribute.find('.') + 1);
	copy.attr("__dict__")[sentenceOfCopy] = attribute + " can be read only as a copy, a tuple, which is not the attribute itself: "
	        + (isReadonly ? "it is a result, which cannot be changed." : "assign a new one, as in x." + name + " = [*x." + name + ", another].");
	if (isReadonly)
		copy.attr("__dict__")[sentenceOfEmptiness]
		        = attribute + " is empty: it is a result, which the first step makes; make one before it is read, as by O.run(1, wait=True).";
	return copy;
}

} // namespace yade
