// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/user_law.hpp"
#include <cstring>

namespace gimpm {

bool callUmat(
        const UserLawGiven& given, double (&stress)[6], double* state, int states, double (&tangent)[36], const double (&strain)[6],
        const double (&increment)[6], double duration)
{
	// What is no part of this interface here: temperatures, fields, places, and the names of elements and steps.
	constexpr double still[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, place[3] = {}, none = 0, time[2] = {}, size = 1;
	constexpr int    direct = 3, shears = 3, components = 6, one = 1;
	char             name[80];
	std::memset(name, ' ', sizeof name);
	const int countOfProperties = int(given.properties.size() - UserLawGiven::beyond);
	double    energy[3] = {}, heat = 0, byTemperature[6] = {}, heatByStrain[6] = {}, heatByTemperature = 0, shorter = 1;

	std::unique_lock<std::mutex> lock;
	if (given.oneAtATime) lock = std::unique_lock(*given.oneAtATime);
	given.call(
	        stress, state, tangent, energy, energy + 1, energy + 2, &heat, byTemperature, heatByStrain, &heatByTemperature, strain, increment, time,
	        &duration, &none, &none, &none, &none, name, &direct, &shears, &components, &states, given.properties.data(), &countOfProperties, place, still,
	        &shorter, &size, still, still, &one, &one, &one, &one, &one, &one, int(sizeof name));
	return shorter >= 1;
}

} // namespace gimpm
