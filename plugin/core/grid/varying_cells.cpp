// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/varying_cells.hpp"
#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace gimpm {
namespace {

/// N_n of the corners of a cell, the first axis fastest, at a position in it, from 0 to 1 along each axis.
template <int Dim> std::array<double, 1 << Dim> valuesAt(const Vec<Dim>& position)
{
	std::array<double, 1 << Dim> value;
	for (int corner = 0; corner < 1 << Dim; ++corner) {
		value[corner] = 1;
		for (int a = 0; a < Dim; ++a)
			value[corner] *= corner >> a & 1 ? position[a] : 1 - position[a];
	}
	return value;
}

/// Mean of the deformation gradient at a node, and its weight.
struct NodalMean {
	double volume = 0;
	Mat3   sum    = Mat3::Zero();
};

/// Cells with points, each with its nodes, which are looked up once.
template <int Dim> class MeanField {
public:
	MeanField(const std::vector<DeformedVolume<Dim>>& points, const Grid<Dim>& grid) : grid_(grid)
	{
		for (const auto& point : points) {
			const auto [cell, value] = at(point.position);
			for (int corner = 0; corner < 1 << Dim; ++corner) {
				NodalMean&   mean   = means_[nodes_[cell][corner]];
				const double volume = value[corner] * point.volume;
				mean.volume += volume, mean.sum += volume * point.deformationGradient;
			}
		}
	}

	/// Number of the cell of a position, and N_n there.
	std::pair<int, std::array<double, 1 << Dim>> at(const Vec<Dim>& position)
	{
		const Vec<Dim>   x    = (position - grid_.origin) / grid_.cellSize;
		const Index<Dim> cell = x.array().floor().template cast<int>();
		return { numberOf(Grid<Dim>::key(cell)), valuesAt<Dim>(x - cell.template cast<double>()) };
	}

	Mat3 operator()(int cell, const std::array<double, 1 << Dim>& value) const
	{
		Mat3 F = Mat3::Zero();
		for (int corner = 0; corner < 1 << Dim; ++corner)
			if (const NodalMean& mean = means_[nodes_[cell][corner]]; mean.volume > 0) F += value[corner] / mean.volume * mean.sum;
		return F;
	}

	const std::vector<Key>& cells() const { return cells_; }

private:
	int numberOf(Key cell)
	{
		if (last_ >= 0 && cells_[last_] == cell) return last_; // points of a cell mostly follow each other
		const auto [found, isNew] = numberOfCell_.emplace(cell, int(cells_.size()));
		if (isNew) {
			cells_.push_back(cell);
			nodes_.emplace_back();
			for (int corner = 0; corner < 1 << Dim; ++corner) {
				const auto [node, isFirst] = numberOfNode_.emplace(cell + Grid<Dim>::keyOffset(corner), int(means_.size()));
				if (isFirst) means_.emplace_back();
				nodes_.back()[corner] = node->second;
			}
		}
		return last_ = found->second;
	}

	Grid<Dim>                              grid_;
	std::unordered_map<Key, int>           numberOfCell_, numberOfNode_;
	std::vector<Key>                       cells_;
	std::vector<std::array<int, 1 << Dim>> nodes_; // by cell
	std::vector<NodalMean>                 means_; // by node
	int                                    last_ = -1;
};

/// Numbers of the largest errors that together have a share of their sum.
std::vector<int> largest(const std::vector<double>& errors, double sum, double share)
{
	std::vector<int> sorted(errors.size());
	std::iota(sorted.begin(), sorted.end(), 0);
	std::stable_sort(sorted.begin(), sorted.end(), [&](int a, int b) { return errors[a] > errors[b]; });
	std::size_t count = 0;
	for (double covered = 0; covered < share * sum && count < sorted.size(); ++count)
		covered += errors[sorted[count]];
	sorted.resize(count);
	return sorted;
}

} // namespace

template <int Dim> std::vector<Index<Dim>> varyingCells(const std::vector<DeformedVolume<Dim>>& points, const Grid<Dim>& grid)
{
	constexpr double    share = 0.98, leastPart = 0.05, roundOff = 1e-12;
	MeanField<Dim>      mean(points, grid);
	std::vector<double> errors(mean.cells().size(), 0);
	double              whole = 0;
	for (const auto& point : points) {
		const auto [cell, value] = mean.at(point.position);
		errors[cell] += point.volume * (point.deformationGradient - mean(cell, value)).squaredNorm();
		whole += point.volume * ((point.deformationGradient - Mat3::Identity()).squaredNorm() + roundOff * roundOff);
	}
	const double sum = std::accumulate(errors.begin(), errors.end(), 0.);
	if (!(sum > leastPart * leastPart * whole)) return {};
	std::vector<Index<Dim>> cells;
	for (const int cell : largest(errors, sum, share))
		cells.push_back(Grid<Dim>::index(mean.cells()[cell]));
	return cells;
}

template std::vector<Index<2>> varyingCells(const std::vector<DeformedVolume<2>>&, const Grid<2>&);
template std::vector<Index<3>> varyingCells(const std::vector<DeformedVolume<3>>&, const Grid<3>&);

} // namespace gimpm
