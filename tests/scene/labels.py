# SPDX-License-Identifier: GPL-2.0-or-later
"""Texts of a figure of matplotlib that lie over each other, by the boxes around them; and a watch over all figures that a script saves."""
import sys


def overlaps(figure):
	"""Pairs of texts that do, and the number of texts looked at."""
	from matplotlib.backends.backend_agg import FigureCanvasAgg
	own = figure.canvas
	canvas = FigureCanvasAgg(figure)
	try:
		canvas.draw()
		texts = list(_texts(figure))
		boxes = [text.get_window_extent(canvas.get_renderer()) for text in texts]
	finally:
		figure.set_canvas(own)
	deep = lambda a, b: min(a.x1, b.x1) - max(a.x0, b.x0) > 1 and min(a.y1, b.y1) - max(a.y0, b.y0) > 1
	return [[texts[i].get_text(), texts[j].get_text()] for i in range(len(texts)) for j in range(i) if deep(boxes[i], boxes[j])], len(texts)


def _texts(artist):
	"""Those that are seen; labels of ticks beyond the limits are not drawn."""
	from matplotlib.text import Text
	if not artist.get_visible(): return
	if isinstance(artist, Text) and artist.get_text().strip(): yield artist
	unseen = set()
	if hasattr(artist, 'get_major_ticks'):
		low, high = sorted(artist.get_view_interval())
		room = 1e-9 * (high - low)
		unseen = {tick for tick in artist.get_major_ticks() + artist.get_minor_ticks() if not low - room <= tick.get_loc() <= high + room}
	if hasattr(artist, 'axison') and not artist.axison: return
	for child in artist.get_children():
		if child not in unseen: yield from _texts(child)


def watch():
	"""Every figure that is saved from now on is looked at, and what overlaps is told on stderr."""
	from matplotlib.figure import Figure
	save = Figure.savefig

	def watched(figure, name, *arguments, **options):
		found, _ = overlaps(figure)
		for pair in found:
			print(f'labels overlap in {name}: {pair}', file=sys.stderr)
		return save(figure, name, *arguments, **options)

	Figure.savefig = watched
