// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact_points.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/parting.hpp"
#include "core/terms/contact/contact_hiding.hpp"
#include "core/terms/contact/contact_small.hpp"
#include "core/terms/contact/contact_surface.hpp"
#include "core/terms/contact/near_points.hpp"
#include <cmath>
#include <map>

namespace gimpm {
namespace {

/// Penalty on the gap over that on the slip. With 20 a contact point slides after mu p h / (stiffness / 20 E). Blocks
/// that are sheared to and fro by a plate, friction 0.3 to 4, take 5 solves a step; with 2 it is 8, and with 50 4.5.
constexpr double slipSoftness = 20;

/// Diameter of a ball below which its contact points see soil along their normals [cells].
constexpr double smallBall = 2;

/// Area fraction of soil that just does not reach a contact point, but for round-off: it must not decide which contact
/// points have touched.
constexpr double noArea = 1e-9;

/// Distance of soil from an arc that it touches by chords of a cell's length, over the cell size, where the radius is
/// that of a cell; less where it is larger.
constexpr double offChord = 1. / 8;

/// Between nodes soil is straight, so that the centre of a point may get behind a facet by a little, as at the tip of a
/// cone. Where soil touches on one side alone, as at a closed mesh, that is no passage, and the facet is like a face of
/// a Box. Soil in sight of the other side counts only where nothing touches: at edges it is that of a neighbour.
template <int Dim> void takeSides(ContactSystem<Dim>& system, const Grid<Dim>& grid)
{
	for (auto& body : system.bodies)
		body.soilSide = 0, body.slack = deepestInBody * grid.cellSize;
	if (grid.isAdaptive)
		for (const auto& r : system.records) // large cells, which were small before, let it in as far
			if (double& slack = system.bodies[r.body].slack; r.touches) slack = std::max(slack, deepestInBody * cellSizeAt(grid, r.position));
	for (auto first = system.records.begin(), last = first; first != system.records.end(); first = last) {
		last                 = std::find_if(first, system.records.end(), [&](const auto& r) { return r.body != first->body; });
		const bool isTouched = std::any_of(first, last, [](const auto& r) { return r.touches; });
		const auto isOn
		        = [&](int odd) { return std::any_of(first, last, [&](const auto& r) { return r.number % 2 == odd && (r.touches || !isTouched); }); };
		if (isOn(0) != isOn(1)) system.bodies[first->body].soilSide = isOn(0) ? 1 : -1;
	}
}

/// A body keeps the contact points with which it has touched.
template <int Dim> bool isFineOn(const ContactSystem<Dim>& system, int body, double cellSize)
{
	if (!mayHaveFinePoints(system.bodies[body].shape, cellSize)) return false;
	const auto record = std::find_if(system.records.begin(), system.records.end(), [&](const auto& r) { return r.body == body; });
	if (record == system.records.end()) return system.kind == StepKind::dynamic;
	return record->number % (std::int64_t(1) << contactPointBits) >= firstFineNumber;
}

/// Number of the face of a contact point, by the axis of the body that its normal is closest to.
template <int Dim> int faceOf(const RigidBody<Dim>& body, const ContactPoint<Dim>& point)
{
	const Vec<Dim> own = (body.free < 0 ? body.end : body.begin).rotation.transpose() * point.normal;
	int            axis;
	own.cwiseAbs().maxCoeff(&axis);
	return 1 + 2 * axis + (own[axis] > 0);
}

/// Soil that is pressed all over a ball touches it in some contact points of a cell and lies off it by a part of the
/// chord in others. The grid knows what presses on all of them together, so that is what adhesion goes by: that of the
/// last step, over the area. Where friction has no other bound than pressure, all of it is the same with or without.
/// So it is with each side of a body that parts soil, whose domains are a staircase along it.
template <int Dim> void spreadPressure(const ContactSystem<Dim>& system, const Grid<Dim>& grid, std::vector<ContactPoint<Dim>>& points)
{
	struct Pressed {
		double force = 0, area = 0;
	};
	std::map<std::array<int, Dim + 2>, Pressed>                cells;
	std::vector<std::pair<ContactPoint<Dim>*, const Pressed*>> meant;
	for (ContactPoint<Dim>& point : points) {
		const auto& body = system.bodies[point.body];
		if (!(body.shape.kind == RigidKind::ball || body.parts) || !(point.law.frictionCoefficient > 0) || !std::isfinite(point.law.cap)) continue;
		std::array<int, Dim + 2> key { point.body, body.parts ? faceOf(body, point) : 0 };
		for (int a = 0; a < Dim; ++a)
			key[a + 2] = int(std::floor((point.soil[a] - grid.origin[a]) / grid.cellSize));
		Pressed& cell = cells[key];
		cell.area += point.area;
		if (const auto* r = system.recordOf(point)) cell.force += r->normalForce;
		meant.emplace_back(&point, &cell);
	}
	for (const auto& [point, cell] : meant)
		point->law.around = cell->force / cell->area * point->area, point->law.reach = offChord * grid.cellSize;
}

/// The layer of the nodes before a contact point, of soil in a layer of its own, or of one that a line parts: there a
/// point of the surface keeps its number on whatever side of the line soil begins to be parted.
template <int Dim> int layerBefore(const Grid<Dim>& grid, const Vec<Dim>& onBody, const Vec<Dim>& normal, int layer)
{
	constexpr double little = 1e-3; // cells
	return grid.parting ? grid.parting->layerAt(onBody + little * grid.cellSize * normal, layer) : layer;
}

template <int Dim> auto findLost(const ContactSystem<Dim>& system, const StepContext<Dim>& step, const std::vector<ContactPoint<Dim>>& points)
{
	std::vector<std::pair<Attachment<Dim>, std::size_t>> lost;
	std::vector<bool>                                    isMet(system.records.size(), false);
	for (const ContactPoint<Dim>& point : points)
		if (const auto* r = system.recordOf(point)) isMet[r - system.records.data()] = true;
	for (std::size_t i = 0; i < isMet.size(); ++i) {
		const auto&                    r = system.records[i];
		std::optional<Attachment<Dim>> attached;
		for (int quarter = 0; quarter <= 4 && !attached && !isMet[i] && r.touches; ++quarter) // deeper in the soil, where its face has no nodes
			attached = attach(
			        Vec<Dim>(r.position + 0.25 * quarter * step.grid.cellSize * r.normal), step.basis, step.grid,
			        layerBefore(step.grid, Vec<Dim>(r.position - std::min(0., r.gap) * r.normal), r.normal, int(r.number >> contactPointBits)));
		if (attached) lost.emplace_back(*attached, i);
	}
	return lost;
}

/// A material point near a body, whichever process has it. Numbers only.
template <int Dim> struct SoilPoint {
	int                     body, side, layer;
	std::array<double, Dim> position, halfSize; ///< at the start of the step
	double                  young;

	Vec<Dim> centre() const { return Eigen::Map<const Vec<Dim>>(position.data()); }
	Vec<Dim> half() const { return Eigen::Map<const Vec<Dim>>(halfSize.data()); }
};

/// Layer of the body of points that a point is part of.
template <int Dim> int layerOfBody(const StepContext<Dim>& step, int point)
{
	const int layer = step.cloud.layerOf(point);
	return step.grid.parting ? step.grid.parting->layerOfBody(layer) : layer;
}

/// Points near bodies, by body.
template <int Dim> std::vector<SoilPoint<Dim>> soilNear(const ContactSystem<Dim>& system, const StepContext<Dim>& step)
{
	std::vector<SoilPoint<Dim>> found;
	for (const auto& [body, point, side] : nearPoints(system.bodies, step.cloud, step.basis, step.grid)) {
		if (point >= step.division.ownOf(step.cloud.size())) continue; // the process that has it tells of it
		SoilPoint<Dim> near { body, side, layerOfBody(step, point), {}, {}, step.stiffnessOf(point).modulus };
		std::copy_n(step.cloud.position[point].data(), Dim, near.position.data());
		std::copy_n(step.cloud.halfSize[point].data(), Dim, near.halfSize.data());
		found.push_back(near);
	}
	found = step.division.joined(std::move(found));
	std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.body < b.body; });
	return found;
}

