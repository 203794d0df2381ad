// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/exceptions.hpp"
#include "yade_api/python_lock.hpp"
#include "yade_api/scene.hpp"

namespace yade {

// Run by Python in its main thread, between two instructions of the script.
static int raiseIfUnseen(void*)
{
	Omega& omega = Singleton<Omega>::instance();
	if (omega.isRunning()) return Py_AddPendingCall(&raiseIfUnseen, nullptr); // the exception is still on its way out of the thread

	const shared_ptr<ThreadRunner>& runner = omega.simulationLoop;
	if (!runner || !runner->workerThrew.exchange(false)) return 0; // O.wait() has raised it
	PyErr_SetString(PyExc_RuntimeError, runner->workerException.what());
	return -1;
}

void announceError()
{
	const ThreadRunner* const runner = Singleton<Omega>::instance().simulationLoop.get();
	if (PyGILState_Check() || !runner || !runner->looping) return;
	// O.run(n, wait=True) holds Python's lock until it waits: when someone has got it, this thread cannot end too early.
	withPython(runner->looping, [] { Py_AddPendingCall(&raiseIfUnseen, nullptr); }); // the call is for O.run(n)
}

} // namespace yade
