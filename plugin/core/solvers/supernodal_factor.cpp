// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/supernodal_factor.hpp"
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace gimpm {
namespace {

cholmod_sparse upper(const Csc& K)
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

/// Numbers of unknowns that follow each other in the order and are coupled to the same ones, as those of a node mostly
/// are. Rows are compared by sums of numbers that look random: where different ones have the same sum, all of these
/// unknowns count as coupled to what one of them is.
std::vector<int> widthsOfAlike(const Csc& K, const std::vector<int>& order)
{
	const auto mixed = [](std::uint64_t x) { // hash of SplitMix64
		x = (x + 1) * 0x9e3779b97f4a7c15;
		x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
		x = (x ^ x >> 27) * 0x94d049bb133111eb;
		return x ^ x >> 31;
	};
	std::vector<std::uint64_t> number(K.size()), row(K.size());
	for (int c = 0; c < K.size(); ++c)
		row[c] = number[c] = mixed(std::uint64_t(c));
	for (int c = 0; c < K.size(); ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e)
			if (K.row[e] < c) row[c] += number[K.row[e]], row[K.row[e]] += number[c];
	std::vector<int> widths;
	for (std::size_t i = 0; i < order.size(); ++i)
		if (i > 0 && row[order[i]] == row[order[i - 1]]) ++widths.back();
		else
			widths.push_back(1);
	return widths;
}

/// Pattern of the nodes that an entry couples, as an upper triangle in the order of elimination. Each node's unknowns,
/// so many, follow each other in the given order.
cholmod_sparse* patternOfNodes(const Csc& K, const std::vector<int>& order, const std::vector<int>& widths, cholmod_common& common)
{
	const int        count = int(widths.size());
	std::vector<int> node(K.size()), start(count + 1, 0), seen(count), row, next;
	for (int a = 0, i = 0; a < count; ++a)
		for (const int end = i + widths[a]; i < end; ++i)
			node[order[i]] = a;
	const auto forPairs = [&](auto&& f) { // some of them twice: from below and from above
		std::fill(seen.begin(), seen.end(), -1);
		for (int a = 0, i = 0; a < count; ++a)
			for (const int end = i + widths[a]; i < end; ++i)
				for (int e = K.start[order[i]]; e < K.start[order[i] + 1]; ++e)
					if (const int b = node[K.row[e]]; seen[b] != a) seen[b] = a, f(std::min(a, b), std::max(a, b));
	};
	forPairs([&](int, int b) { ++start[b + 1]; });
	std::partial_sum(start.begin(), start.end(), start.begin());
	row.resize(start.back());
	next.assign(start.begin(), start.end() - 1);
	forPairs([&](int a, int b) { row[next[b]++] = a; });
	cholmod_sparse* pattern = cholmod_allocate_sparse(count, count, row.size(), true, true, 1, CHOLMOD_PATTERN, &common);
	if (!pattern) return nullptr;
	int* const starts = static_cast<int*>(pattern->p);
	int* const rows   = static_cast<int*>(pattern->i);
	int        end    = 0;
	for (int b = 0; b < count; ++b) {
		std::sort(row.begin() + start[b], row.begin() + start[b + 1]);
		const auto last = std::unique(row.begin() + start[b], row.begin() + start[b + 1]);
		starts[b]       = end;
		end             = int(std::copy(row.begin() + start[b], last, rows + end) - rows);
	}
	starts[count] = end;
	return pattern;
}

/// Supernodes of CHOLMOD: first columns, first rows, first values, and rows.
struct SupernodesOf {
	std::vector<int> columns { 0 }, rowsBegin { 0 }, valuesBegin { 0 }, rows {};
	std::size_t      values = 0, largestUpdate = 0, below = 1;

	void end(int lastColumn, cholmod_common& common)
	{
		const double height = int(rows.size()) - rowsBegin.back(), width = lastColumn - columns.back();
		for (int c = 0; c < width; ++c)
			common.lnz += height - c, common.fl += (height - c) * (height - c);
		values += std::size_t(width) * std::size_t(height);
		below         = std::max(below, std::size_t(height - width));
		largestUpdate = std::max(largestUpdate, std::size_t((height - width) * (height - width)));
		columns.push_back(lastColumn), rowsBegin.push_back(int(rows.size())), valuesBegin.push_back(int(values));
	}
	bool isTooLarge() const { return values > std::size_t(std::numeric_limits<int>::max()); }

	/// Into a factor that is empty.
	void give(cholmod_factor& L, cholmod_common& common) const
	{
		const auto kept = [&](const std::vector<int>& numbers) {
			void* copy = cholmod_malloc(std::max<std::size_t>(1, numbers.size()), sizeof(int), &common);
			if (copy) std::copy(numbers.begin(), numbers.end(), static_cast<int*>(copy));
			return copy;
		};
		L.ordering = CHOLMOD_GIVEN;
		L.is_ll = L.is_super = L.is_monotonic = true;
		L.nsuper = columns.size() - 1, L.ssize = rows.size(), L.xsize = values, L.maxcsize = largestUpdate, L.maxesize = below;
		L.super = kept(columns), L.pi = kept(rowsBegin), L.px = kept(valuesBegin), L.s = kept(rows);
	}
};

/// The symbolic factor of the unknowns from that of their nodes. Sets what is known of its size.
cholmod_factor* expanded(const cholmod_factor& ofNodes, const std::vector<int>& order, const std::vector<int>& widths, cholmod_common& common)
{
	const auto       integers = [](const void* p) { return static_cast<const int*>(p); };
	const int *      permuted = integers(ofNodes.Perm), *columns = integers(ofNodes.super), *places = integers(ofNodes.pi), *nodes = integers(ofNodes.s);
	const int        count = int(widths.size());
	std::vector<int> source(count, 0), first(count + 1, 0); // start of each node: in the order that was given, and in that of the factor
	std::partial_sum(widths.begin(), widths.end() - 1, source.begin() + 1);
	for (int a = 0; a < count; ++a)
		first[a + 1] = first[a] + widths[permuted[a]];
	SupernodesOf all;
	common.lnz = common.fl = 0;
	for (int s = 0; s < int(ofNodes.nsuper); ++s) {
		for (int i = places[s]; i < places[s + 1]; ++i)
			for (int row = first[nodes[i]]; row < first[nodes[i] + 1]; ++row)
				all.rows.push_back(row);
		all.end(first[columns[s + 1]], common);
		if (all.isTooLarge()) return nullptr;
	}
	cholmod_factor* L = cholmod_allocate_factor(order.size(), &common);
	if (!L) return nullptr;
	for (int a = 0; a < count; ++a)
		std::copy_n(order.begin() + source[permuted[a]], widths[permuted[a]], static_cast<int*>(L->Perm) + first[a]);
	all.give(*L, common);
	if (common.status < CHOLMOD_OK) cholmod_free_factor(&L, &common);
	return L;
}

} // namespace

SupernodalFactor::SupernodalFactor()
{
	cholmod_start(&common_);
	common_.print                      = 0; // a failed factorisation is a status, not a message
	common_.quick_return_if_not_posdef = 1;
	common_.final_ll                   = 1;
}

SupernodalFactor::~SupernodalFactor()
{
	cholmod_free_factor(&factor_, &common_);
	cholmod_finish(&common_);
}

/// Unknowns are taken together where that does not matter: there are about a third as many nodes, and a ninth as many
/// pairs of them.
void SupernodalFactor::analyseNodes(const Csc& K, const std::vector<int>& order)
{
	const auto forgetPattern = [this](cholmod_sparse* pattern) { cholmod_free_sparse(&pattern, &common_); };
	const auto forgetFactor  = [this](cholmod_factor* factor) { cholmod_free_factor(&factor, &common_); };
	const auto widths        = widthsOfAlike(K, order);
	const std::unique_ptr<cholmod_sparse, decltype(forgetPattern)> nodes(patternOfNodes(K, order, widths, common_), forgetPattern);
	if (!nodes) return;
	const auto own             = std::make_pair(common_.method[0].ordering, std::array { common_.nrelax[0], common_.nrelax[1], common_.nrelax[2] });
	common_.nmethods           = 1;
	common_.method[0].ordering = CHOLMOD_NATURAL;
	common_.supernodal         = CHOLMOD_SUPERNODAL;
	common_.postorder          = true;
	for (std::size_t& columns : common_.nrelax) // numbers are meant of single unknowns
		columns = columns * widths.size() / order.size();
	const std::unique_ptr<cholmod_factor, decltype(forgetFactor)> ofNodes(cholmod_analyze(nodes.get(), &common_), forgetFactor);
	common_.method[0].ordering = own.first;
	std::copy(own.second.begin(), own.second.end(), common_.nrelax);
	if (ofNodes) factor_ = expanded(*ofNodes, order, widths, common_);
}

void SupernodalFactor::analyse(const Csc& K, std::vector<int> order, int last, bool isDefinite)
{
	cholmod_sparse A = upper(K);
	forget();
	if (!isDefinite && last == 0 && !order.empty()) return analyseNodes(K, order);
	// Its default is AMD, and METIS if that is not good; its first method is the given order.
	common_.nmethods   = order.empty() ? 0 : 1;
	common_.supernodal = last == 0 && isDefinite ? CHOLMOD_AUTO : CHOLMOD_SUPERNODAL;
	for (const bool postorder : { true, false }) { // last ones survive it if all before them are connected
		common_.postorder = postorder;
		factor_           = cholmod_analyze_p(&A, order.empty() ? nullptr : order.data(), nullptr, 0, &common_);
		if (!factor_ || std::equal(order.end() - last, order.end(), ordering() + A.nrow - last)) return;
		forget();
	}
}

bool SupernodalFactor::factorise(const Csc& K)
{
	cholmod_sparse A = upper(K);
	return factor_ && cholmod_factorize(&A, factor_, &common_) && common_.status == CHOLMOD_OK;
}

bool SupernodalFactor::findDestinations(const Csc& K, bool isSymmetric)
{
	using Part = EntryDestinations::Part;
	if (!factor_ || !factor_->is_super) return false;
	if (!entries_.start.empty() && isSymmetric == above_.start.empty()) return true;
	if (!cholmod_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor_, &common_)) return false;
	entries_ = EntryDestinations(*factor_, K, isSymmetric ? Part::triangle : Part::below);
	above_   = isSymmetric ? EntryDestinations() : EntryDestinations(*factor_, K, Part::above);
	upper_.clear();
	return true;
}

