// SPDX-License-Identifier: GPL-2.0-or-later
// Stiffness of the soil in a cell: the measure of what stabilises or holds it.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include <functional>

namespace gimpm {

/// Current volume [m3] and Young's modulus [Pa] of a point of the cloud.
struct VolumeAndModulus {
	double volume, modulus;
};
using PointStiffness = std::function<VolumeAndModulus(int point)>;

/// Young's moduli of the populated leaves that are asked for, by number, zero for the others: the means of their
/// points, weighted by the volumes of the overlaps.
template <int Dim>
std::vector<double> cellModuli(const std::vector<char>& isAskedFor, const CloudBasis<Dim>&, const PointStiffness& stiffnessOf, const Grid<Dim>&);

} // namespace gimpm
