#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""gdspy_bias.py DIR: gdspy's side of tests/bench/mask_peers.py. Rows: what, CPU ms, bytes."""
import os
import sys
import time
import warnings

import numpy as np

warnings.simplefilter("ignore")
import gdspy  # noqa: E402

where = sys.argv[1]
polygons = np.fromfile(where + "/input.f64").reshape(1000, 1000, 2)


def timed(what, run, path=None):
    start = time.process_time()
    got = run()
    took = time.process_time() - start
    print("%s,%.6g,%d" % (what, 1e3 * took, os.path.getsize(path) if path else 0))
    return got


def write(name, sets):
    library = gdspy.GdsLibrary(name="bench")
    library.add(gdspy.Cell("bench", exclude_from_current=True).add(sets))
    path = "%s/%s.gds" % (where, name)
    timed("write %s gds" % name, lambda: library.write_gds(path), path)


write("gdspy-input", [gdspy.PolygonSet([p], layer=1) for p in polygons])
for precision in (1e-3, 1e-6):
    name = "gdspy-%g" % precision
    write(name, timed("bias " + name, lambda: [gdspy.offset(gdspy.PolygonSet([p]), 1.5, join="miter", tolerance=5, max_points=0,
                                                            precision=precision, layer=1) for p in polygons]))
