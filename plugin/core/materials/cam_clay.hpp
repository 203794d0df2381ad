// SPDX-License-Identifier: GPL-2.0-or-later
// Modified Cam clay (Roscoe and Burland 1968) for finite strain: elastic energy whose pressure is an exponential of the
// volumetric strain, with constant shear modulus, and compression along straight lines of ln v over ln p (Borja and
// Tamagnini 1998).
#pragma once
#include "core/materials/perfect_plasticity.hpp"
#include <optional>

namespace gimpm {

/// Yield function Q^2 / M^2 + P (P - pc), associated flow; P and Q of the Kirchhoff stress, P positive in compression.
class CamClay {
public:
	/// All > 0 and swellingIndex < compressionIndex. Indices: slopes of ln v over ln p. preconsolidation: pc at
	/// first [Pa]; referencePressure: P without elastic strain [Pa].
	CamClay(double shearModulus, double criticalStateRatio, double compressionIndex, double swellingIndex, double preconsolidation,
	        double referencePressure)
	        : shear_(shearModulus)
	        , ratio_(criticalStateRatio)
	        , compression_(compressionIndex)
	        , swelling_(swellingIndex)
	        , preconsolidation_(preconsolidation)
	        , reference_(referencePressure)
	        , plasticShare_(1 - swellingIndex / compressionIndex)
	{
	}

	/// Parameters that may differ from point to point: shearModulus, criticalStateRatio.
	using Parameters = std::array<double, 2>;
	Parameters parameters() const { return { shear_, ratio_ }; }
	CamClay    with(const Parameters& p) const { return { p[0], p[1], compression_, swelling_, preconsolidation_, reference_ }; }
	// Strength grows from preconsolidation: there is no single one to be divided.
	Parameters weakened(const Weakening&) const { return parameters(); }

	static constexpr InternalVariable                preconsolidation { "preconsolidation", "Pa", "preconsolidation pressure", positive, anyNumber };
	static constexpr std::array<InternalVariable, 2> variables { equivalentPlasticStrain, preconsolidation };
	static constexpr bool                            mayFail = true, isShort = false, isElastic = false, isLinear = false, canBeWeakened = false;

	/// Pressures from e^-100 to e^100 times the reference; what is beyond has no answer.
	static constexpr double mostExponent = 100;

	std::array<double, 2> initialInternals() const { return { 0, preconsolidation_ }; }

	bool isSymmetric() const { return false; }

	/// At an elastic volumetric strain. It is no less than at a thousandth of the preconsolidation pressure: a
	/// point that lost its pressure would leave nothing to compare forces with.
	double young(const std::array<double, 2>& internals, double volumetricStrain) const
	{
		const double bulk = std::max(reference_ * std::exp(-volumetricStrain / swelling_), 1e-3 * internals[1]) / swelling_;
		return 9 * bulk * shear_ / (3 * bulk + shear_);
	}

	/// Principal elastic strains of principal stresses whose mean is a pressure.
	Vec3 strainOf(const Vec3& stress) const
	{
		const double mean = stress.mean();
		return (stress.array() - mean) / (2 * shear_) - swelling_ / 3 * std::log(-mean / reference_);
	}

	/// There are no stresses whose mean is no pressure.
	std::optional<Vec3> strainNear(const Vec3& stress) const { return stress.sum() < 0 ? std::optional<Vec3>(strainOf(stress)) : std::nullopt; }

