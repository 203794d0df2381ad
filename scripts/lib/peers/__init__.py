# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that other programs compute, too, for scripts/peers."""
