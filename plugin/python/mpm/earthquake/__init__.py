# SPDX-License-Identifier: GPL-2.0-or-later
"""Records of earthquakes, damping, and free ground beside a body that is shaken."""
