// SPDX-License-Identifier: GPL-2.0-or-later
// Matrices over nodes as PETSc has them, of one process or of several.
#pragma once
#include <petscmat.h>

/// Rows of a process, compressed, as the core gives them.
struct CompressedRows {
	MPI_Comm      comm; ///< of those that share the matrix
	int           dim;  ///< components a node
	int           rows, all;
	const int *   start, *column;
	const double* value;
};

/// A copy, but where there is one process: there `rows` must outlive it.
PetscErrorCode makeMatrix(const CompressedRows& rows, bool isSymmetric, Mat* K);

/// The rigid motions, of which coarse levels are made, by dim numbers a node; null: none. Without rotations, bending
/// takes many more iterations.
PetscErrorCode addRigidMotions(Mat K, const CompressedRows&, const double* position);
