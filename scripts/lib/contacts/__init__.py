# SPDX-License-Identifier: GPL-2.0-or-later
"""Cases by which contact with rigid bodies is measured: what they are, and by what they are judged (plan), and the scenes, each module a group of them. All by the public interface of the plugin."""
