// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/flow.hpp"
#include "core/terms/flow_sums.hpp"
#include "core/terms/overlap.hpp"
#include <atomic>

namespace gimpm {
namespace {

/// Calls f(first, last) for ranges of patches from several threads, so that no two work on the same node at a time.
template <int Dim, class F> void forRanges(const CloudBasis<Dim>& basis, F&& f)
{
	for (const auto& colour : basis.colours) {
#pragma omp parallel for schedule(dynamic)
		for (std::size_t range = 0; range < colour.size(); ++range)
			f(colour[range].first, colour[range].second);
	}
}

/// The integral of products of the functions of a cell less the product of their means, over its volume.
template <int Dim> double unevenness(int s, int t)
{
	double product = 1, means = 1;
	for (int a = 0; a < Dim; ++a)
		product *= (s >> a & 1) == (t >> a & 1) ? 1. / 3 : 1. / 6, means /= 4;
	return product - means;
}

} // namespace

template <int Dim> NodalField<Dim> pressureField(SoilWater<Dim>& water, double scale)
{
	const auto begin = [&water](const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis, const Grid<Dim>&) {
		const auto      nodes = Eigen::Index(basis.nodes.size());
		Eigen::VectorXd sum = Eigen::VectorXd::Zero(nodes), volume = sum;
		for (const auto& patch : basis.patches)
			for (int i = patch.first; i < patch.first + patch.count; ++i) {
				const PointFunctions<Dim> f(basis, i, patch);
				const int                 p = basis.order[i];
				for (int n = 0; n < f.count; ++n)
					if (patch.node[n] >= 0) {
						const double weight = f.value[n] * cloud.volume0[p] * cloud.volumeRatio(p);
						volume[patch.node[n]] += weight, sum[patch.node[n]] += weight * water.pressure[p];
					}
			}
		for (Eigen::Index n = 0; n < nodes; ++n) {
			const auto known = water.atNodes.find(basis.nodes[n]);
			sum[n]           = known != water.atNodes.end() ? known->second : volume[n] > 0 ? sum[n] / volume[n] : 0;
		}
		return FieldStart { sum, {} };
	};
	const auto commit = [&water](const CloudBasis<Dim>& basis, const Eigen::VectorXd& value, const Eigen::VectorXd&) {
		water.atNodes.clear();
		for (std::size_t n = 0; n < basis.nodes.size(); ++n)
			water.atNodes.emplace_hint(water.atNodes.end(), basis.nodes[n], value[n]);
	};
	return { { "pore pressure", "Pa", 1, scale, -1 }, begin, commit };
}

template <int Dim>
Flow<Dim>::Flow(SoilWater<Dim>& water, const ConstrainedModulus& modulusOf, const Beginning<Dim>& step)
        : water_(water), basis_(step.basis), h_(step.grid.cellSize), faces_(step.faces)
{
	const auto& cloud = step.cloud;
	points_.reserve(cloud.size());
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		const double J    = cloud.volumeRatio(p);
		const Pores& soil = water.ownPores.empty() ? water.pores[cloud.material[p]] : water.ownPores[p];
		points_.push_back({ cloud.volume0[p] * J, J, std::exp(water.pressure[p] / water.modulus) * (J - 1 + soil.porosity), water.pressure[p], &soil });
	}
	weighCells(modulusOf, step);
	attachDrains(step);
	if (obstacle_.empty()) obstacle_ = enclosure(step);
}

