#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# segyio 1.8.3: traces at 25 Hz, an interval of 40,000 microseconds, in 2 bytes, which revision 2 of SEG-Y takes without a sign.
# Expected: times of samples go on by 40 ms.
# Seen: the interval is read with a sign, -25,536 microseconds, and times go backwards: 0, -25.536, -51.072 ms. No message.
. "$(dirname "$(realpath "$0")")/packages.inc"
take python3-segyio=1.8.3-1.2 libsegyio1=1.8.3-1.2
/usr/bin/python3 - <<'SCRIPT' || changed 'the interval is read otherwise'
import sys
import numpy as np
import segyio
spec = segyio.spec()
spec.format, spec.samples, spec.tracecount = 5, np.arange(4) * 40., 1
with segyio.create('record.sgy', spec) as file: file.trace[0] = np.zeros(4, np.float32)
with open('record.sgy', 'rb') as file: raw = file.read()
print('bytes of the interval in the file:', int.from_bytes(raw[3216:3218], 'big'))
with segyio.open('record.sgy', strict=False) as file: found = [float(time) for time in file.samples]
print(f'segyio {segyio.__version__}: times {found} ms; expected 0, 40, 80, 120 ms')
sys.exit(int.from_bytes(raw[3216:3218], 'big') != 40000 or found[1] >= 0)
SCRIPT
