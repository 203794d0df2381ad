// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The table that pairs the material classes with the core's constitutive laws.
#include "core/materials/law.hpp"
#include "engine/materials/parameters.hpp"

namespace yade {

// std::invalid_argument if the material's values are not admissible or its class has no law.
gimpm::Material coreMaterial(const MpmMaterial&);

// Of the class of the material: what may differ from point to point, in the order of its law; none for other classes.
const vector<ParameterOfClass>& parametersOf(const MpmMaterial&);

// Of the same class and with the same values. The class has a law.
shared_ptr<MpmMaterial> copyOf(const MpmMaterial&);

// Of the law that belongs to the class of the material; none for other classes.
vector<gimpm::InternalVariable> variablesOf(const MpmMaterial&);

// Their values at first, whether the material is admissible or not.
vector<Real> initialInternalsOf(const MpmMaterial&);

// Between Kirchhoff stress [Pa] and elastic logarithmic strain of a point at rest with these internal variables, in the order of its law.
// std::invalid_argument if that state lies outside of the law's yield surface.
Matrix3r kirchhoffStressOf(const gimpm::Material&, const Matrix3r& elasticStrain, const vector<Real>& internals);
Matrix3r elasticStrainOf(const gimpm::Material&, const Matrix3r& kirchhoffStress, const vector<Real>& internals);

// For mpm.respond: one call of the law in principal axes, with a dict of internal variables by name where they are not those at first. Returns a dict of
// tuples with what the law answers, and the internal variables. std::invalid_argument where it has no answer, or for a variable that it does not have.
py::dict respondForPython(const shared_ptr<MpmMaterial>&, const Vector3r& trialStrain, const py::dict& internals);

// For mpm.elementTest: principal elastic strains of principal Kirchhoff stresses [Pa]; std::invalid_argument beyond yield.
py::tuple elasticStrainForPython(const shared_ptr<MpmMaterial>&, const Vector3r& kirchhoffStress, const py::dict& internals);

} // namespace yade
