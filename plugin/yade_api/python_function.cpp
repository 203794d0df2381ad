// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/python_function.hpp"
#include "yade_api/python_lock.hpp"
#include "yade_api/scene.hpp"

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

namespace {
	// Values of a function at these positions, or why there are none.
	struct Evaluation {
		PythonFunction   function;
		vector<Vector3r> positions;
		ExpectedValue    expected;
		vector<Real>     values {};
		string           error {};

		void evaluate()
		{
			for (const Vector3r& x : positions) {
				string answer;
				try {
					const py::object value  = (*function.object)(x);
					const auto       number = Conversion<Real>::fromPython(value);
					if (number && expected.isAdmitted(*number)) {
						values.push_back(*number);
						continue;
					}
					answer = "returned " + repr(value);
				} catch (const py::error_already_set&) {
					answer = "raised " + raised();
				}
				error = answer + " at " + textOf(x) + ": expected " + expected.text + ".";
				return;
			}
		}

	private:
		static string raised()
		{
			PyObject *type, *value, *traceback;
			PyErr_Fetch(&type, &value, &traceback);
			PyErr_NormalizeException(&type, &value, &traceback);
			const py::handle<> keep[] = { py::handle<>(type), py::handle<>(py::allow_null(value)), py::handle<>(py::allow_null(traceback)) };
			return repr(py::object(py::handle<>(py::borrowed(value ? value : type))));
		}
	};
}

vector<Real> evaluate(const PythonFunction& function, vector<Vector3r> positions, const string& name, const ExpectedValue& expected)
{
	// Shared with a thread that may end the evaluation when nobody waits for it any more.
	const auto evaluation = std::make_shared<Evaluation>(Evaluation { function, std::move(positions), expected });
	if (PyGILState_Check()) evaluation->evaluate();
	else
		withPython(Singleton<Omega>::instance().simulationLoop->looping, [evaluation] { evaluation->evaluate(); });
	if (!evaluation->error.empty()) throw std::invalid_argument(name + " " + evaluation->error);
	if (evaluation->values.size() < evaluation->positions.size())
		throw std::invalid_argument(name + " is not known: the run was ended before it had answered.");
	return evaluation->values;
}

} // namespace yade
