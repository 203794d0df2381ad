// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/ground_edge.hpp"
#include "core/solvers/least_squares.hpp"
#include "core/terms/attach_surface.hpp"
#include "core/terms/attached.hpp"
#include <sstream>

namespace gimpm {
namespace {

/// Numbers of the nodes of attachments, each once.
template <int Dim> std::vector<int> nodesOf(const std::vector<Attachment<Dim>>& attached)
{
	constexpr double little = 1e-9; // a vertex on a line of the grid has no part in what lies beside that, but for round-off
	std::vector<int> nodes;
	for (const auto& at : attached)
		for (int n = 0; n < at.nodes; ++n)
			if (std::abs(at.weight[n]) > little) nodes.push_back(at.node[n]);
	std::sort(nodes.begin(), nodes.end());
	nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
	return nodes;
}

} // namespace

template <int Dim> EdgeDrag<Dim>::EdgeDrag(GroundEdge<Dim>& edge, const StepContext<Dim>& step) : edge_(edge)
{
	auto attached = attachVertices(edge_.surface, step, edge_.name);
	attached_     = std::move(attached.positions);
	obstacle_     = std::move(attached.obstacle);
	if (obstacle_.empty() && !edge_.hasBegun) obstacle_ = takeOver(step);
}

/// Forces on the vertices which at the nodes are those that have held these, the least ones in the sense of squares.
template <int Dim> std::string EdgeDrag<Dim>::takeOver(const StepContext<Dim>& step)
{
	constexpr double tolerance = 1e-6;
	edge_.borne.assign(attached_.size(), Vec<Dim>::Zero());
	if (!edge_.acts) return {};
	const Eigen::VectorXd imbalance = step.imbalance();
	for (int axis = 0; axis < Dim; ++axis) {
		std::vector<int> nodes = nodesOf(attached_);
		nodes.erase(std::remove_if(nodes.begin(), nodes.end(), [&](int n) { return step.dofs.number[Dim * n + axis] < 0; }), nodes.end());
		if (nodes.empty()) continue;
		Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(nodes.size(), attached_.size());
		Eigen::VectorXd held(nodes.size());
		for (std::size_t v = 0; v < attached_.size(); ++v)
			for (int n = 0; n < attached_[v].nodes; ++n) {
				const auto at = std::lower_bound(nodes.begin(), nodes.end(), attached_[v].node[n]);
				if (at != nodes.end() && *at == attached_[v].node[n]) weights(at - nodes.begin(), v) += attached_[v].weight[n];
			}
		for (std::size_t n = 0; n < nodes.size(); ++n)
			held[n] = -imbalance[Dim * nodes[n] + axis];
		const Eigen::VectorXd found = leastSquares(weights, held);
		const double          left = (weights * found - held).norm(), most = tolerance * std::max(held.norm(), imbalance.norm());
		if (!(left <= most)) {
			std::ostringstream text;
			text << edge_.name << " cannot take over what has held the body there: " << left << " N of " << held.norm() << " N along "
			     << "xyz"[axis] << " act on nodes beside its surface, which has to lie on the nodes that were held";
			return text.str();
		}
		for (std::size_t v = 0; v < attached_.size(); ++v)
			edge_.borne[v][axis] = found[v];
	}
	return {};
}

template <int Dim> void EdgeDrag<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (const auto& at : attached_)
		markAttached(at, at, K);
}

template <int Dim> Vec<Dim> EdgeDrag<Dim>::forceAt(std::size_t v, const Vec<Dim>& velocity, const GroundMotion<Dim>& ground) const
{
	return edge_.drag[v] * (ground.velocity[v] - velocity) + ground.force[v] + edge_.borne[v];
}

template <int Dim> void EdgeDrag<Dim>::add(const Eigen::VectorXd& v, double velocityDerivative, const AssembledTerms<Dim>& sum) const
{
	for (std::size_t i = 0; i < attached_.size() && edge_.acts; ++i) {
		const auto&    at       = attached_[i];
		const Vec<Dim> velocity = at.displacement(v), force = forceAt(i, velocity, edge_.now);
		addAttachedForce<Dim>(at, force, { sum.force });
		if (sum.K) addAttachedStiffness<Dim>(at, at, -velocityDerivative * edge_.drag[i], *sum.K);
		if (!sum.absoluteContributions) continue;
		const Vec<Dim> size = (edge_.drag[i] * velocity).cwiseAbs() + (edge_.drag[i] * edge_.now.velocity[i]).cwiseAbs() + edge_.now.force[i].cwiseAbs()
		        + edge_.borne[i].cwiseAbs();
		for (int n = 0; n < at.nodes; ++n)
			sum.absoluteContributions->template segment<Dim>(Dim * at.node[n]) += std::abs(at.weight[n]) * size;
	}
}

