// SPDX-License-Identifier: GPL-2.0-or-later
// Inside the law pressures are positive, and P includes the shift c cot(phi), so that strength goes with it. With the
// direction nu of the deviator, which flow leaves as it is, principal pressures are P + Q nu_i, and all surfaces are
// curves in the plane of P and Q.
#include "core/materials/hardening_soil.hpp"
#include "core/base/small_matrices.hpp"
#include "core/materials/isotropic_answer.hpp"
#include <unsupported/Eigen/AutoDiff>

namespace gimpm {
namespace {

/// Numbers with derivatives by the four unknowns of a return and the five numbers of the trial.
using Derivatives = Eigen::Matrix<double, 9, 1>;
using Number      = Eigen::AutoDiffScalar<Derivatives>;

double valueOf(double x) { return x; }
double valueOf(const Number& x) { return x.value(); }

/// The root of a function that falls from f(low) > 0 to f(high) < 0: Illinois' method, and bisection where it is slow.
template <class F> double root(double low, double high, double atLow, double atHigh, double tolerance, F&& f)
{
	for (int iteration = 0, side = 0; iteration < 100 && high - low > tolerance; ++iteration) {
		const bool   isSlow = iteration % 4 == 3 || !(atLow - atHigh > 0);
		const double middle = isSlow ? (low + high) / 2 : low + (high - low) * atLow / (atLow - atHigh), at = f(middle);
		if (at > 0) {
			low = middle, atLow = at;
			if (side > 0) atHigh /= 2;
			side = 1;
		} else {
			high = middle, atHigh = at;
			if (side < 0) atLow /= 2;
			side = -1;
		}
	}
	return (low + high) / 2;
}

} // namespace

/// Trial state of a step, with the state as it begins. Directions are sorted from the most to the least pressed axis.
struct HardeningSoil::Trial {
	std::array<int, 3>    axes;                ///< axes of the principal values
	double                bulk, shear;         ///< moduli of unloading in the step
	double                volumetric, sheared; ///< strains, the former of compression
	std::array<double, 3> direction;           ///< nu
	double                hardening, cap;      ///< values as the step begins, the cap with the shift
	double                sine;                ///< sine of the dilation angle in the step

	Trial(const HardeningSoil&, const Vec3& strain, const TensorState&);

