// SPDX-License-Identifier: GPL-2.0-or-later
// The generic interface of MFront, as it is from version 4.0 on: laws of small strain in space.
#pragma once
#include "core/materials/user_law.hpp"
#include <mutex>

namespace gimpm {

/// Arguments of a law's function; the order of the members is that of the interface. Symmetric tensors are xx, yy, zz
/// and sqrt(2) times xy, xz, yz; matrices are row by row.
struct MfrontData {
	/// `Number` is const in the state at the beginning.
	template <class Number> struct State {
		const double* gradients; ///< strain
		Number*       forces;    ///< stress
		const double* density;
		const double* parameters;
		Number*       variables; ///< internal ones
		Number*       storedEnergy;
		Number*       dissipatedEnergy;
		const double* external; ///< external variables, as the temperature
	};

	static constexpr std::size_t wordsLength = 512;

	char*               words; ///< room for what it says of a failure
	double              duration;
	double*             stiffness;  ///< 36 numbers, of which the first one says before the call which one is wanted
	double*             timeFactor; ///< factor of the next step; below 1 a shorter one is asked for
	double*             speedOfSound;
	State<const double> before;
	State<double>       after;
};

/// Answers -1 where it has no answer, 0 where it does not rely on it, and 1.
using Mfront = int (*)(MfrontData*);

/// Description of a law besides its function. Internal variables in its order.
struct MfrontGiven {
	enum class Variable { scalar, tensor };

	Mfront                      call = nullptr;
	std::vector<double>         parameters;
	std::vector<Variable>       variables;
	std::vector<double>         first;                ///< their values, six numbers of a tensor
	int                         elasticStrain = -1;   ///< number of the variable by which the law goes; -1: none
	std::vector<double>         external;             ///< values of the external variables
	double                      density    = 0;       ///< [kg/m3]
	std::shared_ptr<std::mutex> oneAtATime = nullptr; ///< if any, lets only one thread call it at a time
	std::string                 name {};              ///< for the message where it ends the program
};

class MfrontDoor : public UserDoor {
public:
	explicit MfrontDoor(MfrontGiven given);

	UserState first() const override;
	bool      answer(const UserStep&, UserState&, Mat3& stress, Mandel& tangent) const override;
	void      bear(const Mat3& stress, UserState&) const override;

private:
	MfrontGiven given_;

	static constexpr int mostNumbers = 6 * UserState::mostTensors + UserState::mostScalars;

	void store(const UserState&, double (&numbers)[mostNumbers]) const;
	void load(const double* numbers, UserState&) const;
};

} // namespace gimpm
