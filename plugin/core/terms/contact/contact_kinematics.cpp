// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact_kinematics.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/contact/contact_nodes.hpp"
#include <map>

namespace gimpm {
namespace {

/// Derivatives at a node: forces there by the body's motion, and the body's balance by the displacement there.
template <int Dim> struct AtNode {
	Eigen::Matrix<double, Dim, FreeBody<Dim>::unknowns> forces = decltype(forces)::Zero();
	Eigen::Matrix<double, FreeBody<Dim>::unknowns, Dim> moves  = decltype(moves)::Zero();
};

/// Puts all bodies of a free owner where this motion brings them.
template <int Dim> void moveBodies(ContactSystem<Dim>& system, int number, const typename FreeBody<Dim>::Vector& motion)
{
	const auto&    free     = system.free[number];
	const Vec<Dim> position = free.position + motion.template head<Dim>();
	const Mat<Dim> turn     = rotationOf(Turn<Dim>(motion.template tail<Turn<Dim>::RowsAtCompileTime>()));
	for (auto& body : system.bodies)
		if (body.free == number) body.end = { position + turn * (body.begin.position - free.position), turn * body.begin.rotation };
	system.owners[free.owner] = position;
}

/// Length by which a turn of a free owner is compared with a displacement [m].
template <int Dim> double sizeOfFree(const ContactSystem<Dim>& system, int number, double cellSize)
{
	double size = cellSize;
	for (const auto& body : system.bodies) {
		if (body.free != number) continue;
		const auto [low, high] = body.bounds(body.begin);
		if ((high - low).allFinite()) size = std::max(size, (high - low).norm() / 2);
	}
	return size;
}

template <int Dim> Mat<Dim> resistanceOf(const ContactPoint<Dim>& at, const Touch<Dim>& touched)
{
	const double along = touched.slips || at.law.isSmooth() ? 0 : at.law.tangentialStiffness;
	return at.law.normalStiffness * touched.normal * touched.normal.transpose()
	        + along * (Mat<Dim>::Identity() - touched.normal * touched.normal.transpose());
}

template <int Dim> ContactLoad loadOn(const Vec<Dim>& owner, const ContactPoint<Dim>& at, const Vec<Dim>& position, const Touch<Dim>& touched, bool isRing)
{
	ContactLoad load;
	Vec3        arm                 = Vec3::Zero();
	load.force.template head<Dim>() = -touched.force();
	arm.template head<Dim>()        = position - owner;
	load.torque                     = arm.cross(load.force);
	if (isRing) load.force[0] = 0, load.torque.setZero(); // all around the axis they add up to nothing
	if constexpr (Dim == 3) {
		Eigen::Matrix<double, 3, 6> moves;
		moves << Mat3::Identity(), turnsArm(arm);
		load.stiffness = moves.transpose() * resistanceOf(at, touched) * moves;
	}
	load.area = at.area, load.young = at.area * at.young;
	return load;
}

} // namespace

template <int Dim>
ContactKinematics<Dim>::ContactKinematics(ContactSystem<Dim>& system, const std::vector<ContactPoint<Dim>>& points, const Grid<Dim>& grid)
        : system_(system), points_(points), tolerance_(contactTolerance(grid.cellSize)), cellSize_(grid.cellSize), isRing_(grid.axisymmetric)
{
}

template <int Dim> Approach<Dim> ContactKinematics<Dim>::approach(const ContactPoint<Dim>& point, const Eigen::VectorXd& d) const
{
	const auto&    body    = system_.bodies[point.body];
	const Vec<Dim> u       = point.distribution.displacement(d);
	Vec<Dim>       carried = point.carried, normal = point.normal, tangentialForce = point.tangentialForce;
	if (body.free >= 0) {
		const Mat<Dim> turn = body.end.rotation * body.begin.rotation.transpose();
		carried = body.carried(point.soil), normal = turn * point.normal, tangentialForce = turn * point.tangentialForce;
	}
	Approach<Dim> a { {}, u - carried, tangentialForce };
	if (body.shape.kind == RigidKind::ball && system_.kind != StepKind::dynamic) {
		a.at = body.proximity(body.end, point.soil + u, 1);
		a.at.gap += point.gap - point.away;
	} else {
		a.at.gap    = point.gap + normal.dot(a.slip);
		a.at.normal = normal;
	}
	return a;
}

/// On a ball: where the normal of its face goes through its centre, around which pressure does not turn it. The soil
/// has slipped from there in a time step.
template <int Dim> Vec<Dim> ContactKinematics<Dim>::pointOfForce(const ContactPoint<Dim>& at, const Vec<Dim>& soil, const Vec<Dim>& normal) const
{
	const auto& body = system_.bodies[at.body];
	if (body.shape.kind != RigidKind::ball || system_.kind != StepKind::dynamic) return soil;
	return body.end.position + (soil - body.end.position).dot(normal) * normal;
}

template <int Dim> void ContactKinematics<Dim>::addLoads(const ContactPoint<Dim>& at, const Vec<Dim>& position, const Touch<Dim>& touched)
{
	const auto& body = system_.bodies[at.body];
	if constexpr (Dim == 3)
		if (body.nodes > 0) {
			const auto loads = loadsOnNodes(body, at.soil, { -touched.force(), position, resistanceOf(at, touched), at.area, at.young });
			for (int i = 0; i < body.nodes; ++i)
				system_.loads[body.nodeOwners[i]] += loads[i];
			return;
		}
	system_.loads[body.owner] += loadOn<Dim>(system_.owners[body.owner], at, pointOfForce(at, position, touched.normal), touched, isRing_);
}

template <int Dim> std::vector<const ContactPoint<Dim>*> ContactKinematics<Dim>::pointsOfFree(int number) const
{
	std::vector<const ContactPoint<Dim>*> found;
	for (const ContactPoint<Dim>& point : points_)
		if (system_.bodies[point.body].free == number) found.push_back(&point);
	return found;
}

template <int Dim> FreeContactPoint<Dim> ContactKinematics<Dim>::seen(const ContactPoint<Dim>& point, const Vec<Dim>& owner, const Eigen::VectorXd& d) const
{
	const Approach<Dim> near    = approach(point, d);
	const auto          touched = touch(point.law, near, tolerance_);
	const Vec<Dim>      arm     = pointOfForce(point, point.soil + point.distribution.displacement(d), near.at.normal) - owner;
	if (!touched) return { arm, Vec<Dim>::Zero(), Mat<Dim>::Zero(), near.at.gap, near.at.normal };
	return { arm, touched->force(), touched->tangent, near.at.gap, near.at.normal };
}

template <int Dim> void ContactKinematics<Dim>::solveRigidBodyMotion(const Eigen::VectorXd& d)
{
	if (system_.free.empty() || (solvedAt_.size() == d.size() && solvedAt_ == d)) return;
	for (int number = 0; number < int(system_.free.size()); ++number) {
		const auto points = pointsOfFree(number);
		auto&      free   = system_.free[number];
		const auto look   = [&](const typename FreeBody<Dim>::Vector& motion) {
                        moveBodies(system_, number, motion);
                        std::vector<FreeContactPoint<Dim>> found;
                        for (const ContactPoint<Dim>* point : points)
                                found.push_back(seen(*point, system_.owners[free.owner], d));
                        return found;
		};
		gimpm::solveRigidBodyMotion<Dim>(free, sizeOfFree(system_, number, cellSize_), look);
	}
	solvedAt_ = d;
}

template <int Dim> void ContactKinematics<Dim>::markFree(Couplings& K) const
{
	for (int number = 0; number < int(system_.free.size()); ++number) {
		std::vector<int> nodes;
		for (const ContactPoint<Dim>* point : pointsOfFree(number))
			nodes.insert(nodes.end(), point->distribution.node.begin(), point->distribution.node.begin() + point->distribution.nodes);
		std::sort(nodes.begin(), nodes.end());
		nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
		for (const int a : nodes)
			for (const int b : nodes)
				if (a <= b) K.mark({ 0, a }, { 0, b });
	}
}

/// A product of three small matrices for any two nodes: those of the motion by the soil at one, and of the forces at
/// the other by the motion, with the compliance of the body between them.
template <int Dim> void ContactKinematics<Dim>::addFree(const Eigen::VectorXd& d, Couplings& K)
{
	constexpr int unknowns = FreeBody<Dim>::unknowns;
	solveRigidBodyMotion(d);
	for (int number = 0; number < int(system_.free.size()); ++number) {
		const auto&                        free = system_.free[number];
		std::vector<FreeContactPoint<Dim>> all;
		std::map<int, AtNode<Dim>>         nodes;
		for (const ContactPoint<Dim>* point : pointsOfFree(number)) {
			const auto& at = all.emplace_back(seen(*point, system_.owners[free.owner], d));
			if (at.tangent.isZero(0)) continue;
			const RigidBodyJacobian<Dim> jacobian(at);
			for (int n = 0; n < point->distribution.nodes; ++n) {
				AtNode<Dim>& node = nodes[point->distribution.node[n]];
				node.forces += point->distribution.weight[n] * jacobian.forceByBody(at.tangent);
				node.moves += point->distribution.weight[n] * jacobian.bodyByPosition(at.tangent);
			}
		}
		const typename FreeBody<Dim>::Matrix yields = incrementsOf<Dim>(free.motion) * compliance(free, sizeOfFree(system_, number, cellSize_), all);
		for (const auto& [a, from] : nodes) {
			const Eigen::Matrix<double, Dim, unknowns> left = system_.weight * from.forces * yields;
			for (const auto& [b, to] : nodes)
				K.add({ 0, a }, { 0, b }, Mat<Dim>(left * to.moves));
		}
	}
}

template <int Dim> std::string ContactKinematics<Dim>::unbalanced() const
{
	for (const auto& free : system_.free) {
		if (free.isAtRest) continue;
		for (const auto& body : system_.bodies)
			if (body.free >= 0 && body.owner == free.owner)
				return sentence(body.name, " finds no balance with the soil that it touches: ", free.imbalance, " of the forces on it is left");
	}
	return "";
}

template class ContactKinematics<2>;
template class ContactKinematics<3>;

} // namespace gimpm
