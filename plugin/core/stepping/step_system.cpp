// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/step_system.hpp"
#include "core/base/stopwatch.hpp"
#include "core/grid/filled_cells.hpp"
#include "core/grid/mixed_cells.hpp"
#include "core/terms/aggregates.hpp"
#include "core/terms/inertia/inertia.hpp"
#include "core/terms/points/at_middle.hpp"
#include <algorithm>

namespace gimpm {
namespace {

template <int Dim> PointStiffness stiffnessOf(const PointCloud<Dim>& cloud, const Model<Dim>& model)
{
	return [&](int p) {
		const auto&  material = model.materials[cloud.material[p]];
		const double young    = material.young(cloud.parameters, cloud.internals, p, [&] { return cloud.elasticStrain[p].full().trace(); });
		return VolumeAndModulus { cloud.volume0[p] * cloud.volumeRatio(p), young };
	};
}

template <int Dim>
std::vector<GhostFace<Dim>> stabilise(const PointStiffness& moduli, const Model<Dim>& model, const CloudBasis<Dim>& basis, StepReport& report)
{
	if (model.ghost.factor == 0) return {};
	const Stopwatch watch(report.times.ghost);
	const auto      boundary = boundaryCells(basis.populatedLeaves(), model.boundary, model.grid);
	auto            faces    = ghostFaces<Dim>(basis.populatedLeaves(), boundary, model.boundary, model.grid);
	report.boundaryCells     = int(boundary.size());
	report.ghostFaces        = int(faces.size());
	weighGhostFaces(faces, basis, moduli, model.grid, model.ghost.factor, model.ghost.scaling);
	if (model.ghost.threshold > 0)
		lessenElsewhere(faces, tiesOfIllFilled(faces, basis, moduli, model.grid, model.ghost.threshold), GhostSettings::elsewhere);
	return faces;
}

template <int Dim> int countOfMixed(const PointCloud<Dim>& cloud, const Model<Dim>& model, const CloudBasis<Dim>& basis)
{
	const auto mixed = mixedCells(basis, cloud.material);
	const auto count = [&](std::size_t first, std::size_t last) { return int(std::count(mixed.begin() + first, mixed.begin() + last, true)); };
	const auto start = model.division->startsAmong(basis.cells);
	const int  rank  = model.division->processes->rank();
	return int(model.division->sum(count(start[rank], start[rank + 1])));
}

} // namespace

template <int Dim> std::vector<Vec<Dim>> pointForces(const PointCloud<Dim>& cloud, const Model<Dim>& model, const Load<Dim>& load)
{
	const double          ofGravity = load.ofGravity.value_or(load.factor).value;
	std::vector<Vec<Dim>> force(cloud.size());
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		force[p] = model.materials[cloud.material[p]].density * cloud.volume0[p] * ofGravity * load.gravity;
		if (!cloud.force.empty()) force[p] += load.factor.value * cloud.force[p];
	}
	return force;
}

template <int Dim>
StepSystem<Dim>::StepSystem(const PointCloud<Dim>& c, const Model<Dim>& m, const Load<Dim>& l, StepReport& report)
        : cloud(c), model(m), load(l), stiffnessOf_(stiffnessOf(c, m))
{
	{
		const Stopwatch watch(report.times.basis);
		basis = cloudBasis(cloud, model.grid, model.basis, amongSoil(model.boundary, cloud, model.grid, model.basis, *model.division), *model.division);
		points          = stepPoints(cloud, model.materials, basis, model.fBar);
		points.duration = load.duration;
		// Also for points that others have.
		points.isSymmetric = model.division->largest(points.isSymmetric ? 0 : 1) == 0;
		mapFields();
		external = Eigen::VectorXd::Zero(map.size());
		addPointForces(basis, pointForces(cloud, model, load), external);
		constraints.template condense<Dim>(map, external);
	}
	faces = stabilise(stiffnessOf_, model, basis, report);
	const Stopwatch watch(report.times.basis);
	owned_ = std::make_unique<OwnedParts<Dim>>(*model.processes, basis, faces, *model.division);
	gimpm::complete(owned_->knownNodes(), map, external);
	constrainNodes();
	if (model.water) water_ = model.water(basis, map.isAlone() ? nullptr : &before_[1]);
	makeTerms();
	report.nodes              = int(basis.nodes.size());
	report.dofs               = dofs.count;
	report.populatedCells     = int(basis.populatedLeaves().size());
	report.mixedCells         = countOfMixed(cloud, model, basis);
	report.largestWallOverlap = model.division->largest(basis.largestWallOverlap);
}

