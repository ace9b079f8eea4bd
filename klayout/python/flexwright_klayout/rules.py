# SPDX-License-Identifier: GPL-3.0-or-later
"""A mask certificate's rules as a DRC script of KLayout: a table, behind it drc/engine.rb, which says what the rules do."""
import json
import math
import pathlib
import xml.sax.saxutils

ENGINE = pathlib.Path(__file__).resolve().parents[2] / "drc/engine.rb"
# to what the engine counts in: nm, rad, nm2, a share
FACTOR = {"um": 1e3, "deg": math.pi / 180, "um2": 1e6, "1": 1.0}


def number(value):
    return "%d" % round(value) if abs(value - round(value)) < 1e-9 * max(1, value) else "%.16g" % value


def category(rule):
    """what the rule is called in the marker browser, as in: width 1/0, at least 4 um"""
    words = [rule["kind"], rule["of"] if rule["kind"] != "overlap" else None, rule["layer"], rule["other"]]
    limits = ["%s %.9g %s" % (word, rule[key] * (100 if rule["unit"] == "1" else 1), "%" if rule["unit"] == "1" else rule["unit"])
              for word, key in (("at least", "min"), ("at most", "max")) if rule[key] is not None]
    return ", ".join([" ".join(w for w in words if w), *limits])


def row(rule, certificate):
    more, factor = [], FACTOR[rule["unit"]]
    if rule["of"]:
        more.append(("of", '"%s"' % rule["of"]))
    if rule["other"]:
        more.append(("other", '"%s"' % rule["other"]))
    if rule["max"] is not None:
        more.append(("most", number(rule["max"] * factor)))
    elif rule["kind"] == "density":
        more.append(("most", "Float::INFINITY"))
    if rule["window_um"] is not None:
        more += [("window", number(rule["window_um"] * 1e3)), ("step", number(rule["step_um"] * 1e3)),
                 ("layers", json.dumps([y["gds"] for y in certificate["layers"]]))]
    if rule["kind"] == "space" and any(r["kind"] == "notch" and r["layer"] == rule["layer"] for r in certificate["rules"]):
        more.append(("notch", "true"))
    more.append(("name", json.dumps(category(rule))))
    more.append(("source", json.dumps("%s [FW-D%03d] %s" % (rule["severity"], rule["code"], rule["source"]))))
    return 'flexwright_rule "%s", "%s", %s, %s' % (rule["kind"], rule["layer"], number((rule["min"] or 0) * factor),
                                                  ", ".join("%s: %s" % m for m in more))


def script(certificate):
    """the text of FLOW.lydrc"""
    flow = certificate["flow"]
    lines = ["# Design rules of %s, from masks/%s.xml of Flexwright; made by the package, do not edit." % (flow, flow),
             "# klayout -b -r %s.lydrc -rd input=FILE.gds -rd report=FILE.lyrdb" % flow,
             "source($input) if $input",
             '$report ? report("Flexwright: %s", $report) : report("Flexwright: %s")' % (flow, flow), "", ENGINE.read_text(encoding="utf-8"), ""]
    lines += [row(rule, certificate) for rule in certificate["rules"]]
    text = xml.sax.saxutils.escape("\n".join(lines))
    return """<?xml version="1.0" encoding="utf-8"?>
<klayout-macro>
 <description>Flexwright: design rules of %s</description>
 <version/>
 <category>drc</category>
 <prolog/>
 <epilog/>
 <doc/>
 <autorun>false</autorun>
 <autorun-early>false</autorun-early>
 <shortcut/>
 <show-in-menu>true</show-in-menu>
 <group-name>drc_scripts</group-name>
 <menu-path>tools_menu.drc.end</menu-path>
 <interpreter>dsl</interpreter>
 <dsl-interpreter-name>drc-dsl-xml</dsl-interpreter-name>
 <text>%s
</text>
</klayout-macro>
""" % (flow, text)
