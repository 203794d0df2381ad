# SPDX-License-Identifier: GPL-2.0-or-later
"""Common parts of the cases: steps that are counted and end in time, and how smooth a curve is."""
import contextlib
import os
import re
import tempfile
import time
from collections import Counter

import numpy as np
from yade.wrapper import Omega

O = Omega()


class Course:
	"""Steps of a solver that are counted; they end where one fails or the processor time is used up, and *why* says so.

	:param seconds: of processor time for all steps
	"""

	def __init__(self, solver, seconds):
		self.solver, self.ends = solver, time.process_time() + seconds
		self.began = time.process_time()
		self.steps, self.iterations, self.cuts, self.why = 0, 0, 0, ''

	def run(self, steps, look=lambda: None):
		"""True if all of the steps were made; look() after each."""
		for _ in range(steps):
			if self.why: return False
			if time.process_time() > self.ends: self.why = 'time is up'
			else: self._step()
			if self.why: return False
			look()
		return True

	def _step(self):
		try:
			O.step()
		except RuntimeError as failure:
			self.why = reason(failure)
		self.iterations += self.solver.iterations
		self.cuts += self.solver.cuts
		self.steps += not self.why

	def told(self):
		return dict(iterations=self.iterations, cuts=self.cuts, steps=self.steps, seconds=round(time.process_time() - self.began, 1), why=self.why)


def reason(failure):
	"""The part of the message of a step that failed which says why, short."""
	text = str(failure).split(' failed: ')[-1].split(' Residuals: ')[0].split('. ')[0]
	return re.sub(r'\s+', ' ', text)[:110]


def reasons(whys, most=5):
	"""Number of times of each of them, without the numbers in it."""
	count = Counter(re.sub(r'[-+]?\d[\d.e+-]*|\(.*?\)', '..', why) for why in whys if why)
	return '; '.join(f'{n} x {why}' for why, n in count.most_common(most))


def smoothness(s, F, cell, since):
	"""Mean and largest deviation of F(s) from its mean over one cell's travel around each step, over that mean, for s beyond *since*. NaN where the way is too short."""
	s, F = np.asarray(s), np.asarray(F)
	if len(s) < 3: return np.nan, np.nan
	work = np.concatenate([[0], np.cumsum(np.diff(s) * (F[1:] + F[:-1]) / 2)])
	inner = (s - cell / 2 >= max(since, s[0]) - 1e-9) & (s + cell / 2 <= s[-1] + 1e-9)
	if not inner.any(): return np.nan, np.nan
	mean = (np.interp(s[inner] + cell / 2, s, work) - np.interp(s[inner] - cell / 2, s, work)) / cell
	off = np.abs(F[inner] / mean - 1)
	return float(off.mean()), float(off.max())


def meanBetween(s, F, low, high):
	"""Mean of F over the steps with s in a range, NaN if there are none."""
	s, F = np.asarray(s), np.asarray(F)
	chosen = (s >= low - 1e-9) & (s <= high + 1e-9)
	return float(F[chosen].mean()) if chosen.any() else float('nan')


def spread(values):
	"""Largest less smallest of some forces over their mean; infinite if that is nothing."""
	values = np.asarray(values, float)
	mean = abs(values.mean())
	return float(np.ptp(values) / mean) if mean > 0 else float('inf')


class _Said:
	text = ''


@contextlib.contextmanager
def said():
	"""Standard error while the block runs, as warnings of the plugin are: `with said() as it: ...; it.text`."""
	it, kept = _Said(), os.dup(2)
	with tempfile.TemporaryFile() as file:
		os.dup2(file.fileno(), 2)
		try:
			yield it
		finally:
			os.dup2(kept, 2)
			os.close(kept)
			file.seek(0)
			it.text = file.read().decode(errors='replace')
