// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/interruption.hpp"
#include "yade_api/exceptions.hpp"
#include "yade_api/python_lock.hpp"
#include <boost/python/exception_translator.hpp>
#include <boost/thread/exceptions.hpp>
#include <csignal>
#include <thread>

namespace yade {

namespace {
	std::atomic_int  presses { 0 };         // presses of Ctrl-C
	std::atomic_bool hasEndedRun { false }; // true if Ctrl-C has ended a run, and Python has not been told yet
	struct sigaction python = {};           // Python's handler, which ours stands in front of
	thread_local int seen   = -1;           // presses before this thread, which lives as long as one O.run(), or handled by Python

	void onPress(int number, siginfo_t* info, void* context)
	{
		++presses;
		if (python.sa_flags & SA_SIGINFO) python.sa_sigaction(number, info, context);
		else
			python.sa_handler(number);
	}

	// A handler of somebody else than Python is left alone, and so is the absence of one.
	void listen()
	{
		struct sigaction current = {};
		sigaction(SIGINT, nullptr, &current);
		const bool isOurs = (current.sa_flags & SA_SIGINFO) && current.sa_sigaction == &onPress;
		if (isOurs || current.sa_handler == SIG_DFL || current.sa_handler == SIG_IGN) return;
		if (python.sa_handler && current.sa_handler != python.sa_handler) return;
		python                = current;
		struct sigaction ours = current;
		ours.sa_flags |= SA_SIGINFO;
		ours.sa_sigaction = &onPress;
		sigaction(SIGINT, &ours, nullptr);
	}

	// True if Ctrl-C is for the run: YADE waits for it in Python's main thread, and the script has no handler of
	// its own. Otherwise Python has handled the signal, since its main thread executes Python: then it executes the
	// call below, too.
	bool isForTheRun(const std::atomic_bool& isRunning)
	{
		struct Answers {
			std::atomic_bool wouldRaise { false }, executes { false };
		};
		static Answers answers;
		answers.wouldRaise = answers.executes = false;
		withPython(isRunning, [] {
			try {
				const py::object signal = py::import("signal");
				answers.wouldRaise      = signal.attr("getsignal")(SIGINT) == signal.attr("default_int_handler");
			} catch (const py::error_already_set&) {
				PyErr_Clear();
			}
			Py_AddPendingCall(
			        [](void*) {
				        answers.executes = true;
				        return 0;
			        },
			        nullptr);
		});
		for (int i = 0; i < 100 && answers.wouldRaise && !answers.executes; ++i)
			std::this_thread::sleep_for(std::chrono::milliseconds(1));
		return answers.wouldRaise && !answers.executes;
	}

	void translate(const std::runtime_error&)
	{
		if (!hasEndedRun.exchange(false) || PyErr_CheckSignals() == 0) throw;
	}
}

void Interruption::prepare() { py::register_exception_translator<std::runtime_error>(&translate); }

Interruption::Interruption() : inBackground(!PyGILState_Check()), runner(inBackground ? Singleton<Omega>::instance().simulationLoop.get() : nullptr)
{
	if (!inBackground) return;
	listen();
	if (seen < 0) seen = presses;
}

bool Interruption::isRequested()
{
	if (inBackground) return !runner || !runner->looping || pressedWhileYadeWaits();
	if (PyErr_CheckSignals() == 0) return false;
	PyErr_Fetch(&type, &value, &traceback);
	return true;
}

bool Interruption::pressedWhileYadeWaits()
{
	const int now = presses;
	if (now == seen) return false;
	seen  = now;
	byKey = hasEndedRun = isForTheRun(runner->looping);
	return byKey;
}

void Interruption::raise(const string& message) const
{
	if (byKey) throw Interrupted(message);
	// YADE would log a std::exception as fatal; this one the thread itself catches.
	if (!type) throw boost::thread_interrupted();
	PyErr_Restore(type, value, traceback);
	py::throw_error_already_set();
	std::abort(); // not reached
}

} // namespace yade
