// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/step_system.hpp"
#include "core/base/stopwatch.hpp"
#include "core/grid/mixed_cells.hpp"
#include "core/terms/at_middle.hpp"
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
	return faces;
}

template <int Dim> int countOfMixed(const PointCloud<Dim>& cloud, const Model<Dim>& model, const CloudBasis<Dim>& basis)
{
	const auto mixed = mixedCells(basis, cloud.material);
	const auto count = [&](std::size_t first, std::size_t last) { return int(std::count(mixed.begin() + first, mixed.begin() + last, true)); };
	if (!model.division) return count(0, mixed.size());
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
StepSystem<Dim>::StepSystem(const PointCloud<Dim>& cloud, const Model<Dim>& m, const Load<Dim>& load, StepReport& report)
        : model(m), cloud_(cloud), stiffnessOf_(stiffnessOf(cloud, m))
{
	{
		const Stopwatch watch(report.times.basis);
		basis  = model.division ? cloudBasis(cloud, model.grid, model.basis, model.boundary, *model.division)
		                        : cloudBasis(cloud, model.grid, model.basis, model.boundary);
		points = stepPoints(cloud, model.materials, basis, model.fBar);
		if (model.division) points.isSymmetric = model.division->largest(points.isSymmetric ? 0 : 1) == 0; // also for points that others have
		external = Eigen::VectorXd::Zero(nodalSize());
		addPointForces(basis, pointForces(cloud, model, load), external);
		basis.ties.template fold<Dim>(external);
	}
	faces = stabilise(stiffnessOf_, model, basis, report);
	const Stopwatch watch(report.times.basis);
	if (model.processes) share_ = std::make_unique<Share<Dim>>(*model.processes, basis, faces, model.division.get());
	complete(external);
	holdNodes(load);
	makeTerms(load);
	report.nodes              = int(basis.nodes.size());
	report.dofs               = dofs.count;
	report.populatedCells     = int(basis.populatedLeaves().size());
	report.mixedCells         = countOfMixed(cloud, model, basis);
	report.largestWallOverlap = model.division ? model.division->largest(basis.largestWallOverlap) : basis.largestWallOverlap;
}

template <int Dim> void StepSystem<Dim>::holdNodes(const Load<Dim>& load)
{
	prescribed = Eigen::VectorXd::Zero(nodalSize());
	dofs.number.assign(nodalSize(), -1);
	dofs.ties = basis.ties.empty() ? nullptr : &basis.ties;
	for (std::size_t n = 0; n < basis.nodes.size(); ++n)
		for (int a = 0; a < Dim; ++a) {
			if (basis.ties.contains(int(n))) continue;
			if (const auto* box = model.boundary.holder(Grid<Dim>::index(basis.nodes[n]), a)) {
				const int  number = int(box - model.boundary.boxes().data());
				const auto moves  = load.boxMotion.find(number);
				prescribed[Dim * n + a]
				        = load.ofBox(number).growth * box->displacement[a] + (moves == load.boxMotion.end() ? 0 : moves->second[a]);
			} else
				dofs.number[Dim * n + a] = dofs.count++;
		}
	basis.ties.template spread<Dim>(prescribed);
}

/// The terms that processes share.
template <int Dim> void StepSystem<Dim>::resistPoints()
{
	const auto& colours = share_ ? share_->colours() : basis.colours;
	if (model.atMiddle) terms.push_back(std::make_unique<InternalForceAtMiddle<Dim>>(basis, colours, points, model.materials));
	else
		terms.push_back(std::make_unique<InternalForce<Dim>>(basis, colours, points, model.materials));
	if (!faces.empty()) terms.push_back(std::make_unique<GhostForce<Dim>>(share_ ? share_->faces() : faces, model.grid.cellSize));
}

template <int Dim> void StepSystem<Dim>::makeTerms(const Load<Dim>& load)
{
	resistPoints();
	for (const auto& [box, wall] : model.walls)
		terms.push_back(std::make_unique<WallForce<Dim>>(*wall, basis, stiffnessOf_, model.grid, model.division.get()));
	imbalance_ = [this, earlier = load.before()] {
		Eigen::VectorXd before = Eigen::VectorXd::Zero(nodalSize()), resistance = before;
		addPointForces(basis, pointForces(cloud_, model, earlier), before);
		for (const auto& term : terms)
			term->addBefore(resistance);
		if (share_) share_->nodes().complete(resistance);
		complete(before);
		return Eigen::VectorXd(before - resistance);
	};
	for (const auto& make : model.terms)
		terms.push_back(make(beginning()));
	for (const auto& term : terms)
		if (auto d = term->ownMotion(); d.size() > 0) ownMotion = std::move(d);
}

template <int Dim> void StepSystem<Dim>::prepare(NodeMatrix<Dim>& K) const
{
	if (share()) K.reset(basis.nodes, isSymmetric(), model.grid, { share()->first(), share()->last() });
	else
		K.reset(basis.nodes, isSymmetric(), model.grid);
	for (const auto& term : terms)
		term->mark(K);
}

template <int Dim> LinearProblem StepSystem<Dim>::tangent() const
{
	NodeMatrix<Dim> K;
	tangent(K);
	return reduced(K, dofs);
}

template <int Dim> std::optional<PointFailure> StepSystem<Dim>::tangent(NodeMatrix<Dim>& K) const
{
	Eigen::VectorXd force;
	prepare(K);
	return evaluate(Eigen::VectorXd::Zero(nodalSize()), force, &K);
}

template <int Dim>
std::optional<PointFailure> StepSystem<Dim>::evaluate(const Eigen::VectorXd& d, Eigen::VectorXd& force, NodeMatrix<Dim>* K, Eigen::VectorXd* sizes) const
{
	force = Eigen::VectorXd::Zero(nodalSize());
	if (K) K->setZero();
	if (sizes) *sizes = force;
	std::optional<PointFailure> failure;
	for (auto term = terms.begin(); term != terms.end() && !failure; ++term)
		failure = (*term)->add(d, { force, K, sizes });
	basis.ties.template fold<Dim>(force);
	if (sizes) basis.ties.template fold<Dim>(*sizes);
	if (!share_) return failure;
	failure = share_->firstOf(failure);
	share_->nodes().complete(force); // those of a failure are reported, by all alike
	if (sizes && !failure) share_->nodes().complete(*sizes);
	return failure;
}

template <int Dim> bool StepSystem<Dim>::isSymmetric() const
{
	return std::all_of(terms.begin(), terms.end(), [](const auto& term) { return term->isSymmetric(); });
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
	Eigen::VectorXd sizes = Eigen::VectorXd::Zero(nodalSize());
	for (const auto& term : terms)
		term->addRoundOff(d, sizes);
	basis.ties.template fold<Dim>(sizes);
	return sizes;
}

template std::vector<Vec<2>> pointForces(const PointCloud<2>&, const Model<2>&, const Load<2>&);
template std::vector<Vec<3>> pointForces(const PointCloud<3>&, const Model<3>&, const Load<3>&);
template struct StepSystem<2>;
template struct StepSystem<3>;

} // namespace gimpm
