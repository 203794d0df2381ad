# SPDX-License-Identifier: GPL-2.0-or-later
"""Strips on sand, and walls in it, for scripts/sand."""
