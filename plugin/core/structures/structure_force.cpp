// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/structure_force.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/nearness.hpp"
#include "core/structures/edge_of_soil.hpp"
#include "core/structures/soil_near.hpp"

namespace gimpm {
namespace {

/// Largest distance of a vertex of a bar from the domain of a point [cells]: the same as of a loaded surface.
constexpr double nearDomain = 0.375;

/// Distances at which the soil beside a beam is searched [cells]: material within the second of the first, to its left
/// or right.
constexpr double besideBeam = 0.5, besideReach = 0.25;

/// In the plane, along t on what is to its left from what is to its right.
double shearStress(const SymTensor<2>& stress, const Vec<2>& t) { return -t.dot(stress.inPlane() * Vec<2>(-t[1], t[0])); }

/// On a line along t, pressure positive: in the plane on its sides, in space the mean around it.
double normalStress(const SymTensor<2>& stress, const Vec<2>& t)
{
	const Vec<2> n(-t[1], t[0]);
	return -n.dot(stress.inPlane() * n);
}
double normalStress(const SymTensor<3>& stress, const Vec<3>& t) { return -(stress.inPlane().trace() - t.dot(stress.inPlane() * t)) / 2; }

template <int Dim> Vec<Dim> tangent(const std::vector<Vec<Dim>>& positions, std::size_t v)
{
	return (positions[std::min(v + 1, positions.size() - 1)] - positions[v > 0 ? v - 1 : 0]).normalized();
}

template <int Dim> double cellSizeAt(const std::optional<Attachment<Dim>>& at, const Grid<Dim>& grid) { return grid.size(at ? at->level : 0); }

} // namespace

template <int Dim> StructureForce<Dim>::StructureForce(Structure<Dim>& structure, const StepContext<Dim>& step) : structure_(structure)
{
	soil_ = soilAround(step);
	if (step.water) wet(step);
	obstacle_ = missingSoil(step, soil_);
	if (obstacle_.empty()) obstacle_ = pulledOut(soil_);
	if (obstacle_.empty()) system_.emplace(structure, soil_);
}

template <int Dim> std::vector<Vec<Dim>> StructureForce<Dim>::positions() const
{
	std::vector<Vec<Dim>> all;
	if constexpr (Dim == 2)
		if (structure_.beam) all = structure_.beam->positions;
	for (const auto& bar : structure_.bars)
		all.insert(all.end(), bar.positions.begin(), bar.positions.end());
	return all;
}

/// Calls f(bar, vertex of the bar, vertex of all).
template <int Dim> template <class F> void StructureForce<Dim>::forVertices(F&& f) const
{
	int all = structure_.beam ? int(structure_.beam->positions.size()) : 0;
	for (const auto& bar : structure_.bars)
		for (int v = 0; v < int(bar.positions.size()); ++v, ++all)
			f(bar, v, all);
}

template <int Dim> std::vector<SoilAtVertex> StructureForce<Dim>::soilAround(const StepContext<Dim>& step)
{
	const auto                all = positions();
	std::vector<double>       reach, cells;
	std::vector<SoilAtVertex> soil(all.size());
	for (std::size_t v = 0; v < all.size(); ++v) {
		attached_.push_back(attach(all[v], step.basis, step.grid));
		soil[v].cellSize = cellSizeAt(attached_[v], step.grid);
		cells.push_back(soil[v].cellSize);
		reach.push_back(nearDomain * soil[v].cellSize);
	}
	const auto near = soilNear<Dim>(all, cells, step);
	for (std::size_t v = 0; v < all.size(); ++v)
		soil[v].young = near[v].young;
	const auto isFar = areFarFromMaterial<Dim>(all, reach, step.cloud, step.grid);
	forVertices([&](const Reinforcement<Dim>& bar, int v, int i) {
		using Head           = typename Reinforcement<Dim>::Head;
		const bool hasNone   = v == 0 && (bar.head == Head::pulled || bar.head == Head::joined);
		soil[i].exists       = !hasNone && attached_[i] && !isFar[i];
		soil[i].normalStress = normalStress(near[i].stress, tangent(bar.positions, v));
	});
	if constexpr (Dim == 2)
		if (structure_.beam) {
			lookBesideBeam(step, soil);
			for (std::size_t v = 0; v < structure_.beam->positions.size(); ++v)
				soil[v].normalStress = normalStress(near[v].stress, structure_.beam->tangentAt(int(v)));
			if (structure_.beam->layer > 0) {
				partAlongBeam(step, soil);
				bondAheadOfTips(step, soil);
			}
		}
	return soil;
}

template <int Dim> void StructureForce<Dim>::lookBesideBeam(const StepContext<Dim>& step, std::vector<SoilAtVertex>& soil) const
{
	if constexpr (Dim == 2) {
		const Beam&         beam = *structure_.beam;
		std::vector<Vec<2>> beside;
		std::vector<double> reach;
		for (int v = 0; v < int(beam.positions.size()); ++v) {
			const Vec<2> t = beam.tangentAt(v), n(-t[1], t[0]);
			for (const double side : { 1., -1. }) {
				beside.push_back(beam.positions[v] + side * besideBeam * soil[v].cellSize * n);
				reach.push_back(besideReach * soil[v].cellSize);
			}
		}
		const auto isFar = areFarFromMaterial<2>(beside, reach, step.cloud, step.grid);
		for (std::size_t v = 0; v < beam.positions.size(); ++v) {
			soil[v].sides  = int(!isFar[2 * v]) | int(!isFar[2 * v + 1]) << 1;
			soil[v].exists = attached_[v] && soil[v].sides != 0 && soil[v].young > 0;
		}
	}
}

/// Attaches a position on one side of a beam: it is on its side of other cuts nearby.
static std::optional<Attachment<2>> attachBeside(const Vec<2>& position, int side, int ofBeam, const StepContext<2>& step)
{
	const int others = step.grid.parting ? step.grid.parting->layerAt(position) & ~ofBeam : 0;
	return attach<2>(position, step.basis, step.grid, others | side);
}

/// Parts the soil along a beam: the soil to the left, and the soil to the right where it has other nodes.
template <int Dim> void StructureForce<Dim>::partAlongBeam(const StepContext<Dim>& step, std::vector<SoilAtVertex>& soil)
{
	if constexpr (Dim == 2) {
		const Beam&               beam  = *structure_.beam;
		const std::size_t         count = beam.positions.size(), right = soil.size();
		const std::vector<double> cells(count, step.grid.cellSize);
		const std::array          beside { BesideLine(beam, 1, step.cloud), BesideLine(beam, -1, step.cloud) };
		const std::array          near { soilNear<2>(beam.positions, cells, step, beside[0]), soilNear<2>(beam.positions, cells, step, beside[1]) };
		const EdgeOfSoil          edges(beam.positions, step.grid.cellSize, step.cloud);
		soil.resize(right + count), attached_.resize(right + count);
		for (std::size_t v = 0; v < count; ++v) {
			const Vec<2> t        = beam.tangentAt(int(v)), n(-t[1], t[0]);
			const auto   attachAt = [&](int side, double away) {
                                const Vec<2> position = beam.positions[v] + (side == 0 ? away : -away) * n;
                                return attachBeside(position, side == 0 ? 0 : beam.layer, beam.layer, step);
			};
			std::array at { attachAt(0, 0), attachAt(1, 0) };
			const bool isOne = at[0] && at[1] && at[0]->node == at[1]->node;
			for (const int side : { 0, 1 }) {
				const Vec<2> inwards = (side == 0 ? 1 : -1) * n;
				if (!isOne) at[side] = attachAt(side, edges.from(beam.positions[v], inwards, beside[side]));
				if (!at[side]) soil[v].sides &= ~(1 << side);
			}
			attached_[v]   = at[soil[v].sides == 2];
			soil[v].exists = soil[v].sides != 0 && soil[v].young > 0;
			if (soil[v].sides != 3 || isOne || near[0][v].young == 0 || near[1][v].young == 0) continue;
			attached_[right + v] = at[1];
			soil[right + v]      = soil[v];
			for (const int side : { 0, 1 }) {
				SoilAtVertex& soilHere = soil[side * right + v];
				soilHere.young         = near[side][v].young;
				soilHere.normalStress  = normalStress(near[side][v].stress, t);
				soilHere.shearStress   = shearStress(near[side][v].stress, t);
			}
		}
	}
}

/// The cut is longer than the beam: there its two sides are kept together at integration points, so that it matters
/// little where a tip is in its cell.
template <int Dim> void StructureForce<Dim>::bondAheadOfTips(const StepContext<Dim>& step, std::vector<SoilAtVertex>& soil)
{
	if constexpr (Dim == 2) {
		const Beam&         beam = *structure_.beam;
		const double        part = bondOfOnePart * step.grid.cellSize;
		std::vector<Vec<2>> positions;
		for (const int end : { 0, 1 })
			for (int i = 0; i < bondsOfTip; ++i)
				positions.push_back((end == 0 ? beam.positions.front() : beam.positions.back()) + (i + 0.5) * part * beam.outwardsAt(end));
		const auto       near = soilNear<2>(positions, std::vector<double>(positions.size(), step.grid.cellSize), step);
		const EdgeOfSoil edges(positions, step.grid.cellSize, step.cloud);
		for (std::size_t i = 0; i < positions.size(); ++i) {
			const int                   end = int(i) / bondsOfTip;
			const Vec<2>                t   = beam.tangentAt(end == 0 ? 0 : int(beam.positions.size()) - 1);
			std::array<SoilAtVertex, 2> beside;
			const Vec<2>                n(-t[1], t[0]);
			const auto attachTo = [&](int layer, double away) { return attachBeside(positions[i] + away * n, layer, beam.layer, step); };
			auto       left = attachTo(0, 0), right = attachTo(beam.layer, 0);
			const bool isParted = beam.isTip[end] && left && right && left->node != right->node;
			if (isParted)
				left  = attachTo(0, edges.from(positions[i], n, BesideLine(beam, 1, step.cloud))),
				right = attachTo(beam.layer, -edges.from(positions[i], -n, BesideLine(beam, -1, step.cloud)));
			for (SoilAtVertex& at : beside) {
				at.exists       = isParted && left && right && near[i].young > 0;
				at.young        = near[i].young;
				at.cellSize     = step.grid.cellSize;
				at.normalStress = normalStress(near[i].stress, t);
				at.shearStress  = shearStress(near[i].stress, t);
				at.area         = part * (beam.isShell ? 2 * M_PI * positions[i][0] : 1);
			}
			soil.insert(soil.end(), beside.begin(), beside.end());
			attached_.push_back(left), attached_.push_back(right);
		}
	}
}

template <int Dim> std::string StructureForce<Dim>::missingSoil(const StepContext<Dim>&, const std::vector<SoilAtVertex>& soil) const
{
	std::string missing;
	forVertices([&](const Reinforcement<Dim>& bar, int v, int i) {
		using Head         = typename Reinforcement<Dim>::Head;
		const bool hasNone = v == 0 && (bar.head == Head::pulled || bar.head == Head::joined);
		if (!missing.empty() || soil[i].exists || hasNone) return;
		missing = sentence(
		        bar.name, " has a vertex at (", bar.positions[v].transpose(), "), where there is no material within ", nearDomain,
		        " cells: let its line begin and end in the soil, and take it away where soil is dug out from around it");
	});
	return missing;
}

/// A force at the head that the bond can never take.
template <int Dim> std::string StructureForce<Dim>::pulledOut(const std::vector<SoilAtVertex>& soil) const
{
	std::string         text;
	std::vector<double> strength(structure_.bars.size(), 0);
	forVertices([&](const Reinforcement<Dim>& bar, int v, int i) {
		double length = 0;
		if (v > 0 && !(v == 1 && bar.hasFreeLength)) length += bar.length0[v - 1] / 2;
		if (v < int(bar.length0.size()) && !(v == 0 && bar.hasFreeLength)) length += bar.length0[v] / 2;
		strength[&bar - structure_.bars.data()]
		        += length * bar.bond + (bar.friction > 0 ? length * bar.friction * std::max(0., soil[i].normalStress) : 0);
	});
	for (std::size_t b = 0; b < strength.size(); ++b) {
		const auto& bar = structure_.bars[b];
		if (!text.empty() || bar.pull <= strength[b] || !bar.slips() || bar.head == Reinforcement<Dim>::Head::plate) continue;
		text = sentence(
		        bar.name, " is pulled out: the pull of ", bar.pull, " N is more than its bond can take, ", strength[b],
		        " N by its strength and the normal stresses on it as they are");
	}
	return text;
}

template <int Dim> Eigen::VectorXd StructureForce<Dim>::soilAt(const Eigen::VectorXd& d) const
{
	Eigen::VectorXd soil(system_->soilUnknowns());
	for (std::size_t v = 0; v < attached_.size(); ++v)
		if (const int at = system_->soilUnknown(int(v)); at >= 0) soil.template segment<Dim>(at) = attached_[v]->displacement(d);
	addPressures(soil);
	return soil;
}

/// An equilibrium that has been found is the first guess of the next one. Displacements without one, which a line
/// search tries and leaves, must not spoil it.
template <int Dim> Eigen::VectorXd StructureForce<Dim>::equilibrium(const Eigen::VectorXd& d) const
{
	const auto solution = system_->solve(soilAt(d), last_);
	if (solution.isFound) last_ = solution.x;
	return solution.x;
}

/// Calls f(vertex, vertex, node of the first, node of the second, product of weights) for what the matrix joins.
template <int Dim> template <class F> void StructureForce<Dim>::forJoined(F&& f) const
{
	const auto join = [&](int v, int w) {
		if (system_->soilUnknown(v) < 0 || system_->soilUnknown(w) < 0) return;
		const auto &from = *attached_[v], &to = *attached_[w];
		for (int a = 0; a < from.nodes; ++a)
			for (int b = 0; b < to.nodes; ++b)
				f(v, w, from.node[a], to.node[b], from.weight[a] * to.weight[b]);
	};
	if (system_->hasOwnUnknowns()) {
		for (int v = 0; v < int(attached_.size()); ++v)
			for (int w = 0; w < int(attached_.size()); ++w)
				join(v, w);
	} else
		for (const auto& [v, w] : system_->joinedVertices()) {
			join(v, w);
			if (v != w) join(w, v);
		}
}

template <int Dim> void StructureForce<Dim>::markCouplings(Couplings& K) const
{
	if (!system_) return;
	std::vector<std::pair<int, int>> pairs;
	forJoined([&](int, int, int a, int b, double) { pairs.emplace_back(std::min(a, b), std::max(a, b)); });
	std::sort(pairs.begin(), pairs.end());
	pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
	for (const auto& [a, b] : pairs)
		K.mark({ 0, a }, { 0, b });
	if (!K.map().isAlone()) markWater(K);
}

template <int Dim> std::optional<PointFailure> StructureForce<Dim>::addCoupled(const State& state, const FieldSum<Dim>& sum) const
{
	if (!system_) return std::nullopt;
	const bool flows = !state.map().isAlone();
	if (flows) water_ = state.value(field);
	const EnergySum at = system_->energyAt(equilibrium(state.displacements()));
	distribute(at, sum);
	if (flows) distributeVolumes(at, sum);
	if (!sum.couplings) return std::nullopt;
	const Eigen::MatrixXd K = system_->condensed(at);
	forJoined([&](int v, int w, int a, int b, double weight) {
		const Mat<Dim> block = weight * K.template block<Dim, Dim>(system_->soilUnknown(v), system_->soilUnknown(w));
		sum.couplings->add({ 0, a }, { 0, b }, block);
	});
	if (flows) addWater(K, *sum.couplings);
	return std::nullopt;
}

/// Forces on the soil at the nodes around the vertices.
template <int Dim> void StructureForce<Dim>::distribute(const EnergySum& at, const FieldSum<Dim>& sum) const
{
	for (std::size_t v = 0; v < attached_.size(); ++v) {
		const int first = system_->soilUnknown(int(v));
		if (first < 0) continue;
		for (int n = 0; n < attached_[v]->nodes; ++n) {
			const int    node   = attached_[v]->node[n];
			const double weight = attached_[v]->weight[n];
			sum.force[0].template segment<Dim>(Dim * node) += weight * at.gradient.template segment<Dim>(first);
			sum.absoluteContributions[0].template segment<Dim>(Dim * node)
			        += std::abs(weight) * at.absoluteContributions.template segment<Dim>(first);
		}
	}
}

/// Takes the loads of the beginning: those of the end would act half a step too early.
template <int Dim> EnergySum StructureForce<Dim>::asItBegins() const
{
	Structure<Dim>             structure = structure_.asItBegins();
	const StructureSystem<Dim> system(structure, soil_);
	Eigen::VectorXd            soil = Eigen::VectorXd::Zero(system.soilUnknowns());
	const Eigen::VectorXd      last = std::exchange(water_, waterBefore_);
	addPressures(soil);
	water_ = last;
	return system.energyAt(system.solve(soil, {}).x);
}

template <int Dim> void StructureForce<Dim>::addCoupledBefore(const State&, const FieldSum<Dim>& sum) const
{
	if (system_) distribute(asItBegins(), sum);
}

template <int Dim> void StructureForce<Dim>::commitCoupled(const State& state)
{
	if (!state.map().isAlone()) water_ = state.value(field);
	const Eigen::VectorXd x = equilibrium(state.displacements()), forces = asItBegins().gradient + system_->energyAt(x).gradient;
	structure_.work = 0;
	for (int v = 0; v < int(attached_.size()); ++v)
		if (const int at = system_->soilUnknown(v); at >= 0) structure_.work -= x.template segment<Dim>(at).dot(forces.template segment<Dim>(at)) / 2;
	system_->commit(x);
	if (water_.size() > 0) keepWater();
}

/// Norm of the loads on the structure, and of the reactions at its ends.
template <int Dim> double StructureForce<Dim>::fromOutside(const Eigen::VectorXd& d)
{
	if (!system_) return 0;
	bool isLoaded = structure_.beam.has_value();
	for (const auto& bar : structure_.bars)
		isLoaded = isLoaded || bar.pull != 0;
	return isLoaded ? system_->energyAt(equilibrium(d)).gradient.head(system_->soilUnknowns()).norm() : 0;
}

/// A beam that is held at an end holds the soil around it, and one that parts the soil holds each side as if the other
/// stood still.
template <int Dim> void StructureForce<Dim>::restrain(const typename Term<Dim>::Constrain& constrain)
{
	if (!structure_.beam || !system_) return;
	const Beam& beam = *structure_.beam;
	for (int position = 0; position < int(attached_.size()); ++position) {
		if (position >= int(beam.positions.size()) && position < structure_.vertices()) continue; // bars
		if (position >= structure_.vertices() + int(beam.positions.size())) break;                // bonds
		for (int a = 0; a < Dim && system_->soilUnknown(position) >= 0; ++a)
			if (beam.fixedHead[a] || beam.fixedFoot[a]) constrain(attached_[position]->node[0], Vec<Dim>::Unit(a), attached_[position]->inCell());
	}
	if constexpr (Dim == 2)
		for (int v = 0; v < int(beam.positions.size()); ++v)
			for (const int side : { 0, 1 }) {
				const int other = structure_.vertices() + v, position = side == 0 ? v : other;
				if (other >= int(attached_.size()) || system_->soilUnknown(other) < 0 || beam.sides[side].gap[v] > 0) continue;
				const Vec<2> t = beam.tangentAt(v);
				constrain(attached_[position]->node[0], Vec<2>(-t[1], t[0]), attached_[position]->inCell());
				if (beam.adhesion > 0 || beam.friction > 0) constrain(attached_[position]->node[0], t, attached_[position]->inCell());
			}
}

/// Forces beyond what numbers can hold would make any residual look small, and the soil around a vertex is that of the
/// beginning of the step.
template <int Dim> Refusal StructureForce<Dim>::refusal(const Eigen::VectorXd& d)
{
	if (!system_) return {};
	if (!std::isfinite(fromOutside(d))) return { Failure::refused, structure_.name() + " has forces that are not finite numbers any more", "" };
	const auto solution = system_->solve(soilAt(d), last_);
	if (!solution.isFound)
		return { Failure::refused, structure_.name() + " finds no equilibrium with the soil around it",
			 "It may have been pulled out, have buckled, have become a mechanism by hinges that yield, or slide along itself, where friction "
			 "acts with pressures of the step before: take shorter steps, or fix an end." };
	for (int v = 0; v < structure_.vertices(); ++v) {
		const double move = system_->moveInSoil(v, solution.x);
		if (move <= soil_[v].cellSize) continue;
		return { Failure::refused, sentence(structure_.name(), " moves by ", move, " m in the soil around it, more than a cell"),
			 "If nothing holds it along itself, give it adhesion, friction, an anchor or a fixed end." };
	}
	return {};
}

template class StructureForce<2>;
template class StructureForce<3>;

} // namespace gimpm
