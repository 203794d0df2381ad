// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/shaking/free_fields.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/inertia/absorbing.hpp"
#include "core/terms/inertia/motion.hpp"
#include "engine/conditions/surface/surfaces.hpp"

namespace yade {

namespace {
	using gimpm::Mat;
	using gimpm::Vec;

	// The point whose domain is nearest to a place, as seen from its middle by its extent, and how far away that
	// is: 1 at the edge of the domain.
	std::pair<int, Real> nearestPoint(const gimpm::PointCloud<2>& cloud, const Vec<2>& place)
	{
		std::pair<int, Real> nearest { -1, std::numeric_limits<Real>::infinity() };
		for (size_t p = 0; p < cloud.size(); ++p) {
			const Real away = ((place - cloud.position[p]).array() / cloud.halfSize[p].array()).abs().maxCoeff();
			if (away < nearest.second) nearest = { int(p), away };
		}
		return nearest;
	}

	// rho c_p, rho c_s and the shear modulus of the material beside each piece.
	vector<Vector3r> impedancesBeside(const gimpm::Surface<2>& surface, const gimpm::Model<2>& model, const gimpm::PointCloud<2>& cloud, const string& name)
	{
		constexpr Real   most = 2; // half sizes: a whole domain beside the piece is missing
		vector<Vector3r> found;
		for (const auto& piece : surface.pieces) {
			const Vec<2> middle      = (surface.vertices[piece[0]] + surface.vertices[piece[1]]) / 2;
			const auto [point, away] = nearestPoint(cloud, middle);
			if (!(away <= most))
				throw std::invalid_argument(gimpm::sentence(
				        name, ", an MpmFreeField, has no material beside it at (", middle.transpose(),
				        "): its surface has to be the edge of the body."));
			const auto moduli  = gimpm::waveModuli(model.materials, cloud, point);
			const Real density = model.materials[cloud.material[point]].density / cloud.volumeRatio(point);
			found.emplace_back(std::sqrt(density * moduli.pressure), std::sqrt(density * moduli.shear), moduli.shear);
		}
		return found;
	}

	// `across` times the part of a vector across the normal, and `along` times that along it.
	Mat<2> splitBy(const Vec<2>& normal, Real along, Real across)
	{
		const Vec<2> n = normal.normalized();
		return across * Mat<2>::Identity() + (along - across) * n * n.transpose();
	}

	void setMatrices(gimpm::GroundEdge<2>& edge, const vector<Vector3r>& impedances, Real distance)
	{
		const size_t n = edge.surface.vertices.size();
		edge.drag.assign(n, Mat<2>::Zero());
		if (std::isfinite(distance)) edge.stiffness.assign(n, Mat<2>::Zero());
		for (size_t i = 0; i < edge.surface.pieces.size(); ++i) {
			const auto&  piece  = edge.surface.pieces[i];
			const Vec<2> normal = edge.surface.normal(piece, edge.surface.vertices0);
			for (const int v : piece) {
				edge.drag[v] += normal.norm() / 2 * splitBy(normal, impedances[i][0], impedances[i][1]);
				if (std::isfinite(distance)) edge.stiffness[v] += normal.norm() / 2 * impedances[i][2] / distance * splitBy(normal, 1, 0.5);
			}
		}
	}

	std::vector<Vec<2>> between(const MpmFreeField& field, const vector<Real>& table, Real time)
	{
		const size_t        n = field.surface->vertices.size(), last = field.times.size() - 1;
		const auto          upper = std::upper_bound(field.times.begin(), field.times.end(), time);
		const size_t        after = std::min(size_t(upper - field.times.begin()), last), before = after > 0 ? after - 1 : 0;
		const Real          span  = field.times[after] - field.times[before];
		const Real          share = span > 0 ? std::clamp((time - field.times[before]) / span, Real(0), Real(1)) : 0;
		const auto          at    = [&](size_t row, size_t v) { return Vec<2>(table[2 * (row * n + v)], table[2 * (row * n + v) + 1]); };
		std::vector<Vec<2>> found;
		for (size_t v = 0; v < n; ++v)
			found.push_back((1 - share) * at(before, v) + share * at(after, v));
		return found;
	}

	gimpm::GroundMotion<2> groundAt(const MpmFreeField& field, Real time, size_t vertices)
	{
		const std::vector<Vec<2>> none(vertices, Vec<2>::Zero());
		if (!field.times.empty())
			return { between(field, field.velocities, time), between(field, field.displacements, time), between(field, field.forces, time) };
		if (!field.motion) return { none, none, none };
		return { std::vector<Vec<2>>(vertices, 2 * field.motion->velocityAt(time).head<2>()), none, none };
	}

