# SPDX-License-Identifier: GPL-3.0-or-later
# klayout -z -nc -r drive_package.py -rd work=DIR: what test_package.py asks, in one window; DIR/result.json has the answers
import json
import pathlib
import sys
import time
import traceback

import pya

here = pathlib.Path(work)
out = {}


def texts(cell):
    index = cell.layout().find_layer(63, 0) if hasattr(cell.layout(), "find_layer") else cell.layout().layer(63, 0)
    return [s.text_string for s in cell.shapes(index).each() if s.is_text()] if index is not None else []


def region(layout, cell, layer=(1, 0)):
    return pya.Region(cell.begin_shapes_rec(layout.layer(*layer)))


def place(layout, name, values):
    start = time.time()
    cell = layout.create_cell(name, "Flexwright", values)
    return cell, time.time() - start


try:
    from flexwright_klayout import library, menu, program
    window = pya.MainWindow.instance()
    out["libraries"] = pya.Library.library_names()
    out["technologies"] = sorted(pya.Technology.technology_names())
    out["menu"] = window.menu().items("tools_menu.flexwright") if window.menu().is_valid("tools_menu.flexwright") else []
    declared = pya.Library.library_by_name("Flexwright").layout()
    out["cells"] = declared.pcell_names()
    out["parameters"] = {p.name: [p.default, p.description] for p in declared.pcell_declaration("reference-six-bar").get_parameters()}

    layout = pya.Layout()
    layout.dbu = 0.001
    top = layout.create_cell("TOP")
    cell, out["first_s"] = place(layout, "reference-six-bar", {"flow": "al-masked-rie"})
    top.insert(pya.DCellInstArray(cell.cell_index(), pya.DTrans(1, False, 5000.0, 7000.0)))
    other, out["redraw_s"] = place(layout, "reference-six-bar", {"flow": "al-masked-rie", "p_link": "130 um"})
    _, out["again_s"] = place(layout, "reference-six-bar", {"flow": "al-masked-rie", "p_link": "130 um", "layers": "1/0"})
    reference = pya.Layout()
    reference.read(str(here / "reference.gds"))
    changed = pya.Layout()
    changed.read(str(here / "changed.gds"))
    out["layers"] = sorted(i.to_s() for i in layout.layer_infos())
    out["xor"] = [(region(layout, cell, key) ^ region(reference, reference.top_cell(), key)).area() for key in ((1, 0), (2, 0), (3, 0), (4, 0))]
    out["xor_changed"] = (region(layout, other) ^ region(changed, changed.top_cell())).area()
    out["differs"] = (region(layout, other) ^ region(layout, cell)).area()
    only, _ = place(layout, "reference-six-bar", {"flow": "al-masked-rie", "layers": "2/0"})
    out["only"] = [region(layout, only, key).count() for key in ((1, 0), (2, 0))]
    coarse = pya.Layout()
    coarse.dbu = 0.002
    half, _ = place(coarse, "reference-six-bar", {"flow": "al-masked-rie"})
    out["coarse_um2"] = region(coarse, half).merged().area() * coarse.dbu ** 2
    out["fine_um2"] = region(layout, cell).merged().area() * layout.dbu ** 2
    out["errors"] = {}
    for name, values in (("wrong unit", {"p_link": "130"}), ("out of range", {"p_link": "3 mm"}), ("unknown unit", {"p_arc": "200 dgr"})):
        out["errors"][name] = texts(place(layout, "reference-six-bar", values)[0])
    for name, values in (("any", {"file": str(here / "device.xml"), "set": "link=130 um", "flow": "al-masked-rie"}),
                         ("absent", {"file": str(here / "none.xml")}), ("bad pairs", {"file": str(here / "device.xml"), "set": "link"}),
                         ("bad file", {"file": str(here / "bad.xml")})):
        cell, _ = place(layout, "device file", values)
        out["errors"][name] = texts(cell)
        if name == "any":
            out["xor_any"] = (region(layout, cell) ^ region(changed, changed.top_cell())).area()
    layout.write(str(here / "written.gds"))

    # every device of the gallery in the first of its flows: outlines, and no message
    out["gallery"] = {}
    for name in sorted(p.stem for p in (program.HERE / "devices").glob("*.xml")):
        cell, _ = place(layout, name, {})
        out["gallery"][name] = [region(layout, cell).area(), [t for t in texts(cell) if "error" in t or "declaration" in t]]

    # the file changes: what is drawn of it follows
    mine = here / "devices/mine.xml"
    cell, _ = place(layout, "mine", {"flow": "al-masked-rie"})
    before = region(layout, cell).area()
    mine.write_text(mine.read_text().replace('value="120 um"', 'value="130 um"'))
    library.Flexwright()
    fresh = pya.Layout()
    out["follows"] = [before, region(fresh, place(fresh, "mine", {"flow": "al-masked-rie"})[0]).area(), region(changed, changed.top_cell()).area()]

    # plan, markers, reload
    start = time.time()
    views = menu.plan(here / "narrow.xml", {}, here / "planned")
    out["plan_s"] = time.time() - start
    view = window.current_view()
    out["views"] = len(views)
    shown = [window.view(i) for i in views]
    out["technologies_shown"] = [v.cellview(0).technology for v in shown]
    out["items"] = [v.rdb(0).num_items() if v.num_rdbs() else 0 for v in shown]
    out["categories"] = [[c.path() for c in v.rdb(0).each_category()] if v.num_rdbs() else [] for v in shown]
    shown[0].save_image(str(here / "shown.png"), 900, 700)
    text = (here / "narrow.xml").read_text()
    (here / "narrow.xml").write_text(text.replace('gap="5 um"', 'gap="8 um"'))
    again = menu.reload(window)
    out["reloaded"] = [again == views, [window.view(i).rdb(0).num_items() if window.view(i).num_rdbs() else 0 for i in again], window.views()]
    try:
        menu.plan(here / "bad.xml", {}, here / "bad")
    except program.Failure as failure:
        out["plan_error"] = failure.sentences
except Exception:
    out["trace"] = traceback.format_exc()
(here / "result.json").write_text(json.dumps(out))
