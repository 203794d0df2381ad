// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/linear_solver.hpp"
#include "core/solvers/conjugate_gradients.hpp"
#include "core/base/stopwatch.hpp"
#include <Eigen/SparseCore>
#include <cholmod.h>
#include <cmath>
#include <omp.h>
#include <umfpack.h>

// Of OpenBLAS; null beside any other BLAS, which is left as it is.
extern "C" __attribute__((weak)) int  openblas_get_num_threads();
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);

namespace gimpm {

Eigen::VectorXd SymmetricCsc::operator*(const Eigen::VectorXd& x) const
{
	const Eigen::Map<const Eigen::SparseMatrix<double>> lower(size(), size(), row.size(), start.data(), row.data(), value.data());
	return lower.selfadjointView<Eigen::Lower>() * x;
}

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

/// Operations of a factorisation above which the threads of the BLAS have enough to do. Seconds with one and two of them: 2D, 0.2 GFLOP,
/// 0.0133 and 0.0195; 3D, 5 GFLOP, 0.147 and 0.119; 49 GFLOP, 1.42 and 0.93. Beside another program, which keeps one of the two waiting, two take
/// three to four times as long as one: a gain of a fifth is not worth that.
constexpr double flopsForThreads = 2e10;

/// CHOLMOD opens its own OpenMP threads for every supernode, which costs more than it gains; so do the threads of the BLAS if the matrix is
/// not large.
class FewerThreads {
public:
	explicit FewerThreads(double flops)
	        : levels_(omp_get_max_active_levels())
	        , blas_(openblas_get_num_threads && openblas_set_num_threads && flops < flopsForThreads ? openblas_get_num_threads() : 1)
	{
		omp_set_max_active_levels(0);
		if (blas_ > 1) openblas_set_num_threads(1);
	}
	~FewerThreads()
	{
		omp_set_max_active_levels(levels_);
		if (blas_ > 1) openblas_set_num_threads(blas_);
	}

private:
	int levels_, blas_; // before; 1 if they are left alone
};

/// A pivot that is left of a row's diagonal of about one. Below it, round-off of the rows before is what it consists of.
constexpr double smallestPivot = 1e-12;

/// Operations of the factorisation for each entry of K above which conjugate gradients are preferred. The number grows with the unknowns in
/// 3D, with their square root in 2D; so does the number of conjugate gradients' iterations, with the cube and the square root. Measured on
/// the slope with a weak layer, one thread: unknowns, operations an entry, factor [MB], factorisation [s], conjugate gradients to 1e-2 and
/// 1e-4 [s].
///   3D    3,700     830     5  0.016  0.007  0.012
///        14,200   5,600    47  0.22   0.03   0.06
///        28,100   6,300    91  0.35   0.08   0.14
///       109,200  39,900   784  5.5    0.37   0.58
///   2D   35,000     960    18  0.06   0.12   0.27
///       139,700   2,050    89  0.29   1.5    2.2
/// So 3D changes over between 20,000 and 50,000 unknowns, well past the point where both are equal, because the direct solver is the one
/// that finds singular matrices and is not slowed down by ill-conditioned ones; 2D would at some 3 million.
constexpr double worthwhileFlops = 1e4;

Eigen::VectorXd reversed(const Eigen::VectorXd& x) { return x.reverse(); }

/// Pattern of the matrix with rows and columns in the opposite order. Its lower triangle has become the upper one, which CHOLMOD factorises
/// with one transposition less.
void reverse(const SymmetricCsc& K, SymmetricCsc& reversed)
{
	const int n = K.size(), entries = int(K.row.size());
	reversed.start.resize(n + 1);
	reversed.row.resize(entries);
	std::transform(K.start.rbegin(), K.start.rend(), reversed.start.begin(), [entries](int start) { return entries - start; });
	std::transform(K.row.rbegin(), K.row.rend(), reversed.row.begin(), [n](int row) { return n - 1 - row; });
}
bool isReverse(const SymmetricCsc& K, const SymmetricCsc& reversed)
{
	const int n = K.size(), entries = int(K.row.size());
	return std::equal(K.start.rbegin(), K.start.rend(), reversed.start.begin(), reversed.start.end(), [=](int a, int b) { return a + b == entries; })
	        && std::equal(K.row.rbegin(), K.row.rend(), reversed.row.begin(), reversed.row.end(), [=](int a, int b) { return a + b == n - 1; });
}

/// Copies the values of K in the opposite order, with rows and columns scaled by powers of two that bring the diagonal close to one, and
/// returns those of K. This is exact, and lets pivots be judged: a node that the body hardly touches has a small diagonal and is not
/// singular for that.
Eigen::VectorXd scale(const SymmetricCsc& K, std::vector<double>& scaled)
{
	const int       n       = K.size();
	Eigen::VectorXd largest = Eigen::VectorXd::Zero(n), factor(n);
	for (int c = 0; c < n; ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e) {
			const double size = std::abs(K.value[e]);
			largest[c]        = std::max(largest[c], size);
			largest[K.row[e]] = std::max(largest[K.row[e]], size);
		}
	for (int c = 0; c < n; ++c) {
		const double diagonal = K.start[c] < K.start[c + 1] && K.row[K.start[c]] == c ? std::abs(K.value[K.start[c]]) : 0;
		const double size     = diagonal > 0 ? diagonal : largest[c];
		factor[c]             = size > 0 && std::isfinite(size) ? std::ldexp(1, -std::ilogb(size) / 2) : 1;
	}
	scaled.resize(K.value.size());
	double* out = scaled.data() + scaled.size();
	for (int c = 0; c < n; ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e)
			*--out = K.value[e] * factor[c] * factor[K.row[e]];
	return factor;
}

/// LU of a matrix that Cholesky refused, given by one of its triangles. Returns false if it is singular to working precision.
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
	        && info[UMFPACK_RCOND] > smallestPivot;
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
	static cholmod_sparse upper(const SymmetricCsc& K)
	{
		cholmod_sparse A {};
		A.nrow = A.ncol = K.size();
		A.nzmax         = K.row.size();
		A.p             = const_cast<int*>(K.start.data());
		A.i             = const_cast<int*>(K.row.data());
		A.x             = const_cast<double*>(K.value.data());
		A.stype         = 1;
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

LinearSolver::FactorSize LinearSolver::analyse(const SymmetricCsc& K)
{
	const FewerThreads guard(0);
	if (!cholmod_->factor || !isReverse(K, scaled_)) {
		const Stopwatch watch(times_.analyse);
		reverse(K, scaled_);
		scaled_.value.resize(K.value.size());
		cholmod_sparse A = Cholmod::upper(scaled_);
		cholmod_free_factor(&cholmod_->factor, &cholmod_->common);
		cholmod_->factor = cholmod_analyze(&A, &cholmod_->common);
	}
	return { cholmod_->common.lnz, cholmod_->common.fl };
}

LinearSolver::Status LinearSolver::solve(const SymmetricCsc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	auto&              common = cholmod_->common;
	const FewerThreads guard(analyse(K).flops);
	bool               definite = false;
	{
		const Stopwatch watch(times_.factorise);
		scale_           = scale(K, scaled_.value);
		cholmod_sparse A = Cholmod::upper(scaled_);
		definite         = cholmod_->factor && cholmod_factorize(&A, cholmod_->factor, &common) && common.status == CHOLMOD_OK;
	}
	const Stopwatch       watch(times_.solve);
	const Eigen::VectorXd right = reversed(scale_.cwiseProduct(b));
	if (definite && cholmod_rcond(cholmod_->factor, &common) < smallestPivot) return Status::singular;
	const Status status = definite && cholmod_->solve(right, x) ? Status::cholesky : solveByLu(scaled_, right, x) ? Status::lu : Status::singular;
	if (status != Status::singular) x = reversed(x).cwiseProduct(scale_);
	return status;
}

bool LinearSolver::prefersIterative(const SymmetricCsc& K)
{
	const double flops = analyse(K).flops;
	return !cholmod_->factor || flops > worthwhileFlops * double(K.row.size()); // no factor: it is too large for CHOLMOD
}

LinearSolver::Status LinearSolver::solve(const SymmetricCsc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod method, double tolerance)
{
	if (isIterative(method, K)) {
		const Stopwatch watch(times_.solve);
		if (conjugateGradients(K, b, tolerance, x, effort_.iterations)) return Status::iterative;
		++effort_.fallbacks;
	}
	return solve(K, b, x);
}

bool LinearSolver::solveAgain(const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	const FewerThreads guard(0);
	const bool         solved = cholmod_->solve(reversed(scale_.cwiseProduct(b)), x);
	if (solved) x = reversed(x).cwiseProduct(scale_);
	return solved;
}

} // namespace gimpm
