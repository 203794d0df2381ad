// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/bodies/body_contact.hpp"
#include "core/terms/attached.hpp"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace gimpm {
namespace {

/// Pieces are seen by contact points with a normal at more than some 80 degrees from theirs.
constexpr double facing = 0.2;

/// The same of pieces of a fold, whose surface may be rough.
constexpr double facingInFold = -0.3;

/// Distance by which a contact point may get beyond a side of the piece that it began the step with, over the cell
/// size.
constexpr double beyondPiece = 0.125;

} // namespace

template <int Dim> auto BodyContact<Dim>::positionsAt(const Eigen::VectorXd& d) const -> Positions
{
	Positions positions;
	for (const auto& facets : facets_)
		positions.push_back(facets.positionsAt(d));
	return positions;
}

template <int Dim> PairPositions<Dim> BodyContact<Dim>::pair(const Vec<Dim>& position, int body, int piece, const Positions& positions) const
{
	PairPositions<Dim> x;
	x[0] = position;
	for (int v = 0; v < Dim; ++v)
		x[v + 1] = positions[body][facets_[body].pieces[piece][v]];
	return x;
}

/// The contact point goes on with what the foot moves less than the vertices.
template <int Dim>
PairPositions<Dim> BodyContact<Dim>::pairNow(const ContactPoint& contactPoint, const Near& near, const Eigen::VectorXd& d, const Positions& now) const
{
	const int          master = meetingOf(contactPoint).master;
	PairPositions<Dim> x = pair(contactPoint.start, master, near.piece, now), start = pair(contactPoint.start, master, near.piece, start_);
	x[0] += contactPoint.at.displacement(d) - near.foot.displacement(d);
	for (int v = 0; v < Dim; ++v)
		x[0] += near.weight[v] * (x[v + 1] - start[v + 1]);
	return x;
}

/// The contact points at displacements d; without these, where the step begins.
template <int Dim>
PairPositions<Dim> BodyContact<Dim>::pairThen(const ContactPoint& contactPoint, const Near& near, const Eigen::VectorXd* d, const Positions& positions) const
{
	return d ? pairNow(contactPoint, near, *d, positions) : pair(contactPoint.start, meetingOf(contactPoint).master, near.piece, positions);
}

/// The piece that is nearest to where the contact point is, null if that does not face it. At an edge the one behind
/// which the contact point is least.
template <int Dim> auto BodyContact<Dim>::nearestOf(const ContactPoint& contactPoint, const Eigen::VectorXd* d, const Positions& positions) const -> const Near*
{
	const double same  = 1e-12 * cellSize_ * cellSize_;
	double       least = std::numeric_limits<double>::infinity(), gap = 0;
	const Near*  nearest = nullptr;
	Vec<Dim>     normal  = Vec<Dim>::Zero();
	for (const Near& near : contactPoint.near) {
		const auto   x    = pairThen(contactPoint, near, d, positions);
		const double away = squaredDistance(x);
		if (away > least + same) continue;
		const Facing<Dim> at(x);
		if (away > least - same && at.gap < gap) continue;
		least = std::min(least, away), gap = at.gap, nearest = &near, normal = at.normal;
	}
	return nearest && normal.dot(contactPoint.normal) < (isFold(meetingOf(contactPoint)) ? facingInFold : facing) ? nearest : nullptr;
}

/// True if the contact point stays before the piece that was nearest as the step began, or before its plane a little
/// beyond its sides. Otherwise pressures would jump between adjacent pieces, whose normals differ, and a body that
/// enters by one side of a corner and is pushed out by the other would gain energy.
template <int Dim> bool BodyContact<Dim>::goesOn(const PairPositions<Dim>& x) const
{
	const Facing<Dim> at(x);
	for (int i = 0; i < Dim; ++i)
		if (at.weight[i] < -beyondPiece * cellSize_ * at.weightGradient[i].norm()) return false;
	return true;
}

