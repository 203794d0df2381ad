// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Registration of a class of this plugin with YADE (yade_api/exposed.hpp): for the source file of the class.
#include "yade_api/attribute.hpp"
#include "yade_api/exposed.hpp"
#include "yade_api/plugin_classes.hpp"

namespace yade {

template <class D, class B> constexpr bool isExposed(const Exposed<D, B>*) { return true; }
constexpr bool                             isExposed(const void*) { return false; }

template <class D, class B> string Exposed<D, B>::getClassName() const { return D::staticName(); }
template <class D, class B> string Exposed<D, B>::getBaseClassName(unsigned i) const { return i == 0 ? B::staticName() : ""; }
template <class D, class B> int    Exposed<D, B>::getBaseClassNumber() const { return 1; }

template <class D, class B> void Exposed<D, B>::callPostLoad()
{
	B::callPostLoad();
	self().postLoad();
}

template <class D, class B> AttributeTable& Exposed<D, B>::table()
{
	static AttributeTable table = [] {
		AttributeTable made(D::staticName());
		if constexpr (isExposed(static_cast<B*>(nullptr))) made.base = &B::table();
		D::attributes(Listing<D> { made });
		return made;
	}();
	return table;
}

template <class D, class B> void Exposed<D, B>::pySetAttr(const string& name, const py::object& value)
{
	if (!table().assign(self(), name, value)) B::pySetAttr(name, value);
}

template <class D, class B> py::dict Exposed<D, B>::pyDict() const
{
	py::dict values = table().read(self());
	values.update(this->pyDictCustom());
	values.update(B::pyDict());
	return values;
}

template <class D, class B> void Exposed<D, B>::requireAdmissible() const
{
	if constexpr (isExposed(static_cast<B*>(nullptr))) B::requireAdmissible();
	// Every material point is asked at the beginning of every step: here without the table, which is asked for the
	// message.
	bool areAdmitted = true;
	D::attributes([&](const char*, [[maybe_unused]] auto member, unsigned, const char*, auto... validator) {
		areAdmitted = areAdmitted && (validator(self().*member) && ...);
	});
	if (!areAdmitted) table().requireAdmitted(self());
}

template <class D, class B> void Exposed<D, B>::pyRegisterClass(py::object scope)
{
	this->checkPyClassRegistersItself(D::staticName());
	const py::scope       inModule(scope);
	py::docstring_options docstrings;
	docstrings.enable_all();
	docstrings.disable_cpp_signatures();
	py::class_<D, shared_ptr<D>, py::bases<B>, boost::noncopyable> c(D::staticName(), D::doc(), py::no_init);
	table().addTo(c, py::make_constructor(&fromKeywords));
	D::python(c);
}

template <class D, class B> shared_ptr<D> Exposed<D, B>::fromKeywords(py::tuple positional, py::dict keywords)
{
	shared_ptr<D> object(new D);
	table().setKeywords(*object, positional, keywords);
	return object;
}

template <class D, class B> template <class Archive> void Exposed<D, B>::serialize(Archive& archive, unsigned)
{
	archive& boost::serialization::make_nvp(B::staticName(), boost::serialization::base_object<B>(self()));
	table().serialize(archive, self());
	if (Archive::is_loading::value) self().postLoad();
}

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
