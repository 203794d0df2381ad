// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/bodies/body_pair.hpp"
#include "core/grid/surface.hpp"
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace gimpm {
namespace {

template <int Dim> Vec<Dim> normalOf(const PairPlaces<Dim>& x)
{
	if constexpr (Dim == 2) return pieceNormal(x[1], x[2]).normalized();
	else
		return pieceNormal(x[1], x[2], x[3]).normalized();
}

template <int Dim> double squaredDistance(const Vec<Dim>& x, const Vec<Dim>& a, const Vec<Dim>& b)
{
	const Vec<Dim> side = b - a;
	const double   s    = std::clamp(side.dot(x - a) / side.squaredNorm(), 0., 1.);
	return (x - a - s * side).squaredNorm();
}

Mat3 crossing(const Vec3& v) { return (Mat3() << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0).finished(); }

/// Derivatives of what Facing has by the places, side by side, in the order of these.
template <int Dim> struct FacingSlope {
	static constexpr int size = PairForce<Dim>::size;
	using Row                 = Eigen::Matrix<double, 1, size>;
	using Rows                = Eigen::Matrix<double, Dim, size>;

	Row                       gap;
	Rows                      normal = Rows::Zero();
	std::array<Row, Dim>      weight;
	std::array<Rows, Dim>     slope;
	std::array<Rows, Dim - 1> along;

	/// With n = normal, w = weight, b = slope: dn = -sum of b_j (n . dx_j), dg = n . (dx_0 - sum of w_j dx_j),
	/// dw_i = b_i . (dx_0 - sum of w_j dx_j - g dn), and as the b are dual to the sides of the piece, db_i = - sum
	/// of b_j (b_i . dx_j) - n (b_i . dn).
	FacingSlope(const Facing<Dim>& at, const PairPlaces<Dim>& x)
	{
		Rows foot = Rows::Zero(); // dx_0 - sum of w_j dx_j
		foot.template leftCols<Dim>().setIdentity();
		for (int j = 0; j < Dim; ++j) {
			foot.template middleCols<Dim>(Dim * (j + 1))   = -at.weight[j] * Mat<Dim>::Identity();
			normal.template middleCols<Dim>(Dim * (j + 1)) = -at.slope[j] * at.normal.transpose();
		}
		gap = at.normal.transpose() * foot;
		for (int i = 0; i < Dim; ++i) {
			weight[i] = at.slope[i].transpose() * (foot - at.gap * normal);
			slope[i]  = -at.normal * (at.slope[i].transpose() * normal);
			for (int j = 0; j < Dim; ++j)
				slope[i].template middleCols<Dim>(Dim * (j + 1)) -= at.slope[j] * at.slope[i].transpose();
		}
		const Mat<Dim> across = (Mat<Dim>::Identity() - at.along[0] * at.along[0].transpose()) / (x[2] - x[1]).norm();
		along[0].setZero();
		along[0].template middleCols<Dim>(Dim)     = -across;
		along[0].template middleCols<Dim>(2 * Dim) = across;
		if constexpr (Dim == 3) along[1] = crossing(at.normal) * along[0] - crossing(at.along[0]) * normal;
	}
};

/// Friction returned from a trial, and its derivative.
template <int Dim> struct Rubbing {
	Vec<Dim>                        shear = Vec<Dim>::Zero();
	bool                            slips = false;
	typename FacingSlope<Dim>::Rows slope = FacingSlope<Dim>::Rows::Zero();
};

/// Slip of the place along the matter of the piece, S = sum of (w_i - w_i at the start) x_i, and its derivative.
template <int Dim> struct Slip {
	Vec<Dim>                        value = Vec<Dim>::Zero();
	typename FacingSlope<Dim>::Rows slope = FacingSlope<Dim>::Rows::Zero();

	Slip(const Facing<Dim>& start, const Facing<Dim>& at, const PairPlaces<Dim>& x, const FacingSlope<Dim>* d)
	{
		for (int i = 0; i < Dim; ++i) {
			const double since = at.weight[i] - start.weight[i];
			value += since * (x[i + 1] - x[1]);
			if (!d) continue;
			slope += (x[i + 1] - x[1]) * d->weight[i];
			slope.template middleCols<Dim>(Dim * (i + 1)) += since * Mat<Dim>::Identity();
		}
	}
};

template <int Dim>
Rubbing<Dim> rub(
        const ContactLaw<Dim>& law, const Facing<Dim>& start, const Vec<Dim>& before, double normalForce, const Facing<Dim>& at, const Slip<Dim>& slip,
        const FacingSlope<Dim>* d, bool exactly)
{
	Rubbing<Dim> r;
	if (law.frictionCoefficient == 0 || law.cap == 0) return r;
	if (normalForce == 0) {
		if (d) r.slope = -law.tangentialStiffness * slip.slope;
		return r;
	}
	Vec<Dim> trial = -law.tangentialStiffness * slip.value;
	if (d) r.slope = -law.tangentialStiffness * slip.slope;
	for (int a = 0; a + 1 < Dim; ++a) {
		const double kept = start.along[a].dot(before);
		trial += kept * at.along[a];
		if (d) r.slope += kept * d->along[a];
	}
	const double limit = std::min(law.frictionCoefficient * normalForce, law.cap), size = trial.norm();
	r.slips = size > limit;
	r.shear = r.slips ? Vec<Dim>(limit / size * trial) : trial;
	if (!r.slips || !d) return r;
	const Vec<Dim> way = trial / size;
	r.slope            = (limit / size * (r.slope - way * (way.transpose() * r.slope))).eval();
	if (exactly && law.frictionCoefficient * normalForce < law.cap) r.slope -= law.frictionCoefficient * law.normalStiffness * way * d->gap;
	return r;
}

} // namespace

double squaredDistance(const PairPlaces<2>& x) { return squaredDistance<2>(x[0], x[1], x[2]); }
double squaredDistance(const PairPlaces<3>& x)
{
	const Facing<3> at(x);
	if (*std::min_element(at.weight.begin(), at.weight.end()) >= 0) return at.gap * at.gap;
	return std::min({ squaredDistance<3>(x[0], x[1], x[2]), squaredDistance<3>(x[0], x[2], x[3]), squaredDistance<3>(x[0], x[3], x[1]) });
}

template <int Dim> Facing<Dim>::Facing(const PairPlaces<Dim>& x) : normal(normalOf<Dim>(x))
{
	Mat<Dim> sides;
	for (int i = 1; i < Dim; ++i)
		sides.col(i - 1) = x[i + 1] - x[1];
	sides.col(Dim - 1)  = normal;
	const Mat<Dim> dual = sides.inverse();
	const Vec<Dim> from = x[0] - x[1];
	gap                 = normal.dot(from);
	weight[0]           = 1, slope[0].setZero();
	for (int i = 1; i < Dim; ++i) {
		slope[i]  = dual.row(i - 1).transpose();
		weight[i] = slope[i].dot(from);
		weight[0] -= weight[i];
		slope[0] -= slope[i];
	}
	along[0] = (x[2] - x[1]).normalized();
	if constexpr (Dim == 3) along[1] = normal.cross(along[0]);
}

/// The frictional force T enters the forces on the vertices with -w_i T + g (T . b_i) n: so it is conjugate to the
/// slip, and no moment g T is left.
template <int Dim>
std::optional<PairForce<Dim>> pairForce(
        const ContactLaw<Dim>& law, const PairPlaces<Dim>& start, const Vec<Dim>& before, const PairPlaces<Dim>& now, double closed, double tolerance,
        PairSlope asked)
{
	const Facing<Dim> at(now);
	if (!(at.gap - closed <= tolerance)) return std::nullopt;
	std::optional<FacingSlope<Dim>> d;
	if (asked != PairSlope::none) d.emplace(at, now);
	const Facing<Dim> first(start);
	const Slip<Dim>   slip(first, at, now, d ? &*d : nullptr);
	PairForce<Dim>    f;
	f.normalForce      = std::max(0., -law.normalStiffness * (at.gap - closed));
	const auto rubbing = rub<Dim>(law, first, before, f.normalForce, at, slip, d ? &*d : nullptr, asked == PairSlope::exact);
	f.tangentialForce = rubbing.shear, f.slips = rubbing.slips, f.slip = slip.value;
	const Vec<Dim> whole = f.normalForce * at.normal + f.tangentialForce;
	f.force[0]           = whole;
	for (int i = 0; i < Dim; ++i)
		f.force[i + 1] = -at.weight[i] * whole + at.gap * f.tangentialForce.dot(at.slope[i]) * at.normal;
	if (!d) return f;
	const typename FacingSlope<Dim>::Rows dWhole = -law.normalStiffness * at.normal * d->gap + f.normalForce * d->normal + rubbing.slope;
	f.slope.template topRows<Dim>()              = dWhole;
	for (int i = 0; i < Dim; ++i) {
		const double across                             = f.tangentialForce.dot(at.slope[i]);
		f.slope.template middleRows<Dim>(Dim * (i + 1)) = -at.weight[i] * dWhole - whole * d->weight[i]
		        + at.normal * (across * d->gap + at.gap * (at.slope[i].transpose() * rubbing.slope + f.tangentialForce.transpose() * d->slope[i]))
		        + at.gap * across * d->normal;
	}
	if (asked == PairSlope::symmetric) f.slope = ((f.slope + f.slope.transpose()) / 2).eval();
	return f;
}

template struct Facing<2>;
template struct Facing<3>;
template std::optional<PairForce<2>> pairForce(const ContactLaw<2>&, const PairPlaces<2>&, const Vec<2>&, const PairPlaces<2>&, double, double, PairSlope);
template std::optional<PairForce<3>> pairForce(const ContactLaw<3>&, const PairPlaces<3>&, const Vec<3>&, const PairPlaces<3>&, double, double, PairSlope);

} // namespace gimpm