bool SupernodalFactor::factoriseSigned(const Csc& K, double smallest)
{
	return findDestinations(K, true) && gimpm::factoriseSigned(*factor_, entries_, K.value, smallest, signs_);
}

bool SupernodalFactor::factoriseGeneral(const Csc& K, double smallest)
{
	return findDestinations(K, false) && entries_.areInPattern && above_.areInPattern
	        && gimpm::factoriseSigned(*factor_, upper_, entries_, above_, K.value, smallest, signs_);
}

/// K = L S U, and its transpose is U^T S L^T.
bool SupernodalFactor::solveSigned(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed)
{
	Eigen::VectorXd y;
	if (!solve(CHOLMOD_P, b, x) || !solveTriangle(CHOLMOD_L, transposed, x, y)) return false;
	return solveTriangle(CHOLMOD_Lt, !transposed, y.cwiseProduct(signs_), x) && solve(CHOLMOD_Pt, Eigen::VectorXd(x), x);
}

/// CHOLMOD takes the values of U^T for those of L.
bool SupernodalFactor::solveTriangle(int system, bool ofUpper, const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	if (!ofUpper || upper_.empty()) return solve(system, b, x);
	void* const ofLower = std::exchange(factor_->x, upper_.data());
	const bool  isDone  = solve(system, b, x);
	factor_->x          = ofLower;
	return isDone;
}