	template <class T> ResponseWith<T, 2> respond(const PrincipalValues<T>& trialStrain, const std::array<T, 2>& internals) const
	{
		const T                  volumetric = trialStrain[0] + trialStrain[1] + trialStrain[2], third = T(1. / 3) * volumetric;
		const PrincipalValues<T> dev    = trialStrain - PrincipalValues<T>::Constant(third);
		const T                  length = sqrt(dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2]);
		const Trial<T>           trial(*this, volumetric, T(std::sqrt(2. / 3)) * length, internals[1]);
		const Flow<T>            flow   = returned(trial);
		const T                  mean   = T(1. / 3) * (volumetric + select(trial.flows, flow.volumetric, T(0)));
		const T                  secant = select(trial.flows, flow.secant, T(shear_)), theta = secant * T(1 / shear_);
		const T                  pressure = select(trial.flows, flow.pressure, trial.pressure);
		ResponseWith<T, 2>       r;
		for (int i = 0; i < 3; ++i) {
			r.elasticStrain[i] = select(trial.flows, theta * dev[i] + mean, trialStrain[i]);
			r.stress[i]        = T(2) * secant * dev[i] - pressure;
		}
		r.internals[0] = internals[0] + select(trial.flows, partTaken(theta) * trial.shear, T(0));
		r.internals[1] = select(trial.flows, pressure * (T(1) + flow.root * flow.root), internals[1]);
		r.shear.fill(secant);
		r.failed = select(trial.isAdmitted, select(trial.flows, flow.failed, T(0)), T(1));
		setTangent(derivatives(trial, flow), PrincipalValues<T>(dev * (T(1) / select(length > T(0), length, T(1)))), secant, r);
		return r;
	}
	ResponseWith<double, 2> respond(const Vec3& trialStrain, const std::array<double, 2>& internals) const
	{
		return respond<double>(trialStrain, internals);
	}

private:
	template <class T> using Mask = decltype(T() > T());

	template <class T> GIMPM_INLINE static T exponential(const T& x)
	{
		return each(x, [](double y) { return std::exp(y); });
	}
	template <class T> GIMPM_INLINE static T logarithm(const T& x)
	{
		return each(x, [](double y) { return std::log(y); });
	}

	template <class T> struct Trial {
		T       shear, pressure, excess, preconsolidation; ///< es = sqrt(2/3) |dev e|; P; ln(P / pc)
		T       ratio;                                     ///< Q / (M P)
		Mask<T> isAdmitted, flows, yields;                 ///< outside of the yield surface, and by more than the tolerance

		GIMPM_INLINE Trial(const CamClay& law, const T& volumetric, const T& shearStrain, const T& pc) : shear(shearStrain)
		{
			const T    exponent = volumetric * T(-1 / law.swelling_), most(mostExponent);
			const auto isSmall  = abs(exponent) <= most;
			isAdmitted          = select(isSmall, pc, T(0)) > T(0);
			const T power       = select(isAdmitted, exponent, T(0));
			preconsolidation    = select(isAdmitted, pc, T(law.reference_));
			pressure            = T(law.reference_) * exponential(power);
			excess              = power - logarithm(T(preconsolidation * T(1 / law.reference_)));
			ratio               = T(3 * law.shear_ / law.ratio_) * shear / pressure;
			// Its ellipse's pc.
			const T passing = select(isAdmitted, pressure * (T(1) + ratio * ratio), T(0));
			flows           = passing > preconsolidation;
			yields          = passing > preconsolidation * T(1 + sectorTolerance);
		}
	};

