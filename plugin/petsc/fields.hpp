// SPDX-License-Identifier: GPL-2.0-or-later
// A preconditioner for matrices of several fields: multigrid for each of them, in their order.
#pragma once
#include "petsc/matrix.hpp"
#include <petscpc.h>
#include <vector>

/// Unknowns of a field among the rows, and the rigid motions, if it is that of the displacements.
class BlockOfField {
public:
	BlockOfField() = default;
	BlockOfField(BlockOfField&& other) noexcept { std::swap(rows, other.rows); }
	~BlockOfField() { ISDestroy(&rows); }

	IS rows = nullptr;
};

/// Blocks of rows node after node with the unknowns of all fields. `position` as of addRigidMotions(), for the first
/// field.
PetscErrorCode findBlocks(const CompressedRows&, int fields, const int* widths, const double* position, std::vector<BlockOfField>&);

/// Smoothed aggregation; of neighbours of neighbours on the first level.
PetscErrorCode useMultigrid(PC);

/// One V-cycle for each field in its turn, with what those before it leave.
PetscErrorCode useMultigridByField(PC, const std::vector<BlockOfField>&);
