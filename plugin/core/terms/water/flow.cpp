// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/water/flow.hpp"
#include "core/base/instruction_set.hpp"
#include "core/grid/parting.hpp"
#include "core/terms/overlap.hpp"
#include "core/terms/water/fitted_pressures.hpp"
#include "core/terms/water/flow_sums.hpp"
#include <atomic>

namespace gimpm {
namespace {

/// Calls f(first, last) for ranges of patches from several threads, so that no two work on the same node at a time.
template <int Dim, class F> void forRanges(const CloudBasis<Dim>& basis, F&& f)
{
	for (const auto& colour : basis.colours) {
#pragma omp parallel for schedule(dynamic)
		for (std::size_t range = 0; range < colour.size(); ++range)
			callForProcessor([&] { f(colour[range].first, colour[range].second); });
	}
}

/// Corners of a cell: the integral of products of their functions less the product of their means, over its volume, and
/// the codes of the offsets between them.
template <int Dim> struct Corners {
	static constexpr int count = 1 << Dim;

	double unevenness[count][count];
	int    code[count][count];

	Corners()
	{
		for (int s = 0; s < count; ++s)
			for (int t = 0; t < count; ++t) {
				double     product = 1, means = 1;
				Index<Dim> offset;
				for (int a = 0; a < Dim; ++a) {
					product *= (s >> a & 1) == (t >> a & 1) ? 1. / 3 : 1. / 6, means /= 4;
					offset[a] = (t >> a & 1) - (s >> a & 1);
				}
				unevenness[s][t] = product - means, code[s][t] = NodeMatrix<Dim>::code(offset);
			}
	}
};

} // namespace

template <int Dim> NodalField<Dim> pressureField(SoilWater<Dim>& water, const Division& division, double scale)
{
	const auto folds = std::make_shared<std::shared_ptr<const Parting<Dim>>>(); // of the step
	const auto begin = [&water, &division, folds](const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis, const Grid<Dim>& grid) {
		*folds        = grid.parting && grid.parting->isOfFolds() ? grid.parting : nullptr;
		auto pressure = water.pressure;
		division.extend(pressure);
		const auto      nodes = Eigen::Index(basis.nodes.size());
		Eigen::VectorXd sum = Eigen::VectorXd::Zero(nodes), volume = sum, fitted;
		for (const auto& patch : basis.patches)
			for (int i = patch.first; i < patch.first + patch.count; ++i) {
				const PointFunctions<Dim> f(basis, i, patch);
				const int                 p = basis.order[i];
				for (int n = 0; n < f.count; ++n)
					if (patch.node[n] >= 0) {
						const double weight = f.value[n] * cloud.volume0[p] * cloud.volumeRatio(p);
						volume[patch.node[n]] += weight, sum[patch.node[n]] += weight * pressure[p];
					}
			}
		for (Eigen::Index n = 0; n < nodes; ++n) {
			const auto known = water.atNodes.find(basis.nodes[n]);
			if (known != water.atNodes.end()) sum[n] = known->second;
			else if (!water.whole && !grid.refinement && !grid.parting)
				sum[n] = volume[n] > 0 ? sum[n] / volume[n] : 0;
			else {
				if (fitted.size() == 0) fitted = fittedPressures(basis, cloud, grid, pressure);
				sum[n] = fitted[n];
			}
		}
		return FieldStart { sum, {} };
	};
	// Sides of folds may have other layers in the next step: their points know the pressures.
	const auto commit = [&water, folds](const CloudBasis<Dim>& basis, const Eigen::VectorXd& value, const Eigen::VectorXd&) {
		water.atNodes.clear();
		for (std::size_t n = 0; n < basis.nodes.size(); ++n)
			if (!basis.affineConstraints.contains(int(n)) && !(*folds && (*folds)->isCut(basis.nodes[n])))
				water.atNodes.emplace_hint(water.atNodes.end(), basis.nodes[n], value[n]);
	};
	return { { "pore pressure", "Pa", 1, scale, -1 }, begin, commit };
}

template <int Dim>
Flow<Dim>::Flow(SoilWater<Dim>& water, const ConstrainedModulus& modulusOf, const StepContext<Dim>& step, const State& begin)
        : water_(water)
        , basis_(step.basis)
        , h_(step.grid.cellSize)
        , ownedNodes_(step.ownedNodes)
        , division_(step.division)
        , faces_(step.faces)
        , near_(int(step.basis.nodes.size()))
        , isExact_(water.whole)
        , ownPores_(water.ownPores)
{
	const auto& cloud    = step.cloud;
	auto        pressure = water.pressure;
	division_.extend(pressure), division_.extend(ownPores_);
	for (std::size_t p = division_.ownOf(cloud.size()); p < ownPores_.size(); ++p) { // pointers of other processes
		Pores& pores    = ownPores_[p];
		pores.retention = pores.curve < 0 ? nullptr : water_.whole->curves[pores.curve].get();
		if (pores.hasOwnCurve) pores.retention = &ownCurves_.emplace_back(ownCurveOf(pores, *pores.retention));
	}
	points_.reserve(cloud.size());
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		const double J    = cloud.volumeRatio(p);
		const Pores& soil = ownPores_.empty() ? water.pores[cloud.material[p]] : ownPores_[p];
		points_.push_back({ cloud.volume0[p] * J, J, std::exp(pressure[p] / water.modulus) * (J - 1 + soil.porosity), pressure[p], &soil });
	}
	if (water_.whole) beginUnsaturated(begin.value(field));
	weighCells(modulusOf, step);
	findNear(step);
	attachDrains(step);
	attachPassages(step);
	if (obstacle_.empty()) obstacle_ = enclosure(step);
}

