// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/umat.hpp"
#include "core/materials/call_of_others.hpp"
#include <algorithm>
#include <cctype>
#include <limits>

namespace gimpm {
namespace {

constexpr int rowOf(int i) { return i < 3 ? i : i == 5 ? 1 : 0; }
constexpr int columnOf(int i) { return i < 3 ? i : i == 3 ? 1 : 2; }

void toUmat(const Mat3& tensor, double ofShear, double* numbers)
{
	for (int i = 0; i < 6; ++i)
		numbers[i] = (i < 3 ? 1 : ofShear) * tensor(rowOf(i), columnOf(i));
}

Mat3 fromUmat(const double* numbers, double ofShear)
{
	Mat3 tensor;
	for (int i = 0; i < 6; ++i)
		tensor(rowOf(i), columnOf(i)) = tensor(columnOf(i), rowOf(i)) = numbers[i] / (i < 3 ? 1 : ofShear);
	return tensor;
}

} // namespace

UmatDoor::UmatDoor(
        Umat call, const std::vector<double>& parameters, const std::vector<double>& first, std::shared_ptr<std::mutex> oneAtATime, const std::string& material,
        std::string function, const UmatTensors& tensors)
        : UserDoor(
                int(tensors.likeStress.size() + tensors.likeStrain.size()), int(first.size()) - 6 * int(tensors.likeStress.size() + tensors.likeStrain.size()))
        , call_(call)
        , parameters_(parameters)
        , count_(int(parameters.size()))
        , first_(first)
        , oneAtATime_(std::move(oneAtATime))
        , function_(std::move(function))
{
	material_.fill(' ');
	const std::size_t length = std::min(material.size(), material_.size());
	std::transform(material.begin(), material.begin() + length, material_.begin(), [](unsigned char c) { return char(std::toupper(c)); });
	parameters_.resize(parameters.size() + UserState::beyond, std::numeric_limits<double>::quiet_NaN());
	for (const int begin : tensors.likeStress)
		tensors_.push_back({ begin, 1 });
	for (const int begin : tensors.likeStrain)
		tensors_.push_back({ begin, 2 });
	std::sort(tensors_.begin(), tensors_.end(), [](const Tensor& a, const Tensor& b) { return a.begin < b.begin; });
}

UserState UmatDoor::first() const
{
	UserState state;
	load(first_.data(), state);
	return state;
}

void UmatDoor::store(const UserState& state, double (&numbers)[mostNumbers]) const
{
	const int count  = int(first_.size());
	int       scalar = 0, tensor = 0;
	for (int k = 0; k < count;)
		if (tensor < tensors() && tensors_[tensor].begin == k) {
			toUmat(state.tensors[tensor], tensors_[tensor].ofShear, numbers + k);
			++tensor, k += 6;
		} else
			numbers[k++] = state.scalars[scalar++];
	std::fill(numbers + count, numbers + mostNumbers, std::numeric_limits<double>::quiet_NaN());
}

void UmatDoor::load(const double* numbers, UserState& state) const
{
	const int count  = int(first_.size());
	int       scalar = 0, tensor = 0;
	for (int k = 0; k < count;)
		if (tensor < tensors() && tensors_[tensor].begin == k) {
			state.tensors[tensor] = fromUmat(numbers + k, tensors_[tensor].ofShear);
			++tensor, k += 6;
		} else
			state.scalars[scalar++] = numbers[k++];
}

bool UmatDoor::answer(const UserStep& step, UserState& state, Mat3& stress, Mandel& tangent) const
{
	// Not known here: temperatures, fields, positions, and the numbers of elements and steps.
	constexpr double still[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, position[3] = {}, none = 0, size = 1;
	constexpr int    direct = 3, shears = 3, components = 6, one = 1;
	const double     time[2] = { step.time, step.time };
	const int        states = int(first_.size()), number = step.increments + 1;
	double           energy[3] = {}, heat = 0, byTemperature[6] = {}, heatByStrain[6] = {}, heatByTemperature = 0, shorter = 1;
	double           t[6], strain[6], increment[6], stiffness[36] = {}, variables[mostNumbers];
	toUmat(step.stress, 1, t), toUmat(step.strain, 2, strain), toUmat(step.increment, 2, increment), store(state, variables);
	{
		std::unique_lock<std::mutex> lock;
		if (oneAtATime_) lock = std::unique_lock(*oneAtATime_);
		const CallOfOthers call(function_);
		call_(t, variables, stiffness, energy, energy + 1, energy + 2, &heat, byTemperature, heatByStrain, &heatByTemperature, strain, increment, time,
		      &step.duration, &none, &none, &none, &none, material_.data(), &direct, &shears, &components, &states, parameters_.data(), &count_,
		      position, still, &shorter, &size, still, still, &one, &one, &one, &one, &one, &number, int(material_.size()));
	}
	load(variables, state);
	for (int i = 0; i < 6; ++i) {
		stress(rowOf(i), columnOf(i)) = stress(columnOf(i), rowOf(i)) = t[i];
		for (int j = 0; j < 6; ++j) // derivatives of Mandel's numbers by each other
			tangent(mandelOf(i), mandelOf(j)) = (i < 3 ? 1 : std::sqrt(2.)) * (j < 3 ? 1 : std::sqrt(2.)) * stiffness[i + 6 * j];
	}
	return shorter >= 1;
}

} // namespace gimpm
