// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/empty_model.hpp"
#include "engine/analysis/analysis.hpp"

namespace yade {

namespace {
	gimpm::LinearMethod linearMethod(const string& name)
	{
		if (name == "auto") return gimpm::LinearMethod::automatic;
		if (name == "amg") return gimpm::LinearMethod::multigrid;
		return name == "direct" ? gimpm::LinearMethod::direct : gimpm::LinearMethod::iterative;
	}
}

template <int Dim> gimpm::Model<Dim> emptyModel(const Analysis& analysis, const Conditions<Dim>& conditions)
{
	const MpmGhost&  ghost  = *analysis.ghost;
	const MpmNewton& newton = *analysis.newton;
	analysis.grid->requireAdmissible();
	ghost.requireAdmissible();
	newton.requireAdmissible();
	if (analysis.fBar && ghost.factor == 0)
		throw std::invalid_argument(
		        "fBar takes the dilation of points from the centres of their cells, also where these are nearly empty: it needs ghost stabilisation, "
		        "such as ghost=MpmGhost(), instead of ghost.factor=0.");
	gimpm::Model<Dim> model;
	model.grid                    = analysis.grid->lattice<Dim>();
	model.basis                   = analysis.basis == "mpm" ? gimpm::Basis::linear : gimpm::Basis::gimp;
	model.domains                 = analysis.domainRule();
	model.fBar                    = analysis.fBar;
	model.pressureRelaxation      = analysis.pressureRelaxation;
	model.ghost                   = { ghost.factor, ghost.scaling == "paper" ? gimpm::GhostScaling::paper : gimpm::GhostScaling::meshIndependent };
	model.ghost.memory            = ghost.memory;
	model.ghost.workTolerance     = ghost.workTolerance;
	model.ghost.threshold         = ghost.where == "aggregates" ? ghost.threshold : 0;
	model.newton.tolerance        = newton.tolerance;
	model.newton.maxIterations    = newton.maxIterations;
	model.newton.lineSearchTrials = newton.lineSearchTrials;
	model.newton.reuseFactor      = newton.reuseFactor;
	model.newton.keepFactor       = newton.keepFactor;
	model.newton.linearSolver     = linearMethod(newton.linearSolver);
	if (analysis.grid->axisymmetric) model.boundary = gimpm::Boundary<Dim>({ gimpm::ConstrainedBox<Dim>::ofAxis(model.grid) });
	for (const auto& condition : conditions)
		condition->hold(model);
	return model;
}

template gimpm::Model<2> emptyModel(const Analysis&, const Conditions<2>&);
template gimpm::Model<3> emptyModel(const Analysis&, const Conditions<3>&);

} // namespace yade
