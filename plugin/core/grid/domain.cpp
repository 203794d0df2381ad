// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/domain.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace gimpm {
namespace {

/// Bound on the passes of a reduction, which a flattened domain reaches by round-off alone.
constexpr int mostPasses = 64;

/// Replaces lattice vectors by integer combinations of each other until none becomes shorter (Lagrange and Gauss, pair
/// by pair): the lattice stays.
template <int Dim> void reduceBasis(Mat<Dim>& basis)
{
	bool isReduced = false;
	for (int pass = 0; pass < mostPasses && !isReduced; ++pass) {
		isReduced = true;
		for (int i = 0; i < Dim; ++i)
			for (int j = 0; j < Dim; ++j) {
				if (i == j) continue;
				const double factor = basis.col(i).dot(basis.col(j)) / basis.col(j).squaredNorm();
				if (!(std::abs(factor) > 0.5 + 1e-9) || !std::isfinite(factor)) continue;
				basis.col(i) -= std::nearbyint(factor) * basis.col(j);
				isReduced = false;
			}
	}
}

/// Squares of half lengths over J^(2/Dim), weighted means by axis.
template <int Dim> class LengthFit {
public:
	/// Short vectors of a lattice with a reduced basis: its vectors, their sums and differences in pairs. `scale`:
	/// factor that makes them dimensionless.
	void addLattice(const Mat<Dim>& basis, double scale, bool isReciprocal)
	{
		const Mat<Dim> scaled = scale * basis;
		for (int i = 0; i < Dim; ++i) {
			add(scaled.col(i), isReciprocal);
			for (int j = 0; j < i; ++j) {
				add(scaled.col(i) + scaled.col(j), isReciprocal);
				add(scaled.col(i) - scaled.col(j), isReciprocal);
			}
		}
	}

	/// Half lengths over J^(1/Dim): their product is 1.
	Vec<Dim> solution() const
	{
		const Vec<Dim> inverse = weight.cwiseInverse(), logarithm = 0.5 * sum.cwiseProduct(inverse).array().log();
		return (logarithm - inverse * (logarithm.sum() / inverse.sum())).array().exp();
	}

private:
	void add(const Vec<Dim>& v, bool isReciprocal)
	{
		const Vec<Dim> squares = v.cwiseAbs2();
		const double   length2 = squares.sum();
		for (int a = 0; a < Dim; ++a) {
			const double q = squares[a], qm = (length2 - q) * (q + 4 * (q - 1) * (q - 1)) + exact * q;
			const double inverse = q / qm, w = inverse * inverse;
			weight[a] += w;
			sum[a] += isReciprocal ? inverse / qm : w * q;
		}
	}

	/// Measure m of a vector that is parallel to an axis.
	static constexpr double exact = 1e-14;

	Vec<Dim> weight = Vec<Dim>::Zero(), sum = Vec<Dim>::Zero();
};

} // namespace

template <int Dim> Vec<Dim> stretchAlongAxes(const Mat<Dim>& F)
{
	if constexpr (Dim == 2) { // theorem of Cayley and Hamilton: U = (C + J) / sqrt(tr C + 2 J)
		const double J = F.determinant(), cxx = F.col(0).squaredNorm(), cyy = F.col(1).squaredNorm();
		return Vec<2>(cxx + J, cyy + J) / std::sqrt(cxx + cyy + 2 * J);
	} else {
		const Eigen::SelfAdjointEigenSolver<Mat3> eigen(Mat3(F.transpose() * F));
		// An eigenvalue of 1e-8 others is lost in round-off.
		const Vec3 stretch = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
		return eigen.eigenvectors().cwiseAbs2() * stretch;
	}
}

template <int Dim> Vec<Dim> tilingDomain(const Mat<Dim>& edges)
{
	if (!(edges.determinant() > 0)) return Vec<Dim>::Zero();
	// A power of two, so that scaled scenes have scaled domains to the last bit.
	const double unit  = std::ldexp(1., std::ilogb(edges.cwiseAbs().maxCoeff()));
	Mat<Dim>     basis = edges / unit;
	const double J = basis.determinant(), mean = Dim == 2 ? std::sqrt(J) : std::cbrt(J);
	reduceBasis<Dim>(basis);
	LengthFit<Dim> fit;
	fit.addLattice(basis, 1 / mean, false);
	if constexpr (Dim == 3) { // in the plane the reciprocal lattice is the lattice, turned by 90 degrees
		Mat3 reciprocal = basis.inverse().transpose();
		reduceBasis<3>(reciprocal);
		fit.addLattice(reciprocal, mean, true);
	}
	return unit * mean * fit.solution();
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template Vec<Dim> stretchAlongAxes<Dim>(const Mat<Dim>&);                                                                                              \
	template Vec<Dim> tilingDomain<Dim>(const Mat<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
