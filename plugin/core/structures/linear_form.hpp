// SPDX-License-Identifier: GPL-2.0-or-later
// Energies of a few coordinates that are linear in many unknowns, and their sum.
#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <vector>

namespace gimpm {

/// A coordinate of an element: a sum of a few unknowns, each times a factor. What is held is left out.
struct LinearForm {
	int                   count = 0;
	std::array<int, 4>    index {};
	std::array<double, 4> factor {};

	void add(int unknown, double times)
	{
		if (unknown < 0 || times == 0) return;
		index[count]    = unknown;
		factor[count++] = times;
	}
	double at(const Eigen::VectorXd& x) const
	{
		double sum = 0;
		for (int i = 0; i < count; ++i)
			sum += factor[i] * x[index[i]];
		return sum;
	}
};

/// An energy as a function of N coordinates, and its derivatives.
template <int N> struct Energy {
	double                      value    = 0;
	Eigen::Matrix<double, N, 1> gradient = Eigen::Matrix<double, N, 1>::Zero();
	Eigen::Matrix<double, N, N> hessian  = Eigen::Matrix<double, N, N>::Zero();
};

/// A sum of energies as a function of all unknowns.
struct EnergySum {
	double                              value = 0;
	Eigen::VectorXd                     gradient;
	Eigen::VectorXd                     absoluteContributions; ///< sums of the magnitudes that make up the gradient
	std::vector<Eigen::Triplet<double>> hessian;

	explicit EnergySum(Eigen::Index unknowns) : gradient(Eigen::VectorXd::Zero(unknowns)), absoluteContributions(gradient) { }

	template <int N> void add(const std::array<LinearForm, N>& of, const Energy<N>& energy)
	{
		value += energy.value;
		for (int a = 0; a < N; ++a)
			for (int i = 0; i < of[a].count; ++i) {
				const double part = of[a].factor[i] * energy.gradient[a];
				gradient[of[a].index[i]] += part;
				absoluteContributions[of[a].index[i]] += std::abs(part);
				for (int b = 0; b < N; ++b)
					for (int j = 0; j < of[b].count; ++j)
						hessian.emplace_back(of[a].index[i], of[b].index[j], of[a].factor[i] * energy.hessian(a, b) * of[b].factor[j]);
			}
	}
};

} // namespace gimpm
