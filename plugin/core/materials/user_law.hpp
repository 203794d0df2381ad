// SPDX-License-Identifier: GPL-2.0-or-later
// Other people's laws, behind an interface (umat.hpp, mfront.hpp in this folder). They know a stress that grows with
// increments of strain, and no elastic strain, or one that is theirs. That of the framework is the strain that the
// stress has with an elastic stiffness of reference, so that the increment is the trial strain less the one before;
// whatever that stiffness is.
#pragma once
#include "core/materials/tensor_law.hpp"
#include <memory>
#include <string>

namespace gimpm {

/// The row of Mandel's notation that such a law's i-th component has: their last two are in another order.
constexpr int mandelOf(int i) { return i < 4 ? i : 9 - i; }

/// Internal variables of such a law at a point: tensors, which turn with the material, and scalars.
struct UserState {
	static constexpr int mostTensors = 6, mostScalars = 40;
	/// A law that takes more parameters or scalars than there are has no finite answer then, and harms nothing.
	static constexpr int beyond = 64;

	std::array<Mat3, mostTensors>            tensors; ///< tensors of the history, as many as the law has
	std::array<double, mostScalars + beyond> scalars; ///< behind those of the law are numbers that are none

	UserState()
	{
		tensors.fill(Mat3::Zero());
		scalars.fill(std::numeric_limits<double>::quiet_NaN());
	}
};

/// Input of such a law.
struct UserStep {
	Mat3   stress, strain; ///< Kirchhoff stress [Pa] and logarithmic strain as the step begins
	Mat3   increment;      ///< increment of the strain
	double duration;
	bool   wantsTangent;
	double time       = 0; ///< time that the point has gone through as the step begins, in the time of the loads
	int    increments = 0; ///< steps that it has gone through
};

/// One material's law, with its parameters.
class UserDoor {
public:
	Hencky elastic { 1, 0 }; ///< elasticity of reference

	explicit UserDoor(int tensors, int scalars) : tensors_(tensors), scalars_(scalars) { }
	virtual ~UserDoor() = default;

	int tensors() const { return tensors_; }
	int scalars() const { return scalars_; }

	virtual UserState first() const = 0; ///< state of a point that nothing has happened to

	/// Duration that the law is told of a step.
	virtual double toldOf(double duration) const { return duration; }

	/// One call: the state becomes that at the end of the step. False where the law asks for a shorter step.
	virtual bool answer(const UserStep&, UserState&, Mat3& stress, Mandel& tangent) const = 0;