template <int Dim> void StepSystem<Dim>::mapFields()
{
	std::vector<Field> fields { { "displacement", "m", Dim } };
	for (const auto& other : model.fields)
		fields.push_back(other.field);
	map = DofMap(int(basis.nodes.size()), std::move(fields));
	constraints.reset(map, basis.affineConstraints);
	before_.resize(map.fields());
}

template <int Dim> void StepSystem<Dim>::constrainNodes()
{
	for (std::size_t n = 0; n < basis.nodes.size(); ++n)
		for (int a = 0; a < Dim; ++a) {
			if (basis.affineConstraints.contains(int(n))) continue;
			if (!isStill_.empty() && isStill_[n]) constraints.prescribe(int(Dim * n + a), 0);
			else if (const auto* box = model.boundary.constrainingBox(basis.nodes[n], a)) {
				const int    number = int(box - model.boundary.boxes().data());
				const auto   moves  = load.boxMotion.find(number);
				const double motion = moves == load.boxMotion.end() ? 0 : moves->second[a];
				constraints.prescribe(int(Dim * n + a), load.ofBox(number).growth * box->displacement[a] + motion);
			} else
				constraints.free(int(Dim * n + a));
		}
	for (int f = 1; f < map.fields(); ++f)
		constrainField(f, model.fields[f - 1].begin(cloud, basis, model.grid));
	constraints.template distribute<Dim>(map, constraints.prescribed);
	if (!map.isAlone()) ofDisplacements_ = constraints.ofDisplacements(map);
}

template <int Dim> void StepSystem<Dim>::fixNodes(const std::vector<int>& nodes)
{
	isStill_.assign(basis.nodes.size(), false);
	for (const int node : nodes)
		isStill_[node] = true;
	constraints.reset(map, basis.affineConstraints);
	constrainNodes();
}

template <int Dim> void StepSystem<Dim>::constrainField(int field, const FieldStart& start)
{
	Eigen::VectorXd before = Eigen::VectorXd::Zero(map.size());
	map.of(field, before)  = start.before;
	gimpm::complete(owned_->knownNodes(), map, before); // start value, which may be a sum over points
	constraints.template distribute<Dim>(map, before);
	before_[field] = map.of(field, before);
	for (int n = 0; n < map.nodes(); ++n)
		for (int i = map.at(field, n); i < map.at(field, n + 1) && !basis.affineConstraints.contains(n); ++i)
			if (const auto given = start.prescribed.find(i - map.begin(field)); given != start.prescribed.end())
				constraints.prescribe(i, given->second - before[i]);
			else
				constraints.free(i);
}

/// The terms that processes share.
template <int Dim> void StepSystem<Dim>::resistPoints()
{
	const auto& colours = owned_->colours();
	if (model.atMiddle) terms.push_back(std::make_unique<InternalForceAtMiddle<Dim>>(basis, colours, points, model.materials));
	else
		terms.push_back(std::make_unique<InternalForce<Dim>>(basis, colours, points, model.materials));
	isStabilised_ = !faces.empty();
	if (isStabilised_) terms.push_back(std::make_unique<GhostForce<Dim>>(owned_->faces(), model.grid.cellSize, ghostReference));
}

