# SPDX-License-Identifier: GPL-2.0-or-later
"""Features of the plugin in pairs: which there are and what does not go together, scenes of them, and what must not depend on how a scene is looked at."""
