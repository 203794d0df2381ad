# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost and error of an analysis, seepage, section forces, and safety."""
