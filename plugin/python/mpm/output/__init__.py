# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures, films, tables of runs, and recorders."""
