# SPDX-License-Identifier: GPL-2.0-or-later
"""Style of the pictures of the examples: colours that colour-blind readers tell apart (M. Okabe and K. Ito 2008), and text that can be read at half size. `from style import plt`."""
import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt

colours = '#0072B2', '#E69F00', '#009E73', '#D55E00', '#CC79A7', '#56B4E9', '#000000'  # C0 to C6: blue, orange, green, vermilion, purple, sky blue, black
plt.rcParams.update({'axes.prop_cycle': matplotlib.cycler(color=colours), 'font.size': 12, 'axes.titlesize': 'medium', 'legend.fontsize': 'small'})