	/// Plastic shear over its part that counts, sqrt(2/3) of the deviator: the shear strain of Mohr-Coulomb's
	/// potential in triaxial compression, extension and plane strain.
	template <class T> T perShear(const std::array<T, 3>& nu) const
	{
		const T middle = valueOf(nu[1]) < 0 ? T(-nu[1]) : nu[1];
		return T(1.5 * (nu[0] - nu[2] + middle)) / T(1 + sine * nu[1]);
	}
	double pressure(double shift) const { return bulk * volumetric + shift; }
	double difference() const { return 3 * shear * sheared; }
};

/// The end of a return.
struct HardeningSoil::Flow {
	enum class Shear { none, hardens, fails, apex };
	double pressure, difference;      ///< P with the shift, Q
	double shear = 0, compaction = 0; ///< plastic strains: that of the shear surface, and the volumetric one of the cap
	Shear  mode     = Shear::none;
	bool   isOnCap  = false;
	bool   isFailed = false;
};

/// Derivatives of P and Q by volumetric strain, shear strain and direction of the trial.
struct HardeningSoil::Derivatives {
	std::array<double, 5> pressure, difference;
};

HardeningSoil::HardeningSoil(const Given& g)
        : given_(g)
        , sine_(std::sin(g.frictionAngle))
        , strengthRatio_(2 * sine_ / (1 - sine_))
        , shift_(g.cohesion / std::tan(g.frictionAngle))
        , unit_(g.reference + shift_)
        , initialModulus_(2 * g.secant / (2 - g.failureRatio))
        , bulk_(g.unloading / (3 * (1 - 2 * g.poisson)))
        , shear_(g.unloading / (2 * (1 + g.poisson)))
{
	const AtRest rest(*this);
	const double volume = 1 / g.oedometric - rest.byElasticVolume - rest.byShearVolume;
	const double shear  = 2 / (3 * g.oedometric) - rest.byElasticShear - rest.byShearShear;
	// Flow is normal to the cap P^2 + shape Q^2, along which stress goes with the vertical pressure.
	shape_      = shear / volume * rest.pressure / rest.difference;
	capUnit_    = std::sqrt(rest.pressure * rest.pressure + shape_ * rest.difference * rest.difference);
	capModulus_ = (rest.pressure * (1 + 2 * g.restRatio) / 3 + shape_ * rest.difference * (1 - g.restRatio)) / (capUnit_ * volume);
}

HardeningSoil::AtRest::AtRest(const HardeningSoil& law)
        : pressure((1 + 2 * law.given_.restRatio) / 3 * law.given_.reference + law.shift_), difference((1 - law.given_.restRatio) * law.given_.reference)
{
	const Given& g        = law.given_;
	const double smallest = g.restRatio * g.reference + law.shift_, factor = law.factorAt(smallest), strength = law.strengthRatio_ * smallest;
	mobilised       = difference / strength;
	byElasticVolume = (1 + 2 * g.restRatio) / (3 * factor * law.bulk_);
	byElasticShear  = (1 - g.restRatio) / (3 * factor * law.shear_);
	// The hyperbola strength / factor * f(mobilised), of which strength goes with the smallest pressure.
	const double below      = 1 - g.failureRatio * mobilised;
	const double derivative = 2 / (law.initialModulus_ * below * below) - 2 / g.unloading;
	const double byRest     = law.strengthRatio_ / factor * ((1 - g.power) * law.hyperbola(mobilised) - derivative * mobilised);
	const double growth     = byRest * g.restRatio + derivative / factor * (1 - g.restRatio);
	const double dilates    = law.dilatancy(difference / (difference + 2 * smallest));
	byShearShear            = growth * (3 - dilates) / (6 * (1 - dilates));
	byShearVolume           = -dilates * growth / (1 - dilates);
}

double HardeningSoil::largestOedometric(const Given& given)
{
	const AtRest rest { HardeningSoil(given) };
	return std::min(2. / 3 / (rest.byElasticShear + rest.byShearShear), 1 / (rest.byElasticVolume + rest.byShearVolume));
}

double HardeningSoil::leastRestRatio(const Given& g)
{
	const double sine = std::sin(g.frictionAngle), active = (1 - sine) / (1 + sine);
	return active - 2 * g.cohesion * std::sqrt(active) / g.reference;
}

TensorState HardeningSoil::initialInternals() const
{
	TensorState state(variables);
	state.scalar(stiffness) = factorAt(shift_);
	return state;
}

HardeningSoil::Parameters HardeningSoil::parameters() const
{
	return { given_.secant, given_.oedometric, given_.unloading, given_.cohesion, given_.frictionAngle, given_.dilationAngle };
}

HardeningSoil HardeningSoil::with(const Parameters& p) const
{
	Given given  = given_;
	given.secant = p[0], given.oedometric = p[1], given.unloading = p[2], given.cohesion = p[3], given.frictionAngle = p[4], given.dilationAngle = p[5];
	return HardeningSoil(given);
}

double HardeningSoil::factorAt(double smallest) const { return std::pow(std::max(smallest / unit_, leastPressure), given_.power); }

/// Plastic shear strain times the modulus factor, over the strength: 2 / Ei u / (1 - Rf u) - 2 / Eur u.
double HardeningSoil::hyperbola(double u) const { return 2 * u / (initialModulus_ * (1 - given_.failureRatio * u)) - 2 * u / given_.unloading; }

double HardeningSoil::mostHardening(double smallest) const { return strengthRatio_ * smallest / factorAt(smallest) * hyperbola(1); }

/// The part of the strength to which a shear hardening has led, at most 1.
double HardeningSoil::mobilisedAt(double hardening, double smallest) const
{
	const double first = 2 / initialModulus_, last = 2 / given_.unloading, b = hardening * factorAt(smallest) / (strengthRatio_ * smallest);
	const double h = first - last + b * given_.failureRatio;
	return std::min(1., 2 * b / (h + std::sqrt(h * h + 4 * last * given_.failureRatio * b)));
}

/// Sine of the dilation angle (Rowe 1962), not below 0: contraction is the cap's.
double HardeningSoil::dilatancy(double mobilised) const
{
	const double most = std::sin(given_.dilationAngle), critical = (sine_ - most) / (1 - sine_ * most);
	return std::clamp((mobilised - critical) / (1 - mobilised * critical), 0., most);
}

/// d cap / d volumetric = capModulus (cap / capUnit)^m.
double HardeningSoil::capAt(double before, double volumetric) const
{
	const double strain = capModulus_ / capUnit_ * volumetric, m = given_.power;
	if (m > 1 - 1e-9) return before * std::exp(strain);
	return capUnit_ * std::pow(std::pow(before / capUnit_, 1 - m) + (1 - m) * strain, 1 / (1 - m));
}

namespace {

/// Direction of the cap's measure of Q, with delta = (3 + sin phi) / (3 - sin phi): Q of triaxial compression.
template <class T> T capDirection(const std::array<T, 3>& nu, double sine)
{
	const double delta = (3 + sine) / (3 - sine);
	return nu[0] + (delta - 1) * nu[1] - delta * nu[2];
}

} // namespace

/// Return to the cap alone: P falls and Q with it as the volume is compacted, and the cap grows.
HardeningSoil::Flow HardeningSoil::onCap(const Trial& trial, double pressure, double difference) const
{
	Flow         flow { pressure, difference };
	const double direction = capDirection(trial.direction, sine_), shape = shape_ * direction * direction;
	if (!(pressure > 0) || std::hypot(pressure, std::sqrt(shape) * difference) <= trial.cap * (1 + tolerance)) return flow;
	const auto at = [&](double v) {
		flow.pressure   = pressure - trial.bulk * v;
		flow.difference = flow.pressure > 0 ? difference / (1 + 3 * trial.shear * shape * v / flow.pressure) : 0;
		return std::hypot(flow.pressure, std::sqrt(shape) * flow.difference) - capAt(trial.cap, v);
	};
	const double most = pressure / trial.bulk, first = at(0), last = at(most);
	flow.compaction = root(0, most, first, last, 1e-6 * most, at);
	at(flow.compaction);
	flow.isOnCap = true;
	return flow;
}

HardeningSoil::Flow HardeningSoil::returned(const Trial& trial) const
{
	const double most = trial.sheared, counted = (1 - trial.sine) * trial.perShear(trial.direction),
	             byShear = trial.bulk * trial.sine * trial.perShear(trial.direction);
	const double P = trial.pressure(shift_), Q = trial.difference(), apart = trial.direction[0] - trial.direction[2];
	const auto   beyond = [&](const Flow& flow, double hardening) {
                const double smallest = flow.pressure + flow.difference * trial.direction[2], Q = flow.difference * apart;
                return smallest > 0 ? Q - strengthRatio_ * smallest * mobilisedAt(hardening, smallest) : Q - smallest;
	};
	Flow       flow;
	const auto at = [&](double shear) {
		flow = onCap(trial, P + byShear * shear, Q - 3 * trial.shear * shear);
		return beyond(flow, trial.hardening + counted * shear);
	};
	const double first = at(0);
	if (first <= tolerance * (std::abs(P) + Q)) {
		flow.isFailed = !polish(trial, flow);
		return flow;
	}
	if (P + byShear * most <= 0) { // nothing is left but the apex
		flow      = { 0, 0 };
		flow.mode = Flow::Shear::apex;
		return flow;
	}
	const double last = at(most), shear = root(0, most, first, last, 1e-6 * most, at);
	at(shear);
	flow.shear             = shear;
	const double smallest  = flow.pressure + flow.difference * trial.direction[2];
	const auto   solveWith = [&](Flow::Shear mode) {
                Flow one     = flow;
                one.mode     = mode;
                one.isFailed = !polish(trial, one);
                return one;
	};
	const bool fails = smallest <= 0 || mobilisedAt(trial.hardening + counted * shear, smallest) >= 1;
	flow             = solveWith(fails ? Flow::Shear::fails : Flow::Shear::hardens);
	return flow;
}

/// Residual of the definitions of P and Q, and of the active mechanisms.
template <class T>
std::array<T, 4> HardeningSoil::residual(const Trial& trial, const Flow& flow, const std::array<T, 4>& unknown, const std::array<T, 5>& strains) const
{
	using std::exp;
	using std::pow;
	const auto& [P, Q, shear, compaction] = unknown;
	const std::array<T, 3> nu { strains[2], strains[3], strains[4] };
	const T                perShear = trial.perShear(nu), direction = capDirection(nu, sine_), shape = shape_ * direction * direction;
	std::array<T, 4>       r;
	r[0]             = T(P - shift_ - trial.bulk * (strains[0] - compaction + trial.sine * perShear * shear)) / unit_;
	r[1]             = T(Q * (1. + 3 * trial.shear * shape * compaction / P) - 3 * trial.shear * (strains[1] - shear)) / unit_;
	const T smallest = P + Q * nu[2], deviation = Q * (nu[0] - nu[2]), u = deviation / (strengthRatio_ * smallest);
	if (flow.mode == Flow::Shear::fails) r[2] = T(u - 1.);
	else if (flow.mode == Flow::Shear::hardens) {
		const T part   = T(smallest / unit_);
		const T factor = valueOf(part) > leastPressure ? T(pow(part, given_.power)) : T(factorAt(0));
		const T grown  = T(2. * u / T(initialModulus_ * (1. - given_.failureRatio * u))) - (2 / given_.unloading) * u;
		r[2] = T(strengthRatio_ * smallest / factor * grown - trial.hardening - (1 - trial.sine) * perShear * shear) * (initialModulus_ / unit_);
	} else
		r[2] = shear;
	if (!flow.isOnCap) {
		r[3] = compaction;
		return r;
	}
	const double m     = given_.power;
	const T      grown = (capModulus_ / capUnit_) * compaction;
	const T      inner = m > 1 - 1e-9 ? grown : T((1 - m) * grown + std::pow(trial.cap / capUnit_, 1 - m));
	const T      cap   = m > 1 - 1e-9 ? T(trial.cap * exp(inner)) : T(capUnit_ * pow(inner, 1 / (1 - m)));
	r[3]               = T(P * P + shape * Q * Q) / T(cap * cap) - 1.;
	return r;
}

namespace {

template <class Unknown> std::pair<std::array<Number, 4>, std::array<Number, 5>> withDerivatives(const Unknown& unknown, const std::array<double, 5>& strains)
{
	std::array<Number, 4> x;
	std::array<Number, 5> e;
	for (int i = 0; i < 4; ++i)
		x[i] = Number(unknown[i], 9, i);
	for (int i = 0; i < 5; ++i)
		e[i] = Number(strains[i], 9, 4 + i);
	return { x, e };
}

} // namespace

/// Newton's method for all unknowns, from the root that was found for one after the other.
bool HardeningSoil::polish(const Trial& trial, Flow& flow) const
{
	if (flow.mode == Flow::Shear::none && !flow.isOnCap) return true;
	const std::array<double, 5> strains { trial.volumetric, trial.sheared, trial.direction[0], trial.direction[1], trial.direction[2] };
	Eigen::Vector4d             x(flow.pressure, flow.difference, flow.shear, flow.compaction);
	for (int iteration = 0; iteration < 20; ++iteration) {
		const auto [unknown, given] = withDerivatives(x, strains);
		const auto      r           = residual<Number>(trial, flow, unknown, given);
		Eigen::Vector4d value;
		Eigen::Matrix4d J;
		for (int i = 0; i < 4; ++i)
			value[i] = r[i].value(), J.row(i) = r[i].derivatives().head<4>();
		const Eigen::Vector4d step = solutionOf(J, value);
		if (!step.allFinite()) return false;
		x -= step;
		const double size = std::abs(trial.pressure(shift_)) + trial.difference() + shift_;
		if (std::abs(step[0]) + std::abs(step[1]) <= 1e-13 * size
		    && std::abs(step[2]) + std::abs(step[3]) <= 1e-13 * size / trial.bulk + 1e-12 * (x[2] + x[3])) {
			flow.pressure = x[0], flow.difference = x[1], flow.shear = x[2], flow.compaction = x[3];
			return x[0] > 0 && x[1] >= 0 && x[2] >= -1e-12 && x[3] >= -1e-12;
		}
	}
	return false;
}

HardeningSoil::Derivatives HardeningSoil::derivatives(const Trial& trial, const Flow& flow) const
{
	if (flow.mode == Flow::Shear::apex) return { { floorAtApex * trial.bulk }, { 0, floorAtApex * 3 * trial.shear } };
	if (flow.mode == Flow::Shear::none && !flow.isOnCap) return { { trial.bulk }, { 0, 3 * trial.shear } };
	const std::array<double, 5> strains { trial.volumetric, trial.sheared, trial.direction[0], trial.direction[1], trial.direction[2] };
	const auto [unknown, given]   = withDerivatives(std::array<double, 4> { flow.pressure, flow.difference, flow.shear, flow.compaction }, strains);
	const auto                  r = residual<Number>(trial, flow, unknown, given);
	Eigen::Matrix4d             J;
	Eigen::Matrix<double, 4, 5> by;
	for (int i = 0; i < 4; ++i)
		J.row(i) = r[i].derivatives().head<4>(), by.row(i) = r[i].derivatives().tail<5>();
	const Eigen::Matrix<double, 4, 5> d = -solutionOf(J, by);
	Derivatives                       s;
	for (int i = 0; i < 5; ++i)
		s.pressure[i] = d(0, i), s.difference[i] = d(1, i);
	return s;
}

HardeningSoil::Trial::Trial(const HardeningSoil& law, const Vec3& strain, const TensorState& state)
        : axes { 0, 1, 2 }, bulk(state.scalar(stiffness) * law.bulk_), shear(state.scalar(stiffness) * law.shear_), volumetric(-strain.sum())
{
	const double mean = strain.mean(), length = (strain.array() - mean).matrix().norm();
	std::sort(axes.begin(), axes.end(), [&](int i, int j) { return strain[i] < strain[j]; });
	sheared = std::sqrt(2. / 3) * length;
	// Without a deviator any direction will do.
	for (int i = 0; i < 3; ++i)
		direction[i] = length > 0 ? -std::sqrt(2. / 3) * (strain[axes[i]] - mean) / length : i == 0 ? 2. / 3 : -1. / 3;
	hardening = state.scalar(shearHardening);
	cap       = std::max(state.scalar(capPressure) + law.shift_, leastPressure * law.unit_);
	sine      = state.scalar(dilated) >= law.given_.mostDilation ? 0 : law.dilatancy(std::sin(state.scalar(mobilisedFriction)));
}

Response HardeningSoil::respond(const Vec3& strain, TensorState& state, double growth, bool flows) const
{
	const Trial trial(*this, strain, state);
	const Flow  flow = flows ? returned(trial) : Flow { trial.pressure(shift_), trial.difference() };
	Response    r;
	r.failed = flow.isFailed || !std::isfinite(flow.pressure + flow.difference);
	if (r.failed != 0) return r;
	// Part that is left of the trial deviator.
	const double part     = trial.sheared > 0 ? flow.difference / trial.difference()
	                                          : 1 / (1 + 3 * trial.shear * shape_ * flow.compaction / std::max(flow.pressure, leastPressure * unit_));
	const Vec3   deviator = strain.array() - strain.mean();
	r.stress              = shift_ - flow.pressure + (2 * part * trial.shear * deviator).array();
	r.shear.fill(std::max(part, floorAtApex) * trial.shear);
	setTangent(trial, derivatives(trial, flow), deviator, r);
	setState(trial, flow, state);
	state.scalar(plasticStrain) += std::max(0., (1 - part) * trial.sheared);
	state.scalar(dilated) += growth;
	// The elastic strain that has this stress with the moduli of the next step.
	const double next = state.scalar(stiffness);
	r.elasticStrain   = (shift_ - flow.pressure) / (3 * next * bulk_) + (part * trial.shear / (next * shear_) * deviator).array();
	return r;
}

/// Tangent with d nu_i / d e_j = -sqrt(2/3) / |dev e| (delta_ij - 1/3 - n_i n_j).
void HardeningSoil::setTangent(const Trial& trial, const Derivatives& s, const Vec3& deviator, Response& r) const
{
	const double length = deviator.norm(), root = std::sqrt(2. / 3), perLength = length > 0 ? root / length : 0;
	const Vec3   n = length > 0 ? Vec3(deviator / length) : Vec3(Vec3::Zero()), nu = -root * n;
	Vec3         byPressure, byDifference;
	for (int i = 0; i < 3; ++i)
		byPressure[trial.axes[i]] = s.pressure[2 + i], byDifference[trial.axes[i]] = s.difference[2 + i];
	const Mat3 turning = Mat3::Identity() - Mat3::Constant(1. / 3) - n * n.transpose();
	const Vec3 P       = -s.pressure[0] * Vec3::Ones() - s.pressure[1] * nu - perLength * (turning * byPressure);
	const Vec3 Q       = -s.difference[0] * Vec3::Ones() - s.difference[1] * nu - perLength * (turning * byDifference);
	r.tangent          = -Vec3::Ones() * P.transpose() - nu * Q.transpose() + 2 * r.shear[0] * turning;
}

/// Sets the internal variables at the end.
void HardeningSoil::setState(const Trial& trial, const Flow& flow, TensorState& state) const
{
	const double smallest = flow.pressure + flow.difference * trial.direction[2], largest = flow.pressure + flow.difference * trial.direction[0];
	const double grown = trial.hardening + (1 - trial.sine) * trial.perShear(trial.direction) * std::max(flow.shear, 0.);
	if (flow.mode == Flow::Shear::hardens) state.scalar(shearHardening) = grown;
	if (flow.mode == Flow::Shear::fails) state.scalar(shearHardening) = std::max(trial.hardening, std::min(grown, mostHardening(smallest)));
	if (flow.isOnCap) state.scalar(capPressure) = std::max(state.scalar(capPressure), capAt(trial.cap, flow.compaction) - shift_);
	setMobilised(state, smallest, largest);
	state.scalar(stiffness) = factorAt(smallest);
}

void HardeningSoil::setMobilised(TensorState& state, double smallest, double largest) const
{
	const double sine               = largest + smallest > 0 ? (largest - smallest) / (largest + smallest) : 0;
	state.scalar(mobilisedFriction) = std::asin(std::clamp(sine, 0., sine_));
}

TensorAnswer HardeningSoil::respond(const TensorStep& step) const
{
	const double growth = std::log(step.stretch.determinant());
	return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) { return respond(strain, state, growth, true); });
}

