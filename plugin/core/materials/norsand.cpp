// SPDX-License-Identifier: GPL-2.0-or-later
// Inside the law pressures are negative, as in the paper, so that p = -P and pi = -Pi.
#include "core/materials/norsand.hpp"
#include "core/base/small_matrices.hpp"
#include "core/materials/isotropic_answer.hpp"

namespace gimpm {

/// Trial state of a step: elastic volumetric and shear strain, image pressure before, specific volume after.
struct NorSand::Trial {
	double volumetric, shear, image, volume;
};

/// The end of a return, and its derivatives by the volumetric and the shear strain of the trial.
struct NorSand::Flow {
	double                      volumetric, shear, image;
	bool                        isFailed    = false;
	Eigen::Matrix<double, 2, 2> derivatives = Eigen::Matrix2d::Identity(); ///< first two by the trial
};

NorSand::NorSand(const Given& given) : given_(given), nonAssociated_((1 - given.curvature) / (1 - given.flowCurvature)) { }

TensorState NorSand::initialInternals() const
{
	TensorState state(variables);
	state.scalar(imagePressure)  = leastImage * given_.reference;
	state.scalar(specificVolume) = given_.volume;
	return state;
}

NorSand NorSand::with(const Parameters& p) const
{
	Given given = given_;
	given.shear = p[0], given.ratio = p[1];
	return NorSand(given);
}

double NorSand::young(const TensorState& state) const
{
	const double bulk = state.scalar(imagePressure) / given_.swelling;
	return 9 * bulk * given_.shear / (3 * bulk + given_.shear);
}

double NorSand::pressureAt(double volumetric) const { return -given_.reference * std::exp(-volumetric / given_.swelling); }
double NorSand::volumetricAt(double pressure) const { return -given_.swelling * std::log(-pressure / given_.reference); }

/// eta of the yield function.
double NorSand::obliquity(double p, double pi) const
{
	const double N = given_.curvature, M = given_.ratio;
	return N == 0 ? M * (1 + std::log(pi / p)) : M / N * (1 - (1 - N) * std::pow(p / pi, N / (1 - N)));
}

/// The image pressure of a yield surface through p and Q = -eta p.
double NorSand::imageAt(double p, double eta) const
{
	const double N = given_.curvature, M = given_.ratio;
	if (N == 0) return p * std::exp(eta / M - 1);
	return p * std::pow(std::max(0., 1 - eta * N / M) / (1 - N), (N - 1) / N);
}

/// Residual by elastic volumetric and shear strain, flow and image pressure: flow along the potential, the yield
/// function, and pi - pi_before = -h flow (pi - pi_most), where pi_most is that of the largest dilatancy at this state
/// parameter.
std::pair<NorSand::Vec4, NorSand::Mat4> NorSand::residual(const Trial& trial, const Vec4& x) const
{
	const double N = given_.curvature, M = given_.ratio, h = given_.hardening, G = given_.shear, flow = x[2], pi = x[3];
	const double p = pressureAt(x[0]), byVolume = -p / given_.swelling, q = 3 * G * x[1], eta = obliquity(p, pi);
	const double part = N == 0 ? 0 : std::pow(p / pi, (2 * N - 1) / (1 - N));
	const double byP = N == 0 ? -M / p : -M * part / pi, byPi = N == 0 ? M / pi : M * part * p / (pi * pi);
	const double psi = trial.volume - given_.criticalVolume + given_.compression * std::log(-pi / given_.criticalPressure);
	const double a = given_.dilatancy / nonAssociated_, base = 1 - a * psi * N / M;
	if (!(base > 0)) return { Vec4::Constant(std::numeric_limits<double>::quiet_NaN()), Mat4::Zero() };
	const double most = N == 0 ? std::exp(a * psi / M) : std::pow(base, (N - 1) / N), byPsi = p * most * a / M * (N == 0 ? 1 : (1 - N) / base);
	const double dilatancy = (eta - M) / (1 - N);
	Vec4         r(x[0] - trial.volumetric + flow * nonAssociated_ * dilatancy, x[1] - trial.shear + flow, (q + eta * p) / given_.reference,
	               (pi - trial.image + h * (pi - p * most) * flow) / given_.reference);
	Mat4         J;
	J << 1 + flow * nonAssociated_ * byP / (1 - N) * byVolume, 0, nonAssociated_ * dilatancy, flow * nonAssociated_ * byPi / (1 - N), //
	        0, 1, 1, 0,                                                                                                               //
	        (byP * p + eta) * byVolume, 3 * G, 0, p * byPi,                                                                           //
	        -h * flow * most * byVolume, 0, h * (pi - p * most), 1 + h * flow * (1 - byPsi * given_.compression / pi);
	J.bottomRows<2>() /= given_.reference;
	return { r, J };
}

/// Newton's method, by shorter steps where the residual grows.
bool NorSand::solve(const Trial& trial, Vec4& x) const
{
	const auto sizeOf = [](const Vec4& r) { return std::hypot(1e3 * std::hypot(r[0], r[1]), std::hypot(r[2], r[3])); };
	auto [r, J]       = residual(trial, x);
	double size       = sizeOf(r);
	for (int iteration = 0; iteration < 60 && std::isfinite(size); ++iteration) {
		const Vec4 step = solutionOf(J, r);
		if (!step.allFinite()) return false;
		double part = 1;
		Vec4   next;
		for (int halving = 0;; ++halving, part /= 2) {
			if (halving == 25) return size < 1e-12; // round-off
			next = x - part * step;
			if (!(next[3] < 0) || std::abs(next[0]) > mostExponent * given_.swelling) continue;
			std::tie(r, J)    = residual(trial, next);
			const double then = sizeOf(r);
			if (!(then < size * (1 - .1 * part)) && !(then < 1e-11)) continue;
			size = then;
			break;
		}
		x = next;
		if (part == 1 && std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) <= 1e-12 * (std::abs(trial.volumetric) + trial.shear)
		    && std::abs(step[3]) <= -1e-12 * x[3])
			return true;
		if (size < 1e-15) return true;
	}
	return false;
}

