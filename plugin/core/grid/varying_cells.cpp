// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/varying_cells.hpp"
#include <algorithm>
#include <cmath>
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

/// Linear function a + B d of the distance d from a node, in cells, fitted to the deformation gradients F of points
/// near it by weighted least squares: B = cov(F, d) cov(d, d)^-1, a = mean(F) - B mean(d).
template <int Dim> class NodalFit {
public:
	NodalFit() { products_.fill(Mat<Dim>::Zero()); }

	void add(const Mat<Dim>& F, const Vec<Dim>& distance, double weight)
	{
		const Vec<Dim> weighted = weight * distance;
		weight_ += weight;
		distances_ += weighted;
		squares_ += weighted * distance.transpose();
		F_ += weight * F;
		for (int a = 0; a < Dim; ++a)
			products_[a] += weighted[a] * F;
	}

	/// Its value a at the node; the mean where the points are in a row.
	Mat<Dim> value() const
	{
		constexpr double singular = 1e-6;
		const Mat<Dim>   mean     = F_ / weight_;
		const Vec<Dim>   centre   = distances_ / weight_;
		const Mat<Dim>   spread   = squares_ / weight_ - centre * centre.transpose();
		if (!(spread.determinant() > singular * std::pow(spread.diagonal().maxCoeff(), Dim - 1))) return mean;
		const Vec<Dim> share = spread.inverse() * centre;
		Mat<Dim>       F     = mean;
		for (int a = 0; a < Dim; ++a)
			F -= share[a] * (products_[a] / weight_ - centre[a] * mean);
		return F;
	}

private:
	double                    weight_    = 0;
	Vec<Dim>                  distances_ = Vec<Dim>::Zero(); // this and what follows, summed with the weights
	Mat<Dim>                  squares_   = Mat<Dim>::Zero();
	Mat<Dim>                  F_         = Mat<Dim>::Zero();
	std::array<Mat<Dim>, Dim> products_; // of the distances along each axis and F
};

/// Bilinear between the values at the nodes of cells with points.
template <int Dim> class SmoothField {
public:
	SmoothField(const std::vector<DeformedVolume<Dim>>& points, const Grid<Dim>& grid)
	{
		std::vector<NodalFit<Dim>> fits;
		for (const auto& point : points) {
			const Vec<Dim>   x    = (point.position - grid.origin) / grid.cellSize;
			const Index<Dim> cell = x.array().floor().template cast<int>();
			at_.push_back({ numberOf(Grid<Dim>::key(cell)), valuesAt<Dim>(x - cell.template cast<double>()) });
			fits.resize(numberOfNode_.size());
			const auto& [number, value] = at_.back();
			for (int corner = 0; corner < 1 << Dim; ++corner) {
				Vec<Dim> distance = x - cell.template cast<double>();
				for (int a = 0; a < Dim; ++a)
					distance[a] -= corner >> a & 1;
				fits[nodes_[number][corner]].add(point.deformationGradient, distance, value[corner] * point.volume);
			}
		}
		for (const auto& fit : fits)
			values_.push_back(fit.value());
	}

	int cellOf(std::size_t point) const { return at_[point].first; }

	Mat<Dim> at(std::size_t point) const
	{
		const auto& [cell, value] = at_[point];
		Mat<Dim> F                = Mat<Dim>::Zero();
		for (int corner = 0; corner < 1 << Dim; ++corner)
			F += value[corner] * values_[nodes_[cell][corner]];
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
			for (int corner = 0; corner < 1 << Dim; ++corner)
				nodes_.back()[corner] = numberOfNode_.emplace(cell + Grid<Dim>::keyOffset(corner), int(numberOfNode_.size())).first->second;
		}
		return last_ = found->second;
	}

	std::unordered_map<Key, int>                              numberOfCell_, numberOfNode_;
	std::vector<Key>                                          cells_;
	std::vector<std::array<int, 1 << Dim>>                    nodes_;  // by cell
	std::vector<Mat<Dim>>                                     values_; // by node
	std::vector<std::pair<int, std::array<double, 1 << Dim>>> at_;     // cell and N_n, by point
	int                                                       last_ = -1;
};

} // namespace

template <int Dim> CellErrors<Dim>::CellErrors(const std::vector<DeformedVolume<Dim>>& points, const Grid<Dim>& grid)
{
	constexpr double       roundOff = 1e-12;
	const SmoothField<Dim> smooth(points, grid);
	errors_.assign(smooth.cells().size(), 0);
	for (std::size_t p = 0; p < points.size(); ++p) {
		const Mat<Dim>& F = points[p].deformationGradient;
		errors_[smooth.cellOf(p)] += points[p].volume * (F - smooth.at(p)).squaredNorm();
		whole_ += points[p].volume * ((F - Mat<Dim>::Identity()).squaredNorm() + roundOff * roundOff);
	}
	for (const Key cell : smooth.cells())
		cells_.push_back(Grid<Dim>::index(cell));
	sum_ = std::accumulate(errors_.begin(), errors_.end(), 0.);
}

template <int Dim> std::vector<Index<Dim>> CellErrors<Dim>::largest(double part) const
{
	std::vector<int> sorted(errors_.size());
	std::iota(sorted.begin(), sorted.end(), 0);
	std::stable_sort(sorted.begin(), sorted.end(), [&](int a, int b) { return errors_[a] > errors_[b]; });
	std::vector<Index<Dim>> cells;
	double                  rest = sum_;
	for (std::size_t i = 0; i < sorted.size() && rest > part * part * whole_; ++i) {
		rest -= errors_[sorted[i]];
		cells.push_back(cells_[sorted[i]]);
	}
	return cells;
}

template class CellErrors<2>;
template class CellErrors<3>;

} // namespace gimpm
