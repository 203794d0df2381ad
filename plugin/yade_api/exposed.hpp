// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Base of each class of this plugin that becomes a class of YADE: known by name, saved, and shown in Python with its
// documentation.
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
// and its source file, which alone includes yade_api/registration.hpp, enters it into YADE's lists:
//
//	BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmThing)
//	static const yade::PluginClasses<yade::MpmThing> registered(__FILE__);
//
// An attribute of a YADE base class listed again, with the flag noSave because its own class saves it, gets the
// documentation and the validator given here.
//
// Optional: void postLoad(), run after loading, after construction from keywords and after assignments that ask for it;
// and template <class C> static void python(C& c), which adds methods and properties to the Python class c.
#include "yade_api/conversion.hpp"
#include "yade_api/validators.hpp"
#include "yade_api/value_lock.hpp"
#include "yade_api/yade_api.hpp"

#pragma GCC visibility push(default)
#include <boost/serialization/access.hpp>
#include <boost/serialization/export.hpp>
#pragma GCC visibility pop

namespace yade {

// Bits of an attribute's flags, with YADE's values.
enum AttributeFlag : unsigned {
	noSave          = 1, // not part of saved files
	readonly        = 2, // from Python; still saved, copied and restored
	triggerPostLoad = 4, // assignment is followed by postLoad()
	hidden          = 8, // not shown in Python
};

class AttributeTable;

// The functions without a body are in yade_api/registration.hpp: they are compiled where the class is registered, and
// nowhere else.
template <class D, class B> class Exposed : public B {
public:
	string getClassName() const override;
	string getBaseClassName(unsigned i = 0) const override;
	int    getBaseClassNumber() const override;

	void     postLoad() { }
	void     callPostLoad() override;
	void     pySetAttr(const string& name, const py::object& value) override;
	py::dict pyDict() const override;
	void     pyRegisterClass(py::object scope) override;

	// Checks all attributes of this plugin's classes again: elements of vectors can be changed in place, and values
	// can come from a file. std::invalid_argument (a ValueError in Python) as at assignment.
	virtual void requireAdmissible() const;

	template <class C> static void python(C&) { }

	// The attributes of D, which know of those of the plugin's classes that it derives from.
	static AttributeTable& table();

private:
	D&       self() { return static_cast<D&>(*this); }
	const D& self() const { return static_cast<const D&>(*this); }

	static shared_ptr<D> fromKeywords(py::tuple positional, py::dict keywords);

	friend class boost::serialization::access;
	// In one piece, as other files archive objects of the class, too.
	template <class Archive> [[gnu::noipa]] void serialize(Archive& archive, unsigned);
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

} // namespace yade
