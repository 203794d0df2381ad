// SPDX-License-Identifier: GPL-2.0-or-later
// Matrices over nodes as PETSc has them, of one process or of several.
#pragma once
#include <petscmat.h>

/// Rows of a process, compressed, as the core gives them.
struct CompressedRows {
	MPI_Comm      comm; ///< communicator of those that share the matrix
	int           dim;  ///< unknowns a node
	int           rows, all;
	const int *   start, *column;
	const double* value;
	bool          areCopied = false; ///< else they must outlive the matrix, where there is one process
};

PetscErrorCode makeMatrix(const CompressedRows& rows, bool isSymmetric, Mat* K);

/// The rigid motions of so many nodes, by dim numbers for each.
PetscErrorCode makeRigidMotions(MPI_Comm, int dim, int nodes, const double* position, MatNullSpace*);

/// The rigid motions, of which coarse levels are made, by dim numbers a node; null: none. Without rotations, bending
/// takes many more iterations.
PetscErrorCode addRigidMotions(Mat K, const CompressedRows&, const double* position);
