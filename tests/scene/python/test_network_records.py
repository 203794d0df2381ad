# SPDX-License-Identifier: GPL-2.0-or-later
"""Records in the forms of strong-motion networks, written here column by column as their descriptions say, read by mpm.record."""
write = '''
from scenes import *
import numpy as np

n, dt = 1003, 0.02  # the last row of eight is not full
t = dt * np.arange(n)
acceleration = np.round(np.where(t < 16, 100 * np.sin(np.pi * t / 4)**3 * np.sin(np.pi * t / 16), 0), 7)  # [cm/s2]
velocity = np.cumsum(acceleration) * dt
rows = lambda values, form, width: '\\\\n'.join(''.join(form % x for x in values[i:i + width]) for i in range(0, len(values), width)) + '\\\\n'

def asRead(values, form):
	"""What the digits of a file tell."""
	return np.array([float(form % x) for x in values])

def esm(kind='ACCELERATION', unit='cm/s^2', baseline='BASELINE REMOVED', count=n):
	head = dict(EVENT_NAME='CENTRAL VALLEY', EVENT_ID='X-1', EVENT_DATE_YYYYMMDD=20160824, NETWORK='XX', STATION_CODE='ABC', STATION_NAME='Town: Hall', LOCATION='', SAMPLING_INTERVAL_S='0.020000', NDATA=count,
		STREAM='HNE', UNITS=unit, INSTRUMENT='sensor = Q [Unknown] | digitizer = Unknown', BASELINE_CORRECTION=baseline, HEADER_FORMAT='DYNA 1.2', DATA_TYPE=kind, PROCESSING='manual', USER5='')
	head = {**head, 'INSTRUMENT_ANALOG/DIGITAL': 'D', 'PGA_CM/S^2': '1.0', 'LATE/NORMAL_TRIGGERED': 'NT'}
	return ''.join(f'{key}: {value}\\\\n' for key, value in head.items()) + rows(acceleration, '%.6f', 1)

counts = np.round((acceleration - 7.5) / 7845 * 8223790)  # with an offset
def knet(direction='E-W', length='20.06'):
	head = [('Origin Time', '2014/12/31 23:49:00'), ('Lat.', '35.785'), ('Long.', '139.887'), ('Depth. (km)', '84'), ('Mag.', '4.2'), ('Station Code', 'CHB003'), ('Station Lat.', '35.79'), ('Station Long.', '140.05'),
		('Station Height(m)', '28'), ('Record Time', '2014/12/31 23:50:11'), ('Sampling Freq(Hz)', '50Hz'), ('Duration Time(s)', length), ('Dir.', direction), ('Scale Factor', '7845(gal)/8223790'),
		('Max. Acc. (gal)', '8.0'), ('Last Correction', '2014/12/31 23:50:12'), ('Memo.', '')]
	return ''.join(f'{key:18}{value}\\\\n' for key, value in head) + rows(counts, '%8d ', 8)

def cosmos(channels=(1, 2), form='%10.5f', code='8F10.5', unit='cm/sec2(04)'):
	text = ''
	for channel in channels:
		for kind, values, own in (('acceleration', channel * acceleration, unit), ('velocity', channel * velocity, 'cm/sec(05)')):
			head = [f'Corrected {kind}    (Format v01.20 with 13 text lines)', 'Record of Some Earthquake of Fri Nov 30, 2018 17:29 UTC', 'Hypocenter: 61.3', 'Origin: 2018', 'Statn No: 37-000011 Code:AK-BMR     UAF  River', 'Coords:', 'Recorder:',
				'Rcrd start time:', f'Sta Chan {channel:3}: {90 * channel} deg   (Rcrdr Chan  1) Location:', 'Raw record length = 210.000 sec', 'Processed:2019', 'Record filtered below  0.03 Hz', 'Values used when unknown: -999']
			reals = np.full(100, -999.)
			reals[33] = dt
			text += '\\\\n'.join(head) + '\\\\n 100 Integer-header values follow on  10 lines, Format= (10I8)\\\\n' + rows(np.full(100, -999), '%8d', 10)
			text += ' 100 Real-header values follow on  20 lines, Format= (5F15.6)\\\\n' + rows(reals, '%15.6f', 5) + '   2 Comment line(s) follow, each starting with a "|":\\\\n| Sensor\\\\n|<SCNL>\\\\n'
			text += f'{n:8} {kind} pts, approx   20 secs, units={own},Format=({code})\\\\n' + rows(values, form, int(code[0])) + f'End-of-data for Chan {channel:2} {kind}\\\\n'
	return text

def csmip(channels=(1, 3), isOld=False):
	text = ''
	for channel in channels:
		head = ['Corrected accelerogram   1.CI.WLT.--.HN', 'Uncorrected Accelerogram Data', 'Rcrd of Fri', '', '1.CI', 'Station Id. WLT', 'Hacienda Heights                         SCSN   Data: Acceleration', f'Chan {channel:2}:  90 Deg', 'Rcrd of Fri Mar 28, 2014 21:09:34.0 PDT    Fri Mar',
			'Hypocenter:', 'Instr Period', 'Record length', 'Uncor Max', 'RMS accel', 'Accelerogram bandpass filtered', f' {n} points of instrument- and baseline-corrected accel, veloc and displ data', 'At equally', 'Peak acceleration', 'Peak velocity', 'Peak displ', 'Initial', 'Rcrd', '', '1.CI', '']
		text += '\\\\n'.join(head) + '\\\\n' + rows(np.full(100, -999), '%5d', 16) + rows(np.full(100, -99.), '%10.5f', 8)
		for kind, values, unit in (('accel', channel * acceleration, 'cm/sec2.'), ('veloc', channel * velocity, 'cm/sec. ')):
			if isOld: text += f'{n:6} POINTS OF {kind.upper()} DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: {unit.strip(". ").upper()})\\\\n' + rows(values, '%10.3f', 8)
			else: text += f'{n:6} points of {kind} data equally spaced at  .020 sec, in {unit} (8f10.5)\\\\n' + rows(values, '%10.5f', 8)
		text += f'/&  ---------- End of data for channel {channel:2} ----------\\\\n'
	return text

def smc(kind='2 CORRECTED ACCELEROGRAM', rate=1 / dt):
	integers, reals = np.full(48, -32768), np.full(50, 1.7e38)
	integers[15], integers[16], reals[1] = 3, n, rate
	short = lambda x: ('% .4E' % x).replace('E-0', 'E-').replace('E+0', 'E+')[:10]
	head = [kind, '*', 'SAF0B', '     1989  10  18    0004 Loma Prieta, CA', 'Moment Mag=', 'station = San Francisco, 1295 Shafter, F component=   up', 'epicentral', 'inst', '*', '*', '*']
	return '\\\\n'.join(head) + '\\\\n' + rows(integers, '%10d', 8) + rows(reals, '%15.7E', 5) + '|\\\\n|ref\\\\n|\\\\n' + rows([short(x) for x in acceleration], '%s', 8)

def record(text, **settings):
	open('quake', 'w').write(text)
	return mpm.record('quake', **(dict(isSure=True, baseline=None) | settings))

def said(text, **settings):
	try: record(text, **(dict(isSure=False, baseline='linear') | settings))
	except (ValueError, TypeError) as error: return str(error)
	return ''
'''.replace('\\\\n', '\\n')


