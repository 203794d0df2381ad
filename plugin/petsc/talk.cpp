// SPDX-License-Identifier: GPL-2.0-or-later
#include "petsc/talk.hpp"
#include <cstdio>
#include <cstdlib>
#include <vector>

MPI_Comm comm = MPI_COMM_NULL;

namespace {

double bytes = 0; // bytes that this process has sent to others, besides what PETSc has

/// Waits as MPI_Wait() does, but not for a process that has come to the end of its script, of which yade.mpm.processes
/// tells.
void wait(MPI_Request& request)
{
	constexpr int    endOfScript = 27183, seldom = 1000; // a tag, and tests between two looks
	constexpr double grace = 5;                          // [s]; what it has taken part in ends sooner
	double           ended = 0;
	for (int tests = 0, isDone = 0; MPI_Test(&request, &isDone, MPI_STATUS_IGNORE), !isDone; ++tests) {
		if (tests % seldom) continue;
		int hasEnded = 0;
		MPI_Iprobe(MPI_ANY_SOURCE, endOfScript, MPI_COMM_WORLD, &hasEnded, MPI_STATUS_IGNORE);
		if (hasEnded && ended == 0) ended = MPI_Wtime();
		if (hasEnded && MPI_Wtime() - ended > grace) stop("it is in a load step, and another process has come to the end of its script");
	}
}

}

void beginToTalk()
{
	if (comm == MPI_COMM_NULL) MPI_Comm_dup(MPI_COMM_WORLD, &comm);
}

int rankOf()
{
	int rank;
	MPI_Comm_rank(comm, &rank);
	return rank;
}

int sizeOf()
{
	int size;
	MPI_Comm_size(comm, &size);
	return size;
}

void stop(const char* reason)
{
	std::fprintf(stderr, "yade.mpm: process %d cannot go on, and ends all: %s\n", rankOf(), reason);
	std::fflush(stderr);
	MPI_Abort(comm, 1);
	std::abort();
}

void smallest(std::int64_t* numbers, int count)
{
	MPI_Request request;
	MPI_Iallreduce(MPI_IN_PLACE, numbers, count, MPI_INT64_T, MPI_MIN, comm, &request);
	wait(request);
	bytes += 8. * count;
}

void gather(double* all, const int* start)
{
	const int        size = sizeOf();
	std::vector<int> count(size);
	for (int r = 0; r < size; ++r)
		count[r] = start[r + 1] - start[r];
	MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, all, count.data(), start, MPI_DOUBLE, comm);
	bytes += 8. * count[rankOf()] * (size - 1);
}

/// PETSc counts what is sent so, with names of its own for these functions of MPI.
void exchange(const gimpm::Message* messages, int count)
{
	std::vector<MPI_Request> requests(2 * count);
	for (int i = 0; i < count; ++i) {
		const gimpm::Message& p = messages[i];
		MPI_Irecv(p.received, p.receivedCount, MPI_DOUBLE, p.process, 0, comm, &requests[2 * i]);
		MPI_Isend(p.sent, p.sentCount, MPI_DOUBLE, p.process, 0, comm, &requests[2 * i + 1]);
	}
	MPI_Waitall(2 * count, requests.data(), MPI_STATUSES_IGNORE);
}

void tell(char* text, int length, int from) { MPI_Bcast(text, length, MPI_CHAR, from, comm); }

double sent() { return bytes + petsc_isend_len + petsc_send_len + petsc_allreduce_ct * 8.; }
