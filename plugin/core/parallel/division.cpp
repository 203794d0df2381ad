// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/parallel/division.hpp"
#include "core/base/even_parts.hpp"
#include <algorithm>
#include <numeric>

namespace gimpm {
namespace {

/// Work of so many points, and of the nodes of so many cells, in multiples of the assembly of a cell.
double workOf(double points, double cells, double pointsOfCell) { return solveOverAssembly * cells + points / pointsOfCell; }

} // namespace

std::vector<int> Division::startsAmong(const std::vector<Key>& sorted) const
{
	std::vector<int> start { 0 };
	for (const Key key : first)
		start.push_back(int(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin()));
	start.push_back(int(sorted.size()));
	return start;
}

std::vector<Key> Division::united(std::vector<Key> sorted) const
{
	const auto start = startsAmong(sorted);
	const int  rank  = processes->rank();
	sorted.erase(sorted.begin() + start[rank + 1], sorted.end());
	sorted.erase(sorted.begin(), sorted.begin() + start[rank]);
	return joined(std::move(sorted));
}

void Division::complete(const std::vector<Key>& sorted, std::vector<double>& values) const
{
	if (!isWhole()) processes->gather(values.data(), startsAmong(sorted).data());
}

void Division::complete(const std::vector<Key>& sorted, std::vector<char>& values) const
{
	if (isWhole()) return;
	std::vector<double> numbers(values.begin(), values.end());
	complete(sorted, numbers);
	std::copy(numbers.begin(), numbers.end(), values.begin());
}

double Division::sum(double own) const
{
	addUp(*processes, &own, 1);
	return own;
}

double Division::largest(double own) const
{
	const auto numbers = ofEach(*processes, own);
	return *std::max_element(numbers.begin(), numbers.end());
}

std::vector<Key> cutByWork(std::vector<CellLoad> loads, int processes)
{
	std::sort(loads.begin(), loads.end(), [](const CellLoad& a, const CellLoad& b) { return a.lowest < b.lowest; });
	std::vector<CellLoad> cells; // loads by cell, summed: several processes may have points in one
	for (const CellLoad& load : loads)
		if (!cells.empty() && cells.back().lowest == load.lowest) cells.back().points += load.points;
		else
			cells.push_back(load);
	const double        points = std::accumulate(cells.begin(), cells.end(), 0., [](double sum, const CellLoad& cell) { return sum + cell.points; });
	std::vector<double> work;
	for (const CellLoad& cell : cells)
		work.push_back(workOf(cell.points, 1, points / double(cells.size())));
	const auto       start = evenParts(work, processes);
	std::vector<Key> first;
	for (int r = 1; r < processes; ++r)
		first.push_back(start[r] < int(cells.size()) ? cells[start[r]].lowest : ~Key(0));
	return first;
}

double imbalance(const Processes& all, const std::vector<CellLoad>& own)
{
	double points = 0;
	for (const auto& load : own)
		points += load.points;
	const auto   pointsOf = ofEach(all, points), cellsOf = ofEach(all, double(own.size()));
	const double allPoints = std::accumulate(pointsOf.begin(), pointsOf.end(), 0.), allCells = std::accumulate(cellsOf.begin(), cellsOf.end(), 0.);
	double       most = 0;
	for (std::size_t r = 0; r < pointsOf.size(); ++r)
		most = std::max(most, workOf(pointsOf[r], cellsOf[r], allPoints / allCells));
	return most * double(pointsOf.size()) / workOf(allPoints, allCells, allPoints / allCells) - 1;
}

} // namespace gimpm
