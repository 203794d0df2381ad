// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/plausibility.hpp"
#include "engine/MpmImplicitEngine.hpp"
#include "yade_api/logging.hpp"
#include <unordered_map>

namespace yade {

namespace {
	template <class... Parts> [[noreturn]] void refuse(const Parts&... parts)
	{
		std::ostringstream text;
		(text << ... << parts);
		throw std::invalid_argument(text.str());
	}

	void requireGravityInPlane(const MpmImplicitEngine& engine)
	{
		if (engine.grid->dim == 3 || engine.gravity[2] == 0) return;
		refuse("MpmImplicitEngine.gravity = (", engine.gravity.transpose(), ") has a z component, which a grid with dim=2 (plane strain in x-y) would leave out; ",
		       "there gravity acts along y, as in (0, -9.81, 0).");
	}

	// YADE begins with O.dt = 1e-8, for grains.
	void requireSensibleIncrement(const MpmImplicitEngine& engine)
	{
		constexpr Real mostSteps = 1e6;
		const auto&    curve     = engine.loadCurve;
		const Real     dt = engine.scene->dt, left = engine.loadsEnd() - engine.scene->time, length = engine.loadsEnd() - curve.front().first;
		if (engine.iterPeriod != 1 || left <= 0) return;
		if (left / dt > mostSteps)
			refuse("MpmImplicitEngine: with O.dt = ", dt, " the load curve would take ", left / dt,
			       " steps; was O.dt forgotten? It is the load time of one step: 1/80 gives 80 steps with the default loadCurve.");
		if (curve.size() > 1 && dt > length * (1 + 1e-9))
			refuse("MpmImplicitEngine: O.dt = ", dt, ", the load time of one step, is more than the whole loadCurve, from ", curve.front().first, " to ",
			       engine.loadsEnd(), ": 1/80 of that gives 80 steps.");
	}

	// As long as they have not been deformed, points must not claim the same place.
	class Places {
	public:
		Places(const vector<MaterialPoint>& points, int dim)
		        : points(points)
		        , dim(dim)
		{
			for (const MaterialPoint& p : points)
				for (int a = 0; a < dim; ++a)
					width = std::max(width, 2 * p.shape->halfSize[a]);
		}
		void requireDistinct()
		{
			for (size_t i = 0; i < points.size(); ++i)
				if (points[i].state->defGrad == Matrix3r::Identity()) add(i);
		}

	private:
		using Cell = Eigen::Matrix<int64_t, 3, 1>;

		Cell cellOf(const Vector3r& x) const
		{
			Cell c = Cell::Zero();
			for (int a = 0; a < dim; ++a)
				c[a] = int64_t(std::floor(x[a] / width));
			return c;
		}
		static uint64_t hash(const Cell& c) { return uint64_t(c[0]) * 73856093 ^ uint64_t(c[1]) * 19349663 ^ uint64_t(c[2]) * 83492791; }

		void add(size_t i)
		{
			const Cell here = cellOf(points[i].state->pos);
			for (int n = 0; n < (dim == 2 ? 9 : 27); ++n)
				for (auto [at, end] = found.equal_range(hash(here + Cell(n % 3 - 1, n / 3 % 3 - 1, dim == 2 ? 0 : n / 9 - 1))); at != end; ++at)
					requireApart(points[at->second], points[i]);
			found.emplace(hash(here), i);
		}

		// Neighbours that fill a cell with others are a whole domain apart.
		void requireApart(const MaterialPoint& p, const MaterialPoint& q) const
		{
			const Vector3r apart = (p.state->pos - q.state->pos).cwiseAbs(), half = p.shape->halfSize.cwiseMax(q.shape->halfSize);
			for (int a = 0; a < dim; ++a)
				if (apart[a] >= 0.75 * half[a]) return;
			refuse("Bodies #", p.id, " and #", q.id, " are material points in the same place, at (", p.state->pos.transpose(), ") and (",
			       q.state->pos.transpose(), "): has a region been filled twice, or do two fills overlap? Give mpm.fill one region, with a list or function as material.");
		}

		const vector<MaterialPoint>&                points;
		int                                         dim;
		Real                                        width = 0;
		std::unordered_multimap<uint64_t, size_t> found;
	};

	void warn(const string& text) { log(Severity::warning, MpmImplicitEngine::staticName(), text); }

	void warnOfGravityUpwards(const MpmImplicitEngine& engine)
	{
		for (int axis = 0; axis < 3; ++axis)
			if (engine.gravity[axis] > 0 && engine.gravity[axis] == engine.gravity.norm())
				warn(string("gravity acts along +") + "xyz"[axis] + ", upwards as most would draw it; downwards it has a minus.");
	}

	Real largestPoint(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points)
	{
		Real largest = 0;
		for (const MaterialPoint& p : points)
			largest = std::max(largest, 2 * p.shape->halfSize0.head(engine.grid->dim).maxCoeff());
		return largest;
	}

	// No fill puts so many points into a cell that they are as small.
	void requireCellsForPoints(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points)
	{
		constexpr Real most    = 1e5; // points per cell and axis
		const Real     largest = largestPoint(engine, points), h = engine.grid->cellSize;
		if (h / most > largest)
			refuse("MpmGrid.cellSize = ", h, " m is ", h / largest, " times the size of the largest material point (", largest,
			       " m), so that all of them would move as one cell does; is it the grid that mpm.fill was given, in the same unit?");
	}

	void warnOfLargeCells(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points)
	{
		constexpr Real most     = 20; // points per cell and axis
		Real           smallest = std::numeric_limits<Real>::infinity();
		for (const MaterialPoint& p : points)
			smallest = std::min(smallest, 2 * p.shape->halfSize.head(engine.grid->dim).minCoeff());
		if (engine.grid->cellSize <= most * smallest) return;
		std::ostringstream text;
		text << "cellSize = " << engine.grid->cellSize << " m is more than " << most << " times the size of a material point (" << smallest
		     << " m); is it the grid that mpm.fill was given?";
		warn(text.str());
	}
}

void requirePlausible(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points)
{
	requireGravityInPlane(engine);
	requireSensibleIncrement(engine);
	requireCellsForPoints(engine, points);
	Places(points, engine.grid->dim).requireDistinct();
	warnOfGravityUpwards(engine);
	warnOfLargeCells(engine, points);
}

string idleBoundaries(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points, const vector<const MpmBoundary*>& except)
{
	if (engine.boundaries.empty()) return " The engine has no boundaries.";
	std::ostringstream text;
	const int          dim = engine.grid->dim;
	for (size_t b = 0; b < engine.boundaries.size(); ++b) {
		const MpmBoundary& boundary = *engine.boundaries[b];
		if (std::find(except.begin(), except.end(), &boundary) != except.end()) continue;
		const auto         isNear   = [&](const MaterialPoint& p) {
                        const Vector3r reach = p.shape->halfSize + Vector3r::Constant(engine.grid->cellSize); // nodes of the cells that it touches
                        return ((p.state->pos + reach - boundary.min).head(dim).array() > 0).all() && ((boundary.max - p.state->pos + reach).head(dim).array() > 0).all();
		};
		if (std::none_of(points.begin(), points.end(), isNear))
			text << " boundaries[" << b << "], from (" << boundary.min.transpose() << ") to (" << boundary.max.transpose() << "), holds no node of any material.";
	}
	return text.str();
}

} // namespace yade
