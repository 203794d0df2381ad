// SPDX-License-Identifier: GPL-2.0-or-later
// Interface of a library with algebraic multigrid, which it opens only when that is needed: nothing of it is
// known here.
#pragma once

namespace gimpm {

/// A symmetric positive definite matrix over nodes, in compressed rows. All of it must outlive the hierarchy that is
/// made of it.
struct MultigridMatrix {
	int           dim;      ///< components a node
	int           rows;     ///< dim times the nodes; where processes share the matrix, those of this one
	int           all;      ///< rows of all processes
	bool          isShared; ///< all processes call each function; who cannot go on says why and ends all of them
	const int*    start;    ///< start of each row, and the end of the last one
	const int*    column;   ///< rising, among all; rows of a node have the same ones, by whole blocks
	const double* value;
	/// Dim numbers a node, for the rigid motions of the body; null: only translations leave it without stress.
	const double* position;
	void*         product;                                       ///< for multiply()
	void (*multiply)(void* product, const double* x, double* y); ///< y = K x, faster than by rows
};

/// Functions that can fail write why, in so many characters at most.
struct MultigridModule {
	int version; ///< version of this interface
	/// Null if it fails.
	void* (*create)(const MultigridMatrix*, char* reason, int length);
	/// One V-cycle: z = M r, with M symmetric positive definite and close to the inverse. False if it fails.
	bool (*apply)(void* hierarchy, const double* r, double* z, char* reason, int length);
	void (*destroy)(void* hierarchy);
};

constexpr int         multigridVersion = 2;
constexpr const char* multigridSymbol  = "mpm_multigrid"; ///< const MultigridModule* mpm_multigrid(), in C

} // namespace gimpm
