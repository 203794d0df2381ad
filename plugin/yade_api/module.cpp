// SPDX-License-Identifier: GPL-2.0-or-later
// The plugin is also a Python extension module, imported by yade.mpm for what can be checked only when YADE has started.
#include "yade_api/layout_check.hpp"
#include "yade_api/registration.hpp"

namespace yade {

static string joined(const vector<string>& items)
{
	string text;
	for (const string& item : items)
		text += (text.empty() ? "" : ", ") + item;
	return text;
}

// YADE registers Python classes in a loop that swallows errors, so a class can be missing without a word.
static vector<string> findMissingClasses()
{
	const py::object wrapper = py::import("yade.wrapper");
	vector<string>   missing;
	for (const string& name : pluginClassNames())
		if (!PyObject_HasAttrString(wrapper.ptr(), name.c_str())) missing.push_back(name);
	return missing;
}

static void verify()
{
	const vector<string> layoutErrors = findLayoutErrors();
	if (!layoutErrors.empty())
		raisePython(PyExc_ImportError, "This build of YADE differs from the one that the plugin is made for, in: " + joined(layoutErrors) + ".");
	const vector<string> missing = findMissingClasses();
	if (!missing.empty()) raisePython(PyExc_ImportError, "YADE could not register these classes of the plugin: " + joined(missing) + ".");
}

} // namespace yade

BOOST_PYTHON_MODULE(mpm_engine)
{
	boost::python::def("verify", &yade::verify, "ImportError if YADE does not fit the plugin, or has not registered all of its classes.");
}