/// Relative permeabilities as the step begins. Compliances become those with which suction acts on the grains.
static std::vector<double> relativePermeabilities(const std::vector<PorePoint>& points, std::vector<double>& compliance)
{
	std::vector<double> relative;
	for (std::size_t p = 0; p < points.size(); ++p) {
		const Pores& pores = *points[p].pores;
		relative.push_back(permeabilityOf(pores, points[p].pressure, points[p].ratio).value);
		if (pores.retention) compliance[p] *= std::pow(pores.retention->effective(suctionFactor(pores, points[p].ratio) * points[p].pressure).value, 2);
	}
	return relative;
}

/// True if some soil conducts better in one direction than in another, in any process.
template <int Dim> bool Flow<Dim>::hasDirections() const
{
	const bool here = std::any_of(points_.begin(), points_.end(), [](const PorePoint& point) { return point.pores->verticalRatio != 1; });
	return division_.sum(here ? 1. : 0.) > 0;
}

/// Adds a leaf of which all nodes are there, with its weight.
template <int Dim> void Flow<Dim>::addCell(Key key, double weight, const StepContext<Dim>& step)
{
	Cell       cell { {}, weight };
	const int  level = Grid<Dim>::level(key), layer = Grid<Dim>::layer(key);
	const auto lowest = Grid<Dim>::index(key);
	for (int s = 0; s < corners; ++s) {
		Index<Dim> node = lowest;
		for (int a = 0; a < Dim; ++a)
			node[a] += (s >> a & 1) << level;
		cell.node[s] = gimpm::find(step.basis.nodes, Grid<Dim>::key(step.grid.first(node), level, layer));
	}
	if (*std::min_element(cell.node.begin(), cell.node.end()) >= 0) cells_.push_back(cell);
}

