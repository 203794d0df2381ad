// SPDX-License-Identifier: GPL-2.0-or-later
// The interface of Abaqus' user materials (UMAT), for which many laws have been written.
#pragma once

namespace gimpm {

/// Fortran hands all arguments on by address. Tensors are xx, yy, zz, xy, xz, yz, strains with twice the shear
/// components, stress positive in tension; `tangent` is column by column.
using Umat = void (*)(
        double* stress, double* state, double* tangent, double* elasticEnergy, double* plasticWork, double* creepWork, double* heat, double* byTemperature,
        double* heatByStrain, double* heatByTemperature, const double* strain, const double* increment, const double* time, const double* duration,
        const double* temperature, const double* warming, const double* fields, const double* fieldIncrements, const char* name, const int* direct,
        const int* shears, const int* components, const int* states, const double* properties, const int* countOfProperties, const double* place,
        const double* turn, double* shorter, const double* size, const double* gradientBefore, const double* gradient, const int* element, const int* point,
        const int* layer, const int* section, const int* step, const int* increments, int lengthOfName);

} // namespace gimpm
