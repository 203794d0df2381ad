// SPDX-License-Identifier: GPL-2.0-or-later
// Laws with the names and the function that MFront's generic interface gives them, written by hand, of the tests:
// elasticity of which one shear stress goes with the dilation, von Mises' law by its elastic strain, and laws that are
// refused.
#include <cmath>
#include <cstring>

namespace {

struct State {
	const double *strain, *stress;
	const double *density, *properties, *variables, *stored, *dissipated, *external;
};
struct Data {
	char*   words;
	double  dt;
	double *K, *rdt, *speed;
	State   s0, s1;

	double* stress() const { return const_cast<double*>(s1.stress); }
	double* variables() const { return const_cast<double*>(s1.variables); }
};

/// Entry of K I + 2 G (...), row by row.
double elastic(int i, int j, double K, double G) { return (i == j ? 2 * G : 0) + (i < 3 && j < 3 ? K - 2. / 3 * G : 0); }

int failed(const Data& d, const char* why) { return std::strncpy(d.words, why, 511), -1; }

} // namespace

extern "C" int Elastic_Tridimensional(Data* d)
{
	const double E = d->s1.properties[0], nu = d->s1.properties[1], skew = d->s1.properties[2], K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));
	double       dilation = 0;
	for (int i = 0; i < 3; ++i)
		dilation += d->s1.strain[i];
	if (std::abs(dilation) > .5) return failed(*d, "the strain is too large");
	if (d->s0.external[0] != 293.15) return failed(*d, "it is too cold");
	const bool wantsTangent = d->K[0] > 3.5;
	for (int i = 0; i < 6; ++i) {
		d->stress()[i] = i == 4 ? skew * dilation : 0;
		for (int j = 0; j < 6; ++j) {
			const double slope = elastic(i, j, K, G) + (i == 4 && j < 3 ? skew : 0);
			d->stress()[i] += (slope - (i == 4 && j < 3 ? skew : 0)) * d->s1.strain[j];
			if (wantsTangent) d->K[6 * i + j] = slope;
		}
	}
	return 1;
}

/// Variables: equivalent plastic strain, elastic strain. Properties: yield stress in tension, and the two of elasticity
/// before it.
extern "C" int VonMises_Tridimensional(Data* d)
{
	const double E = d->s1.properties[0], nu = d->s1.properties[1], limit = d->s1.properties[2], K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));
	double       strain[6], deviator[6], dilation = 0, size = 0;
	for (int i = 0; i < 6; ++i)
		strain[i] = d->s0.variables[1 + i] + d->s1.strain[i] - d->s0.strain[i];
	for (int i = 0; i < 3; ++i)
		dilation += strain[i];
	for (int i = 0; i < 6; ++i)
		deviator[i] = strain[i] - (i < 3 ? dilation / 3 : 0), size += deviator[i] * deviator[i];
	size               = std::sqrt(size);
	const double yield = std::sqrt(2. / 3) * limit / (2 * G);
	if (size > 1e3 * yield) return 0;
	const bool   wantsTangent = d->K[0] > 3.5, flows = size > yield;
	const double part = flows ? yield / size : 1;
	for (int i = 0; i < 6; ++i) {
		d->variables()[1 + i] = part * deviator[i] + (i < 3 ? dilation / 3 : 0);
		d->stress()[i]        = 2 * G * part * deviator[i] + (i < 3 ? K * dilation : 0);
		for (int j = 0; j < 6 && wantsTangent; ++j)
			d->K[6 * i + j] = elastic(i, j, K, G * part) - (flows ? 2 * G * part * deviator[i] * deviator[j] / (size * size) : 0);
	}
	d->variables()[0] = d->s0.variables[0] + std::sqrt(2. / 3) * (1 - part) * size;
	return 1;
}

#define DECLARE(law, interface, version, type, symmetry, hypothesis, external)                                                                                 \
	extern "C" {                                                                                                                                           \
	const char*    law##_mfront_interface                             = interface;                                                                         \
	const char*    law##_tfel_version                                 = version;                                                                           \
	const char*    law##_unit_system                                  = "";                                                                                \
	unsigned short law##_BehaviourType                                = type;                                                                              \
	unsigned short law##_BehaviourKinematic                           = type == 1 ? 1 : 3;                                                                 \
	unsigned short law##_SymmetryType                                 = symmetry;                                                                          \
	unsigned short law##_nModellingHypotheses                         = 1;                                                                                 \
	const char*    law##_ModellingHypotheses[]                        = { hypothesis };                                                                    \
	unsigned short law##_nGradients                                   = 1;                                                                                 \
	const char*    law##_Gradients[]                                  = { type == 1 ? "Strain" : "DeformationGradient" };                                  \
	unsigned short law##_nThermodynamicForces                         = 1;                                                                                 \
	const char*    law##_ThermodynamicForces[]                        = { "Stress" };                                                                      \
	unsigned short law##_TemperatureRemovedFromExternalStateVariables = 1;                                                                                 \
	unsigned short law##_nExternalStateVariables                      = external[0] != 0;                                                                  \
	const char*    law##_ExternalStateVariables[]                     = { external };                                                                      \
	}

DECLARE(Elastic, "Generic", "4.2.0", 1, 0, "Tridimensional", "")
DECLARE(VonMises, "Generic", "5.0.1", 1, 0, "Tridimensional", "")
DECLARE(Old, "Generic", "3.4.3", 1, 0, "Tridimensional", "")
DECLARE(Finite, "Generic", "4.2.0", 2, 0, "Tridimensional", "")
DECLARE(Layered, "Generic", "4.2.0", 1, 1, "Tridimensional", "")
DECLARE(Plane, "Generic", "4.2.0", 1, 0, "PlaneStrain", "")
DECLARE(Wet, "Generic", "4.2.0", 1, 0, "Tridimensional", "Humidity")
DECLARE(Directed, "Generic", "4.2.0", 1, 0, "Tridimensional", "")
DECLARE(Elsewhere, "Castem", "4.2.0", 1, 0, "Tridimensional", "")

extern "C" {
// The elastic ones of VonMises are not in its list: MFront has them in front of it.
unsigned short     VonMises_requiresStiffnessTensor                      = 1;
unsigned short     VonMises_nMaterialProperties                          = 1;
const char*        VonMises_MaterialProperties[]                         = { "YieldStress" };
unsigned short     VonMises_Tridimensional_nInternalStateVariables       = 2;
const char*        VonMises_Tridimensional_InternalStateVariables[]      = { "EquivalentPlasticStrain", "ElasticStrain" };
int                VonMises_Tridimensional_InternalStateVariablesTypes[] = { 0, 1 };
unsigned short     Elastic_requiresStiffnessTensor                       = 0;
unsigned short     Elastic_nMaterialProperties                           = 3;
const char*        Elastic_MaterialProperties[]                          = { "YoungModulus", "PoissonRatio", "Skew" };
unsigned short     Elastic_nInternalStateVariables                       = 0;
const char* const* Elastic_InternalStateVariables                        = nullptr;
const int*         Elastic_InternalStateVariablesTypes                   = nullptr;
unsigned short     Directed_nInternalStateVariables                      = 1;
const char*        Directed_InternalStateVariables[]                     = { "Axis" };
int                Directed_InternalStateVariablesTypes[]                = { 2 };
}
