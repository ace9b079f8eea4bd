# SPDX-License-Identifier: GPL-3.0-or-later
# kl_xor.py: klayout -b -r kl_xor.py -rd a=FILE -rd b=FILE [-rd la=1/0 -rd lb=1/0] [-rd tol=0.001] [-rd out=XOR.gds]
# XOR of all common layers of two files (or of one layer pair). Residues narrower than tol um (both ways opened) are ignored. Exit 1 if any area stays.
import pya, sys
g = globals(); A = pya.Layout(); A.read(a); B = pya.Layout(); B.read(b); tol = float(g.get("tol", 0.0)); bad = 0
if abs(A.dbu-B.dbu) > 1e-12: print("dbu differ", A.dbu, B.dbu)
d = min(A.dbu, B.dbu)
def key(l, li): i = l.get_info(li); return (i.layer, i.datatype)
def reg(l, k):
    for li in l.layer_indexes():
        if key(l, li) == k:
            r = pya.Region()
            for t in l.top_cells(): r += pya.Region(t.begin_shapes_rec(li), pya.ICplxTrans(l.dbu/d))
            return r.merged()
    return pya.Region()
P = lambda s: tuple(int(v) for v in s.split("/"))
pairs = [(P(g["la"]), P(g.get("lb", g["la"])))] if "la" in g else [(k, k) for k in sorted({key(A, i) for i in A.layer_indexes()} | {key(B, i) for i in B.layer_indexes()})]
O = pya.Layout(); O.dbu = d; oc = O.create_cell("XOR")
for ka, kb in pairs:
    x = reg(A, ka) ^ reg(B, kb); t = int(round(tol/d)); y = x
    if t > 0: h = (t+1)//2; y = x.sized(-h, 2).sized(h, 2)
    n = y.count(); oc.shapes(O.layer(*ka)).insert(x)
    print("xor %s vs %s: raw residues %d area %.6f um2; wider than %g um: %d area %.6f um2" % (ka, kb, x.count(), x.area()*d*d, tol, n, y.area()*d*d)); bad += n > 0
if "out" in g: O.write(g["out"])
print("XOR", "DIFF" if bad else "SAME", a, b); sys.stdout.flush(); pya.Application.instance().exit(1 if bad else 0)
