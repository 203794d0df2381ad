// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// How a class of this plugin becomes a class of YADE: known by name, saved, and shown in Python with its documentation.
//
// The header of a class says what it is:
//
//	class MpmThing : public Exposed<MpmThing, Serializable> { // ExposedIndexed for kinds of Material, State and Shape
//	public:
//		Real size = 1;
//		YADE_API_NAME(MpmThing)
//		static const char* doc() { return "A thing."; }
//		template <class V> static void attributes(V&& v) { v("size", &MpmThing::size, 0, "Size [m], > 0.", positive); }
//	};
//
//	BOOST_CLASS_EXPORT_KEY(yade::MpmThing)
//
// and its source file enters it into YADE's lists:
//
//	BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmThing)
//	static const yade::PluginClasses<yade::MpmThing> registered(__FILE__);
//
// An attribute of a YADE base class listed again, with the flag noSave because its own class saves it, gets the documentation and
// the validator given here.
//
// Optional: void postLoad(), run after loading, after construction from keywords and after assignments that ask for it; and
// template <class C> static void python(C& c), which adds methods and properties to the Python class c.
#include "yade_api/attribute.hpp"
#include "yade_api/plugin_classes.hpp"
#include "yade_api/serialization.hpp"

#pragma GCC visibility push(default)
#include <boost/python/raw_function.hpp>
#pragma GCC visibility pop