TensorAnswer HardeningSoil::elastic(const TensorStep& step) const
{
	const double growth = std::log(step.stretch.determinant());
	return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) { return respond(strain, state, growth, false); });
}

TensorState HardeningSoil::bearing(const Mat3& stress, TensorState state) const
{
	const Vec3   pressure = shift_ - principal(SymTensor<3>::from(stress)).value.array();
	const double smallest = pressure.minCoeff(), largest = pressure.maxCoeff(), mean = pressure.mean();
	const double mobilised  = smallest > 0 ? (largest - smallest) / (strengthRatio_ * smallest) : 0;
	state.scalar(stiffness) = factorAt(smallest);
	setMobilised(state, smallest, largest);
	// Hardening bears no stress beyond the strength.
	const double reached         = strengthRatio_ * std::max(smallest, 0.) / factorAt(smallest) * hyperbola(std::min(mobilised, 1.));
	state.scalar(shearHardening) = std::max(state.scalar(shearHardening), reached);
	std::array<double, 3> sorted { pressure[0], pressure[1], pressure[2] };
	std::sort(sorted.rbegin(), sorted.rend());
	const double sheared      = capDirection(sorted, sine_);
	state.scalar(capPressure) = std::max(state.scalar(capPressure), std::sqrt(mean * mean + shape_ * sheared * sheared) - shift_);
	return state;
}

Mat3 HardeningSoil::strainOf(const Mat3& stress, const TensorState& state) const
{
	const double factor = state.scalar(stiffness), mean = stress.trace() / 3;
	return (stress - mean * Mat3::Identity()) / (2 * factor * shear_) + mean / (3 * factor * bulk_) * Mat3::Identity();
}

} // namespace gimpm
