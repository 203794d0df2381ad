# SPDX-License-Identifier: GPL-2.0-or-later
"""Scripts of the examples, found by words."""
import re

from .base.messages import brief
from .base.naming import didYouMean
from .scripts import scripts

# Words of other programs and trades, by what the examples call it
others = {
        'buoyancy': 'water', 'cpt': 'cone', 'cptu': 'cone', 'dam': 'drawdown', 'debris': 'run-out', 'dem': 'grains', 'dtm': 'terrain', 'esri': 'terrain', 'excavation': 'wall', 'fos': 'safety', 'geotextile': 'embankment',
        'groundwater': 'seepage', 'landslide': 'slope', 'lining': 'tunnel', 'phi-c': 'safety', 'pipe': 'tunnel', 'pipeline': 'tunnel', 'retaining': 'wall', 'seismic': 'earthquake', 'silo': 'grains', 'spectrum': 'earthquake',
        'srf': 'safety', 'stl': 'mesh', 'surcharge': 'pressure', 'umat': 'hypoplastic', 'uplift': 'anchor', 'usermat': 'hypoplastic'
}


def examples(words=''):
	"""Find scripts to begin from: prints the command of each that all of the words are about, tasks of thirty lines first, and what it is. ::

		mpm.examples('footing')
		mpm.examples('MpmTraction')
		mpm.examples('slope water')

	The scripts are in the folder of the project, where the commands are given; README.md there says which task is done how, and how sure the numbers are.

	:param words: text, of one word or several; none: all scripts
	:return: list of the paths
	:raises TypeError: words that are no text.
	"""
	if not isinstance(words, str): raise TypeError(f"examples: words = {brief(words)} must be a text, as in mpm.examples('footing')")
	wanted = words.lower().split()
	found = [(path, sentence) for path, sentence, text in scripts if all(_isAbout(word, f'{path} {sentence} {text}'.lower()) for word in wanted)]
	for path, sentence in found:
		print(f'scripts/run {path:52} {sentence}')
	if not found: print(f'No script is about {words!r}.{didYouMean(words, _vocabulary())}')
	return [path for path, _ in found]


def _isAbout(word, text):
	"""True if a word of the text begins with it, in the singular, or with the name of it in the examples."""
	names = {word, word[:-1] if word.endswith('s') and len(word) > 3 else word, others.get(word, word)}
	return any(re.search(r'(?<![a-z])' + re.escape(name), text) for name in names)


def _vocabulary():
	return sorted({word for path, sentence, text in scripts for word in re.findall(r'[A-Za-z][\w.-]+', f'{path} {text}')} | set(others))
