# SPDX-License-Identifier: GPL-2.0-or-later
"""Run in YADE by scripts/docs: writes the page of all classes, attributes and functions, from their docstrings, to the file named on the command line."""
import inspect
import os
import re
import sys

from yade import mpm, wrapper

folder = os.path.dirname(os.path.abspath(__file__))
flags = re.compile(r'\s*:yattrflags:`\d+`')
groups = {
        'Analysis': ['MpmImplicitEngine', 'MpmDynamicEngine', 'MpmGrid', 'MpmRefinement', 'MpmAdaptation', 'MpmGhost', 'MpmNewton'],
        'Conditions': ['MpmBoundary', 'MpmAbsorbingBoundary', 'MpmFreeField', 'MpmBaseMotion', 'MpmTraction', 'MpmReinforcement', 'MpmBeam', 'MpmWater', 'MpmFlow', 'MpmDrain', 'MpmSurface', 'MpmContact', 'MpmBodyContact', 'MpmBody', 'MpmCondition'],
        'Materials': ['MpmElasticMat', 'MpmVonMisesMat', 'MpmTrescaMat', 'MpmMohrCoulombMat', 'MpmDruckerPragerMat', 'MpmCamClayMat', 'MpmHardeningSoilMat', 'MpmNorSandMat', 'MpmUserMat', 'MpmFrictionalMat', 'MpmMaterial', 'MpmVanGenuchten', 'MpmGardner', 'MpmBrooksCorey', 'MpmRetentionTable', 'MpmRetention'],
        'Material points': ['MpmPoint', 'MpmState'],
        'Output': ['MpmVtkRecorder'],
}


def classes():
	"""Names of all classes of the plugin, in the order of the page; those in no group come last."""
	known = sorted(name for name in dir(wrapper) if name.startswith('Mpm'))
	ordered = [name for names in groups.values() for name in names]
	return [name for name in ordered if name in known] + [name for name in known if name not in ordered]


def isOwn(name, value):
	return isinstance(value, property) or callable(value) and not name.startswith('_')


def entries(cls):
	"""(name, value) of the attributes and methods that a class adds to its base."""
	return sorted((item for item in vars(cls).items() if isOwn(*item)), key=lambda item: (callable(item[1]), item[0]))


def docOf(value):
	return flags.sub('', value.__doc__ or '').strip().replace('(**', r'(\*\*')


def heading(text, line):
	return [text, line * len(text), '']


def indented(text):
	return ['   ' + line if line else '' for line in inspect.cleandoc(text).splitlines()] + ['']


def attribute(name, value, defaults):
	readonly = value.fset is None
	shown = re.sub(r'<(\w+) instance at \w+>', r'\1()', repr(defaults.get(name)))
	default = 'Read only.' if readonly else f'Default: ``{shown}``.' if name in defaults else ''
	return [f'.. py:attribute:: {name}', ''] + indented(docOf(value)) + ([f'   {default}', ''] if default else [])


def method(name, value):
	signature, _, text = docOf(value).partition('\n\n')
	return [f'.. py:method:: {signature}', ''] + indented(text)


def describe(cls):
	base = cls.__bases__[0]
	defaults = cls().dict()
	lines = heading(cls.__name__, '~') + [f'.. py:class:: {cls.__name__}(**attributes)', ''] + indented(docOf(cls))
	if os.path.exists(os.path.join(folder, 'classes', cls.__name__ + '.md')): lines += [f'   More on :doc:`the page of the class </plugin/docs/classes/{cls.__name__}>`.', '']
	lines += [f'   Attributes of its base {base.__name__} are inherited.', '']
	for name, value in entries(cls):
		lines += ['   ' + line if line else '' for line in (attribute(name, value, defaults) if isinstance(value, property) else method(name, value))]
	return lines


def function(name, module=mpm):
	value = getattr(module, name)
	if inspect.isclass(value):
		members = [(n, v) for n, v in vars(value).items() if callable(v) and not n.startswith('_')]
		lines = [f'.. py:class:: {name}{inspect.signature(value.__init__).replace(parameters=list(inspect.signature(value.__init__).parameters.values())[1:])}', '']
		lines += indented(docOf(value))
		for n, v in members:
			lines += [f'   .. py:method:: {n}{inspect.signature(v)}', ''] + ['   ' + line if line else '' for line in indented(docOf(v))]
		return lines
	return [f'.. py:function:: {name}{inspect.signature(value)}', ''] + indented(docOf(value))


def page():
	lines = heading('Reference', '=') + ['Generated from the docstrings, which ``help(MpmImplicitEngine)`` shows as well.', '']
	remaining = classes()
	for title, names in groups.items():
		lines += heading(title, '-')
		for name in names:
			lines += describe(getattr(wrapper, name))
			remaining.remove(name)
	if remaining: lines += heading('Further classes', '-')
	for name in remaining:
		lines += describe(getattr(wrapper, name))
	lines += heading('Module yade.mpm', '-') + ['.. py:module:: yade.mpm', ''] + inspect.cleandoc(mpm.__doc__).splitlines() + ['']
	for name in mpm.__all__:
		lines += function(name)
	lines += heading('Module yade.mpm.stages', '-') + ['.. py:module:: yade.mpm.stages', ''] + inspect.cleandoc(mpm.stages.__doc__).splitlines() + ['']
	for name in mpm.stages.__all__:
		lines += function(name, mpm.stages)
	return '\n'.join(lines)


with open(sys.argv[1], 'w') as file:
	file.write(page())
