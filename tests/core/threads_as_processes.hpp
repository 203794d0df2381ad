// SPDX-License-Identifier: GPL-2.0-or-later
// Threads that stand for processes.
#pragma once
#include "core/parallel/processes.hpp"
#include <algorithm>
#include <condition_variable>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace gimpm {

/// Meeting point of the threads.
struct Place {
	int                                         all, waiting = 0, rounds = 0;
	std::mutex                                  mutex;
	std::condition_variable                     isFull {};
	std::vector<const double*>                  given {};
	std::vector<std::pair<const Message*, int>> messages {};
	std::vector<std::vector<std::int64_t>>      numbers {};

	explicit Place(int all) : all(all), given(all), messages(all), numbers(all) { }

	void meet()
	{
		std::unique_lock<std::mutex> lock(mutex);
		const int                    round = rounds;
		if (++waiting == all) waiting = 0, ++rounds, isFull.notify_all();
		else
			isFull.wait(lock, [&] { return rounds != round; });
	}
};

struct OneOfThreads : Processes {
	Place& place;
	int    number;

	OneOfThreads(Place& place, int number) : place(place), number(number) { }
	int  rank() const override { return number; }
	int  size() const override { return place.all; }
	void smallest(std::int64_t* numbers, int count) const override
	{
		place.numbers[number].assign(numbers, numbers + count);
		place.meet();
		for (const auto& others : place.numbers)
			for (int i = 0; i < count; ++i)
				numbers[i] = std::min(numbers[i], others[i]);
		place.meet();
	}
	void gather(double* all, const int* start) const override
	{
		place.given[number] = all;
		place.meet();
		for (int r = 0; r < size(); ++r)
			if (r != number) std::copy(place.given[r] + start[r], place.given[r] + start[r + 1], all + start[r]);
		place.meet();
	}
	void exchange(const Message* messages, int count) const override
	{
		place.messages[number] = { messages, count };
		place.meet();
		for (int i = 0; i < count; ++i) {
			const auto [others, most] = place.messages[messages[i].process];
			const auto* other         = std::find_if(others, others + most, [&](const Message& p) { return p.process == number; });
			ASSERT_NE(other, others + most) << "who is not heard is not sent to";
			ASSERT_EQ(other->sentCount, messages[i].receivedCount);
			std::copy(other->sent, other->sent + other->sentCount, messages[i].received);
		}
		place.meet();
	}
	std::string told(const std::string& text, int) const override { return text; }
	double      sent() const override { return 0; }
};

/// Calls f(process) in so many threads at the same time.
inline void inThreads(int processes, const std::function<void(const std::shared_ptr<const Processes>&)>& f)
{
	Place                    place(processes);
	std::vector<std::thread> threads;
	for (int r = 0; r < processes; ++r)
		threads.emplace_back([&, r] { f(std::make_shared<OneOfThreads>(place, r)); });
	for (auto& thread : threads)
		thread.join();
}

} // namespace gimpm
