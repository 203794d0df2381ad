// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/registration.hpp"

namespace yade {

class MpmNewton : public Exposed<MpmNewton, Serializable> {
public:
	Real tolerance     = 1e-6;
	int  maxIterations = 20;
	Real minStep           = 1. / 1024;
	int  lineSearchTrials  = 5;
	bool acceptUnconverged = false;
	bool predictor         = true;
	bool reuseFactor       = true;
	string linearSolver    = "auto";

	YADE_API_NAME(MpmNewton)
	static const char*             doc() { return "Settings of the Newton-Raphson solution of a load step (Coombs 2023, section 2.1)."; }
	template <class V> static void attributes(V&& v)
	{
		v("tolerance",
		  &MpmNewton::tolerance,
		  0,
		  "A step has converged when the residual on the free degrees of freedom is at most this part [-] of external forces and reactions, and around "
		  "each node at most three times this part of the forces there; between 0 and 1, both excluded.",
		  strictlyBetween(0, 1));
		v("maxIterations", &MpmNewton::maxIterations, 0, "Linear solves allowed in a step, at least 1.", atLeast(1));
		v("minStep",
		  &MpmNewton::minStep,
		  0,
		  "Smallest load step [-] as a part of O.dt, > 0 and <= 1: a step that does not converge is undone and tried again with half the increment, down "
		  "to this. 1: no cutting.",
		  part);
		v("lineSearchTrials",
		  &MpmNewton::lineSearchTrials,
		  0,
		  "Shorter steps (a half, a quarter, ...) that are tried when a full Newton step raises the residual by more than a tenth, and full steps after "
		  "it do not halve it each time until it is smaller than before, as they do in bending; at least 0; 0 takes every full step.",
		  atLeast(0));
		v("acceptUnconverged",
		  &MpmNewton::acceptUnconverged,
		  0,
		  "Whether a step that has not converged after *maxIterations*, at *minStep*, is taken over all the same, with a warning: for reproducing analyses "
		  "that did so.");
		v("predictor",
		  &MpmNewton::predictor,
		  0,
		  "Whether a step starts from the nodal displacements of the last one, in the ratio of the load increments, unless their residual is more than twice "
		  "that of zero; should it fail from there it begins again at zero. The same states to *tolerance*; with small load steps about half the solves. "
		  "False: every step starts from zero, as in the paper.");
		v("reuseFactor",
		  &MpmNewton::reuseFactor,
		  0,
		  "Whether the last iterations of a step keep the factorised stiffness matrix of the one before (modified Newton) where the convergence so far says "
		  "that this suffices. The same states to *tolerance*; more iterations (solver.reusedFactors of them with that factor), fewer factorisations. "
		  "False: every iteration has its own, as in the paper.");
		v("linearSolver",
		  &MpmNewton::linearSolver,
		  0,
		  "'direct': Cholesky factorisation, or LU of a matrix that is not positive definite; the only one that finds singular matrices. 'iterative': "
		  "conjugate gradients with the diagonal as preconditioner, as precise as Newton's method needs at the time, so the same states to *tolerance*; "
		  "it stores no factor. A step whose matrix is not positive definite or too ill-conditioned for it goes on with 'direct' (solver.cgFallbacks). It does "
		  "not notice a singular matrix whose equations have a solution all the same; bodies that nothing restrains are found "
		  "with both. 'auto': 'iterative' where the factorisation takes more than 10000 operations for each entry of the matrix: 3D from some "
		  "30000 unknowns, 2D from some millions.",
		  oneOf("auto", "direct", "iterative"));
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmNewton)
