// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/contact_picture.hpp"
#include "core/terms/contact/contact_surface.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/contact/MpmContact.hpp"
#include "engine/conditions/contact/contact_records.hpp"
#include "engine/conditions/contact/deforming_bodies.hpp"
#include "engine/conditions/contact/rigid_bodies.hpp"
#include "engine/grid/MpmGrid.hpp"
#include "yade_api/bodies.hpp"
#include <Eigen/Geometry>
#include <map>

namespace yade {

namespace {
	// Records of one body, by the number of the contact point.
	using RecordsOfBody = std::map<std::int64_t, ContactRecords::Record>;

	std::map<int, RecordsOfBody> byBody(const vector<Real>& records)
	{
		std::map<int, RecordsOfBody> found;
		for (const auto& r : ContactRecords::from(records))
			found[r.body].emplace(r.number & ((std::int64_t(1) << gimpm::contactPointBits) - 1), r);
		return found;
	}

	// The soil that it has in front of it, and some cells more.
	template <int Dim> Eigen::AlignedBox<Real, Dim> extent(const RecordsOfBody& records, Real cellSize)
	{
		constexpr Real               margin = 4; // cells
		Eigen::AlignedBox<Real, Dim> box;
		for (const auto& [number, r] : records)
			box.extend(gimpm::Vec<Dim>(r.position.template head<Dim>()));
		return { box.min().array() - margin * cellSize, box.max().array() + margin * cellSize };
	}

	template <int Dim> void addCell(Picture& picture, const gimpm::SurfacePoint<Dim>& point, const gimpm::Pose<Dim>& pose)
	{
		vector<int> cell;
		for (size_t c = 0; c < point.corners.size(); ++c) {
			if (c > 0 && point.corners[c] == point.corners[c - 1]) continue; // a triangle
			Vector3r x    = Vector3r::Zero();
			x.head<Dim>() = pose.inSpace(point.corners[c]);
			cell.push_back(int(picture.corners.size()));
			picture.corners.push_back(x);
		}
		picture.add(cell);
	}

	template <int Dim> std::optional<gimpm::RigidBody<Dim>> currentBody(const Body& body, const Scene& scene, const gimpm::Grid<Dim>& grid)
	{
		vector<NodePose> nodes;
		for (const auto& node : nodesOf(body, scene))
			nodes.push_back({ node.get(), node->state->se3, node->state->se3 });
		return nodes.empty() ? rigidBody<Dim>(body, body.state->se3, grid) : deformingBody<Dim>(body, grid, nodes);
	}

	// Stresses are those on the part of the surface that has soil in front of it.
	void addFields(Picture& picture, const ContactRecords::Record* r, Real area)
	{
		const bool touches = r && r->touches;
		const Real wetted  = r ? area * r->areaFraction : area;
		picture.set("force", touches ? r->force() : Vector3r(Vector3r::Zero()));
		picture.set("pressure", touches ? r->normalForce / wetted : 0);
		picture.set("shear", touches ? r->tangentialForce.norm() / wetted : 0);
		if (r) picture.set("gap", r->gap), picture.set("slip", r->travel);
		picture.set("touches", int(touches));
		picture.set("slips", int(touches && r->slips));
	}
}

template <int Dim> void drawFaces(Picture& picture, const MpmContact& contact, const Analysis& analysis)
{
	const auto grid  = analysis.grid->lattice<Dim>();
	const auto scene = analysis.ownScene();
	for (const auto& [id, records] : byBody(contact.records)) {
		const auto shared = bodyAt(*scene, id);
		if (!shared) continue;
		const Body& body  = *shared;
		auto        rigid = currentBody<Dim>(body, *scene, grid);
		if (!rigid) continue;
		rigid->shape.axes = contact.turnOf(id).template topLeftCorner<Dim, Dim>();
		const auto box    = extent<Dim>(records, grid.cellSize);
		const bool isFine = records.rbegin()->first >= gimpm::firstFineNumber && gimpm::mayHaveFinePoints(rigid->shape, grid.cellSize);
		for (const auto& point : gimpm::surfacePointsAt<Dim>(rigid->shape, rigid->begin, grid.cellSize, box.min(), box.max(), isFine)) {
			const auto found        = records.find(point.number);
			const Real around       = grid.axisymmetric ? 2 * M_PI * rigid->begin.inSpace(point.position)[0] : 1;
			const bool isBeyondAxis = around <= 0, isOtherSide = rigid->shape.isTwoSided && found == records.end();
			if (isBeyondAxis || isOtherSide) continue;
			addCell<Dim>(picture, point, rigid->begin);
			addFields(picture, found == records.end() ? nullptr : &found->second, around * point.area);
			picture.set("body", id);
		}
	}
}

template void drawFaces<2>(Picture&, const MpmContact&, const Analysis&);
template void drawFaces<3>(Picture&, const MpmContact&, const Analysis&);

} // namespace yade
