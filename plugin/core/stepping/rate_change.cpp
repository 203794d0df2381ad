// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/rate_change.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/terms/points/point_update.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace gimpm {
namespace {

/// The sum over the points, in their order, where they are divided over the own ones of all processes: copies have no
/// volume.
template <int Dim> double weighed(const StepSystem<Dim>& system, const std::vector<double>& volume, const std::vector<double>& ofPoints)
{
	const double own = std::inner_product(volume.begin(), volume.end(), ofPoints.begin(), 0.);
	return system.model.division->sum(own);
}

/// Root of the mean square of a nodal vector at the points.
template <int Dim> double atPoints(const StepSystem<Dim>& system, const Eigen::VectorXd& nodal)
{
	std::vector<double> squares(system.points.volume0.size());
	forPointNodes(system.basis, [&](int i, const Patch<Dim>& patch, const double* value, int count) {
		squares[i] = atPoint(patch, value, count, nodal).squaredNorm();
	});
	std::vector<double> volume = system.points.volume0;
	const int           own    = system.model.division->ownOf(volume.size());
	for (std::size_t i = 0; i < volume.size(); ++i)
		if (system.basis.order[i] >= own) volume[i] = 0;
	return std::sqrt(weighed(system, volume, squares) / weighed(system, volume, std::vector<double>(volume.size(), 1)));
}

/// |plastic strain| / |strain| of the step, both as roots of mean squares, at most 1. The trial elastic strain, what is
/// left of it and what has become plastic, is what an elastic law would answer.
template <int Dim> double plasticShare(const StepSystem<Dim>& system, const Eigen::VectorXd& d)
{
	const auto& materials = system.model.materials;
	if (std::all_of(materials.begin(), materials.end(), [](const Material& m) { return m.law->isElastic; })) return 0;
	std::vector<double>         volume = system.cloud.volume0;
	std::vector<SymTensor<Dim>> trial(volume.size());
	std::vector<double>         all(volume.size()), plastic(volume.size());
	forUpdatedPoints(
	        system.basis, system.points, std::vector<Material>(materials.size(), { Law::ofTrialStrain(), 1 }), d, [&](int p, const PointUpdate<Dim>& u) {
		        trial[p] = u.elasticStrain;
		        all[p]   = (u.gradient + u.gradient.transpose()).squaredNorm() / 4 + u.hoop * u.hoop;
	        });
	forUpdatedPoints(system.basis, system.points, materials, d, [&](int p, const PointUpdate<Dim>& u) {
		plastic[p] = (trial[p].full() - u.elasticStrain.full()).squaredNorm();
	});
	std::fill(volume.begin() + system.model.division->ownOf(volume.size()), volume.end(), 0);
	const double of = weighed(system, volume, plastic), whole = weighed(system, volume, all);
	return of < whole ? std::sqrt(of / whole) : of > 0 ? 1 : 0;
}

} // namespace

template <int Dim>
LocalError rateChange(const StepSystem<Dim>& system, const LastIncrement<Dim>& last, double load, const Eigen::VectorXd& prediction, const Eigen::VectorXd& d)
{
	constexpr int order = 2;
	const double  share = plasticShare(system, d);
	const double  size  = share > 0 ? share * load / (load + last.load) * atPoints<Dim>(system, d - prediction) : 0;
	return { size, system.model.newton.stepTolerance, order };
}

template LocalError rateChange(const StepSystem<2>&, const LastIncrement<2>&, double, const Eigen::VectorXd&, const Eigen::VectorXd&);
template LocalError rateChange(const StepSystem<3>&, const LastIncrement<3>&, double, const Eigen::VectorXd&, const Eigen::VectorXd&);

} // namespace gimpm
