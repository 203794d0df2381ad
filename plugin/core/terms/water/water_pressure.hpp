// SPDX-License-Identifier: GPL-2.0-or-later
// Pressure of water as a given function of the position.
#pragma once
#include "core/grid/grid.hpp"
#include <optional>

namespace gimpm {

/// Averaged over a box, with its derivatives by the position of the box.
template <int Dim> struct PressureAround {
	double   value    = 0;                ///< [Pa]
	Vec<Dim> gradient = Vec<Dim>::Zero(); ///< [Pa/m]
	Mat<Dim> hessian  = Mat<Dim>::Zero(); ///< derivative of the gradient [Pa/m2], symmetric
};

template <int Dim> class WaterPressure {
public:
	virtual ~WaterPressure() = default;

	/// Average over the box x -+ half. Averages change continuously, with their derivatives, as the box moves
	/// through a water table. Nothing: not known there.
	virtual std::optional<PressureAround<Dim>> around(const Vec<Dim>& x, const Vec<Dim>& half) const = 0;

	/// Gain along each axis over one period of the grid [Pa], everywhere the same; zero along others.
	virtual Vec<Dim> fall() const { return Vec<Dim>::Zero(); }
};

/// Still water: weight times the depth below a level, zero above it.
template <int Dim> class StillWater : public WaterPressure<Dim> {
public:
	/// Heights are up * x[axis] with up = 1 or -1; weight by volume [N/m3].
	StillWater(int axis, double up, double level, double weight) : axis_(axis), up_(up), level_(level), weight_(weight) { }
	std::optional<PressureAround<Dim>> around(const Vec<Dim>& x, const Vec<Dim>& half) const override;

private:
	int    axis_;
	double up_, level_, weight_;
};

/// Values at nodes of the grid, linear in between along each axis.
template <int Dim> class TabulatedWater : public WaterPressure<Dim> {
public:
	/// Sorted nodes, and their values; those of the first period stand for all, to which each period adds the fall.
	TabulatedWater(const Grid<Dim>& grid, std::vector<Key> nodes, std::vector<double> values, const Vec<Dim>& fall = Vec<Dim>::Zero())
	        : grid_(grid), nodes_(std::move(nodes)), values_(std::move(values)), fall_(fall)
	{
	}
	Vec<Dim>                           fall() const override { return fall_; }
	std::optional<PressureAround<Dim>> around(const Vec<Dim>& x, const Vec<Dim>& half) const override;

private:
	Grid<Dim>           grid_;
	std::vector<Key>    nodes_;
	std::vector<double> values_;
	Vec<Dim>            fall_;

	std::optional<PressureAround<Dim>> aroundIn(int level, const Vec<Dim>& x, const Vec<Dim>& half) const;
	double                             sincePeriod(const Index<Dim>& node, const Index<Dim>& first) const;
};

} // namespace gimpm
