// SPDX-License-Identifier: GPL-2.0-or-later
// The response of points side by side, for the kernels that compute it.
#pragma once
#include "core/terms/points/law_response.hpp"
#include "core/terms/points/point_kernel.hpp"

namespace gimpm {

/// Response of points to the gradient of the incremental displacement.
template <int Dim> struct BatchResponse {
	using OfLaw = LanesOfLaws;

	Principal<Dim, Lanes>  trial; ///< principal values and axes of b - 1
	PrincipalValues<Lanes> strain;
	OfLaw                  law;          ///< in each lane that of the law of the point, with that of water which cannot leave its pores
	Lanes                  water { 0. }; ///< part of the principal stresses that is the water's

	template <int Axes>
	GIMPM_INLINE BatchResponse(
	        const Batch& batch, const StepPoints<Dim>& points, const std::vector<Material>& materials, const Increment<Dim, Axes>& increment)
	        : trial(principal(pushForward(leftCauchyGreen(batch, points), increment))), strain(logStrain(trial.value))
	{
		respond(materials[points.material[batch.point[0]]], batch, points, law);
		for (int lane = 1; lane < Lanes::count; ++lane) { // seldom: another material among them
			const int material = points.material[batch.point[lane]];
			if (material == points.material[batch.point[lane - 1]]) continue;
			OfLaw other;
			respond(materials[material], batch, points, other);
			for (int l = lane; l < Lanes::count; ++l) {
				law.takeLane(l, other);
				if constexpr (LawTraits<PrincipalLaws>::mayFail) law.failed.v[l] = other.failed[l];
			}
		}
		if (points.hasWater()) addWater(batch, points, materials);
	}

	/// Principal stresses without the water's part.
	GIMPM_INLINE PrincipalValues<Lanes> effectiveStress(const StepPoints<Dim>& points) const
	{
		PrincipalValues<Lanes> stress = law.stress;
		for (int i = 0; i < 3 && points.hasWater(); ++i)
			stress[i] = stress[i] - water;
		return stress;
	}

private:
	/// Adds pore water: an elastic fluid of Hencky's law.
	GIMPM_INLINE void addWater(const Batch& batch, const StepPoints<Dim>& points, const std::vector<Material>& materials)
	{
		const Lanes modulus = batch.load([&](int p) GIMPM_INLINE_LAMBDA { return materials[points.material[p]].waterModulus; });
		water               = batch.load([&](int p) GIMPM_INLINE_LAMBDA { return points.water[p]; }) + modulus * (strain[0] + strain[1] + strain[2]);
		for (int i = 0; i < 3; ++i) {
			law.stress[i] += water;
			for (int j = 0; j < 3; ++j)
				law.tangent(i, j) += modulus;
		}
	}
	GIMPM_INLINE static SymTensor<Dim, Lanes> leftCauchyGreen(const Batch& batch, const StepPoints<Dim>& points)
	{
		SymTensor<Dim, Lanes> b1;
		for (int k = 0; k < b1.size; ++k)
			b1.c[k] = batch.load([&](int p) GIMPM_INLINE_LAMBDA { return points.leftCauchyGreen[p].c[k]; });
		return b1;
	}
	/// In the lanes of other materials there are any numbers.
	GIMPM_INLINE void respond(const Material& material, const Batch& batch, const StepPoints<Dim>& points, OfLaw& response) const
	{
		respondTogether(material, points.parameters, points.internals, batch.point, strain, response);
	}
};

} // namespace gimpm
