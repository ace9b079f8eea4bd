# SPDX-License-Identifier: GPL-3.0-or-later
# kl_plate.py: klayout -b -r kl_plate.py -rd a=FLOW-wafer.gds -rd b=FLOW-plate.gds -rd expression="1/0 NOT 2/0" -rd layer=1/0 -rd mirror=1
# The layered plate, joined by KLayout's booleans and mirrored, against the written one: no difference. Of the written one: one layer,
# no overlap between polygons, 4094 vertices at most. Exit 1 if not.
import pya, sys
A = pya.Layout(); A.read(a); B = pya.Layout(); B.read(b); bad = 0

def region(l, key):
    n, d = (int(v) for v in key.split("/"))
    i = l.find_layer(n, d)
    return pya.Region() if i is None else pya.Region(l.top_cell().begin_shapes_rec(i))

def say(text, wrong):
    global bad
    print(("FAIL  " if wrong else "ok    ") + text); bad += bool(wrong)

words = expression.split()
want = region(A, words[0]).merged()
for op, key in zip(words[1::2], words[2::2]):
    r = region(A, key)
    want = {"OR": want + r, "AND": want & r, "NOT": want - r, "XOR": want ^ r}[op].merged()
if int(globals().get("mirror", 0)): want = want.transformed(pya.Trans.M90)
raw = region(B, layer); raw.merged_semantics = False
drawn = [i for i in B.layer_indexes() if any(not c.shapes(i).is_empty() for c in B.each_cell())]
say("one layer, %d" % len(drawn), len(drawn) != 1)
got = raw.merged()
x = want ^ got
say("XOR: %d polygons, %g um2, of %d" % (x.count(), x.area() * B.dbu ** 2, want.count()), not x.is_empty() or want.is_empty())
# KLayout's own merging rounds where slanted edges meet cuts: some square nanometres
say("areas of the polygons add up to that of the whole but for %d nm2: nothing overlaps" % (raw.area() - got.area()), abs(raw.area() - got.area()) > 1000)
most = max(s.polygon.num_points() for c in B.each_cell() for i in drawn for s in c.shapes(i).each())
say("at most %d vertices" % most, most > 4094)
say("no holes", any(s.polygon.holes() for c in B.each_cell() for i in drawn for s in c.shapes(i).each()))
print("PLATE", "FAIL" if bad else "PASS"); sys.stdout.flush(); pya.Application.instance().exit(1 if bad else 0)
