# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands of the studies, one module each; scripts/study runs them."""
