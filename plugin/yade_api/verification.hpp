// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {

// Checks that are possible only when YADE has started: the complete layout, and that YADE knows every class of the
// plugin. A Python ImportError says what is wrong.
void verifyPlugin();

} // namespace yade
