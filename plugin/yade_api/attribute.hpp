// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The attributes of a plugin class, as given by its attributes() list. What can be done with an attribute depends on
// its type; where it is, on the class.
#include "yade_api/exposed.hpp"
#include "yade_api/naming.hpp"
#include "yade_api/serialization.hpp"
#include <atomic>
#include <boost/archive/archive_exception.hpp>
#include <cstdint>
#include <memory>
#include <typeinfo>

namespace yade {

// Description of an attribute of any type.
struct ListedAttribute {
	const char* className;
	const char* name;
	unsigned    flags;
	const char* doc;
};

class Attribute : public ListedAttribute {
public:
	explicit Attribute(const ListedAttribute& listed) : ListedAttribute(listed) { }
	virtual ~Attribute() = default;
	bool is(AttributeFlag flag) const { return flags & flag; }

	// Number of values that Python has assigned, of any object; and true if it has had one by reference, which may
	// be changed at any time.
	long assignments() const { return assignments_; }
	bool isLent() const { return isLent_; }

	// TypeError or ValueError leave the old value in place.
	virtual void       assign(Serializable&, const py::object& value) const = 0;
	virtual py::object read(const Serializable&) const                      = 0;
	// std::invalid_argument, a ValueError in Python
	virtual void requireAdmitted(const Serializable&) const = 0;
	// The function of Python that gives its value.
	virtual py::object getter() const;

	virtual void serialize(boost::archive::xml_iarchive&, Serializable&) const    = 0;
	virtual void serialize(boost::archive::xml_oarchive&, Serializable&) const    = 0;
	virtual void serialize(boost::archive::binary_iarchive&, Serializable&) const = 0;
	virtual void serialize(boost::archive::binary_oarchive&, Serializable&) const = 0;

protected:
	string            qualifiedName() const { return string(className) + "." + name; }
	[[noreturn]] void refuseType(const py::object& value, const string& expected, bool isItem) const;
	[[noreturn]] void refuseValue(const string& value, const string& expected) const;

	mutable std::atomic_long assignments_ { 0 };
	mutable std::atomic_bool isLent_ { false };
};

// A member of any class derived from Serializable: what follows from its type is compiled once for all of them.
template <class T> class AttributeOf : public Attribute {
public:
	using Member = T Serializable::*;

	AttributeOf(const ListedAttribute& listed, Member member) : Attribute(listed), member_(member) { }
	void       assign(Serializable& object, const py::object& value) const override;
	py::object read(const Serializable& object) const override;
	void       requireAdmitted(const Serializable& object) const override;
	py::object getter() const override;

	void serialize(boost::archive::xml_iarchive& archive, Serializable& object) const override;
	void serialize(boost::archive::xml_oarchive& archive, Serializable& object) const override;
	void serialize(boost::archive::binary_iarchive& archive, Serializable& object) const override;
	void serialize(boost::archive::binary_oarchive& archive, Serializable& object) const override;

private:
	virtual bool   admits(const T&) const = 0;
	virtual string admitted() const       = 0;

	T&                      in(Serializable& object) const { return object.*member_; }
	T                       copy(const Serializable& object) const;
	void                    requireAdmitted(const T& value) const;
	template <class A> void serializeBy(A& archive, Serializable& object) const;

	Member member_;
};

// Defined outside the class: bodies inside are inline, and each file would compile them in spite of `extern template`.
template <class T> void AttributeOf<T>::assign(Serializable& object, const py::object& value) const
{
	const std::optional<T> converted = Conversion<T>::fromPython(value);
	if (!converted) refuseType(value, Conversion<T>::expected(), ItemOf<T>::is(value));
	requireAdmitted(*converted);
	const ValueLock lock;
	in(object) = *converted;
	++assignments_;
}

template <class T> py::object AttributeOf<T>::read(const Serializable& object) const
{
	const T    value     = copy(object);
	const auto converted = Conversion<T>::toPython(value);
	if constexpr (std::is_same_v<decltype(converted), const py::tuple>) return copyOfAttribute(converted, qualifiedName(), is(readonly));
	else
		return converted;
}

// Vectors and matrices that may be written come by reference, as in YADE: b.state.force[1] = 3
template <class T> py::object AttributeOf<T>::getter() const
{
	if constexpr (std::is_same_v<T, Vector3r> || std::is_same_v<T, Matrix3r>)
		if (!is(readonly)) {
			const auto reference = [this](Serializable& object) -> T& {
				isLent_ = true;
				return in(object);
			};
			return py::make_function(reference, py::return_internal_reference<>(), boost::mpl::vector2<T&, Serializable&>());
		}
	return Attribute::getter();
}

template <class T> T AttributeOf<T>::copy(const Serializable& object) const
{
	const ValueLock lock;
	return in(const_cast<Serializable&>(object));
}

template <class T> void AttributeOf<T>::requireAdmitted(const Serializable& object) const { requireAdmitted(in(const_cast<Serializable&>(object))); }
template <class T> void AttributeOf<T>::requireAdmitted(const T& value) const
{
	if (admits(value)) return;
	// An engine in the background must not wait for Python's lock, which O.reset() keeps while it waits for the
	// engine.
	refuseValue(PyGILState_Check() ? repr(Conversion<T>::toPython(value)) : textOf(value), admitted());
}

template <class T> template <class Archive> void AttributeOf<T>::serializeBy(Archive& archive, Serializable& object) const
{
	if (!is(noSave)) archive& boost::serialization::make_nvp(name, in(object));
}
template <class T> void AttributeOf<T>::serialize(boost::archive::xml_iarchive& archive, Serializable& object) const { serializeBy(archive, object); }
template <class T> void AttributeOf<T>::serialize(boost::archive::xml_oarchive& archive, Serializable& object) const { serializeBy(archive, object); }
template <class T> void AttributeOf<T>::serialize(boost::archive::binary_iarchive& archive, Serializable& object) const { serializeBy(archive, object); }
template <class T> void AttributeOf<T>::serialize(boost::archive::binary_oarchive& archive, Serializable& object) const { serializeBy(archive, object); }

// Types of attributes that several files have: compiled in yade_api/attribute_types.cpp only.
extern template class AttributeOf<bool>;
extern template class AttributeOf<int>;
extern template class AttributeOf<Real>;
extern template class AttributeOf<string>;
extern template class AttributeOf<Vector3r>;
extern template class AttributeOf<vector<Real>>;
extern template class AttributeOf<vector<string>>;
extern template class AttributeOf<vector<Vector3r>>;
extern template class AttributeOf<vector<vector<int>>>;
extern template class AttributeOf<vector<std::pair<Real, Real>>>;
extern template class AttributeOf<vector<std::pair<string, Real>>>;

template <class T, class Validator> class ValidatedAttribute final : public AttributeOf<T> {
public:
	ValidatedAttribute(const ListedAttribute& listed, typename AttributeOf<T>::Member member, const Validator& validator)
	        : AttributeOf<T>(listed, member), validator_(validator)
	{
	}

private:
	bool   admits(const T& value) const override { return validator_(value); }
	string admitted() const override { return validator_.description(); }

	Validator validator_;
};

class AttributeTable {
public:
	AttributeTable* base = nullptr; // table of the plugin's class that this one derives from

