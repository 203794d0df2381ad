# SPDX-License-Identifier: GPL-2.0-or-later
"""Material points: filling, data, initial stress, stages of construction, files."""