def test_they_are_read_with_unit_name_and_baseline(yade):
	yade(write + '''
short = asRead(acceleration, '%.4E')
for text, settings, values, unit, title, isCorrected in (
	(esm(), {}, asRead(acceleration, '%.6f'), 'cm/s2', 'CENTRAL VALLEY, 20160824, ABC, HNE', True), (esm(baseline='NOT REMOVED', unit='m/s^2'), {}, 100 * asRead(acceleration, '%.6f'), 'm/s2', None, False),
	(knet(), {}, counts * 7845 / 8223790, 'cm/s2', '2014/12/31 23:49:00, CHB003, E-W', False), (knet('4'), {}, counts * 7845 / 8223790, 'cm/s2', '2014/12/31 23:49:00, CHB003, N-S at the surface', False),
	(cosmos(), dict(channel=2), asRead(2 * acceleration, '%.5f'), 'cm/s2', None, True), (cosmos((1, ), '%15.6e', '1E15.6'), {}, asRead(acceleration, '%.6e'), 'cm/s2', None, True),
	(cosmos((1, ), unit='g(02)'), {}, 980.665 * asRead(acceleration, '%.5f'), 'g', None, True),
	(csmip(), dict(channel=3), asRead(3 * acceleration, '%.5f'), 'cm/s2', 'Hacienda Heights, Chan 3: 90 Deg, Rcrd of Fri Mar 28, 2014 21:09:34.0 PDT', True),
	(csmip((1, ), isOld=True), {}, asRead(acceleration, '%.3f'), 'cm/s2', None, True),
	(smc(), {}, short, 'cm/s2', '1989 10 18 0004 Loma Prieta, CA, San Francisco, 1295 Shafter, F up', True), (smc('1 UNCORRECTED ACCELEROGRAM'), {}, short, 'cm/s2', None, False)):
	r = record(text, **settings)
	assert r.step == dt and len(r.acceleration) == n and np.abs(100 * r.acceleration - values).max() < 1e-9 * np.abs(values).max(), (text[:60], r.acceleration[:9], values[:9] / 100)
	assert r.unit == unit and r.isCorrected is isCorrected and title in (None, r.title), (r.unit, r.isCorrected, r.title)
for text in cosmos((1, )), csmip((1, )):
	r = record(text, quantity='velocity')
	assert np.abs(100 * r.velocity - asRead(velocity, '%.5f')).max() < 0.02 * velocity.max()  # differentiated and integrated again
assert abs(record(knet(), baseline='constant').velocity[-1]) < 1e-9
''')


