# SPDX-License-Identifier: GPL-3.0-or-later
# kl_plate.py: klayout -b -r kl_plate.py -rd a=FLOW-wafer.gds -rd b=FLOW-plate.gds -rd expression="1/0 NOT 2/0" -rd layer=1/0 -rd mirror=1
#   [-rd scale=1.0002] [-rd field=119] [-rd tol=4] [-rd die=1] [-rd rule=4.0] [-rd wafer=25.4]
# The layered plate, joined by KLayout's booleans, its dies and what else lies within a circle of `wafer` mm scaled, mirrored, or what it leaves free within a square of `field` mm, against the
# written one: no difference wider than tol nm. die=1: a is one die, and b has it in its middle. Of the written one: one layer,
# no overlap between polygons, no width or space below `rule` um, 4094 vertices at most. Exit 1 if not.
import pya, sys
A = pya.Layout(); A.read(a); B = pya.Layout(); B.read(b); bad = 0
given = globals()
scale, field, tol, single = float(given.get("scale", 1)), float(given.get("field", 0)), int(given.get("tol", 0)), int(given.get("die", 0))

def own(l, key, children):
    n, d = (int(v) for v in key.split("/"))
    i, top = l.find_layer(n, d), l.top_cell()
    if i is None: return pya.Region()
    beside = pya.Region(top.shapes(i))
    reach = int(1e6 * float(given.get("wafer", 0)))
    on = beside.merged() & pya.Region(pya.Polygon.ellipse(pya.Box(-reach, -reach, reach, reach), 512)) if reach else pya.Region()
    if not children: return beside - on
    return (pya.Region(top.begin_shapes_rec(i)) - beside) + on

def say(text, wrong):
    global bad
    print(("FAIL  " if wrong else "ok    ") + text); bad += bool(wrong)

def joined(get):
    words = expression.split()
    want = get(words[0]).merged()
    for op, key in zip(words[1::2], words[2::2]):
        r = get(key)
        want = {"OR": want + r, "AND": want & r, "NOT": want - r, "XOR": want ^ r}[op].merged()
    return want

def everything(key):
    n, d = (int(v) for v in key.split("/"))
    i = A.find_layer(n, d)
    return pya.Region() if i is None else pya.Region(A.top_cell().begin_shapes_rec(i))

raw = pya.Region(B.top_cell().begin_shapes_rec(B.find_layer(*(int(v) for v in layer.split("/"))))); raw.merged_semantics = False
if single: # the written plate has lettering besides, in its top cell: only the die is compared
    cell = [c for c in B.each_cell() if c.cell_index() != B.top_cell().cell_index()]
    say("one die, %d" % len(cell), len(cell) != 1)
    raw = pya.Region(cell[0].begin_shapes_rec(B.find_layer(*(int(v) for v in layer.split("/"))))); raw.merged_semantics = False
    want = joined(everything).transformed(pya.ICplxTrans(scale))
elif scale != 1:
    want = joined(lambda k: own(A, k, True)).transformed(pya.ICplxTrans(scale)) + joined(lambda k: own(A, k, False))
else:
    want = joined(everything)
if int(given.get("mirror", 0)): want = want.transformed(pya.Trans.M90)
if field:
    h = int(round(field * 5e5)); whole = pya.Region(pya.Box(-h, -h, h, h))
    if single: whole = pya.Region(raw.bbox()) # of the place: lanes are not drawn
    want = whole - want
drawn = [i for i in B.layer_indexes() if any(not c.shapes(i).is_empty() for c in B.each_cell())]
say("one layer, %d" % len(drawn), len(drawn) != 1)
got = raw.merged()
x = want ^ got
if tol: x = x.sized(-tol // 2)
say("XOR: %d polygons, %g um2, of %d" % (x.count(), x.area() * B.dbu ** 2, want.count()), not x.is_empty() or want.is_empty())
# KLayout's own merging rounds where slanted edges meet cuts: some square nanometres
say("areas of the polygons add up to that of the whole but for %d nm2: nothing overlaps" % (raw.area() - got.area()), abs(raw.area() - got.area()) > 1000)
# as written: widths and spaces of everything on the plate, titles and crosses too; corners of 90 degrees are some less on the grid
rule = int(round(1000 * float(given.get("rule", 4.0)))) - 2 * int(given.get("chord", 5))
for name, pairs in (("width", got.width_check(rule, False, pya.Region.Euclidian, 89.0, None, None)),
                    ("space", got.space_check(rule, False, pya.Region.Euclidian, 89.0, None, None))):
    say("%s of at least %g um: %d below%s" % (name, 1e-3 * rule, pairs.count(), ", at %s" % next(pairs.each()).bbox().to_s() if pairs.count() else ""), pairs.count())
most = max(s.polygon.num_points() for c in B.each_cell() for i in drawn for s in c.shapes(i).each())
say("at most %d vertices" % most, most > 4094)
say("no holes", any(s.polygon.holes() for c in B.each_cell() for i in drawn for s in c.shapes(i).each()))
print("PLATE", "FAIL" if bad else "PASS"); sys.stdout.flush(); pya.Application.instance().exit(1 if bad else 0)
