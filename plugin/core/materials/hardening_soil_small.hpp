// SPDX-License-Identifier: GPL-2.0-or-later
// Hardening soil with small-strain stiffness (Benz 2007, Small-strain stiffness of soils and its numerical
// consequences): where strain has turned back the shear modulus is G0, and falls with the shear strain g since then, as
// G0 / (1 + .385 g / g07)^2 (Hardin and Drnevich 1972), to that of unloading. Poisson's ratio stays.
//
// Strain turns back where the step leads against the strain since the last turn: the more it does, the more of that
// strain is forgotten, so that stress has no jump. A step across is no turn.
#pragma once
#include "core/materials/hardening_soil.hpp"

namespace gimpm {

class HardeningSoilSmall : public HardeningSoil {
public:
	/// Small-strain shear: modulus G0 [Pa] at the reference pressure, no less than that of unloading, and the shear
	/// strain > 0 at which the secant modulus is 0.722 of it.
	HardeningSoilSmall(const Given& given, double smallest, double strain);

	enum { strainHistory = 6 };
	static constexpr std::array<TensorVariable, 7> variables { HardeningSoil::variables[0],
		                                                   HardeningSoil::variables[1],
		                                                   HardeningSoil::variables[2],
		                                                   HardeningSoil::variables[3],
		                                                   HardeningSoil::variables[4],
		                                                   HardeningSoil::variables[5],
		                                                   TensorVariable::tensor("strainHistory", "-", "shear strain since it turned") };
	TensorState                                    initialInternals() const;

	/// Behind those of hardening soil: G0.
	using Parameters = std::array<double, 7>;
	Parameters         parameters() const;
	HardeningSoilSmall with(const Parameters&) const;
	Parameters         weakened(const Weakening&) const { return parameters(); }

	TensorAnswer respond(const TensorStep& step) const { return answer(step, true); }
	TensorAnswer elastic(const TensorStep& step) const { return answer(step, false); }

private:
	static constexpr double decay = .385; ///< the secant modulus at g07 is G0 / (1 + decay)

	/// Curve of shear without turns.
	struct Curve {
		double stress, tangent, bend; ///< secant modulus times strain, and its derivatives by it
	};
	struct Mean {
		double modulus, byBegin, byEnd; ///< shear modulus, and its derivatives by both strains
	};
	/// Turn of the history by a step.
	struct Turn {
		Mat3   after;                                            ///< the strain that is remembered
		double from = 0, to = 0;                                 ///< shear strains between which the modulus is taken
		Mat3   fromByStep = Mat3::Zero(), byStep = Mat3::Zero(); ///< and their derivatives by the deviator of the step
	};
	TensorAnswer answer(const TensorStep&, bool flows) const;
	Curve        at(double strain) const;
	Mean         between(double from, double to) const;
	Turn         turnOf(const Mat3& history, const Mat3& shearing) const;

	double first_, strain_, most_ = 0; ///< G0; g07; strain from which on the modulus is that of unloading
};

} // namespace gimpm
