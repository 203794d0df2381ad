// SPDX-License-Identifier: GPL-2.0-or-later
// The processes that are at work on the same scene: one that is alone, or several.
#pragma once
#include <cstdint>
#include <memory>
#include <string>

namespace gimpm {

/// Numbers for another process, and those that it has for this one.
struct Message {
	int           process;
	const double* sent;
	int           sentCount;
	double*       received;
	int           receivedCount;
};

/// Messages among processes. Each function is called by all of them, in the same order; a process that cannot go on
/// ends all.
class Processes {
public:
	virtual ~Processes() = default;

	virtual int rank() const = 0;
	virtual int size() const = 0;

	/// Each of the numbers becomes the smallest one that a process has given.
	virtual void smallest(std::int64_t* numbers, int count) const = 0;

	/// Process r gives all[start[r]] ... all[start[r + 1] - 1] to the others.
	virtual void gather(double* all, const int* start) const = 0;

	/// One message at most with each process, which calls this with the other side of it.
	virtual void exchange(const Message* messages, int count) const = 0;

	/// The text of the process `from`.
	virtual std::string told(const std::string& text, int from) const = 0;

	/// Amount that this process has sent so far [bytes].
	virtual double sent() const = 0;

	/// This process, and no others.
	static const std::shared_ptr<const Processes>& alone();

	bool haveSame(std::uint64_t number) const
	{
		// The smallest, and what only the largest is the complement of.
		std::int64_t both[2] = { std::int64_t(number), ~std::int64_t(number) };
		smallest(both, 2);
		return both[0] == ~both[1];
	}
};

/// Has nobody to talk to: what it knows is what all know.
class OneProcess : public Processes {
public:
	int         rank() const override { return 0; }
	int         size() const override { return 1; }
	void        smallest(std::int64_t*, int) const override { }
	void        gather(double*, const int*) const override { }
	void        exchange(const Message*, int) const override { }
	std::string told(const std::string& text, int) const override { return text; }
	double      sent() const override { return 0; }
};

inline const std::shared_ptr<const Processes>& Processes::alone()
{
	static const std::shared_ptr<const Processes> one = std::make_shared<OneProcess>();
	return one;
}

} // namespace gimpm