/// The solution, wherever it is, by halving. Of each flow from 0 to the whole deviator there is one ratio eta = Q / P:
/// Q is what is left, and eta P grows with eta, as it dilates the more. The image pressure that eta and P have is more
/// than it becomes where there is no flow, as the trial is outside, and less in the end, unless that is beyond the tip.
NorSand::Vec4 NorSand::between(const Trial& trial) const
{
	constexpr int halvings = 60;
	const double  N = given_.curvature, M = given_.ratio, p = pressureAt(trial.volumetric);
	double        low = 0, high = trial.shear;
	Vec4          x;
	for (int k = 0; k < halvings; ++k) {
		x[2]               = (low + high) / 2;
		x[1]               = trial.shear - x[2];
		const double q     = 3 * given_.shear * x[1];
		double       least = 0, most = std::max(M, -q / p);
		for (int i = 0; i < halvings; ++i) {
			const double eta                             = (least + most) / 2;
			x[0]                                         = trial.volumetric - x[2] * nonAssociated_ * (eta - M) / (1 - N);
			(-eta * pressureAt(x[0]) > q ? most : least) = eta;
		}
		x[3]                                            = imageAt(pressureAt(x[0]), (least + most) / 2);
		(residual(trial, x).first[3] >= 0 ? high : low) = x[2]; // sign for pressures, which are negative; the residual may be infinite first
	}
	return x;
}

/// The pressure on the axis over the image pressure.
double NorSand::tip() const
{
	const double N = given_.curvature;
	return N == 0 ? std::exp(1.) : std::pow(1 - N, (N - 1) / N);
}

/// True if the pressure is beyond the tip even when the whole deviator has flowed, and all its contraction with it.
bool NorSand::isBeyondTip(const Trial& trial) const
{
	const double volumetric = trial.volumetric + trial.shear * nonAssociated_ * given_.ratio / (1 - given_.curvature);
	return residual(trial, { volumetric, 0, trial.shear, pressureAt(volumetric) / tip() }).first[3] < 0; // sign for pressures, which are negative
}

