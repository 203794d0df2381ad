// SPDX-License-Identifier: GPL-2.0-or-later
#include "petsc/fields.hpp"
#include <petscksp.h>
#include <string>

namespace {

PetscErrorCode findBlock(const CompressedRows& rows, int before, int width, IS* block)
{
	std::vector<int> numbers;
	int              first = 0; // first row of this process
	MPI_Exscan(&rows.rows, &first, 1, MPI_INT, MPI_SUM, rows.comm);
	for (int node = 0; node < rows.rows / rows.dim; ++node)
		for (int i = 0; i < width; ++i)
			numbers.push_back(first + rows.dim * node + before + i);
	PetscCall(ISCreateGeneral(rows.comm, int(numbers.size()), numbers.data(), PETSC_COPY_VALUES, block));
	return ISSetBlockSize(*block, width);
}

/// Steps of the smoother. With two, its default, iterations of displacements beside pressures grow more as grids are
/// refined, and all takes as long.
constexpr int smoothing = 3;

PetscErrorCode smoothMore(PC multigrid)
{
	int levels;
	PetscCall(PCMGGetLevels(multigrid, &levels));
	for (int level = 1; level < levels; ++level) {
		KSP smoother;
		PetscCall(PCMGGetSmoother(multigrid, level, &smoother));
		PetscCall(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, smoothing));
	}
	return 0;
}

PetscErrorCode useMultigridIn(KSP field, bool hasDisplacements)
{
	Mat matrix;
	PC  pc;
	PetscCall(KSPGetOperators(field, nullptr, &matrix));
	PetscCall(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
	PetscCall(KSPSetType(field, KSPPREONLY));
	PetscCall(KSPGetPC(field, &pc));
	PetscCall(PCSetType(pc, PCGAMG));
	PetscCall(PCGAMGSetAggressiveLevels(pc, 1));
	PetscCall(KSPSetUp(field));
	return hasDisplacements ? smoothMore(pc) : PetscErrorCode(0);
}

}

PetscErrorCode findBlocks(const CompressedRows& rows, int fields, const int* widths, const double* position, std::vector<BlockOfField>& blocks)
{
	blocks.clear();
	for (int field = 0, before = 0; field < fields; before += widths[field++]) {
		blocks.emplace_back();
		PetscCall(findBlock(rows, before, widths[field], &blocks.back().rows));
	}
	if (!position) return 0;
	MatNullSpace motions;
	PetscCall(makeRigidMotions(rows.comm, widths[0], rows.rows / rows.dim, position, &motions));
	PetscCall(PetscObjectCompose(reinterpret_cast<PetscObject>(blocks[0].rows), "nearnullspace", reinterpret_cast<PetscObject>(motions)));
	return MatNullSpaceDestroy(&motions);
}

PetscErrorCode useMultigrid(PC pc)
{
	PetscCall(PCSetType(pc, PCGAMG));
	PetscCall(PCGAMGSetAggressiveLevels(pc, 1));
	return PCSetUp(pc);
}

PetscErrorCode useMultigridByField(PC pc, const std::vector<BlockOfField>& blocks)
{
	PetscCall(PCSetType(pc, PCFIELDSPLIT));
	PetscCall(PCFieldSplitSetType(pc, PC_COMPOSITE_MULTIPLICATIVE));
	for (std::size_t field = 0; field < blocks.size(); ++field)
		PetscCall(PCFieldSplitSetIS(pc, std::to_string(field).c_str(), blocks[field].rows));
	PetscCall(PCSetUp(pc));
	KSP* solvers;
	int  count;
	PetscCall(PCFieldSplitGetSubKSP(pc, &count, &solvers));
	for (int field = 0; field < count; ++field)
		PetscCall(useMultigridIn(solvers[field], field == 0));
	return PetscFree(solvers);
}