/// Volumes of the leaves that are filled, over the moduli of what fills them, and how much they conduct.
template <int Dim> void Flow<Dim>::weighCells(const ConstrainedModulus& modulusOf, const StepContext<Dim>& step)
{
	const auto&             cells = step.basis.populatedLeaves();
	std::vector<double>     volume(cells.size(), 0), softness(cells.size(), 0);
	const std::vector<char> all(cells.size(), 1);
	cellConductivity_.assign(cells.size(), 0);
	std::vector<double> compliance(points_.size());
	for (std::size_t p = 0; p < points_.size(); ++p)
		compliance[p] = 1 / modulusOf(int(p));
	const auto          relative = water_.whole ? relativePermeabilities(points_, compliance) : std::vector<double>();
	std::vector<double> permeability(water_.whole ? cells.size() : 0, 0.);
	if (hasDirections()) cellRise_.assign(cells.size(), 0);
	forOverlaps(all, step.basis, step.grid, [&](int number, int p, auto within) {
		const int    cell = step.basis.leaf(number);
		const double part = within(points_[p].volume);
		volume[cell] += part, softness[cell] += part * compliance[p];
		const Pores& pores        = *points_[p].pores;
		const double conductivity = part * pores.at(points_[p].ratio).value;
		cellConductivity_[cell] += conductivity;
		if (!cellRise_.empty()) cellRise_[cell] += (pores.verticalRatio - 1) * conductivity;
		if (water_.whole) permeability[cell] += part * relative[p];
	});
	for (auto* ofCells : { &volume, &softness, &cellConductivity_ })
		step.division.complete(cells, *ofCells);
	if (water_.whole) step.division.complete(cells, permeability);
	if (!cellRise_.empty()) step.division.complete(cells, cellRise_);
	for (std::size_t c = 0; c < cells.size(); ++c) {
		addCell(cells[c], water_.stabilisation * softness[c], step);
		softness[c] /= volume[c], cellConductivity_[c] /= volume[c];
		if (water_.whole) permeability[c] /= volume[c];
		if (!cellRise_.empty()) cellRise_[c] /= volume[c];
	}
	weighFaces(softness, permeability, step);
}

/// Stiffness of the faces by the compliances of the cells and, where pores need not be full, their relative
/// permeabilities. A face has what the less permeable of its two cells has: the pressure may bend where soils meet.
template <int Dim> void Flow<Dim>::weighFaces(const std::vector<double>& softness, const std::vector<double>& permeability, const StepContext<Dim>& step)
{
	const auto levelOf = [&](int leaf) { return Grid<Dim>::level(step.basis.populatedLeaves()[leaf]); };
	for (auto& face : faces_) {
		const auto [lower, upper] = cellsAt(face, step.basis, step.grid);
		const double h            = step.grid.size(std::max(levelOf(lower), levelOf(upper)));
		const auto   passes
		        = [&, axis = face.axis](int cell) { return conductivityAlong(cell, Vec<Dim>::Unit(axis)) * (water_.whole ? permeability[cell] : 1); };
		const double ofFlow = water_.duration * std::min(passes(lower), passes(upper));
		face.stiffness      = water_.ghost / 3 * (std::pow(h, 3) * std::min(softness[lower], softness[upper]) + h * ofFlow);
	}
}

/// Nodes of points, of cells and of ghost faces. Where most points reach as far as they can, those that do not are
/// taken to do so, too: the pattern of the matrix then stays as they move, and with it its symbolic analysis.
template <int Dim> void Flow<Dim>::findNear(const StepContext<Dim>& step)
{
	const auto& code = Window<Dim>::get().code;
	double      more = 0; // excess of whole windows over others
	forCellsOfPatches(basis_, 0, int(basis_.patches.size()), [&](const PatchesOfCell<Dim>& cell) {
		cell.forPairs([&](int m, int n) { near_.add(cell.node[m], cell.node[n], code[m][n]); });
		more += cell.isWhole() ? 1 : -1;
	});
	if (step.division.sum(more) > 0) near_.addAll(basis_.nodes, step.grid);
	const Corners<Dim> at;
	for (const Cell& cell : cells_)
		for (int s = 0; s < corners; ++s)
			for (int t = s; t < corners; ++t)
				near_.add(cell.node[s], cell.node[t], at.code[s][t]);
	forGhostPairs<Dim>(faces_, h_, [&](int a, int b, int offset, double) { near_.add(a, b, offset); });
}

template <int Dim> void Flow<Dim>::mark(NodeMatrix<Dim>& K) const { near_.mark(K); }

