// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/water/MpmWater.hpp"
#include "yade_api/python_lock.hpp"
#include "yade_api/registration.hpp"

namespace yade {

std::optional<PythonFunction> Conversion<PythonFunction>::fromPython(const py::object& value)
{
	if (value.is_none()) return PythonFunction();
	if (!PyCallable_Check(value.ptr())) return std::nullopt;
	const auto release = [](py::object* function) {
		if (!Py_IsInitialized()) return; // the interpreter has taken it along
		const PythonLock python;
		delete function;
	};
	return PythonFunction { shared_ptr<py::object>(new py::object(value), release) };
}

void MpmWater::requireAdmissible() const
{
	Exposed<MpmWater, Serializable>::requireAdmissible();
	vector<string> given;
	if (!std::isnan(level)) given.push_back("level = " + textOf(level));
	if (!levels.empty()) given.push_back("levels");
	if (pressure || !table.empty()) given.push_back(pressure ? "pressure" : "pressure (of a saved scene)");
	if (given.size() == 1) return;
	string all;
	for (const string& one : given)
		all += (all.empty() ? "" : ", ") + one;
	throw std::invalid_argument("MpmWater: one of level, levels and pressure must be given; " + (all.empty() ? "none is" : "given are " + all) + ".");
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmWater)
static const yade::PluginClasses<yade::MpmWater> registeredMpmWater(__FILE__);