template <int Dim> void StepSystem<Dim>::makeTerms()
{
	resistPoints();
	for (const auto& [box, wall] : model.walls)
		terms.push_back(std::make_unique<WallForce<Dim>>(*wall, basis, stiffnessOf_, model.grid, *model.division));
	imbalance_ = [this, earlier = load.before()] {
		Eigen::VectorXd before = Eigen::VectorXd::Zero(nodalSize()), resistance = before;
		addPointForces(basis, pointForces(cloud, model, earlier), before);
		for (const auto& term : terms)
			term->addBefore(resistance);
		if (isCoupled()) addCoupledBefore(resistance);
		ownedNodes().complete(resistance);
		complete(before);
		Eigen::VectorXd imbalance = before - resistance;
		basis.affineConstraints.template condense<Dim>(imbalance);
		return imbalance;
	};
	for (const auto& make : model.coupledTerms) { // inertia knows their imbalance
		auto term = make(context(), state(Eigen::VectorXd::Zero(map.size())));
		coupled_.push_back(term.get());
		terms.push_back(std::move(term));
	}
	for (const auto& make : model.terms)
		terms.push_back(make(context()));
	if (!model.inertia) return;
	auto made         = model.inertia(context());
	inertialPredictor = prescribed, map.of(0, inertialPredictor) = made->inertialPredictor();
	inertia = made.get();
	terms.push_back(std::move(made));
}

template <int Dim> std::string StepSystem<Dim>::obstacle() const
{
	if (!map.isAlone() && coupled_.empty()) return "no term is for the field '" + map[1].name + "'";
	return "";
}

template <int Dim> void StepSystem<Dim>::prepare(NodeMatrix<Dim>& K, Couplings* couplingBlocks) const
{
	K.reset(basis.nodes, isSymmetric(), model.grid, ownedNodes().range());
	for (const auto& term : terms)
		term->mark(K);
	if (!couplingBlocks || !isCoupled()) return;
	couplingBlocks->reset(map, isSymmetric());
	for (const auto* term : coupled_)
		term->markCouplings(*couplingBlocks);
}

template <int Dim> std::optional<PointFailure> StepSystem<Dim>::addTerms(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum) const
{
	std::optional<PointFailure> failure;
	for (auto term = terms.begin(); term != terms.end() && !failure; ++term)
		failure = (*term)->add(d, sum);
	return failure;
}

/// The other terms first: where points fail there is no state to couple.
template <int Dim>
std::optional<PointFailure> StepSystem<Dim>::addCoupled(
        const Eigen::VectorXd& d, Eigen::VectorXd& force, NodeMatrix<Dim>* K, Eigen::VectorXd* absoluteContributions, Couplings* couplingBlocks) const
{
	const State at     = state(d);
	auto        forces = map.zeros(), parts = forces;
	if (couplingBlocks) couplingBlocks->setZero();
	auto                failure = addTerms(at.displacements(), { forces[0], K, absoluteContributions ? &parts[0] : nullptr });
	const FieldSum<Dim> sum { forces, parts, K, couplingBlocks };
	for (auto term = coupled_.begin(); term != coupled_.end() && !failure; ++term)
		failure = (*term)->addCoupled(at, sum);
	force = map.joined(forces);
	if (absoluteContributions) *absoluteContributions = map.joined(parts);
	return failure;
}

/// Forces on the nodes of the other terms, as the step begins.
template <int Dim> void StepSystem<Dim>::addCoupledBefore(Eigen::VectorXd& resistance) const
{
	auto forces = map.zeros(), absoluteContributions = forces;
	for (const auto* term : coupled_)
		term->addCoupledBefore(state(Eigen::VectorXd::Zero(map.size())), { forces, absoluteContributions });
	resistance += forces[0];
}

template <int Dim>
std::optional<PointFailure> StepSystem<Dim>::evaluate(
        const Eigen::VectorXd& d, Eigen::VectorXd& force, NodeMatrix<Dim>* K, Eigen::VectorXd* absoluteContributions, Couplings* couplingBlocks) const
{
	force = Eigen::VectorXd::Zero(map.size());
	if (K) K->setZero();
	if (absoluteContributions) *absoluteContributions = force;
	std::optional<PointFailure> failure
	        = isCoupled() ? addCoupled(d, force, K, absoluteContributions, couplingBlocks) : addTerms(d, { force, K, absoluteContributions });
	constraints.template condense<Dim>(map, force);
	if (absoluteContributions) constraints.template condense<Dim>(map, *absoluteContributions);
	failure = owned_->firstOf(failure);
	completeForces(force); // those of a failure are reported, by all alike
	if (absoluteContributions && !failure) completeForces(*absoluteContributions);
	return failure;
}

