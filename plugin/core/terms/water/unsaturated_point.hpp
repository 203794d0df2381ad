// SPDX-License-Identifier: GPL-2.0-or-later
// Water in the pores of one point that need not be full, at an iterate.
#pragma once
#include "core/materials/retention.hpp"
#include "core/terms/water/flow_point.hpp"
#include "core/terms/water/soil_water.hpp"

namespace gimpm {

/// Degree of saturation and relative permeability; one in soil that is always saturated.
inline Retention::Value saturationOf(const Pores& pores, double pressure)
{
	return pores.retention ? pores.retention->saturation(pressure) : Retention::Value { 1, 0 };
}
inline Retention::Value permeabilityOf(const Pores& pores, double pressure)
{
	return pores.retention ? pores.retention->relativePermeability(pressure) : Retention::Value { 1, 0 };
}

/// Degree of saturation and relative permeability at the pressure of a node.
struct NodeWetness {
	Retention::Value saturation { 1, 0 }, permeability { 1, 0 };
};

/// Pressure that acts on the grains: chi p, with Bishop's factor chi of a suction, and one of a pressure.
inline Retention::Value pressureOnGrains(const Pores& pores, Bishop bishop, double pressure)
{
	if (!pores.retention || pressure >= 0) return { pressure, 1 };
	const auto chi = bishop == Bishop::saturation ? pores.retention->saturation(pressure) : pores.retention->effective(pressure);
	return { chi.value * pressure, chi.value + chi.slope * pressure };
}

/// Lumped storage: each node has the saturation of its own pressure, so that fronts into dry soil do not undershoot
/// (Celia and others 1990). The increment is the difference of the contents at the ends of the step.
///
/// The permeability is for a quarter that of the nodes, else that at the pressure of the point. The first drives a
/// front on in the cell where it is, the second holds it back.
template <int Dim> struct UnsaturatedPoint {
	static constexpr int    nodes   = windowNodes<Dim>;
	static constexpr double ofNodes = 0.25;

	double           stored[nodes] {};     ///< by node: growth of the content over the initial volume [-]
	double           saturation[nodes] {}; ///< of each node
	double           capacity[nodes] {};   ///< derivative of the content by its pressure [1/Pa]
	double           filled;               ///< content of full pores, over the initial volume [-]
	double           content = 0;          ///< of water [-]
	Retention::Value push;                 ///< pressure on the grains [Pa]
	double           opening[nodes] {};    ///< derivative of the relative permeability by its pressure [1/Pa]
	double           permeability;         ///< relative
	Vec<Dim>         drive;                ///< gradient of the pressure less the weight of the water [Pa/m]

	/// `before`, `now`: curves of the point at all nodes, as the step begins and at the iterate. `correction`: what
	/// it has more than the nodes say.
	UnsaturatedPoint(
	        const WholeWater<Dim>& water, const PorePoint& point, const std::vector<NodeWetness>& before, const std::vector<NodeWetness>& now,
	        double correction, const Patch<Dim>& patch, const PointFunctions<Dim>& f, const FlowPoint<Dim>& s)
	        : filled(point.content + s.content)
	        , push(pressureOnGrains(*point.pores, water.bishop, s.pressure))
	        , permeability(0)
	        , drive(s.pressureGradient - water.weight)
	{
		const auto here = permeabilityOf(*point.pores, s.pressure);
		permeability    = (1 - ofNodes) * here.value;
		for (int n = 0; n < f.count; ++n) {
			if (patch.node[n] < 0) continue;
			const auto& [S, k] = now[patch.node[n]];
			permeability += ofNodes * f.value[n] * k.value;
			opening[n]    = f.value[n] * ((1 - ofNodes) * here.slope + ofNodes * k.slope);
			saturation[n] = S.value, capacity[n] = S.slope * filled;
			stored[n] = S.value * s.content + (S.value - before[patch.node[n]].saturation.value) * point.content - correction;
			content += f.value[n] * S.value * filled;
		}
	}
};

} // namespace gimpm
