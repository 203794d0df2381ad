// SPDX-License-Identifier: GPL-2.0-or-later
// What MpmImplicitEngine tells of a run: numbers for YADE's plot, and the line on the terminal.
#include "engine/points/MaterialPoints.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include <numeric>

namespace yade {

namespace {
	constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();

	// Over all material points.
	struct Totals {
		Real     volume0 = 0, plasticVolume0 = 0, elasticEnergy = 0, largestDisplacement = 0, settlement = -std::numeric_limits<Real>::infinity();
		Vector3r massTimesDisplacement = Vector3r::Zero();
	};

	Totals totals(const vector<MaterialPoint>& points, const Vector3r& gravity)
	{
		Totals         t;
		const Vector3r down = gravity.normalized(); // zero without gravity
		for (const MaterialPoint& point : points) {
			const MpmState& state        = *point.state;
			const Vector3r  displacement = state.pos - state.refPos;
			t.volume0 += state.volume0;
			if (state.plasticStrain > 0) t.plasticVolume0 += state.volume0;
			// per initial volume half Kirchhoff stress times strain; the former is J times the Cauchy stress, and J the ratio of volumes
			t.elasticEnergy += 0.5 * state.volume * state.stress.cwiseProduct(state.elasticStrain).sum();
			t.massTimesDisplacement += point.material->density * state.volume0 * displacement;
			t.largestDisplacement = std::max(t.largestDisplacement, displacement.norm());
			t.settlement          = std::max(t.settlement, displacement.dot(down));
		}
		return t;
	}

	string reactionName(const string& number, int axis) { return "reaction" + number + "_" + "xyz"[axis]; }
}

py::dict MpmImplicitEngine::plotData()
{
	const ValueLock lock;
	requireAdmissible();
	const auto     points = materialPoints(*ownScene(), mask);
	const Totals   t      = totals(points, gravity);
	const bool     isKnown = reactions.size() == boundaries.size();
	const Vector3r total   = std::accumulate(reactions.begin(), reactions.end(), Vector3r(Vector3r::Zero()));
	py::dict       data;
	data["step"]             = nDone;
	data["loadFactor"]       = loadFactor;
	data["iterations"]       = iterations;
	data["cuts"]             = cuts;
	data["residual"]         = residual;
	data["points"]           = points.size();
	data["settlement"]       = points.empty() || gravity.isZero(0) ? unknown : t.settlement;
	data["displacement"]     = points.empty() ? unknown : t.largestDisplacement;
	data["plasticShare"]     = points.empty() ? unknown : t.plasticVolume0 / t.volume0;
	data["elasticEnergy"]    = t.elasticEnergy;
	data["gravityPotential"] = -curveOfGravity().valueAt(loadTime) * gravity.dot(t.massTimesDisplacement);
	for (int axis = 0; axis < grid->dim; ++axis)
		data[reactionName("", axis)] = isKnown && !reactions.empty() ? total[axis] : unknown;
	for (size_t b = 0; b < boundaries.size(); ++b)
		for (int axis = 0; axis < grid->dim; ++axis)
			if (boundaries[b]->fixes(axis)) data[reactionName(std::to_string(b), axis)] = isKnown ? reactions[b][axis] : unknown;
	return data;
}

void MpmImplicitEngine::showProgress(size_t points, bool stepIsDone)
{
	const long last      = lastIteration(), step = scene->iter + 1;
	const bool runEnds   = scene->stopAtIter > scene->iter && step + iterPeriod > scene->stopAtIter;
	const bool isRunning = Singleton<Omega>::instance().isRunning();
	progressLine.show({ loadFactor, step, last, iterations, cuts, residual, points, isRunning, stepIsDone && runEnds }, verbosity);
}

// Of the run: where it is to stop, or where the load curves end; 0 if both are behind.
long MpmImplicitEngine::lastIteration() const
{
	const auto iterationAt = [&](Real time) { return scene->iter + long(std::ceil((time - scene->time) / scene->dt - 1e-6)); };
	if (scene->stopAtIter > scene->iter) return scene->stopAtIter;
	if (scene->stopAtTime > scene->time) return iterationAt(scene->stopAtTime);
	return loadsEnd() > scene->time ? iterationAt(loadsEnd()) : 0;
}

} // namespace yade
