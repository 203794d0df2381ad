// SPDX-License-Identifier: GPL-2.0-or-later
// Other people's laws, by the interface of Abaqus (core/materials/umat.hpp). They know a stress that grows with
// increments of strain, and no elastic strain. That of the framework is the strain that the stress has with an elastic
// stiffness of reference, so that the increment is the trial strain less the one before; whatever that stiffness is.
#pragma once
#include "core/materials/tensor_law.hpp"
#include "core/materials/umat.hpp"
#include <memory>
#include <mutex>
#include <string>

namespace gimpm {

/// What all points of a material have in common.
struct UserLawGiven {
	/// A law that takes more parameters or state variables than there are has no finite answer then, and harms
	/// nothing.
	static constexpr std::size_t beyond = 64;

	static std::vector<double> padded(std::vector<double> numbers)
	{
		numbers.resize(numbers.size() + beyond, std::numeric_limits<double>::quiet_NaN());
		return numbers;
	}

	Umat                        call = nullptr;
	std::vector<double>         properties;       ///< and behind them `beyond` numbers that are none, for a law that reads more
	std::vector<double>         first;            ///< values of its state variables
	Hencky                      elastic { 1, 0 }; ///< of reference
	std::shared_ptr<std::mutex> oneAtATime;       ///< null: several threads may call it at a time
};

/// One call: stress [Pa] and state variables as the increment begins, which become those at its end. False where the
/// law asks for a shorter step. In the order of UMAT.
bool callUmat(
        const UserLawGiven&, double (&stress)[6], double* state, int states, double (&tangent)[36], const double (&strain)[6], const double (&increment)[6],
        double duration);

/// Count: of state variables there is room for.
template <int Count> class UserLaw : public TensorLaw {
	static constexpr std::array<TensorVariable, Count + 2> makeVariables();

public:
	explicit UserLaw(std::shared_ptr<const UserLawGiven> given) : given_(std::move(given)) { }

	enum { stressBefore, strain, state1 }; ///< the variables, by number; behind them the other state variables
	static constexpr std::array<TensorVariable, Count + 2> variables = makeVariables();
	static constexpr bool                                  mayFail = true, isElastic = false, isLinear = true, canBeWeakened = false;

	TensorState initialInternals() const
	{
		TensorState state(variables);
		for (std::size_t k = 0; k < given_->first.size() && k < Count; ++k)
			state.scalar(state1 + int(k)) = given_->first[k];
		return state;
	}

	using Parameters = std::array<double, 0>;
	Parameters parameters() const { return {}; }
	UserLaw    with(const Parameters&) const { return *this; }
	Parameters weakened(const Weakening&) const { return {}; }
	bool       isSymmetric() const { return false; }
	double     young(const TensorState&) const { return given_->elastic.young(); }

	TensorState bearing(const Mat3& stress, TensorState state) const
	{
		state.setTensor(stressBefore, stress);
		return state;
	}
	Mat3 strainOf(const Mat3& stress, const TensorState&) const
	{
		const double mean = stress.trace() / 3;
		return (stress - mean * Mat3::Identity()) / (2 * given_->elastic.shear()) + mean / (3 * given_->elastic.bulk()) * Mat3::Identity();
	}

	TensorAnswer respond(const TensorStep& step) const
	{
		const Mat3 before = step.state.tensor(stressBefore), past = step.state.tensor(strain),
		           increment = step.trialStrain - strainOf(before, step.state);
		double       t[6], e[6], d[6], tangent[36] = {}, states[Count + UserLawGiven::beyond];
		TensorAnswer answer(step.state);
		toUmat(before, 1, t), toUmat(past, 2, e), toUmat(increment, 2, d);
		for (int k = 0; k < Count; ++k)
			states[k] = step.state.scalar(state1 + k);
		std::fill(states + given_->first.size(), std::end(states), std::numeric_limits<double>::quiet_NaN());
		answer.failed = !callUmat(*given_, t, states, int(given_->first.size()), tangent, e, d, step.duration);
		for (std::size_t k = 0; k < given_->first.size(); ++k)
			answer.state.scalar(state1 + int(k)) = states[k];
		for (int i = 0; i < 6; ++i) {
			answer.stress(row(i), column(i)) = answer.stress(column(i), row(i)) = t[i];
			for (int j = 0; j < 6; ++j) // of Mandel's numbers by each other
				answer.tangent(mandel(i), mandel(j)) = (i < 3 ? 1 : std::sqrt(2.)) * (j < 3 ? 1 : std::sqrt(2.)) * tangent[i + 6 * j];
		}
		if (answer.failed || !answer.stress.allFinite()) return answer.failed = true, answer;
		answer.elasticStrain = strainOf(answer.stress, answer.state);
		answer.state.setTensor(stressBefore, answer.stress);
		answer.state.setTensor(strain, Mat3(past + increment));
		return answer;
	}

private:
	std::shared_ptr<const UserLawGiven> given_;

	static constexpr int row(int i) { return i < 3 ? i : i == 5 ? 1 : 0; }
	static constexpr int column(int i) { return i < 3 ? i : i == 3 ? 1 : 2; }
	static constexpr int mandel(int i) { return i < 4 ? i : 9 - i; }

	static void toUmat(const Mat3& tensor, double ofShear, double (&numbers)[6])
	{
		for (int i = 0; i < 6; ++i)
			numbers[i] = (i < 3 ? 1 : ofShear) * tensor(row(i), column(i));
	}
};

/// state1, state2 ...
inline constexpr const char* namesOfStates[] = { "state1",  "state2",  "state3",  "state4",  "state5",  "state6",  "state7",  "state8",  "state9",  "state10",
	                                         "state11", "state12", "state13", "state14", "state15", "state16", "state17", "state18", "state19", "state20" };

template <int Count> constexpr std::array<TensorVariable, Count + 2> UserLaw<Count>::makeVariables()
{
	std::array<TensorVariable, Count + 2> all {};
	all[0] = TensorVariable::tensor("stressBefore", "Pa", "Kirchhoff stress");
	all[1] = TensorVariable::tensor("strain", "-", "strain");
	for (int k = 0; k < Count; ++k)
		all[k + 2] = InternalVariable { namesOfStates[k], "-", "state variable of the law", -anyNumber, anyNumber };
	return all;
}

} // namespace gimpm
