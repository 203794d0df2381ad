// SPDX-License-Identifier: GPL-2.0-or-later
// The interface of Abaqus' user materials (UMAT), for which many laws have been written.
#pragma once
#include "core/materials/user_law.hpp"
#include <mutex>

namespace gimpm {

/// Fortran hands all arguments on by address. Tensors are xx, yy, zz, xy, xz, yz, strains with twice the shear
/// components, stress positive in tension; `tangent` is column by column.
using Umat = void (*)(
        double* stress, double* state, double* tangent, double* elasticEnergy, double* plasticWork, double* creepWork, double* heat, double* byTemperature,
        double* heatByStrain, double* heatByTemperature, const double* strain, const double* increment, const double* time, const double* duration,
        const double* temperature, const double* warming, const double* fields, const double* fieldIncrements, const char* name, const int* direct,
        const int* shears, const int* components, const int* states, const double* properties, const int* countOfProperties, const double* position,
        const double* turn, double* shorter, const double* size, const double* gradientBefore, const double* gradient, const int* element, const int* point,
        const int* layer, const int* section, const int* step, const int* increments, int lengthOfName);

/// State variables, by the number of their first from 0, that are symmetric tensors: six numbers that turn with the
/// material. Those like strains have twice the shear components.
struct UmatTensors {
	std::vector<int> likeStress, likeStrain;
};

class UmatDoor : public UserDoor {
public:
	/// `first`: values of its state variables. `oneAtATime`, if any, lets only one thread call it at a time.
	/// `material`: name that it is told; `function`: name for the message where it ends the program.
	UmatDoor(
	        Umat call, const std::vector<double>& parameters, const std::vector<double>& first, std::shared_ptr<std::mutex> oneAtATime,
	        const std::string& material = "", std::string function = "umat_", const UmatTensors& tensors = {});

	UserState first() const override;

	/// Abaqus hands over no DTIME of 0, by which laws of rates divide: where no time goes by it is 1.
	double toldOf(double duration) const override { return duration > 0 ? duration : 1; }
	bool   answer(const UserStep&, UserState&, Mat3& stress, Mandel& tangent) const override;

private:
	Umat                call_;
	std::vector<double> parameters_; ///< and behind them numbers that are none, for a law that reads more
	int                 count_;      ///< number of parameters
	std::vector<double> first_;      ///< all state variables at first
	struct Tensor {
		int    begin;
		double ofShear; ///< what is given over the shear component
	};
	std::vector<Tensor>         tensors_; ///< in the order of the state variables
	std::shared_ptr<std::mutex> oneAtATime_;
	std::array<char, 80>        material_; ///< CMNAME: capital letters, and blanks behind them
	std::string                 function_;

	static constexpr int mostNumbers = UserState::mostScalars + UserState::beyond;

	void store(const UserState&, double (&numbers)[mostNumbers]) const;
	void load(const double* numbers, UserState&) const;
};

} // namespace gimpm
