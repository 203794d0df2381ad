// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/small_features.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/contact/contact_small.hpp"
#include <algorithm>

namespace yade {

namespace {
	template <int Dim> using Touched = vector<const gimpm::ContactRecord<Dim>*>;

	template <int Dim> Touched<Dim> touchedOf(const gimpm::ContactSystem<Dim>& system, int body)
	{
		Touched<Dim> found;
		for (const auto& r : system.records)
			if (r.body == body && r.touches) found.push_back(&r);
		return found;
	}

	// The soil is one field: on both sides of what is thinner than a cell the same nodes move it, and before its
	// narrow faces they are farther apart than these are wide.
	template <int Dim> string ofThinness(const gimpm::RigidBody<Dim>& body, const Touched<Dim>& touched, Real cellSize, const string& inItsWay)
	{
		bool isBetween = body.isBetween, isNarrow = false;
		for (const auto* r : touched) {
			isBetween = isBetween || touched[0]->normal.dot(r->normal) < -0.5;
			isNarrow  = isNarrow || body.isNarrow(body.end.rotation.transpose() * r->normal);
		}
		isBetween = isBetween && !body.parts;
		if (!isNarrow && !isBetween) return "";
		return gimpm::sentence(
		        body.name, " is ", body.thickness(), " m thick, less than a cell (", cellSize, " m). ",
		        isNarrow ? "Before it the soil resists about as to a body of that width. " : "",
		        isBetween ? gimpm::sentence(
		                "Soil on its two sides moves as one, which neither slides along the body nor comes off it on one side alone, and water of MpmFlow passes: bodies do not part it beside ",
		                inItsWay.empty() ? "five others near them, nor where they are hardly longer than a cell" : inItsWay, ". ")
		                  : "",
		        body.thickness() > 0 ? gimpm::sentence("Cells of at most ", body.thickness(), " m resolve it.") : "");
	}

	template <int Dim> string ofSmallBall(const gimpm::RigidBody<Dim>& body, Real cellSize)
	{
		return gimpm::sentence(
		        body.name, " is ", body.thickness(), " m thick, less than a cell (", cellSize,
		        " m). Its contact force depends on its position in a cell, by a sixth, and a ball of less than half a cell may get none or be pulled. "
		        "Cells of at most ",
		        body.thickness() / 2, " m resolve it.");
	}

	template <int Dim> vector<gimpm::FacePoint<Dim>> placesOf(const Touched<Dim>& touched)
	{
		vector<gimpm::FacePoint<Dim>> found;
		for (const auto* r : touched)
			found.push_back({ r->position, r->normal });
		return found;
	}

	template <int Dim> string ofEdge(const gimpm::RigidBody<Dim>& body, Real reach, Real cellSize)
	{
		if (!(reach > 0 && reach < 3 * cellSize)) return "";
		return gimpm::sentence(
		        body.name, " presses by an edge or a tip of which ", reach, " m are in the soil, less than three cells (of ", cellSize,
		        " m). Its contact force there depends on its position in a cell, by ", reach < cellSize ? "a fifth or more" : "a tenth",
		        ". Cells of at most ", reach / 5, " m, or five times that depth, make it a twentieth.");
	}

	// The same of the border of a sheet, which no cells resolve where soil on its two sides moves as one.
	template <int Dim> string ofBorder(const gimpm::RigidBody<Dim>& body, Real reach, Real cellSize)
	{
		if (!(reach > 0 && reach < 3 * cellSize)) return "";
		return gimpm::sentence(
		        body.name, " presses by a border of which ", reach, " m are in the soil, less than three cells (of ", cellSize,
		        " m). Its contact force there depends on its position in a cell, by up to a sixth, and smaller cells ",
		        body.parts
		                ? "make that less."
		                : "do not change that, as soil on both of its sides moves as one. A Box, or a closed mesh of Facets, that has its thickness can be resolved.");
	}
}

template <int Dim> string warningOfSmallFeatures(const gimpm::ContactSystem<Dim>& system, Real cellSize, const string& inItsWay)
{
	using gimpm::RigidKind;
	const auto isSheet = [&](const auto& body) { return body.shape.kind == RigidKind::sheet; };
	const bool isMesh  = std::count_if(system.bodies.begin(), system.bodies.end(), isSheet) > 1;
	for (int i = 0; i < int(system.bodies.size()); ++i) {
		const auto& body    = system.bodies[i];
		const auto  touched = touchedOf(system, i);
		if (touched.empty()) continue;
		const bool isThin = body.thickness() < cellSize * (1 - 1e-9);
		string     text;
		if (isThin && body.shape.kind == RigidKind::ball) text = ofSmallBall(body, cellSize);
		else if (isThin)
			text = ofThinness(body, touched, cellSize, inItsWay);
		if (body.shape.kind == RigidKind::block && text.empty())
			text = ofEdge(body, gimpm::reachFromEdge(body, body.end, placesOf<Dim>(touched)), cellSize);
		if (isSheet(body) && !isMesh && text.empty()) text = ofBorder(body, gimpm::reachFromBorder(body, body.end, placesOf<Dim>(touched)), cellSize);
		if (!text.empty()) return text;
	}
	return "";
}

template string warningOfSmallFeatures(const gimpm::ContactSystem<2>&, Real, const string&);
template string warningOfSmallFeatures(const gimpm::ContactSystem<3>&, Real, const string&);

} // namespace yade
