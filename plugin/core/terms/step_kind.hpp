// SPDX-License-Identifier: GPL-2.0-or-later
// Kind of a load step.
#pragma once

namespace gimpm {

enum class StepKind {
	quasiStatic, ///< without inertia
	dynamic,     ///< time step with inertia, implicit or explicit
};

} // namespace gimpm
