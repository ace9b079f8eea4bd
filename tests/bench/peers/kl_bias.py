# SPDX-License-Identifier: GPL-3.0-or-later
# klayout -b -r kl_bias.py -rd dir=DIR: KLayout's side of tests/bench/mask_peers.py. Rows: what, CPU ms, bytes.
import os, time, pya, sys
source = pya.Layout(); source.read(dir + "/flexwright-input.gds"); layer = source.layer(1, 0)
def timed(what, run, path=None):
    start = time.process_time(); got = run(); took = time.process_time() - start
    print("%s,%.6g,%d" % (what, 1e3 * took, os.path.getsize(path) if path else 0)); return got
def write(layout, name, what):
    o = pya.SaveLayoutOptions(); o.set_format_from_filename(name); o.gds2_write_timestamps = False
    o.oasis_write_cblocks = True; o.oasis_compression_level = 2
    timed(what, lambda: layout.write(dir + "/" + name, o), dir + "/" + name)
write(source, "klayout-input.gds", "write klayout-input gds"); write(source, "klayout-input.oas", "write klayout-input oasis")
region = pya.Region(source.top_cell().begin_shapes_rec(layer))
moved = timed("bias klayout", lambda: region.sized(1500, 2))
out = pya.Layout(); out.dbu = 0.001; cell = out.create_cell("bench"); cell.shapes(out.layer(1, 0)).insert(moved)
write(out, "klayout.gds", "write klayout gds")
sys.stdout.flush(); pya.Application.instance().exit(0)
