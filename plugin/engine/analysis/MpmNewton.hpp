// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"

namespace yade {

class MpmNewton : public Exposed<MpmNewton, Serializable> {
public:
	Real   tolerance         = 1e-6;
	int    maxIterations     = 20;
	Real   minStep           = 1. / 1024;
	int    lineSearchTrials  = 5;
	bool   acceptUnconverged = false;
	bool   predictor         = true;
	bool   reuseFactor       = true;
	int    keepFactor        = 0;
	string linearSolver      = "auto";
	Real   stepTolerance     = 0;

	YADE_API_NAME(MpmNewton)
	static const char* doc()
	{
		return "Settings of the Newton-Raphson solution of a load step (Coombs 2023, section 2.1).\n\n"
		       "Leave *tolerance* at 1e-6. Set first: *stepTolerance* [m], if O.dt is the whole load; *minStep* = 1/64 where steps that fail are not worth "
		       "more cuts. Page: plugin/docs/classes/MpmNewton.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("tolerance", &MpmNewton::tolerance, 0,
		  "Converged: the residual is at most this part [-] of external forces and reactions, at each node three times this part of the forces there; > 0 "
		  "and < 1.",
		  strictlyBetween(0, 1));
		v("maxIterations", &MpmNewton::maxIterations, 0, "Linear solves allowed in a step, at least 1.", atLeast(1));
		v("minStep", &MpmNewton::minStep, 0,
		  "Smallest load step [-] as a part of O.dt, > 0 and <= 1: a step that does not converge is tried again with half the increment, down to this.",
		  part);
		v("lineSearchTrials", &MpmNewton::lineSearchTrials, 0,
		  "Shorter steps tried when forces pull back after a full Newton step and full steps after it do not lower the residual; 0 takes each "
		  "full step.",
		  atLeast(0));
		v("acceptUnconverged", &MpmNewton::acceptUnconverged, 0,
		  "True: a step that has not converged after *maxIterations*, at *minStep*, is taken over all the same, with a warning: for reproducing analyses "
		  "that did so.");
		v("predictor", &MpmNewton::predictor, 0,
		  "True: a step starts from the last displacements, in the ratio of the load increments: the same states to *tolerance*, with fewer solves. "
		  "False: from zero, as in the paper.");
		v("reuseFactor", &MpmNewton::reuseFactor, 0,
		  "True: a step's last iterations keep the factorised matrix of the one before where that suffices: the same states to *tolerance*, fewer "
		  "factorisations. False: never, as in the paper.");
		v("keepFactor", &MpmNewton::keepFactor, 0,
		  "Solves of a step [-] >= 0 that may take the factorised matrix of an earlier step, where that suffices: 3 where steps change little. 0: none.",
		  atLeast(0));
		v("linearSolver", &MpmNewton::linearSolver, 0,
		  "'direct': Cholesky or LU factorisation; 'iterative': conjugate gradients, which store no factor and fall back to 'direct' (solver.cgFallbacks); "
		  "'amg': these with algebraic multigrid (PETSc); 'auto': as it needs.",
		  oneOf("auto", "direct", "iterative", "amg"));
		v("stepTolerance", &MpmNewton::stepTolerance, 0,
		  "Largest estimated error of displacements in a quasi-static step [m] >= 0: steps beyond it are cut (*minStep*) and grow again, up to O.dt. 0: not "
		  "checked. Needs *predictor*.",
		  nonNegative);
	}
	void requireAdmissible() const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmNewton)
