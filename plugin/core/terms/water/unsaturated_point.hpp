// SPDX-License-Identifier: GPL-2.0-or-later
// Water in the pores of one point that need not be full, at an iterate.
#pragma once
#include "core/materials/retention.hpp"
#include "core/terms/water/flow_point.hpp"
#include "core/terms/water/soil_water.hpp"

namespace gimpm {

/// Curve of a point that has parameters of its own.
inline Retention ownCurveOf(const Pores& pores, const Retention& ofMaterial)
{
	Retention own = ofMaterial;
	own.alpha = pores.ownCurve.alpha, own.exponent = pores.ownCurve.exponent;
	own.residual = pores.ownCurve.residual, own.saturated = pores.ownCurve.saturated;
	return own;
}

/// True if points of a material differ in their curves: no node can have a value for all of them.
inline bool hasCurveByPoint(const Pores& pores) { return pores.retention && (pores.hasOwnCurve || pores.retention->voidExponent != 0); }

/// Factor of the suction in a volume that was 1 at first and now is J: a power of the void ratio over the initial one.
inline double suctionFactor(const Pores& pores, double J)
{
	const double power = pores.retention->voidExponent;
	return power == 0 ? 1 : std::pow((J - 1 + pores.porosity) / pores.porosity, power);
}
/// Its logarithm's derivative by that of J.
inline double suctionGrowth(const Pores& pores, double J)
{
	return !pores.retention || pores.retention->voidExponent == 0 ? 0 : pores.retention->voidExponent * J / (J - 1 + pores.porosity);
}

/// Degree of saturation and relative permeability; one in soil that is always saturated.
inline Retention::Value saturationOf(const Pores& pores, double pressure, double J)
{
	if (!pores.retention) return { 1, 0 };
	const double factor = suctionFactor(pores, J);
	const auto   found  = pores.retention->saturation(factor * pressure);
	return { found.value, factor * found.slope };
}
inline Retention::Value permeabilityOf(const Pores& pores, double pressure, double J)
{
	if (!pores.retention) return { 1, 0 };
	const double factor = suctionFactor(pores, J);
	const auto   found  = pores.retention->relativePermeability(factor * pressure);
	return { found.value, factor * found.slope };
}

/// Degree of saturation and relative permeability at the pressure of a node.
struct NodeWetness {
	Retention::Value saturation { 1, 0 }, permeability { 1, 0 };
};
inline NodeWetness wetnessOf(const Pores& pores, double pressure, double J) { return { saturationOf(pores, pressure, J), permeabilityOf(pores, pressure, J) }; }

/// Pressure that acts on the grains: chi p, with Bishop's factor chi of a suction, and one of a pressure.
inline Retention::Value pressureOnGrains(const Pores& pores, Bishop bishop, double pressure, double J)
{
	if (!pores.retention || pressure >= 0) return { pressure, 1 };
	const double counted = suctionFactor(pores, J) * pressure;
	const auto   chi     = bishop == Bishop::saturation ? pores.retention->saturation(counted) : pores.retention->effective(counted);
	return { chi.value * pressure, chi.value + chi.slope * counted };
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
	double           growth[nodes] {};     ///< of its content by ln J, as the curve changes
	double           filled;               ///< content of full pores, over the initial volume [-]
	double           content = 0;          ///< of water [-]
	Retention::Value push;                 ///< pressure on the grains [Pa]
	double           opening[nodes] {};    ///< derivative of the relative permeability by its pressure [1/Pa]
	double           permeability;         ///< relative
	/// Growth of the push, of the permeability and of the content by ln J, as the curve changes.
	double   pushGrowth, openingGrowth = 0, contentGrowth = 0;
	Vec<Dim> drive; ///< gradient of the pressure less the weight of the water [Pa/m]

	/// `before(node)`, `now(node)`: saturation as the step begins, wetness at the iterate, by the point's curve.
	/// `correction`: what it has more than the nodes say.
	template <class Before, class Now>
	UnsaturatedPoint(
	        const WholeWater<Dim>& water, const PorePoint& point, Before&& before, Now&& now, const Eigen::VectorXd& P, double correction,
	        const Patch<Dim>& patch, const PointFunctions<Dim>& f, const FlowPoint<Dim>& s)
	        : filled(point.content + s.content)
	        , push(pressureOnGrains(*point.pores, water.bishop, s.pressure, s.poreRatio(point)))
	        , permeability(0)
	        , drive(s.pressureGradient - water.weight)
	{
		const double grows = point.coupling() * suctionGrowth(*point.pores, s.poreRatio(point));
		const auto   here  = permeabilityOf(*point.pores, s.pressure, s.poreRatio(point));
		permeability       = (1 - ofNodes) * here.value;
		pushGrowth         = grows * (push.slope * s.pressure - push.value);
		for (int n = 0; n < f.count; ++n) {
			if (patch.node[n] < 0) continue;
			const auto& [S, k] = now(patch.node[n]);
			permeability += ofNodes * f.value[n] * k.value;
			opening[n]    = f.value[n] * ((1 - ofNodes) * here.slope + ofNodes * k.slope);
			saturation[n] = S.value, capacity[n] = S.slope * filled;
			stored[n] = S.value * s.content + (S.value - before(patch.node[n])) * point.content - correction;
			content += f.value[n] * S.value * filled;
			if (grows == 0) continue;
			growth[n] = grows * capacity[n] * P[patch.node[n]];
			contentGrowth += f.value[n] * growth[n];
			openingGrowth += grows * opening[n] * P[patch.node[n]];
		}
	}
};

} // namespace gimpm
