// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/linear_solver.hpp"
#include "core/stopwatch.hpp"
#include <cholmod.h>
#include <limits>
#include <omp.h>
#include <umfpack.h>

namespace gimpm {

template <int Dim> void reduce(const NodeMatrix<Dim>& K, const FreeDofs& dofs, SymmetricCsc& out)
{
	out.start.assign(1, 0);
	out.row.clear();
	out.value.clear();
	for (int a = 0; a < K.nodes(); ++a)
		for (int i = 0; i < Dim; ++i) {
			if (dofs.number[Dim * a + i] < 0) continue;
			for (int c = 0; c < NodeMatrix<Dim>::codes; ++c) {
				if (!K.used(a, c)) continue;
				const int     b = K.neighbour(a, c);
				const double* k = K.at(a, c) + i * Dim; // row i of K_ab is the part of this column in block (b, a)
				for (int j = b == a ? i : 0; j < Dim; ++j)
					if (dofs.number[Dim * b + j] >= 0) {
						out.row.push_back(dofs.number[Dim * b + j]);
						out.value.push_back(k[j]);
					}
			}
			out.start.push_back(int(out.row.size()));
		}
}

template void reduce(const NodeMatrix<2>&, const FreeDofs&, SymmetricCsc&);
template void reduce(const NodeMatrix<3>&, const FreeDofs&, SymmetricCsc&);

namespace {

/// CHOLMOD opens its own OpenMP threads for every supernode, which costs more than it gains; BLAS threads are not affected.
class WithoutNestedThreads {
public:
	WithoutNestedThreads() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
	~WithoutNestedThreads() { omp_set_max_active_levels(levels_); }

private:
	int levels_;
};

/// LU of a matrix that Cholesky refused. Returns false if it is singular to working precision.
bool solveByLu(const SymmetricCsc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	const int           n = K.size();
	std::vector<int>    rows, columns; // both triangles
	std::vector<double> values;
	for (int c = 0; c < n; ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
			const int r = K.row[e];
			rows.push_back(r), columns.push_back(c), values.push_back(K.value[e]);
			if (r != c) rows.push_back(c), columns.push_back(r), values.push_back(K.value[e]);
		}
	std::vector<int>    start(n + 1), row(values.size());
	std::vector<double> value(values.size());
	if (umfpack_di_triplet_to_col(n, n, int(values.size()), rows.data(), columns.data(), values.data(), start.data(), row.data(), value.data(), nullptr) != UMFPACK_OK)
		return false;
	double info[UMFPACK_INFO];
	void * symbolic = nullptr, *numeric = nullptr;
	bool   ok = umfpack_di_symbolic(n, n, start.data(), row.data(), value.data(), &symbolic, nullptr, info) == UMFPACK_OK
	        && umfpack_di_numeric(start.data(), row.data(), value.data(), symbolic, &numeric, nullptr, info) == UMFPACK_OK
	        && info[UMFPACK_RCOND] > std::numeric_limits<double>::epsilon();
	if (ok) {
		x.resize(n);
		ok = umfpack_di_solve(UMFPACK_A, start.data(), row.data(), value.data(), x.data(), b.data(), numeric, nullptr, info) == UMFPACK_OK;
	}
	umfpack_di_free_symbolic(&symbolic);
	umfpack_di_free_numeric(&numeric);
	return ok && x.allFinite();
}

} // namespace

struct LinearSolver::Cholmod {
	cholmod_common  common;
	cholmod_factor* factor = nullptr;

	Cholmod()
	{
		cholmod_start(&common);
		common.print                 = 0; // a failed factorisation is a status, not a message
		common.quick_return_if_not_posdef = 1;
		common.final_ll              = 1;
	}
	~Cholmod()
	{
		cholmod_free_factor(&factor, &common);
		cholmod_finish(&common);
	}
	static cholmod_sparse view(const SymmetricCsc& K)
	{
		cholmod_sparse A {};
		A.nrow = A.ncol = K.size();
		A.nzmax         = K.row.size();
		A.p             = const_cast<int*>(K.start.data());
		A.i             = const_cast<int*>(K.row.data());
		A.x             = const_cast<double*>(K.value.data());
		A.stype         = -1;
		A.itype         = CHOLMOD_INT;
		A.xtype         = CHOLMOD_REAL;
		A.dtype         = CHOLMOD_DOUBLE;
		A.sorted = A.packed = 1;
		return A;
	}
	bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x)
	{
		cholmod_dense B {};
		B.nrow = B.nzmax = B.d = b.size();
		B.ncol                 = 1;
		B.x                    = const_cast<double*>(b.data());
		B.xtype                = CHOLMOD_REAL;
		B.dtype                = CHOLMOD_DOUBLE;
		cholmod_dense* X       = cholmod_solve(CHOLMOD_A, factor, &B, &common);
		if (!X) return false;
		x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(X->x), b.size());
		cholmod_free_dense(&X, &common);
		return x.allFinite();
	}
};

LinearSolver::LinearSolver() : cholmod_(new Cholmod) { }
LinearSolver::~LinearSolver()                                  = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept            = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

LinearSolver::Status LinearSolver::solve(const SymmetricCsc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	const WithoutNestedThreads guard;
	auto&                      common = cholmod_->common;
	cholmod_sparse             A      = Cholmod::view(K);
	if (!cholmod_->factor || !K.samePattern(analysed_)) {
		const Stopwatch watch(times_.analyse);
		cholmod_free_factor(&cholmod_->factor, &common);
		cholmod_->factor = cholmod_analyze(&A, &common);
		analysed_.start  = K.start;
		analysed_.row    = K.row;
	}
	bool definite = false;
	if (cholmod_->factor) {
		const Stopwatch watch(times_.factorise);
		definite = cholmod_factorize(&A, cholmod_->factor, &common) && common.status == CHOLMOD_OK;
	}
	const Stopwatch watch(times_.solve);
	if (definite && cholmod_->solve(b, x)) return Status::cholesky;
	return solveByLu(K, b, x) ? Status::lu : Status::singular;
}

} // namespace gimpm
