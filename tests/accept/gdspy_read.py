#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""gdspy_read.py: independent read with gdspy 1.4 (Debian python3-gdspy). usage: gdspy_read.py FILE.gds [expect L/D:area ...]
Per layer polygons, vertices, area (shoelace, no merge), bbox, max vertices; any gdspy warning fails (not the one about a missing tkinter: it speaks of the installation, not of the file). exit 1 on warning or mismatch."""
import sys, warnings, collections
import numpy as np
with warnings.catch_warnings(record=True) as W:
    warnings.simplefilter("always"); import gdspy
    lib = gdspy.GdsLibrary(infile=sys.argv[1]); bad = [str(w.message) for w in W if "GDSPY" in str(w.message) and "LayoutViewer" not in str(w.message)]
print("file %s lib %r unit %g m precision %g m cells %d top %s" % (sys.argv[1], lib.name, lib.unit, lib.precision, len(lib.cell_dict), [c.name for c in lib.top_level()]))
S = collections.defaultdict(lambda: [0, 0, 0.0, np.inf, np.inf, -np.inf, -np.inf, 0, 0.0]); grid = lib.precision/lib.unit; off = 0
for t in lib.top_level():
    for k, polys in t.get_polygons(by_spec=True).items():
        s = S[k]
        for p in polys:
            x, y = p[:, 0], p[:, 1]; x0, y0 = x[0], y[0]; xs, ys = x-x0, y-y0
            a = 0.5*np.dot(xs, np.roll(ys, -1)-np.roll(ys, 1))
            s[0] += 1; s[1] += len(p); s[2] += abs(a); s[3] = min(s[3], x.min()); s[4] = min(s[4], y.min()); s[5] = max(s[5], x.max()); s[6] = max(s[6], y.max()); s[7] = max(s[7], len(p))
            off += int(np.sum(np.abs(p/grid-np.round(p/grid)) > 1e-3))
for k in sorted(S):
    s = S[k]; print("layer %d/%d polys %d verts %d max %d area %.6f um2 bbox %.6f %.6f %.6f %.6f" % (k[0], k[1], s[0], s[1], s[7], s[2]*(lib.unit*1e6)**2, *[v*lib.unit*1e6 for v in s[3:7]]))
fail = bool(bad)
for e in sys.argv[2:]:
    k, v = e.split(":"); k = tuple(int(z) for z in k.split("/")); got = S[k][2]*(lib.unit*1e6)**2; ok = abs(got-float(v)) <= 1e-5*abs(float(v)); fail |= not ok
    print("expect %s %.6f got %.6f %s" % (e, float(v), got, "ok" if ok else "BAD"))
print("off-grid coordinates %d warnings %s => %s" % (off, bad or "none", "FAIL" if fail else "PASS")); sys.exit(1 if fail else 0)
