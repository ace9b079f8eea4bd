# SPDX-License-Identifier: GPL-3.0-or-later
# kl_area.py: klayout -b -r kl_area.py -rd f=FILE -rd expect="1/0:12345.678,2/0:99.5" [-rd rel=1e-5] [-rd abs=0.01]
import pya, sys
g = globals(); ly = pya.Layout(); ly.read(f); rel = float(g.get("rel", 1e-5)); ab = float(g.get("abs", 0.0)); bad = 0
for e in expect.split(","):
    k, v = e.split(":"); L, D = (int(z) for z in k.split("/")); v = float(v); a = 0.0
    for li in ly.layer_indexes():
        i = ly.get_info(li)
        if (i.layer, i.datatype) == (L, D):
            r = pya.Region()
            for t in ly.top_cells(): r += pya.Region(t.begin_shapes_rec(li))
            a += r.merged().area()*ly.dbu**2
    er = a-v; ok = abs(er) <= max(ab, rel*abs(v)); bad += not ok
    print("area %s got %.6f want %.6f um2 diff %+.6f rel %+.3e %s" % (k, a, v, er, er/v if v else 0, "ok" if ok else "BAD"))
print("AREA", "FAIL" if bad else "PASS"); sys.stdout.flush(); pya.Application.instance().exit(1 if bad else 0)