bool SupernodalFactor::solve(int system, const Eigen::VectorXd& b, Eigen::VectorXd& x)
{
	cholmod_dense B {};
	B.nrow = B.nzmax = B.d = b.size();
	B.ncol                 = 1;
	B.x                    = const_cast<double*>(b.data());
	B.xtype                = CHOLMOD_REAL;
	B.dtype                = CHOLMOD_DOUBLE;
	cholmod_dense* X       = cholmod_solve(system, factor_, &B, &common_);
	if (!X) return false;
	x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(X->x), b.size());
	cholmod_free_dense(&X, &common_);
	return x.allFinite();
}

void SupernodalFactor::lastBlock(Eigen::MatrixXd& block) const
{
	const auto&   L        = *factor_;
	const auto    integers = [](const void* p) { return static_cast<const int*>(p); };
	const int *   columns = integers(L.super), *places = integers(L.pi), *values = integers(L.px), *rows = integers(L.s);
	const int     first = int(L.n) - int(block.rows());
	const double* x     = static_cast<const double*>(L.x);
	block.setZero();
	for (int s = int(L.nsuper) - 1; s >= 0 && columns[s + 1] > first; --s) {
		const int height = places[s + 1] - places[s];
		for (int c = std::max(columns[s], first); c < columns[s + 1]; ++c)
			for (int i = c - columns[s]; i < height; ++i) // its first rows are its columns
				block(rows[places[s] + i] - first, c - first) = x[values[s] + i + (c - columns[s]) * std::ptrdiff_t(height)];
	}
}

} // namespace gimpm
