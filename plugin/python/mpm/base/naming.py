# SPDX-License-Identifier: GPL-2.0-or-later
"""Names that a script gives: of arguments, and labels of materials."""
import builtins
import functools
import inspect

from yade import wrapper

from ..library import engine
from .messages import brief


def didYouMean(name, known):
	"""A question that follows a message, with the names that are most like another one; empty if none is."""
	return engine.didYouMean(str(name), [str(one) for one in known])


class ShortName:
	"""Name of a class without its ending, in the builtins of Python: it tells whoever calls it which class is meant."""

	def __init__(self, name, meant):
		self._text = f"name {name!r} is not defined; did you mean {meant!r}?"

	def __call__(self, *arguments, **keywords):
		raise NameError(self._text)


def tellShortNames(classes):
	"""Make short names such as MpmVonMises tell that MpmVonMisesMat is meant."""
	for name in classes:
		for ending in 'Mat', 'Engine':
			short = name.removesuffix(ending)
			if short != name and short not in classes and len(short) > len('Mpm') and not hasattr(builtins, short): setattr(builtins, short, ShortName(short, name))


def telling(thing):
	"""A function, or a class with its constructor, that tells of a keyword argument which it does not have what may have been meant."""
	if inspect.isclass(thing):
		thing.__init__ = _telling(thing.__init__, thing.__name__)
		return thing
	return _telling(thing, thing.__name__)


def _telling(function, name):
	signature = inspect.signature(function)
	known = [parameter for parameter in signature.parameters.values() if parameter.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD and parameter.name != 'self']
	takesAny = any(parameter.kind is inspect.Parameter.VAR_KEYWORD for parameter in signature.parameters.values())
	needed = [parameter.name for parameter in known if parameter.default is inspect.Parameter.empty]

	@functools.wraps(function)
	def checked(*arguments, **keywords):
		others = [keyword for keyword in keywords if keyword not in signature.parameters]
		if others and not (takesAny and set(needed) <= set(signature.bind_partial(*arguments, **keywords).arguments)): _refuse(others[0])
		return function(*arguments, **keywords)

	def _refuse(keyword):
		names = [parameter.name for parameter in known]
		raise TypeError(f"{name}: there is no argument {keyword!r}{didYouMean(keyword, names) or '.'} It takes {', '.join(names) or 'none'}.")

	return checked


def materialOf(who, label):
	"""The material in O.materials that has this label; the errors say what is wrong with the label. It may be of any class."""
	materials = wrapper.Omega().materials
	known = [m.label for m in materials if m.label]
	if not label:
		raise ValueError(f"{who}: material = '' is no label: give the material one, as in MpmElasticMat(..., label='soil')")
	if label not in known:
		there = f'which has {known}{didYouMean(label, known)}' if known else 'which has no material with a label yet; append it there before filling'
		raise KeyError(f'{who}: material = {brief(label)} is not in O.materials, {there}')
	if known.count(label) > 1:
		numbers = [str(i) for i, m in enumerate(materials) if m.label == label]
		raise ValueError(
		        f"{who}: material {brief(label)} is the label of {len(numbers)} materials, O.materials[{'] and O.materials['.join(numbers)}], of which only the first would be taken; "
		        'give each a label of its own'
		)
	return materials[label]
