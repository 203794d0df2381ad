// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/python_lock.hpp"
#include <memory>
#include <thread>

namespace yade {

void withPython(const std::atomic_bool& isWanted, std::function<void()> f)
{
	const auto isDone = std::make_shared<std::atomic_bool>(false);
	std::thread([isDone, f] {
		const PythonLock lock;
		f();
		*isDone = true;
	}).detach();
	while (isWanted && !*isDone)
		std::this_thread::sleep_for(std::chrono::microseconds(100));
}

} // namespace yade
