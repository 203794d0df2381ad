// SPDX-License-Identifier: GPL-2.0-or-later
// Cells in which the deformation varies too much for their size.
#pragma once
#include "core/grid/grid.hpp"
#include <vector>

namespace gimpm {

/// Centre, volume and deformation gradient of a point, in the plane its part there.
template <int Dim> struct DeformedVolume {
	Vec<Dim> position;
	double   volume;
	Mat<Dim> deformationGradient;
};

/// Estimated errors of the deformation gradient F in the cells of a grid of equal ones. As in the superconvergent
/// patch recovery of stresses (O.C. Zienkiewicz and J.Z. Zhu 1992), it is the difference from a smooth field, which
/// is bilinear between values F_n at the nodes, those of linear functions that are fitted to the points around a
/// node, with weights N_n V_p:
///
///     e_cell^2 = sum_p V_p |F_p - sum_n N_n(x_p) F_n|^2.
///
/// Unlike the stress, F still tells where soil shears when all of it yields. Errors are compared with the deformation
/// of the whole, (sum_p V_p |F_p - I|^2)^(1/2). A body whose strain grows linearly, as by its weight, has none.
template <int Dim> class CellErrors {
public:
	CellErrors(const std::vector<DeformedVolume<Dim>>&, const Grid<Dim>&);

	/// The fewest cells without which the error of the others is this part of the deformation at most.
	std::vector<Index<Dim>> largest(double part) const;

	/// Error of the cells for which f(cell) is false, as a part of the deformation.
	template <class F> double without(F&& f) const
	{
		double rest = 0;
		for (std::size_t c = 0; c < cells_.size(); ++c)
			if (!f(cells_[c])) rest += errors_[c];
		return whole_ > 0 ? std::sqrt(rest / whole_) : 0;
	}

private:
	std::vector<Index<Dim>> cells_;
	std::vector<double>     errors_; // squares, by cell
	double                  sum_ = 0, whole_ = 0;
};

} // namespace gimpm
