// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/exceptions.hpp"
#include "yade_api/python_lock.hpp"
#include "yade_api/scene.hpp"
#include <boost/thread/exceptions.hpp>

namespace yade {

// Run by Python in its main thread, between two instructions of the script.
static int raiseIfUnseen(void*)
{
	Omega& omega = Singleton<Omega>::instance();
	// The exception is still on its way out of the thread.
	if (omega.isRunning()) return Py_AddPendingCall(&raiseIfUnseen, nullptr);

	const shared_ptr<ThreadRunner>& runner = omega.simulationLoop;
	if (!runner || !runner->workerThrew.exchange(false)) return 0; // O.wait() has raised it
	PyErr_SetString(PyExc_RuntimeError, runner->workerException.what());
	return -1;
}

static void announceError()
{
	const ThreadRunner* const runner = Singleton<Omega>::instance().simulationLoop.get();
	// O.run(n, wait=True) holds Python's lock until it waits: when someone has got it, this thread cannot end too
	// early.
	withPython(runner->looping, [] { Py_AddPendingCall(&raiseIfUnseen, nullptr); }); // the call is for O.run(n)
}

static void keepFor(ThreadRunner& runner, const std::exception& error)
{
	announceError();
	runner.workerException = std::runtime_error(error.what());
	runner.workerThrew     = true;
	runner.looping         = false;
}

void endRun(const std::exception& error)
{
	ThreadRunner* const runner = Singleton<Omega>::instance().simulationLoop.get();
	if (PyGILState_Check() || !runner || !runner->looping) return;
	keepFor(*runner, error);
	throw boost::thread_interrupted(); // YADE would log a std::exception; this one the thread itself catches
}

// The first error of O.step(), which has returned when Python runs this.
static struct {
	std::mutex guard; // mutex of the threads of the region
	PyObject*  type = nullptr;
	string     text;
} kept;

// Asked from another thread than its main one, Python before 3.13 might make a pending call many statements later. An
// exception, which the call takes back, makes it look at once. The lock is with the thread of O.step(), which waits for
// the end of the region. Since 3.12 others cannot tell which it is.
static void setPassing([[maybe_unused]] PyObject* exception)
{
#if PY_VERSION_HEX < 0x030d0000
	if (const PyThreadState* const state = _PyThreadState_UncheckedGet()) PyThreadState_SetAsyncExc(state->thread_id, exception);
#endif
}

static int raiseKept(void*)
{
	const std::lock_guard<std::mutex> lock(kept.guard);
	setPassing(nullptr);
	PyErr_SetString(kept.type, kept.text.c_str());
	kept.type = nullptr;
	return -1;
}

// The step of O.run() that an error in an OpenMP region has ended last. Other engines in that region may fail later,
// when the script has seen the error and goes on.
static struct {
	boost::weak_ptr<const Factorable> scene;
	long                              iter = -1;

	bool is(const Scene& other) const { return scene.lock().get() == &other && iter == other.iter; }
} ended;

void raiseLater(const std::exception& error, const Scene& scene)
{
	const std::lock_guard<std::mutex> lock(kept.guard);
	ThreadRunner* const               runner = Singleton<Omega>::instance().simulationLoop.get();
	if (kept.type || ended.is(scene)) return; // one is enough
	if (runner && runner->looping) {
		ended.scene = scene.weak_from_this(), ended.iter = scene.iter;
		keepFor(*runner, error);
	} else {
		kept.type = dynamic_cast<const std::invalid_argument*>(&error) ? PyExc_ValueError : PyExc_RuntimeError;
		kept.text = error.what();
		Py_AddPendingCall(&raiseKept, nullptr);
		setPassing(PyExc_RuntimeError);
	}
}

} // namespace yade