/// The whole deviator flows, and the image pressure with it; P follows from eta = 0. What remains of the image pressure
/// over what there was is 1 + h flow (1 - tip most), which falls with the state parameter, so that there is one answer.
NorSand::Flow NorSand::atTip(const Trial& trial) const
{
	const auto rest = [&](double logarithm) { // residual at the image pressure, and its derivative
		const double pi   = -std::exp(logarithm);
		const auto [r, J] = residual(trial, { volumetricAt(tip() * pi), 0, trial.shear, pi });
		return std::make_pair(-r[3], -pi * J(3, 3) + J(3, 0) * given_.swelling);
	};
	constexpr double most = 100; // e-folds
	double           low = std::log(-trial.image), high = low, width = 1;
	for (; rest(high).first <= 0 && width < most; width *= 2)
		low = high, high += width;
	for (width = 1; !(rest(low).first <= 0) && width < most; width *= 2)
		high = low, low -= width;
	const bool isBetween = rest(low).first <= 0 && rest(high).first > 0;
	double     pi        = (low + high) / 2;
	for (int iteration = 0; iteration < 100 && high - low > 1e-15 * std::abs(pi); ++iteration) {
		const auto [r, derivative] = rest(pi);
		(r <= 0 ? low : high)      = pi;
		const double next          = pi - r / derivative;
		const bool   isInside      = next > low && next < high;
		const double step          = (isInside ? next : (low + high) / 2) - pi;
		pi += step;
		if (std::abs(step) <= 1e-14) break;
	}
	Flow flow { volumetricAt(-tip() * std::exp(pi)), 0, -std::exp(pi) };
	flow.isFailed = !std::isfinite(flow.image) || !isBetween;
	flow.derivatives *= floorAtTip;
	return flow;
}

bool NorSand::solveByHalving(const Trial& trial, Vec4& x) const
{
	constexpr double roundOff = 1e-10;
	const Vec4       halved   = between(trial);
	x                         = halved;
	if (solve(trial, x) && x[1] >= 0 && x[2] >= 0) return true;
	// To round-off it may be there already, which in the last equation grows with the hardening.
	x               = halved;
	const Vec4 rest = residual(trial, x).first * given_.reference;
	return std::abs(rest[2]) < -roundOff * pressureAt(x[0]) && std::abs(rest[3]) < -roundOff * (1 + given_.hardening * x[2]) * x[3];
}

NorSand::Flow NorSand::returned(const Trial& trial) const
{
	const double p = pressureAt(trial.volumetric), q = 3 * given_.shear * trial.shear, eta = obliquity(p, trial.image);
	if (q + eta * p <= -tolerance * p) return { trial.volumetric, trial.shear, trial.image };
	const Vec4 first(trial.volumetric, trial.shear, 0, trial.image);
	Vec4       x        = first;
	bool       isSolved = solve(trial, x) && x[1] >= 0 && x[2] >= 0;
	if (!isSolved && eta < 0 && isBeyondTip(trial)) return atTip(trial);
	isSolved = isSolved || solveByHalving(trial, x);
	Flow flow { x[0], x[1], x[3] };
	flow.isFailed = !isSolved;
	if (!isSolved) return flow;
	// The state parameter changes with the volume of the whole step.
	const Mat4                  J   = residual(trial, x).second;
	const double                psi = trial.volume - given_.criticalVolume + given_.compression * std::log(-x[3] / given_.criticalPressure);
	const double                N = given_.curvature, M = given_.ratio, a = given_.dilatancy / nonAssociated_, base = 1 - a * psi * N / M;
	const double                most  = N == 0 ? std::exp(a * psi / M) : std::pow(base, (N - 1) / N);
	const double                byPsi = pressureAt(x[0]) * most * a / M * (N == 0 ? 1 : (1 - N) / base);
	Eigen::Matrix<double, 4, 2> by    = Eigen::Matrix<double, 4, 2>::Zero();
	by(0, 0) = by(1, 1) = 1;
	by(3, 0)            = given_.hardening * x[2] * byPsi * trial.volume / given_.reference;
	flow.derivatives    = solutionOf(J, by).topRows<2>();
	return flow;
}

