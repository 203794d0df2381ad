# SPDX-License-Identifier: GPL-2.0-or-later
"""Messages, names of arguments, processes, and the engine that a function works on."""
