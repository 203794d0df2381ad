// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The thread in which YADE makes the steps of O.run(n).

namespace yade {

// Ends what O.run(n) has begun, after the step that is being made; without Python's lock, which a step may wait for.
void endBackgroundRun();

// True while O.run(n) goes on from step to step; not in O.step(), and not once O.pause() has been called.
bool isRunGoingOn();

} // namespace yade
