// SPDX-License-Identifier: GPL-2.0-or-later
// Hencky elasticity with Drucker and Prager's perfect plasticity: cone, apex, and a cut of the mean stress (de Souza
// Neto, Peric and Owen 2008, Computational methods for plasticity, section 8.3, for cone and apex).
#pragma once
#include "core/materials/perfect_plasticity.hpp"

namespace gimpm {

/// Yield function sqrt(J2) + frictionCoefficient p - strength, plastic potential sqrt(J2) + dilation p, with the mean
/// stress p; three ways to match Mohr and Coulomb's law.
struct DruckerPragerCone {
	double frictionCoefficient, dilation, strength; ///< [-], [-], [Pa]

	using Match = DruckerPragerCone (*)(double cohesion, double frictionAngle, double dilationAngle);
	Match  match;                                  ///< the one that made it
	double cohesion, frictionAngle, dilationAngle; ///< from these

	/// The same strength in plane strain, for any dilation: flow without strain out of the plane fixes the stress
	/// there, on which the share of friction in the plane depends. The customary 3 tan phi / sqrt(9 + 12 tan^2 phi)
	/// is the case of associated flow.
	static DruckerPragerCone planeStrain(double cohesion, double frictionAngle, double dilationAngle)
	{
		const double s = std::sin(frictionAngle), q = std::sin(dilationAngle), dilation = 3 * q / std::sqrt(9 + 3 * q * q);
		const double factor = 1 / (std::sqrt(1 - dilation * dilation / 3) + dilation * s / 3);
		return { frictionAngle == dilationAngle ? dilation : factor * s,
			 dilation,
			 factor * std::cos(frictionAngle) * cohesion,
			 &planeStrain,
			 cohesion,
			 frictionAngle,
			 dilationAngle };
	}
	/// The same strength in triaxial compression, and in triaxial extension: the outer and the inner edges of the
	/// pyramid.
	static DruckerPragerCone compression(double cohesion, double frictionAngle, double dilationAngle)
	{
		return triaxial(cohesion, frictionAngle, dilationAngle, -1, &compression);
	}
	static DruckerPragerCone extension(double cohesion, double frictionAngle, double dilationAngle)
	{
		return triaxial(cohesion, frictionAngle, dilationAngle, 1, &extension);
	}

private:
	static DruckerPragerCone triaxial(double cohesion, double frictionAngle, double dilationAngle, int sign, Match match)
	{
		const auto factor = [sign](double angle) { return 6 / (std::sqrt(3.) * (3 + sign * std::sin(angle))); };
		return { factor(frictionAngle) * std::sin(frictionAngle),
			 factor(dilationAngle) * std::sin(dilationAngle),
			 factor(frictionAngle) * std::cos(frictionAngle) * cohesion,
			 match,
			 cohesion,
			 frictionAngle,
			 dilationAngle };
	}
};

class DruckerPrager {
public:
	/// 0 <= dilation <= friction of the cone, strength >= 0, one of friction and strength not zero. The mean stress
	/// reaches no more than tensileStrength >= 0 [Pa], which is of use below the apex.
	DruckerPrager(double young, double poisson, const DruckerPragerCone& cone, double tensileStrength = std::numeric_limits<double>::infinity())
	        : elastic_(young, poisson), cone_(cone), tension_(tensileStrength)
	{
		const double apex = cone.frictionCoefficient > 0 ? cone.strength / cone.frictionCoefficient : std::numeric_limits<double>::infinity();
		mostMean_         = std::min(apex, tensileStrength);
		radius_           = tensileStrength < apex ? cone.strength - cone.frictionCoefficient * tensileStrength : 0;
		inverse_          = 1 / (elastic_.shear() + elastic_.bulk() * cone.frictionCoefficient * cone.dilation);
	}

	/// Parameters that may differ from point to point: Young's modulus, cohesion, frictionAngle, dilationAngle,
	/// tensileStrength.
	using Parameters = std::array<double, 5>;
	Parameters    parameters() const { return { elastic_.young(), cone_.cohesion, cone_.frictionAngle, cone_.dilationAngle, tension_ }; }
	DruckerPrager with(const Parameters& p) const { return { p[0], elastic_.poisson(), cone_.match(p[1], p[2], p[3]), p[4] }; }
	Parameters    weakened(const Weakening& w) const { return weakenedFriction(parameters(), w); }

	static constexpr std::array<InternalVariable, 1> variables { equivalentPlasticStrain };
	static constexpr bool                            mayFail = false, isShort = false, isElastic = false, isLinear = true, canBeWeakened = true;

	std::array<double, 1> initialInternals() const { return { 0 }; }

	bool isSymmetric() const { return cone_.dilation == cone_.frictionCoefficient; }

	double young(const std::array<double, 1>&) const { return elastic_.young(); }

