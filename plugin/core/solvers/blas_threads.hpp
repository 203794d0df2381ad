// SPDX-License-Identifier: GPL-2.0-or-later
// How many threads a factorisation is worth.
#pragma once

namespace gimpm {

/// For its lifetime. CHOLMOD opens its own OpenMP threads for every supernode, which costs more than it gains; so do the threads of the BLAS
/// if the matrix is not large.
class FewerThreads {
public:
	/// For a factorisation of so many operations.
	explicit FewerThreads(double flops);
	~FewerThreads();
	FewerThreads(const FewerThreads&)            = delete;
	FewerThreads& operator=(const FewerThreads&) = delete;

private:
	int levels_, blas_; // before; 1 if they are left alone
};

} // namespace gimpm