	/// Changes the state so that the law has the stress [Pa], if it goes by its state.
	virtual void bear(const Mat3& /*stress*/, UserState&) const { }

private:
	int tensors_, scalars_;
};

/// Text of the last law of this thread that had no answer; empty: none.
std::string& wordsOfUserLaw();

/// User law with room for so many tensors and scalars.
template <int Tensors, int Scalars> class UserLaw : public TensorLaw {
	static constexpr int                                                   ofAll = 4; // variables that all such laws have
	static constexpr std::array<TensorVariable, ofAll + Tensors + Scalars> makeVariables();

public:
	explicit UserLaw(std::shared_ptr<const UserDoor> door) : door_(std::move(door)) { }

	enum {
		stressBefore,
		strain,
		time,
		increments,
		tensor1,
		state1 = tensor1 + Tensors
	}; ///< the variables, by number; behind them the other state variables
	static constexpr std::array<TensorVariable, ofAll + Tensors + Scalars> variables = makeVariables();
	static constexpr bool                                                  mayFail = true, isElastic = false, isLinear = true, canBeWeakened = false;

	TensorState initialInternals() const
	{
		TensorState state(variables);
		store(door_->first(), state);
		return state;
	}

	using Parameters = std::array<double, 0>;
	Parameters parameters() const { return {}; }
	UserLaw    with(const Parameters&) const { return *this; }
	Parameters weakened(const Weakening&) const { return {}; }
	bool       isSymmetric() const { return false; }
	double     young(const TensorState&) const { return door_->elastic.young(); }

	TensorState bearing(const Mat3& stress, TensorState state) const
	{
		UserState own = stateOf(state);
		door_->bear(stress, own);
		store(own, state);
		state.setTensor(stressBefore, stress);
		return state;
	}
	Mat3 strainOf(const Mat3& stress, const TensorState&) const
	{
		const double mean = stress.trace() / 3;
		return (stress - mean * Mat3::Identity()) / (2 * door_->elastic.shear()) + mean / (3 * door_->elastic.bulk()) * Mat3::Identity();
	}

	/// The law is not called: without strain and time it need not have an answer.
	Mat3 present(const TensorStep& step) const { return step.state.tensor(stressBefore); }

	TensorAnswer respond(const TensorStep& step) const
	{
		const Mat3 before = step.state.tensor(stressBefore), past = step.state.tensor(strain),
		           increment = step.trialStrain - strainOf(before, step.state);
		TensorAnswer answer(step.state);
		UserState    own      = stateOf(step.state);
		const double duration = door_->toldOf(step.duration), begin = step.state.scalar(time), count = step.state.scalar(increments);
		answer.failed = !door_->answer({ before, past, increment, duration, step.wantsTangent, begin, int(count) }, own, answer.stress, answer.tangent);
		if (answer.failed || !answer.stress.allFinite()) return answer.failed = true, answer;
		store(own, answer.state);
		answer.elasticStrain = strainOf(answer.stress, answer.state);
		answer.state.setTensor(stressBefore, answer.stress);
		answer.state.setTensor(strain, Mat3(past + increment));
		answer.state.scalar(time)       = begin + duration;
		answer.state.scalar(increments) = count + 1;
		return answer;
	}

private:
	std::shared_ptr<const UserDoor> door_;

	UserState stateOf(const TensorState& state) const
	{
		UserState own;
		for (int k = 0; k < door_->tensors(); ++k)
			own.tensors[k] = state.tensor(tensor1 + k);
		for (int k = 0; k < door_->scalars(); ++k)
			own.scalars[k] = state.scalar(state1 + k);
		return own;
	}
	void store(const UserState& own, TensorState& state) const
	{
		for (int k = 0; k < door_->tensors(); ++k)
			state.setTensor(tensor1 + k, own.tensors[k]);
		for (int k = 0; k < door_->scalars(); ++k)
			state.scalar(state1 + k) = own.scalars[k];
	}
};

inline constexpr const char* namesOfTensors[UserState::mostTensors]
        = { "stateTensor1", "stateTensor2", "stateTensor3", "stateTensor4", "stateTensor5", "stateTensor6" };
inline constexpr const char* namesOfStates[UserState::mostScalars]
        = { "state1",  "state2",  "state3",  "state4",  "state5",  "state6",  "state7",  "state8",  "state9",  "state10",
	    "state11", "state12", "state13", "state14", "state15", "state16", "state17", "state18", "state19", "state20",
	    "state21", "state22", "state23", "state24", "state25", "state26", "state27", "state28", "state29", "state30",
	    "state31", "state32", "state33", "state34", "state35", "state36", "state37", "state38", "state39", "state40" };

template <int Tensors, int Scalars>
constexpr std::array<TensorVariable, UserLaw<Tensors, Scalars>::ofAll + Tensors + Scalars> UserLaw<Tensors, Scalars>::makeVariables()
{
	std::array<TensorVariable, ofAll + Tensors + Scalars> all {};
	all[stressBefore] = TensorVariable::tensor("stressBefore", "Pa", "Kirchhoff stress");
	all[strain]       = TensorVariable::tensor("strain", "-", "strain");
	all[time]         = InternalVariable { "lawTime", "s", "time that a user material has gone through", 0, anyNumber };
	all[increments]   = InternalVariable { "lawIncrements", "-", "steps that a user material has gone through", 0, anyNumber };
	for (int k = 0; k < Tensors; ++k)
		all[tensor1 + k] = TensorVariable::tensor(namesOfTensors[k], "-", "state variable of the law");
	for (int k = 0; k < Scalars; ++k)
		all[state1 + k] = InternalVariable { namesOfStates[k], "-", "state variable of the law", -anyNumber, anyNumber };
	return all;
}

} // namespace gimpm