	/// The end of a return, by the one unknown u = Q / (M P). On the yield surface P = pc / (1 + u^2); with the
	/// volumetric plastic strain v
	///   P = P_tr exp(-v / kappa), pc = pc_n exp(v / (lambda - kappa)), so that v = kappa (1 - kappa / lambda) (ln(P_tr / pc_n) + ln(1 + u^2));
	/// and flow is normal to the surface where
	///   S(u) = (es_tr - M P u / 3G) (1 - u^2) - 2 u v / M = 0.
	template <class T> struct Flow {
		T root, residual, derivative;           ///< u, S, dS/du
		T volumetric, pressure, growth, secant; ///< v; P; d ln(1 + u^2) / du; secant shear modulus
		T failed;
	};
	template <class T> GIMPM_INLINE Flow<T> at(const Trial<T>& trial, const T& u) const
	{
		const T one(1), square = u * u, left = one - square, perRatio(2 / ratio_);
		const T log = each(square, [](double x) { return std::log1p(x); }), plastic = T(plasticShare_) * (trial.excess + log);
		Flow<T> f;
		f.root           = u;
		f.growth         = T(2) * u / (one + square);
		f.volumetric     = T(swelling_) * plastic;
		f.pressure       = trial.pressure * exponential(T(-plastic));
		const T perShear = f.pressure * T(ratio_ / (3 * shear_)), elastic = perShear * u;
		f.residual   = (trial.shear - elastic) * left - perRatio * u * f.volumetric;
		f.derivative = perShear * (u * T(plasticShare_) * f.growth - one) * left - T(2) * u * (trial.shear - elastic)
		        - perRatio * (f.volumetric + u * T(swelling_ * plasticShare_) * f.growth);
		return f;
	}
	/// S changes its sign once, from plus to minus, between the ratio at which the volume would stay and 1, that of
	/// the critical state: flow leads towards the critical state. Newton's method is kept in this interval, which
	/// halves where it would leave it.
	template <class T> GIMPM_INLINE Flow<T> returned(const Trial<T>& trial) const
	{
		const T zero(0), one(1), squared = trial.preconsolidation / trial.pressure - one, still = sqrt(select(squared > zero, squared, zero));
		T       low = select(still > one, one, still), high = select(still > one, still, one);
		T       u    = select(trial.ratio > high, high, select(low > trial.ratio, low, trial.ratio));
		T       open = select(trial.flows, one, zero); // 1 where u is not found yet
		Flow<T> f {};
		for (int iteration = 0; iteration < 60 && !everywhere(open <= zero); ++iteration) {
			f                  = at(trial, u);
			low                = select(f.residual > zero, u, low);
			high               = select(f.residual > zero, high, u);
			const auto isSteep = zero > f.derivative;
			const T    newton  = u - f.residual / select(isSteep, f.derivative, T(-1)),
			        within     = select(newton > high, zero, select(low > newton, zero, one));
			const T middle     = select(low >= one, sqrt(low * high), T(0.5) * (low + high));
			const T next       = select(select(isSteep, within, zero) > zero, newton, middle);
			open               = select(abs(next - u) <= T(1e-9) * next, zero, open);
			u                  = next;
		}
		f        = at(trial, u);
		f.failed = open;
		// es = M P u / 3G of es_tr; in isotropic compression, where both are zero, the limit of S(u) = 0
		const T perRatio = T(ratio_ / 3) * f.pressure;
		const T limit    = perRatio / (perRatio * T(1 / shear_) + T(2 / ratio_) * f.volumetric);
		f.secant         = select(trial.shear > T(1e-100), perRatio * u / select(trial.shear > T(1e-100), trial.shear, one), limit);
		return f;
	}

	/// Derivatives of P and Q by volumetric strain and es of the trial.
	template <class T> struct Derivatives {
		T pressureByVolume, pressureByShear, stressByVolume, stressByShear;
	};
	/// Tangent from the derivatives of S(u; strains) = 0.
	template <class T> GIMPM_INLINE Derivatives<T> derivatives(const Trial<T>& trial, const Flow<T>& f) const
	{
		const T P = f.pressure, u = f.root, left = T(1) - u * u, Q = T(ratio_) * P * u, perLength(1 / compression_);
		const T byVolume = left * Q * T(1 / (3 * shear_)) * perLength + T(2 * plasticShare_ / ratio_) * u;
		const T inverse = T(-1) / select(trial.yields, f.derivative, T(-1)), uByShear = left * inverse, uByVolume = byVolume * inverse;
		// Derivatives of ln P.
		const T    share = T(plasticShare_) * f.growth, logByVolume = -perLength - share * uByVolume, logByShear = -share * uByShear;
		const auto of = [&](const T& plastic, const T& elastic) GIMPM_INLINE_LAMBDA { return select(trial.yields, plastic, elastic); };
		return { of(P * logByVolume, trial.pressure * T(-1 / swelling_)), of(P * logByShear, T(0)),
			 of(T(ratio_) * P * uByVolume + Q * logByVolume, T(0)), of(T(ratio_) * P * uByShear + Q * logByShear, T(3 * shear_)) };
	}
	/// Tangent of stress = -P 1 + sqrt(2/3) Q n with the direction n of the deviator.
	template <class T> GIMPM_INLINE static void setTangent(const Derivatives<T>& d, const PrincipalValues<T>& n, const T& secant, ResponseOf<T>& r)
	{
		const T root(std::sqrt(2. / 3)), twice = T(2) * secant, linear = -d.pressureByVolume - T(1. / 3) * twice;
		const T radial = T(2. / 3) * d.stressByShear - twice, right = root * d.pressureByShear, left = root * d.stressByVolume;
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				r.tangent(i, j) = (i == j ? linear + twice : linear) + radial * n[i] * n[j] + left * n[i] - right * n[j];
	}

	double shear_, ratio_, compression_, swelling_, preconsolidation_, reference_,
	        plasticShare_; ///< plasticShare_: of a change of volume along compression
};

} // namespace gimpm
