// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/terms/inertia/time_scheme.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"
#include "engine/engines/explicit_steps.hpp"
#include "engine/points/energies.hpp"

namespace yade {
class MpmAbsorbingBoundary;

class MpmDynamicEngine : public Exposed<MpmDynamicEngine, MpmImplicitEngine> {
public:
	PointMass pointMass() const; // with the water that pores have
	string    scheme = "newmark";
	Real      beta = 0.25, gamma = 0.5, rhoInfinity = 0.8, timeTolerance = 0;
	int       loosePoints = 0;
	Real loadWork = 0, boundaryWork = 0, contactWork = 0, impactWork = 0, ghostWork = 0, gridWork = 0, plasticWork = 0, dampingWork = 0, frictionWork = 0,
	     penaltyWork = 0;
	// When the first step began; NaN: there was none.
	Real             firstEnergy = std::numeric_limits<Real>::quiet_NaN();
	vector<Vector3r> reactionsBefore;    // those of the step before
	Real             givenByContact = 0; // not saved: part of contactWork that neither a body has worked nor contact had stored [J]

	vector<shared_ptr<MpmAbsorbingBoundary>> absorbing;
	std::pair<Real, Real>                    rayleigh { 0, 0 };

	MpmDynamicEngine() { loadCurve = { { 0, 1 } }; }

	YADE_API_NAME(MpmDynamicEngine)
	static const char* doc()
	{
		return "Dynamic analysis, implicit or explicit: MpmImplicitEngine with inertia. Each run advances the material points in time, from the last "
		       "converged time to O.time + O.dt [s], with velocities that their states keep (*vel*; mpm.assign(velocity=...)). Consistent mass, stabilised "
		       "at the edge of the body as the stiffness is (MpmGhost.massFactor).\n\n"
		       "Set first: O.dt [s], in which waves go half a cell to one, O.dt = cellSize / solver.waveSpeed() at most; more where all is slow; *scheme* "
		       "= 'explicit' has a limit, criticalTimeStep(). Page: plugin/docs/classes/MpmDynamicEngine.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using E = MpmDynamicEngine;
		v("loadCurve", &E::loadCurve, noSave,
		  "Load factor [-] as of MpmImplicitEngine. Here it is 1 from the beginning unless another curve is given: loads act at once.",
		  admitting("one or more (time, factor), all finite, with increasing times", gimpm::LoadCurve::isAdmissible));
		v("scheme", &E::scheme, 0,
		  "Integration in time: 'newmark' (*beta*, *gamma*), 'generalised-alpha' (*rhoInfinity*), which damps high frequencies, 'midpoint', which keeps angular "
		  "momentum, or 'explicit', central differences, up to criticalTimeStep().",
		  oneOf("newmark", "generalised-alpha", "midpoint", "explicit"));
		v("beta", &E::beta, 0,
		  "Newmark's parameter [-] > 0 and <= 1; 1/4 with gamma = 1/2 is the trapezoidal rule. Below (gamma + 1/2)^2 / 4 long steps are unstable.",
		  part);
		v("gamma", &E::gamma, 0, "Newmark's parameter [-], 1/2 to 1; above 1/2 the scheme damps and is of first order only.",
		  admitting("a number from 1/2 to 1: below it, energy grows", [](Real value) { return value >= 0.5 && value <= 1; }));
		v("rhoInfinity", &E::rhoInfinity, 0, "Factor by which generalised-alpha keeps the highest frequencies in each step [-], 0 to 1.",
		  admitting("a number from 0 to 1", [](Real value) { return value >= 0 && value <= 1; }));
		v("timeTolerance", &E::timeTolerance, 0,
		  "Largest local error of displacements in a step [cells] >= 0: a step beyond it is cut (newton.minStep) and grows again. 0: not checked. Not with 'midpoint'.",
		  nonNegative);
		v("absorbing", &E::absorbing, 0, "Edges where waves leave the body (MpmAbsorbingBoundary); read as a tuple, so assign a new one to change it.");
		v("rayleigh", &E::rayleigh, 0,
		  "Rayleigh damping (alpha [1/s], beta [s]), both >= 0: alpha times mass and beta times the stiffness of the points as the step begins. (0, 0): none.",
		  admitting("two finite numbers >= 0", [](const auto& r) { return nonNegative(r.first) && nonNegative(r.second); }));
		v("loadWork", &E::loadWork, readonly, "Work of gravity, point loads and loads on surfaces so far [J].", finite);
		v("boundaryWork", &E::boundaryWork, readonly, "Work of boundaries that move, and of those that absorb, so far [J].", finite);
		v("contactWork", &E::contactWork, readonly, "Work of rigid bodies on the material so far, friction and penalties included [J].", finite);
		v("impactWork", &E::impactWork, readonly,
		  "Kinetic energy that constrained nodes have taken from points which came to them with other velocities, so far [J].", finite);
		v("ghostWork", &E::ghostWork, readonly, "Energy that ghost stabilisation has taken so far [J].", finite);
		v("gridWork", &E::gridWork, readonly,
		  "Energy lost so far because steps begin with the accelerations of the points, not with those of the stress on the new grid, and what "
		  "'generalised-alpha' damps by itself [J].",
		  finite);
		v("plasticWork", &E::plasticWork, readonly, "Energy dissipated by plastic flow so far [J].", finite);
		v("dampingWork", &E::dampingWork, readonly, "Energy that Rayleigh damping has taken so far [J].", finite);
		v("frictionWork", &E::frictionWork, readonly, "Energy that friction between rigid bodies and the material has dissipated so far [J].", finite);
		v("penaltyWork", &E::penaltyWork, readonly,
		  "Energy that penalties of contact with rigid bodies have taken so far [J]: stored, or lost where pressed surfaces part.", finite);
		v("loosePoints", &E::loosePoints, noSave | readonly,
		  "Points of the last step in cells with too few to tell the velocities of their nodes, as those that fly alone.", AnyValue());
		v("firstEnergy", &E::firstEnergy, hidden, "", AnyValue());
		v("reactionsBefore", &E::reactionsBefore, hidden, "",
		  admitting("forces of finite numbers [N]", [](const auto& forces) { return std::all_of(forces.begin(), forces.end(), finite); }));
	}

	template <class C> static void python(C& c) { addExplicitSteps(c); }

	bool isDynamic() const override { return true; }
	bool isExplicit() const override { return scheme == "explicit"; }
	void tellMotion(py::dict&) const override;

	vector<Listed> conditions() const override;
	std::uint64_t  checksumInTime() const override;

	gimpm::TimeScheme timeScheme() const;
	Real              ghostMass() const; // over the density

	void requireAdmissible() const override;

protected:
	const vector<Vector3r>& formerReactions() const override { return reactionsBefore; }
	void                    setMoving(Job<2>& job, const vector<MaterialPoint>& points) override;
	void                    setMoving(Job<3>& job, const vector<MaterialPoint>& points) override;

private:
	template <int Dim> void makeMoving(Job<Dim>&, const vector<MaterialPoint>&);
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmDynamicEngine)
