// SPDX-License-Identifier: GPL-2.0-or-later
// A user material by Abaqus' interface, of the tests: elasticity and von Mises' perfect plasticity, with the equivalent
// plastic strain as its state variable. Constants: Young's modulus, Poisson's ratio, limit of sqrt(2 J2), and what its
// tangent is multiplied by, which should be 1.
#include <cmath>

extern "C" void umat_(
        double* stress, double* state, double* tangent, double*, double*, double*, double*, double*, double*, double*, const double*, const double* increment,
        const double*, const double*, const double*, const double*, const double*, const double*, const char*, const int*, const int*, const int*, const int*,
        const double* properties, const int*, const double*, const double*, double* shorter, const double*, const double*, const double*, const int*,
        const int*, const int*, const int*, const int*, const int*, int)
{
	const double E = properties[0], nu = properties[1], yield = properties[2], K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));
	const double volumetric = increment[0] + increment[1] + increment[2];
	double       length = 0, mean = 0, deviator[6];
	for (int i = 0; i < 6; ++i)
		stress[i] += i < 3 ? K * volumetric + 2 * G * (increment[i] - volumetric / 3) : G * increment[i];
	for (int i = 0; i < 3; ++i)
		mean += stress[i] / 3;
	for (int i = 0; i < 6; ++i) {
		deviator[i] = stress[i] - (i < 3 ? mean : 0);
		length += (i < 3 ? 1 : 2) * deviator[i] * deviator[i];
	}
	length             = std::sqrt(length);
	const bool   flows = length > yield * (1 + 1e-9);
	const double part  = flows ? yield / length : 1;
	if (length > 1e3 * yield) *shorter = .5;
	for (int i = 0; i < 6; ++i) {
		if (flows) stress[i] = part * deviator[i] + (i < 3 ? mean : 0);
		for (int j = 0; j < 6; ++j) {
			const double same = i == j ? (i < 3 ? 2 : 1) * G * part : 0, both = i < 3 && j < 3 ? K - 2. / 3 * G * part : 0;
			tangent[i + 6 * j] = properties[3] * (same + both - (flows ? 2 * G * part * deviator[i] * deviator[j] / (length * length) : 0));
		}
	}
	state[0] += std::sqrt(2. / 3) * (1 - part) * length / (2 * G);
}