template <int Dim> Flow<Dim>::~Flow() = default;

template <int Dim> void Flow<Dim>::markCouplings(Couplings& K) const
{
	blocks_.reset();
	near_.mark(K, 0, field);
	if (!K.isSymmetric()) near_.mark(K, field, 0);
	near_.mark(K, field, field);
	for (const Outlet& outlet : outlets_)
		for (const int a : outlet.at.node)
			for (const int b : outlet.at.node)
				K.mark({ field, a }, { field, b });
	for (const auto& passage : passages_)
		passage.mark(K);
}

/// Kept from iteration to iteration, until the matrix is marked anew.
template <int Dim> const FlowBlocks<Dim>& Flow<Dim>::blocksIn(Couplings& K) const
{
	if (!blocks_ || blockValues_ != K.values()) blocks_ = std::make_unique<FlowBlocks<Dim>>(near_, K, field);
	blockValues_ = K.values();
	return *blocks_;
}

template <int Dim> std::optional<PointFailure> Flow<Dim>::addCoupled(const State& state, const FieldSum<Dim>& sum) const
{
	constexpr int         none = std::numeric_limits<int>::max();
	std::atomic<int>      failed { none };
	const Eigen::VectorXd P       = state.value(field);
	const auto&           d       = state.displacements();
	const auto*           blocks  = sum.couplings ? &blocksIn(*sum.couplings) : nullptr;
	const auto            wetness = water_.whole ? curves_->at(P) : CurvesOfNodes::Wetness();
	forRanges(basis_, [&](int first, int last) {
		FlowSums<Dim> sums(sum, blocks, basis_.isAxisymmetric(), water_);
		forCellsOfPatches(basis_, first, last, [&](const PatchesOfCell<Dim>& cell) {
			sums.begin(cell.node);
			for (const auto* patch = cell.first; patch < cell.end; ++patch)
				for (int i = patch->first; i < patch->first + patch->count; ++i) {
					const int                 p = basis_.order[i];
					const PointFunctions<Dim> f(basis_, i, *patch);
					const FlowPoint<Dim>      s(points_[p], *patch, f, d, P, water_.modulus);
					const auto                functions = [&](const Vec<Dim>& drive) {
                                                return PresentFunctions<Dim>(s, f, conducted(*points_[p].pores, water_.vertical, drive));
					};
					if (!s.isPossible(points_[p]))
						for (int seen = failed; p < seen && !failed.compare_exchange_weak(seen, p);) { }
					else if (water_.whole) {
						const auto u = unsaturated(p, *patch, f, s, wetness);
						sums.addUnsaturated(points_[p], s, u, *patch, f, functions(u.drive));
					} else
						sums.add(points_[p], s, *patch, f, functions(s.pressureGradient));
				}
			sums.scatterAdd();
		});
	});
	if (failed != none) return PointFailure { failed };
	addPenalties(state.growth(field), sum, blocks);
	addDrains(P, sum);
	for (const auto& passage : passages_)
		passage.add(P, sum);
	return std::nullopt;
}

template <int Dim> void Flow<Dim>::addPenalties(const Eigen::VectorXd& growth, const FieldSum<Dim>& sum, const FlowBlocks<Dim>* blocks) const
{
	const auto add = [&](int row, int column, int code, double k) {
		sum.force[field][row] += k * growth[column];
		sum.absoluteContributions[field][row] += std::abs(k * growth[column]);
		if (!blocks) return;
		if (double* to = blocks->pp.at(row, code)) *to += k;
	};
	const Corners<Dim> at;
	for (const Cell& cell : cells_)
		for (int s = 0; s < corners; ++s)
			for (int t = 0; t < corners; ++t)
				add(cell.node[s], cell.node[t], at.code[s][t], cell.weight * at.unevenness[s][t]);
	forGhostPairs<Dim>(faces_, h_, [&](int a, int b, int code, double k) {
		add(a, b, code, k);
		if (code > 0) add(b, a, -code, k);
	});
}

