#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""layers.py GDS TABLE.xml [CERTIFICATE.json]: one line per layer that holds boundaries,
"LAYER/DATATYPE WIDTH SPACE AREA": the table's rules in um (4 without a row or a rule), the
certificate's polygon area in um2 ("-" without one). Reads the records itself."""
import json, os, sys, struct, xml.etree.ElementTree as ET

UNIT = {"nm": 1e-3, "um": 1.0, "mm": 1e3}

def boundary_layers(name):
    data, found, at = open(name, "rb").read(), set(), 0
    inside = layer = datatype = None
    while at + 4 <= len(data):
        length, kind = struct.unpack(">HB", data[at:at + 3])
        if length < 4:
            break
        if kind == 0x08:
            inside = True
        elif kind == 0x0d:
            layer = struct.unpack(">H", data[at + 4:at + 6])[0]
        elif kind == 0x0e:
            datatype = struct.unpack(">H", data[at + 4:at + 6])[0]
        elif kind == 0x11:
            if inside:
                found.add((layer, datatype))
            inside = False
        at += length
    return sorted(found)

def length(text):
    value, unit = text.split()
    return float(value) * UNIT[unit]

rules, area = {}, {}
if len(sys.argv) > 2 and os.path.exists(sys.argv[2]):
    for e in ET.parse(sys.argv[2]).getroot():
        rules[e.get("gds")] = tuple(length(e.get(k, "4 um")) for k in ("min-width", "min-space"))
if len(sys.argv) > 3 and os.path.exists(sys.argv[3]):
    for e in json.load(open(sys.argv[3]))["layers"]:
        area[e["gds"]] = "%.6f" % e["polygon_area_um2"]
for k in boundary_layers(sys.argv[1]):
    key = "%d/%d" % k
    w, s = rules.get(key, (4.0, 4.0))
    print(key, repr(w), repr(s), area.get(key, "-"))