def test_what_is_wrong_with_them_is_named(yade):
	yade(write + '''
for text, settings, words in (
	(esm(kind='DISPLACEMENT', unit='cm'), {}, 'has no acceleration'), (esm(kind='DISPLACEMENT', unit='cm'), dict(quantity='velocity'), 'displacement (cm)'), (esm(count=1004), {}, '1003 values, and 1004 are announced'),
	(esm(), dict(unit='g'), 'says in its heading that it has cm/s2'), (esm().replace('SAMPLING_INTERVAL_S: 0.020000', 'SAMPLING_INTERVAL_S: 0'), {}, 'time step of 0 s'), (esm().replace('UNITS: cm/s^2', 'UNITS: '), {}, 'does not tell UNITS'),
	(knet(length='21'), {}, 'cut off'), (knet().replace('7845(gal)', '7845'), {}, 'Scale Factor'), (knet(), dict(baseline=None), 'baseline is not corrected'), (knet(), dict(channel=1.5), 'channel = 1.5 is none of'),
	(cosmos(), {}, '2 channels'), (cosmos(), dict(channel=3), 'channel = 3 is none'), (cosmos(), dict(channel='2'), 'must be the number'), (cosmos((1, ), unit='counts (50)'), {}, 'counts'), (cosmos((1, ))[:-3000], dict(quantity='velocity'), 'cut off'),
	(csmip(), {}, 'Chan 3: 90 Deg'), (csmip((1, ))[:5000], {}, 'cut off'), (csmip((1, ))[:1500], {}, 'Volume 2'), (smc('4 DISPLACEMENT'), {}, 'has no acceleration'), (smc('5 RESPONSE SPECTRA'), {}, 'no history'),
	(smc('1 UNCORRECTED ACCELEROGRAM', 1.7e38), {}, 'unequal times'), (smc()[:9000], {}, 'cut off'), ('0 1\\n0.1 2\\n', dict(channel=1, unit='g'), 'has no channels')):
	assert words in said(text, **settings), (words, said(text, **settings))
''')


def test_peer_files_of_other_quantities_are_not_taken_for_accelerations(yade):
	yade(write + '''
r = record('El Centro\\nThe units are (g)\\nNPTS=  1003, DT= .02000 SEC\\n' + rows(acceleration, '%15.7E', 5))
assert r.unit == 'g' and abs(r.acceleration[5] / acceleration[5] - 9.80665) < 1e-6
heading = 'PEER STRONG MOTION DATABASE RECORD\\nSOME EVENT, SOME STATION, 360\\n%s\\nNPTS=  1003, DT= .02000 SEC\\n'
for line, words in ('DISPLACEMENT TIME HISTORY IN UNITS OF CM. FILTER POINTS: HP=0.12 Hz', 'has cm;'), ('VELOCITY TIME HISTORY IN UNITS OF CM/S', 'has cm/s;'), ('DISPLACEMENT TIME HISTORY', 'has displacement;'), ('ACCELERATION TIME HISTORY IN UNITS OF FT/S2', 'has ft/s2;'):
	for unit in None, 'cm/s2':
		assert words in said(heading % line + rows(acceleration, '%15.7E', 5), unit=unit), (line, said(heading % line + rows(acceleration, '%15.7E', 5), unit=unit))
for line, unit in ('ACCELERATION TIME HISTORY IN UNITS OF CM/S**2', 'cm/s2'), ('ACCELERATION TIME SERIES IN UNITS OF CM/SEC/SEC.', 'cm/s2'), ('ACCELERATION TIME SERIES IN UNITS OF G', 'g'):
	assert record(heading % line + rows(acceleration, '%15.7E', 5)).unit == unit
''')
