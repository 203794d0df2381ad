// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/critical_step.hpp"
#include "core/grid/refinement.hpp"
#include "core/terms/inertia/absorbing.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// At least h omega_max / c of the body alone (tests/core/stepping/test_explicit.cpp).
double factor(int dim, double ghostMass, double spacing)
{
	if (ghostMass == 0) return 3.6;
	const double few = std::max(0., std::min(spacing, 1.) - 0.75);
	return std::max(dim == 2 ? 4.8 : 5.2, 1.5 * std::pow(ghostMass, -0.36)) * (1 + 56 * few * few);
}

} // namespace

/// Under compression the modulus of a wave is larger by twice the stress.
template <int Dim> Stiffest stiffestOfOwn(const PointCloud<Dim>& cloud, const Model<Dim>& model)
{
	double wave = 0, bar = 0, spacing = 0;
#pragma omp parallel for reduction(max : wave, bar, spacing)
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		const auto&  material = model.materials[cloud.material[p]];
		const double young    = material.young(cloud.parameters, cloud.internals, p, [&] { return cloud.elasticStrain[p].full().trace(); });
		const double stress   = cloud.volumeRatio(p) * cloud.stress[p].full().norm();
		wave                  = std::max(wave, (waveModuli(model.materials, cloud, int(p)).pressure + 2 * stress) / material.density);
		bar                   = std::max(bar, young / material.density);
		spacing               = std::max(spacing, cloud.halfSize[p].maxCoeff() / largestHalf(model.grid, cloud.position[p]));
	}
	return { wave, bar, spacing };
}

template <int Dim> Stiffest stiffest(const PointCloud<Dim>& cloud, const Model<Dim>& model)
{
	const Stiffest  own      = stiffestOfOwn(cloud, model);
	const Division& division = *model.division;
	return { division.largest(own.pressureWave), division.largest(own.bar), division.largest(own.spacing) };
}

template <int Dim> double criticalStep(const PointCloud<Dim>& cloud, const Model<Dim>& model, double ghostMass, double penalty)
{
	const Stiffest most = stiffest(cloud, model);
	const double   h = model.grid.cellSize, C = factor(Dim, ghostMass, most.spacing);
	const double   scale = model.ghost.scaling == GhostScaling::paper ? h * h : 1;
	const double   ghost = ghostMass > 0 ? model.ghost.factor * scale / ghostMass : 0;
	for (const auto& [box, wall] : model.walls)
		penalty = std::max(penalty, wall->penalty);
	return 2 * h / std::sqrt(C * C * most.pressureWave + (ghost + 16 * penalty) * most.bar);
}

template Stiffest stiffestOfOwn(const PointCloud<2>&, const Model<2>&);
template Stiffest stiffestOfOwn(const PointCloud<3>&, const Model<3>&);
template Stiffest stiffest(const PointCloud<2>&, const Model<2>&);
template Stiffest stiffest(const PointCloud<3>&, const Model<3>&);
template double   criticalStep(const PointCloud<2>&, const Model<2>&, double, double);
template double   criticalStep(const PointCloud<3>&, const Model<3>&, double, double);

} // namespace gimpm
