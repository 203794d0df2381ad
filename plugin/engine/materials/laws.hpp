// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Queries to the laws of material classes (engine/materials/law_of_class.hpp pairs them).
#include "core/materials/material.hpp"
#include "engine/materials/parameters.hpp"

namespace yade {

// std::invalid_argument if the material's values are not admissible or its class has no law.
gimpm::Material coreMaterial(const MpmMaterial&);

// Parameters of the class of the material that may differ from point to point, in the order of its law; none for other
// classes.
const vector<ParameterOfClass>& parametersOf(const MpmMaterial&);

// Copy of the same class and with the same values. The class has a law.
shared_ptr<MpmMaterial> copyOf(const MpmMaterial&);

// True if nothing flows under any load, and true if a factor of safety can divide the strength; false for classes
// without a law.
bool isElastic(const MpmMaterial&);
bool canBeWeakened(const MpmMaterial&);

// The internal variables of its law with their values at first, whether the material is admissible or not; none for
// other classes.
vector<std::pair<const gimpm::InternalVariable*, Real>> initialInternalsOf(const MpmMaterial&);

// Between Kirchhoff stress [Pa] and elastic logarithmic strain of a point at rest with these internal variables, in the
// order of its law. std::invalid_argument if that state lies outside of the law's yield surface.
Matrix3r kirchhoffStressOf(const gimpm::Material&, const Matrix3r& elasticStrain, const vector<Real>& internals);
Matrix3r elasticStrainOf(const gimpm::Material&, const Matrix3r& kirchhoffStress, const vector<Real>& internals);

// Internal variables that bear a stress [Pa] at least, in the order of the law, for laws whose history follows from a
// stress; for others as they are.
vector<Real> internalsBearing(const gimpm::Law&, const Matrix3r& kirchhoffStress, const vector<Real>& internals);

// For mpm.respond: one call of the law in principal axes, with a dict of internal variables by name where they are not
// those at first. Returns a dict of tuples with what the law answers, and the internal variables. std::invalid_argument
// where it has no answer, or for a variable that it does not have.
py::dict respondForPython(const shared_ptr<MpmMaterial>&, const Vector3r& trialStrain, const py::dict& internals);

// The same of a tensor law, for a strain, the increment of strain in the step, and its time: tensors by their rows, and
// the tangent by Mandel's six numbers. And for mpm.elementTest the state after an increment of the deformation
// gradient, with the rates of the stress by the nine velocity gradients.
bool     hasTensorLaw(const shared_ptr<MpmMaterial>&);
py::dict respondInSpaceForPython(
        const shared_ptr<MpmMaterial>&, const vector<Real>& trialStrain, const vector<Real>& increment, const py::dict& internals, Real duration);
py::dict stepInSpaceForPython(
        const shared_ptr<MpmMaterial>&, const vector<Real>& elasticStrain, const vector<Real>& increment, const py::dict& internals, Real duration);

// The internal variables of a point that bears principal Kirchhoff stresses [Pa], by name: those given, and of laws
// whose history follows from a stress what is needed of the others.
py::dict bearingForPython(const shared_ptr<MpmMaterial>&, const Vector3r& kirchhoffStress, const py::dict& internals);

// For mpm.elementTest: principal elastic strains of principal Kirchhoff stresses [Pa]; std::invalid_argument beyond
// yield.
py::tuple elasticStrainForPython(const shared_ptr<MpmMaterial>&, const Vector3r& kirchhoffStress, const py::dict& internals);

} // namespace yade
