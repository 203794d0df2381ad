// SPDX-License-Identifier: GPL-2.0-or-later
// Points that are divided among processes.
#pragma once
#include "core/grid/neighbourhood.hpp"
#include "core/stepping/load_step.hpp"
#include "scenes.hpp"

namespace gimpm {

template <int Dim> Key lowestCellOf(const PointCloud<Dim>& all, int p, const Model<Dim>& model)
{
	return lowestCell(all.position[p], all.halfSize[p], model.grid, model.basis, all.layerOf(p));
}

/// The points of one process, and which of all these are.
template <int Dim> PointCloud<Dim> partOf(const PointCloud<Dim>& all, const Model<Dim>& model, Division& division)
{
	for (int p = 0; p < int(all.size()); ++p)
		if (division.owns(lowestCellOf(all, p, model))) division.id.push_back(p);
	PointCloud<Dim> own = all;
	forColumns(own, [&](auto& column, ColumnPolicy) {
		const auto ofAll = column;
		column.clear();
		for (const std::int64_t p : division.id)
			if (!ofAll.empty()) column.push_back(ofAll[p]);
	});
	return own;
}

template <int Dim> std::vector<CellLoad> loadsOf(const PointCloud<Dim>& all, const Model<Dim>& model)
{
	std::map<Key, double> points;
	for (int p = 0; p < int(all.size()); ++p)
		++points[lowestCellOf(all, p, model)];
	std::vector<CellLoad> found;
	for (const auto& [cell, count] : points)
		found.push_back({ cell, count });
	return found;
}

} // namespace gimpm
