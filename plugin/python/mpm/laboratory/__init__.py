# SPDX-License-Identifier: GPL-2.0-or-later
"""Laboratory tests on a law, and parameters from them."""
