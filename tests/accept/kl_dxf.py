# SPDX-License-Identifier: GPL-3.0-or-later
# kl_dxf.py: klayout -b -r kl_dxf.py -rd gds=FILE -rd dxf=FILE -rd lyt=FILE [-rd tol=0.012]
# Reads the DXF with the reader options of the technology file (its layer map and arc accuracy; so that is proved, too):
# KLayout flattens the arcs itself. Layer by layer: XOR with the GDSII narrower than tol um everywhere, same number of
# merged polygons, areas within perimeter times tol/2. Every drawn GDSII layer must be there. Exit 1 if not.
import pya, sys
g = globals(); tol = float(g.get("tol", 0.012)); bad = 0
t = pya.Technology(); t.load(lyt)
if not t.name.startswith("flexwright-") or not t.eff_layer_properties_file().endswith(".lyp"): bad = 1; print("technology", t.name)
o = t.load_layout_options
print("technology %s dbu %g arcs within %g um layer properties %s" % (t.name, t.dbu, o.dxf_circle_accuracy, t.eff_layer_properties_file()))
try: open(t.eff_layer_properties_file()).close()
except OSError as e: bad = 1; print(e)
A = pya.Layout(); A.read(dxf, o); B = pya.Layout(); B.read(gds); d = B.dbu
def layers(l): return {(l.get_info(i).layer, l.get_info(i).datatype): i for i in l.layer_indexes()}
def region(l, i):
    r = pya.Region()
    for c in l.top_cells(): r += pya.Region(c.begin_shapes_rec(i))
    return r.merged()
a, b = layers(A), layers(B); drawn = 0
if abs(A.dbu - d) > 1e-12: bad = 1; print("dbu", A.dbu, d)
for k, i in sorted(b.items()):
    q = region(B, i)
    if q.count() == 0: continue
    drawn += 1
    if k not in a: bad = 1; print("layer", k, "is not in the DXF"); continue
    p = region(A, a[k]); x = p ^ q; h = max(1, int(round(tol / d / 2))); y = x.sized(-h, 2).sized(h, 2)
    da = abs(p.area() - q.area()) * d * d; most = q.perimeter() * d * tol / 2
    wrong = y.count() > 0 or p.count() != q.count() or da > most
    bad |= wrong
    print("%s %s: %d and %d polygons, areas differ by %.6f um2 (%.6f allowed), XOR %.6f um2, wider than %g um: %d" % ("FAIL" if wrong else "ok", k, p.count(), q.count(), da, most, x.area() * d * d, 2 * h * d, y.count()))
for k in a:
    if k not in b and region(A, a[k]).count(): bad = 1; print("layer", k, "is in the DXF alone")
if not drawn: bad = 1; print("nothing drawn")
print("DXF", "DIFF" if bad else "SAME", dxf, gds); sys.stdout.flush(); pya.Application.instance().exit(1 if bad else 0)
