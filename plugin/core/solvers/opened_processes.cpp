// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/opened_processes.hpp"
#include "core/base/instruction_set.hpp"
#include "core/solvers/petsc_library.hpp"
#include <array>

namespace gimpm {
namespace {

class OpenedProcesses : public Processes {
public:
	OpenedProcesses(const DistributedModule& library, int rank, int size) : library_(library), rank_(rank), size_(size) { }

	int         rank() const override { return rank_; }
	int         size() const override { return size_; }
	void        smallest(std::int64_t* numbers, int count) const override { library_.smallest(numbers, count); }
	void        gather(double* all, const int* start) const override { library_.gather(all, start); }
	void        exchange(const Message* messages, int count) const override { library_.exchange(messages, count); }
	double      sent() const override { return library_.sent(); }
	std::string told(const std::string& text, int from) const override
	{
		std::array<char, 2048> said {};
		text.copy(said.data(), said.size() - 1);
		library_.tell(said.data(), int(said.size()), from);
		return said.data();
	}

private:
	const DistributedModule& library_;
	int                      rank_, size_;
};

} // namespace

std::shared_ptr<const Processes> openProcesses(std::string& reason)
{
	PetscLibrary& library = PetscLibrary::get();
	reason                = library.open();
	if (!reason.empty()) return nullptr;
	int                   rank = 0, size = 1;
	std::array<char, 512> said {};
	if (!library.distributed->begin(&rank, &size, said.data(), int(said.size()))) {
		reason = said.data();
		return nullptr;
	}
	if (size == 1) return Processes::alone();
	auto         processes  = std::make_shared<OpenedProcesses>(*library.distributed, rank, size);
	std::int64_t hasSameSet = processorHasAvx2();
	processes->smallest(&hasSameSet, 1);
	mayUseAvx2 = hasSameSet != 0;
	return processes;
}

} // namespace gimpm
