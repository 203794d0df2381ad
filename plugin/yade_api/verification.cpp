// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/verification.hpp"
#include "yade_api/conversion.hpp"
#include "yade_api/layout_check.hpp"
#include "yade_api/plugin_classes.hpp"

namespace yade {

vector<string>& pluginClassNames()
{
	static vector<string> names;
	return names;
}

// YADE registers Python classes in a loop that swallows errors, so one can be missing without a word.
static vector<string> findMissingClasses()
{
	const py::object wrapper = py::import("yade.wrapper");
	vector<string>   missing;
	for (const string& name : pluginClassNames())
		if (!PyObject_HasAttrString(wrapper.ptr(), name.c_str())) missing.push_back(name);
	return missing;
}

void verifyPlugin()
{
	const vector<string> layoutErrors = findLayoutErrors();
	if (!layoutErrors.empty())
		raisePython(PyExc_ImportError, "This build of YADE differs from the one that the plugin is made for, in: " + joined(layoutErrors) + ".");
	const vector<string> missing = findMissingClasses();
	if (!missing.empty()) raisePython(PyExc_ImportError, "YADE could not register these classes of the plugin: " + joined(missing) + ".");
}

} // namespace yade
