# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings of Sphinx for scripts/docs, whose source folder is the whole project: pages stand where their links are right on any viewer of Markdown."""
import pathlib
import shutil

project = 'Implicit material point method for YADE'
root_doc = 'plugin/docs/index'
include_patterns = ['README.md', 'examples/README.md', 'examples/*/README.md', 'plugin/docs/*.md', 'plugin/docs/explanation/*.md', 'plugin/docs/tutorials/*.md', 'plugin/docs/classes/*.md', 'build/docs/reference.rst', 'build/docs/messages.md', 'plugin/docs/studies/*.md']
extensions = ['myst_parser', 'sphinx.ext.mathjax']
myst_enable_extensions = ['dollarmath']
myst_heading_anchors = 3
myst_update_mathjax = False  # it writes settings for MathJax 3; Debian has version 2
mathjax2_config = {'tex2jax': {'processClass': 'math'}}
mathjax_path = 'mathjax/MathJax.js?config=TeX-AMS_CHTML'
html_theme = 'alabaster'
html_theme_options = {'page_width': '1100px', 'fixed_sidebar': True, 'description': 'Reference and course'}
html_sidebars = {'**': ['about.html', 'navigation.html', 'searchbox.html']}
html_copy_source = False


def copyViews(app, failure):
	"""Files of mpm.view, which pages embed, beside those pages."""
	if failure or app.builder.name != 'html': return
	for view in pathlib.Path(app.srcdir).glob('examples/*/*.html'):
		shutil.copy(view, pathlib.Path(app.outdir) / 'examples' / view.parent.name)


def setup(app):
	app.connect('build-finished', copyViews)
