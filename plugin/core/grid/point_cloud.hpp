// SPDX-License-Identifier: GPL-2.0-or-later
// Material points as structure of arrays; all arrays have the same length.
#pragma once
#include "core/base/types.hpp"
#include <Eigen/LU>
#include <vector>

namespace gimpm {

template <int Dim> struct PointCloud {
	std::vector<Vec<Dim>>       position;      ///< [m]
	std::vector<Vec<Dim>>       position0;     ///< where the points were at first [m]; empty: they are there still, or no boundary moves nodes
	std::vector<Vec<Dim>>       halfSize;      ///< current half lengths of the domains [m], at most half a cell
	std::vector<Vec<Dim>>       halfSize0;     ///< initial half lengths [m]
	std::vector<double>         volume0;       ///< initial volume [m3], per metre of thickness in plane strain, of the whole ring around an axis
	std::vector<Mat<Dim>>       defGrad;       ///< deformation gradient
	std::vector<double>         hoopStretch;   ///< around an axis of symmetry, beside the deformation gradient; else empty
	std::vector<SymTensor<Dim>> elasticStrain; ///< logarithmic
	std::vector<SymTensor<Dim>> stress;        ///< Cauchy stress [Pa], a result
	InternalColumns             internals;     ///< internal variables of the laws
	ParameterColumns            parameters;    ///< of the laws of points that have their own
	std::vector<Vec<Dim>>       force;         ///< point load at load factor 1 [N]; empty: no point loads
	std::vector<int>            material;      ///< position in the list of materials

	std::size_t size() const { return position.size(); }

	/// Current volume over the initial one.
	double volumeRatio(std::size_t p) const
	{
		const double J = defGrad[p].determinant();
		return hoopStretch.empty() ? J : J * hoopStretch[p];
	}
	void resize(std::size_t n)
	{
		position.resize(n);
		halfSize.resize(n);
		halfSize0.resize(n);
		volume0.resize(n);
		defGrad.resize(n);
		elasticStrain.resize(n);
		stress.resize(n);
		for (auto& column : internals)
			if (!column.empty()) column.resize(n);
		for (auto& column : parameters)
			if (!column.empty()) column.resize(n);
		material.resize(n);
	}
};

} // namespace gimpm
