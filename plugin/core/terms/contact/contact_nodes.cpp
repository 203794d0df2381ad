// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact_nodes.hpp"
#include "core/solvers/least_squares.hpp"
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

namespace gimpm {
namespace {

std::array<double, 3> weightsOnSheet(const std::array<Vec3, 3>& corners, const Vec3& own)
{
	const Vec3                  u = corners[1] - corners[0], v = corners[2] - corners[0], x = own - corners[0];
	const Eigen::Matrix2d       metric = (Eigen::Matrix2d() << u.dot(u), u.dot(v), u.dot(v), v.dot(v)).finished();
	const Eigen::Vector2d       part   = metric.inverse() * Eigen::Vector2d(x.dot(u), x.dot(v));
	const std::array<double, 3> weights { 1 - part[0] - part[1], part[0], part[1] };
	return weights;
}

/// Turn of the nodes about their centre by which forces, each proportional to its distance, give a moment; about the
/// axis of a capsule none does.
Vec3 turnOf(const std::array<Vec3, 3>& arms, int nodes, const Vec3& moment)
{
	if (nodes == 2) return moment / (arms[0].squaredNorm() + arms[1].squaredNorm());
	Mat3 inertia = Mat3::Zero();
	for (int i = 0; i < nodes; ++i)
		inertia += arms[i].squaredNorm() * Mat3::Identity() - arms[i] * arms[i].transpose();
	return leastSquares(inertia, moment);
}

} // namespace

template <int Dim> std::array<double, 3> nodeWeights(const RigidBody<Dim>& body, const Vec<Dim>& own)
{
	if constexpr (Dim == 3)
		if (body.nodes == 3) return weightsOnSheet(body.shape.corners, own);
	const Vec<Dim> along = body.shape.corners[1] - body.shape.corners[0];
	const double   part  = std::clamp((own - body.shape.corners[0]).dot(along) / along.squaredNorm(), 0., 1.);
	return { 1 - part, part, 0 };
}

template std::array<double, 3> nodeWeights(const RigidBody<2>&, const Vec<2>&);
template std::array<double, 3> nodeWeights(const RigidBody<3>&, const Vec<3>&);

std::array<ContactLoad, 3> loadsOnNodes(const RigidBody<3>& body, const Vec3& soil, const ForceOnNodes& at)
{
	const auto                 weight = nodeWeights(body, body.begin.inBody(soil));
	std::array<Vec3, 3>        node;
	std::array<ContactLoad, 3> loads;
	Vec3                       foot = Vec3::Zero(), middle = Vec3::Zero();
	for (int i = 0; i < body.nodes; ++i) {
		node[i] = body.end.inSpace(body.shape.corners[i] + body.end.shift[i]);
		foot += weight[i] * node[i], middle += node[i] / body.nodes;
	}
	const Vec3 offset = at.position - foot, axis = (node[1] - node[0]).normalized();
	Vec3       moment = offset.cross(at.force), twist = Vec3::Zero();
	if (body.nodes == 2) twist = moment.dot(axis) * axis, moment -= twist;
	for (int i = 0; i < body.nodes; ++i)
		node[i] -= middle;
	const Vec3                  turn = turnOf(node, body.nodes, moment);
	Eigen::Matrix<double, 3, 6> moves;
	moves << Mat3::Identity(), Mat3::Zero();
	if (body.nodes == 2) moves.rightCols<3>() = axis.cross(offset) * axis.transpose();
	for (int i = 0; i < body.nodes; ++i) {
		loads[i].force     = weight[i] * at.force + turn.cross(node[i]);
		loads[i].torque    = weight[i] * twist;
		loads[i].stiffness = std::max(0., weight[i]) * moves.transpose() * at.resists * moves;
		loads[i].area      = weight[i] * at.area;
		loads[i].young     = weight[i] * at.area * at.modulus;
	}
	return loads;
}

} // namespace gimpm
