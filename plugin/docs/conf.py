# SPDX-License-Identifier: GPL-2.0-or-later
"""Settings of Sphinx for scripts/docs, whose source folder is the whole project: pages stand where their links are right on any viewer of Markdown.

With the tag pdf they are those of the manual in one file: pages that plugin/docs/manual.md lists, by LaTeX.
"""
import csv
import pathlib
import shutil

from docutils import nodes
from sphinx import addnodes
from sphinx.search import en

project = 'Implicit material point method for YADE'
author = 'The authors of the material point plugin'
isPdf = tags.has('pdf')  # noqa: F821, a name that Sphinx gives
root_doc = 'plugin/docs/manual' if isPdf else 'plugin/docs/index'
manual = ['README.md', 'plugin/docs/explanation/*.md', 'plugin/docs/tutorials/*.md', 'plugin/docs/classes/*.md']
manual += [f'plugin/docs/{name}.md' for name in ('manual', 'questions', 'installation', 'results', 'failures', 'processes', 'glossary')]
include_patterns = manual if isPdf else manual + ['examples/README.md', 'examples/*/README.md', 'plugin/docs/*.md', 'build/docs/reference.rst', 'build/docs/messages.md', 'plugin/docs/studies/*.md']
exclude_patterns = [] if isPdf else ['plugin/docs/manual.md']
extensions = ['myst_parser', 'sphinx.ext.mathjax']
myst_enable_extensions = ['dollarmath']
myst_heading_anchors = 3
if isPdf: suppress_warnings = ['ref.myst', 'myst.xref_missing']  # links to pages that are not in the manual
myst_update_mathjax = False  # it writes settings for MathJax 3; Debian has version 2
mathjax2_config = {'tex2jax': {'processClass': 'math'}}
mathjax_path = 'mathjax/MathJax.js?config=TeX-AMS_CHTML'
html_theme = 'alabaster'
html_theme_options = {'page_width': '1160px', 'sidebar_width': '270px', 'fixed_sidebar': True, 'description': 'Reference and course'}
html_sidebars = {'**': ['about.html', 'searchbox.html', 'localtoc.html', 'navigation.html']}
html_copy_source = False
html_show_copyright = False
html_search_scorer = str(pathlib.Path(__file__).parent / 'search.js')
# words of questions, which no page need have
en.SearchEnglish.stopwords = en.SearchEnglish.stopwords | set('can did do does from get have how its make must my should want what when where which who why you your'.split())


def copyViews(app, failure):
	"""Files of mpm.view, which pages embed, beside those pages."""
	if failure or app.builder.name != 'html': return
	for view in pathlib.Path(app.srcdir).glob('examples/*/*.html'):
		shutil.copy(view, pathlib.Path(app.outdir) / 'examples' / view.parent.name)


latex_engine = 'xelatex'
latex_documents = [(root_doc, 'manual.tex', project, author, 'manual')]
latex_use_xindy = False
latex_show_pagerefs = True
latex_elements = {
        'papersize': 'a4paper',
        'extraclassoptions': 'openany,oneside',
        'fncychap': '',
        'printindex': '',
        'preamble': r'\setcounter{tocdepth}{0} \setlength{\tymin}{55pt}',  # contents by chapter; columns that do not break names
}


def tagEquations(app, doctree, page):
	"""Equations with a number of their own, as (C1), which neither LaTeX nor MathJax admits in the environment that Sphinx puts around formulas."""
	for node in doctree.findall(nodes.math_block):
		if r'\tag' not in node.astext(): continue
		node['nowrap'] = node['no-wrap'] = True  # name up to Sphinx 8.1, and since
		node.children = [nodes.Text(r'\begin{equation*}' + node.astext() + r'\end{equation*}')]


with open(pathlib.Path(__file__).parent / 'keywords.csv', newline='') as file:
	keywords = list(csv.DictReader(file))


def addKeywords(app, doctree, page):
	"""Words for which users search, and which the page that answers does not have: an entry that leads to the section, and the single words."""
	rows = [row for row in keywords if row['page'] == page]
	if not rows: return
	doctree += addnodes.index(entries=[('single', row['words'], row['section'], '', None) for row in rows])
	doctree += nodes.meta(name='keywords', content=','.join(word for row in rows for word in row['words'].split()))


def setup(app):
	app.connect('doctree-resolved', tagEquations)
	app.connect('doctree-resolved', addKeywords)
	app.connect('build-finished', copyViews)
