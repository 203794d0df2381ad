// SPDX-License-Identifier: GPL-2.0-or-later
// Number of threads that a factorisation is worth.
#pragma once

namespace gimpm {

/// The BLAS works in one thread for its lifetime: its threads would wait for each other at every short sum.
class OneBlasThread {
public:
	explicit OneBlasThread(bool isWanted = true);
	~OneBlasThread();
	OneBlasThread(const OneBlasThread&)            = delete;
	OneBlasThread& operator=(const OneBlasThread&) = delete;

private:
	int before_; // 1 if they are left alone
};

/// For its lifetime. CHOLMOD opens its own OpenMP threads for every supernode, which costs more than it gains; so do
/// the threads of the BLAS if the matrix is not large.
class FewerThreads {
public:
	/// For a factorisation of so many operations.
	explicit FewerThreads(double flops);
	~FewerThreads();
	FewerThreads(const FewerThreads&)            = delete;
	FewerThreads& operator=(const FewerThreads&) = delete;

private:
	int           levels_; // before
	OneBlasThread blas_;
};

} // namespace gimpm