	explicit AttributeTable(const char* ofClass) : className_(ofClass) { }

	template <class T, class Validator> void add(const char* name, T Serializable::*member, unsigned flags, const char* doc, const Validator& validator)
	{
		keep(new ValidatedAttribute<T, Validator>({ className_, name, flags, doc }, member, validator));
		if (!(flags & noSave)) mark(name), mark(typeid(T).name());
	}

	// Query and access by name.
	bool     assign(Serializable&, const string& name, const py::object& value) const;
	py::dict read(const Serializable&) const;
	void     requireAdmitted(const Serializable&) const;

	// Sums over all attributes, see Attribute.
	long assignments() const;
	bool areLent() const;

	// Makes the class of Python: properties, and the constructor by keywords.
	void addTo(const py::object& c, const py::object& construct);
	void setKeywords(Serializable&, const py::tuple& positional, const py::dict& keywords) const;

	// A scene is read by the table that it was saved by, or refused.
	template <class Archive> void serialize(Archive& archive, Serializable& object) const
	{
		serializeFormat(archive);
		for (const auto& attribute : attributes_)
			attribute->serialize(archive, object);
	}

private:
	template <class Archive> void serializeFormat(Archive& archive) const
	{
		std::uint64_t format = format_;
		try {
			archive& boost::serialization::make_nvp("format", format);
		} catch (const boost::archive::archive_exception&) { // XML that has something else in this place
			if (!Archive::is_loading::value) throw;
			format = 0;
		}
		if (format != format_) refuseFormat();
	}
	[[noreturn]] void refuseFormat() const;
	// Names and types of what is saved, in their order, make the format (hash FNV-1a).
	void mark(const char* text);

	// Attributes, those of the plugin's classes that it derives from included: settings, or results that can only
	// be read.
	string            names(bool areReadonly) const;
	const Attribute*  find(const string& name) const;
	void              keep(const Attribute*);
	static void       addProperty(py::object c, const Attribute&);
	void              requireSettable(const string& name) const;
	[[noreturn]] void raiseUnknown(const string& name) const;
	py::object        refuseUnknown(const py::object&, const string& name) const;
	void              setKnownAttribute(const py::object&, const string& name, const py::object& value) const;

	const char*                                   className_;
	PyTypeObject*                                 type_   = nullptr; // once there is a class of Python
	std::uint64_t                                 format_ = 14695981039346656037u;
	std::vector<std::unique_ptr<const Attribute>> attributes_;
};

// Adds what D lists: members of its own or of a base, which need not be derived from Serializable itself.
template <class D> struct Listing {
	AttributeTable& table;

	template <class T, class Owner, class Validator = AnyValue>
	void operator()(const char* name, T Owner::*member, unsigned flags, const char* doc, const Validator& validator = {}) const
	{
		table.add(name, static_cast<T Serializable::*>(static_cast<T D::*>(member)), flags, doc, validator);
	}
};

} // namespace yade
