// SPDX-License-Identifier: GPL-2.0-or-later
// A law that the plugin does not have, for tests: elasticity that remembers the largest pressure, and has no answer
// beyond a limit.
#pragma once
#include "core/materials/hencky.hpp"

namespace gimpm {

class Remembering {
public:
	Remembering(double young, double initialPressure, double limit) : elastic_(young, 0), initial_(initialPressure), limit_(limit) { }

	static constexpr std::array<InternalVariable, 1> variables { { { "largestPressure", "Pa", "largest pressure", positive, anyNumber } } };
	static constexpr bool                            mayFail = true, isShort = false, isElastic = false, isLinear = true, canBeWeakened = false;

	using Parameters = std::array<double, 0>;
	Parameters  parameters() const { return {}; }
	Remembering with(const Parameters&) const { return *this; }
	Parameters  weakened(const Weakening&) const { return {}; }
	bool        isSymmetric() const { return true; }

	std::array<double, 1> initialInternals() const { return { initial_ }; }

	/// It stiffens under pressure: only the ghost stabilisation and round-off ask.
	double young(const std::array<double, 1>& internals) const { return elastic_.young() * internals[0] / initial_; }

	template <class T> ResponseWith<T, 1> respond(const PrincipalValues<T>& trialStrain, const std::array<T, 1>& internals) const
	{
		ResponseWith<T, 1> r;
		r.take(elastic_.respond<T>(trialStrain, {}));
		const T pressure = T(-1. / 3) * (r.stress[0] + r.stress[1] + r.stress[2]);
		r.internals[0]   = select(pressure > internals[0], pressure, internals[0]);
		r.failed         = select(pressure > T(limit_), T(1), T(0));
		return r;
	}
	ResponseWith<double, 1> respond(const Vec3& trialStrain, const std::array<double, 1>& internals) const
	{
		return respond<double>(trialStrain, internals);
	}

private:
	Hencky elastic_;
	double initial_, limit_;
};

} // namespace gimpm
