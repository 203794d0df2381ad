// SPDX-License-Identifier: GPL-2.0-or-later
#include "petsc/matrix.hpp"

PetscErrorCode makeMatrix(const CompressedRows& rows, bool isSymmetric, Mat* K)
{
	if (rows.comm == PETSC_COMM_SELF) // PETSc only reads them
		PetscCall(MatCreateSeqAIJWithArrays(
		        rows.comm, rows.rows, rows.rows, const_cast<int*>(rows.start), const_cast<int*>(rows.column), const_cast<double*>(rows.value), K));
	else {
		PetscCall(MatCreate(rows.comm, K));
		PetscCall(MatSetSizes(*K, rows.rows, rows.rows, rows.all, rows.all));
		PetscCall(MatSetBlockSize(*K, rows.dim));
		PetscCall(MatSetType(*K, MATMPIAIJ));
		PetscCall(MatMPIAIJSetPreallocationCSR(*K, rows.start, rows.column, rows.value));
	}
	PetscCall(MatSetBlockSize(*K, rows.dim));
	PetscCall(MatSetOption(*K, MAT_USE_INODES, PETSC_FALSE)); // whose product takes longer
	// Not MAT_SPD: of a matrix that is not, PETSc would look for the largest eigenvalue by conjugate gradients and
	// an iteration without end.
	if (isSymmetric) PetscCall(MatSetOption(*K, MAT_SYMMETRIC, PETSC_TRUE));
	return 0;
}

PetscErrorCode addRigidMotions(Mat K, const CompressedRows& rows, const double* position)
{
	if (!position) return 0;
	Vec          places;
	MatNullSpace motions;
	if (rows.comm == PETSC_COMM_SELF) PetscCall(VecCreateSeqWithArray(rows.comm, rows.dim, rows.rows, position, &places));
	else
		PetscCall(VecCreateMPIWithArray(rows.comm, rows.dim, rows.rows, rows.all, position, &places));
	PetscCall(MatNullSpaceCreateRigidBody(places, &motions));
	PetscCall(MatSetNearNullSpace(K, motions));
	PetscCall(MatNullSpaceDestroy(&motions));
	return VecDestroy(&places);
}