namespace yade {

template <class D, class B> class Exposed : public B {
public:
	string getClassName() const override { return D::staticName(); }
	string getBaseClassName(unsigned i = 0) const override { return i == 0 ? B::staticName() : ""; }
	int    getBaseClassNumber() const override { return 1; }

	void postLoad() { }
	void callPostLoad() override
	{
		B::callPostLoad();
		self().postLoad();
	}

	void pySetAttr(const string& name, const py::object& value) override
	{
		bool found = false;
		forEachAttribute([&](const auto& attribute) {
			if (found || name != attribute.name) return;
			attribute.assign(self(), value);
			found = true;
		});
		if (!found) B::pySetAttr(name, value);
	}

	py::dict pyDict() const override
	{
		py::dict values;
		forEachAttribute([&](const auto& attribute) {
			if (!attribute.is(hidden)) values[attribute.name] = toPython(attribute);
		});
		values.update(this->pyDictCustom());
		values.update(B::pyDict());
		return values;
	}

	// Checks all attributes of this plugin's classes again: elements of vectors can be changed in place, and values can come
	// from a file. std::invalid_argument (a ValueError in Python) as at assignment.
	virtual void requireAdmissible() const
	{
		if constexpr (baseIsExposed(static_cast<B*>(nullptr))) B::requireAdmissible();
		forEachAttribute([&](const auto& attribute) { attribute.requireAdmitted(self().*attribute.member); });
	}

	template <class C> static void python(C&) { }

	void pyRegisterClass(py::object scope) override
	{
		this->checkPyClassRegistersItself(D::staticName());
		const py::scope       inModule(scope);
		py::docstring_options docstrings;
		docstrings.enable_all();
		docstrings.disable_cpp_signatures();
		PythonClass c(D::staticName(), D::doc(), py::no_init);
		c.def("__init__", py::raw_function(Initializer { py::make_constructor(&fromKeywords) }, 1));
		c.def("__setattr__", &setKnownAttribute);
		c.def("__getattr__", &refuseUnknown);
		forEachAttribute([&](const auto& attribute) { addProperty(c, attribute); });
		D::python(c);
	}

protected:
	// names of the attributes of D and of the plugin's classes that it derives from: settings, or results that can only be read
	static string attributeNames(bool areReadonly)
	{
		string names;
		if constexpr (baseIsExposed(static_cast<B*>(nullptr))) names = B::attributeNames(areReadonly);
		forEachAttribute([&](const auto& attribute) {
			const bool isListed = (", " + names + ",").find(", " + string(attribute.name) + ",") != string::npos; // that of a base
			if (attribute.is(hidden) || attribute.is(readonly) != areReadonly || isListed) return;
			names += (names.empty() ? "" : ", ") + string(attribute.name);
		});
		return names;
	}

	static string documentation(const string& name)
	{
		string result;
		if constexpr (baseIsExposed(static_cast<B*>(nullptr))) result = B::documentation(name);
		forEachAttribute([&](const auto& attribute) {
			if (name == attribute.name) result = attribute.doc;
		});
		return result;
	}

	static bool isReadonly(const string& name)
	{
		bool result = false;
		if constexpr (baseIsExposed(static_cast<B*>(nullptr))) result = B::isReadonly(name);
		forEachAttribute([&](const auto& attribute) {
			if (name == attribute.name) result = attribute.is(readonly);
		});
		return result;
	}

private:
	using PythonClass = py::class_<D, shared_ptr<D>, py::bases<B>, boost::noncopyable>;

	D&       self() { return static_cast<D&>(*this); }
	const D& self() const { return static_cast<const D&>(*this); }

	template <class D2, class B2> static constexpr bool baseIsExposed(const Exposed<D2, B2>*) { return true; }
	static constexpr bool                               baseIsExposed(const void*) { return false; }

	// calls f with each attribute of D, not those of its base
	template <class F> static void forEachAttribute(F&& f)
	{
		D::attributes([&](auto... listed) { f(makeAttribute<D>(listed...)); });
	}

	friend class boost::serialization::access;
	template <class Archive> void serialize(Archive& archive, unsigned)
	{
		using boost::serialization::make_nvp;
		archive& make_nvp(B::staticName(), boost::serialization::base_object<B>(self()));
		forEachAttribute([&](const auto& attribute) {
			if (!attribute.is(noSave)) archive& make_nvp(attribute.name, self().*attribute.member);
		});
		if (Archive::is_loading::value) self().postLoad();
	}

	template <class A> py::object toPython(const A& attribute) const { return attribute.read(self()); }

	template <class A> static void addProperty(PythonClass& c, const A& attribute)
	{
		using T = typename A::Type;
		if (attribute.is(hidden)) return;
		const string doc = string(attribute.doc) + " :yattrflags:`" + std::to_string(attribute.flags) + "`"; // YADE's inspector reads the flags

		// Vectors and matrices that may be written come by reference, as in YADE: b.state.force[1] = 3
		constexpr bool hasElements = std::is_same_v<T, Vector3r> || std::is_same_v<T, Matrix3r>;
		const bool     inPlace     = hasElements && !attribute.is(readonly);
		const auto     converted   = [attribute](const D& object) { return object.toPython(attribute); };
		using Signature            = boost::mpl::vector2<py::object, const D&>;
		py::object get = inPlace ? py::make_getter(attribute.member) : py::make_function(converted, py::default_call_policies(), Signature());
		if (attribute.is(readonly)) {
			c.add_property(attribute.name, get, doc.c_str());
			return;
		}
		py::object set = py::make_function(
		        [attribute](D& object, const py::object& value) {
			        attribute.assign(object, value);
			        if (attribute.is(triggerPostLoad)) object.callPostLoad();
		        },
		        py::default_call_policies(), boost::mpl::vector3<void, D&, const py::object&>());
		c.add_property(attribute.name, get, set, doc.c_str());
	}

	// boost.python passes the new object as first positional argument; the constructor wants (object, positional, keywords)
	struct Initializer {
		py::object construct;
		py::object operator()(const py::tuple& positional, const py::dict& keywords) const
		{
			return construct(py::object(positional[0]), py::tuple(positional.slice(1, py::_)), keywords);
		}
	};

	static shared_ptr<D> fromKeywords(py::tuple positional, py::dict keywords)
	{
		shared_ptr<D> object(new D);
		object->pyHandleCustomCtorArgs(positional, keywords);
		if (py::len(positional) > 0) raisePython(PyExc_TypeError, string(D::staticName()) + " takes keyword arguments only, as in ...(name=value).");
		const py::list names = keywords.keys();
		for (py::ssize_t i = 0; i < py::len(names); i++)
			requireSettable(py::extract<string>(names[i]));
		object->pyUpdateAttrs(keywords);
		return object;
	}

	static PyTypeObject* pythonType() { return py::converter::registered<D>::converters.get_class_object(); }

	static void requireSettable(const string& name)
	{
		if (!PyObject_HasAttrString(reinterpret_cast<PyObject*>(pythonType()), name.c_str())) raiseUnknown(name);
		if (isReadonly(name)) raisePython(PyExc_AttributeError, string(D::staticName()) + "." + name + " can only be read. " + documentation(name));
	}

	[[noreturn]] static void raiseUnknown(const string& name)
	{
		const string meant = didYouMean(name, namesIn(pythonType())), results = attributeNames(true), settings = attributeNames(false);
		raisePython(
		        PyExc_AttributeError,
		        string(D::staticName()) + " has no attribute '" + name + "'" + (meant.empty() ? "." : meant)
		                + (settings.empty() ? "" : " Its settings: " + settings + ".")
		                + (results.empty() ? "" : " Results, to be read: " + results + "."));
	}

	// Asked by Python for what it does not find. Names with underscores are those that it looks for itself.
	static py::object refuseUnknown(const py::object& object, const string& name)
	{
		if (Py_TYPE(object.ptr()) == pythonType() && name.rfind('_', 0) != 0) raiseUnknown(name);
		raisePython(PyExc_AttributeError, "'" + string(Py_TYPE(object.ptr())->tp_name) + "' object has no attribute '" + name + "'");
	}

	// A misspelt name would otherwise become a new Python attribute without effect. Classes derived in Python may add theirs.
	static void setKnownAttribute(const py::object& object, const string& name, const py::object& value)
	{
		if (Py_TYPE(object.ptr()) == pythonType()) requireSettable(name);
		if (PyObject_GenericSetAttr(object.ptr(), py::object(name).ptr(), value.ptr()) != 0) py::throw_error_already_set();
	}
};

// The same with an index by which YADE's dispatchers tell kinds of Material, State and Shape apart.
template <class D, class B> class ExposedIndexed : public Exposed<D, B> {
	static int& index()
	{
		static int assigned = -1;
		return assigned;
	}

protected:
	int& modifyClassIndex() override { return index(); }

public:
	ExposedIndexed() { this->createIndex(); }
	static const int& getClassIndexStatic() { return index(); }
	const int&        getClassIndex() const override { return index(); }
	const int&        getBaseClassIndex(int depth) const override
	{
		static const shared_ptr<B> base(new B);
		return depth == 1 ? base->getClassIndex() : base->getBaseClassIndex(depth - 1);
	}
};

// A static object of this type makes classes known to YADE when the plugin is opened.
template <class... Classes> struct PluginClasses {
	explicit PluginClasses(const char* file)
	{
		ClassFactory& factory = Singleton<ClassFactory>::instance();
		(factory.registerFactorable(
		         Classes::staticName(), []() -> Factorable* { return new Classes; },
		         []() -> shared_ptr<Factorable> { return shared_ptr<Classes>(new Classes); }, []() -> void* { return new Classes; }),
		 ...);
		(pluginClassNames().push_back(Classes::staticName()), ...);
		const char* fileAndClasses[] = { file, Classes::staticName()..., nullptr };
		factory.registerPluginClasses(fileAndClasses);
	}
};

} // namespace yade