	// A step between these times.
	void requireKnown(const MpmFreeField& field, const string& name, const StepTime& step)
	{
		if (field.times.empty()) return;
		const Real little = 1e-9 * (field.times.back() - field.times.front()) + 1e-9 * std::abs(field.times.front());
		if (step.to > field.times.back() + little)
			throw std::invalid_argument(gimpm::sentence(
			        name, ", an MpmFreeField: how the ground beyond moves is known until t = ", field.times.back(), " s, but this step ends at ",
			        step.to, " s: make it by mpm.freeField with a later until."));
		if (!field.hasBegun && step.to > step.from && std::abs(step.from - field.times.front()) > little)
			throw std::invalid_argument(gimpm::sentence(
			        name, ", an MpmFreeField: its first step begins at t = ", step.from, " s, but the first of its times is ", field.times.front(),
			        " s."));
	}
}

bool MpmFreeField::areFinite(const vector<Real>& numbers)
{
	return std::all_of(numbers.begin(), numbers.end(), [](Real number) { return std::isfinite(number); });
}

bool MpmFreeField::increase(const vector<Real>& numbers)
{
	return areFinite(numbers) && std::is_sorted(numbers.begin(), numbers.end(), std::less_equal<Real>());
}

std::shared_ptr<FreeFields::Edge> FreeFields::edgeOf(const Listed& listed, const gimpm::Model<2>& model, const gimpm::PointCloud<2>& cloud) const
{
	const auto edge = std::make_shared<Edge>();
	edge->from      = boost::static_pointer_cast<MpmFreeField>(listed.condition);
	edge->name      = listed.name();
	edge->acts      = edge->from->acts;
	edge->hasBegun  = edge->from->hasBegun;
	requireDimension<2>(*edge->from->surface, edge->name);
	if (edge->from->motion) edge->from->motion->requireInDimension(2, edge->name);
	edge->surface = coreSurface<2>(*edge->from->surface);
	if (edge->from->times.empty() && edge->acts && !edge->hasBegun) edge->surface.refine(gimpm::pieceLimit * model.grid.cellSize);
	edge->impedances = edge->from->impedances;
	if (edge->impedances.empty()) edge->impedances = impedancesBeside(edge->surface, model, cloud, edge->name);
	edge->borne = inDimension<2>(edge->from->borne);
	if (edge->impedances.size() != edge->surface.pieces.size() || (edge->hasBegun && edge->borne.size() != edge->surface.vertices.size()))
		throw std::invalid_argument(edge->name + ", an MpmFreeField, has begun to act on another surface: give a new MpmFreeField.");
	setMatrices(*edge, edge->impedances, edge->acts ? edge->from->distance : std::numeric_limits<Real>::infinity());
	return edge;
}

void FreeFields::join(gimpm::Model<2>& model, const Surroundings<2>& around)
{
	if (model.processes->size() > 1) throw std::invalid_argument("MpmFreeField cannot go with several processes yet: start the script with one.");
	for (const Listed& listed : group)
		edges.push_back(edgeOf(listed, model, around.cloud));
	for (const auto& edge : edges)
		if (!edge->stiffness.empty())
			model.terms.push_back([edge](const gimpm::StepContext<2>& step) { return std::make_unique<gimpm::EdgeSprings<2>>(*edge, step); });
}

void FreeFields::joinMotion(gimpm::Motion<2>& motion, const gimpm::Model<2>&, Real)
{
	for (const auto& edge : edges) {
		edge->atMiddle = motion.scheme.atMiddle;
		motion.damping.push_back([edge](const gimpm::StepContext<2>& step) { return std::make_unique<gimpm::EdgeDrag<2>>(*edge, step); });
	}
}

void FreeFields::advance(const StepTime& step, gimpm::Model<2>&, gimpm::Load<2>&)
{
	for (const auto& edge : edges) {
		requireKnown(*edge->from, edge->name, step);
		edge->before = groundAt(*edge->from, edge->atMiddle ? step.looked : step.from, edge->surface.vertices.size());
		edge->now    = groundAt(*edge->from, step.looked, edge->surface.vertices.size());
	}
}

void FreeFields::reach(const StepOutcome<2>&)
{
	for (const auto& edge : edges) {
		MpmFreeField& to = *edge->from;
		scatter<2>(edge->surface, *to.surface);
		to.hasBegun           = edge->hasBegun;
		to.borne              = inSpace<2>(edge->borne, 0);
		to.impedances         = edge->impedances;
		to.velocity           = inSpace<2>(edge->velocity, 0);
		to.reaction           = Vector3r::Zero();
		to.reaction.head<2>() = edge->force + edge->springForce;
	}
}

Work FreeFields::work(const StepOutcome<2>&) const
{
	Work sum;
	for (const auto& edge : edges)
		sum.ofBoundaries += edge->work + edge->springWork;
	return sum;
}

} // namespace yade
