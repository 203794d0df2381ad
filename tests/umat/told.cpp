// SPDX-License-Identifier: GPL-2.0-or-later
// User materials by Abaqus' interface, for the tests. The first is elastic, counts what it is told, and has no answer
// for a material that is not named sand or soil; the second ends the program. Constants of the first: Young's modulus,
// Poisson's ratio, and whether its increments are those of rates times DTIME.
#include <cstdlib>
#include <cstring>

extern "C" void umat_(
        double* stress, double* state, double* tangent, double*, double*, double*, double*, double*, double*, double*, const double*, const double* increment,
        const double* time, const double* duration, const double*, const double*, const double*, const double*, const char* name, const int*, const int*,
        const int*, const int*, const double* properties, const int*, const double*, const double*, double* shorter, const double*, const double*,
        const double*, const int*, const int*, const int*, const int*, const int* step, const int* number, int)
{
	const double E = properties[0], nu = properties[1], lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), G = E / (2 * (1 + nu));
	if (std::strncmp(name, "SAND ", 5) != 0 && std::strncmp(name, "SOIL ", 5) != 0) *shorter = 0.5;
	if (time[1] == 0) state[0] = 0;
	if (*step == 1 && *number == 1) state[1] = 0;
	state[0] += 1, state[1] += 1;
	state[2] = time[1], state[3] = *duration;
	for (int i = 0; i < 6; ++i)
		for (int j = 0; j < 6; ++j) {
			tangent[i + 6 * j] = (i < 3 && j < 3 ? lambda : 0) + (i == j ? (i < 3 ? 2 : 1) * G : 0);
			stress[i] += tangent[i + 6 * j] * (properties[2] != 0 ? increment[j] / *duration * *duration : increment[j]);
		}
}

extern "C" void stops_(
        double*, double*, double*, double*, double*, double*, double*, double*, double*, double*, const double*, const double*, const double*, const double*,
        const double*, const double*, const double*, const double*, const char*, const int*, const int*, const int*, const int*, const double*, const int*,
        const double*, const double*, double*, const double*, const double*, const double*, const int*, const int*, const int*, const int*, const int*,
        const int*, int)
{
	std::exit(0);
}
