// SPDX-License-Identifier: GPL-2.0-or-later
// Hencky elasticity with Mohr-Coulomb's perfect plasticity: exact edges and apex, tension planes, flow with a dilation
// angle of its own.
//
// Yield function of principal Kirchhoff stresses t1 >= t2 >= t3 is k t1 - t3 - s, and the plastic potential m t1 -
// t3 (de Souza Neto, Peric and Owen 2008, Computational methods for plasticity, section 8.2), where k = (1 + sin phi) /
// (1 - sin phi), s = 2 c sqrt(k), and m is k of the dilation angle. Tension planes t1 - tensileStrength flow along
// their normals.
#pragma once
#include "core/materials/perfect_plasticity.hpp"
#include "core/materials/principal_order.hpp"

namespace gimpm {

class MohrCoulomb {
public:
	/// cohesion >= 0 [Pa] and 0 <= dilationAngle <= frictionAngle < pi/2; one of cohesion and friction is not zero.
	/// tensileStrength >= 0 [Pa] is of use below the stress of the apex.
	MohrCoulomb(double young, double poisson, double cohesion, double frictionAngle, double dilationAngle, double tensileStrength = infinite)
	        : elastic_(young, poisson)
	        , given_ { young, cohesion, frictionAngle, dilationAngle, tensileStrength }
	        , k_(ratioOf(frictionAngle))
	        , m_(ratioOf(dilationAngle))
	        , strength_(2 * cohesion * std::sqrt(k_))
	{
		apex_    = k_ > 1 ? strength_ / (k_ - 1) : infinite;
		isCut_   = tensileStrength < apex_;
		cut_     = isCut_ ? tensileStrength : 0;
		remote_  = k_ * cut_ - strength_;
		main_    = plane({ k_, 0, -1 }, { m_, 0, -1 });
		right_   = plane({ k_ / 2, k_ / 2, -1 }, { m_ / 2, m_ / 2, -1 });
		left_    = plane({ k_, -.5, -.5 }, { m_, -.5, -.5 });
		tension_ = plane({ 1, 0, 0 }, { 1, 0, 0 });
	}

	/// Without friction; the undrained strength [Pa] is half of the largest difference of principal stresses.
	static MohrCoulomb tresca(double young, double poisson, double undrainedStrength) { return { young, poisson, undrainedStrength, 0, 0 }; }

	/// Parameters that may differ from point to point: Young's modulus, cohesion, frictionAngle, dilationAngle,
	/// tensileStrength.
	using Parameters = std::array<double, 5>;
	Parameters  parameters() const { return given_; }
	MohrCoulomb with(const Parameters& p) const { return { p[0], elastic_.poisson(), p[1], p[2], p[3], p[4] }; }
	Parameters  weakened(const Weakening& w) const { return weakenedFriction(parameters(), w); }

	static constexpr std::array<InternalVariable, 1> variables { equivalentPlasticStrain };
	static constexpr bool                            mayFail = false, isShort = false, isElastic = false, isLinear = true, canBeWeakened = true;

	std::array<double, 1> initialInternals() const { return { 0 }; }

	bool isSymmetric() const { return m_ == k_; }

	double young(const std::array<double, 1>&) const { return elastic_.young(); }

	template <class T> ResponseWith<T, 1> respond(const PrincipalValues<T>& trialStrain, const std::array<T, 1>& internals) const
	{
		const PrincipalOrder<T>  order(trialStrain);
		const Return<T>          back   = returned<T>(order.sorted);
		const PrincipalValues<T> stress = order.restored(back.stress), elasticStrain = elastic_.strainOf<T>(stress);
		ResponseWith<T, 1>       r;
		r.stress = stress;
		for (int i = 0; i < 3; ++i)
			r.elasticStrain[i] = select(back.flows, elasticStrain[i], trialStrain[i]);
		r.internals[0] = internals[0] + select(back.yields | back.isCut, equivalentPlasticStrainOf<T>(trialStrain, r.elasticStrain), T(0));

		const TangentForm<T>     form = tangentForm(back);
		const PrincipalValues<T> flow = order.restored(form.flow), normal = order.restored(form.normal), axis = order.restored(form.axis);
		const T                  lambda = form.elastic * T(lame()), diagonal = lambda + form.elastic * T(2 * elastic_.shear());
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				r.tangent(i, j) = (i == j ? diagonal : lambda) - flow[i] * normal[j] + form.along * axis[i] * axis[j];
		// An axis' value is that of the pair of the others.
		const PrincipalValues<T> opposite = order.restored(secants(back));
		r.shear                           = { opposite[2], opposite[0], opposite[1] };
		return r;
	}
	ResponseWith<double, 1> respond(const Vec3& trialStrain, const std::array<double, 1>& internals) const
	{
		return respond<double>(trialStrain, internals);
	}

private:
	static constexpr double infinite = std::numeric_limits<double>::infinity();

	template <class T> using Mask = decltype(T() > T());

