# SPDX-License-Identifier: GPL-3.0-or-later
# kl_svg.py: klayout -b -r kl_svg.py -rd gds=FILE -rd svg=FILE -rd json=CERTIFICATE -rd here=DIRECTORY-OF-outlines.py [-rd tol=0.008]
# The exact outlines of the SVG, flattened by outlines.py to 1.5 nm: layer by layer, XOR with the GDSII narrower than tol um
# everywhere, and the same number of merged polygons. Exit 1 if not.
import json as J, pya, sys
sys.path.insert(0, here); sys.dont_write_bytecode = True
import outlines as O
g = globals(); tol = float(g.get("tol", 0.008)); bad = 0; drawn = 0
with open(json, encoding="utf-8") as file: extent = J.load(file)["extent_um"]
shapes = O.read_svg(svg, extent); B = pya.Layout(); B.read(gds); d = B.dbu; bad = abs(d - 1e-3) > 1e-12
def region(i):
    r = pya.Region()
    for c in B.top_cells(): r += pya.Region(c.begin_shapes_rec(i))
    return r.merged()
layers = {"%d/%d" % (B.get_info(i).layer, B.get_info(i).datatype): region(i) for i in B.layer_indexes()}
for k in sorted(set(layers) | set(shapes)):
    q = layers.get(k, pya.Region()); p = pya.Region()
    for o in shapes.get(k, []): p.insert(pya.Polygon([pya.Point(x, y) for x, y in O.flat(o, 0.0015)]))
    p.merge(); x = p ^ q; h = max(1, int(round(tol / d / 2))); y = x.sized(-h, 2)
    wrong = y.count() > 0 or p.count() != q.count(); bad |= wrong; drawn += q.count()
    print("%s %s: %d and %d polygons, XOR %.6f um2, wider than %g um: %d" % ("FAIL" if wrong else "ok", k, p.count(), q.count(), x.area() * d * d, 2 * h * d, y.count()))
if not drawn: bad = 1; print("nothing drawn")
print("SVG", "DIFF" if bad else "SAME", svg, gds); sys.stdout.flush(); pya.Application.instance().exit(1 if bad else 0)
