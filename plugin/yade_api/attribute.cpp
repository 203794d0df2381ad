// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/attribute.hpp"
#include <numeric>
#include <stdexcept>

#pragma GCC visibility push(default)
#include <boost/python/raw_function.hpp>
#pragma GCC visibility pop

namespace yade {
namespace {

	// boost.python passes the new object as first positional argument; the constructor wants (object, positional,
	// keywords)
	struct Initializer {
		py::object construct;
		py::object operator()(const py::tuple& positional, const py::dict& keywords) const
		{
			return construct(py::object(positional[0]), py::tuple(positional.slice(1, py::_)), keywords);
		}
	};

	// The name of the first class derived from a type that has an attribute, or nothing.
	string derivedWith(PyTypeObject* type, const string& name)
	{
		const py::object classes = py::object(py::handle<>(py::borrowed(reinterpret_cast<PyObject*>(type)))).attr("__subclasses__")();
		for (py::ssize_t i = 0; i < py::len(classes); ++i)
			if (const py::object one = classes[i]; PyObject_HasAttrString(one.ptr(), name.c_str()))
				return py::extract<string>(one.attr("__name__"));
		return "";
	}

} // namespace

py::object Attribute::getter() const
{
	const auto converted = [this](const Serializable& object) { return read(object); };
	return py::make_function(converted, py::default_call_policies(), boost::mpl::vector2<py::object, const Serializable&>());
}

void Attribute::refuseType(const py::object& value, const string& expected, bool isItem) const
{
	raisePython(PyExc_TypeError, qualifiedName() + " = " + repr(value) + ": expected " + expected + "." + (isItem ? " For one item write [item]." : ""));
}

void Attribute::refuseValue(const string& value, const string& expected) const
{
	throw std::invalid_argument(qualifiedName() + " = " + value + " is not admitted: expected " + expected + ".");
}

bool AttributeTable::assign(Serializable& object, const string& name, const py::object& value) const
{
	for (const auto& attribute : attributes_)
		if (name == attribute->name) {
			attribute->assign(object, value);
			return true;
		}
	return false;
}

py::dict AttributeTable::read(const Serializable& object) const
{
	py::dict values;
	for (const auto& attribute : attributes_)
		if (!attribute->is(hidden)) values[attribute->name] = attribute->read(object);
	return values;
}

void AttributeTable::requireAdmitted(const Serializable& object) const
{
	for (const auto& attribute : attributes_)
		attribute->requireAdmitted(object);
}

long AttributeTable::assignments() const
{
	return std::accumulate(attributes_.begin(), attributes_.end(), 0L, [](long sum, const auto& attribute) { return sum + attribute->assignments(); });
}

bool AttributeTable::areLent() const
{
	return std::any_of(attributes_.begin(), attributes_.end(), [](const auto& attribute) { return attribute->isLent(); });
}

void AttributeTable::mark(const char* text)
{
	do
		format_ = (format_ ^ static_cast<unsigned char>(*text)) * 1099511628211u;
	while (*text++);
}

void AttributeTable::refuseFormat() const
{
	throw std::runtime_error(
	        string(className_)
	        + " was saved by another version of yade-mpm, in which it had other attributes, or the file is damaged: load the scene by that version, or run its script again.");
}

void AttributeTable::keep(const Attribute* attribute) { attributes_.emplace_back(attribute); }

string AttributeTable::names(bool areReadonly) const
{
	string names = base ? base->names(areReadonly) : "";
	for (const auto& attribute : attributes_) {
		// Skips an attribute that a base has listed.
		const bool isListed = (", " + names + ",").find(", " + string(attribute->name) + ",") != string::npos;
		if (attribute->is(hidden) || attribute->is(readonly) != areReadonly || isListed) continue;
		names += (names.empty() ? "" : ", ") + string(attribute->name);
	}
	return names;
}

const Attribute* AttributeTable::find(const string& name) const
{
	for (const auto& attribute : attributes_)
		if (name == attribute->name) return attribute.get();
	return base ? base->find(name) : nullptr;
}

void AttributeTable::addProperty(py::object c, const Attribute& attribute)
{
	if (attribute.is(hidden)) return;
	// YADE's inspector reads the flags.
	const string doc = string(attribute.doc) + " :yattrflags:`" + std::to_string(attribute.flags) + "`";
	py::object   setter;
	if (!attribute.is(readonly)) {
		const auto set = [&attribute](Serializable& object, const py::object& value) {
			attribute.assign(object, value);
			if (attribute.is(triggerPostLoad)) object.callPostLoad();
		};
		setter = py::make_function(set, py::default_call_policies(), boost::mpl::vector3<void, Serializable&, const py::object&>());
	}
	const py::object property { py::handle<>(py::borrowed(reinterpret_cast<PyObject*>(&PyProperty_Type))) };
	c.attr(attribute.name) = property(attribute.getter(), setter, py::object(), doc);
}

void AttributeTable::addTo(const py::object& c, const py::object& construct)
{
	type_ = reinterpret_cast<PyTypeObject*>(c.ptr());
	py::objects::add_to_namespace(c, "__init__", py::raw_function(Initializer { construct }, 1));
	const auto set  = [this](const py::object& object, const string& name, const py::object& value) { setKnownAttribute(object, name, value); };
	using Signature = boost::mpl::vector4<void, const py::object&, const string&, const py::object&>;
	py::objects::add_to_namespace(c, "__setattr__", py::make_function(set, py::default_call_policies(), Signature()));
	const auto get = [this](const py::object& object, const string& name) { return refuseUnknown(object, name); };
	using Reading  = boost::mpl::vector3<py::object, const py::object&, const string&>;
	py::objects::add_to_namespace(c, "__getattr__", py::make_function(get, py::default_call_policies(), Reading()));
	for (const auto& attribute : attributes_)
		addProperty(c, *attribute);
}

void AttributeTable::setKeywords(Serializable& object, const py::tuple& positional, const py::dict& keywords) const
{
	py::tuple rest  = positional;
	py::dict  named = keywords;
	object.pyHandleCustomCtorArgs(rest, named);
	if (py::len(rest) > 0) raisePython(PyExc_TypeError, string(className_) + " takes keyword arguments only, as in ...(name=value).");
	const py::list names = named.keys();
	for (py::ssize_t i = 0; i < py::len(names); i++)
		requireSettable(py::extract<string>(names[i]));
	object.pyUpdateAttrs(named);
}

void AttributeTable::requireSettable(const string& name) const
{
	if (!PyObject_HasAttrString(reinterpret_cast<PyObject*>(type_), name.c_str())) raiseUnknown(name);
	if (const Attribute* found = find(name); found && found->is(readonly))
		raisePython(PyExc_AttributeError, string(className_) + "." + name + " can only be read. " + found->doc);
}

void AttributeTable::raiseUnknown(const string& name) const
{
	const string owner = derivedWith(type_, name);
	const string meant = owner.empty() ? didYouMean(name, namesIn(type_)) : ", as " + owner + " has.", results = names(true), settings = names(false);
	raisePython(
	        PyExc_AttributeError,
	        string(className_) + " has no attribute '" + name + "'" + (meant.empty() ? "." : meant)
	                + (settings.empty() ? "" : " Its settings: " + settings + ".") + (results.empty() ? "" : " Results, to be read: " + results + "."));
}

// Asked by Python for what it does not find. Names with underscores are those that it looks for itself.
py::object AttributeTable::refuseUnknown(const py::object& object, const string& name) const
{
	if (Py_TYPE(object.ptr()) == type_ && name.rfind('_', 0) != 0) raiseUnknown(name);
	raisePython(PyExc_AttributeError, "'" + string(Py_TYPE(object.ptr())->tp_name) + "' object has no attribute '" + name + "'");
}

// A misspelt name would otherwise become a new Python attribute without effect. Classes derived in Python may add
// theirs.
void AttributeTable::setKnownAttribute(const py::object& object, const string& name, const py::object& value) const
{
	if (Py_TYPE(object.ptr()) == type_) requireSettable(name);
	if (PyObject_GenericSetAttr(object.ptr(), py::object(name).ptr(), value.ptr()) != 0) py::throw_error_already_set();
}

} // namespace yade
