// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/bodies/body_pair.hpp"
#include "core/grid/surface.hpp"
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace gimpm {
namespace {

template <int Dim> Vec<Dim> normalOf(const PairPositions<Dim>& x)
{
	if constexpr (Dim == 2) return pieceNormal(x[1], x[2]).normalized();
	else
		return pieceNormal(x[1], x[2], x[3]).normalized();
}

/// Part of the side from a to b at which it is closest to x.
template <int Dim> double closestPart(const Vec<Dim>& x, const Vec<Dim>& a, const Vec<Dim>& b)
{
	return std::clamp((b - a).dot(x - a) / (b - a).squaredNorm(), 0., 1.);
}

template <int Dim> double squaredDistance(const Vec<Dim>& x, const Vec<Dim>& a, const Vec<Dim>& b)
{
	return (x - a - closestPart<Dim>(x, a, b) * (b - a)).squaredNorm();
}

Mat3 crossing(const Vec3& v) { return (Mat3() << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0).finished(); }

/// Derivatives of what Facing has by the contact points, side by side, in the order of these.
template <int Dim> struct FacingDerivative {
	static constexpr int size = PairForce<Dim>::size;
	using Row                 = Eigen::Matrix<double, 1, size>;
	using Rows                = Eigen::Matrix<double, Dim, size>;

	Row                       gap;
	Rows                      normal = Rows::Zero();
	std::array<Row, Dim>      weight;
	std::array<Rows, Dim>     weightGradient;
	std::array<Rows, Dim - 1> along;

	/// Derivatives with n = normal, w = weight, b = weightGradient: dn = -sum of b_j (n . dx_j), dg = n . (dx_0 -
	/// sum of w_j dx_j), dw_i = b_i . (dx_0 - sum of w_j dx_j - g dn), and as the b are dual to the sides of the
	/// piece, db_i =
	/// - sum of b_j (b_i . dx_j) - n (b_i . dn).
	FacingDerivative(const Facing<Dim>& at, const PairPositions<Dim>& x)
	{
		Rows foot = Rows::Zero(); // dx_0 - sum of w_j dx_j
		foot.template leftCols<Dim>().setIdentity();
		for (int j = 0; j < Dim; ++j) {
			foot.template middleCols<Dim>(Dim * (j + 1))   = -at.weight[j] * Mat<Dim>::Identity();
			normal.template middleCols<Dim>(Dim * (j + 1)) = -at.weightGradient[j] * at.normal.transpose();
		}
		gap = at.normal.transpose() * foot;
		for (int i = 0; i < Dim; ++i) {
			weight[i]         = at.weightGradient[i].transpose() * (foot - at.gap * normal);
			weightGradient[i] = -at.normal * (at.weightGradient[i].transpose() * normal);
			for (int j = 0; j < Dim; ++j)
				weightGradient[i].template middleCols<Dim>(Dim * (j + 1)) -= at.weightGradient[j] * at.weightGradient[i].transpose();
		}
		const Mat<Dim> across = (Mat<Dim>::Identity() - at.along[0] * at.along[0].transpose()) / (x[2] - x[1]).norm();
		along[0].setZero();
		along[0].template middleCols<Dim>(Dim)     = -across;
		along[0].template middleCols<Dim>(2 * Dim) = across;
		if constexpr (Dim == 3) along[1] = crossing(at.normal) * along[0] - crossing(at.along[0]) * normal;
	}
};

/// Slip of the contact point along the matter of the piece, S = sum of (w_i - w_i at the start) x_i, and its
/// derivative.
template <int Dim> struct Slip {
	Vec<Dim>                             value      = Vec<Dim>::Zero();
	typename FacingDerivative<Dim>::Rows derivative = FacingDerivative<Dim>::Rows::Zero();

	Slip(const Facing<Dim>& start, const Facing<Dim>& at, const PairPositions<Dim>& x, const FacingDerivative<Dim>* d)
	{
		for (int i = 0; i < Dim; ++i) {
			const double since = at.weight[i] - start.weight[i];
			value += since * (x[i + 1] - x[1]);
			if (!d) continue;
			derivative += (x[i + 1] - x[1]) * d->weight[i];
			derivative.template middleCols<Dim>(Dim * (i + 1)) += since * Mat<Dim>::Identity();
		}
	}
};

/// Adds the derivative to the tangent, if there is one; without dGap that by the pressure is left out.
template <int Dim>
Friction<Dim> frictionOf(
        const ContactLaw<Dim>& law, const Facing<Dim>& start, const Vec<Dim>& before, double normalForce, const Facing<Dim>& at, const Slip<Dim>& slip,
        const FacingDerivative<Dim>* d, const typename FacingDerivative<Dim>::Row* dGap, typename FacingDerivative<Dim>::Rows* tangent)
{
	if (law.isSmooth()) return {};
	Vec<Dim>                             trial  = -law.tangentialStiffness * slip.value;
	typename FacingDerivative<Dim>::Rows dTrial = -law.tangentialStiffness * slip.derivative;
	if (normalForce == 0) {
		if (tangent) *tangent = dTrial;
		return {};
	}
	for (int a = 0; a + 1 < Dim; ++a) {
		const double kept = start.along[a].dot(before);
		trial += kept * at.along[a];
		if (d) dTrial += kept * d->along[a];
	}
	return returnMapping<Dim, PairForce<Dim>::size>(law, normalForce, trial, &dTrial, dGap, tangent);
}

} // namespace

double squaredDistance(const PairPositions<2>& x) { return squaredDistance<2>(x[0], x[1], x[2]); }
double squaredDistance(const PairPositions<3>& x)
{
	const Facing<3> at(x);
	if (*std::min_element(at.weight.begin(), at.weight.end()) >= 0) return at.gap * at.gap;
	return std::min({ squaredDistance<3>(x[0], x[1], x[2]), squaredDistance<3>(x[0], x[2], x[3]), squaredDistance<3>(x[0], x[3], x[1]) });
}

std::array<double, 2> closestWeights(const PairPositions<2>& x)
{
	const double part = closestPart<2>(x[0], x[1], x[2]);
	return { 1 - part, part };
}

std::array<double, 3> closestWeights(const PairPositions<3>& x)
{
	std::array<double, 3> weight = Facing<3>(x).weight;
	if (*std::min_element(weight.begin(), weight.end()) >= 0) return weight;
	double least = std::numeric_limits<double>::infinity();
	for (int i = 0; i < 3; ++i) {
		const int    next = (i + 1) % 3;
		const double away = squaredDistance<3>(x[0], x[i + 1], x[next + 1]);
		if (away >= least) continue;
		least             = away;
		const double part = closestPart<3>(x[0], x[i + 1], x[next + 1]);
		weight.fill(0), weight[i] = 1 - part, weight[next] = part;
	}
	return weight;
}

template <int Dim> Facing<Dim>::Facing(const PairPositions<Dim>& x) : normal(normalOf<Dim>(x))
{
	Mat<Dim> sides;
	for (int i = 1; i < Dim; ++i)
		sides.col(i - 1) = x[i + 1] - x[1];
	sides.col(Dim - 1)  = normal;
	const Mat<Dim> dual = sides.inverse();
	const Vec<Dim> from = x[0] - x[1];
	gap                 = normal.dot(from);
	weight[0]           = 1, weightGradient[0].setZero();
	for (int i = 1; i < Dim; ++i) {
		weightGradient[i] = dual.row(i - 1).transpose();
		weight[i]         = weightGradient[i].dot(from);
		weight[0] -= weight[i];
		weightGradient[0] -= weightGradient[i];
	}
	along[0] = (x[2] - x[1]).normalized();
	if constexpr (Dim == 3) along[1] = normal.cross(along[0]);
}

/// The frictional force T enters the forces on the vertices with -w_i T + g (T . b_i) n: so it is conjugate to the
/// slip, and no moment g T is left.
template <int Dim>
std::optional<PairForce<Dim>> pairForce(
        const ContactLaw<Dim>& law, const PairPositions<Dim>& start, const Vec<Dim>& before, const PairPositions<Dim>& now, double closed, double tolerance,
        PairJacobian asked)
{
	const Facing<Dim> at(now);
	if (!(at.gap - closed <= tolerance)) return std::nullopt;
	std::optional<FacingDerivative<Dim>> d;
	if (asked != PairJacobian::none) d.emplace(at, now);
	const Facing<Dim> first(start);
	const Slip<Dim>   slip(first, at, now, d ? &*d : nullptr);
	PairForce<Dim>    f;
	f.normalForce                                  = law.normalForce(at.gap - closed);
	typename FacingDerivative<Dim>::Rows dFriction = FacingDerivative<Dim>::Rows::Zero();
	const auto                           friction  = frictionOf<Dim>(
                law, first, before, f.normalForce, at, slip, d ? &*d : nullptr, asked == PairJacobian::exact ? &d->gap : nullptr, d ? &dFriction : nullptr);
	f.tangentialForce = friction.force, f.slips = friction.slips, f.slip = slip.value;
	const Vec<Dim> whole = f.normalForce * at.normal + f.tangentialForce;
	f.force[0]           = whole;
	for (int i = 0; i < Dim; ++i)
		f.force[i + 1] = -at.weight[i] * whole + at.gap * f.tangentialForce.dot(at.weightGradient[i]) * at.normal;
	if (!d) return f;
	const typename FacingDerivative<Dim>::Rows dWhole = -law.normalStiffness * at.normal * d->gap + f.normalForce * d->normal + dFriction;
	f.tangent.template topRows<Dim>()                 = dWhole;
	for (int i = 0; i < Dim; ++i) {
		const double across                               = f.tangentialForce.dot(at.weightGradient[i]);
		f.tangent.template middleRows<Dim>(Dim * (i + 1)) = -at.weight[i] * dWhole - whole * d->weight[i]
		        + at.normal
		                * (across * d->gap
		                   + at.gap * (at.weightGradient[i].transpose() * dFriction + f.tangentialForce.transpose() * d->weightGradient[i]))
		        + at.gap * across * d->normal;
	}
	if (asked == PairJacobian::symmetric) f.tangent = ((f.tangent + f.tangent.transpose()) / 2).eval();
	return f;
}

template struct Facing<2>;
template struct Facing<3>;
template std::optional<PairForce<2>> pairForce(
        const ContactLaw<2>&, const PairPositions<2>&, const Vec<2>&, const PairPositions<2>&, double, double, PairJacobian);
template std::optional<PairForce<3>> pairForce(
        const ContactLaw<3>&, const PairPositions<3>&, const Vec<3>&, const PairPositions<3>&, double, double, PairJacobian);

} // namespace gimpm
