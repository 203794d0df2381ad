// SPDX-License-Identifier: GPL-2.0-or-later
// Permeability of the pores of a soil to water.
#pragma once
#include <limits>

namespace gimpm {

struct Retention;

struct Pores {
	enum class Law { constant, kozenyCarman, logarithmic };

	/// Parameters of the retention curve of a point, in place of its material's.
	struct OwnCurve {
		double alpha, exponent, residual, saturated;
	};

	/// At the initial porosity, over the weight of water [m2/(Pa s)].
	double conductivity = std::numeric_limits<double>::quiet_NaN();
	double porosity     = std::numeric_limits<double>::quiet_NaN(); ///< part of the initial volume [-]
	Law    law          = Law::constant;
	/// Change of the void ratio for ten times the conductivity, in the logarithmic law [-].
	double           index       = std::numeric_limits<double>::quiet_NaN();
	bool             areRigid    = false;   ///< water passes without pressing on the grains, and their strain displaces no water
	const Retention* retention   = nullptr; ///< null: the pores are always full
	long             curve       = -1;      ///< its number among the curves of the scene, the same in all processes; -1: there is none
	bool             hasOwnCurve = false;   ///< `retention` is that of the number with what `ownCurve` has
	OwnCurve         ownCurve {};
	double           verticalRatio = 1; ///< vertical over horizontal conductivity [-]; `conductivity` is the horizontal one
	double           weightPart    = 1; ///< part of the weight of the soil that acts [-], in a stage of construction

	/// Horizontal conductivity for the water in a volume that was 1 at first, which now is J.
	struct Conductivity {
		double value;         ///< [m2/(Pa s)]
		double logDerivative; ///< d ln value / d ln J
	};
	Conductivity at(double J) const;

	/// Largest conductivity of all directions over the horizontal one.
	double largestRatio() const { return verticalRatio > 1 ? verticalRatio : 1; }

	/// Coupling of strain and pressure [-].
	double coupling() const { return areRigid ? 0 : 1; }

	/// True if grains, which keep their volume, leave room for water.
	bool areOpen(double J) const { return J > 1 - porosity; }
};

} // namespace gimpm
