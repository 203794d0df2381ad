// SPDX-License-Identifier: GPL-2.0-or-later
// Communication between processes by MPI: see DistributedModule.
#pragma once
#include "core/parallel/processes.hpp"
#include <petscsys.h> // MPI without its old interface for C++

extern MPI_Comm comm; // one of our own: messages of the script, by mpi4py, are not taken for ours

void beginToTalk();
int  rankOf();
int  sizeOf();

/// The others wait for what will not come.
[[noreturn]] void stop(const char* reason);

void   smallest(std::int64_t* numbers, int count);
void   gather(double* all, const int* start);
void   exchange(const gimpm::Message* messages, int count);
void   tell(char* text, int length, int from);
double sent(); ///< bytes sent, those of PETSc included
