# SPDX-License-Identifier: GPL-3.0-or-later
# kl_shapes.py: klayout -b -r kl_shapes.py -rd jobs=JOBS.json -rd result=RESULT.json
# Of each {"polygons": [[hole, [[X, Y], ..]], ..] um in a frame 100 um up, "gds": FILE and "bias": UM or not, "alike": BOOL} what
# KLayout's union of the polygons has, and what differs from the mask above y = 500 um, or is narrower than 4 um there.
import json

import pya

NEAR = pya.Region.Euclidian


def drawn(job):
    solid, holes = pya.Region(), pya.Region()
    for hole, points in job["polygons"]:
        polygon = pya.DPolygon([pya.DPoint(x, y + 100) for x, y in points]).to_itype(0.001)
        (holes if hole else solid).insert(polygon)
    return solid.merged(), holes.merged()


def judge(job):
    solid, holes = drawn(job)
    shape = (solid - holes).merged()
    out = {"pieces": max(solid.count(), shape.count()), "holes inside": (holes.sized(4000) - solid).is_empty(), "wrong": []}
    if "gds" not in job:
        return out
    layout = pya.Layout()
    layout.read(job["gds"])
    mask = pya.Region(layout.top_cell().begin_shapes_rec(layout.layer(1, 0))).merged()
    box = solid.bbox()
    window = pya.Region(pya.Box(box.left - 2000, 500000, box.right + 2000, box.top + 2000))
    if job["alike"]:
        wanted = shape.sized(round(1000 * job["bias"]), 4)
        differs = ((mask ^ wanted) & window).sized(-60)
        if not differs.is_empty():
            out["wrong"].append("the mask differs from the shape by %.3f um2 at %s" % (1e-6 * differs.area(), differs.bbox().to_s()))
    for name, found in (("width", mask.width_check(3995, False, NEAR, 89.0, None, None)),
                        ("space", mask.space_check(3995, False, NEAR, 89.0, None, None))):
        if found.count():
            out["wrong"].append("%d times a %s below 4 um, at %s" % (found.count(), name, next(found.each()).bbox().to_s()))
    return out


json.dump([judge(job) for job in json.load(open(jobs))], open(result, "w"))
