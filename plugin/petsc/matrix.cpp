// SPDX-License-Identifier: GPL-2.0-or-later
#include "petsc/matrix.hpp"

PetscErrorCode makeMatrix(const CompressedRows& rows, bool isSymmetric, Mat* K)
{
	if (rows.comm == PETSC_COMM_SELF && !rows.areCopied) // PETSc only reads them
		PetscCall(MatCreateSeqAIJWithArrays(
		        rows.comm, rows.rows, rows.rows, const_cast<int*>(rows.start), const_cast<int*>(rows.column), const_cast<double*>(rows.value), K));
	else {
		PetscCall(MatCreate(rows.comm, K));
		PetscCall(MatSetSizes(*K, rows.rows, rows.rows, rows.all, rows.all));
		PetscCall(MatSetBlockSize(*K, rows.dim));
		PetscCall(MatSetType(*K, MATAIJ)); // the type of one process or of several follows
		PetscCall(MatSeqAIJSetPreallocationCSR(*K, rows.start, rows.column, rows.value));
		PetscCall(MatMPIAIJSetPreallocationCSR(*K, rows.start, rows.column, rows.value));
	}
	PetscCall(MatSetBlockSize(*K, rows.dim));
	PetscCall(MatSetOption(*K, MAT_USE_INODES, PETSC_FALSE)); // their product takes longer
	// Not MAT_SPD: of a matrix that is not, PETSc would look for the largest eigenvalue by conjugate gradients and
	// an iteration without end.
	if (isSymmetric) PetscCall(MatSetOption(*K, MAT_SYMMETRIC, PETSC_TRUE));
	return 0;
}

PetscErrorCode makeRigidMotions(MPI_Comm comm, int dim, int nodes, const double* position, MatNullSpace* motions)
{
	Vec places;
	if (comm == PETSC_COMM_SELF) PetscCall(VecCreateSeqWithArray(comm, dim, dim * nodes, position, &places));
	else
		PetscCall(VecCreateMPIWithArray(comm, dim, dim * nodes, PETSC_DETERMINE, position, &places));
	PetscCall(MatNullSpaceCreateRigidBody(places, motions));
	return VecDestroy(&places);
}

PetscErrorCode addRigidMotions(Mat K, const CompressedRows& rows, const double* position)
{
	if (!position) return 0;
	MatNullSpace motions;
	PetscCall(makeRigidMotions(rows.comm, rows.dim, rows.rows / rows.dim, position, &motions));
	PetscCall(MatSetNearNullSpace(K, motions));
	return MatNullSpaceDestroy(&motions);
}