template <int Dim> Eigen::VectorXd StepSystem<Dim>::sumOf(std::size_t first, std::size_t count, const Eigen::VectorXd& d) const
{
	Eigen::VectorXd force = Eigen::VectorXd::Zero(nodalSize());
	for (std::size_t i = first; i < first + count; ++i)
		terms[i]->add(d, { force });
	return completed(std::move(force));
}

/// Forces of tied nodes are given to their masters, and each process gets the rows of the others.
template <int Dim> Eigen::VectorXd StepSystem<Dim>::completed(Eigen::VectorXd force) const
{
	constraints.template condense<Dim>(map, force);
	completeForces(force);
	return force;
}

/// Term::add() of a coupled term adds nothing: its forces come from addCoupled().
template <int Dim> Eigen::VectorXd StepSystem<Dim>::otherForces(const Eigen::VectorXd& d) const
{
	const std::size_t first  = 1 + isStabilised_;
	auto              forces = map.zeros(), absoluteContributions = forces;
	for (const auto* term : coupled_)
		term->addCoupled(state(d), { forces, absoluteContributions });
	return sumOf(first, terms.size() - first, d) + completed(forces[0]);
}

template <int Dim> bool StepSystem<Dim>::isSymmetric() const
{
	return std::all_of(terms.begin(), terms.end(), [](const auto& term) { return term->isSymmetric(); });
}

template <int Dim> bool StepSystem<Dim>::makeExact() const
{
	bool hasChanged = false;
	for (auto* term : coupled_)
		hasChanged |= term->makeExact();
	return hasChanged;
}

template <int Dim> std::optional<FieldGrowth> StepSystem<Dim>::expected() const
{
	for (const auto* term : coupled_)
		if (auto growth = term->expected()) return growth;
	return std::nullopt;
}

template <int Dim> double StepSystem<Dim>::fromOutside(const Eigen::VectorXd& d) const
{
	double squares = 0;
	for (const auto& term : terms)
		squares += std::pow(term->fromOutside(d), 2);
	return std::sqrt(squares);
}

template <int Dim> Eigen::VectorXd StepSystem<Dim>::roundOff(const Eigen::VectorXd& d) const
{
	const Eigen::VectorXd displacements         = map.displacements(d);
	Eigen::VectorXd       absoluteContributions = Eigen::VectorXd::Zero(nodalSize());
	if (inertia) inertia->addRoundOff(displacements, absoluteContributions);
	if (isCoupled()) {
		auto blocks = map.zeros();
		blocks[0]   = absoluteContributions;
		for (const auto* term : coupled_)
			term->addCoupledRoundOff(state(d), blocks);
		absoluteContributions = map.joined(blocks);
	}
	constraints.template condense<Dim>(map, absoluteContributions);
	if (isCoupled()) completeForces(absoluteContributions);
	return absoluteContributions;
}

template <int Dim> void StepSystem<Dim>::commit(const Eigen::VectorXd& d) const
{
	// The sum of the terms of another field vanishes except where values are prescribed.
	Eigen::VectorXd force  = Eigen::VectorXd::Zero(map.size());
	const auto      others = dofs.number.begin() + map.end(0);
	if (std::any_of(others, others + (map.size() - map.end(0)), [](int number) { return number < 0; })) evaluate(d, force, nullptr); // before terms go on
	const State at = state(d);
	for (const auto& term : terms)
		term->commit(at.displacements());
	for (auto* term : coupled_)
		term->commitCoupled(at);
	for (int f = 1; f < map.fields(); ++f)
		if (const auto& commit = model.fields[f - 1].commit) commit(basis, at.value(f), map.of(f, force));
}

template std::vector<Vec<2>> pointForces(const PointCloud<2>&, const Model<2>&, const Load<2>&);
template std::vector<Vec<3>> pointForces(const PointCloud<3>&, const Model<3>&, const Load<3>&);
template struct StepSystem<2>;
template struct StepSystem<3>;

} // namespace gimpm