	/// A plane of the yield surface, or the mean of the two that meet in an edge: normal f, De g with the direction
	/// g of flow, De f / (f De g).
	template <class T> struct Plane {
		PrincipalValues<T> normal, flow, scaled;
		T                  inverse; ///< reciprocal of f De g
	};
	/// A return in the order of the principal values. The masks say which tangent belongs to the stress; they are
	/// chosen with the tolerance, but for `flows`, which is exact.
	template <class T> struct Return {
		PrincipalValues<T> strain, trial, stress;
		T                  tolerance; ///< [Pa]
		Mask<T>            flows;
		Mask<T>            yields, right, left, apex;        ///< at all; edge t1 = t2; edge t2 = t3
		Mask<T>            isCut, isCutTwice, slides, fixed; ///< t1 is cut; t2 too; t3 follows from yield; no stress is free
	};
	/// Tangent = elastic De - flow normal^T + along axis axis^T.
	template <class T> struct TangentForm {
		T                  elastic, along;
		PrincipalValues<T> flow, normal, axis;
	};

	static double ratioOf(double angle) { return (1 + std::sin(angle)) / (1 - std::sin(angle)); }
	double        lame() const { return elastic_.bulk() - 2. / 3 * elastic_.shear(); }

	Plane<double> plane(const Vec3& normal, const Vec3& direction) const
	{
		const auto   De   = [this](const Vec3& g) { return Vec3(2 * elastic_.shear() * g.array() + lame() * g.sum()); };
		const double size = normal.dot(De(direction));
		return { normal, De(direction), De(normal) / size, 1 / size };
	}
	/// The plane that a return ends on: the main one, or that of an edge.
	template <class T> GIMPM_INLINE Plane<T> pick(const Mask<T>& right, const Mask<T>& left) const
	{
		const auto of = [&](double r, double l, double m) GIMPM_INLINE_LAMBDA { return select(right, T(r), select(left, T(l), T(m))); };
		Plane<T>   p;
		for (int i = 0; i < 3; ++i) {
			p.normal[i] = of(right_.normal[i], left_.normal[i], main_.normal[i]);
			p.flow[i]   = of(right_.flow[i], left_.flow[i], main_.flow[i]);
			p.scaled[i] = of(right_.scaled[i], left_.scaled[i], main_.scaled[i]);
		}
		p.inverse = of(right_.inverse, left_.inverse, main_.inverse);
		return p;
	}

	template <class T> GIMPM_INLINE Return<T> returned(const PrincipalValues<T>& strain) const
	{
		Return<T> r;
		r.strain = strain;
		r.trial = r.stress = elastic_.respond<T>(strain, {}).stress;
		const T first = abs(r.trial[0]), last = abs(r.trial[2]);
		r.tolerance = T(sectorTolerance) * select(first > last, first, last);
		returnToPlanes(r);
		r.isCut = r.isCutTwice = r.slides = r.fixed = T(0) > T(0);
		if (isCut_) cutTension(r);
		return r;
	}
	/// To the main plane; where that would change the order of the principal stresses, to an edge, and where this
	/// leads beyond the apex, to the apex. The multiplier of an edge's second plane is positive where, and only
	/// where, the return to the main plane changes the order.
	template <class T> GIMPM_INLINE void returnToPlanes(Return<T>& r) const
	{
		const auto& t    = r.trial;
		const T     over = T(k_) * t[0] - t[2] - T(strength_), multiplier = select(over > T(0), over * T(main_.inverse), T(0));
		const T     beyondRight          = T(2 * elastic_.shear() * m_) * multiplier - (t[0] - t[1]),
		        beyondLeft               = T(2 * elastic_.shear()) * multiplier - (t[1] - t[2]);
		const auto               isRight = beyondRight > T(0), isLeft = beyondLeft > T(0);
		const auto               p    = pick<T>(isRight, isLeft);
		const T                  size = (p.normal[0] * t[0] + p.normal[1] * t[1] + p.normal[2] * t[2] - T(strength_)) * p.inverse;
		const PrincipalValues<T> end  = t - p.flow * size;
		const T                  high = T(0.5) * (end[0] + end[1]), low = T(0.5) * (end[1] + end[2]);
		const T                  largest = select(isRight, high, end[0]), beyondApex = T(k_ - 1) * largest - T(strength_);
		const PrincipalValues<T> onPlanes { largest, select(isRight, high, select(isLeft, low, end[1])), select(isLeft, low, end[2]) };

		r.flows = over > T(0);
		for (int i = 0; i < 3; ++i)
			r.stress[i] = select(r.flows, select(beyondApex > T(0), T(apex_), onPlanes[i]), t[i]);
		r.yields = over > T(k_ + 1) * r.tolerance;
		r.right  = beyondRight > r.tolerance;
		r.left   = beyondLeft > r.tolerance;
		r.apex   = beyondApex > T(k_ - 1) * r.tolerance;
	}
	/// Cuts what the other planes leave above the tensile strength: t1 is cut; t2 and t3 where they would still be
	/// above it; and where that would violate the yield function, t3 follows from it. A stress on none of these
	/// planes does without plastic strain along its axis, as in uniaxial stress.
	template <class T> GIMPM_INLINE void cutTension(Return<T>& r) const
	{
		const T    cut(cut_), remote(remote_), excess = (r.trial[0] - cut) * T(tension_.flow[1] * tension_.inverse);
		const T    second = r.trial[1] - excess, third = uniaxial(r.strain[2], cut_ + cut_), free = uniaxial(r.strain[1], cut_ + remote_);
		const auto isSecondCut = second > cut;
		const T    last        = select(isSecondCut, select(third > cut, cut, third), r.trial[2] - excess);
		const auto isSlid      = remote > last;
		const T    middle      = select(isSlid, select(free > cut, cut, select(remote > free, remote, free)), select(isSecondCut, cut, second));
		const auto isAbove     = r.stress[0] > cut;

		r.isCut      = r.stress[0] > cut + r.tolerance;
		r.isCutTwice = second > cut + r.tolerance;
		r.slides     = remote > last + r.tolerance;
		const T past = select(r.slides, outside(free, remote, cut), third - cut);
		r.fixed      = select(r.isCutTwice | r.slides, past, T(0)) > r.tolerance;
		r.flows      = r.flows | isAbove;
		r.stress     = { select(isAbove, cut, r.stress[0]), select(isAbove, middle, r.stress[1]),
			         select(isAbove, select(isSlid, remote, last), r.stress[2]) };
	}
	/// Stress along an axis without plastic strain where the sum of the two others is given.
	template <class T> GIMPM_INLINE T uniaxial(const T& strain, double others) const
	{
		const double poisson = elastic_.young() / (2 * elastic_.shear()) - 1;
		return T(elastic_.young()) * strain + T(poisson * others);
	}
	/// Distance of a number from an interval; negative inside.
	template <class T> GIMPM_INLINE static T outside(const T& x, const T& from, const T& to) { return select(x - to > from - x, x - to, from - x); }

