// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Root classes of everything that YADE creates by name, saves, and shows in Python.
//
// The order of members and of virtual functions in this folder is that of libyade.so since 2023.02a; layout_check.cpp
// and virtual_functions.cpp verify it in the running program. Functions without a body are defined there.
#include "yade_api/types.hpp"
#include <stdexcept>

#pragma GCC visibility push(default)

// The name under which YADE knows a class.
#define YADE_API_NAME(Name)                                                                                                                                    \
	static const char* staticName() { return #Name; }

// Virtual functions that every registered class of YADE overrides.
#define YADE_API_OVERRIDES(Name)                                                                                                                               \
	YADE_API_NAME(Name)                                                                                                                                    \
	void     pySetAttr(const string&, const py::object&) override;                                                                                         \
	py::dict pyDict() const override;                                                                                                                      \
	void     callPostLoad() override;                                                                                                                      \
	string   getClassName() const override;                                                                                                                \
	string   getBaseClassName(unsigned = 0) const override;                                                                                                \
	int      getBaseClassNumber() const override;                                                                                                          \
	void     pyRegisterClass(py::object) override;

// Class index of a root of dispatched classes (Material, State, Shape) ...
#define YADE_API_INDEX_ROOT                                                                                                                                    \
protected:                                                                                                                                                     \
	int& modifyClassIndex() override;                                                                                                                      \
                                                                                                                                                               \
public:                                                                                                                                                        \
	const int& getClassIndex() const override;                                                                                                             \
	const int& getBaseClassIndex(int) const override;                                                                                                      \
	const int& getMaxCurrentlyUsedClassIndexOfKin() const override;                                                                                        \
                                                                                                                                                               \
protected:                                                                                                                                                     \
	void incrementMaxCurrentlyUsedClassIndexOfKin() override;                                                                                              \
                                                                                                                                                               \
public:

// ... and of a class derived from one.
#define YADE_API_INDEX_DERIVED                                                                                                                                 \
protected:                                                                                                                                                     \
	int& modifyClassIndex() override;                                                                                                                      \
                                                                                                                                                               \
public:                                                                                                                                                        \
	const int& getClassIndex() const override;                                                                                                             \
	const int& getBaseClassIndex(int) const override;

namespace yade {

class Factorable : public boost::enable_shared_from_this<Factorable> {
public:
	Factorable() { }
	virtual ~Factorable();
	virtual string getBaseClassName(unsigned = 0) const;
	virtual int    getBaseClassNumber() const;
	virtual string getClassName() const;
};

class Serializable : public Factorable {
public:
	YADE_API_NAME(Serializable)
	Serializable() { }
	~Serializable() override;
	virtual void     pySetAttr(const string&, const py::object&);
	virtual py::dict pyDict() const;
	virtual py::dict pyDictCustom() const;
	virtual void     callPostLoad();
	virtual void     checkPyClassRegistersItself(const string&) const;
	virtual void     pyRegisterClass(py::object);
	virtual void     pyHandleCustomCtorArgs(py::tuple&, py::dict&);
	string           getClassName() const override;
	string           getBaseClassName(unsigned = 0) const override;
	int              getBaseClassNumber() const override;
	void             pyUpdateAttrs(const py::dict&);
};

// Second base of classes that YADE dispatches on by index. libyade.so does not export its vtable, so all is inline.
class Indexable {
	[[noreturn]] static void missing() { throw std::logic_error("Indexable: class index functions are not overridden"); }

protected:
	void createIndex()
	{
		int& index = modifyClassIndex();
		if (index != -1) return;
		index = getMaxCurrentlyUsedClassIndexOfKin() + 1;
		incrementMaxCurrentlyUsedClassIndexOfKin();
	}
	virtual void incrementMaxCurrentlyUsedClassIndexOfKin() { missing(); }
	virtual int& modifyClassIndex() { missing(); }

public:
	Indexable() { }
	virtual ~Indexable() { }
	virtual const int& getClassIndex() const { missing(); }
	virtual const int& getBaseClassIndex(int) const { missing(); }
	virtual const int& getMaxCurrentlyUsedClassIndexOfKin() const { missing(); }
};

static_assert(sizeof(Factorable) == 24 && sizeof(Serializable) == 24 && sizeof(Indexable) == 8, "layout of YADE");
} // namespace yade
#pragma GCC visibility pop