	template <class T> ResponseWith<T, 1> respond(const PrincipalValues<T>& trialStrain, const std::array<T, 1>& internals) const
	{
		const T                  volumetric = trialStrain[0] + trialStrain[1] + trialStrain[2], third = T(1. / 3) * volumetric;
		const PrincipalValues<T> dev    = trialStrain - PrincipalValues<T>::Constant(third);
		const T                  length = sqrt(dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2]);
		const Return<T>          back   = returned<T>(T(elastic_.bulk()) * volumetric, T(std::sqrt(2.) * elastic_.shear()) * length);
		const T                  end    = T(1 / (3 * elastic_.bulk())) * back.mean;
		ResponseWith<T, 1>       r;
		for (int i = 0; i < 3; ++i)
			r.elasticStrain[i] = select(back.flows, back.theta * dev[i] + end, trialStrain[i]);
		r.take(elastic_.respond<T>(r.elasticStrain, {}));
		r.internals[0] = internals[0] + select(back.yields | back.isCut, T(std::sqrt(2. / 3)) * partTaken(back.theta) * length, T(0));

		const TangentForm<T>     form = tangentForm(back);
		const PrincipalValues<T> n    = dev * (T(1) / select(length > T(0), length, T(1)));
		const T                  bulk = form.bulk - T(2. / 3) * form.shear;
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j) {
				const T isotropic = i == j ? bulk + T(2) * form.shear : bulk;
				r.tangent(i, j)   = isotropic + form.radial * n[i] * n[j] + form.pressing * n[i] + form.dilating * n[j];
			}
		r.shear.fill(form.shear);
		return r;
	}
	ResponseWith<double, 1> respond(const Vec3& trialStrain, const std::array<double, 1>& internals) const
	{
		return respond<double>(trialStrain, internals);
	}

private:
	template <class T> using Mask = decltype(T() > T());

	/// The masks say which tangent belongs to the stress; they are chosen with a tolerance, but for `flows`, which
	/// is exact.
	template <class T> struct Return {
		T       mean, theta; ///< mean stress; what remains of the trial deviator
		Mask<T> flows, yields, isCut, isCorner;
	};
	/// Tangent = bulk 1 1^T + 2 shear (I - 1 1^T / 3) + radial n n^T + pressing n 1^T + dilating 1 n^T, n:
	/// direction of the deviator.
	template <class T> struct TangentForm {
		T bulk, shear, radial, pressing, dilating;
	};

	/// From the trial's mean stress and sqrt(J2). A return to the cone that ends above the cut, ends at it; where
	/// sqrt(J2) may then be larger than the trial's, only the mean stress changes. The apex is a cut that leaves
	/// nothing.
	template <class T> GIMPM_INLINE Return<T> returned(const T& mean, const T& root) const
	{
		const T    G(elastic_.shear()), most(mostMean_), radius(radius_);
		const T    over = root + T(cone_.frictionCoefficient) * mean - T(cone_.strength), multiplier = select(over > T(0), over * T(inverse_), T(0));
		const T    onCone = mean - T(elastic_.bulk() * cone_.dilation) * multiplier, some = select(root > T(0), root, T(1));
		const auto isAbove = onCone > most;
		const T    left    = select(isAbove, select(root > radius, radius, root), root - G * multiplier);
		Return<T>  r;
		r.mean            = select(isAbove, most, onCone);
		r.flows           = (over > T(0)) | isAbove;
		r.theta           = select(r.flows, select(root > T(0), left / some, T(0)), T(1));
		const T tolerance = T(sectorTolerance) * (root + abs(mean));
		r.yields          = over > tolerance;
		r.isCut           = onCone > most + tolerance;
		r.isCorner        = root > radius + tolerance;
		return r;
	}
	template <class T> GIMPM_INLINE TangentForm<T> tangentForm(const Return<T>& r) const
	{
		const double   G = elastic_.shear(), K = elastic_.bulk(), coupling = std::sqrt(2.) * G * K * inverse_;
		const T        zero(0), floor(tangentFloor);
		const auto     yields = select(r.isCut, zero, select(r.yields, T(1), zero)) > zero;
		const T        theta = select(r.yields | r.isCut, r.theta, T(1)), least = select(theta > floor, theta, floor);
		TangentForm<T> form;
		form.bulk  = select(r.isCut, floor * T(K), select(yields, T(K * (1 - K * cone_.frictionCoefficient * cone_.dilation * inverse_)), T(K)));
		form.shear = T(G) * least;
		form.radial
		        = select(r.isCut, select(r.isCorner, T(2 * G) * (floor - least), zero), select(yields, T(2 * G) * (T(1 - G * inverse_) - theta), zero));
		form.pressing = select(yields, T(-coupling * cone_.frictionCoefficient), zero);
		form.dilating = select(yields, T(-coupling * cone_.dilation), zero);
		return form;
	}

	Hencky            elastic_;
	DruckerPragerCone cone_;
	double            tension_;                     ///< tensile strength as given
	double            mostMean_, radius_, inverse_; ///< largest mean stress; sqrt(J2) of the cone there; 1 over G + K eta eta_g
};

} // namespace gimpm