/// Volumes of the cells that are filled, over the moduli of what fills them, and how much they conduct. A face has what
/// the less permeable of its two cells has: the pressure may bend where soils meet.
template <int Dim> void Flow<Dim>::weighCells(const ConstrainedModulus& modulusOf, const Beginning<Dim>& step)
{
	const auto&             cells = step.basis.cells;
	std::vector<double>     volume(cells.size(), 0), softness(cells.size(), 0);
	const std::vector<char> all(step.basis.populatedLeaves().size(), 1);
	cellConductivity_.assign(cells.size(), 0);
	std::vector<double> compliance(points_.size());
	for (std::size_t p = 0; p < points_.size(); ++p)
		compliance[p] = 1 / modulusOf(int(p));
	forOverlaps(all, step.basis, step.grid, [&](int cell, int p, auto within) {
		const double part = within(points_[p].volume);
		volume[cell] += part, softness[cell] += part * compliance[p];
		cellConductivity_[cell] += part * points_[p].pores->at(points_[p].ratio).value;
	});
	for (std::size_t c = 0; c < cells.size(); ++c) {
		Cell       cell { {}, water_.stabilisation * softness[c] };
		const auto lowest = Grid<Dim>::index(cells[c]);
		for (int s = 0; s < corners; ++s) {
			Index<Dim> node = lowest;
			for (int a = 0; a < Dim; ++a)
				node[a] += s >> a & 1;
			cell.node[s] = position(step.basis.nodes, Grid<Dim>::key(step.grid.first(node)));
		}
		if (*std::min_element(cell.node.begin(), cell.node.end()) >= 0) cells_.push_back(cell);
		softness[c] /= volume[c], cellConductivity_[c] /= volume[c];
	}
	for (auto& face : faces_) {
		const auto [lower, upper] = cellsAt(face, step.basis, step.grid);
		const double ofFlow       = water_.duration * std::min(cellConductivity_[lower], cellConductivity_[upper]);
		face.stiffness            = water_.ghost / 3 * (std::pow(h_, 3) * std::min(softness[lower], softness[upper]) + h_ * ofFlow);
	}
}

template <int Dim> void Flow<Dim>::mark(NodeMatrix<Dim>& K) const
{
	forCellsOfPatches(basis_, 0, int(basis_.patches.size()), [&](const PatchesOfCell<Dim>& cell) {
		cell.forPairs([&](int m, int n) {
			if (m <= n) K.markUsed(cell.node[m], Window<Dim>::get().code[m][n]);
		});
	});
}

template <int Dim> void Flow<Dim>::markCouplings(Couplings& K) const
{
	forCellsOfPatches(basis_, 0, int(basis_.patches.size()), [&](const PatchesOfCell<Dim>& cell) {
		cell.forPairs([&](int m, int n) {
			if (m <= n) K.mark({ field, cell.node[m] }, { field, cell.node[n] });
			K.mark({ 0, cell.node[m] }, { field, cell.node[n] });
		});
	});
	for (const Cell& cell : cells_)
		for (int s = 0; s < corners; ++s)
			for (int t = s; t < corners; ++t)
				K.mark({ field, cell.node[s] }, { field, cell.node[t] });
	forGhostPairs<Dim>(faces_, h_, [&](int a, int b, int, double) { K.mark({ field, a }, { field, b }); });
	for (const Outlet& outlet : outlets_)
		for (const int a : outlet.at.node)
			for (const int b : outlet.at.node)
				K.mark({ field, a }, { field, b });
}

template <int Dim> std::optional<PointFailure> Flow<Dim>::addCoupled(const State& state, const FieldSum<Dim>& sum) const
{
	constexpr int         none = std::numeric_limits<int>::max();
	std::atomic<int>      failed { none };
	const Eigen::VectorXd P = state.value(field);
	const auto&           d = state.displacements();
	forRanges(basis_, [&](int first, int last) {
		FlowSums<Dim> sums(sum, water_.duration, water_.modulus);
		forCellsOfPatches(basis_, first, last, [&](const PatchesOfCell<Dim>& cell) {
			sums.begin(cell.node);
			for (const auto* patch = cell.first; patch < cell.end; ++patch)
				for (int i = patch->first; i < patch->first + patch->count; ++i) {
					const int                 p = basis_.order[i];
					const PointFunctions<Dim> f(basis_, i, *patch);
					const FlowPoint<Dim>      s(points_[p], *patch, f, d, P, water_.modulus);
					if (s.isPossible(points_[p])) sums.add(points_[p], s, *patch, f, PresentFunctions<Dim>(s, f));
					else
						for (int seen = failed; p < seen && !failed.compare_exchange_weak(seen, p);) { }
				}
			sums.scatterAdd();
		});
	});
	if (failed != none) return PointFailure { failed };
	addPenalties(state.growth(field), sum);
	addDrains(P, sum);
	return std::nullopt;
}

