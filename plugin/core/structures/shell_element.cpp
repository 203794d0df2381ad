// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/shell_element.hpp"

namespace gimpm {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Function of the six coordinates, with its derivatives.
using Quantity = Energy<6>;

Quantity operator+(Quantity a, const Quantity& b)
{
	a.value += b.value, a.gradient += b.gradient, a.hessian += b.hessian;
	return a;
}
Quantity operator*(double factor, Quantity a)
{
	a.value *= factor, a.gradient *= factor, a.hessian *= factor;
	return a;
}
Quantity operator*(const Quantity& a, const Quantity& b)
{
	Quantity product;
	product.value    = a.value * b.value;
	product.gradient = a.value * b.gradient + b.value * a.gradient;
	product.hessian  = a.value * b.hessian + b.value * a.hessian + a.gradient * b.gradient.transpose() + b.gradient * a.gradient.transpose();
	return product;
}
Quantity sineOf(const Quantity& a)
{
	const double s = std::sin(a.value), c = std::cos(a.value);
	return { s, c * a.gradient, c * a.hessian - s * a.gradient * a.gradient.transpose() };
}
Quantity coordinate(int index, double value) { return { value, Vec6::Unit(index), Mat6::Zero() }; }

/// At a position of a piece, from 0 to 1: derivatives of Hermite's functions of the turns of its ends.
struct Hermite {
	Vec<2> first, curvature;

	explicit Hermite(double x) : first((1 - x) * (1 - 3 * x), -x * (2 - 3 * x)), curvature(-4 + 6 * x, -2 + 6 * x) { }
};

/// Strains and curvatures at a position.
struct Strains {
	Quantity along, hoop, bend, hoopBend;
};

class Shape {
public:
	Shape(const ShellPiece& piece, const Vec6& u) : piece_(piece)
	{
		const BeamShape shape(piece.meridian, u);
		const double    l = shape.length, c = shape.direction[0], s = shape.direction[1];
		Vec6            r, z;
		r << -c, -s, 0, c, s, 0;
		z << s, -c, 0, -s, c, 0;
		const Mat6 both = r * z.transpose() + z * r.transpose();
		elongation_     = { shape.elongation, r, z * z.transpose() / l };
		angle_          = { std::atan2(s, c), z / l, -both / (l * l) };
		for (int end = 0; end < 2; ++end) {
			turns_[end]    = { shape.turns[end], Vec6::Unit(3 * end + 2) - z / l, both / (l * l) };
			outwards_[end] = coordinate(3 * end, piece.outwards[end] + u[3 * end]);
		}
	}
	Strains at(double x) const
	{
		const Hermite  hermite(x);
		const double   l0 = piece_.meridian.length0, R = radius0(x);
		const auto     ofTurns  = [&](const Vec<2>& of) { return of[0] * turns_[0] + of[1] * turns_[1]; };
		const Quantity outwards = (1 - x) * outwards_[0] + x * outwards_[1];
		const Quantity sine     = sineOf(angle_ + ofTurns(hermite.first)) + Quantity { -piece_.slope0 };
		// On the axis a parallel has the curvature of the meridian.
		const Quantity bend = (1 / l0) * ofTurns(hermite.curvature);
		return { (1 / l0) * elongation_, (1 / R) * outwards, bend, R > 0 ? (1 / R) * sine : bend };
	}
	double radius0(double x) const { return (1 - x) * piece_.radius0[0] + x * piece_.radius0[1]; }
	Vec<2> direction() const { return { std::cos(angle_.value), std::sin(angle_.value) }; }

private:
	const ShellPiece& piece_;
	Quantity          elongation_, angle_;
	Quantity          turns_[2], outwards_[2];
};

/// Half of the product of two strains with their forces.
Quantity halfEnergy(const Quantity& a, const Quantity& b, double poisson) { return 0.5 * (a * a) + 0.5 * (b * b) + poisson * (a * b); }

} // namespace

Energy<6> energyOf(const ShellPiece& piece, const BeamSection& section, const Vec6& u)
{
	constexpr double positions[] { 0.1127016653792583, 0.5, 0.8872983346207417 }, weights[] { 5. / 18, 8. / 18, 5. / 18 };
	const Shape      shape(piece, u);
	Energy<6>        sum;
	for (int g = 0; g < 3; ++g) {
		const Strains at   = shape.at(positions[g]);
		const double  area = weights[g] * 2 * M_PI * shape.radius0(positions[g]) * piece.meridian.length0;
		sum                = sum + (area * section.axialStiffness) * halfEnergy(at.along, at.hoop, section.poisson)
		        + (area * section.bendingStiffness) * halfEnergy(at.bend, at.hoopBend, section.poisson);
	}
	return sum;
}

/// Forces of the meridian by the forces on the ends, which are in equilibrium; on the axis, where these are none, by
/// the curvatures.
ShellForces forcesIn(const ShellPiece& piece, const BeamSection& section, const Vec6& u)
{
	const Shape  shape(piece, u);
	const Vec6   force = energyOf(piece, section, u).gradient;
	const Vec<2> along = shape.direction(), across(-along[1], along[0]), apart = (force.segment<2>(3) - force.head<2>()) / 2;
	const double middle = 2 * M_PI * shape.radius0(0.5), nu = section.poisson;
	const auto   inMiddle = shape.at(0.5);
	ShellForces  of { apart.dot(along) / middle, -apart.dot(across) / middle, 0, {}, {} };
	of.hoop = section.axialStiffness * (inMiddle.hoop.value + nu * inMiddle.along.value);
	for (int end = 0; end < 2; ++end) {
		const Strains at = shape.at(end);
		const double  D = section.bendingStiffness, R = piece.radius0[end];
		const double  bent = D * (at.bend.value + nu * at.hoopBend.value), turned = force[3 * end + 2] / (2 * M_PI * R);
		of.moments[end]     = R > 0 ? turned : end == 0 ? -bent : bent;
		const double moment = end == 0 ? -of.moments[end] : of.moments[end];
		of.hoopMoments[end] = nu * moment + D * (1 - nu * nu) * at.hoopBend.value;
	}
	return of;
}

} // namespace gimpm
