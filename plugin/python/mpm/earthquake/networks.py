# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of strong-motion networks: ESM, K-NET and KiK-net, COSMOS V2, CSMIP V2 (CGS) and SMC (USGS), with what their headers tell.

Sources: header of DYNA 1.2 files (ESM, INGV); K-NET ASCII format (NIED); COSMOS Strong Motion Data Format 1.20 (2001); A. F. Shakal and
M. J. Huang, Standard Tape Format for CSMIP Strong-Motion Data Tapes (CDMG 1985); the SMC format of the National Strong-Motion Project (USGS).
"""
import math
import re
from types import SimpleNamespace

import numpy as np

from ..base.messages import brief, isNumber

_quantities = {'accel': 'acceleration', 'veloc': 'velocity', 'displ': 'displacement'}
_null = 1e38  # reals of SMC files that are larger are not known


def unitNamed(text):
	"""A unit as the project writes it: 'cm/sec/sec', 'CM/S**2' and 'gal' are 'cm/s2'."""
	plain = re.sub(r'\s+', '', text).lower().strip('.,;()[]').replace('sec', 's').replace('**', '').replace('^', '').replace('/s/s', '/s2')
	return {'gal': 'cm/s2', 'gals': 'cm/s2', 'cm/s2/s': 'cm/s3'}.get(plain, plain)


def series(name, lines, quantity, channel):
	"""Contents of a file of one of these forms: step [s], values, unit, title, and whether its baseline is corrected; None for a file of another form."""
	reader = next((reader for isMeant, reader in _forms if lines and isMeant(lines)), None)
	if reader is None: return None
	found = reader(name, lines)
	own = [one for one in found if one.quantity == quantity]
	if not own:
		kinds = ', '.join(dict.fromkeys(one.quantity for one in found))
		raise ValueError(f'record: {name} has no {quantity}, as quantity says, but {kinds} ({found[0].unit}); a displacement is not admitted')
	return _chosen(name, own, channel)


def _chosen(name, own, channel):
	known = ', '.join(f'{one.channel} ({one.title})' for one in own)
	if channel is None:
		if len(own) > 1: raise ValueError(f'record: {name} has {len(own)} channels, so that channel must say which one is meant: {known}')
		return own[0]
	if not isNumber(channel): raise TypeError(f'record: channel = {brief(channel)} must be the number of a channel, one of {known}')
	meant = [one for one in own if one.channel == channel]
	if len(meant) != 1: raise ValueError(f'record: channel = {brief(channel)} is none of {name}, which has {known}')
	return meant[0]


def _one(name, quantity, unit, step, values, title, isCorrected, channel=1):
	if not (math.isfinite(step) and step > 0): raise ValueError(f'record: {name} tells in its header a time step of {step:g} s; expected is one > 0')
	return SimpleNamespace(quantity=quantity, unit=unitNamed(unit), step=step, values=np.array(values, float), title=' '.join(title.split()), isCorrected=isCorrected, channel=channel)


def _number(name, what, text):
	try:
		return float(text)
	except ValueError:
		raise ValueError(f'record: {name} has {brief(text.strip())} as {what} in its header, which is no number') from None


def _numbers(name, lines, first, count, form):
	"""Numbers in columns of equal width from a line on, as Fortran's (8F10.3) writes them: they may touch each other."""
	found = re.match(r'\s*(\d*)\s*(?:1P)?\s*\d*[IFEGD]\s*(\d+)', form, re.IGNORECASE)
	if not found: raise ValueError(f'record: {name} has the format {brief(form)} in line {first}, which is not understood')
	inRow, width, values = int(found[1] or 1), int(found[2]), []
	for number in range(first, first + math.ceil(count / inRow)):
		row = lines[number].rstrip() if number < len(lines) else ''
		here = min(inRow, count - len(values))
		words = [row[i * width:(i + 1) * width] for i in range(here)]
		try:
			values += [float(word) for word in words]
		except ValueError:
			raise ValueError(f'record: {name}, line {number + 1}: {brief(row.strip())} does not have {here} numbers of {width} characters ({count} are announced): is the file cut off?') from None
	if not np.isfinite(values).all(): raise ValueError(f'record: {name} has values that are not finite')
	return values


