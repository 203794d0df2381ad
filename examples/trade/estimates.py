#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares what mpm.advise says of a scene with the run that follows: `examples/trade/estimates.py [--user]` adds results/estimates.csv to out/trade."""
import os
import sys

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, '..', '..', 'scripts', 'lib')]
from commands.trade import measure
from fronts import judged
from plans import Plan
from study import Study

study = Study('trade', __doc__)
study.parse(sys.argv[1:], timeLimit=600)

names = ['scene', 'dim', 'cells', 'pointsPerCell', 'steps']
scenes = [
        ('column', 2, 16, 2, 40), ('column', 2, 128, 3, 40), ('column', 3, 16, 2, 40), ('column', 3, 64, 3, 20), ('slope', 2, 1, 2, 40), ('slope', 2, 1, 4, 40),
        ('slope', 2, 2, 2, 80), ('slope', 2, 2, 3, 20), ('slope', 2, 4, 2, 10), ('collapse', 2, 2, 2, 20), ('collapse', 2, 4, 2, 80), ('cantilever', 2, 2, 2, 20),
        ('column', 2, 64, 4, 10), ('slope', 2, 1, 3, 80), ('slope', 2, 3, 2, 40), ('collapse', 2, 3, 3, 40)
] # the constants of mpm.advise were fitted to the first twelve
quantities = ['unknowns', 'fastest', 'usual', 'slowest', 'measuredTime', 'estimatedMemory', 'measuredMemory']
settings = [dict(zip(names, [f"'{scene}'", *map(str, values)])) | dict(advise='True') for scene, *values in scenes]
plan = Plan(script=os.path.join(here, 'scenes.py'), parameters=settings[0], together={}, quantities=quantities)
within = 0
for row in measure(study, 'estimates', plan, settings).rows.values():
	ratio, inRange = judged(row)
	within += 0.5 <= ratio <= 2
	print(*(row[name] for name in names), f"time {ratio:.2f} {'' if inRange else 'not '}in range, memory {float(row['estimatedMemory']) / max(1, float(row['measuredMemory'])):.2f}")
print(f'time within a factor of 2: {within} of {len(scenes)}')