/// Calls f with the derivatives if they are wanted.
template <int Dim>
auto BodyContact<Dim>::contactAt(const Eigen::VectorXd& d, PairJacobian kind, const std::function<void(const Touching&, const Tangent&)>& f) const
        -> const ContactState&
{
	if (!f && state_.d.size() == d.size() && state_.d == d) return state_;
	state_.d = d, state_.now = positionsAt(d), state_.touching.clear();
	for (const ContactPoint& contactPoint : contactPoints_) {
		const Near* near    = contactPoint.first;
		auto        end     = near ? pairNow(contactPoint, *near, d, state_.now) : PairPositions<Dim>();
		const Near* nearest = nearestOf(contactPoint, &d, state_.now);
		if (!nearest) continue;
		if (!near || !goesOn(end)) near = nearest, end = pairNow(contactPoint, *near, d, state_.now);
		const auto start = pair(contactPoint.start, meetingOf(contactPoint).master, near->piece, start_);
		const auto force = pairForce<Dim>(contactPoint.law, start, contactPoint.tangentialForce, end, contactPoint.closed, tolerance_, kind);
		if (!force) continue;
		state_.touching.push_back({ contactPoint, *near, *force, end });
		if (f) f(state_.touching.back(), force->tangent);
	}
	return state_;
}

/// The nodes are in the order of their numbers.
template <int Dim> auto BodyContact<Dim>::nodesOf(const ContactPoint& contactPoint, const Near& near) const -> std::vector<PairNode>
{
	std::vector<PairNode> nodes;
	nodes.reserve(4 << Dim);
	const auto add = [&](const Attachment<Dim>& at, int i, double part) {
		for (int n = 0; n < at.nodes; ++n) {
			if (at.weight[n] == 0) continue;
			auto known = std::find_if(nodes.begin(), nodes.end(), [&](const PairNode& other) { return other.node >= at.node[n]; });
			if (known == nodes.end() || known->node != at.node[n]) known = nodes.insert(known, PairNode { at.node[n], {} });
			known->weight[i] += part * at.weight[n];
		}
	};
	const auto& master = facets_[meetingOf(contactPoint).master];
	add(contactPoint.at, 0, 1);
	add(near.foot, 0, -1);
	for (int v = 0; v < Dim; ++v) {
		const auto& at = *master.at[master.pieces[near.piece][v]];
		add(at, 0, near.weight[v]);
		add(at, v + 1, 1);
	}
	return nodes;
}

/// Without friction the derivatives are symmetric as they are.
template <int Dim> bool BodyContact<Dim>::isRough() const
{
	return std::any_of(system_.meetings.begin(), system_.meetings.end(), [](const auto& m) { return m.frictionCoefficient > 0 && m.adhesion > 0; });
}

template <int Dim> bool BodyContact<Dim>::makeExact() { return isRough() && !std::exchange(isExact_, true); }

/// All nodes around a contact point and the pieces near it, as any of these may be the nearest one.
template <int Dim> void BodyContact<Dim>::markNodes(const ContactPoint& contactPoint, std::vector<int>& nodes) const
{
	const auto add = [&](const Attachment<Dim>& at) {
		for (int n = 0; n < at.nodes; ++n)
			if (at.weight[n] != 0 && std::find(nodes.begin(), nodes.end(), at.node[n]) == nodes.end()) nodes.push_back(at.node[n]);
	};
	const auto& master = facets_[meetingOf(contactPoint).master];
	add(contactPoint.at);
	for (const Near& near : contactPoint.near) {
		add(near.foot);
		for (const int v : master.pieces[near.piece])
			add(*master.at[v]);
	}
	std::sort(nodes.begin(), nodes.end());
}

template <int Dim> void BodyContact<Dim>::markCouplings(Couplings& K) const
{
	std::set<std::vector<int>> known; // contact points in one cell have the same nodes
	std::vector<int>           nodes;
	for (const ContactPoint& contactPoint : contactPoints_) {
		nodes.clear();
		markNodes(contactPoint, nodes);
		if (!known.insert(nodes).second) continue;
		for (const int a : nodes)
			for (const int b : nodes)
				if (a <= b) K.mark({ 0, a }, { 0, b });
	}
	for (const auto& passage : passages_)
		passage.mark(K);
}

template <int Dim>
void BodyContact<Dim>::addForces(
        const std::vector<PairNode>& nodes, const PairAction<Dim>& action, double factor, Eigen::VectorXd& force, Eigen::VectorXd* absoluteContributions) const
{
	for (const PairNode& one : nodes) {
		Vec<Dim> f = Vec<Dim>::Zero();
		for (int i = 0; i <= Dim; ++i)
			f += factor * one.weight[i] * action.force[i];
		force.template segment<Dim>(Dim * one.node) -= f;
		if (absoluteContributions) absoluteContributions->template segment<Dim>(Dim * one.node) += f.cwiseAbs();
	}
}