def _plainNumbers(name, lines, first, count):
	"""Numbers between blanks, all from a line on; their number is announced."""
	values = []
	for number, line in enumerate(lines[first:], first + 1):
		try:
			values += [float(word) for word in line.split()]
		except ValueError:
			raise ValueError(f'record: {name}, line {number}: {brief(line.strip())} has what is no number') from None
	if len(values) != count: raise ValueError(f'record: {name} has {len(values)} values, and {count} are announced: is the file cut off?')
	if not np.isfinite(values).all(): raise ValueError(f'record: {name} has values that are not finite')
	return values


def _fields(name, header, wanted):
	missing = [key for key in wanted if not header.get(key)]
	if missing: raise ValueError(f"record: {name} does not tell {', '.join(missing)} in its header")
	return [header[key] for key in wanted]


def _ofEsm(name, lines):
	count = next((i for i, line in enumerate(lines) if not re.match(r'[A-Z][A-Z0-9_/^]*:', line)), len(lines))
	header = {key: value.strip() for key, _, value in (line.partition(':') for line in lines[:count])}
	step, samples, kind, unit = _fields(name, header, ['SAMPLING_INTERVAL_S', 'NDATA', 'DATA_TYPE', 'UNITS'])
	values = _plainNumbers(name, lines, count, int(_number(name, 'NDATA', samples)))
	title = ', '.join(header[key] for key in ('EVENT_NAME', 'EVENT_DATE_YYYYMMDD', 'STATION_CODE', 'STREAM') if header.get(key))
	baseline = header.get('BASELINE_CORRECTION', '').upper()
	isCorrected = None if not baseline else 'REMOVED' in baseline and 'NOT' not in baseline
	return [_one(name, kind.lower(), unit, _number(name, 'SAMPLING_INTERVAL_S', step), values, title, isCorrected)]


def _ofKnet(name, lines):
	count = next((i for i, line in enumerate(lines[:40]) if line.startswith('Memo')), None)
	if count is None: raise ValueError(f'record: {name} has no line Memo., with which a header of K-NET ends')
	header = {line[:18].strip(): line[18:].strip() for line in lines[:count]}
	frequency, duration, scale = _fields(name, header, ['Sampling Freq(Hz)', 'Duration Time(s)', 'Scale Factor'])
	found = re.fullmatch(r'([\d.]+)\s*\(gal\)\s*/\s*([\d.]+)', scale)
	if not found: raise ValueError(f"record: {name} has the Scale Factor {brief(scale)}; expected is one as '7845(gal)/8223790'")
	frequency = _number(name, 'Sampling Freq(Hz)', re.sub(r'\s*Hz$', '', frequency))
	values = _plainNumbers(name, lines, count + 1, round(frequency * _number(name, 'Duration Time(s)', duration)))
	sensors = {str(3 * k + i + 1): f'{way} {place}' for k, place in enumerate(('in the borehole', 'at the surface')) for i, way in enumerate(('N-S', 'E-W', 'U-D'))}  # sensors of KiK-net
	direction = header.get('Dir.', '')
	title = ', '.join(part for part in (header.get('Origin Time'), header.get('Station Code'), sensors.get(direction, direction)) if part)
	return [_one(name, 'acceleration', 'gal', 1 / frequency if frequency else math.inf, np.array(values) * float(found[1]) / float(found[2]), title, False)]


def _ofCosmos(name, lines):
	found, row = [], 0
	while row < len(lines):
		head = _cosmosHead(lines[row])
		if not head:
			row += 1
			continue
		text, row = lines[row:row + int(head[1])], row + int(head[1])
		integers, row = _cosmosBlock(name, lines, row, 'Integer-header')
		reals, row = _cosmosBlock(name, lines, row, 'Real-header')
		row += 1 + int(_announced(name, lines, row, r'(\d+)\s+Comment line')[1])
		data = _announced(name, lines, row, r'(\d+)\s+(\w+)\s+pts.*units\s*=\s*([^,(]+?)\s*(?:\(\s*\d+\s*\))?\s*,\s*Format\s*=\s*\(([^)]*)\)')
		values = _numbers(name, lines, row + 1, int(data[1]), data[4])
		row += 1
		channel = re.search(r'Sta Chan\s+(\d+)', text[8])
		number = int(channel[1]) if channel else 1 + sum(one.quantity == data[2].lower() for one in found)
		title = ', '.join(part.strip() for part in (text[1], text[4].partition('Code:')[2] or text[4], text[8]))
		found.append(_one(name, data[2].lower(), data[3], reals[33], values, title, text[0].lower().startswith('corrected'), number))
	return found