	template <class T> GIMPM_INLINE TangentForm<T> tangentForm(const Return<T>& r) const
	{
		const T        zero(0), half(std::sqrt(0.5)), G(elastic_.shear());
		const auto     p      = pick<T>(r.right, r.left);
		const auto     onEdge = r.yields & (r.right | r.left), isAtApex = r.yields & r.apex;
		TangentForm<T> form;
		form.elastic = select(isAtApex, T(tangentFloor), select(onEdge, T(1 + tangentFloor), T(1)));
		form.along   = select(isAtApex, zero, select(onEdge, T(-2) * G, zero));
		form.axis    = { select(r.right, half, zero), select(r.right, -half, half), select(r.right, zero, -half) };
		for (int i = 0; i < 3; ++i) {
			form.flow[i]   = select(isAtApex, zero, select(r.yields, p.flow[i], zero));
			form.normal[i] = p.scaled[i];
		}
		return isCut_ ? cutForm(r, form) : form;
	}
	/// Tangent of points that the tension planes cut; that of the others stays.
	template <class T> GIMPM_INLINE TangentForm<T> cutForm(const Return<T>& r, TangentForm<T> form) const
	{
		const T    zero(0), one(1);
		const auto isOneLeft = r.isCutTwice | r.slides;
		form.elastic         = select(r.isCut, select(isOneLeft, T(tangentFloor), one), form.elastic);
		form.along           = select(r.isCut, select(r.fixed, zero, select(isOneLeft, T(elastic_.young()), zero)), form.along);
		for (int i = 0; i < 3; ++i) {
			form.flow[i]   = select(r.isCut, select(isOneLeft, zero, T(tension_.flow[i])), form.flow[i]);
			form.normal[i] = select(r.isCut, T(tension_.scaled[i]), form.normal[i]);
			form.axis[i]   = select(r.isCut, select(r.slides, T(i == 1), T(i == 2)), form.axis[i]);
		}
		return form;
	}
	/// Secant shear moduli, by the axis that a pair leaves out. Equal stresses that were not equal have none; t2
	/// and t3 keep theirs where t1 is cut alone.
	template <class T> GIMPM_INLINE PrincipalValues<T> secants(const Return<T>& r) const
	{
		const T    zero(0), one(1), G(elastic_.shear());
		const auto of = [&](int i, int j) GIMPM_INLINE_LAMBDA {
			const T    before = r.trial[i] - r.trial[j], after = r.stress[i] - r.stress[j];
			const auto some  = before > zero;
			const T    ratio = select(some, after, zero) / select(some, before, one);
			return select(ratio > one, one, select(ratio > T(tangentFloor), ratio, T(tangentFloor)));
		};
		const auto flows       = r.yields | r.isCut,
		           flowsBehind = select(r.isCut, select(r.isCutTwice | r.slides, one, zero), select(r.yields, one, zero)) > zero;
		return { G * select(flowsBehind, of(1, 2), one), G * select(flows, of(0, 2), one), G * select(flows, of(0, 1), one) };
	}

	Hencky        elastic_;
	Parameters    given_;
	double        k_, m_, strength_, apex_, cut_, remote_; ///< remote_: t3 that yields with t1 = cut_
	bool          isCut_;
	Plane<double> main_, right_, left_, tension_;
};

} // namespace gimpm