/// Round-off that large pressures of small gradient leave, and that of volumes; and, in the balance of forces, what is
/// left of pressures that vanish in the step.
template <int Dim> void Flow<Dim>::addCoupledRoundOff(const State& state, std::vector<Eigen::VectorXd>& absoluteContributions) const
{
	constexpr double      roundOff = 10 * std::numeric_limits<double>::epsilon();
	const Eigen::VectorXd P = state.value(field), before = state.before(field).cwiseAbs();
	forRanges(basis_, [&](int first, int last) {
		for (auto patch = basis_.patches.begin() + first; patch != basis_.patches.begin() + last; ++patch)
			for (int i = patch->first; i < patch->first + patch->count; ++i) {
				const PointFunctions<Dim> f(basis_, i, *patch);
				const PorePoint&          point = points_[basis_.order[i]];
				const double flow     = water_.duration * point.volume * point.pores->largestRatio() * point.pores->at(point.ratio).value;
				double       gradient = 0, pressure = 0, steepness[windowNodes<Dim>];
				for (int n = 0; n < f.count; ++n) {
					steepness[n] = f.gradient[n].norm();
					if (patch->node[n] < 0) continue;
					gradient += steepness[n] * std::abs(P[patch->node[n]]), pressure += f.value[n] * before[patch->node[n]];
				}
				for (int n = 0; n < f.count; ++n) {
					const int a = patch->node[n];
					if (a < 0) continue;
					absoluteContributions[field][a] += roundOff * (flow * gradient * steepness[n] + point.volume * f.value[n]);
					absoluteContributions[0].template segment<Dim>(Dim * a).array()
					        += roundOff * point.coupling() * point.volume * pressure * (steepness[n] + f.hoop[n]);
				}
			}
	});
	for (const Outlet& outlet : outlets_)
		for (int n = 0; n < outlet.at.nodes; ++n)
			absoluteContributions[field][outlet.at.node[n]] += roundOff * outlet.conductance * std::abs(outlet.at.weight[n] * P[outlet.at.node[n]]);
}

template <int Dim> void Flow<Dim>::commitCoupled(const State& state)
{
	const Eigen::VectorXd P   = state.value(field);
	const auto&           d   = state.displacements();
	const int             own = division_.ownOf(points_.size());
	water_.flux.resize(own);
	water_.pressure.resize(own);
	double stored = 0;
	for (const auto& patch : basis_.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int p = basis_.order[i];
			if (p >= own) continue;
			const FlowPoint<Dim> s(points_[p], patch, PointFunctions<Dim>(basis_, i, patch), d, P, water_.modulus);
			water_.pressure[p] = s.pressure;
			water_.flux[p]     = -s.kappa.value * conducted(*points_[p].pores, water_.vertical, s.pressureGradient);
			stored += points_[p].volume / points_[p].ratio * s.content;
		}
	water_.stored = division_.sum(stored);
	if (water_.whole) commitSaturation(state);
	if (water_.keepsGrowth) keepGrowth(state);
	if (water_.wantsWork) water_.work = workOn(state);
	moveDrains(d, P);
}

/// Work with the mean of the forces as the step begins and as it ends.
template <int Dim> double Flow<Dim>::workOn(const State& end) const
{
	const std::vector<Eigen::VectorXd> before { Eigen::VectorXd::Zero(end.displacements().size()), end.before(field) };
	const State                        start(end.map(), before, Eigen::VectorXd::Zero(end.map().size()));
	auto                               twice = end.map().zeros(), absoluteContributions = twice;
	for (const State* state : { &start, &end })
		addCoupled(*state, { twice, absoluteContributions });
	ownedNodes_.complete(twice[0]);
	return -twice[0].dot(end.displacements()) / 2;
}

template NodalField<2> pressureField(SoilWater<2>&, const Division&, double);
template NodalField<3> pressureField(SoilWater<3>&, const Division&, double);
template class Flow<2>;
template class Flow<3>;

} // namespace gimpm
