# SPDX-License-Identifier: GPL-2.0-or-later
"""Regions, their surfaces, and sections."""
