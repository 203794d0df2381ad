// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/hardening_soil_small.hpp"

namespace gimpm {
namespace {

Mat3 deviatorOf(const Mat3& tensor) { return tensor - tensor.trace() / 3 * Mat3::Identity(); }

Mat3 logarithm(const Mat3& stretch)
{
	const auto p = principal(SymTensor<3>::from(Mat3(stretch - Mat3::Identity())));
	return p.axes * Vec3(p.value.unaryExpr([](double x) { return std::log1p(x); })).asDiagonal() * p.axes.transpose();
}

/// Deviatoric measure that is the shear strain of triaxial compression.
double shearOf(const Mat3& deviator) { return std::sqrt(1.5) * deviator.norm(); }

} // namespace

HardeningSoilSmall::HardeningSoilSmall(const Given& given, double smallest, double strain) : HardeningSoil(given), first_(smallest), strain_(strain)
{
	most_ = strain / decay * (std::sqrt(smallest / shear()) - 1);
}

TensorState HardeningSoilSmall::initialInternals() const
{
	TensorState       state(variables);
	const TensorState plain = HardeningSoil::initialInternals();
	std::copy_n(plain.numbers(), plain.size(), state.numbers());
	return state;
}

HardeningSoilSmall::Parameters HardeningSoilSmall::parameters() const
{
	Parameters p;
	const auto plain = HardeningSoil::parameters();
	std::copy(plain.begin(), plain.end(), p.begin());
	p.back() = first_;
	return p;
}

HardeningSoilSmall HardeningSoilSmall::with(const Parameters& p) const
{
	HardeningSoil::Parameters plain;
	std::copy_n(p.begin(), plain.size(), plain.begin());
	return { HardeningSoil::with(plain).given(), p.back(), strain_ };
}

HardeningSoilSmall::Curve HardeningSoilSmall::at(double strain) const
{
	const double within = std::min(strain, most_), below = 1 + decay * within / strain_, tangent = first_ / (below * below);
	if (strain > most_) return { first_ * within / below + shear() * (strain - within), shear(), 0 };
	return { first_ * within / below, tangent, -2 * decay / strain_ * tangent / below };
}

/// Mean modulus of shear between two strains, and its derivatives by both.
HardeningSoilSmall::Mean HardeningSoilSmall::between(double from, double to) const
{
	constexpr double least = 1e-5;
	if (to - from > least * strain_) {
		const Curve  begin = at(from), end = at(to);
		const double mean = (end.stress - begin.stress) / (to - from);
		return { mean, (mean - begin.tangent) / (to - from), (end.tangent - mean) / (to - from) };
	}
	const Curve middle = at((from + to) / 2);
	return { middle.tangent, middle.bend / 2, middle.bend / 2 };
}

/// Shear strain that is round-off has no direction, and what has been is not forgotten by it.
static constexpr double leastStep = 1e-12;

/// Strain since the last turn that a step leaves, and what the step adds. A step that leads back, at an angle to the
/// history whose cosine is c < 0, forgets the history's component along it, and of that across it, |history| sqrt(1 -
/// c^2), so much that 1 - c^2 of the whole stays: nothing where the step leads straight back, all of it where it leads
/// across. So the modulus has no jump where a step turns, which Newton's method would have to cross.
HardeningSoilSmall::Turn HardeningSoilSmall::turnOf(const Mat3& history, const Mat3& shearing) const
{
	const double length = shearing.norm(), unit = std::sqrt(1.5);
	// Strain beyond that from which on the modulus is that of unloading needs no memory.
	const double known = std::min(history.norm(), most_ / unit);
	const Mat3   past  = known > 0 ? Mat3(history * (known / history.norm())) : Mat3(Mat3::Zero());
	if (!(length > leastStep)) return { past, unit * known, unit * known };
	const Mat3   along  = shearing / length;
	const double cosine = known > 0 ? std::clamp(past.cwiseProduct(along).sum() / known, -1., 1.) : 0;
	Turn         turn;
	if (cosine >= 0) {
		turn.after  = past + shearing;
		turn.from   = unit * known;
		turn.to     = shearOf(turn.after);
		turn.byStep = turn.to > 0 ? Mat3(1.5 / turn.to * turn.after) : Mat3(Mat3::Zero());
		return turn;
	}
	const double sine = std::sqrt(1 - cosine * cosine), left = known * sine * sine;
	turn.after      = shearing + sine * (past - known * cosine * along);
	turn.from       = unit * left;
	turn.to         = unit * std::hypot(left, length);
	turn.fromByStep = -2 * unit * cosine / length * (past - known * cosine * along);
	turn.byStep     = (turn.from * turn.fromByStep + 1.5 * shearing) / turn.to;
	return turn;
}

TensorAnswer HardeningSoilSmall::answer(const TensorStep& step, bool flows) const
{
	const Mat3 increment = logarithm(step.stretch), shearing = deviatorOf(increment);
	const Turn turn = turnOf(step.state.tensor(strainHistory), shearing);
	const Mean mean = between(turn.from, turn.to);
	// The strain that has the stress of the beginning, and then that of the step, with the modulus of the step.
	const double factor = step.state.scalar(stiffness), stiffer = factor * mean.modulus / shear();
	const Mat3   elastic = step.trialStrain - increment;
	const auto   with    = [&](double stiffer, bool wantsTangent) {
                TensorStep changed              = step;
                changed.trialStrain             = increment + factor / stiffer * elastic;
                changed.state.scalar(stiffness) = stiffer;
                changed.wantsTangent            = wantsTangent;
                return flows ? HardeningSoil::respond(changed) : HardeningSoil::elastic(changed);
	};
	TensorAnswer answer = with(stiffer, step.wantsTangent);
	if (shearing.norm() > 0) answer.state.setTensor(strainHistory, turn.after);
	if (!step.wantsTangent || answer.failed) return answer;
	// The modulus changes with the strain of the step: of the stress by the modulus, differences of fourth order.
	const double h         = 1e-4 * stiffer;
	const auto   at        = [&](double s) { return toMandel(with(stiffer + s * h, false).stress); };
	const Vec6   byModulus = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
	const Mat3   byStep    = mean.byBegin * turn.fromByStep + mean.byEnd * turn.byStep;
	answer.tangent += factor / shear() * byModulus * toMandel(byStep).transpose();
	return answer;
}

} // namespace gimpm
