# SPDX-License-Identifier: GPL-3.0-or-later
# kl_drc.py: klayout -b -r kl_drc.py -rd f=FILE -rd layer=1/0 -rd width=4.0 -rd space=4.0 [-rd grid=0.001] [-rd angle=90] [-rd sliver=0.020] [-rd edge=0.005] [-rd top=CELL] [-rd lyrdb=OUT]
# Prints measured minimum width/space (um) below the rule, off-grid vertices, acute corners, strange polygons, short edges. Exit 1 on any violation.
import pya, math, sys
g = globals()
ly = pya.Layout(); ly.read(f)
tc = ly.cell(g["top"]) if "top" in g else ly.top_cell()
L, D = (int(v) for v in g.get("layer", "1/0").split("/"))
li = ly.find_layer(L, D) if hasattr(ly, "find_layer") else ly.layer(L, D)
if li is None: print("DRC FAIL: no layer %d/%d" % (L, D)); pya.Application.instance().exit(2)
dbu = ly.dbu; U = lambda um: int(round(float(um)/dbu))
raw = pya.Region(tc.begin_shapes_rec(li)); raw.merged_semantics = False
r = pya.Region(tc.begin_shapes_rec(li)); r.merge()
def clamp(t): return max(0.0, min(1.0, t))
def pd(px, py, e):
    dx, dy = e.d().x, e.d().y; q = dx*dx+dy*dy
    t = clamp(((px-e.p1.x)*dx+(py-e.p1.y)*dy)/q) if q else 0.0
    return math.hypot(px-e.p1.x-t*dx, py-e.p1.y-t*dy)
def dist(ep):
    a, b = ep.first, ep.second
    if a.crossed_by(b) and b.crossed_by(a): return 0.0
    return min(pd(a.p1.x, a.p1.y, b), pd(a.p2.x, a.p2.y, b), pd(b.p1.x, b.p1.y, a), pd(b.p2.x, b.p2.y, a))
def worst(eps):
    best = None; n = 0
    for ep in eps.each():
        d = dist(ep)*dbu; n += 1
        if best is None or d < best[0]: c = ep.bbox().center(); best = (d, c.x*dbu, c.y*dbu)
    return n, best
bad = 0; db = pya.ReportDatabase("drc"); rc = db.create_cell(tc.name)
def rep(name, n, extra=""):
    global bad
    print("%-22s %6d %s" % (name, n, extra)); bad += n > 0
def log(name, coll):
    cat = db.create_category(name); db.create_items(rc.rdb_id(), cat.rdb_id(), pya.CplxTrans(dbu), coll)
M = pya.Region.Euclidian
w = r.width_check(U(g.get("width", 4.0)), False, M); n, b = worst(w); log("width", w)
rep("width<%s" % g.get("width", 4.0), n, "min %.6f um at (%.3f,%.3f)" % b if b else "ok")
s = r.space_check(U(g.get("space", 4.0)), False, M); n, b = worst(s); log("space", s)     # space_check includes notches
rep("space<%s" % g.get("space", 4.0), n, "min %.6f um at (%.3f,%.3f)" % b if b else "ok")
sl = r.width_check(U(g.get("sliver", 0.020)), False, M); n, b = worst(sl); rep("sliver_width", n, "min %.6f um at (%.3f,%.3f)" % b if b else "ok")
ss = r.space_check(U(g.get("sliver", 0.020)), False, M); n, b = worst(ss); rep("sliver_space", n, "min %.6f um at (%.3f,%.3f)" % b if b else "ok")
gr = U(g.get("grid", dbu)); og = raw.grid_check(gr, gr) if gr > 1 else pya.EdgePairs(); rep("off_grid(%d dbu)" % gr, og.count())
# bend angle: interior angle < A  <=>  |bend| > 180-A
A = float(g.get("angle", 90.0)); c1 = r.corners(180-A, 180.0, 1, False, True); c2 = r.corners(-180.0, -(180-A), 1, True, False)
log("acute", c1+c2); rep("interior_angle<%g" % A, c1.count(), "(acute convex corners)"); rep("exterior_angle<%g" % A, c2.count(), "(acute notches)")
sp = raw.strange_polygon_check(); log("strange", sp); rep("strange_polygons", sp.count(), "(self-crossing / wrong wrap count)")
o2 = raw.merged(False, 2); rep("overlaps", o2.count(), "(area covered more than once)")
el = U(g.get("edge", 0.005)); se = r.edges().with_length(0, el, False); rep("edges<%s um" % g.get("edge", 0.005), se.count())
zero = spike = odd = 0
it = pya.RecursiveShapeIterator(ly, tc, li)
while not it.at_end():
    sh = it.shape()
    if sh.is_polygon():
        P = [p for p in sh.simple_polygon.each_point()]
        m = len(P)
        for i in range(m):
            a, b2, c = P[i-1], P[i], P[(i+1) % m]
            if a == b2: zero += 1
            elif (b2.x-a.x)*(c.y-b2.y)-(b2.y-a.y)*(c.x-b2.x) == 0 and (b2.x-a.x)*(c.x-b2.x)+(b2.y-a.y)*(c.y-b2.y) < 0: spike += 1
    it.next()
rep("zero_length_edges", zero); rep("180deg_spikes", spike)
if "lyrdb" in g: db.save(g["lyrdb"])
print("DRC %s %s layer %d/%d" % ("FAIL" if bad else "PASS", f, L, D)); sys.stdout.flush()
pya.Application.instance().exit(1 if bad else 0)
