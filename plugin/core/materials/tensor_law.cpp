// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/tensor_law.hpp"
#include <deque>
#include <string>

namespace gimpm {
namespace {

/// The names of what is added, which nobody else keeps.
const char* kept(std::string name)
{
	static std::deque<std::string> names;
	return names.emplace_back(std::move(name)).c_str();
}

/// x / sinh x.
double overSinh(double x) { return std::abs(x) < 1e-3 ? 1 - x * x * (1. / 6 - x * x * 7. / 360) : x / std::sinh(x); }

/// Trial state of one step: stretches V and rotation R with F = V R, and the trial elastic strain e, the axes of which
/// are those of b.
struct TrialState {
	Principal<3> V, b;
	Vec3         lambda, e;
	Mat3         R, strain;

	TrialState(const SymTensor<3>& b1, const Mat3& gradient)
	        : V(principal(pushForward(SymTensor<3>(), gradient))), b(principal(pushForward(b1, gradient))), e(logStrain<double>(b.value))
	{
		const Vec3 stretch = logStrain<double>(V.value);
		lambda             = stretch.array().exp();
		// Inverse of V, less 1.
		const Mat3 shrink = V.axes * Vec3(stretch.unaryExpr([](double x) { return std::expm1(-x); })).asDiagonal() * V.axes.transpose();
		const Mat3 F      = gradient + Mat3::Identity();
		R                 = F + shrink * F;
		strain            = b.axes * e.asDiagonal() * b.axes.transpose();
	}
};

/// The rates of R and of the trial strain. In the axes of V the spin is (l_ij lambda_j - l_ji lambda_i) / (lambda_i +
/// lambda_j). In those of b the rate of the strain is half of that of log b, whose divided differences are 2 d / (exp(2
/// e_i) - exp(2 e_j)) with d = e_i - e_j.
class TrialRates {
public:
	explicit TrialRates(const TrialState& trial) : trial_(trial)
	{
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j) {
				const double d  = trial.e[i] - trial.e[j];
				spinOf_(i, j)   = trial.lambda[j] / (trial.lambda[i] + trial.lambda[j]);
				strainOf_(i, j) = overSinh(d) / 2 * std::exp(-d);
			}
	}
	/// Rate of R, times the transpose of R.
	Mat3 spin(const Mat3& l) const
	{
		const Mat3& q    = trial_.V.axes;
		const Mat3  part = spinOf_.cwiseProduct(q.transpose() * l * q);
		return q * (part - part.transpose()) * q.transpose();
	}
	Mat3 strain(const Mat3& l) const
	{
		const Mat3& q    = trial_.b.axes;
		const Mat3  part = strainOf_.cwiseProduct(q.transpose() * l * q);
		return q * (part + part.transpose()) * q.transpose();
	}

private:
	const TrialState& trial_;
	Mat3              spinOf_, strainOf_;
};

Mat3 turned(const Mat3& R, const Mat3& tensor) { return R * tensor * R.transpose(); }

/// The stress turns with R, and so does what the law sees of the strain.
void setRates(TensorPoint& point, const TrialState& trial, const Mandel& tangent, const TensorQuestion& question)
{
	const TrialRates rates(trial);
	point.rates.setZero();
	for (int k = 0; k < 3; ++k)
		for (int l = 0; l < 3; ++l) {
			const bool isInPlane = k < question.dim && l < question.dim, isAround = k == 2 && l == 2 && question.axes == 3;
			if (!isInPlane && !isAround) continue;
			Mat3 gradient  = Mat3::Zero();
			gradient(k, l) = 1;
			const Mat3 W = rates.spin(gradient), seen = rates.strain(gradient) - W * trial.strain + trial.strain * W;
			const Mat3 law  = fromMandel(tangent * toMandel(turned(trial.R.transpose(), seen)));
			const Mat3 rate = turned(trial.R, law) + W * point.stress - point.stress * W;
			for (int i = 0; i < 9; ++i)
				point.rates(i, 3 * k + l) = rate(i / 3, i % 3);
		}
}

} // namespace

std::vector<int> TensorVariable::columns() const
{
	static constexpr const char* ends[] = { "XX", "YY", "ZZ", "XY", "YZ", "ZX" };
	static constexpr const char* axes[] = { "X", "Y", "Z" };
	if (kind == Kind::scalar) return { internalVariables.add(variable) };
	std::vector<int> columns;
	for (int i = 0; i < count(); ++i) {
		const char* const end   = kind == Kind::tensor ? ends[i] : axes[i];
		const std::string name  = variable.name + std::string(end);
		const int         known = internalVariables.find(name);
		InternalVariable  one   = variable;
		if (known < 0) one.name = kept(name), one.description = kept(variable.description + (" " + std::string(end)));
		columns.push_back(known < 0 ? internalVariables.add(one) : known);
	}
	return columns;
}

void TensorState::turn(const Mat3& R)
{
	for (int k = 0; k < count_; ++k) {
		if (variables_[k].kind == TensorVariable::Kind::vector) setVector(k, Vec3(R * vector(k)));
		if (variables_[k].kind == TensorVariable::Kind::tensor) setTensor(k, turned(R, tensor(k)));
	}
}

const PrincipalLaw& placeholder()
{
	static const PrincipalLaw law { Hencky(1, 0) };
	return law;
}

TensorPoint respondInSpace(const Law& law, const PointOfLaw& at, const TensorQuestion& question)
{
	const TrialState trial(question.b1, question.gradient);
	const Mat3       back    = trial.R.transpose();
	const Mat3       stretch = turned(back, trial.V.axes * trial.lambda.asDiagonal() * trial.V.axes.transpose());
	TensorAnswer     answer  = law->respond(at, { turned(back, trial.strain), stretch, question.duration, {}, question.wantsRates, question.isBeginning });
	TensorPoint      point { turned(trial.R, answer.stress), turned(trial.R, answer.elasticStrain), answer.state, answer.failed, {} };
	point.state.turn(trial.R);
	if (question.wantsRates && !point.failed) setRates(point, trial, answer.tangent, question);
	return point;
}

} // namespace gimpm
