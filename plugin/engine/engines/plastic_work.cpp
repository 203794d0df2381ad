// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/plastic_work.hpp"
#include "engine/points/parallel.hpp"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <numeric>

namespace yade {

namespace {
	template <class F> Matrix3r ofEigenvalues(const Matrix3r& symmetric, F&& f)
	{
		const Eigen::SelfAdjointEigenSolver<Matrix3r> eigen(symmetric);
		return eigen.eigenvectors() * eigen.eigenvalues().unaryExpr(f).asDiagonal() * eigen.eigenvectors().transpose();
	}

	template <int Dim> Matrix3r defGradOf(const gimpm::PointCloud<Dim>& cloud, size_t p)
	{
		Matrix3r F                           = Matrix3r::Identity();
		F.template topLeftCorner<Dim, Dim>() = cloud.defGrad[p];
		if (!cloud.hoopStretch.empty()) F(2, 2) = cloud.hoopStretch[p];
		return F;
	}

	template <int Dim> Real workOf(const gimpm::PointCloud<Dim>& cloud, size_t p, const MpmState& before)
	{
		const Matrix3r F         = defGradOf(cloud, p) * before.defGrad.inverse();
		const Matrix3r b         = F * ofEigenvalues(before.elasticStrain, [](Real e) { return std::exp(2 * e); }) * F.transpose();
		const Matrix3r trial     = ofEigenvalues(b, [](Real x) { return 0.5 * std::log(x); });
		const Matrix3r kirchhoff = cloud.volumeRatio(p) * cloud.stress[p].full() + before.defGrad.determinant() * before.stress;
		return cloud.volume0[p] / 2 * kirchhoff.cwiseProduct(trial - cloud.elasticStrain[p].full()).sum();
	}
}

template <int Dim> Real plasticWork(const gimpm::PointCloud<Dim>& cloud, const std::vector<gimpm::Material>& materials, const vector<MaterialPoint>& points)
{
	std::vector<Real> work(points.size(), 0);
	inRanges(points.size(), [&](size_t begin, size_t end) {
		for (size_t p = begin; p < end; ++p)
			if (!materials[cloud.material[p]].law->isElastic) work[p] = workOf(cloud, p, *points[p].state);
	});
	return std::accumulate(work.begin(), work.end(), Real(0)); // in the order of the points, whatever the threads
}

template Real plasticWork(const gimpm::PointCloud<2>&, const std::vector<gimpm::Material>&, const vector<MaterialPoint>&);
template Real plasticWork(const gimpm::PointCloud<3>&, const std::vector<gimpm::Material>&, const vector<MaterialPoint>&);

} // namespace yade
