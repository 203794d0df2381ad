// SPDX-License-Identifier: GPL-2.0-or-later
// Hencky elasticity: Kirchhoff stress linear in the logarithmic strain.
#pragma once
#include "core/materials/internal_variable.hpp"
#include "core/materials/response.hpp"
#include "core/materials/weakening.hpp"

namespace gimpm {

class Hencky {
public:
	/// young > 0 [Pa], -1 < poisson < 0.5.
	Hencky(double young, double poisson) : young_(young), poisson_(poisson), bulk_(young / (3 * (1 - 2 * poisson))), shear_(young / (2 * (1 + poisson))) { }

	static constexpr std::array<InternalVariable, 0> variables {};
	static constexpr bool                            mayFail = false, isShort = true, isElastic = true, isLinear = true, canBeWeakened = false;

	/// Parameters that may differ from point to point: Young's modulus.
	using Parameters = std::array<double, 1>;
	Parameters parameters() const { return { young_ }; }
	Hencky     with(const Parameters& p) const { return { p[0], poisson() }; }
	Parameters weakened(const Weakening& w) const { return { young_ * w.moduli }; }

	std::array<double, 0> initialInternals() const { return {}; }

	bool isSymmetric() const { return true; }

	double young(const std::array<double, 0>& = {}) const { return young_; }
	double poisson() const { return poisson_; }
	double bulk() const { return bulk_; }
	double shear() const { return shear_; }

	/// Principal elastic strains of principal stresses.
	template <class T> GIMPM_INLINE PrincipalValues<T> strainOf(const PrincipalValues<T>& stress) const
	{
		const T mean = T(1. / 3) * (stress[0] + stress[1] + stress[2]), volumetric = T(1 / (3 * bulk_)) * mean, share = T(1 / (2 * shear_));
		return { share * (stress[0] - mean) + volumetric, share * (stress[1] - mean) + volumetric, share * (stress[2] - mean) + volumetric };
	}

	template <class T> ResponseWith<T, 0> respond(const PrincipalValues<T>& trialStrain, const std::array<T, 0>&) const
	{
		const T            lambda = bulk_ - 2. / 3 * shear_, pressure = lambda * (trialStrain[0] + trialStrain[1] + trialStrain[2]);
		ResponseWith<T, 0> r;
		for (int i = 0; i < 3; ++i) {
			r.stress[i] = T(2 * shear_) * trialStrain[i] + pressure;
			for (int j = 0; j < 3; ++j)
				r.tangent(i, j) = i == j ? lambda + T(2 * shear_) : lambda;
		}
		r.shear.fill(T(shear_));
		r.elasticStrain = trialStrain;
		return r;
	}
	ResponseWith<double, 0> respond(const Vec3& trialStrain, const std::array<double, 0>& internals) const
	{
		return respond<double>(trialStrain, internals);
	}

private:
	double young_, poisson_, bulk_, shear_;
};

} // namespace gimpm
