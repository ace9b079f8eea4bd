# SPDX-License-Identifier: GPL-3.0-or-later
# kl_wafer.py: klayout -b -r kl_wafer.py -rd gds=FLOW-wafer.gds -rd csv=FLOW-wafer.csv -rd dies=VALUE=DIE.gds,VALUE=DIE.gds.. [-rd rule=4]
# Builds the wafer flat, die by die, from its map (x, y and the value in column 8 of the CSV; "" without a sweep) and from masks of
# single dies, and compares layer by layer: arrays and map must agree. Letters (2/0) may only be more. Then width and space of what
# remains on the plate, 1/0 NOT 2/0 NOT 3/0, over everything. Exit 1 if anything differs.
import csv as table
import pya, sys

W = pya.Layout(); W.read(gds)
dbu, bad = W.dbu, 0
top = W.top_cell()

def region(layout, cell, key):
    for index in layout.layer_indexes():
        info = layout.get_info(index)
        if (info.layer, info.datatype) == key:
            return pya.Region(cell.begin_shapes_rec(index))
    return pya.Region()

single = {}
for item in dies.split(","):
    value, _, name = item.partition("=")
    D = pya.Layout(); D.read(name)
    single[value] = (D, D.top_cell(), region(D, D.top_cell(), (4, 0)).bbox())

def say(text, wrong):
    global bad
    print(("FAIL  " if wrong else "ok    ") + text)
    bad += bool(wrong)

rows = [r for r in table.DictReader(open(csv)) if r["kind"] == "die"]
swept = list(rows[0])[7] if list(rows[0])[7] != "verdict" else None
flat, places = {key: pya.Region() for key in ((1, 0), (2, 0), (3, 0), (4, 0))}, pya.Region()
for r in rows:
    D, cell, box = single[r[swept] if swept else ""]
    x, y = round(float(r["x_mm"]) * 1e6), round(float(r["y_mm"]) * 1e6)
    move = pya.Vector((2 * x - box.left - box.right) // 2, (2 * y - box.bottom - box.top) // 2)
    places.insert(box.moved(move))
    for key in flat:
        flat[key] += region(D, cell, key).moved(move)
for key in flat:
    alone, whole = flat[key].merged(), region(W, top, key).merged()
    say("%d/%d: nothing of %d dies is missing" % (*key, len(rows)), not (alone - whole).is_empty())
    more = (whole - alone) & places
    if key == (2, 0):
        print("      2/0: %d letters more" % more.count())
    else:
        say("%d/%d: nothing else lies on them" % key, not more.is_empty())
say("dies do not overlap", places.count() != len(rows) or places.sized(-1).merged().count() != len(rows))
plate = (region(W, top, (1, 0)) - region(W, top, (2, 0)) - region(W, top, (3, 0))).merged()
limit = int(float(globals().get("rule", 4)) / dbu)
say("plate: width %s um" % globals().get("rule", 4), plate.width_check(limit, False, pya.Region.Euclidian, 80).count())
say("plate: space", plate.space_check(limit, False, pya.Region.Euclidian, 80).count())
say("plate: %d polygons" % plate.count(), plate.is_empty())
print("WAFER", "FAIL" if bad else "PASS"); sys.stdout.flush(); pya.Application.instance().exit(1 if bad else 0)
