# SPDX-License-Identifier: GPL-2.0-or-later
"""Public laws of soils as user materials, for scripts/wild."""
