// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/mfront.hpp"
#include "core/base/small_matrices.hpp"
#include "core/materials/call_of_others.hpp"
#include <algorithm>

namespace gimpm {
namespace {

using Variable = MfrontGiven::Variable;

void toMfront(const Mat3& tensor, double* numbers)
{
	const Vec6 v = toMandel(tensor);
	for (int i = 0; i < 6; ++i)
		numbers[i] = v[mandelOf(i)];
}
Mat3 fromMfront(const double* numbers)
{
	Vec6 v;
	for (int i = 0; i < 6; ++i)
		v[mandelOf(i)] = numbers[i];
	return fromMandel(v);
}

} // namespace

MfrontDoor::MfrontDoor(MfrontGiven given)
        : UserDoor(
                int(std::count(given.variables.begin(), given.variables.end(), Variable::tensor)),
                int(std::count(given.variables.begin(), given.variables.end(), Variable::scalar)))
        , given_(std::move(given))
{
}

UserState MfrontDoor::first() const
{
	UserState state;
	load(given_.first.data(), state);
	return state;
}

void MfrontDoor::store(const UserState& state, double (&numbers)[mostNumbers]) const
{
	double* next   = numbers;
	int     tensor = 0, scalar = 0;
	for (const Variable variable : given_.variables)
		if (variable == Variable::scalar) *next++ = state.scalars[scalar++];
		else
			toMfront(state.tensors[tensor++], next), next += 6;
}

void MfrontDoor::load(const double* numbers, UserState& state) const
{
	int tensor = 0, scalar = 0;
	for (const Variable variable : given_.variables)
		if (variable == Variable::scalar) state.scalars[scalar++] = *numbers++;
		else
			state.tensors[tensor++] = fromMfront(numbers), numbers += 6;
}

bool MfrontDoor::answer(const UserStep& step, UserState& state, Mat3& stress, Mandel& tangent) const
{
	constexpr double none = 0, consistentTangent = 4;
	double           stiffness[36] = { step.wantsTangent ? consistentTangent : 0 }, timeFactor = 1, speedOfSound = 0, energies[2] = {};
	double           strains[2][6], stresses[2][6], variables[2][mostNumbers];
	char             words[MfrontData::wordsLength] = "";
	toMfront(step.strain, strains[0]), toMfront(Mat3(step.strain + step.increment), strains[1]);
	toMfront(step.stress, stresses[0]), toMfront(step.stress, stresses[1]);
	store(state, variables[0]), store(state, variables[1]);
	MfrontData data { words,
		          step.duration,
		          stiffness,
		          &timeFactor,
		          &speedOfSound,
		          { strains[0], stresses[0], &given_.density, given_.parameters.data(), variables[0], &none, &none, given_.external.data() },
		          { strains[1], stresses[1], &given_.density, given_.parameters.data(), variables[1], energies, energies + 1,
		            given_.external.data() } };
	int        status;
	{
		std::unique_lock<std::mutex> lock;
		if (given_.oneAtATime) lock = std::unique_lock(*given_.oneAtATime);
		const CallOfOthers call(given_.name);
		status = given_.call(&data);
	}
	wordsOfUserLaw() = status < 1 ? words : "";
	if (status < 1) return false;
	load(variables[1], state);
	stress              = fromMfront(stresses[1]);
	const bool isAtRest = step.increment.norm() < 1e-14;
	if (given_.elasticStrain < 0 && isAtRest && (stress - step.stress).norm() > 1e-6 * step.stress.norm())
		wordsOfUserLaw() = "it has no variable ElasticStrain, and forgets the stress with which a step begins";
	for (int i = 0; i < 6; ++i)
		for (int j = 0; j < 6; ++j)
			tangent(mandelOf(i), mandelOf(j)) = stiffness[6 * i + j];
	return true;
}

// Solves by Newton's method, as near as round-off admits; a state with a stress that the law cannot bear is not taken.
void MfrontDoor::bear(const Mat3& stress, UserState& state) const
{
	constexpr int mostSolves = 30;
	if (given_.elasticStrain < 0) return;
	const int tensor  = int(std::count(given_.variables.begin(), given_.variables.begin() + given_.elasticStrain, Variable::tensor));
	UserState bearing = state;
	double    least   = 1e-9 * stress.norm();
	for (int solve = 0; solve < mostSolves; ++solve) {
		UserState after = bearing;
		Mat3      found;
		Mandel    tangent;
		if (!answer({ stress, Mat3::Zero(), Mat3::Zero(), 0, true }, after, found, tangent)) return;
		const Mat3 difference = stress - found;
		if (difference.norm() <= least) state = bearing, least = difference.norm();
		if (difference.norm() <= 1e-14 * stress.norm()) return;
		const Vec6 change = solutionOf(tangent, toMandel(difference));
		if (!change.allFinite()) return;
		bearing.tensors[tensor] += fromMandel(change);
	}
}

} // namespace gimpm
