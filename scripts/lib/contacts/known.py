# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of examples/penetration that were right with the corners of domains, by their own scripts."""
import contextlib
import io
import os
import re
import sys
import time

from examplerun import runExample
from yade.wrapper import Omega

O = Omega()
script = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))), 'examples', 'penetration', 'penetration.py')


def example(scene, seconds=300, **options):
	"""Error of the scene's number against its closed form, as the script tells it; *seconds* is not looked at."""
	O.reset()
	began, said = time.process_time(), io.StringIO()
	with contextlib.redirect_stdout(said): names = runExample(script, vars(sys.modules['__main__']), scene=scene, picture=0, **options)
	failed = re.findall(r'step \d+ of \d+ fails: .*', said.getvalue())
	pressure = re.search(r'largest mean pressure.*\(([+-][\d.]+) %\)', said.getvalue())
	more = dict(pressure=float(pressure[1]) / 100) if pressure else {}
	return dict(error=float(names['error']), **more, iterations=sum(names['solves']), steps=len(names['solves']), seconds=round(time.process_time() - began, 1), why=failed[0][:110] if failed else '')
