// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Attribute values between Python and C++, stricter than YADE's own conversion: a bool is not a number, None is not a
// bool, a string is not a sequence. Sequences come back as tuples: what is read is a copy, so appending to it must
// fail.
#include "yade_api/types.hpp"
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace yade {

[[noreturn]] inline void raisePython(PyObject* type, const string& message)
{
	PyErr_SetString(type, message.c_str());
	py::throw_error_already_set();
	std::abort(); // not reached: the line above throws
}

// repr(value), shortened to what fits into an error message
inline string repr(const py::object& value)
{
	constexpr size_t longest = 160;
	const string     text    = py::extract<string>(py::object(py::handle<>(PyObject_Repr(value.ptr()))));
	return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

// The same in threads without Python's lock: as Python writes it, but for the digits of numbers.
inline string             textOf(const string& text) { return "'" + text + "'"; }
inline string             textOf(bool value) { return value ? "True" : "False"; }
template <class T> string textOf(const shared_ptr<T>& object) { return object ? string("<") + T::staticName() + ">" : "None"; }
template <class T> std::enable_if_t<std::is_arithmetic_v<T>, string> textOf(T value)
{
	std::ostringstream text;
	text << value;
	return text.str();
}
template <class T, int Rows, int Columns> string textOf(const Eigen::Matrix<T, Rows, Columns>& value)
{
	std::ostringstream text;
	text << (Columns == 1 ? "Vector" : "Matrix") << Rows
	     << value.format(Eigen::IOFormat(Eigen::StreamPrecision, Eigen::DontAlignCols, ",", Columns == 1 ? "," : ", ", "", "", "(", ")"));
	return text.str();
}
template <class First, class Second> string textOf(const std::pair<First, Second>& value)
{
	return "(" + textOf(value.first) + ", " + textOf(value.second) + ")";
}
template <class T> string textOf(const vector<T>& values)
{
	string text;
	for (const T& value : values)
		text += (text.empty() ? "" : ", ") + textOf(value);
	return "(" + text + ")";
}

// Conversion<T>: expected() says what Python values become a T; fromPython() returns nothing for any other; toPython().
template <class T> struct Conversion;

// Types whose conversion YADE registers with boost.python.
template <class T> struct RegisteredConversion {
	static std::optional<T> fromPython(const py::object& value)
	{
		try {
			const py::extract<T> extracted(value);
			if (extracted.check()) return T(extracted());
		} catch (const py::error_already_set&) { // the converter accepted the object, but not its items
			PyErr_Clear();
		} catch (const std::exception&) { // so did that of matrices
		}
		return std::nullopt;
	}
	static py::object toPython(const T& value) { return py::object(value); }
};
template <> struct Conversion<string> : RegisteredConversion<string> {
	static string                expected() { return "a string"; }
	static std::optional<string> fromPython(const py::object& value)
	{
		// Bytes are none.
		return PyUnicode_Check(value.ptr()) ? RegisteredConversion<string>::fromPython(value) : std::nullopt;
	}
};
template <> struct Conversion<Vector3r> : RegisteredConversion<Vector3r> {
	static string expected() { return "three numbers"; }
};
template <> struct Conversion<Matrix3r> : RegisteredConversion<Matrix3r> {
	static string expected() { return "a 3x3 matrix"; }
};

template <> struct Conversion<bool> {
	static string              expected() { return "True or False"; }
	static std::optional<bool> fromPython(const py::object& value)
	{
		if (PyBool_Check(value.ptr())) return value.ptr() == Py_True;
		return std::nullopt;
	}
	static py::object toPython(bool value) { return py::object(value); }
};

template <class T> struct IntegerConversion {
	static std::optional<T> fromPython(const py::object& value)
	{
		if (PyBool_Check(value.ptr()) || !PyIndex_Check(value.ptr())) return std::nullopt;
		const py::object integer { py::handle<>(PyNumber_Index(value.ptr())) };
		int              overflow = 0;
		const long       number   = PyLong_AsLongAndOverflow(integer.ptr(), &overflow);
		if (overflow || number < std::numeric_limits<T>::min() || number > std::numeric_limits<T>::max()) return std::nullopt;
		return T(number);
	}
	static py::object toPython(T value) { return py::object(value); }
};
template <> struct Conversion<int> : IntegerConversion<int> {
	static string expected() { return "an integer"; }
};
template <> struct Conversion<long> : IntegerConversion<long> {
	static string expected() { return "an integer"; }
};

template <> struct Conversion<Real> {
	static string              expected() { return "a number"; }
	static std::optional<Real> fromPython(const py::object& value)
	{
		const PyNumberMethods* number = Py_TYPE(value.ptr())->tp_as_number;
		if (PyBool_Check(value.ptr()) || !number || !(number->nb_float || number->nb_index)) return std::nullopt;
		const Real real = PyFloat_AsDouble(value.ptr());
		if (!PyErr_Occurred()) return real;
		PyErr_Clear();
		return std::nullopt;
	}
	static py::object toPython(Real value) { return py::object(value); }
};

template <class T> struct Conversion<shared_ptr<T>> {
	static string                       expected() { return string("an object of type ") + T::staticName(); }
	static std::optional<shared_ptr<T>> fromPython(const py::object& value)
	{
		const py::extract<shared_ptr<T>> extracted(value);
		if (extracted.check()) return made(extracted);
		return std::nullopt;
	}
	// Not in one piece with its caller, where g++ 14 takes what boost makes in place for uninitialised memory.
	[[gnu::noinline]] static shared_ptr<T> made(const py::extract<shared_ptr<T>>& extracted) { return extracted(); }
	static py::object                      toPython(const shared_ptr<T>& value) { return py::object(value); }
};

// the items of any sequence but a string; nothing if it is none
inline std::optional<vector<py::object>> itemsOf(const py::object& value)
{
	if (PyUnicode_Check(value.ptr()) || PyBytes_Check(value.ptr()) || !PySequence_Check(value.ptr())) return std::nullopt;
	vector<py::object> items;
	for (py::ssize_t i = 0, size = py::len(value); i < size; i++)
		items.emplace_back(value[i]);
	return items;
}

template <class First, class Second> struct Conversion<std::pair<First, Second>> {
	using Pair = std::pair<First, Second>;
	static string              expected() { return "a pair (" + Conversion<First>::expected() + ", " + Conversion<Second>::expected() + ")"; }
	static std::optional<Pair> fromPython(const py::object& value)
	{
		const auto items = itemsOf(value);
		if (!items || items->size() != 2) return std::nullopt;
		const auto first  = Conversion<First>::fromPython((*items)[0]);
		const auto second = Conversion<Second>::fromPython((*items)[1]);
		if (!first || !second) return std::nullopt;
		return Pair(*first, *second);
	}
	static py::object toPython(const Pair& value)
	{
		return py::make_tuple(Conversion<First>::toPython(value.first), Conversion<Second>::toPython(value.second));
	}
};

template <class T> struct Conversion<vector<T>> {
	static string                   expected() { return "a sequence, each item " + Conversion<T>::expected(); }
	static std::optional<vector<T>> fromPython(const py::object& value)
	{
		const auto items = itemsOf(value);
		if (!items) return std::nullopt;
		vector<T> result;
		for (const py::object& item : *items) {
			const auto converted = item.is_none() ? std::nullopt : Conversion<T>::fromPython(item);
			if (!converted) return std::nullopt;
			result.push_back(*converted);
		}
		return result;
	}
	static py::tuple toPython(const vector<T>& value)
	{
		py::list items;
		for (const T& item : value)
			items.append(Conversion<T>::toPython(item));
		return py::tuple(items);
	}
};

// True if a value is an item of a sequence of type T: somebody has forgotten the brackets.
template <class T> struct ItemOf {
	static bool is(const py::object&) { return false; }
};
template <class T> struct ItemOf<vector<T>> {
	static bool is(const py::object& value) { return !value.is_none() && Conversion<T>::fromPython(value); }
};

} // namespace yade
