// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// One attribute of a plugin class, as given by the attributes() list of that class.
#include "yade_api/conversion.hpp"
#include "yade_api/naming.hpp"
#include "yade_api/validators.hpp"
#include "yade_api/value_lock.hpp"
#include <stdexcept>

namespace yade {

// Bits of an attribute's flags, with YADE's values.
enum AttributeFlag : unsigned {
	noSave          = 1, // not part of saved files
	readonly        = 2, // from Python; still saved, copied and restored
	triggerPostLoad = 4, // assignment is followed by postLoad()
	hidden          = 8, // not shown in Python
};

template <class D, class T> using MemberOf = T D::*;

template <class D, class T, class Validator> struct Attribute {
	using Type = T;

	const char*          name;
	const MemberOf<D, T> member;
	unsigned             flags;
	const char*          doc;
	Validator            validator;

	bool is(AttributeFlag flag) const { return flags & flag; }

	// TypeError or ValueError leave the old value in place.
	void assign(D& object, const py::object& value) const
	{
		const std::optional<T> converted = Conversion<T>::fromPython(value);
		if (!converted)
			raisePython(
			        PyExc_TypeError,
			        qualifiedName() + " = " + repr(value) + ": expected " + Conversion<T>::expected() + "."
			                + (ItemOf<T>::is(value) ? " For one item write [item]." : ""));
		requireAdmitted(*converted);
		const ValueLock lock;
		object.*member = *converted;
	}

	py::object read(const D& object) const
	{
		const T    value     = copy(object);
		const auto converted = Conversion<T>::toPython(value);
		if constexpr (std::is_same_v<decltype(converted), const py::tuple>) return copyOfAttribute(converted, qualifiedName(), is(readonly));
		else
			return converted;
	}

	// A Python ValueError.
	void requireAdmitted(const T& value) const
	{
		if (validator(value)) return;
		// An engine in the background must not wait for Python's lock, which O.reset() keeps while it waits for the engine.
		const string text = PyGILState_Check() ? repr(Conversion<T>::toPython(value)) : textOf(value);
		throw std::invalid_argument(qualifiedName() + " = " + text + " is not admitted: expected " + validator.description() + ".");
	}

private:
	T copy(const D& object) const
	{
		const ValueLock lock;
		return object.*member;
	}
	string qualifiedName() const { return string(D::staticName()) + "." + name; }
};

template <class D, class T, class Owner, class Validator = AnyValue>
Attribute<D, T, Validator> makeAttribute(const char* name, MemberOf<Owner, T> member, unsigned flags, const char* doc, Validator validator = {})
{
	return { name, member, flags, doc, validator };
}

} // namespace yade
