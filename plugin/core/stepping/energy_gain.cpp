// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/energy_gain.hpp"
#include "core/base/sentence.hpp"
#include "core/stepping/outcome.hpp"
#include "core/terms/bodies/body_contact.hpp"
#include "core/terms/inertia/inertia.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

/// Part of the energy in play that a step of bodies in contact may gain: the same as for contact itself
/// (body_contact_end.cpp).
constexpr double mostOfBodies = 1e-3;

/// Spurious energy gain of all points, of all processes where they are divided.
struct EnergyGain {
	double gain   = 0; ///< gain of elastic energy, beyond what stress has taken up on its way [J]
	double inPlay = 0; ///< kinetic and elastic energy as the step begins, and the size of that work [J]

	static constexpr double most = 0.25; ///< part of the energy in play

	bool isAdmissible() const { return !(gain > most * inPlay); }
};

/// Kirchhoff stress over the plane or space of the grid, and around an axis.
template <int Dim> struct KirchhoffStress {
	Mat<Dim> inSpace;
	double   hoop;   ///< stress of a ring
	double   energy; ///< energy of Hencky's elasticity, over the initial volume

	KirchhoffStress(const PointCloud<Dim>& cloud, std::size_t p)
	{
		const double J    = cloud.volumeRatio(p);
		const Mat3   full = J * cloud.stress[p].full();
		inSpace           = full.template topLeftCorner<Dim, Dim>();
		hoop              = full(2, 2);
		energy            = full.cwiseProduct(cloud.elasticStrain[p].full()).sum() / 2;
	}
};

/// Energy gain of one point, without kinetic energy.
template <int Dim> EnergyGain gainOf(const PointCloud<Dim>& before, const PointCloud<Dim>& after, std::size_t p, bool isHencky)
{
	constexpr double           roundOff = 1e-12; // round-off of strains
	const KirchhoffStress<Dim> first(before, p), last(after, p);
	const Mat<Dim>             I = Mat<Dim>::Identity(), &F0 = before.defGrad[p], &F1 = after.defGrad[p];
	double work = (first.inSpace.cwiseProduct(F1 * F0.inverse() - I).sum() + last.inSpace.cwiseProduct(I - F0 * F1.inverse()).sum()) / 2;
	if (!before.hoopStretch.empty()) {
		const double ratio = after.hoopStretch[p] / before.hoopStretch[p];
		work += (first.hoop * (ratio - 1) + last.hoop * (1 - 1 / ratio)) / 2;
	}
	const double V0 = before.volume0[p], inPlay = std::abs(work) + roundOff * (first.inSpace.norm() + last.inSpace.norm());
	if (!isHencky) return { 0, V0 * inPlay };
	return { V0 * (last.energy - first.energy - work), V0 * (inPlay + first.energy) };
}

/// In pieces whose sums do not depend on the number of threads.
template <class F> EnergyGain sumOf(std::size_t count, F&& of)
{
	constexpr std::size_t   atOnce = 1024;
	std::vector<EnergyGain> sums((count + atOnce - 1) / atOnce);
#pragma omp parallel for
	for (std::size_t s = 0; s < sums.size(); ++s)
		for (std::size_t p = s * atOnce; p < std::min(count, (s + 1) * atOnce); ++p) {
			const EnergyGain one = of(p);
			sums[s].gain += one.gain, sums[s].inPlay += one.inPlay;
		}
	EnergyGain all;
	for (const EnergyGain& sum : sums)
		all.gain += sum.gain, all.inPlay += sum.inPlay;
	return all;
}

/// Energy gain of a step. In Newmark's rule the body loses kinetic energy by the mean of the stresses at both ends of
/// the step. Where strains are small in it that is what elastic energy grows by. Where they are large it may grow by
/// much more: Newton's method has then found an equilibrium far from the motion. Plastic flow takes its part, which is
/// no gain. For laws whose elastic energy is not Hencky's nothing is known but the work.
template <int Dim> EnergyGain energyGain(const StepSystem<Dim>& system, const PointCloud<Dim>& before, const PointCloud<Dim>& after)
{
	const auto&       model = system.model;
	std::vector<char> isHencky;
	for (const auto& material : model.materials)
		isHencky.push_back(material.law->isLinear);
	const std::size_t count = model.division->ownOf(before.size());
	EnergyGain        sum   = sumOf(count, [&](std::size_t p) { return gainOf(before, after, p, isHencky[before.material[p]]); });
	sum                     = { model.division->sum(sum.gain), model.division->sum(sum.inPlay) };
	if (system.inertia) sum.inPlay += system.inertia->kineticEnergy();
	return sum;
}

} // namespace

template <int Dim>
bool requireEnergy(const StepSystem<Dim>& system, const PointCloud<Dim>& before, const PointCloud<Dim>& after, const Eigen::VectorXd& d, StepReport& report)
{
	if (!system.hasInertia() || system.model.atMiddle) return true;
	const EnergyGain energy = energyGain(system, before, after);
	if (!energy.isAdmissible())
		return !fail(
		        report, Failure::gainsEnergy,
		        sentence(
		                "integration in time would make ", energy.gain, " J of energy out of nothing, more than ", EnergyGain::most, " of the ",
		                energy.inPlay, " J that are in play"));
	const auto* bodies = system.inertia->motion().bodies;
	if (!bodies || !std::isfinite(bodies->energy) || system.prescribed.any()) return true;
	const double gain = energy.gain - system.inertia->gridWork(d), inPlay = energy.inPlay + bodies->energy;
	if (!(gain > mostOfBodies * inPlay + std::abs(d.dot(system.map.displacements(system.external))))) return true;
	return !fail(
	        report, Failure::gainsEnergy,
	        sentence(
	                "integration in time would make ", gain, " J of energy out of nothing, of ", inPlay,
	                " J that are in play, where bodies of points have met"));
}

template bool requireEnergy(const StepSystem<2>&, const PointCloud<2>&, const PointCloud<2>&, const Eigen::VectorXd&, StepReport&);
template bool requireEnergy(const StepSystem<3>&, const PointCloud<3>&, const PointCloud<3>&, const Eigen::VectorXd&, StepReport&);

} // namespace gimpm