template <int Dim> void EdgeDrag<Dim>::addBefore(const Eigen::VectorXd& v, Eigen::VectorXd& force) const
{
	for (std::size_t i = 0; i < attached_.size() && edge_.acts && obstacle_.empty(); ++i)
		addAttachedForce<Dim>(attached_[i], forceAt(i, attached_[i].displacement(v), edge_.before), { force });
}

template <int Dim> void EdgeDrag<Dim>::addBorne(Eigen::VectorXd& force) const
{
	for (std::size_t i = 0; i < attached_.size() && edge_.acts && obstacle_.empty(); ++i)
		addAttachedForce<Dim>(attached_[i], edge_.borne[i], { force });
}

template <int Dim> double EdgeDrag<Dim>::fromOutside(const Eigen::VectorXd& v) const
{
	Eigen::VectorXd force = Eigen::VectorXd::Zero(v.size());
	add(v, 0, { force });
	return force.norm();
}

template <int Dim> void EdgeDrag<Dim>::commit(const Eigen::VectorXd& d, const Eigen::VectorXd& before, const Eigen::VectorXd& now)
{
	edge_.hasBegun = true;
	edge_.work     = -this->workTaken(d, before, now);
	edge_.force.setZero();
	edge_.velocity.resize(attached_.size());
	for (std::size_t i = 0; i < attached_.size(); ++i) {
		edge_.velocity[i] = attached_[i].displacement(now);
		if (edge_.acts) edge_.force += forceAt(i, edge_.velocity[i], edge_.now);
		edge_.surface.vertices[i] += attached_[i].displacement(d);
	}
}

template <int Dim> EdgeSprings<Dim>::EdgeSprings(GroundEdge<Dim>& edge, const StepContext<Dim>& step) : edge_(edge)
{
	auto attached = attachVertices(edge_.surface, step, edge_.name);
	attached_     = std::move(attached.positions);
	obstacle_     = std::move(attached.obstacle);
}

template <int Dim> void EdgeSprings<Dim>::mark(NodeMatrix<Dim>& K) const
{
	for (const auto& at : attached_)
		markAttached(at, at, K);
}

template <int Dim> Vec<Dim> EdgeSprings<Dim>::forceAt(std::size_t v, const Vec<Dim>& moved, const GroundMotion<Dim>& ground) const
{
	return edge_.stiffness[v] * (ground.displacement[v] - (edge_.surface.vertices[v] - edge_.surface.vertices0[v] + moved));
}

template <int Dim> std::optional<PointFailure> EdgeSprings<Dim>::add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum)
{
	for (std::size_t i = 0; i < attached_.size(); ++i) {
		addAttachedForce(attached_[i], forceAt(i, share() * attached_[i].displacement(d), edge_.now), sum);
		if (sum.K) addAttachedStiffness<Dim>(attached_[i], attached_[i], -share() * edge_.stiffness[i], *sum.K);
	}
	return std::nullopt;
}

template <int Dim> void EdgeSprings<Dim>::addBefore(Eigen::VectorXd& force)
{
	for (std::size_t i = 0; i < attached_.size() && obstacle_.empty(); ++i)
		addAttachedForce<Dim>(attached_[i], forceAt(i, Vec<Dim>::Zero(), edge_.before), { force });
}

template <int Dim> void EdgeSprings<Dim>::restrain(const typename Term<Dim>::Constrain& constrain)
{
	for (const auto& at : attached_)
		for (int axis = 0; axis < Dim; ++axis)
			constrain(at.node[0], Vec<Dim>::Unit(axis), at.inCell());
}

template <int Dim> void EdgeSprings<Dim>::commit(const Eigen::VectorXd& d)
{
	edge_.springWork = 0;
	edge_.springForce.setZero();
	for (std::size_t i = 0; i < attached_.size(); ++i) {
		const Vec<Dim> moved = attached_[i].displacement(d), first = forceAt(i, Vec<Dim>::Zero(), edge_.before),
		               last = forceAt(i, share() * moved, edge_.now);
		edge_.springForce += last;
		edge_.springWork += moved.dot(edge_.atMiddle ? last : Vec<Dim>((first + last) / 2));
	}
}

template class EdgeDrag<2>;
template class EdgeDrag<3>;
template class EdgeSprings<2>;
template class EdgeSprings<3>;

} // namespace gimpm
