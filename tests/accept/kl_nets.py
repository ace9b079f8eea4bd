# SPDX-License-Identifier: GPL-3.0-or-later
# kl_nets.py: klayout -b -r kl_nets.py -rd f=FILE.gds -rd certificate=FILE.json -rd layer=1/0
# Traces the conductors of the written polygons with KLayout's net extractor and holds them against the certificate: as many nets, the
# largest area of each, every contact on the net that it belongs to, and the least distance of two nets. Tethers are still there on the
# mask: the nets that the certificate calls tethered may hang together.
import json
import sys

import pya

g = globals()
doc = json.load(open(certificate))
layout = pya.Layout()
layout.read(f)
number, datatype = (int(z) for z in layer.split("/"))
top = layout.top_cell()
index = layout.find_layer(number, datatype)
bad = []
l2n = pya.LayoutToNetlist(pya.RecursiveShapeIterator(layout, top, index))
metal = l2n.make_layer(index, "device")
l2n.connect(metal)
l2n.extract_netlist()
circuit = l2n.netlist().circuit_by_name(top.name)
found = [l2n.shapes_of_net(net, metal, True).merged() for net in circuit.each_net()]
nets, on_mask = doc["wiring"]["nets"], doc["nets_on_mask"]
tethered = sum(net["tethered"] for net in nets)
if not (on_mask["nets"] - tethered <= len(found) <= on_mask["nets"]):
    bad.append(f"{len(found)} nets, the certificate has {on_mask['nets']}")
if len(nets) != on_mask["nets"]:
    bad.append("drawing and mask of the certificate differ")
# areas of what the bias leaves when it is taken back; corners that it rounded or mitred, and the grid, are off by little
back = -round(doc["bias_um_per_edge"] * 1000)
drawn = sorted(net["area_m2"] * 1e12 for net in nets)
traced = sorted((region.sized(back).area() * layout.dbu**2, region.perimeter() * layout.dbu) for region in found)
if not tethered:
    for one, (other, length) in zip(drawn, traced):
        if abs(one - other) > 2e-3 * length + 2e-4 * one:
            bad.append(f"area {other:.1f} um2, the certificate has {one:.1f}")
# contacts: the whole square on one traced net, another one for each
used = []
for net in nets:
    if net["pad_m"] is None:
        continue
    box = pya.Box(*(round(v * 1e9) for v in net["pad_m"]))
    on = [i for i, region in enumerate(found) if (pya.Region(box) & region).area() == box.area()]
    if len(on) != 1 or on[0] in used:
        bad.append(f"the contact of {net['net']} lies on nets {on}")
    used += on
# least distance between different nets
if len(found) > 1 and not tethered:
    least = round(on_mask["least_um"] * 1000)
    for i, one in enumerate(found):
        for other in found[i + 1:]:
            if not one.separation_check(other, least - 3, False, pya.Region.Euclidian).is_empty():
                bad.append(f"two nets come nearer than {least - 3} nm")
    if all(one.separation_check(other, least + 3, False, pya.Region.Euclidian).is_empty()
           for i, one in enumerate(found) for other in found[i + 1:]):
        bad.append(f"no two nets come as near as {least + 3} nm")
for line in bad:
    print(line)
print(f"NETS {len(found)}", "FAIL" if bad else "PASS")
sys.stdout.flush()
pya.Application.instance().exit(1 if bad else 0)
