# SPDX-License-Identifier: GPL-3.0-or-later
# kl_cells.py: klayout -b -r kl_cells.py -rd a=FILE -rd b=FILE
# Two hierarchical files have the same cells, the same instances with their arrays, and the same texts. Exit 1 if not.
import pya, sys


def content(name):
    layout = pya.Layout()
    layout.read(name)
    cells = {}
    for cell in layout.each_cell():
        placed = sorted((i.cell.name, i.trans.to_s(), i.na, i.nb, i.a.to_s() if i.na > 1 else "", i.b.to_s() if i.nb > 1 else "") for i in cell.each_inst())
        texts = sorted((layout.get_info(l).layer, s.text.to_s()) for l in layout.layer_indexes() for s in cell.shapes(l).each(pya.Shapes.STexts))
        cells[cell.name] = (placed, texts)
    return cells, sorted(c.name for c in layout.top_cells())


def expanded(placed):
    """every single place: readers may hold a row of one column as they like"""
    out = []
    for name, trans, na, nb, a, b in placed:
        t = pya.Trans.from_s(trans)
        va = pya.Vector.from_s(a) if a else pya.Vector()
        vb = pya.Vector.from_s(b) if b else pya.Vector()
        for i in range(max(na, 1)):
            for k in range(max(nb, 1)):
                d = t.disp + va * i + vb * k
                out.append((name, t.rot, d.x, d.y))
    return sorted(out)


one, two = content(a), content(b)
bad = one[1] != two[1] or set(one[0]) != set(two[0])
places = 0
for name in one[0]:
    if name in two[0]:
        p, q = expanded(one[0][name][0]), expanded(two[0][name][0])
        places += len(p)
        bad = bad or p != q or one[0][name][1] != two[0][name][1]
bad = bad or places == 0
print("CELLS", "DIFF" if bad else "SAME", len(one[0]), "cells", places, "places")
sys.stdout.flush()
pya.Application.instance().exit(1 if bad else 0)
