// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/grid/point_cloud.hpp"
#include "core/stepping/predictor.hpp"
#include "core/stepping/step_control.hpp"
#include "engine/analysis/analysis.hpp"

namespace yade {

template <int Dim> class Moving;

// Model and points of the core, and the conditions on them. The terms of the model refer to the conditions, which live
// as long as this does.
template <int Dim> struct Setup {
	gimpm::Model<Dim>      model = gimpm::Model<Dim>();
	gimpm::PointCloud<Dim> cloud {};
	Conditions<Dim>        conditions {};
};

// Work of a run, and what remains to be done.
template <int Dim> struct Job : Setup<Dim> {
	Job(Setup<Dim>&& setup, const gimpm::StepControl& control, Real begin, Real target)
	        : Setup<Dim>(std::move(setup)), control(control), begin(begin), target(target)
	{
	}
	gimpm::StepControl control;
	Real               begin, target; // load times
	vector<string>     warnings {};   // doubts about settings

	std::shared_ptr<Moving<Dim>> moving {}; // null without inertia
};

// A load step, and what it may start from.
template <int Dim> struct Attempt {
	Real                      time;
	gimpm::Load<Dim>          load;
	bool                      predicts;
	gimpm::LastIncrement<Dim> last;
};

} // namespace yade