/// Search on one body.
template <int Dim> class BodySearch {
public:
	BodySearch(const ContactSystem<Dim>& system, const StepContext<Dim>& step, const std::vector<SoilPoint<Dim>>& soil, int body, FoundContact<Dim>& to)
	        : system_(system), step_(step), number_(body), body_(system.bodies[body]), h_(step.grid.cellSize), to_(to)
	{
		first_ = std::lower_bound(soil.begin(), soil.end(), body, [](const auto& near, int b) { return near.body < b; });
		last_  = std::find_if(first_, soil.end(), [&](const auto& near) { return near.body != body; });
	}

	/// Checks the overlap of the body with the soil near it, and says what cannot be computed.
	void checkOverlap()
	{
		const bool isThin  = body_.nodes > 0 && body_.thickness() < h_ / 2;
		const bool isPlain = body_.shape.kind == RigidKind::ball && isSmooth();
		if (first_ != last_ && body_.turn > 1 && !isPlain)
			to_.obstacle = sentence(
			        body_.name, " turns by ", body_.turn,
			        " rad from one load step to the next; soil near it can follow 1 rad: decrease angVel, O.dt or iterPeriod");
		for (auto near = first_; body_.isNew && near != last_; ++near) // No point is inside of a two-sided surface.
			if (body_.proximity(body_.begin, near->centre(), near->side).gap < 0 && !isThin)
				to_.obstacle = sentence(
				        body_.name, " has the middle of a material point inside of it, at (", near->centre().transpose(),
				        "): let it begin beside the soil, or leave its place out of the region that is filled, as pack.inAlignedBox(...) - pack.inSphere(...)");
	}

	/// Adds contact points before each body of points for itself.
	void addPoints()
	{
		std::vector<int> layers;
		for (auto near = first_; near != last_; ++near)
			if (std::find(layers.begin(), layers.end(), near->layer) == layers.end()) layers.push_back(near->layer);
		for (const int layer : layers)
			if (layer < layersOfContactPoints) addPoints(layer);
			else
				to_.obstacle = body_.name
				        + " is near a body of points that is one of more than four of which each meets each other; it can touch four of them";
	}

private:
	void addPoints(int layer)
	{
		std::vector<SoilDomain<Dim>> domains;
		for (auto near = first_; near != last_; ++near) {
			if (near->layer != layer) continue;
			const Proximity<Dim> closest = body_.proximity(body_.begin, near->centre(), near->side);
			domains.push_back({ near->centre(), near->half(), near->young, closest.normal, closest.gap });
		}
		const bool          isSmallBall = body_.shape.kind == RigidKind::ball && body_.thickness() < smallBall * h_;
		const SoilNear<Dim> soil(std::move(domains), h_, isSmallBall);
		const auto [low, high]   = soil.bounds();
		const Vec<Dim>    margin = Vec<Dim>::Constant(h_ + searchReach(body_, step_.grid));
		const Hiding<Dim> others(system_.bodies, number_, h_, contactTolerance(h_));
		for (const auto& point : surfacePointsAt<Dim>(body_.shape, body_.begin, h_, low - margin, high + margin, isFineOn(system_, number_, h_)))
			addPoint(layer, point, soil, others);
	}

	void addPoint(int layer, const SurfacePoint<Dim>& point, const SoilNear<Dim>& soil, const Hiding<Dim>& others)
	{
		const bool     isRing = step_.grid.axisymmetric;
		const Vec<Dim> onBody = body_.begin.inSpace(point.position), normal = body_.begin.rotation * point.normal;
		if ((isRing && onBody[0] <= 0) || !isInPeriod(onBody, step_.grid)) return;
		const auto sight = soil.from(onBody, normal, searchReach(body_, step_.grid), others.screensBefore(onBody));
		if (!sight || others.hides(onBody, normal)) return;
		ContactPoint<Dim> made;
		made.body = number_, made.number = point.number | std::int64_t(layer) << contactPointBits;
		const auto* record   = system_.recordOf(made);
		const bool  isWithin = isWithinSoil(onBody, normal, sight->gap, soil);
		made.gap             = std::max(0., isWithin ? (record ? record->gap : 0) : sight->gap);
		made.soil            = onBody + (isWithin ? sight->gap : made.gap) * normal;
		made.normal          = (body_.free < 0 ? body_.end : body_.begin).rotation * point.normal;
		made.areaFraction    = sight->areaFraction;
		const bool touched   = record && record->touches;
		// Domains turn and stretch; but soil that presses goes no faster than it slides, a quarter of a cell
		// from being there in full to not being there.
		if (touched) made.areaFraction = std::max(made.areaFraction, record->areaFraction - 4 * record->travel / h_);
		if (made.areaFraction <= noArea) return;
		// Pressed soil begins inside of the body: at its face even pressure would not balance even stress.
		if (touched && record->gap < 0 && !isWithin) made.soil = onBody + record->gap * normal;
		const int before = layerBefore(step_.grid, onBody, normal, layer);
		if (!placeAhead(made, record, point, before) && !place(made, point, before)) return;
		made.area            = made.areaFraction * point.area * (isRing ? 2 * M_PI * onBody[0] : 1);
		made.young           = sight->young;
		const double penalty = body_.stiffness * made.young * made.area / h_;
		made.law             = { penalty, penalty / slipSoftness, body_.frictionCoefficient, body_.adhesion * made.area };
		if (step_.water) made.law.water = made.area * made.attached.value(*step_.water);
		if (record) recall(made, *record, sight->gap);
		if (touched && record->gap < 0) moveOut(made, *record, soil);
		to_.points.push_back(made);
	}

	bool partsSoil() const { return body_.parts && body_.shape.kind == RigidKind::sheet; }

	/// True where a sheet parts soil that is one body: domains through which it goes count on one of its sides, and
	/// leave a gap on the other one, which is none. What opens then is known from its motion. Pressure acts where
	/// the domains of its side begin: cells beyond have nothing that bears it.
	bool isWithinSoil(const Vec<Dim>& onBody, const Vec<Dim>& normal, double gap, const SoilNear<Dim>& soil) const
	{
		if (!partsSoil()) return false;
		const double h      = cellSizeAt(step_.grid, onBody);
		const auto   behind = soil.from(onBody, -normal, h / 2);
		return behind && gap + behind->gap <= deepestInBody * h;
	}

	bool isSmooth() const { return body_.frictionCoefficient == 0 || body_.adhesion == 0; }

	/// Attaches it to the soil that will be in front of it as the step ends: all that the body moves along its face
	/// where it is smooth, else as far as soil slid in the last step. Soil in front of an edge as the step begins
	/// is beyond it as the step ends, and would be pushed on: the edge would act as if it were wider by half of the
	/// slip. False where cells do not follow bodies, where there is no soil ahead, and where water flows: steps of
	/// a cone around which it drains fail then.
	bool placeAhead(ContactPoint<Dim>& made, const ContactRecord<Dim>* record, const SurfacePoint<Dim>& point, int layer) const
	{
		if (!step_.grid.isAdaptive || step_.water || system_.kind == StepKind::dynamic) return false;
		const Vec<Dim> carried = body_.carried(made.soil), along = carried - carried.dot(made.normal) * made.normal, soil = made.soil;
		const double   most = along.norm(), way = isSmooth() ? most : record ? std::min(record->travel, most) : 0;
		if (!(way > 0)) return false;
		made.soil += way / most * along;
		if (step_.grid.axisymmetric) made.soil[0] = std::max(0., made.soil[0]);
		if (place(made, point, layer)) return true;
		made.soil = soil;
		return false;
	}

	/// Attaches it to the soil. False behind a wall, where there is none.
	bool place(ContactPoint<Dim>& made, const SurfacePoint<Dim>& point, int layer) const
	{
		const Vec<Dim> beside   = made.soil + body_.begin.rotation * point.aside;
		auto           attached = attach(beside, step_.basis, step_.grid, layer);
		if (attached) made.soil = beside;
		else
			attached = attach(made.soil, step_.basis, step_.grid, layer); // at an end of the soil
		if (!attached) return false;
		made.attached     = *attached;
		made.distribution = ForceDistribution<Dim>(*attached);
		made.away         = body_.proximity(body_.begin, made.soil, 1).gap; // found as at the end: no gap by round-off
		made.carried      = body_.carried(made.soil);
		return true;
	}

	/// Recalls a record: what pressed stays pressed, wherever domains are seen now. Soil that slides through the
	/// grid follows its domains slowly, so that it does not creep in; in time steps that would be work of nobody.
	/// Soil at rest, along which the body slides, does not creep in, and its domains are a staircase that says
	/// nothing of its pressure.
	void recall(ContactPoint<Dim>& made, const ContactRecord<Dim>& record, double seen) const
	{
		made.tangentialForce
		        = body_.free < 0 ? Vec<Dim>(body_.end.rotation * body_.begin.rotation.transpose() * record.tangentialForce) : record.tangentialForce;
		if (!record.touches || record.gap >= 0) return;
		// A stiffer spring has the force that the softer one had: it has been given no energy.
		made.gap            = std::max(record.gap, -record.normalForce / made.law.normalStiffness);
		const double creeps = system_.kind == StepKind::dynamic || partsSoil() ? 0 : std::min(0.1, record.creep / h_);
		made.gap += creeps * std::min(0., seen - made.gap);
	}

	/// In statics centres that have got into the body are moved out slowly, also where soil does not slide, as
	/// recall() does where it does: they get in on their way through the grid, be it with the body.
	void moveOut(ContactPoint<Dim>& made, const ContactRecord<Dim>& record, const SoilNear<Dim>& soil) const
	{
		if (system_.kind == StepKind::dynamic || body_.free >= 0 || body_.nodes > 0) return;
		const Vec<Dim> normal = body_.begin.rotation * body_.end.rotation.transpose() * made.normal;
		const auto     share  = [&](double way) { return std::min(0.1, way / h_); };
		made.gap += std::max(0., share(made.carried.norm()) - share(record.travel)) * (soil.deepest(made.soil, normal, made.gap) - made.gap);
	}

	static bool isInPeriod(const Vec<Dim>& position, const Grid<Dim>& grid)
	{
		for (int a = 0; a < Dim; ++a) {
			const double from = position[a] - grid.origin[a];
			if (grid.period[a] > 0 && !(from >= 0 && from < grid.cellSize * grid.period[a])) return false;
		}
		return true;
	}

	const ContactSystem<Dim>&                            system_;
	const StepContext<Dim>&                              step_;
	const int                                            number_;
	const RigidBody<Dim>&                                body_;
	const double                                         h_;
	FoundContact<Dim>&                                   to_;
	typename std::vector<SoilPoint<Dim>>::const_iterator first_, last_;
};

} // namespace

template <int Dim> FoundContact<Dim> findContactPoints(ContactSystem<Dim>& system, const StepContext<Dim>& step)
{
	FoundContact<Dim> found;
	takeSides(system, step.grid);
	const auto soil = soilNear(system, step);
	for (int body = 0; body < int(system.bodies.size()); ++body) {
		BodySearch<Dim> search(system, step, soil, body, found);
		search.checkOverlap();
		search.addPoints();
	}
	widenDistributions(system.bodies, step, found.points);
	if (system.kind == StepKind::dynamic) found.lost = findLost(system, step, found.points);
	spreadPressure(system, step.grid, found.points);
	return found;
}

template FoundContact<2> findContactPoints(ContactSystem<2>&, const StepContext<2>&);
template FoundContact<3> findContactPoints(ContactSystem<3>&, const StepContext<3>&);

} // namespace gimpm