template <int Dim> void Flow<Dim>::addPenalties(const Eigen::VectorXd& growth, const FieldSum<Dim>& sum) const
{
	const auto add = [&](int row, int column, double k) {
		sum.force[field][row] += k * growth[column];
		sum.sizes[field][row] += std::abs(k * growth[column]);
		if (sum.couplings) sum.couplings->add({ field, row }, { field, column }, k);
	};
	for (const Cell& cell : cells_)
		for (int s = 0; s < corners; ++s) {
			const auto weight = [&](int t) { return cell.weight * unevenness<Dim>(s, t); };
			for (int t = 0; t < corners; ++t)
				sum.force[field][cell.node[s]] += weight(t) * growth[cell.node[t]],
				        sum.sizes[field][cell.node[s]] += std::abs(weight(t) * growth[cell.node[t]]);
			const auto block = [&](int t) { return Eigen::Matrix<double, 1, 1>(weight(t)); };
			if (sum.couplings) sum.couplings->addRow({ field, cell.node[s] }, field, cell.node.data(), corners, block);
		}
	forGhostPairs<Dim>(faces_, h_, [&](int a, int b, int code, double k) {
		add(a, b, k);
		if (code > 0) add(b, a, k);
	});
}

/// What large pressures of little slope leave, and what is left of volumes.
template <int Dim> void Flow<Dim>::addCoupledRoundOff(const State& state, std::vector<Eigen::VectorXd>& sizes) const
{
	constexpr double      roundOff = 10 * std::numeric_limits<double>::epsilon();
	const Eigen::VectorXd P        = state.value(field);
	for (const auto& patch : basis_.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const PointFunctions<Dim> f(basis_, i, patch);
			const PorePoint&          point = points_[basis_.order[i]];
			const double              flow  = water_.duration * point.volume * point.pores->at(point.ratio).value;
			double                    slope = 0;
			for (int n = 0; n < f.count; ++n)
				if (patch.node[n] >= 0) slope += f.gradient[n].norm() * std::abs(P[patch.node[n]]);
			for (int n = 0; n < f.count; ++n)
				if (patch.node[n] >= 0)
					sizes[field][patch.node[n]] += roundOff * (flow * slope * f.gradient[n].norm() + point.volume * f.value[n]);
		}
	for (const Outlet& outlet : outlets_)
		for (int n = 0; n < outlet.at.nodes; ++n)
			sizes[field][outlet.at.node[n]] += roundOff * outlet.conductance * std::abs(outlet.at.weight[n] * P[outlet.at.node[n]]);
}

template <int Dim> void Flow<Dim>::commitCoupled(const State& state)
{
	const Eigen::VectorXd P = state.value(field);
	const auto&           d = state.displacements();
	water_.flux.resize(points_.size());
	water_.pressure.resize(points_.size());
	double stored = 0;
	for (const auto& patch : basis_.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int            p = basis_.order[i];
			const FlowPoint<Dim> s(points_[p], patch, PointFunctions<Dim>(basis_, i, patch), d, P, water_.modulus);
			water_.pressure[p] = s.pressure;
			water_.flux[p]     = -s.kappa.value * s.slope;
			stored += points_[p].volume / points_[p].ratio * s.content;
		}
	water_.stored = stored;
	if (water_.keepsGrowth) keepGrowth(state);
	if (water_.wantsWork) water_.work = workOn(state);
	moveDrains(d, P);
}

/// With the mean of the forces as the step begins and as it ends.
template <int Dim> double Flow<Dim>::workOn(const State& end) const
{
	const std::vector<Eigen::VectorXd> before { Eigen::VectorXd::Zero(end.displacements().size()), end.before(field) };
	const State                        start(end.map(), before, Eigen::VectorXd::Zero(end.map().size()));
	auto                               twice = end.map().zeros(), sizes = twice;
	for (const State* state : { &start, &end })
		addCoupled(*state, { twice, sizes });
	return -twice[0].dot(end.displacements()) / 2;
}

template NodalField<2> pressureField(SoilWater<2>&, double);
template NodalField<3> pressureField(SoilWater<3>&, double);
template class Flow<2>;
template class Flow<3>;

} // namespace gimpm
