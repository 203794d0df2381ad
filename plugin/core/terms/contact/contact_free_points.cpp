// SPDX-License-Identifier: GPL-2.0-or-later
// Contact with bodies that move freely in the step.
#include "core/base/sentence.hpp"
#include "core/terms/contact/contact.hpp"
#include "core/terms/contact/contact_turn.hpp"
#include <algorithm>
#include <map>

namespace gimpm {
namespace {

/// Derivatives at a node: forces there by the body's motion, and the body's balance by the displacement there.
template <int Dim> struct AtNode {
	Eigen::Matrix<double, Dim, FreeBody<Dim>::unknowns> forces;
	Eigen::Matrix<double, FreeBody<Dim>::unknowns, Dim> moves;

	AtNode() { forces.setZero(), moves.setZero(); }
};

} // namespace

template <int Dim> typename Contact<Dim>::Moved Contact<Dim>::moved(const ContactPoint& contactPoint) const
{
	const auto& body = system_.bodies[contactPoint.body];
	if (body.free < 0) return { contactPoint.carried, contactPoint.normal, contactPoint.tangentialForce };
	const Mat<Dim> turn = body.end.rotation * body.begin.rotation.transpose();
	return { body.carried(contactPoint.soil), turn * contactPoint.normal, turn * contactPoint.tangentialForce };
}

/// Puts all bodies of the owner where this motion brings them.
template <int Dim> void Contact<Dim>::moveBodies(int number, const typename FreeBody<Dim>::Vector& motion)
{
	const auto&    free     = system_.free[number];
	const Vec<Dim> position = free.position + motion.template head<Dim>();
	const Mat<Dim> turn     = rotationOf(Turn<Dim>(motion.template tail<Turn<Dim>::RowsAtCompileTime>()));
	for (auto& body : system_.bodies)
		if (body.free == number) body.end = { position + turn * (body.begin.position - free.position), turn * body.begin.rotation };
	system_.owners[free.owner] = position;
}

template <int Dim> std::vector<const typename Contact<Dim>::ContactPoint*> Contact<Dim>::contactPointsOfFree(int number) const
{
	std::vector<const ContactPoint*> found;
	for (const ContactPoint& contactPoint : contactPoints_)
		if (system_.bodies[contactPoint.body].free == number) found.push_back(&contactPoint);
	return found;
}

template <int Dim> FreeContactPoint<Dim> Contact<Dim>::seen(const ContactPoint& contactPoint, const Vec<Dim>& owner, const Eigen::VectorXd& d) const
{
	const Approach<Dim> near    = approach(contactPoint, d);
	const auto          touched = touch(contactPoint.law, near, tolerance_);
	const Vec<Dim>      arm     = pointOfForce(contactPoint, contactPoint.soil + contactPoint.distribution.displacement(d), near.at.normal) - owner;
	if (!touched) return { arm, Vec<Dim>::Zero(), Mat<Dim>::Zero(), near.at.gap, near.at.normal };
	return { arm, touched->force(), touched->tangent, near.at.gap, near.at.normal };
}

/// Length by which a turn is compared with a displacement [m].
template <int Dim> double Contact<Dim>::sizeOfFree(int number) const
{
	double size = grid_.cellSize;
	for (const auto& body : system_.bodies) {
		if (body.free != number) continue;
		const auto [low, high] = body.bounds(body.begin);
		if ((high - low).allFinite()) size = std::max(size, (high - low).norm() / 2);
	}
	return size;
}

/// At each iterate of the soil's displacements free bodies are in balance with it as it is there.
template <int Dim> void Contact<Dim>::solveRigidBodyMotion(const Eigen::VectorXd& d)
{
	if (system_.free.empty() || (solvedAt_.size() == d.size() && solvedAt_ == d)) return;
	for (int number = 0; number < int(system_.free.size()); ++number) {
		const auto contactPoints = contactPointsOfFree(number);
		auto&      free          = system_.free[number];
		const auto look          = [&](const typename FreeBody<Dim>::Vector& motion) {
                        moveBodies(number, motion);
                        std::vector<FreeContactPoint<Dim>> found;
                        for (const ContactPoint* contactPoint : contactPoints)
                                found.push_back(seen(*contactPoint, system_.owners[free.owner], d));
                        return found;
		};
		gimpm::solveRigidBodyMotion<Dim>(free, sizeOfFree(number), look);
	}
	solvedAt_ = d;
}

template <int Dim> void Contact<Dim>::markFree(Couplings& K) const
{
	for (int number = 0; number < int(system_.free.size()); ++number) {
		std::vector<int> nodes;
		for (const ContactPoint* contactPoint : contactPointsOfFree(number))
			nodes.insert(
			        nodes.end(), contactPoint->distribution.node.begin(),
			        contactPoint->distribution.node.begin() + contactPoint->distribution.nodes);
		std::sort(nodes.begin(), nodes.end());
		nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
		for (const int a : nodes)
			for (const int b : nodes)
				if (a <= b) K.mark({ 0, a }, { 0, b });
	}
}

/// A product of three small matrices for any two nodes: those of the motion by the soil at one, and of the forces at
/// the
/// other by the motion, with the compliance of the body between them.
template <int Dim> void Contact<Dim>::addFree(const Eigen::VectorXd& d, Couplings& K)
{
	constexpr int unknowns = FreeBody<Dim>::unknowns;
	solveRigidBodyMotion(d);
	for (int number = 0; number < int(system_.free.size()); ++number) {
		const auto&                        free = system_.free[number];
		std::vector<FreeContactPoint<Dim>> all;
		std::map<int, AtNode<Dim>>         nodes;
		for (const ContactPoint* contactPoint : contactPointsOfFree(number)) {
			all.push_back(seen(*contactPoint, system_.owners[free.owner], d));
			if (all.back().tangent.isZero(0)) continue;
			const RigidBodyJacobian<Dim> jacobian(all.back());
			for (int n = 0; n < contactPoint->distribution.nodes; ++n) {
				AtNode<Dim>& node = nodes[contactPoint->distribution.node[n]];
				node.forces += contactPoint->distribution.weight[n] * jacobian.forceByBody(all.back().tangent);
				node.moves += contactPoint->distribution.weight[n] * jacobian.bodyByPosition(all.back().tangent);
			}
		}
		const typename FreeBody<Dim>::Matrix yields = incrementsOf<Dim>(free.motion) * compliance(free, sizeOfFree(number), all);
		for (const auto& [a, from] : nodes) {
			const Eigen::Matrix<double, Dim, unknowns> left = system_.weight * from.forces * yields;
			for (const auto& [b, to] : nodes)
				K.add({ 0, a }, { 0, b }, Mat<Dim>(left * to.moves));
		}
	}
}

template <int Dim> std::string Contact<Dim>::unbalanced() const
{
	for (const auto& free : system_.free) {
		if (free.isAtRest) continue;
		for (const auto& body : system_.bodies)
			if (body.free >= 0 && body.owner == free.owner)
				return sentence(body.name, " finds no balance with the soil that it touches: ", free.imbalance, " of the forces on it is left");
	}
	return "";
}

template typename Contact<2>::Moved Contact<2>::moved(const ContactPoint&) const;
template typename Contact<3>::Moved Contact<3>::moved(const ContactPoint&) const;
template void                       Contact<2>::solveRigidBodyMotion(const Eigen::VectorXd&);
template void                       Contact<3>::solveRigidBodyMotion(const Eigen::VectorXd&);
template void                       Contact<2>::markFree(Couplings&) const;
template void                       Contact<3>::markFree(Couplings&) const;
template void                       Contact<2>::addFree(const Eigen::VectorXd&, Couplings&);
template void                       Contact<3>::addFree(const Eigen::VectorXd&, Couplings&);
template std::string                Contact<2>::unbalanced() const;
template std::string                Contact<3>::unbalanced() const;

} // namespace gimpm