template <int Dim> void BodyContact<Dim>::addTangent(const std::vector<PairNode>& nodes, const Tangent& tangent, double factor, Couplings& K) const
{
	using Block = Eigen::Map<Eigen::Matrix<double, Dim, Dim, Eigen::RowMajor>>;
	std::vector<int>            numbers;
	std::vector<std::ptrdiff_t> positions(nodes.size());
	for (const PairNode& one : nodes)
		numbers.push_back(one.node);
	for (const PairNode& one : nodes) {
		Eigen::Matrix<double, Dim, Tangent::ColsAtCompileTime> row = Eigen::Matrix<double, Dim, Tangent::ColsAtCompileTime>::Zero();
		for (int i = 0; i <= Dim; ++i)
			row -= factor * one.weight[i] * tangent.template middleRows<Dim>(Dim * i);
		K.findOffsets({ 0, one.node }, 0, numbers.data(), int(numbers.size()), positions.data());
		for (std::size_t other = 0; other < nodes.size(); ++other) {
			if (positions[other] < 0) continue;
			Block k(K.values() + positions[other]);
			for (int j = 0; j <= Dim; ++j)
				k += nodes[other].weight[j] * row.template middleCols<Dim>(Dim * j);
		}
	}
}

template <int Dim>
void BodyContact<Dim>::add(
        const Eigen::VectorXd& d, double factor, Eigen::VectorXd& force, Eigen::VectorXd* absoluteContributions, Couplings* K, PairJacobian kind) const
{
	for (const Wedge& wedge : wedges_)
		addForces(nodesOf(*wedge.contactPoint, *wedge.contactPoint->first), wedge.force, factor, force, absoluteContributions);
	if (contactPoints_.empty()) return;
	if (!K) {
		for (const Touching& touching : contactAt(d).touching)
			addForces(nodesOf(touching.contactPoint, touching.near), touching.force, factor, force, absoluteContributions);
		return;
	}
	contactAt(d, kind, [&](const Touching& touching, const Tangent& tangent) {
		const auto nodes = nodesOf(touching.contactPoint, touching.near);
		addForces(nodes, touching.force, factor, force, absoluteContributions);
		addTangent(nodes, tangent, factor, *K);
	});
}

template <int Dim> std::optional<PointFailure> BodyContact<Dim>::addCoupled(const State& state, const FieldSum<Dim>& sum) const
{
	add(state.displacements(), system_.weight, sum.force[0], &sum.absoluteContributions[0], sum.couplings, jacobianKind());
	if (passages_.empty()) return std::nullopt;
	const Eigen::VectorXd P = state.value(Passage<Dim>::field);
	for (const auto& passage : passages_)
		passage.add(P, sum);
	return std::nullopt;
}

template <int Dim> void BodyContact<Dim>::addCoupledBefore(const State&, const FieldSum<Dim>& sum) const { addUnweighted(nullptr, sum.force[0]); }

template <int Dim> void BodyContact<Dim>::addUnweighted(const Eigen::VectorXd* d, Eigen::VectorXd& resistance) const
{
	add(d ? *d : Eigen::VectorXd::Zero(unknowns_), 1, resistance, nullptr, nullptr, PairJacobian::none);
}

template <int Dim> void BodyContact<Dim>::addWithTangent(const Eigen::VectorXd& d, Eigen::VectorXd& resistance, Couplings* K) const
{
	add(d, 1, resistance, nullptr, K, isRough() ? PairJacobian::symmetric : PairJacobian::exact);
}

template <int Dim> void BodyContact<Dim>::constrainAt(const Touching& touching, bool slips, const typename Term<Dim>::Constrain& constrain) const
{
	const Vec<Dim>& normal = Facing<Dim>(touching.now).normal;
	const auto&     master = facets_[meetingOf(touching.contactPoint).master];
	const bool      sticks = !touching.contactPoint.law.isSmooth() && !slips;
	constrainAttached<Dim>(touching.contactPoint.at, normal, sticks, constrain);
	for (const int v : master.pieces[touching.near.piece])
		constrainAttached<Dim>(*master.at[v], normal, sticks, constrain);
}

/// Each as if the other one stood still.
template <int Dim> void BodyContact<Dim>::restrain(const typename Term<Dim>::Constrain& constrain)
{
	for (const Touching& touching : contactAt(Eigen::VectorXd::Zero(unknowns_)).touching)
		constrainAt(touching, false, constrain);
}

template <int Dim> void BodyContact<Dim>::restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Constrain& constrain)
{
	for (const Touching& touching : contactAt(d).touching)
		constrainAt(touching, touching.force.slips, constrain);
}

template class BodyContact<2>;
template class BodyContact<3>;

} // namespace gimpm
