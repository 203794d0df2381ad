// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/power_elastic.hpp"
#include "core/materials/isotropic_answer.hpp"

namespace gimpm {

Hencky PowerElastic::secant(const Moduli& m)
{
	const Hencky at(m.young, m.poisson);
	const double bulk = (1 - m.power) * at.bulk(), shear = at.shear();
	return { 9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear)) };
}

PowerElastic::PowerElastic(const Moduli& moduli, const Strength& strength)
        : moduli_(moduli)
        , secant_(secant(moduli))
        , strength_(strength)
        , exponent_(moduli.power / (1 - moduli.power))
        , scale_(secant_.bulk() / moduli.reference)
        , floor_(std::pow(leastPressure, 1 - moduli.power) / scale_)
{
}

TensorState PowerElastic::initialInternals() const
{
	TensorState state(variables);
	state.scalar(stiffness) = stiffnessOf(0);
	return state;
}

PowerElastic::Parameters PowerElastic::parameters() const
{
	Parameters own = std::visit([](const auto& law) { return law.parameters(); }, strength_);
	own[0]         = moduli_.young;
	return own;
}

PowerElastic PowerElastic::with(const Parameters& p) const
{
	Moduli moduli  = moduli_;
	moduli.young   = p[0];
	Parameters own = p;
	own[0]         = secant(moduli).young();
	return { moduli, std::visit([&](const auto& law) { return Strength(law.with(own)); }, strength_) };
}

PowerElastic::Parameters PowerElastic::weakened(const Weakening& w) const
{
	Parameters weak = std::visit([&](const auto& law) { return law.weakened(w); }, strength_);
	weak[0]         = moduli_.young * w.moduli;
	return weak;
}

bool PowerElastic::isSymmetric() const
{
	return std::visit([](const auto& law) { return law.isSymmetric(); }, strength_);
}

double PowerElastic::stiffnessOf(double energy) const { return std::pow(scale_ * std::sqrt(2 * energy / secant_.bulk() + floor_ * floor_), exponent_); }

double PowerElastic::derivativeOf(double energy) const { return exponent_ * stiffnessOf(energy) / (2 * energy + secant_.bulk() * floor_ * floor_); }

double PowerElastic::energyOf(const Vec3& e) const
{
	const Vec3 deviator = e.array() - e.mean();
	return secant_.bulk() / 2 * e.sum() * e.sum() + secant_.shear() * deviator.squaredNorm();
}

ResponseWith<double, 1> PowerElastic::unscaled(const Vec3& strain) const
{
	return std::visit([&](const auto& law) { return law.respond(strain, { 0 }); }, strength_);
}

/// The stiffness s that belongs to the elastic strain which it leaves: the energy of that falls, relative to s^2, as s
/// grows. Newton's method for the logarithm, and bisection where that leaves the bracket.
std::optional<double> PowerElastic::solve(const Vec3& strain) const
{
	constexpr double exact = 1e-14, most = 1e100;
	double           low = stiffnessOf(0), high = 0, s = stiffnessOf(energyOf(strain));
	for (int iteration = 0; iteration < 100; ++iteration) {
		if (!(s < most)) return std::nullopt;
		const auto   r      = unscaled(s * strain);
		const Vec3   left   = r.elasticStrain / s;
		const double energy = energyOf(left), belongs = stiffnessOf(energy), error = std::log(belongs / s);
		if (std::abs(error) <= exact) return s;
		(error > 0 ? low : high) = s;
		const double derivative  = derivativeOf(energy) / belongs * (left.dot(r.tangent * strain) - 2 * energy) - 1,
		             next        = s * std::exp(-error / derivative);
		const bool   isInside    = derivative < 0 && next > low && (high == 0 || next < high);
		const double other       = high == 0 ? 4 * s : std::sqrt(low * high);
		if (high > 0 && high - low <= 4e-16 * high) return s;
		s = isInside ? next : other;
	}
	return std::nullopt;
}

Response PowerElastic::respond(const Vec3& strain, TensorState& state) const
{
	const auto s = solve(strain);
	Response   r {};
	r.failed = s ? 0 : 1;
	if (!s) return r;
	const auto   own  = unscaled(*s * strain);
	const Vec3   left = own.elasticStrain / *s, byStiffness = own.tangent * strain;
	const double energy = energyOf(left), derivative = derivativeOf(energy) / *s;
	r.stress        = own.stress;
	r.elasticStrain = left;
	r.shear         = *s * own.shear;
	// dt = s D de + D e ds, ds = f'' (e_e . dt - 2 W ds) / s, where D is the tangent without the power, at s e.
	r.tangent = *s * own.tangent;
	r.tangent += derivative * *s / (1 - derivative * (left.dot(byStiffness) - 2 * energy)) * byStiffness * (own.tangent.transpose() * left).transpose();
	state.scalar(plasticStrain) += own.internals[0] / *s;
	state.scalar(stiffness) = *s;
	return r;
}

TensorAnswer PowerElastic::respond(const TensorStep& step) const
{
	return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) { return respond(strain, state); });
}

TensorAnswer PowerElastic::elastic(const TensorStep& step) const
{
	return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) {
		const double energy = energyOf(strain), s = stiffnessOf(energy);
		Response     r = secant_.respond(strain, {});
		r.failed       = std::isfinite(s) ? 0 : 1;
		r.tangent      = s * r.tangent + derivativeOf(energy) * r.stress * r.stress.transpose();
		r.stress *= s;
		r.shear *= s;
		state.scalar(stiffness) = s;
		return r;
	});
}

/// s = f'(W_1 / s^2), where W_1 is the energy of Hencky's strain of that stress: by Newton's method for the logarithm,
/// of which the equation is convex, from below.
double PowerElastic::stiffnessAt(const Mat3& stress) const
{
	const double mean = stress.trace() / 3, deviator = (stress - mean * Mat3::Identity()).squaredNorm();
	const double unit = mean * mean / (2 * secant_.bulk()) + deviator / (4 * secant_.shear());
	double       s    = stiffnessOf(0);
	for (int iteration = 0; iteration < 200; ++iteration) {
		const double energy = unit / (s * s), belongs = stiffnessOf(energy), error = std::log(belongs / s);
		if (error <= 1e-15) break;
		s *= std::exp(error / (1 + 2 * derivativeOf(energy) / belongs * energy));
	}
	return s;
}

Mat3 PowerElastic::strainOf(const Mat3& stress, const TensorState&) const
{
	const double mean = stress.trace() / 3;
	return ((stress - mean * Mat3::Identity()) / (2 * secant_.shear()) + mean / (3 * secant_.bulk()) * Mat3::Identity()) / stiffnessAt(stress);
}

TensorState PowerElastic::bearing(const Mat3& stress, TensorState state) const
{
	state.scalar(stiffness) = stiffnessAt(stress);
	return state;
}

} // namespace gimpm
