// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/stepping/load_curve.hpp"
#include "yade_api/exposed.hpp"

namespace yade {

// A load curve that may be left out, as then another one is meant.
struct CurveOrNothing {
	bool          operator()(const gimpm::LoadCurve::Knees& knees) const { return knees.empty() || gimpm::LoadCurve::isAdmissible(knees); }
	static string description() { return "nothing, or (time, factor), all finite, with increasing times"; }
};
inline constexpr CurveOrNothing curveOrNothing {};

} // namespace yade
