// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/messages/ProgressLine.hpp"

namespace yade {
class Analysis;

// For the line on the terminal, after a load step. It may be a part of that of the iteration, which is then not done.
Progress progressOf(const Analysis&, bool isIterationDone);

} // namespace yade
