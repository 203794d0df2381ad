// SPDX-License-Identifier: GPL-2.0-or-later
// Interface of a library that lets several processes talk and solve together, which it opens only then:
// nothing of it is known here.
#pragma once
#include "core/parallel/processes.hpp"

namespace gimpm {

/// The rows of a process of a matrix over nodes, compressed. They are copied.
struct DistributedRows {
	int           fields;
	const int*    widths; ///< unknowns a node of each field; the first is that of the displacements
	int           dim;    ///< unknowns a node, of all fields
	int           rows;   ///< rows of this process: dim times its nodes
	int           all;    ///< rows of all processes
	const int*    start;  ///< start of each row, and the end of the last one
	const int*    column; ///< rising, among all
	const double* value;
	bool          isSymmetric;
	const double* symmetricPart; ///< values that multigrid is made of, (K + K^T) / 2 within each field; null: K
	const double* position;      ///< a position for each node, for the rigid motions of the body; null: only translations leave it without stress
};

/// GMRES with multigrid of the symmetric part; of several fields each is done in its turn, with what those before it
/// leave.
struct DistributedIteration {
	bool   goesOn;    ///< from x, instead of from zero
	double tolerance; ///< |b - K x| <= tolerance |b|
	int    atMost;    ///< iterations
	int    made;
	double error; ///< |b - K x|
	bool   hasConverged, hasBrokenDown;
};

/// Vectors have the rows of the process. Who cannot go on says why and ends all processes.
struct DistributedModule {
	int version; ///< version of this interface
	/// False, with the reason in so many characters at most, if they cannot be found.
	bool (*begin)(int* rank, int* size, char* reason, int length);
	void (*smallest)(std::int64_t* numbers, int count);
	void (*gather)(double* all, const int* start);
	void (*exchange)(const Message* messages, int count);
	void (*tell)(char* text, int length, int from);
	double (*sent)();               ///< sum sent by this process [bytes]
	void* (*create)(bool isShared); ///< false: for this process alone, in which nothing ends what fails
	void (*destroy)(void* solver);
	void (*setMatrix)(void* solver, const DistributedRows*);
	void (*setUp)(void* solver); ///< multigrid of the symmetric part, for this matrix and those that follow
	void (*iterate)(void* solver, DistributedIteration*, const double* b, double* x);
	/// False if a pivot is less than so small a part of the largest entry of a row.
	bool (*factorise)(void* solver, double smallestPivot, int* negativePivots);
	bool (*substitute)(void* solver, const double* b, double* x);
};

constexpr int         distributedVersion = 3;
constexpr const char* distributedSymbol  = "mpm_distributed"; ///< const DistributedModule* mpm_distributed(), in C

} // namespace gimpm
