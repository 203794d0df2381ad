// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/exceptions.hpp"
#include "yade_api/scene.hpp"

namespace yade {

// Run by Python in its main thread, between two instructions of the script.
static int raisePending(void*)
{
	Omega& omega = Singleton<Omega>::instance();
	if (omega.isRunning()) return Py_AddPendingCall(&raisePending, nullptr); // the exception is still on its way out of the thread

	const shared_ptr<ThreadRunner>& runner = omega.simulationLoop;
	if (!runner || !runner->workerThrew.exchange(false)) return 0; // O.wait() has raised it
	PyErr_SetString(PyExc_RuntimeError, runner->workerException.what());
	return -1;
}

void raiseInMainThread()
{
	if (Singleton<Omega>::instance().isRunning()) Py_AddPendingCall(&raisePending, nullptr);
}

} // namespace yade
