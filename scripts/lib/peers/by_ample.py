# SPDX-License-Identifier: GPL-2.0-or-later
"""AMPLE GS (Coombs) in Octave: its set-ups run in a folder of their own, and their points after each step. Needs nothing of YADE.

The folder given is a checkout of branch AMPLE-GS of github.com/wmcoombs/AMPLE-m, which stays as it is.
"""
import os
import re
import shutil
import subprocess

import numpy as np

program = 'octave-cli'
folders = ['constitutive', 'functions', 'plotting', 'setup']
setups = dict(column='setupGrid', beam='setupGrid_beam', collapse='setupGrid_collapse')

# Reads the set-up that ships, and adds rows of empty elements above its mesh, constrained as its uppermost nodes.
setup = """function [lstps,g,mpData,mesh] = setupGrid
[lstps,g,mpData,mesh] = shipped;
rows = {rows};
if rows > 0
  span = max(mesh.coord); n = round(span./mesh.h); across = n(1)+1; nodes = size(mesh.coord,1);
  top = mesh.bc(mesh.bc(:,1) > 2*(nodes-across),:);
  for row = 1:rows
    mesh.bc = [mesh.bc; top(:,1)+2*across*row, top(:,2)];
  end
  [mesh.etpl,mesh.coord,mesh.ftpl,mesh.fntpl] = formCoord2D(n(1),n(2)+rows,span(1),span(2)+rows*mesh.h(2));
  mesh.eMin = mesh.coord(mesh.etpl(:,1),:); mesh.eMax = mesh.coord(mesh.etpl(:,3),:);
end
"""

# Written after each step instead of its output: points, and the solves of the step.
output = """if lstp == 0, tally = zeros(0,2); else, tally(lstp,:) = [NRit-1 fErr]; end
dlmwrite('steps.csv',tally,'precision','%.17g');
dlmwrite(sprintf('points%d.csv',lstp),[vertcat(mpData.mpC),horzcat(mpData.sig)'],'precision','%.17g');
"""


def missing(folder):
	"""What a run needs and does not find: the program, or files of the checkout."""
	wanted = [os.path.join(folder, 'ample.m'), *(os.path.join(folder, name) for name in folders), *(os.path.join(folder, 'setup', name + '.m') for name in setups.values()), os.path.join(folder, 'functions', 'ghostPenalty.m')]
	return [f'{program} (package octave)'] * (shutil.which(program) is None) + [path for path in wanted if not os.path.exists(path)]


def prepare(folder, into, name, tolerance, rows):
	"""Makes a folder in which AMPLE finds this set-up, tolerance and output before its own."""
	os.makedirs(into, exist_ok=True)
	links = {part: os.path.join(folder, part) for part in folders} | {'shipped.m': os.path.join(folder, 'setup', setups[name] + '.m')}
	for link, target in links.items():
		if not os.path.lexists(os.path.join(into, link)): os.symlink(os.path.abspath(target), os.path.join(into, link))
	with open(os.path.join(folder, 'ample.m')) as file:
		main, found = re.subn(r'\btol\s*=\s*[\d.e-]+', f'tol = {tolerance:g}', file.read())
	if found != 1: raise ValueError(f'{folder}/ample.m sets tol {found} times; once is admitted. Take branch AMPLE-GS.')
	for file, text in ('ample.m', main), ('setupGrid.m', setup.format(rows=rows)), ('postPro.m', output):
		with open(os.path.join(into, file), 'w') as written: written.write(text)


def run(folder, into, name, tolerance, rows, limit):
	"""Positions, Cauchy stresses (xx, yy, zz, xy) of all points at the start and after each step, and solves and residuals of the steps; earlier results in the folder are read."""
	last = os.path.join(into, 'ended')
	if not os.path.exists(last):
		prepare(folder, into, name, tolerance, rows)
		ended = subprocess.run([program, '--quiet', '--no-gui', 'ample.m'], cwd=into, timeout=limit, capture_output=True, text=True, env=os.environ | dict(OMP_NUM_THREADS='1'))
		if ended.returncode: raise RuntimeError(f'{name} of AMPLE ends with {ended.returncode}: {ended.stderr[:300]}')
		open(last, 'w').close()
	steps = np.loadtxt(os.path.join(into, 'steps.csv'), delimiter=',', ndmin=2)
	points = np.stack([np.loadtxt(os.path.join(into, f'points{step}.csv'), delimiter=',') for step in range(len(steps) + 1)])
	return points[..., :2], points[..., 2:6], steps
