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

/// That of triaxial compression.
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

/// Mean modulus of shear between two strains, and its derivative by the second.
std::pair<double, double> HardeningSoilSmall::modulus(double from, double to) const
{
	constexpr double least = 1e-5;
	if (to - from > least * strain_) {
		const Curve  end  = at(to);
		const double mean = (end.stress - at(from).stress) / (to - from);
		return { mean, (end.tangent - mean) / (to - from) };
	}
	const Curve middle = at((from + to) / 2);
	return { middle.tangent, middle.bend / 2 };
}

TensorAnswer HardeningSoilSmall::answer(const TensorStep& step, bool flows) const
{
	const Mat3   increment = logarithm(step.stretch), shearing = deviatorOf(increment), past = step.state.tensor(strainHistory);
	const bool   turns  = past.cwiseProduct(shearing).sum() <= 0;
	const Mat3   before = turns ? Mat3(Mat3::Zero()) : past, after = before + shearing;
	const double from = shearOf(before), to = shearOf(after);
	const auto [mean, slope] = modulus(from, to);
	// The strain that has the stress of the beginning, and then that of the step, with the modulus of the step.
	const double factor = step.state.scalar(stiffness), stiffer = factor * mean / shear();
	const Mat3   elastic = step.trialStrain - increment;
	const auto   with    = [&](double stiffer, bool wantsTangent) {
                TensorStep changed              = step;
                changed.trialStrain             = increment + factor / stiffer * elastic;
                changed.state.scalar(stiffness) = stiffer;
                changed.wantsTangent            = wantsTangent;
                return flows ? HardeningSoil::respond(changed) : HardeningSoil::elastic(changed);
	};
	TensorAnswer answer = with(stiffer, step.wantsTangent);
	if (shearing.norm() > 0) answer.state.setTensor(strainHistory, after);
	if (!step.wantsTangent || answer.failed || to == 0) return answer;
	// The modulus changes with the strain of the step: of the stress by the modulus, differences of fourth order.
	const double h         = 1e-4 * stiffer;
	const auto   at        = [&](double s) { return toMandel(with(stiffer + s * h, false).stress); };
	const Vec6   byModulus = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
	answer.tangent += factor / shear() * slope * std::sqrt(1.5) / after.norm() * byModulus * toMandel(after).transpose();
	return answer;
}

} // namespace gimpm