def _cosmosHead(line):
	return re.search(r'\(Format v?[\d.]+ with\s+(\d+) text lines\)', line, re.IGNORECASE)


def _announced(name, lines, row, pattern):
	found = re.match(r'\s*' + pattern, lines[row], re.IGNORECASE) if row < len(lines) else None
	if not found: raise ValueError(f'record: {name}, line {row + 1}: {brief(lines[row].strip() if row < len(lines) else "")} is not what a COSMOS file has there')
	return found


def _cosmosBlock(name, lines, row, what):
	head = _announced(name, lines, row, rf'(\d+)\s+{what} values follow on\s+(\d+)\s+lines?,\s*Format\s*=\s*\(([^)]*)\)')
	return _numbers(name, lines, row + 1, int(head[1]), head[3]), row + 1 + int(head[2])


def _ofCsmip(name, lines):
	found, title, isCorrected, channel = [], '', None, 1
	for row, line in enumerate(lines):
		if re.match(r'\s*corrected accelerogram', line, re.IGNORECASE):
			head = lines[row:row + 25]
			isCorrected = any('baseline' in text.lower() and 'corrected' in text.lower() for text in head)
			own = re.search(r'Chan\s+(\d+)', ' '.join(head))
			channel = int(own[1]) if own else 1 + len({one.channel for one in found})
			title = ', '.join(text[:40].strip() if i != 7 else text.strip() for i, text in enumerate(head) if i in (6, 7, 8))
		data = re.match(r'\s*(\d+)\s+points of (accel|veloc|displ)\w* data equally spaced at\s*([\d.]+)\s*sec[.,]\s*(?:in\s+(\S+?)\.?\s*\(([^)]*)\)|\(units:\s*([^)]*)\))', line, re.IGNORECASE)
		if data:  # files of the eighties tell the unit alone
			values = _numbers(name, lines, row + 1, int(data[1]), data[5] or '8f10.3')
			found.append(_one(name, _quantities[data[2].lower()], data[4] or data[6], float(data[3]), values, title, isCorrected, channel))
	if not found: raise ValueError(f'record: {name} begins as a file of CSMIP, and has no line "points of accel data equally spaced at"; is it of Volume 2, and whole?')
	return found


def _ofSmc(name, lines):
	kind = re.match(r'\s*(\d)\s+(.*)', lines[0])[1]
	kinds = {'1': ('acceleration', 'cm/s2'), '2': ('acceleration', 'cm/s2'), '3': ('velocity', 'cm/s'), '4': ('displacement', 'cm')}
	if kind not in kinds: raise ValueError(f'record: {name} is an SMC file of {brief(lines[0].strip())}, which is no history')
	integers, reals = _numbers(name, lines, 11, 48, '8I10'), _numbers(name, lines, 17, 50, '5E15.7')
	if not reals[1] < _null: raise ValueError(f'record: {name} is an SMC file of {brief(lines[0].strip())} at unequal times, without a rate of samples; take the corrected one')
	values = _numbers(name, lines, 27 + int(integers[15]), int(integers[16]), '8E10.4')
	title = ', '.join(part for part in (lines[3].strip(), re.sub(r'\s*(station|component)\s*=\s*', r' ', lines[5]).strip()) if part)
	return [_one(name, *kinds[kind], 1 / reals[1] if reals[1] else math.inf, values, title, kind != '1')]


_forms = [
        (lambda lines: lines[0].startswith('EVENT_NAME:') and any(line.startswith('SAMPLING_INTERVAL_S:') for line in lines[:80]), _ofEsm),
        (lambda lines: lines[0].startswith('Origin Time'), _ofKnet),
        (lambda lines: bool(_cosmosHead(lines[0])), _ofCosmos),
        (lambda lines: bool(re.match(r'\s*(un)?corrected accelerogram', lines[0], re.IGNORECASE)), _ofCsmip),
        (lambda lines: bool(re.match(r'\s*[0-6]\s+(UNKNOWN|UNCORRECTED ACC|CORRECTED ACC|VELOCITY|DISPLACEMENT|RESPONSE|FOURIER)', lines[0])), _ofSmc),
]