/// Sand that comes apart has no stress that matters, and no elastic strain beyond that of so little: it would have to
/// be closed again before it bears anything.
NorSand::Flow NorSand::opened(const Flow& flow) const
{
	const double least = -leastPressure * given_.reference;
	if (flow.isFailed || pressureAt(flow.volumetric) <= least) return flow;
	Flow open { volumetricAt(least), 0, std::min(flow.image, least / tip()) };
	open.derivatives *= floorAtTip;
	return open;
}

Response NorSand::respond(const Vec3& strain, TensorState& state, double growth, bool flows) const
{
	const double mean = strain.mean(), length = (strain.array() - mean).matrix().norm(), root = std::sqrt(2. / 3);
	const Trial  trial { 3 * mean, root * length, -state.scalar(imagePressure), state.scalar(specificVolume) * growth };
	Response     r;
	r.failed = trial.volumetric < -mostExponent * given_.swelling || !(trial.volume >= 1);
	if (r.failed != 0) return r;
	const bool isFarApart = trial.volumetric > mostExponent * given_.swelling; // no flow makes that up
	const Flow elastic { trial.volumetric, trial.shear, trial.image }, flow = isFarApart ? opened(elastic) : flows ? opened(returned(trial)) : elastic;
	r.failed = flow.isFailed;
	if (r.failed != 0) return r;
	const double G = given_.shear, p = pressureAt(flow.volumetric), part = length > 0 ? flow.shear / trial.shear : 1;
	const Vec3   n = length > 0 ? Vec3((strain.array() - mean) / length) : Vec3(Vec3::Zero()), deviator = (strain.array() - mean).matrix();
	r.elasticStrain = part * deviator.array() + flow.volumetric / 3;
	r.stress        = 2 * G * part * deviator.array() + p;
	r.shear.fill(std::max(part, floorAtTip) * G);
	const Eigen::Matrix2d d   = Eigen::Vector2d(-p / given_.swelling, 3 * G).asDiagonal() * flow.derivatives;
	const Mat3            one = Mat3::Constant(1. / 3);
	const Vec3            I   = Vec3::Ones();
	r.tangent                 = I * (d(0, 0) * I + root * d(0, 1) * n).transpose() + root * n * (d(1, 0) * I + root * d(1, 1) * n).transpose()
	        + 2 * G * std::max(part, floorAtTip) * (Mat3::Identity() - one - n * n.transpose());
	state.scalar(plasticStrain) += std::max(0., trial.shear - flow.shear);
	state.scalar(imagePressure)  = -flow.image;
	state.scalar(specificVolume) = trial.volume;
	return r;
}

TensorAnswer NorSand::respond(const TensorStep& step) const
{
	const double growth = step.stretch.determinant();
	return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) { return respond(strain, state, growth, true); });
}

TensorAnswer NorSand::elastic(const TensorStep& step) const
{
	const double growth = step.stretch.determinant();
	return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) { return respond(strain, state, growth, false); });
}

TensorState NorSand::bearing(const Mat3& stress, TensorState state) const
{
	const double p = stress.trace() / 3, q = std::sqrt(1.5) * (stress - p * Mat3::Identity()).norm();
	if (!(p < 0)) return state;
	const double image = -imageAt(p, -q / p);
	if (std::isfinite(image)) state.scalar(imagePressure) = std::max(state.scalar(imagePressure), image);
	return state;
}

Mat3 NorSand::strainOf(const Mat3& stress, const TensorState&) const
{
	const double p = stress.trace() / 3;
	return (stress - p * Mat3::Identity()) / (2 * given_.shear) - given_.swelling / 3 * std::log(-p / given_.reference) * Mat3::Identity();
}

} // namespace gimpm
