// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/multifrontal.hpp"
#include <algorithm>
#include <cmath>
#include <dmumps_c.h>
#include <mutex>

namespace gimpm {
namespace {

// Jobs of MUMPS, and positions of its controls and results, counted from 0.
enum Job { begin = -1, end = -2, analyse = 1, factorisation = 2, solution = 3 };
enum Control {
	errors,
	diagnostics,
	statistics,
	verbosity,
	transversal = 5,
	orderingMethod,
	scaling,
	notTransposed,
	refinement,
	moreMemory = 13,
	nullPivots = 23
};
enum RealControl { pivotThreshold, refinedEnough, nullPivot };
enum Result { status, nullPivotsFound = 27 };

constexpr int givenOrdering = 1, anySigns = 2, worldOfOne = -987654; // the communicator of a MUMPS without MPI

/// MUMPS shares variables between all of its instances.
std::mutex& oneAtATime()
{
	static std::mutex mutex;
	return mutex;
}

} // namespace

struct Multifrontal::Instance : DMUMPS_STRUC_C {
	bool isReady = false; // analysed
};

Multifrontal::Multifrontal(const Csc& K, Form form, const int* ordering) : mumps_(new Instance()), row_(K.row), column_(K.row.size())
{
	auto& m        = *mumps_;
	m.par          = 1;
	m.sym          = form == Form::triangle ? anySigns : 0;
	m.comm_fortran = worldOfOne;
	run(begin);
	m.icntl[errors] = m.icntl[diagnostics] = m.icntl[statistics] = m.icntl[verbosity] = 0;
	m.icntl[transversal] = m.icntl[scaling] = 0; // the diagonal is there, and about one
	m.icntl[orderingMethod]                 = givenOrdering;
	m.icntl[nullPivots]                     = 1;
	m.icntl[refinement]                     = 2; // steps at most
	m.cntl[refinedEnough]                   = 1e-15;
	m.cntl[pivotThreshold]                  = 0.01;
	for (int c = 0; c < K.size(); ++c)
		std::fill(column_.begin() + K.start[c], column_.begin() + K.start[c + 1], c + 1);
	for (int& row : row_)
		++row;
	std::vector<int> place(K.size()); // position of each row
	for (int i = 0; i < K.size(); ++i)
		place[ordering[i]] = i + 1;
	m.n       = K.size();
	m.nnz     = MUMPS_INT8(row_.size());
	m.irn     = row_.data();
	m.jcn     = column_.data();
	m.perm_in = place.data();
	m.isReady = m.n > 0 && run(analyse);
	m.perm_in = nullptr;
}

Multifrontal::~Multifrontal() { run(end); }

bool Multifrontal::run(int job)
{
	const std::lock_guard<std::mutex> guard(oneAtATime());
	mumps_->job = job;
	dmumps_c(mumps_.get());
	return mumps_->infog[status] >= 0;
}

bool Multifrontal::factorise(const Csc& K, double smallestRow)
{
	auto& m = *mumps_;
	if (!m.isReady || !std::all_of(K.value.begin(), K.value.end(), [](double v) { return std::isfinite(v); })) return false;
	m.a               = const_cast<double*>(K.value.data());
	m.cntl[nullPivot] = smallestRow;
	// pivots that are looked for off the diagonal take more memory than the analysis can foresee
	for (const int percent : { 20, 100, 400 }) {
		m.icntl[moreMemory] = percent;
		if (run(factorisation)) return m.infog[nullPivotsFound] == 0;
		const bool workspaceIsTooSmall = m.infog[status] == -8 || m.infog[status] == -9;
		if (!workspaceIsTooSmall) break;
	}
	return false;
}

bool Multifrontal::solve(const Csc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
{
	x                            = b;
	mumps_->a                    = const_cast<double*>(K.value.data());
	mumps_->rhs                  = x.data();
	mumps_->nrhs                 = 1;
	mumps_->icntl[notTransposed] = transposed ? 0 : 1;
	return run(solution) && x.allFinite();
}

} // namespace gimpm
